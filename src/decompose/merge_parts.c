// SPDX-License-Identifier: MIT
//
// Merging parts whose common hull keeps the tolerance, the pair first whose hull adds the least volume.
//
// Planes cut all of a part, so they cut what needed no cut; merging mends that. Every pair is judged by the proof that
// parts are judged by, so a merged part keeps the tolerance as all others do. Only pairs whose boxes come closer than
// twice the tolerance are tried: between others lies a point that is too far from both.
//
// Source: Mamou, V-HACD, 2016, which merges by volume until there are few enough; here the tolerance decides.

#include "base/assert.h"
#include "base/min_max.h"
#include "decompose/decomposer.h"

#include <math.h>
#include <string.h>

typedef struct merge_pair {
    uint32_t a, b; // parts, a < b
    double added;  // cubic metres that the common hull has more than both
    double concavity;
    tl_hull *hull; // of both; NULL: the pair does not keep the tolerance
    tl_result result;
} merge_pair;

// The heap's items: pairs stay where they are.
typedef struct merge_item {
    double added;
    uint32_t pair;
} merge_item;

static inline bool merges_before(merge_item a, merge_item b)
{
    return a.added != b.added ? a.added < b.added : a.pair < b.pair;
}

#define TL_HEAP(name)                 merge_queue_##name
#define TL_HEAP_ITEM                  merge_item
#define TL_HEAP_BEFORE(context, a, b) merges_before((a), (b))
#include "base/heap.inl"

typedef struct part_merger {
    tl_decomposer *d;
    merge_pair *pairs;
    uint64_t pair_count, pair_capacity;
    uint32_t first_new; // pair that is not judged yet
    merge_item *queue;
    uint32_t queue_count;
    uint64_t queue_capacity;
    uint32_t live; // parts
    bool ignores_tolerance;
} part_merger;

static bool is_live(const part_merger *m, uint32_t part)
{
    return m->d->parts[part].hull != NULL;
}

static bool boxes_are_near(const tl_hull *a, const tl_hull *b, double distance)
{
    const float *low_a = &a->bounds.min.x, *high_a = &a->bounds.max.x;
    const float *low_b = &b->bounds.min.x, *high_b = &b->bounds.max.x;
    double sum = 0.0;
    for (uint32_t axis = 0; axis < 3; axis++) {
        const double gap =
            tl_max_f64((double)low_a[axis] - (double)high_b[axis], (double)low_b[axis] - (double)high_a[axis]);
        sum += gap > 0.0 ? gap * gap : 0.0;
    }
    return sum <= distance * distance;
}

static tl_result common_hull(const tl_decomposer *d, const tl_hull *a, const tl_hull *b, tl_hull **hull_out)
{
    const uint32_t count = a->vertex_count + b->vertex_count;
    tl_vec3 *points = tl_allocate_array(d->allocator, count, sizeof *points);
    if (points == NULL) {
        return TL_ERR_MEMORY;
    }
    memcpy(points, tl_hull_vertices(a), a->vertex_count * sizeof *points);
    memcpy(points + a->vertex_count, tl_hull_vertices(b), b->vertex_count * sizeof *points);
    const tl_result result = tl_decomposer_bake_hull(d, points, count, hull_out);
    tl_release_array(d->allocator, points, count, sizeof *points);
    return result;
}

// Judges a pair. Its hull stays where the pair may be merged.
static void judge_pair(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const part_merger *m = user;
    merge_pair *pair = &m->pairs[m->first_new + index];
    const tl_hull *a = m->d->parts[pair->a].hull, *b = m->d->parts[pair->b].hull;
    bool holds = false;
    pair->result = common_hull(m->d, a, b, &pair->hull);
    if (pair->result == TL_OK) {
        pair->added = pair->hull->mass.volume - a->mass.volume - b->mass.volume;
        pair->result = tl_decomposer_judge(m->d, pair->hull, &holds, &pair->concavity);
    }
    if (!holds && !(m->ignores_tolerance && pair->result == TL_OK)) {
        tl_blob_free(pair->hull);
        pair->hull = NULL;
    }
}

static tl_result add_merge_pair(part_merger *m, uint32_t a, uint32_t b)
{
    if (m->pair_count == m->pair_capacity) {
        merge_pair *grown = tl_grow_array(m->d->allocator, m->pairs, &m->pair_capacity, sizeof *grown);
        if (grown == NULL || m->pair_capacity > UINT32_MAX) {
            return TL_ERR_MEMORY;
        }
        m->pairs = grown;
    }
    const merge_pair pair = { a, b, 0.0, 0.0, NULL, TL_OK };
    m->pairs[m->pair_count++] = pair;
    return TL_OK;
}

// Pairs of a part with those before it.
static tl_result pair_with_earlier(part_merger *m, uint32_t part, double near)
{
    const tl_hull *hull = m->d->parts[part].hull;
    for (uint32_t i = 0; i < part; i++) {
        if (is_live(m, i) && boxes_are_near(m->d->parts[i].hull, hull, near)) {
            TL_TRY(add_merge_pair(m, i, part));
        }
    }
    return TL_OK;
}

