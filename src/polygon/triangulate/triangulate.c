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
// vertex in the triangle, and its foremost one is reflex or straight. Of a small outline only such vertices are kept,
// in a k-d tree, which is a plain loop for the few that most have. Of a large one a triangulation is kept, whose
// triangles around the corner tell; both give the same answers. All is exact; ties go to the lowest vertex before the
// corner.

#include "polygon/triangulate/triangulate.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "polygon/triangulate/ear_mesh.h"
#include "polygon/triangulate/partition_queue.h"
#include "polygon/triangulate/reflex_tree.h"

// From so many points on the mesh is the faster one.
enum { SMALLEST_MESH = 256, CUTS_AHEAD = 8 };

// A vertex with the ones next to it in what is left of the outline.
typedef struct outline_vertex {
    tl_lattice_point position;
    uint32_t previous, next;
    uint32_t across; // edge of a cut triangle on the far side of the edge that starts here, or TL_NO_EDGE
} outline_vertex;

typedef struct triangulation {
    const tl_lattice_point *points;
    outline_vertex *vertices;
    uint8_t *is_reflex; // or straight
    bool has_mesh;
    tl_ear_mesh mesh;      // of large outlines
    tl_reflex_tree reflex; // of small ones
    tl_partition_queue queue;
} triangulation;

// The partition that cuts off corner b. False: it fails the internal angle test.
static bool find_partition(const triangulation *t, uint32_t b, tl_partition *found)
{
    if (t->is_reflex[b]) {
        return false;
    }
    const uint32_t a = t->vertices[b].previous, c = t->vertices[b].next;
    const outline_vertex *before = &t->vertices[a], *after = &t->vertices[c];
    const tl_lattice_point pa = before->position, pb = t->vertices[b].position, pc = after->position;
    // Angles only shrink in an outline; in a scribble a convex corner may turn reflex.
    if (tl_turn(pa, pb, pc) <= 0) {
        return false;
    }
    // The internal angle test. b is convex, so one half of it holds already, and at a reflex end that is enough.
    if ((!t->is_reflex[a] && tl_turn(pa, pc, t->vertices[before->previous].position) <= 0) ||
        (!t->is_reflex[c] && tl_turn(pc, t->vertices[after->next].position, pa) <= 0)) {
        return false;
    }
    found->key = (uint64_t)tl_distance2(pa, pc);
    found->value = a;
    found->extra = c;
    return true;
}

static void consider_partition(triangulation *t, uint32_t b)
{
    tl_partition item;
    if (find_partition(t, b, &item)) {
        tl_partition_queue_push(&t->queue, item);
    }
}

// A corner whose angle a cut has made smaller.
static void update_angle(triangulation *t, uint32_t b)
{
    const outline_vertex *v = &t->vertices[b];
    if (t->is_reflex[b] && tl_turn(t->vertices[v->previous].position, v->position, t->vertices[v->next].position) > 0) {
        t->is_reflex[b] = 0;
        if (!t->has_mesh) {
            tl_reflex_tree_remove(&t->reflex, b);
        }
    }
}

// A partition is stale as soon as one of its ends, or the corner between them, is cut off. A vertex that was cut off
// keeps its neighbours' numbers, but they no longer name it. And since vertices only go, the one between the ends is
// still the one that was tested.
static bool is_current(const triangulation *t, const tl_partition *item)
{
    const outline_vertex *b = &t->vertices[t->vertices[item->value].next];
    return b->previous == item->value && b->next == item->extra;
}

// The edge intersection test.
static bool is_free_partition(const triangulation *t, const tl_partition *item)
{
    const outline_vertex *a = &t->vertices[item->value];
    if (t->has_mesh) {
        return tl_ear_mesh_is_free(&t->mesh, item->value, a->next, a->position, t->vertices[item->extra].position);
    }
    return !tl_reflex_tree_any_in_triangle(&t->reflex, a->position, t->vertices[a->next].position,
                                           t->vertices[item->extra].position);
}

// Corners are cut off in no order of place. Those of the sorted list are known long before their turn, the next one of
// the heap is while the one before it is cut: what they need is fetched meanwhile.
static void fetch_cuts_ahead(const triangulation *t)
{
    const tl_partition_queue *queue = &t->queue;
    if (queue->sorted_count > 2 * CUTS_AHEAD) {
        const uint32_t a = queue->sorted[2 * CUTS_AHEAD].value;
        tl_prefetch(&t->vertices[a]);
        tl_prefetch(&t->vertices[queue->sorted[2 * CUTS_AHEAD].extra]);
        tl_prefetch(&t->mesh.outer[a]);
    }
    if (queue->sorted_count > CUTS_AHEAD) {
        const uint32_t b = t->vertices[queue->sorted[CUTS_AHEAD].value].next;
        tl_prefetch(&t->mesh.edges[t->mesh.outer[b]]);
    }
    if (queue->heap_count > 0) {
        tl_prefetch(&t->vertices[queue->heap[0].value]);
        tl_prefetch(&t->vertices[queue->heap[0].extra]);
    }
}

