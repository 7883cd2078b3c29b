// SPDX-License-Identifier: MIT
//
// Fewest polygons for an outline of any size.
//
// An outline that is one small walk is solved exactly. A larger one is cut along edges of its triangulation into pieces
// of a few dozen triangles, each piece is solved exactly, and the polygons are merged across the cuts and across the
// bridges to holes. (With holes the exact problem is NP-hard: Lingas 1982.) Merging the triangles is tried as well, as
// they are and as Delaunay triangles, and the fewest polygons win.

#include "polygon/optimal/divide_outline.h"

#include "base/assert.h"
#include "polygon/optimal/optimal_partition.h"
#include "polygon/triangulate/delaunay.h"
#include "polygon/triangulate/fans.h"
#include "polygon/triangulate/triangulate.h"

#include <string.h>

// Up to here an outline is solved whatever it takes; a convex one takes n^2 / 2 chords and n^3 / 6 steps, stars of
// spread angles take several times as many steps.
#define ALWAYS_SOLVED 128
// Larger outlines are given up above these limits. All but the largest of levels stay below them.
#define MAX_SOLVED_CHORDS  (1u << 16)
#define MAX_SOLVED_STEPS   (1u << 22)
#define MAX_SOLVED_CORNERS (1u << 12)
// A piece has at most 2 * PIECE_TRIANGLES + 1 triangles.
#define PIECE_TRIANGLES 32

static tl_result solve_exactly(tl_arena *arena, const tl_triangulated_outline *outline, uint32_t max_corners,
                               tl_convex_parts *parts, bool *found)
{
    *found = false;
    if (outline->count > MAX_SOLVED_CORNERS) {
        return TL_OK;
    }
    tl_visibility visibility;
    TL_TRY(tl_find_visibility(arena, outline, MAX_SOLVED_CHORDS, &visibility, found));
    if (*found) {
        uint64_t max_steps = outline->count <= ALWAYS_SOLVED ? UINT64_MAX : MAX_SOLVED_STEPS;
        TL_TRY(tl_partition_optimally(arena, outline, &visibility, max_corners, max_steps, parts, found));
    }
    return TL_OK;
}

static void add_fans(tl_fans *fans, const tl_convex_parts *parts, const uint32_t *names)
{
    for (uint32_t p = 0; p < parts->count; p++) {
        tl_fans_add(fans, parts->corners + parts->first[p], parts->first[p + 1] - parts->first[p], names);
    }
}

// The number of each triangle's piece. Each triangle but the last was cut off along its edge 2, by a later one, so one
// pass gathers the subtrees, and a subtree that is large enough becomes a piece.
static tl_result cut_into_pieces(tl_arena *arena, const uint32_t *twins, uint32_t triangle_count, uint32_t **piece_out,
                                 uint32_t *piece_count)
{
    uint32_t *piece = TL_PUSH(arena, uint32_t, triangle_count);
    uint32_t *size = TL_PUSH(arena, uint32_t, triangle_count);
    if (piece == NULL || size == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t t = 0; t < triangle_count; t++) {
        size[t] = 1;
        piece[t] = TL_NO_EDGE;
    }
    *piece_count = 0;
    for (uint32_t t = 0; t < triangle_count; t++) {
        if (t + 1 == triangle_count || size[t] >= PIECE_TRIANGLES) {
            piece[t] = (*piece_count)++;
        } else {
            size[twins[3 * t + 2] / 3] += size[t];
        }
    }
    for (uint32_t t = triangle_count; t-- > 0;) {
        piece[t] = piece[t] == TL_NO_EDGE ? piece[twins[3 * t + 2] / 3] : piece[t];
    }
    *piece_out = piece;
    return TL_OK;
}

// The triangles of one piece, as a triangulation of its own outline.
typedef struct piece_outline {
    uint32_t count; // corners
    tl_lattice_point *points;
    uint32_t *names; // [corner]
    uint32_t *triangles;
    uint32_t *twins;
} piece_outline;

static tl_triangulated_outline triangulated_view(const piece_outline *outline)
{
    tl_triangulated_outline view = { outline->points, outline->count, outline->triangles, outline->twins };
    return view;
}

// The triangles of a piece.
typedef struct piece_members {
    const uint32_t *piece;     // [triangle of the walk] its piece
    const uint32_t *rank;      // [triangle of the walk] its place among `triangles`
    const uint32_t *triangles; // [count] those of this piece
    uint32_t count;
} piece_members;

