// SPDX-License-Identifier: MIT
//
// Pairing: each task matches the triangles of one chunk (pair_match.c), which lie near each other in most meshes, and
// so does their memory. The triangles left single are matched once more, across the borders of chunks. Where borders
// turn out to be everywhere, because the mesh is in no order, all triangles are matched at once: on a mesh larger than
// the caches that takes twice as long, and one thread. Chunks depend on the mesh alone, so the pairs do not depend on
// the number of tasks.
//
// The article's pair A B C, A C D is stored with the order in which each triangle really runs.
//
// Source: Christer Ericson, "Chunky triangle soup", 2009.

#include "base/assert.h"
#include "base/host.h"
#include "soup/bake/pair_match.h"
#include "soup/bake/soup_bake.h"
#include "soup/layout/soup_layout.h"

#include <string.h>

// Rows 1 to 6 are the six orders of three slots; rows 0 and 7 keep any three bits in range.
const uint8_t tl_soup_corner_slots[8][3] = { { 0, 1, 2 }, { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 },
                                             { 0, 2, 1 }, { 2, 1, 0 }, { 1, 0, 2 }, { 0, 1, 2 } };

// The largest chunk, in triangles: its arrays take about 400 KB, and a mesh of a few thousand has work for two threads.
enum { CHUNK_TRIANGLES = 1 << 12 };

// A mesh is in no order when more than 1 / BORDER_SHARE of it is paired across borders.
enum { BORDER_SHARE = 16 };

typedef struct pairing {
    const tl_mesh *mesh;
    tl_stage *stage;
    tl_arena *scratch;
    uint32_t chunk_count, chunk_size;
    tl_triangle_pair *pairs;
    uint32_t *mates;            // of triangles, as tl_pair_match has them
    uint32_t *ends;             // of chunks: pairs up to its end
    tl_pair_matcher **matchers; // of workers
} pairing;

// Chunks of nearly equal size.
static void lay_chunks(pairing *p)
{
    uint32_t count = p->mesh->triangle_count;
    p->chunk_size = tl_block_count(count, tl_block_count(count, CHUNK_TRIANGLES));
    p->chunk_count = tl_block_count(count, p->chunk_size);
}

static uint32_t chunk_end(const pairing *p, uint32_t chunk)
{
    return tl_block_end(chunk, p->chunk_size, p->mesh->triangle_count);
}

static void match_chunk(uint32_t chunk, uint32_t worker, void *user)
{
    const pairing *p = user;
    uint32_t first = chunk * p->chunk_size;
    (void)tl_pair_match(p->matchers[worker], NULL, NULL, first, chunk_end(p, chunk) - first, p->mates);
}

static tl_result match_chunks(pairing *p)
{
    uint32_t workers = tl_worker_count(p->stage != NULL ? p->stage->host : NULL);
    tl_arena_mark mark = tl_arena_get_mark(p->scratch);
    p->matchers = TL_PUSH(p->scratch, tl_pair_matcher *, workers);
    if (p->matchers == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < workers; i++) {
        p->matchers[i] = tl_pair_matcher_make(p->mesh, p->chunk_size, p->scratch);
        if (p->matchers[i] == NULL) {
            return TL_ERR_MEMORY;
        }
    }
    TL_TRY(tl_stage_run(p->stage, match_chunk, p->chunk_count, p, 2, p->mesh->triangle_count / 2));
    tl_arena_rollback(p->scratch, mark);
    return TL_OK;
}

static uint32_t count_free(const pairing *p)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < p->mesh->triangle_count; i++) {
        count += p->mates[i] == TL_NO_MATE;
    }
    return count;
}

