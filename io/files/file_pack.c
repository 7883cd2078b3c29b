// SPDX-License-Identifier: MIT
//
// Files are little-endian on every machine; what was read into memory may be turned round there.

#include "io/files/file_pack.h"

#include <string.h>

tl_result tl_file_open_pack(const tl_file_map *map, tl_pack *pack_out, tl_report *report_out)
{
    if (!map->mapped) {
        // The copy is the map's own memory; only its users must not write to it.
        const tl_result result = tl_pack_to_host_order((void *)(uintptr_t)map->bytes, map->size, report_out);
        if (result != TL_OK) {
            memset(pack_out, 0, sizeof *pack_out);
            return result;
        }
    }
    return tl_pack_open(map->bytes, map->size, pack_out, report_out);
}