static tl_result queue_pair(part_merger *m, uint32_t pair)
{
    if (m->queue_count == m->queue_capacity) {
        merge_item *grown = tl_grow_array(m->d->allocator, m->queue, &m->queue_capacity, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        m->queue = grown;
    }
    const merge_item item = { m->ignores_tolerance ? m->pairs[pair].concavity : m->pairs[pair].added, pair };
    merge_queue_push(m->queue, &m->queue_count, item, NULL);
    return TL_OK;
}

// Judges the pairs that were added, and queues those that may be merged.
static tl_result judge_new_pairs(part_merger *m, tl_stage *stage)
{
    const uint32_t count = (uint32_t)m->pair_count - m->first_new;
    TL_TRY(tl_stage_run(stage, judge_pair, count, m, 4, 0));
    for (uint32_t i = 0; i < count; i++) {
        TL_TRY(m->pairs[m->first_new + i].result);
        if (m->pairs[m->first_new + i].hull != NULL) {
            TL_TRY(queue_pair(m, m->first_new + i));
        }
    }
    m->first_new = (uint32_t)m->pair_count;
    return TL_OK;
}

// Makes one part of a pair's two, behind all others. The pair gives its hull away.
static tl_result merge_two(part_merger *m, merge_pair *pair)
{
    tl_decomposer *d = m->d;
    tl_part merged;
    memset(&merged, 0, sizeof merged);
    const uint32_t cuts_a = d->parts[pair->a].cut_count, cuts_b = d->parts[pair->b].cut_count;
    merged.cut_count = cuts_a > cuts_b ? cuts_a : cuts_b;
    merged.hull = pair->hull;
    merged.concavity = pair->concavity;
    merged.is_whole = pair->concavity <= d->tolerance;
    TL_TRY(tl_decomposer_add(d, &merged));
    pair->hull = NULL;
    tl_part_free(&d->parts[pair->a], d->allocator);
    tl_part_free(&d->parts[pair->b], d->allocator);
    m->live--;
    return TL_OK;
}

// Merges queued pairs and pairs the merged ones anew, until none is left or few enough parts are.
static tl_result merge_queued(part_merger *m, double near, tl_stage *stage)
{
    while (m->queue_count > 0 && !(m->ignores_tolerance && m->live <= m->d->def->max_parts)) {
        merge_pair *pair = &m->pairs[merge_queue_pop(m->queue, &m->queue_count, NULL).pair];
        if (is_live(m, pair->a) && is_live(m, pair->b)) {
            TL_TRY(merge_two(m, pair));
            TL_TRY(pair_with_earlier(m, m->d->part_count - 1, near)); // pairs may move
            TL_TRY(judge_new_pairs(m, stage));
            TL_TRY(tl_stage_add(stage, 1));
        } else {
            tl_blob_free(pair->hull);
            pair->hull = NULL;
        }
    }
    return TL_OK;
}

static void forget_pairs(part_merger *m)
{
    for (uint64_t i = 0; i < m->pair_count; i++) {
        tl_blob_free(m->pairs[i].hull);
    }
    m->pair_count = 0;
    m->first_new = 0;
    m->queue_count = 0;
}

static void drop_merged(tl_decomposer *d)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < d->part_count; i++) {
        if (d->parts[i].hull != NULL) {
            d->parts[kept++] = d->parts[i];
        }
    }
    d->part_count = kept;
}

static tl_result merge_near(part_merger *m, double near, tl_stage *stage)
{
    forget_pairs(m);
    drop_merged(m->d);
    m->live = m->d->part_count;
    for (uint32_t i = 1; i < m->d->part_count; i++) {
        TL_TRY(pair_with_earlier(m, i, near));
    }
    TL_TRY(judge_new_pairs(m, stage));
    return merge_queued(m, near, stage);
}

// Within the tolerance, then beyond it: pairs that are near each other, then any.
static tl_result merge_all(part_merger *m, tl_stage *stage)
{
    const uint32_t max_parts = m->d->def->max_parts;
    double near = 2.0 * m->d->tolerance + 2.0 * m->d->grid.noise;
    TL_TRY(merge_near(m, near, stage));
    m->ignores_tolerance = true;
    for (; max_parts != 0 && m->live > max_parts; near *= 4.0) {
        TL_TRY(merge_near(m, near, stage));
    }
    return TL_OK;
}

tl_result tl_decomposer_merge(tl_decomposer *d)
{
    tl_stage stage;
    d->report->base.stage = "merging";
    TL_TRY(tl_stage_begin(&stage, &d->def->host, "merging", d->part_count));
    part_merger m;
    memset(&m, 0, sizeof m);
    m.d = d;
    tl_result result = merge_all(&m, &stage);
    forget_pairs(&m);
    drop_merged(d);
    tl_release_array(d->allocator, m.queue, m.queue_capacity, sizeof *m.queue);
    tl_release_array(d->allocator, m.pairs, m.pair_capacity, sizeof *m.pairs);
    return result == TL_OK ? tl_stage_end(&stage) : result;
}
