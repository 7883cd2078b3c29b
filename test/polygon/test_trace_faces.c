// SPDX-License-Identifier: MIT

#include "polygon/outline/outline.h"
#include "polygon_shapes.h"

enum { MAX_NODES = 64 };

typedef struct fixture {
    tl_arena arena;
    tl_outline outline;
    tl_lattice_point points[MAX_NODES];
} fixture;

// Traces the closed walk over the numbered nodes.
static tl_result trace(fixture *f, const tl_lattice_point *points, uint32_t node_count, const uint32_t *walk,
                       uint32_t count, const tl_allocator *allocator)
{
    memset(f, 0, sizeof *f);
    tl_arena_init(&f->arena, allocator);
    memcpy(f->points, points, node_count * sizeof *points);
    f->outline.nodes.points = f->points;
    f->outline.nodes.count = node_count;
    tl_outline_edge edges[2 * MAX_NODES];
    for (uint32_t i = 0; i < count; i++) {
        edges[i].from = walk[i];
        edges[i].to = walk[(i + 1) % count];
    }
    return tl_outline_trace_faces(&f->arena, edges, count, &f->outline);
}

// Doubled area of one walk, or of all.
static int64_t area2(const tl_outline *outline, uint32_t walk)
{
    int64_t sum = 0;
    for (uint32_t k = outline->walk_first[walk]; k < outline->walk_first[walk + 1]; k++) {
        uint32_t next = k + 1 < outline->walk_first[walk + 1] ? k + 1 : outline->walk_first[walk];
        tl_lattice_point a = outline->nodes.points[outline->corners[k]];
        tl_lattice_point b = outline->nodes.points[outline->corners[next]];
        sum += (int64_t)b.x * a.z - (int64_t)a.x * b.z;
    }
    return sum;
}

static bool walk_is(const tl_outline *outline, uint32_t walk, const uint32_t *nodes, uint32_t count)
{
    return outline->walk_first[walk + 1] - outline->walk_first[walk] == count &&
           oracle_same_polygon(outline->corners + outline->walk_first[walk], nodes, count);
}

// 0 1 / 3 2: a square in the contours' direction, and a smaller one in the middle of it.
static const tl_lattice_point squares[8] = { { 0, 0 }, { 0, 9 }, { 9, 9 }, { 9, 0 },
                                             { 3, 3 }, { 3, 6 }, { 6, 6 }, { 6, 3 } };

static void a_simple_walk_comes_back_as_it_was(void **state)
{
    (void)state;
    const uint32_t walk[4] = { 0, 1, 2, 3 };
    fixture f;
    TEST_RESULT(trace(&f, squares, 4, walk, 4, NULL), TL_OK);
    TEST_CHECK(f.outline.walk_count == 1 && f.outline.faults == 0 && area2(&f.outline, 0) == 2 * 81);
    TEST_CHECK(memcmp(f.outline.corners, walk, sizeof walk) == 0);
    for (uint32_t k = 0; k < 4; k++) {
        TEST_CHECK(f.outline.edges[k] == k);
    }
    tl_arena_free(&f.arena);
}

static void a_backward_walk_holds_no_floor(void **state)
{
    (void)state;
    const uint32_t walk[4] = { 3, 2, 1, 0 };
    fixture f;
    TEST_RESULT(trace(&f, squares, 4, walk, 4, NULL), TL_OK);
    TEST_CHECK(f.outline.walk_count == 0 && f.outline.faults == TL_CONTOUR_FAULT_WINDING);
    tl_arena_free(&f.arena);
}

static void a_bridge_to_a_hole_stays(void **state)
{
    (void)state;
    const uint32_t walk[10] = { 0, 1, 2, 3, 0, 4, 7, 6, 5, 4 };
    fixture f;
    TEST_RESULT(trace(&f, squares, 8, walk, 10, NULL), TL_OK);
    TEST_CHECK(f.outline.walk_count == 1 && f.outline.faults == 0 && area2(&f.outline, 0) == 2 * (81 - 9));
    TEST_CHECK(walk_is(&f.outline, 0, walk, 10));
    tl_arena_free(&f.arena);
}

// The inner square runs the same way as the outer one: its floor is there twice, and is covered once.
static void a_second_winding_is_floor_once(void **state)
{
    (void)state;
    const uint32_t walk[10] = { 0, 1, 2, 3, 0, 4, 5, 6, 7, 4 };
    fixture f;
    TEST_RESULT(trace(&f, squares, 8, walk, 10, NULL), TL_OK);
    TEST_CHECK(f.outline.walk_count == 2 && f.outline.faults == (TL_CONTOUR_FAULT_WINDING | TL_CONTOUR_FAULT_PINCH));
    TEST_CHECK(area2(&f.outline, 0) + area2(&f.outline, 1) == 2 * 81);
    tl_arena_free(&f.arena);
}

static void spikes_go(void **state)
{
    (void)state;
    // One into the floor, of two edges, and one out of it, at the walk's beginning.
    const tl_lattice_point points[7] = { { 0, 0 }, { 0, 9 }, { 9, 9 }, { 9, 0 }, { 4, 4 }, { 5, 4 }, { -3, -3 } };
    const uint32_t walk[10] = { 6, 0, 1, 4, 5, 4, 1, 2, 3, 0 }, expected[4] = { 0, 1, 2, 3 };
    fixture f;
    TEST_RESULT(trace(&f, points, 7, walk, 10, NULL), TL_OK);
    TEST_CHECK(f.outline.walk_count == 1 && f.outline.faults == TL_CONTOUR_FAULT_SPIKE);
    TEST_CHECK(walk_is(&f.outline, 0, expected, 4));
    tl_arena_free(&f.arena);
    // Nothing but a spike.
    const uint32_t run[2] = { 4, 5 };
    TEST_RESULT(trace(&f, points, 7, run, 2, NULL), TL_OK);
    TEST_CHECK(f.outline.walk_count == 0 && f.outline.faults == TL_CONTOUR_FAULT_SPIKE);
    tl_arena_free(&f.arena);
}