static bool is_piece_border(const uint32_t *twins, const uint32_t *piece, uint32_t edge)
{
    return twins[edge] == TL_NO_EDGE || piece[twins[edge] / 3] != piece[edge / 3];
}

static bool trace_piece(tl_arena *arena, const tl_lattice_point *points, const tl_outline_triangles *all,
                        const piece_members *members, piece_outline *out)
{
    const uint32_t member_count = members->count, *rank = members->rank;
    out->points = TL_PUSH(arena, tl_lattice_point, (uint64_t)member_count + 2);
    out->names = TL_PUSH(arena, uint32_t, (uint64_t)member_count + 2);
    out->triangles = TL_PUSH(arena, uint32_t, 3 * (uint64_t)member_count);
    out->twins = TL_PUSH(arena, uint32_t, 3 * (uint64_t)member_count);
    if (out->points == NULL || out->names == NULL || out->triangles == NULL || out->twins == NULL) {
        return false;
    }
    uint32_t start = TL_NO_EDGE;
    for (uint32_t m = 0; m < member_count; m++) {
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t edge = 3 * members->triangles[m] + k;
            bool border = is_piece_border(all->twins, members->piece, edge);
            uint32_t twin = all->twins[edge];
            out->twins[3 * m + k] = border ? TL_NO_EDGE : 3 * rank[twin / 3] + twin % 3;
            start = border ? edge : start;
        }
    }
    // Around the outline; at each corner, around the triangles that have it.
    uint32_t edge = start;
    out->count = 0;
    do {
        uint32_t corner = out->count++;
        for (edge = tl_triangle_edge_next(edge);; edge = tl_triangle_edge_next(all->twins[edge])) {
            out->triangles[3 * rank[edge / 3] + edge % 3] = corner;
            if (is_piece_border(all->twins, members->piece, edge)) {
                break;
            }
        }
        out->names[corner] = all->corners[edge];
        out->points[corner] = points[all->corners[edge]];
    } while (edge != start);
    TL_ASSERT(out->count == member_count + 2);
    return true;
}

// All triangles of one walk, piece by piece, into fans.
static tl_result solve_pieces(tl_arena *arena, const tl_lattice_point *points, const tl_outline_triangles *walk,
                              uint32_t max_corners, tl_fans *f)
{
    uint32_t *piece, piece_count;
    TL_TRY(cut_into_pieces(arena, walk->twins, walk->count, &piece, &piece_count));
    uint32_t *first = TL_PUSH_ZERO(arena, uint32_t, (uint64_t)piece_count + 2);
    uint32_t *members = TL_PUSH(arena, uint32_t, walk->count);
    uint32_t *rank = TL_PUSH(arena, uint32_t, walk->count);
    if (first == NULL || members == NULL || rank == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t t = 0; t < walk->count; t++) {
        first[piece[t] + 2]++;
    }
    for (uint32_t p = 0; p < piece_count; p++) {
        first[p + 2] += first[p + 1];
    }
    for (uint32_t t = 0; t < walk->count; t++) {
        members[first[piece[t] + 1]++] = t;
    }
    for (uint32_t p = 0; p < piece_count; p++) {
        for (uint32_t m = first[p]; m < first[p + 1]; m++) {
            rank[members[m]] = m - first[p];
        }
    }
    for (uint32_t p = 0; p < piece_count; p++) {
        tl_arena_mark mark = tl_arena_get_mark(arena);
        const piece_members of_piece = { piece, rank, members + first[p], first[p + 1] - first[p] };
        piece_outline outline;
        if (!trace_piece(arena, points, walk, &of_piece, &outline)) {
            return TL_ERR_MEMORY;
        }
        tl_convex_parts parts;
        bool found;
        const tl_triangulated_outline view = triangulated_view(&outline);
        TL_TRY(solve_exactly(arena, &view, max_corners, &parts, &found));
        TL_ASSERT(found);
        add_fans(f, &parts, outline.names);
        tl_arena_rollback(arena, mark);
    }
    return TL_OK;
}

