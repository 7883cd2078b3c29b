// SPDX-License-Identifier: MIT
//
// Whether a point is inside a solid, by winding numbers: a ray straight up crosses the surfaces of all closed parts
// around the point; the parts that it leaves more often than it enters contain the point, and the smallest of them
// decides. So the inside of a pillar in a room is solid, and a cave inside a mountain is not; parts that intersect are
// counted separately. Crossings at edges and corners are counted exactly (TL_HITS_CROSSED of soup.h).
//
// Rejected: one winding number for all parts. A room (-1) around a pillar (+1) adds up to the same 0 as a mountain
// around a cave. Rejected: the side of the first surface that the ray meets. Where a pillar stands in the room's floor,
// that may be either's.

#include "nav_prune/solids.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"

#include <math.h>
#include <string.h>

static tl_result collect_triangles(const tl_mesh_view *mesh, tl_solids *s)
{
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        s->index_count += s->parts.part_of[t] != TL_NO_PART ? 3 : 0;
    }
    s->indices = tl_allocate_array(s->allocator, s->index_count, sizeof *s->indices);
    s->part_of = tl_allocate_array(s->allocator, s->index_count / 3, sizeof *s->part_of);
    if (s->indices == NULL || s->part_of == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t count = 0;
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        if (s->parts.part_of[t] != TL_NO_PART) {
            memcpy(s->indices + 3 * (size_t)count, mesh->indices + 3 * (size_t)t, 3 * sizeof *s->indices);
            s->part_of[count++] = s->parts.part_of[t];
        }
    }
    return TL_OK;
}

tl_result tl_solids_init(const tl_mesh_view *mesh, const tl_host *host, tl_solids *solids_out, tl_report *report)
{
    tl_solids *s = solids_out;
    memset(s, 0, sizeof *s);
    s->allocator = host->allocator;
    TL_TRY(tl_closed_parts_find(mesh, host, &s->parts, NULL));
    for (uint32_t p = 0; p < s->parts.part_count; p++) {
        s->outward_count += s->parts.volumes[p] > 0.0;
    }
    if (s->outward_count == 0) {
        return TL_OK;
    }
    TL_TRY(collect_triangles(mesh, s));
    s->winding = tl_allocate_array(s->allocator, s->parts.part_count, sizeof *s->winding);
    if (s->winding == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(s->winding, 0, s->parts.part_count * sizeof *s->winding);
    const tl_mesh_view closed = { mesh->vertices, mesh->vertex_count, s->indices, s->index_count / 3, NULL };
    tl_soup_def def = tl_default_soup_def();
    def.quality = TL_SOUP_QUALITY_FAST; // few queries
    def.host = *host;
    tl_soup_report soup_report;
    const tl_result result = tl_soup_bake(&closed, &def, &s->soup, &soup_report);
    if (result != TL_OK && report != NULL) {
        *report = soup_report.base;
    }
    return result;
}

void tl_solids_free(tl_solids *s)
{
    tl_blob_free(s->soup);
    tl_release_array(s->allocator, s->winding, s->parts.part_count, sizeof *s->winding);
    tl_release_array(s->allocator, s->part_of, s->index_count / 3, sizeof *s->part_of);
    tl_release_array(s->allocator, s->indices, s->index_count, sizeof *s->indices);
    tl_release_array(s->allocator, s->hits, s->hit_capacity, sizeof *s->hits);
    tl_closed_parts_free(&s->parts);
    memset(s, 0, sizeof *s);
}

static tl_result grow_hits(tl_solids *s, uint32_t count)
{
    tl_release_array(s->allocator, s->hits, s->hit_capacity, sizeof *s->hits);
    s->hit_capacity = 0;
    s->hits = tl_allocate_array(s->allocator, 2 * (uint64_t)count, sizeof *s->hits);
    if (s->hits == NULL) {
        return TL_ERR_MEMORY;
    }
    s->hit_capacity = 2 * (uint64_t)count;
    return TL_OK;
}

static tl_result cast_up(tl_solids *s, tl_vec3 point, uint32_t *count_out)
{
    const tl_ray ray = { point, tl_vec3_make(0.0f, 1.0f, 0.0f), INFINITY };
    tl_result result =
        tl_soup_cast_ray_all(s->soup, &ray, TL_HITS_CROSSED, NULL, s->hits, (uint32_t)s->hit_capacity, count_out);
    if (result == TL_INCOMPLETE) {
        TL_TRY(grow_hits(s, *count_out));
        result =
            tl_soup_cast_ray_all(s->soup, &ray, TL_HITS_CROSSED, NULL, s->hits, (uint32_t)s->hit_capacity, count_out);
    }
    return result;
}

tl_result tl_solids_contain(tl_solids *s, tl_vec3 point, bool *inside_out)
{
    *inside_out = false;
    if (s->soup == NULL) {
        return TL_OK;
    }
    uint32_t count = 0;
    TL_TRY(cast_up(s, point, &count));
    for (uint32_t i = 0; i < count; i++) {
        s->winding[s->part_of[s->hits[i].triangle]] += s->hits[i].back ? 1 : -1;
    }
    uint32_t innermost = TL_NO_PART;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t part = s->part_of[s->hits[i].triangle];
        if (s->winding[part] != 0) {
            const bool smaller =
                innermost == TL_NO_PART || fabs(s->parts.volumes[part]) < fabs(s->parts.volumes[innermost]);
            innermost = smaller ? part : innermost;
        }
    }
    *inside_out = innermost != TL_NO_PART && s->winding[innermost] > 0;
    for (uint32_t i = 0; i < count; i++) {
        s->winding[s->part_of[s->hits[i].triangle]] = 0;
    }
    return TL_OK;
}
