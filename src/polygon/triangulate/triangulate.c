// SPDX-License-Identifier: MIT
//
// Triangulation by ear clipping: of all ears, corners whose two neighbours can be joined inside the outline, cut off
// the one with the shortest new edge (the partition edge), until none is left. Source: "Convex Polygon Generation",
// Critterai Navigation Mesh Generation documentation, section Triangulation. The valid-partition test: O'Rourke,
// Computational Geometry in C, section 1.5.
//
// The plain form tests every corner against every edge before each cut, O(n^3). Here each corner is tested once and
// again only when a cut moves one of its neighbours, because validity does not change in between: what remains of the
// floor only shrinks, so a partition edge that left it still leaves it, and two corners that are both valid and not
// neighbours cut off disjoint triangles. So there are at most 3n partitions. Those that pass the cheap half of the test
// wait in a queue, and have the other half when their turn comes, for which many never live.
//
// A partition edge is valid when it lies in the interior angle at both ends (the internal angle test) and the triangle
// it cuts off holds no other vertex (the edge intersection test): the part of the outline that would intrude has a
// vertex in the triangle, and its foremost one is reflex or straight. Of a small outline such vertices are kept in a
// list. Of a large one a triangulation is kept, whose triangles around the corner tell; both give the same answers. All
// is exact; ties go to the lowest vertex before the corner.

#include "polygon/triangulate/triangulate.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "polygon/triangulate/ear_list.h"
#include "polygon/triangulate/ear_mesh.h"
#include "polygon/triangulate/partition_queue.h"

#include <string.h>

// From so many points on the mesh is the faster one.
enum { SMALLEST_MESH = 128, CUTS_AHEAD = 8 };

typedef struct triangulation {
    const tl_lattice_point *points;
    tl_ear_vertex *vertices;
    uint32_t count;
    bool has_mesh;    // in the vertices, of large outlines
    tl_ear_list list; // of small ones
    tl_partition_queue queue;
} triangulation;

// The partition that cuts off corner b. False: it fails the internal angle test. No branch depends on the angles, which
// nobody can predict.
static TL_ALWAYS_INLINE bool find_partition(const triangulation *t, uint32_t b, tl_partition *found)
{
    const tl_ear_vertex *corner = &t->vertices[b];
    const tl_ear_vertex *before = &t->vertices[corner->previous], *after = &t->vertices[corner->next];
    const tl_lattice_point a = before->position, c = after->position;
    found->key = (uint64_t)tl_distance2(a, c);
    found->value = corner->previous;
    found->extra = corner->next;
    // Angles only shrink in an outline; in a scribble a convex corner may turn reflex.
    const int is_ear = !corner->is_reflex & (tl_turn(a, corner->position, c) > 0);
    // b is convex, so one half of the internal angle test holds already, and at a reflex end that is enough.
    const int leaves_a = before->is_reflex | (tl_turn(a, c, t->vertices[before->previous].position) > 0);
    const int leaves_c = after->is_reflex | (tl_turn(c, t->vertices[after->next].position, a) > 0);
    return (is_ear & leaves_a & leaves_c) != 0;
}

static void consider_partition(triangulation *t, uint32_t b)
{
    tl_partition item;
    const bool is_found = find_partition(t, b, &item);
    if (!t->has_mesh) {
        t->list.lengths2[t->vertices[b].previous] = is_found ? item.key : TL_NO_PARTITION;
    } else if (is_found) {
        tl_partition_queue_push(&t->queue, item);
    }
}

// A corner whose angle a cut has made smaller.
static void update_angle(triangulation *t, uint32_t b)
{
    tl_ear_vertex *v = &t->vertices[b];
    if (v->is_reflex && tl_turn(t->vertices[v->previous].position, v->position, t->vertices[v->next].position) > 0) {
        v->is_reflex = false;
        if (!t->has_mesh) {
            tl_ear_list_remove_reflex(&t->list, v->position);
        }
    }
}

// A partition is stale as soon as one of its ends, or the corner between them, is cut off. A vertex that was cut off
// keeps its neighbours' numbers, but they no longer name it. And since vertices only go, the one between the ends is
// still the one that was tested.
static bool is_current(const triangulation *t, const tl_partition *item)
{
    const tl_ear_vertex *b = &t->vertices[t->vertices[item->value].next];
    return b->previous == item->value && b->next == item->extra;
}

