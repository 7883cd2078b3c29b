// SPDX-License-Identifier: MIT
//
// Where each part of a baked hull lies, and the derived values in it. The bake writes by these rules and the check
// compares by them, so a hull that passes is the one that its vertices and topology imply.

#include "hull/support/face_ring.h"

#include "math/tolerance.h"

#include <stddef.h>

// A coordinate relative to the middle is rounded once; then a product and two sums; the comparison's own roundings make
// less than eight in a row.
#define SCAN_ERROR TL_FLOAT_GAMMA(8)

// Parts begin at whole units of TL_BLOB_ALIGNMENT.
static uint64_t place_units(uint64_t *units, uint64_t count, uint64_t element_size)
{
    uint64_t at = *units;
    *units = at + (count * element_size + TL_BLOB_ALIGNMENT - 1) / TL_BLOB_ALIGNMENT;
    return at;
}

static uint64_t place_bytes(uint64_t *units, uint64_t count, uint64_t element_size)
{
    return place_units(units, count, element_size) * TL_BLOB_ALIGNMENT;
}

uint64_t tl_hull_lay_out(tl_hull *head)
{
    // With the most points that a hull may have the units stay below 2^32.
    _Static_assert(offsetof(tl_hull, rings) + sizeof(uint32_t) <= TL_BLOB_ALIGNMENT, "a support reads one cache line");
    uint64_t units = (sizeof(tl_hull) + TL_BLOB_ALIGNMENT - 1) / TL_BLOB_ALIGNMENT;
    bool scanned = head->vertex_count <= TL_HULL_SCAN_LIMIT;
    uint32_t padding = head->vertex_count <= TL_CLIMB_LANES ? TL_CLIMB_LANES : TL_SCAN_PAIR;
    head->scan_count = scanned ? (head->vertex_count + padding - 1) / padding * padding : 0;
    head->table_side = scanned ? 0 : tl_hull_table_side(head->vertex_count, head->ring_count > 0);
    uint64_t cells = 2 * (uint64_t)head->table_side * head->table_side + head->ring_cells;
    head->scan = (uint32_t)place_units(&units, 3 * (uint64_t)head->scan_count, sizeof(float));
    head->table = (uint32_t)place_units(&units, cells, sizeof(uint32_t));
    head->rings = (uint32_t)place_units(&units, head->ring_count, sizeof(tl_face_ring));
    head->blocks = (uint32_t)place_units(&units, head->block_count, sizeof(tl_climb_block));
    head->vertices = place_bytes(&units, head->vertex_count, sizeof(tl_vec3));
    head->sources = place_bytes(&units, head->vertex_count, sizeof(uint32_t));
    head->vertex_edges = place_bytes(&units, head->vertex_count, sizeof(uint32_t));
    head->half_edges = place_bytes(&units, head->half_edge_count, sizeof(tl_hull_half_edge));
    head->faces = place_bytes(&units, head->face_count, sizeof(tl_hull_face));
    head->planes = place_bytes(&units, tl_hull_plane_block_count(head->face_count), sizeof(tl_hull_plane_block));
    return units * TL_BLOB_ALIGNMENT;
}

void tl_hull_count_rings(tl_hull *head, const tl_hull_face *faces)
{
    head->ring_count = head->ring_cells = 0;
    for (uint32_t f = 0; f < head->face_count && head->vertex_count > TL_HULL_SCAN_LIMIT; f++) {
        if (tl_face_has_ring(faces[f].count)) {
            head->ring_count++;
            head->ring_cells += tl_face_ring_cells(faces[f].count);
        }
    }
}

uint32_t tl_hull_blocks_of(uint32_t degree)
{
    // All blocks but the last give one lane to the link that goes on.
    return degree <= TL_CLIMB_LANES ? 1 : (degree + TL_CLIMB_LANES - 3) / (TL_CLIMB_LANES - 1);
}

tl_vec3 tl_hull_edge_vector(tl_vec3 from, tl_vec3 to)
{
    return tl_vec3_make((float)((double)to.x - (double)from.x), (float)((double)to.y - (double)from.y),
                        (float)((double)to.z - (double)from.z));
}

void tl_hull_fill_block(const tl_vec3 *vertices, const tl_hull_half_edge *half_edges, uint32_t *edge, uint32_t count,
                        tl_climb_block *block)
{
    const tl_vec3 vertex = vertices[half_edges[*edge].origin];
    for (uint32_t lane = 0; lane < TL_CLIMB_LANES; lane++) {
        if (lane < count) {
            uint32_t other = half_edges[half_edges[*edge].next].origin;
            tl_vec3 e = tl_hull_edge_vector(vertex, vertices[other]);
            block->x[lane] = e.x;
            block->y[lane] = e.y;
            block->z[lane] = e.z;
            block->link[lane] = other;
            *edge = half_edges[half_edges[*edge].twin].next;
        } else {
            block->x[lane] = block->x[0];
            block->y[lane] = block->y[0];
            block->z[lane] = block->z[0];
            block->link[lane] = block->link[0];
        }
    }
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