// One walk into fans: at once where that can be, else in pieces.
static tl_result solve_walk(tl_arena *arena, const tl_lattice_point *points, const tl_outline_triangles *walk,
                            uint32_t max_corners, tl_fans *f, bool *is_exact)
{
    uint32_t *piece = TL_PUSH_ZERO(arena, uint32_t, walk->count);
    uint32_t *members = TL_PUSH(arena, uint32_t, walk->count);
    if (piece == NULL || members == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t t = 0; t < walk->count; t++) {
        members[t] = t;
    }
    const piece_members all = { piece, members, members, walk->count };
    piece_outline outline;
    if (!trace_piece(arena, points, walk, &all, &outline)) {
        return TL_ERR_MEMORY;
    }
    tl_convex_parts parts;
    const tl_triangulated_outline view = triangulated_view(&outline);
    TL_TRY(solve_exactly(arena, &view, max_corners, &parts, is_exact));
    if (!*is_exact) {
        return solve_pieces(arena, points, walk, max_corners, f);
    }
    add_fans(f, &parts, outline.names);
    return TL_OK;
}

static tl_result solve_walks(tl_arena *arena, const tl_outline *outline, uint32_t max_corners,
                             const tl_outline_triangles *triangles, tl_fans *f, bool *is_exact)
{
    if (!tl_fans_init(f, arena, triangles->count)) {
        return TL_ERR_MEMORY;
    }
    *is_exact = true;
    uint32_t first = 0;
    for (uint32_t w = 0; w < outline->walk_count; w++) {
        tl_arena_mark mark = tl_arena_get_mark(arena);
        tl_outline_triangles walk = { outline->walk_first[w + 1] - outline->walk_first[w] - 2,
                                      triangles->corners + 3 * (size_t)first, NULL, NULL, 0 };
        walk.twins = TL_PUSH(arena, uint32_t, 3 * (uint64_t)walk.count);
        if (walk.twins == NULL) {
            return TL_ERR_MEMORY;
        }
        for (uint32_t edge = 0; edge < 3 * walk.count; edge++) {
            uint32_t twin = triangles->twins[3 * (size_t)first + edge];
            walk.twins[edge] = twin != TL_NO_EDGE ? twin - 3 * first : TL_NO_EDGE;
        }
        bool walk_is_exact;
        TL_TRY(solve_walk(arena, outline->nodes.points, &walk, max_corners, f, &walk_is_exact));
        *is_exact &= walk_is_exact;
        first += walk.count;
        tl_arena_rollback(arena, mark);
    }
    return TL_OK;
}

static tl_result merge_and_compare(tl_arena *arena, const tl_merge_input *input, tl_convex_parts *best)
{
    tl_convex_parts parts;
    TL_TRY(tl_merge_triangles(arena, input, &parts));
    *best = parts.count < best->count ? parts : *best;
    return TL_OK;
}

tl_result tl_divide_optimally(tl_arena *arena, const tl_outline *outline, uint32_t max_corners,
                              tl_outline_triangles *triangles, tl_convex_parts *parts_out, bool *is_exact)
{
    const tl_lattice_point *points = outline->nodes.points;
    if (outline->is_plain) {
        const tl_triangulated_outline view = { points, outline->nodes.count, triangles->corners, triangles->twins };
        TL_TRY(solve_exactly(arena, &view, max_corners, parts_out, is_exact));
        if (*is_exact) {
            return TL_OK;
        }
    }
    tl_fans f;
    TL_TRY(solve_walks(arena, outline, max_corners, triangles, &f, is_exact));
    uint32_t edges = 3 * triangles->count;
    uint32_t pairs = 0;
    TL_TRY(tl_pair_edges(arena, f.corners, f.twins, edges, &pairs));
    TL_TRY(tl_pair_edges(arena, triangles->corners, triangles->twins, edges, &triangles->bridge_count));
    *is_exact &= triangles->bridge_count == 0;
    parts_out->count = UINT32_MAX;
    const tl_merge_input pieces = { points, f.corners, f.twins, f.count, max_corners, f.joined, NULL, NULL };
    TL_TRY(merge_and_compare(arena, &pieces, parts_out));
    if (*is_exact) {
        return TL_OK;
    }
    const tl_merge_input plain = {
        points, triangles->corners, triangles->twins, triangles->count, max_corners, NULL, NULL, NULL
    };
    TL_TRY(merge_and_compare(arena, &plain, parts_out));
    TL_TRY(tl_make_delaunay(arena, points, triangles->corners, triangles->twins, triangles->count));
    return merge_and_compare(arena, &plain, parts_out);
}
