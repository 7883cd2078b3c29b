// SPDX-License-Identifier: MIT
//
// A baked file's bytes as a container, on machines of either byte order.

#ifndef TALUS_IO_FILE_PACK_H
#define TALUS_IO_FILE_PACK_H

#include "io/files/file_map.h"

#include <talus/pack.h>

#ifdef __cplusplus
extern "C" {
#endif

/// tl_pack_to_host_order, where the bytes are a copy (tl_file_read), then tl_pack_open. A mapped file cannot be turned
/// round: on big-endian machines it is refused as tl_pack_open refuses it. `pack_out` is a view of the map. Errors: of
/// both. `report_out` may be NULL.
tl_result tl_file_open_pack(const tl_file_map *map, tl_pack *pack_out, tl_report *report_out);

#ifdef __cplusplus
}
#endif

#endif
