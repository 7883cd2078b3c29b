// SPDX-License-Identifier: MIT
//
// Writing a baked file: its chunks gathered, then all of them at once.

#ifndef TALUS_CLI_WRITE_PACK_H
#define TALUS_CLI_WRITE_PACK_H

#include "cli/level/bake_level.h"
#include "cli/shared/command.h"

#include <talus/pack.h>

/// The chunks of one file, and what must be freed with them. Zero is empty.
typedef struct tl_pack_content {
    tl_pack_item *items;
    uint32_t count;
    tl_pack_meta *meta;
    tl_pack_navmesh *navmesh;
    tl_pack_frame *frame;
} tl_pack_content;

/// Takes up to `max_count` chunks. Free with tl_pack_content_free, also after a failure.
tl_result tl_pack_content_make(uint32_t max_count, tl_pack_content *content_out);
void tl_pack_content_free(tl_pack_content *content);

/// Adds a blob, which stays the caller's; a NULL is left out.
void tl_pack_content_add(tl_pack_content *content, uint32_t type, uint32_t id, const void *blob);

/// The file's own name of its source: without folders, so that the same level gives the same bytes anywhere.
const char *tl_pack_source_name(const char *path);

/// All chunks of a bake; `nav`: the navmesh's too, also where nothing is walkable. The bake stays the caller's. Free
/// with tl_pack_content_free, also after a failure.
tl_result tl_pack_content_of_bake(const tl_level *level, const tl_bake *bake, bool nav, tl_pack_content *content);

/// Writes the file, whole or not at all, with progress. Failures are reported.
tl_exit tl_pack_content_write(tl_cli *cli, const char *output, const tl_pack_content *content, uint64_t *size_out);

#endif