// The edge intersection test.
static bool is_free_partition(const triangulation *t, const tl_partition *item)
{
    const tl_ear_vertex *a = &t->vertices[item->value];
    if (t->has_mesh) {
        return tl_ear_mesh_is_free(t->vertices, item->value, a->next, a->position, t->vertices[item->extra].position);
    }
    return tl_ear_list_is_free(&t->list, a->position, t->vertices[a->next].position, t->vertices[item->extra].position);
}

// What a cut from a to c needs, in steps, each of which reads what the one before has fetched: both ends; the corner
// between them and the vertices before and after; the next ones on both sides, and the triangle that the fan begins
// with.
static TL_ALWAYS_INLINE void fetch_ends(const tl_ear_vertex *vertices, const tl_partition *item)
{
    tl_prefetch(&vertices[item->value]);
    tl_prefetch(&vertices[item->extra]);
}

static TL_ALWAYS_INLINE void fetch_beside(const tl_ear_vertex *vertices, const tl_partition *item)
{
    tl_prefetch(&vertices[vertices[item->value].next]);
    tl_prefetch(&vertices[vertices[item->value].previous]);
    tl_prefetch(&vertices[vertices[item->extra].next]);
}

static TL_ALWAYS_INLINE void fetch_around(const tl_ear_vertex *vertices, const tl_partition *item)
{
    const tl_ear_vertex *a = &vertices[item->value], *c = &vertices[item->extra];
    tl_prefetch(&vertices[vertices[a->previous].previous]);
    tl_prefetch(&vertices[vertices[c->next].next]);
    tl_prefetch(&vertices[vertices[a->next].outer >> 2]);
}

static TL_ALWAYS_INLINE void fetch_fan(const tl_ear_vertex *vertices, const tl_partition *item)
{
    const uint32_t back = tl_ear_edge_previous(vertices[vertices[item->value].next].outer);
    tl_prefetch(&vertices[tl_ear_edge_origin(vertices, back)]);
    const uint32_t twin = tl_ear_edge_twin(vertices, back);
    tl_prefetch(&vertices[twin != TL_NO_EAR_EDGE ? twin >> 2 : item->value]);
}

// Corners are cut off in no order of place. Those of the sorted list are known long before their turn, the next ones of
// the heap are likely to be on top of it: what they need is fetched meanwhile.
static TL_ALWAYS_INLINE void fetch_cuts_ahead(const triangulation *t)
{
    const tl_partition_queue *queue = &t->queue;
    if (queue->sorted_count > 3 * CUTS_AHEAD) {
        fetch_ends(t->vertices, &queue->sorted[3 * CUTS_AHEAD]);
        fetch_beside(t->vertices, &queue->sorted[2 * CUTS_AHEAD]);
        fetch_around(t->vertices, &queue->sorted[CUTS_AHEAD]);
        fetch_fan(t->vertices, &queue->sorted[CUTS_AHEAD / 2]);
    }
    for (uint32_t i = 1; i < 5 && i < queue->heap_count; i++) {
        fetch_ends(t->vertices, &queue->heap[i]);
    }
    if (queue->heap_count > 0) {
        fetch_beside(t->vertices, &queue->heap[0]);
        fetch_around(t->vertices, &queue->heap[0]);
    }
}

// The shortest partition that is valid. False: there is none.
static bool choose_from_list(triangulation *t, tl_partition *chosen)
{
    for (;;) {
        const uint32_t a = tl_ear_list_shortest(&t->list);
        if (t->list.lengths2[a] == TL_NO_PARTITION) {
            return false;
        }
        chosen->value = a;
        chosen->extra = t->vertices[t->vertices[a].next].next;
        t->list.lengths2[a] = TL_NO_PARTITION;
        if (is_free_partition(t, chosen)) {
            return true;
        }
    }
}

static bool choose_from_queue(triangulation *t, tl_partition *chosen)
{
    do {
        if (!tl_partition_queue_pop(&t->queue, chosen)) {
            return false;
        }
        fetch_cuts_ahead(t);
    } while (!is_current(t, chosen) || !is_free_partition(t, chosen));
    return true;
}

static bool is_left_turn(const triangulation *t, uint32_t b)
{
    return t->vertices[t->vertices[b].previous].next == b && t->vertices[t->vertices[b].next].previous == b;
}

