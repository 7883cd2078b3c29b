// SPDX-License-Identifier: MIT
//
// The triangles that a few tiles of a large level need. To check and sort all triangles of a city takes longer than to
// bake the tiles, so most of them are rejected first, by their bounds.

#include "nav_bake/input/range_input.h"

#include "base/arena.h"
#include "base/assert.h"

#include <string.h>

// Written so that what is no number counts as inside.
static bool may_lie_in(const tl_mesh_view *mesh, const uint32_t *corners, const tl_aabb *window)
{
    if (corners[0] >= mesh->vertex_count || corners[1] >= mesh->vertex_count || corners[2] >= mesh->vertex_count) {
        return true;
    }
    const tl_vec3 *a = &mesh->vertices[corners[0]], *b = &mesh->vertices[corners[1]], *c = &mesh->vertices[corners[2]];
    return !((a->x < window->min.x && b->x < window->min.x && c->x < window->min.x) ||
             (a->x > window->max.x && b->x > window->max.x && c->x > window->max.x) ||
             (a->z < window->min.z && b->z < window->min.z && c->z < window->min.z) ||
             (a->z > window->max.z && b->z > window->max.z && c->z > window->max.z));
}

static tl_result grow_range_input(tl_range_input *range, const tl_allocator *allocator)
{
    uint32_t *grown = tl_grow_array(allocator, range->triangles, &range->capacity, sizeof *grown);
    if (grown == NULL) {
        return TL_ERR_MEMORY;
    }
    range->triangles = grown;
    return TL_OK;
}

tl_result tl_range_input_make(const tl_nav_input *input, tl_triangle_list list, tl_aabb window,
                              const tl_allocator *allocator, tl_range_input *range_out)
{
    tl_range_input *range = range_out;
    memset(range, 0, sizeof *range);
    range->input = *input;
    tl_mesh_view *mesh = &range->input.mesh;
    mesh->triangle_count = 0;
    for (uint32_t i = 0; i < list.count; i++) {
        const uint32_t t = tl_triangle_list_get(&list, i);
        if (may_lie_in(&input->mesh, input->mesh.indices + 3 * (size_t)t, &window)) {
            if (mesh->triangle_count == range->capacity) {
                TL_TRY(grow_range_input(range, allocator));
            }
            range->triangles[mesh->triangle_count++] = t;
        }
    }
    const uint32_t count = mesh->triangle_count;
    if (count == 0) {
        return TL_OK;
    }
    range->indices = tl_allocate_array(allocator, 3 * (uint64_t)count, sizeof *range->indices);
    range->areas = input->areas != NULL ? tl_allocate_array(allocator, count, sizeof *range->areas) : NULL;
    if (range->indices == NULL || (input->areas != NULL && range->areas == NULL)) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        memcpy(range->indices + 3 * (size_t)i, input->mesh.indices + 3 * (size_t)range->triangles[i],
               3 * sizeof *range->indices);
        if (range->areas != NULL) {
            range->areas[i] = input->areas[range->triangles[i]];
        }
    }
    mesh->indices = range->indices;
    range->input.areas = range->areas;
    return TL_OK;
}

void tl_range_input_free(tl_range_input *range, const tl_allocator *allocator)
{
    const uint64_t count = range->input.mesh.triangle_count;
    tl_release_array(allocator, range->indices, 3 * count, sizeof *range->indices);
    tl_release_array(allocator, range->areas, count, sizeof *range->areas);
    tl_release_array(allocator, range->triangles, range->capacity, sizeof *range->triangles);
    memset(range, 0, sizeof *range);
}
