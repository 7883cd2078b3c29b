// SPDX-License-Identifier: MIT
//
// Whether a point lies inside a solid.

#ifndef TALUS_SRC_NAV_PRUNE_SOLIDS_H
#define TALUS_SRC_NAV_PRUNE_SOLIDS_H

#include <talus/mesh.h>
#include <talus/soup.h>

/// The closed parts of a mesh, ready for queries. Zeroed: no part; free with tl_solids_free.
typedef struct tl_solids {
    tl_closed_parts parts;
    tl_soup *soup;     ///< of the closed parts' triangles; NULL: there is none
    uint32_t *part_of; ///< [triangles of the soup]
    uint32_t *indices; ///< what the soup was baked from
    uint32_t index_count;
    uint32_t outward_count; ///< parts that face outwards
    int32_t *winding;       ///< [parts.part_count] zero between calls
    tl_ray_hit *hits;       ///< grows
    uint64_t hit_capacity;
    const tl_allocator *allocator;
} tl_solids;

/// TL_ERR_MEMORY, TL_ERR_LIMIT, TL_ERR_CANCELLED; the soup's other errors name the vertex. Free also then.
tl_result tl_solids_init(const tl_mesh_view *mesh, const tl_host *host, tl_solids *solids_out, tl_report *report);
void tl_solids_free(tl_solids *solids);

/// One thread at a time: it uses the scratch above. TL_ERR_MEMORY.
tl_result tl_solids_contain(tl_solids *solids, tl_vec3 point, bool *inside_out);

#endif