static bool is_left_turn(const triangulation *t, uint32_t b)
{
    return t->vertices[t->vertices[b].previous].next == b && t->vertices[t->vertices[b].next].previous == b;
}

static void emit_triangle(triangulation *t, uint32_t triangle, const uint32_t corners[3], uint32_t edges,
                          uint32_t *triangles_out, uint32_t *twins_out)
{
    for (uint32_t k = 0; k < 3; k++) {
        triangles_out[3 * triangle + k] = corners[k];
        uint32_t twin = k < edges ? t->vertices[corners[k]].across : TL_NO_EDGE;
        twins_out[3 * triangle + k] = twin;
        if (twin != TL_NO_EDGE) {
            twins_out[twin] = 3 * triangle + k;
        }
    }
}

static tl_result start_ear_test(triangulation *t, tl_arena *scratch, const tl_triangulate_input *input)
{
    t->has_mesh =
        input->ear_test == TL_EARS_BY_SIZE ? input->count >= SMALLEST_MESH : input->ear_test == TL_EARS_BY_MESH;
    if (t->has_mesh) {
        return tl_ear_mesh_init(&t->mesh, scratch, input->points, input->count, input->record);
    }
    return tl_reflex_tree_init(&t->reflex, scratch, input->points, t->is_reflex, input->count) ? TL_OK : TL_ERR_MEMORY;
}

static tl_result start_triangulation(triangulation *t, tl_arena *scratch, const tl_triangulate_input *input)
{
    const tl_lattice_point *points = input->points;
    const uint32_t count = input->count;
    t->points = points;
    t->vertices = TL_PUSH(scratch, outline_vertex, count);
    t->is_reflex = TL_PUSH(scratch, uint8_t, count);
    if (t->vertices == NULL || t->is_reflex == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        outline_vertex v = { points[i], i > 0 ? i - 1 : count - 1, i + 1 < count ? i + 1 : 0, TL_NO_EDGE };
        t->vertices[i] = v;
        t->is_reflex[i] = tl_turn(points[v.previous], points[i], points[v.next]) <= 0;
    }
    TL_TRY(start_ear_test(t, scratch, input));
    tl_partition_queue *queue = &t->queue;
    if (!tl_partition_queue_init(queue, scratch, count)) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t a = 0; a < count && count > 3; a++) {
        queue->sorted_count += find_partition(t, a + 1 < count ? a + 1 : 0, &queue->sorted[queue->sorted_count]);
    }
    tl_partition_queue_sort(queue);
    return TL_OK;
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

static tl_result triangulate(triangulation *t, tl_arena *scratch, uint32_t count, const tl_step_tracer *tracer,
                             uint32_t *triangles_out, uint32_t *twins_out)
{
    uint32_t triangle = 0;
    for (uint32_t left = count; left > 3; left--) {
        tl_partition chosen;
        do {
            if (!tl_partition_queue_pop(&t->queue, &chosen)) {
                return TL_ERR_SELF_INTERSECTION;
            }
            if (t->has_mesh) {
                fetch_cuts_ahead(t);
            }
        } while (!is_current(t, &chosen) || !is_free_partition(t, &chosen));
        const uint32_t a = chosen.value, c = chosen.extra;
        const uint32_t corners[3] = { a, t->vertices[a].next, c };
        if (tracer != NULL) {
            TL_TRY(trace_cut(t, scratch, tracer, left, corners));
        }
        emit_triangle(t, triangle, corners, 2, triangles_out, twins_out);
        if (t->has_mesh) {
            tl_ear_mesh_cut(&t->mesh, a, corners[1]);
        }
        t->vertices[a].across = 3 * triangle + 2;
        t->vertices[a].next = c;
        t->vertices[c].previous = a;
        update_angle(t, a);
        update_angle(t, c);
        triangle++;
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
    emit_triangle(t, triangle, corners, 3, triangles_out, twins_out);
    return tracer != NULL ? trace_cut(t, scratch, tracer, 3, corners) : TL_OK;
}

tl_result tl_triangulate(tl_arena *scratch, const tl_triangulate_input *input, uint32_t *triangles_out,
                         uint32_t *twins_out)
{
    const tl_arena_mark mark = tl_arena_get_mark(scratch);
    triangulation t;
    TL_TRY(start_triangulation(&t, scratch, input));
    TL_TRY(triangulate(&t, scratch, input->count, input->tracer, triangles_out, twins_out));
    tl_arena_rollback(scratch, mark);
    return TL_OK;
}
