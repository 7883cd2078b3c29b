// SPDX-License-Identifier: MIT
//
// Where each part of a baked hull lies, and the derived values in it. The bake writes by these rules and the check
// compares by them, so a hull that passes is the one that its vertices and topology imply.

#include "hull/support.h"

#include "math/tolerance.h"

// A coordinate relative to the middle is rounded once; then a product and two sums; the comparison's own roundings make
// less than eight in a row.
#define SCAN_ERROR TL_FLOAT_GAMMA(8)
// An edge vector is rounded once; the rest as above.
#define EDGE_ERROR TL_FLOAT_GAMMA(8)

static uint64_t place(uint64_t *size, uint64_t count, uint64_t element_size)
{
    uint64_t at = *size;
    *size = (at + count * element_size + 63u) & ~(uint64_t)63u;
    return at;
}

uint64_t tl_hull_lay_out(tl_hull *head)
{
    uint64_t size = (sizeof(tl_hull) + 63u) & ~(uint64_t)63u;
    bool scanned = head->vertex_count <= TL_HULL_SCAN_LIMIT;
    head->scan_count = scanned ? (head->vertex_count + 7u) & ~7u : 0;
    head->table_cells = scanned ? 0 : tl_hull_table_side(head->vertex_count);
    head->vertices = place(&size, head->vertex_count, sizeof(tl_vec3));
    head->sources = place(&size, head->vertex_count, sizeof(uint32_t));
    head->vertex_edges = place(&size, head->vertex_count, sizeof(uint32_t));
    head->half_edges = place(&size, head->half_edge_count, sizeof(tl_hull_half_edge));
    head->faces = place(&size, head->face_count, sizeof(tl_hull_face));
    head->planes = place(&size, tl_hull_plane_block_count(head->face_count), sizeof(tl_hull_plane_block));
    head->vertex_blocks = place(&size, head->vertex_count, sizeof(uint32_t));
    head->block_vertices = place(&size, head->block_count, sizeof(uint32_t));
    head->block_errors = place(&size, head->block_count, sizeof(float));
    head->blocks = place(&size, head->block_count, sizeof(tl_climb_block));
    head->scan = place(&size, 3 * (uint64_t)head->scan_count, sizeof(float));
    head->table = place(&size, (uint64_t)head->table_cells * head->table_cells, sizeof(uint32_t));
    return size;
}

tl_vec3 tl_hull_edge_vector(tl_vec3 from, tl_vec3 to)
{
    return tl_vec3_make((float)((double)to.x - (double)from.x), (float)((double)to.y - (double)from.y),
                        (float)((double)to.z - (double)from.z));
}

float tl_hull_block_error(const tl_climb_block *block)
{
    float reach = 0.0f;
    for (uint32_t i = 0; i < TL_CLIMB_LANES; i++) {
        reach = tl_maxf(reach, tl_maxf(fabsf(block->x[i]), tl_maxf(fabsf(block->y[i]), fabsf(block->z[i]))));
    }
    return reach * EDGE_ERROR;
}

tl_vec3 tl_hull_scan_point(const tl_hull *hull, uint32_t index)
{
    tl_vec3 p = tl_hull_vertices(hull)[index < hull->vertex_count ? index : hull->vertex_count - 1];
    tl_aabb box = hull->bounds;
    return tl_vec3_make((float)((double)p.x - 0.5 * ((double)box.min.x + (double)box.max.x)),
                        (float)((double)p.y - 0.5 * ((double)box.min.y + (double)box.max.y)),
                        (float)((double)p.z - 0.5 * ((double)box.min.z + (double)box.max.z)));
}

float tl_hull_scan_error(const tl_hull *hull)
{
    float reach = 0.0f;
    for (uint32_t i = 0; i < hull->scan_count; i++) {
        tl_vec3 size = tl_abs(tl_hull_scan_point(hull, i));
        reach = tl_maxf(reach, tl_maxf(size.x, tl_maxf(size.y, size.z)));
    }
    return reach * SCAN_ERROR;
}