static tl_result start_list(triangulation *t, tl_arena *scratch, uint32_t count)
{
    if (!tl_ear_list_init(&t->list, scratch, count)) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        tl_partition item;
        t->list.lengths2[t->vertices[i].previous] = find_partition(t, i, &item) ? item.key : TL_NO_PARTITION;
        if (t->vertices[i].is_reflex) {
            tl_ear_list_add_reflex(&t->list, t->vertices[i].position);
        }
    }
    return TL_OK;
}

static tl_result start_mesh(triangulation *t, tl_arena *scratch, const tl_triangulate_input *input)
{
    TL_TRY(tl_ear_mesh_init(t->vertices, input->count, scratch, input->points, input->sweep));
    tl_partition_queue *queue = &t->queue;
    if (!tl_partition_queue_init(queue, scratch, input->count)) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t a = 0; a < input->count && input->count > 3; a++) {
        queue->sorted_count += find_partition(t, a + 1 < input->count ? a + 1 : 0, &queue->sorted[queue->sorted_count]);
    }
    tl_partition_queue_sort(queue);
    return TL_OK;
}

static tl_result start_triangulation(triangulation *t, tl_arena *scratch, const tl_triangulate_input *input)
{
    const tl_lattice_point *points = input->points;
    const uint32_t count = input->count;
    t->points = points;
    t->count = count;
    t->vertices = TL_PUSH(scratch, tl_ear_vertex, count);
    if (t->vertices == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t before = i > 0 ? i - 1 : count - 1, after = i + 1 < count ? i + 1 : 0;
        tl_ear_vertex *v = &t->vertices[i];
        v->position = points[i];
        v->previous = before;
        v->next = after;
        v->across = v->cut = TL_NO_EAR_VERTEX;
        v->is_reflex = tl_turn(points[before], points[i], points[after]) <= 0;
    }
    // Those who watch get the partitions in the queue's order.
    t->has_mesh = input->ear_test == TL_EARS_BY_SIZE ? input->count >= SMALLEST_MESH || input->tracer != NULL
                                                     : input->ear_test == TL_EARS_BY_MESH;
    return t->has_mesh ? start_mesh(t, scratch, input) : start_list(t, scratch, count);
}

static void add_potential(const triangulation *t, const tl_partition *items, uint32_t count, uint32_t *partitions,
                          uint32_t *partition_count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (is_current(t, &items[i]) && is_free_partition(t, &items[i])) {
            partitions[2 * *partition_count] = items[i].value;
            partitions[2 * (*partition_count)++ + 1] = items[i].extra;
        }
    }
}

// Hands out a cut with the partitions that could have been chosen instead: the current and free ones that wait.
static tl_result trace_cut(const triangulation *t, tl_arena *scratch, const tl_step_tracer *tracer, uint32_t left,
                           const uint32_t corners[3])
{
    tl_arena_mark mark = tl_arena_get_mark(scratch);
    uint32_t *outline = TL_PUSH(scratch, uint32_t, left);
    const uint64_t waiting = (uint64_t)t->queue.sorted_count + t->queue.heap_count;
    uint32_t *partitions = TL_PUSH(scratch, uint32_t, 2 * (waiting + 1));
    if (outline == NULL || partitions == NULL) {
        return TL_ERR_MEMORY;
    }
    outline[0] = corners[0];
    for (uint32_t i = 1; i < left; i++) {
        outline[i] = t->vertices[outline[i - 1]].next;
    }
    tl_traced_step step = { TL_POLYGON_STEP_CUT, partitions, 0, outline, left, corners, 3 };
    if (left > 3) {
        partitions[0] = corners[0];
        partitions[1] = corners[2];
        step.partition_count = 1;
        add_potential(t, t->queue.sorted, t->queue.sorted_count, partitions, &step.partition_count);
        add_potential(t, t->queue.heap, t->queue.heap_count, partitions, &step.partition_count);
    }
    TL_TRY(tl_trace_step(tracer, scratch, t->points, &step));
    tl_arena_rollback(scratch, mark);
    return TL_OK;
}

// Cuts corner b off and joins its neighbours.
static void cut_ear(triangulation *t, uint32_t b, uint32_t number)
{
    tl_ear_vertex *ear = &t->vertices[b], *a = &t->vertices[ear->previous], *c = &t->vertices[ear->next];
    if (t->has_mesh) {
        tl_ear_mesh_cut(t->vertices, ear->previous, b);
    } else {
        t->list.lengths2[b] = TL_NO_PARTITION;
    }
    ear->cut = number;
    ear->across_before = a->across;
    a->across = b;
    a->next = ear->next;
    c->previous = ear->previous;
}

