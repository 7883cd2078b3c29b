// SPDX-License-Identifier: MIT
//
// Where each part of a baked hull lies, and the derived values in it. The bake writes by these rules and the check
// compares by them, so a hull that passes is the one that its vertices and topology imply.
//
// Hulls are many and small, so most of a layout is what it leaves out. Indices take one byte where the half-edges can
// be counted by it, else two or four. Faces are loops, so the next half-edge is the one behind or the face's first and
// is not stored. Sources that count up are not either. Up to TL_HULL_FEW vertices the support query takes all dot
// products whether it has a hint or not, so there are no edge vectors; and the planes of up to six faces lie in short
// rows. A box is 640 bytes: head 152, rows of the scan 96, planes 208, vertices 96, topology 87.

#include "hull/support/face_ring.h"

#include "math/tolerance.h"

#include <stddef.h>
#include <string.h>

// A coordinate relative to the middle is rounded once; then a product and two sums; the comparison's own roundings make
// less than eight in a row.
#define SCAN_ERROR TL_FLOAT_GAMMA(8)

// Parts begin at whole units of TL_BLOB_ALIGNMENT.
static uint32_t place_units(uint64_t *bytes, uint64_t size)
{
    const uint64_t units = (*bytes + TL_BLOB_ALIGNMENT - 1) / TL_BLOB_ALIGNMENT;
    *bytes = units * TL_BLOB_ALIGNMENT + size;
    return (uint32_t)units; // with the most points that a hull may have they stay below 2^32
}

uint64_t tl_hull_plane_bytes(const tl_hull *head)
{
    const uint64_t lanes = tl_hull_plane_lanes(head), rows = 4 * lanes * tl_hull_plane_block_count(head);
    return (rows + 8 - lanes) * sizeof(double);
}

uint64_t tl_hull_cell_count(const tl_hull_climb *climb)
{
    return 2 * (uint64_t)climb->table_side * climb->table_side + climb->ring_cells;
}

uint64_t tl_hull_sources_offset(const tl_hull *head)
{
    const uint64_t words = (tl_hull_word_count(head) * head->index_bytes + 3) / 4 * 4;
    return head->vertices + sizeof(tl_vec3) * (uint64_t)head->vertex_count + words;
}

static uint64_t lay_out_climb(const tl_hull *head, tl_hull_climb *climb, uint64_t bytes)
{
    const bool scanned = head->vertex_count <= TL_HULL_SCAN_LIMIT;
    climb->table_side = scanned ? 0 : tl_hull_table_side(head->vertex_count, climb->ring_count > climb->cap_count);
    climb->cell_bytes = head->vertex_count <= TL_TABLE_SHORT_RING ? sizeof(uint16_t) : sizeof(uint32_t);
    climb->planes = place_units(&bytes, tl_hull_plane_bytes(head));
    climb->table = place_units(&bytes, tl_hull_cell_count(climb) * climb->cell_bytes);
    climb->rings = place_units(&bytes, climb->ring_count * sizeof(tl_face_ring));
    climb->blocks = place_units(&bytes, climb->block_count * sizeof(tl_climb_block));
    return bytes;
}

uint64_t tl_hull_lay_out(tl_hull *head, tl_hull_climb *climb)
{
    _Static_assert(offsetof(tl_hull, mass) == TL_BLOB_ALIGNMENT, "what queries read is one cache line");
    _Static_assert(sizeof(tl_hull_climb) == TL_BLOB_ALIGNMENT, "so is this");
    _Static_assert(TL_HULL_CLIMB_OFFSET % TL_BLOB_ALIGNMENT == 0 && TL_HULL_CLIMB_OFFSET >= sizeof(tl_hull), "beside");
    const bool few = head->vertex_count <= TL_HULL_FEW;
    const uint64_t rows = few ? sizeof *head : TL_HULL_CLIMB_OFFSET + sizeof *climb;
    const uint64_t scan_bytes = 3 * sizeof(float) * (uint64_t)tl_hull_scan_count(head);
    head->index_bytes = head->half_edge_count < 0x100 ? 1 : head->half_edge_count < 0x10000 ? 2 : 4;
    head->vertices = (uint16_t)(rows + scan_bytes + (few ? tl_hull_plane_bytes(head) : 0));
    uint64_t bytes = tl_hull_sources_offset(head) + (uint64_t)tl_hull_source_bytes(head) * head->vertex_count;
    if (few) {
        memset(climb, 0, sizeof *climb);
    } else {
        bytes = lay_out_climb(head, climb, bytes);
    }
    place_units(&bytes, 0);
    return bytes;
}

void tl_hull_count_ring(uint32_t vertex_count, uint32_t corners, tl_hull_climb *climb)
{
    if (vertex_count > TL_HULL_SCAN_LIMIT && tl_face_has_ring(corners)) {
        climb->ring_count++;
        climb->ring_cells += tl_face_ring_cells(corners);
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

void tl_hull_fill_block(const tl_vec3 *vertices, uint32_t vertex, const uint32_t *links, uint32_t count,
                        tl_climb_block *block)
{
    for (uint32_t lane = 0; lane < TL_CLIMB_LANES; lane++) {
        const uint32_t other = links[lane < count ? lane : 0];
        const tl_vec3 e = tl_hull_edge_vector(vertices[vertex], vertices[other]);
        block->x[lane] = e.x;
        block->y[lane] = e.y;
        block->z[lane] = e.z;
        block->link[lane] = other;
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
    for (uint32_t i = 0; i < tl_hull_scan_count(hull); i++) {
        tl_vec3 size = tl_abs(tl_hull_scan_point(hull, i));
        reach = tl_maxf(reach, tl_maxf(size.x, tl_maxf(size.y, size.z)));
    }
    return reach * SCAN_ERROR;
}