static void a_pinch_falls_apart(void **state)
{
    (void)state;
    // Two triangles that meet in node 2, both forward; then a bow, whose second wing runs backward.
    const tl_lattice_point points[5] = { { 0, 0 }, { 0, 4 }, { 2, 2 }, { 4, 4 }, { 4, 0 } };
    const uint32_t forward[6] = { 0, 1, 2, 3, 4, 2 }, bow[6] = { 0, 1, 2, 4, 3, 2 };
    fixture f;
    TEST_RESULT(trace(&f, points, 5, forward, 6, NULL), TL_OK);
    TEST_CHECK(f.outline.walk_count == 2 && f.outline.faults == TL_CONTOUR_FAULT_PINCH);
    TEST_CHECK(walk_is(&f.outline, 0, forward, 3) && walk_is(&f.outline, 1, forward + 2, 3));
    tl_arena_free(&f.arena);
    TEST_RESULT(trace(&f, points, 5, bow, 6, NULL), TL_OK);
    TEST_CHECK(f.outline.walk_count == 1 && f.outline.faults == TL_CONTOUR_FAULT_WINDING);
    TEST_CHECK(walk_is(&f.outline, 0, bow, 3));
    tl_arena_free(&f.arena);
}

// Random closed walks along the lines of a grid meet in nodes only. The walks' area is the number of cells that the
// walk winds around, counted cell by cell.
static void walks_on_a_grid_cover_the_cells_wound_around(void **state)
{
    (void)state;
    enum { SIDE = 6 };
    tl_lattice_point grid[SIDE * SIDE];
    for (int32_t i = 0; i < SIDE * SIDE; i++) {
        grid[i].x = i % SIDE;
        grid[i].z = i / SIDE;
    }
    test_random random = { 3 };
    uint32_t floors = 0, doubled = 0, pinched = 0;
    for (uint32_t round = 0; round < 4000; round++) {
        uint32_t walk[2 * MAX_NODES], count = 0;
        uint32_t x = test_random_below(&random, SIDE), z = test_random_below(&random, SIDE);
        const uint32_t start_x = x, start_z = z;
        for (uint32_t steps = 4 + test_random_below(&random, 60); steps > 0 || x != start_x || z != start_z;) {
            walk[count++] = z * SIDE + x;
            if (steps > 0) {
                steps--;
                uint32_t d = test_random_below(&random, 4);
                x = d == 0 && x > 0 ? x - 1 : d == 1 && x + 1 < SIDE ? x + 1 : x;
                z = d == 2 && z > 0 ? z - 1 : d == 3 && z + 1 < SIDE ? z + 1 : z;
            } else if (x != start_x) {
                x = x < start_x ? x + 1 : x - 1;
            } else {
                z = z < start_z ? z + 1 : z - 1;
            }
            count -= walk[count - 1] == z * SIDE + x;
        }
        if (count < 3) {
            continue;
        }
        int64_t cells = 0;
        for (uint32_t cell_z = 0; cell_z + 1 < SIDE; cell_z++) {
            int winding = 0;
            for (uint32_t cell_x = 0; cell_x + 1 < SIDE; cell_x++) {
                // Edges along the cell's left side.
                for (uint32_t i = 0; i < count; i++) {
                    uint32_t a = walk[i], b = walk[(i + 1) % count], low = cell_z * SIDE + cell_x;
                    winding += a == low && b == low + SIDE;
                    winding -= b == low && a == low + SIDE;
                }
                cells += winding >= 1;
                doubled += winding > 1;
            }
        }
        fixture f;
        TEST_RESULT(trace(&f, grid, SIDE * SIDE, walk, count, NULL), TL_OK);
        int64_t sum = 0;
        for (uint32_t w = 0; w < f.outline.walk_count; w++) {
            TEST_CHECK(area2(&f.outline, w) > 0);
            sum += area2(&f.outline, w);
        }
        TEST_CHECK(sum == 2 * cells);
        floors += cells > 0;
        pinched += f.outline.walk_count > 1;
        tl_arena_free(&f.arena);
    }
    TEST_CHECK(floors > 1000 && doubled > 200 && pinched > 500);
}

static void memory_may_run_out(void **state)
{
    (void)state;
    const uint32_t walk[10] = { 0, 1, 2, 3, 0, 4, 7, 6, 5, 4 };
    uint64_t fail_at = 1;
    for (tl_result result = TL_ERR_MEMORY; result == TL_ERR_MEMORY; fail_at++) {
        test_allocator allocator;
        test_allocator_init(&allocator, fail_at);
        fixture f;
        result = trace(&f, squares, 8, walk, 10, &allocator.allocator);
        TEST_CHECK(result == TL_OK || result == TL_ERR_MEMORY);
        tl_arena_free(&f.arena);
        TEST_CHECK(allocator.live_blocks == 0);
    }
    TEST_CHECK(fail_at > 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_simple_walk_comes_back_as_it_was),
        cmocka_unit_test(a_backward_walk_holds_no_floor),
        cmocka_unit_test(a_bridge_to_a_hole_stays),
        cmocka_unit_test(a_second_winding_is_floor_once),
        cmocka_unit_test(spikes_go),
        cmocka_unit_test(a_pinch_falls_apart),
        cmocka_unit_test(walks_on_a_grid_cover_the_cells_wound_around),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