// Cuts off all but the last triangle, of which the middle vertex is handed out.
static tl_result cut_ears(triangulation *t, tl_arena *scratch, const tl_step_tracer *tracer, uint32_t *last_out)
{
    for (uint32_t left = t->count; left > 3; left--) {
        tl_partition chosen;
        if (!(t->has_mesh ? choose_from_queue(t, &chosen) : choose_from_list(t, &chosen))) {
            return TL_ERR_SELF_INTERSECTION;
        }
        const uint32_t a = chosen.value, c = chosen.extra;
        const uint32_t corners[3] = { a, t->vertices[a].next, c };
        if (tracer != NULL) {
            TL_TRY(trace_cut(t, scratch, tracer, left, corners));
        }
        cut_ear(t, corners[1], t->count - left);
        update_angle(t, a);
        update_angle(t, c);
        if (left > 4) {
            consider_partition(t, a);
            consider_partition(t, c);
        }
    }
    // The last triangle begins at its lowest vertex.
    uint32_t corners[3] = { 0, 0, 0 };
    while (!is_left_turn(t, corners[0])) {
        corners[0]++;
    }
    corners[1] = t->vertices[corners[0]].next;
    corners[2] = t->vertices[corners[1]].next;
    if (tl_turn(t->points[corners[0]], t->points[corners[1]], t->points[corners[2]]) <= 0) {
        return TL_ERR_SELF_INTERSECTION;
    }
    t->vertices[corners[1]].cut = t->count - 3;
    t->vertices[corners[1]].across_before = t->vertices[corners[0]].across;
    *last_out = corners[1];
    return tracer != NULL ? trace_cut(t, scratch, tracer, 3, corners) : TL_OK;
}

// Where the triangle of an ear is written: by the number of its cut, or by its corner. Two vertices, the first and the
// last one of the last triangle, are no ear's corner.
static uint32_t triangle_of(const triangulation *t, uint32_t b, const uint32_t *places_out, const uint32_t uncut[2])
{
    return places_out == NULL ? t->vertices[b].cut : b - (b > uncut[0]) - (b > uncut[1]);
}

static void write_triangles(const triangulation *t, uint32_t last, const tl_triangulate_input *input,
                            uint32_t *triangles_out, uint32_t *twins_out)
{
    uint32_t *places_out = input->places_out;
    const uint32_t uncut[2] = { t->vertices[last].previous, t->vertices[last].next };
    memset(twins_out, 0xff, 3 * ((size_t)t->count - 2) * sizeof *twins_out);
    for (uint32_t b = 0; b < t->count; b++) {
        const tl_ear_vertex *ear = &t->vertices[b];
        if (ear->cut == TL_NO_EAR_VERTEX) {
            continue;
        }
        const uint32_t triangle = triangle_of(t, b, places_out, uncut);
        triangles_out[3 * triangle] = ear->previous;
        triangles_out[3 * triangle + 1] = b;
        triangles_out[3 * triangle + 2] = ear->next;
        if (places_out != NULL) {
            places_out[triangle] = ear->cut;
        }
        const uint32_t across[3] = { ear->across_before, ear->across,
                                     b == last ? t->vertices[uncut[1]].across : TL_NO_EAR_VERTEX };
        for (uint32_t k = 0; k < 3; k++) {
            if (across[k] != TL_NO_EAR_VERTEX) {
                const uint32_t twin = 3 * triangle_of(t, across[k], places_out, uncut) + 2;
                twins_out[3 * triangle + k] = twin;
                twins_out[twin] = 3 * triangle + k;
            }
        }
    }
}

tl_result tl_triangulate(tl_arena *scratch, const tl_triangulate_input *input, uint32_t *triangles_out,
                         uint32_t *twins_out)
{
    const tl_arena_mark mark = tl_arena_get_mark(scratch);
    triangulation t;
    uint32_t last = 0;
    TL_TRY(start_triangulation(&t, scratch, input));
    TL_TRY(cut_ears(&t, scratch, input->tracer, &last));
    write_triangles(&t, last, input, triangles_out, twins_out);
    tl_arena_rollback(scratch, mark);
    return TL_OK;
}