// Matches the triangles that the chunks left free.
static tl_result match_rest(pairing *p, uint32_t count)
{
    tl_arena_mark mark = tl_arena_get_mark(p->scratch);
    uint32_t *list = TL_PUSH(p->scratch, uint32_t, count);
    tl_pair_matcher *matcher = tl_pair_matcher_make(p->mesh, count, p->scratch);
    if (list == NULL || matcher == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t rest = 0;
    for (uint32_t i = 0; i < p->mesh->triangle_count; i++) {
        if (p->mates[i] == TL_NO_MATE) {
            list[rest++] = i;
        }
    }
    TL_TRY(tl_pair_match(matcher, p->stage, list, 0, count, p->mates));
    tl_arena_rollback(p->scratch, mark);
    return TL_OK;
}

static tl_result match_at_once(pairing *p)
{
    tl_arena_mark mark = tl_arena_get_mark(p->scratch);
    tl_pair_matcher *matcher = tl_pair_matcher_make(p->mesh, p->mesh->triangle_count, p->scratch);
    if (matcher == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_pair_match(matcher, p->stage, NULL, 0, p->mesh->triangle_count, p->mates));
    tl_arena_rollback(p->scratch, mark);
    return TL_OK;
}

static tl_result match_mesh(pairing *p)
{
    if (p->chunk_count == 1) {
        return match_at_once(p);
    }
    TL_TRY(match_chunks(p));
    uint32_t count = count_free(p);
    TL_TRY(tl_stage_add(p->stage, 0));
    TL_TRY(match_rest(p, count));
    uint32_t over_borders = count - count_free(p);
    return over_borders > p->mesh->triangle_count / BORDER_SHARE ? match_at_once(p) : TL_OK;
}

uint32_t tl_corner_order(const uint32_t *corners, uint32_t a, uint32_t e, uint32_t c)
{
    // By the slot of the first corner, and whether the second lies in the slot behind it.
    static const uint8_t rows[3][2] = { { 4, 1 }, { 6, 2 }, { 5, 3 } };
    const uint32_t slot[4] = { a, e, c, a };
    const uint32_t first = corners[0] == a ? 0 : corners[0] == e ? 1 : 2;
    const uint32_t row = rows[first][corners[1] == slot[first + 1]];
    TL_ASSERT(slot[tl_soup_corner_slots[row][0]] == corners[0] && slot[tl_soup_corner_slots[row][1]] == corners[1] &&
              slot[tl_soup_corner_slots[row][2]] == corners[2]);
    return row;
}

static tl_triangle_pair make_single(const tl_mesh *mesh, uint32_t triangle)
{
    const uint32_t *v = mesh->indices + 3 * (size_t)triangle;
    tl_triangle_pair pair = { { v[0], v[1], v[2], v[0] }, { mesh->source_triangles[triangle] | 1u << 29, TL_ID_NONE } };
    return pair;
}

// The shared edge runs from c to a in the first triangle: it is a, b, c from the corner after the edge's first on.
static tl_triangle_pair make_pair(const tl_mesh *mesh, uint32_t edge, uint32_t other_edge)
{
    const uint32_t triangles[2] = { edge / 3, other_edge / 3 };
    const uint32_t *v = mesh->indices + 3 * (size_t)triangles[0];
    const uint32_t *w = mesh->indices + 3 * (size_t)triangles[1];
    uint32_t k = edge % 3;
    uint32_t c = v[k];
    uint32_t a = v[(k + 1) % 3];
    uint32_t b = v[(k + 2) % 3];
    uint32_t d = w[(other_edge + 2) % 3];
    tl_triangle_pair pair = { { a, b, c, d },
                              { mesh->source_triangles[triangles[0]] | tl_corner_order(v, a, b, c) << 29,
                                mesh->source_triangles[triangles[1]] | tl_corner_order(w, a, d, c) << 29 } };
    return pair;
}

// A pair belongs to the earlier of its triangles.
static bool begins_pair(const pairing *p, uint32_t triangle)
{
    return p->mates[triangle] == TL_NO_MATE || p->mates[triangle] / 3 > triangle;
}

static void count_pairs(uint32_t chunk, uint32_t worker, void *user)
{
    (void)worker;
    const pairing *p = user;
    uint32_t count = 0, end = chunk_end(p, chunk);
    for (uint32_t i = chunk * p->chunk_size; i < end; i++) {
        count += begins_pair(p, i);
    }
    p->ends[chunk] = count;
}

static void write_pairs(uint32_t chunk, uint32_t worker, void *user)
{
    (void)worker;
    const pairing *p = user;
    tl_triangle_pair *next = p->pairs + (chunk > 0 ? p->ends[chunk - 1] : 0);
    uint32_t end = chunk_end(p, chunk);
    for (uint32_t i = chunk * p->chunk_size; i < end; i++) {
        if (begins_pair(p, i)) {
            uint32_t mate = p->mates[i];
            *next++ = mate == TL_NO_MATE ? make_single(p->mesh, i) : make_pair(p->mesh, p->mates[mate / 3], mate);
        }
    }
}

static tl_result pair_mesh(pairing *p, bool allow_pairs, tl_arena *arena, uint32_t *pair_count_out)
{
    const uint32_t triangles = p->mesh->triangle_count;
    p->mates = TL_PUSH(p->scratch, uint32_t, triangles);
    p->ends = TL_PUSH(p->scratch, uint32_t, p->chunk_count);
    if (p->mates == NULL || p->ends == NULL) {
        return TL_ERR_MEMORY;
    }
    if (allow_pairs) {
        TL_TRY(match_mesh(p));
    } else {
        memset(p->mates, 0xff, (size_t)triangles * sizeof *p->mates);
    }
    TL_TRY(tl_stage_run(p->stage, count_pairs, p->chunk_count, p, 32, 0));
    for (uint32_t i = 1; i < p->chunk_count; i++) {
        p->ends[i] += p->ends[i - 1];
    }
    *pair_count_out = p->ends[p->chunk_count - 1];
    p->pairs = TL_PUSH(arena, tl_triangle_pair, *pair_count_out);
    return p->pairs != NULL ? tl_stage_run(p->stage, write_pairs, p->chunk_count, p, 32, triangles / 4) : TL_ERR_MEMORY;
}

tl_result tl_pair_triangles(const tl_mesh *mesh, bool allow_pairs, tl_stage *stage, tl_arena *arena,
                            tl_triangle_pair **pairs_out, uint32_t *pair_count_out)
{
    tl_arena scratch;
    tl_arena_init(&scratch, &arena->allocator);
    pairing p = { .mesh = mesh, .stage = stage, .scratch = &scratch };
    lay_chunks(&p);
    tl_result result = pair_mesh(&p, allow_pairs, arena, pair_count_out);
    *pairs_out = p.pairs;
    tl_arena_free(&scratch);
    return result;
}
