// SPDX-License-Identifier: MIT
//
// Voxelization of single triangles against clipping them to each cell, and the rules for what lies on a border.
//
// The oracle clips the triangle to the cell's prism with Sutherland and Hodgman's method, once to a prism a little
// smaller than the cell and once to one a little larger: what lies in the smaller one must be covered, what misses the
// larger one must not be, and the heights lie between theirs. "A little" is the documented displacement, 2^-10.

#include "nav_bake/voxels/voxelize.h"

#include "nav_fields.h"

#include <math.h>

enum { WIDTH = 24, HEIGHT = 20, VOXELS = 40 };

static const double DISPLACEMENT = 1.0 / 1024;

typedef struct bench {
    tl_voxel_band band;
    tl_span_buffer buffer;
    double heights[TL_VOXEL_HEIGHTS_PER_CELL * WIDTH];
    tl_span_item items[WIDTH * HEIGHT]; ///< of the last triangle, which has at most one a column
    uint32_t count;
    test_random lane;
} bench;

static void bench_begin(bench *b)
{
    memset(b, 0, sizeof *b);
    tl_voxel_heights_init(b->heights, WIDTH);
    b->band = (tl_voxel_band){ WIDTH, 0, HEIGHT, HEIGHT, VOXELS, false, WIDTH, b->heights, &b->buffer };
}

static void bench_end(bench *b)
{
    tl_span_buffer_free(&b->buffer);
}

// Each lane of the block has the triangle; all levels of instructions place it alike.
static void place(const tl_voxel_band *band, tl_triangle_block *block, tl_voxel_point p, tl_voxel_point q,
                  tl_voxel_point r)
{
    const tl_voxel_point corners[3] = { p, q, r };
    memset(block, 0, sizeof *block);
    for (uint32_t c = 0; c < 3; c++) {
        for (uint32_t i = 0; i < TL_TRIANGLE_BLOCK; i++) {
            block->lattice[0][c][i] = corners[c].x;
            block->lattice[1][c][i] = corners[c].y;
            block->lattice[2][c][i] = corners[c].z;
        }
    }
    tl_triangle_block other = *block;
    tl_block_questions_scalar.place(band, block);
    tl_block_questions_best()->place(band, &other);
    TEST_CHECK(memcmp(block, &other, sizeof other) == 0);
}

static void voxelize(bench *b, tl_voxel_point p, tl_voxel_point q, tl_voxel_point r)
{
    const uint32_t columns = b->band.width * b->band.row_count;
    uint32_t first[WIDTH * HEIGHT + 1];
    const tl_nav_span *spans;
    TEST_RESULT(tl_span_buffer_begin(&b->buffer, columns), TL_OK);
    tl_triangle_block block;
    place(&b->band, &block, p, q, r);
    TEST_RESULT(tl_voxelize_triangle(&b->band, &block, test_random_below(&b->lane, TL_TRIANGLE_BLOCK), 1), TL_OK);
    TEST_RESULT(tl_span_buffer_merge(&b->buffer, first, &spans), TL_OK);
    b->count = first[columns];
    for (uint32_t c = 0; c < columns; c++) {
        TEST_CHECK(first[c + 1] - first[c] <= 1);
        for (uint32_t i = first[c]; i < first[c + 1]; i++) {
            b->items[i] = tl_span_item_make(c, spans[i].min, spans[i].max, spans[i].area);
        }
    }
    double clean[TL_VOXEL_HEIGHTS_PER_CELL * WIDTH];
    tl_voxel_heights_init(clean, WIDTH);
    TEST_CHECK(memcmp(clean, b->heights, sizeof clean) == 0);
}

// The item of a column, or 0. A column has at most one.
static tl_span_item item_of(const bench *b, uint32_t x, uint32_t z)
{
    tl_span_item found = 0;
    for (uint32_t i = 0; i < b->count; i++) {
        if (tl_span_item_column(b->items[i]) == z * WIDTH + x) {
            TEST_CHECK(found == 0);
            found = b->items[i];
        }
    }
    return found;
}

// ---- The oracle --------------------------------------------------------------------------------------------

typedef struct clip_polygon {
    tl_voxel_point points[16];
    int count;
} clip_polygon;

// Keeps the side where sign * (coordinate - line) <= 0; axis 0: x, 1: z.
static clip_polygon clip(const clip_polygon *in, int axis, double line, double sign)
{
    clip_polygon out;
    out.count = 0;
    for (int i = 0; i < in->count; i++) {
        tl_voxel_point p = in->points[i], q = in->points[(i + 1) % in->count];
        double dp = sign * ((axis == 0 ? p.x : p.z) - line), dq = sign * ((axis == 0 ? q.x : q.z) - line);
        if (dp <= 0) {
            out.points[out.count++] = p;
        }
        if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) {
            double t = dp / (dp - dq);
            tl_voxel_point cut = { p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t, p.z + (q.z - p.z) * t };
            out.points[out.count++] = cut;
        }
    }
    return out;
}

// Heights of the triangle over the cell grown by `grow`; false when it misses it.
static bool heights_over(const tl_voxel_point *triangle, uint32_t x, uint32_t z, double grow, double *low, double *high)
{
    clip_polygon polygon = { { triangle[0], triangle[1], triangle[2] }, 3 };
    polygon = clip(&polygon, 0, (double)x - grow, -1);
    polygon = clip(&polygon, 0, (double)x + 1 + grow, 1);
    polygon = clip(&polygon, 1, (double)z - grow, -1);
    polygon = clip(&polygon, 1, (double)z + 1 + grow, 1);
    if (polygon.count == 0) {
        return false;
    }
    *low = (double)INFINITY;
    *high = -(double)INFINITY;
    for (int i = 0; i < polygon.count; i++) {
        *low = fmin(*low, polygon.points[i].y);
        *high = fmax(*high, polygon.points[i].y);
    }
    return true;
}

typedef struct coverage {
    uint32_t covered, empty, undecided, tall, below, above;
} coverage;

static void check_cell(const bench *b, const tl_voxel_point *triangle, uint32_t x, uint32_t z, coverage *seen)
{
    double inner_low = 0, inner_high = 0, outer_low = 0, outer_high = 0;
    bool inner = heights_over(triangle, x, z, -DISPLACEMENT, &inner_low, &inner_high);
    bool outer = heights_over(triangle, x, z, DISPLACEMENT, &outer_low, &outer_high);
    tl_span_item item = item_of(b, x, z);
    const double slack = DISPLACEMENT;
    if (!outer) {
        TEST_CHECK(item == 0);
        seen->empty++;
        return;
    }
    if (item == 0) {
        bool outside = inner_high < slack || inner_low > VOXELS - slack;
        TEST_CHECK(!inner || outside);
        seen->undecided += !inner;
        seen->below += inner && inner_high < slack;
        seen->above += inner && inner_low > VOXELS - slack;
        return;
    }
    TEST_CHECK(outer_high >= -slack && outer_low <= VOXELS + slack);
    double min = tl_span_item_min(item), max = tl_span_item_max(item);
    TEST_CHECK(min >= fmin(VOXELS, fmax(0, floor(outer_low - slack))));
    TEST_CHECK(max <= fmin(VOXELS, ceil(outer_high + slack)) + (max == min + 1 ? 1 : 0));
    TEST_CHECK(max > min);
    if (inner) {
        TEST_CHECK(min <= fmin(VOXELS, fmax(0, floor(inner_low + slack))));
        TEST_CHECK(max >= fmin(VOXELS, ceil(inner_high - slack)));
        seen->covered++;
        seen->tall += max - min > 3;
    } else {
        seen->undecided++;
    }
}

static void check_triangle(bench *b, const tl_voxel_point *triangle, coverage *seen)
{
    voxelize(b, triangle[0], triangle[1], triangle[2]);
    tl_span_item first[WIDTH * HEIGHT];
    uint64_t count = b->count;
    memcpy(first, b->items, count * sizeof *first);
    for (uint32_t z = 0; z < HEIGHT; z++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            check_cell(b, triangle, x, z, seen);
        }
    }
    // Any order of the corners gives the same items.
    voxelize(b, triangle[2], triangle[1], triangle[0]);
    TEST_CHECK(b->count == count && memcmp(first, b->items, count * sizeof *first) == 0);
    voxelize(b, triangle[1], triangle[2], triangle[0]);
    TEST_CHECK(b->count == count && memcmp(first, b->items, count * sizeof *first) == 0);
}

static double random_between(test_random *random, double low, double high)
{
    return low + (high - low) * ((double)(test_random_u64(random) >> 11) * 0x1p-53);
}

static double on_grid(double value, double steps)
{
    return floor(value * steps) / steps;
}

static tl_voxel_point random_point(test_random *random, double margin, double steps)
{
    tl_voxel_point p = { random_between(random, -margin, WIDTH + margin),
                         random_between(random, -margin, VOXELS + margin),
                         random_between(random, -margin, HEIGHT + margin) };
    p.x = on_grid(p.x, steps);
    p.z = on_grid(p.z, steps);
    p.y = steps <= 2 ? on_grid(p.y, 1) : p.y;
    return p;
}

static void agrees_with_clipping(void **state)
{
    (void)state;
    bench b;
    bench_begin(&b);
    test_random random = { 77 };
    const char *names[] = { "large", "small", "wall", "on the lattice", "needle", "huge" };
    for (int kind = 0; kind < 6; kind++) {
        coverage seen = { 0 };
        for (uint32_t round = 0; round < 1500; round++) {
            tl_voxel_point t[3];
            double steps = kind == 3 ? 1 + test_random_below(&random, 2) : 1024;
            double margin = kind == 5 ? 1e9 : 8;
            for (int k = 0; k < 3; k++) {
                t[k] = random_point(&random, margin, steps);
            }
            if (kind == 1) {
                for (int k = 1; k < 3; k++) {
                    t[k].x = on_grid(t[0].x + random_between(&random, -1.5, 1.5), 1024);
                    t[k].y = t[0].y + random_between(&random, -1.5, 1.5);
                    t[k].z = on_grid(t[0].z + random_between(&random, -1.5, 1.5), 1024);
                }
            } else if (kind == 2) { // in a vertical plane, or as good as
                t[2].x = t[round % 2].x + (double)test_random_below(&random, 2) / 1024;
                t[2].z = t[round % 2].z;
            } else if (kind == 4) {
                t[2] = t[1];
                t[2].x += (double)test_random_below(&random, 3) / 1024;
            } else if (kind == 5) { // through the field, somewhere
                t[0] = random_point(&random, 2, 1024);
                t[1].y = t[0].y + (t[1].y - t[0].y) * 1e-2;
            }
            check_triangle(&b, t, &seen);
        }
        if (!(seen.covered > 300 && seen.empty > 300 && (kind == 1 || seen.tall > 100))) {
            fail_msg("%s: covered %u empty %u tall %u", names[kind], seen.covered, seen.empty, seen.tall);
        }
        if (kind == 0) {
            TEST_CHECK(seen.below > 50 && seen.above > 50);
        }
    }
    bench_end(&b);
}

// ---- What lies on borders ----------------------------------------------------------------------------------

static tl_voxel_point at(double x, double y, double z)
{
    tl_voxel_point p = { x, y, z };
    return p;
}

static uint32_t covered_count(const bench *b)
{
    return (uint32_t)b->count;
}

static void borders_belong_to_one_side(void **state)
{
    (void)state;
    bench b;
    bench_begin(&b);
    // A floor from line 3 to line 6 covers the cells 3, 4, 5: nothing is only touched.
    voxelize(&b, at(3, 5, 3), at(3, 5, 6), at(6, 5, 6));
    TEST_CHECK(covered_count(&b) == 6);
    TEST_CHECK(item_of(&b, 3, 3) != 0 && item_of(&b, 5, 5) != 0 && item_of(&b, 4, 3) == 0);
    // It lies exactly on a voxel's floor: one voxel tall.
    TEST_CHECK(item_of(&b, 3, 3) == tl_span_item_make(3 * WIDTH + 3, 5, 6, 1));
    // A wall on line 3 belongs to the cells right of it.
    voxelize(&b, at(3, 0, 2), at(3, 0, 7), at(3, 8, 7));
    TEST_CHECK(covered_count(&b) == 5);
    TEST_CHECK(item_of(&b, 3, 2) != 0 && item_of(&b, 2, 2) == 0 && item_of(&b, 3, 7) == 0);
    TEST_CHECK(tl_span_item_max(item_of(&b, 3, 6)) == 8 && tl_span_item_min(item_of(&b, 3, 6)) == 0);
    TEST_CHECK(tl_span_item_max(item_of(&b, 3, 2)) == 2); // the slope's 1.6 voxels at the far end of the cell
    voxelize(&b, at(2, 0, 3), at(7, 0, 3), at(7, 8, 3));
    TEST_CHECK(covered_count(&b) == 5 && item_of(&b, 2, 3) != 0 && item_of(&b, 2, 2) == 0);
    // A point and an upright line are somewhere, too.
    voxelize(&b, at(4, 2, 5), at(4, 2, 5), at(4, 2, 5));
    TEST_CHECK(covered_count(&b) == 1 && item_of(&b, 4, 5) == tl_span_item_make(5 * WIDTH + 4, 2, 3, 1));
    voxelize(&b, at(4.5, 2.5, 5.5), at(4.5, 7.5, 5.5), at(4.5, 3, 5.5));
    TEST_CHECK(covered_count(&b) == 1 && item_of(&b, 4, 5) == tl_span_item_make(5 * WIDTH + 4, 2, 8, 1));
    // A diagonal through lattice corners touches no cell but those that it runs through.
    voxelize(&b, at(2, 0, 2), at(7, 0, 7), at(7, 4, 7));
    TEST_CHECK(covered_count(&b) == 5 && item_of(&b, 2, 2) != 0 && item_of(&b, 6, 6) != 0);
    // The triangle above its diagonal: 10 + 5 cells.
    voxelize(&b, at(2, 0, 2), at(7, 0, 7), at(2, 0, 7));
    TEST_CHECK(covered_count(&b) == 15);
    bench_end(&b);
}

static void the_far_side_is_closed_on_request(void **state)
{
    (void)state;
    bench b;
    bench_begin(&b);
    const tl_voxel_point x_wall[3] = { at(WIDTH, 0, 2), at(WIDTH, 0, 4), at(WIDTH, 5, 4) };
    const tl_voxel_point z_wall[3] = { at(2, 0, HEIGHT), at(4, 0, HEIGHT), at(4, 5, HEIGHT) };
    voxelize(&b, x_wall[0], x_wall[1], x_wall[2]);
    TEST_CHECK(covered_count(&b) == 0);
    voxelize(&b, z_wall[0], z_wall[1], z_wall[2]);
    TEST_CHECK(covered_count(&b) == 0);
    b.band.closed_far_side = true;
    voxelize(&b, x_wall[0], x_wall[1], x_wall[2]);
    TEST_CHECK(covered_count(&b) == 2 && item_of(&b, WIDTH - 1, 3) != 0);
    voxelize(&b, z_wall[0], z_wall[1], z_wall[2]);
    TEST_CHECK(covered_count(&b) == 2 && item_of(&b, 3, HEIGHT - 1) != 0);
    bench_end(&b);
}

static void heights_are_cut_to_the_field(void **state)
{
    (void)state;
    bench b;
    bench_begin(&b);
    voxelize(&b, at(1, VOXELS, 1), at(1, VOXELS, 2), at(2, VOXELS, 2));
    TEST_CHECK(item_of(&b, 1, 1) == tl_span_item_make(WIDTH + 1, VOXELS, VOXELS + 1, 1));
    voxelize(&b, at(1, VOXELS + 0.01, 1), at(1, VOXELS + 0.01, 2), at(2, VOXELS + 0.01, 2));
    TEST_CHECK(covered_count(&b) == 0);
    voxelize(&b, at(1, -0.01, 1), at(1, -0.01, 2), at(2, -0.01, 2));
    TEST_CHECK(covered_count(&b) == 0);
    voxelize(&b, at(1, -1e-9, 1), at(1, -1e-9, 2), at(2, -1e-9, 2)); // noise
    TEST_CHECK(item_of(&b, 1, 1) == tl_span_item_make(WIDTH + 1, 0, 1, 1));
    voxelize(&b, at(1, -100, 1), at(1, 1000, 2), at(2, 1000, 2));
    TEST_CHECK(item_of(&b, 1, 1) == tl_span_item_make(WIDTH + 1, 0, VOXELS, 1));
    bench_end(&b);
}

// Two triangles of a random quadrangle cover, together, what their union covers: no cell on the diagonal is lost, also
// when the band is cut into rows.
static void bands_and_seams_lose_nothing(void **state)
{
    (void)state;
    bench b;
    bench_begin(&b);
    test_random random = { 123 };
    for (uint32_t round = 0; round < 2000; round++) {
        tl_voxel_point t[3];
        for (int k = 0; k < 3; k++) {
            t[k] = random_point(&random, 6, 1024);
        }
        b.band.first_row = 0;
        b.band.row_count = HEIGHT;
        voxelize(&b, t[0], t[1], t[2]);
        tl_span_item whole[WIDTH * HEIGHT];
        uint64_t count = b.count, at_item = 0;
        memcpy(whole, b.items, count * sizeof *whole);
        for (uint32_t row = 0; row < HEIGHT;) {
            uint32_t rows = 1 + test_random_below(&random, HEIGHT - row);
            b.band.first_row = row;
            b.band.row_count = rows;
            voxelize(&b, t[0], t[1], t[2]);
            for (uint64_t i = 0; i < b.count; i++) {
                tl_span_item shift = tl_span_item_make(row * WIDTH, 0, 0, 0);
                TEST_CHECK(at_item < count && b.items[i] + shift == whole[at_item]);
                at_item++;
            }
            row += rows;
        }
        TEST_CHECK(at_item == count);
    }
    bench_end(&b);
}

// A level's map gives each tile the same points, moved by whole columns.
static void maps_of_tiles_agree(void **state)
{
    (void)state;
    test_random random = { 9 };
    const tl_nav_lattice whole = { { 5000.3f, -20.0f, -4000.7f }, 0, 0 };
    for (uint32_t round = 0; round < 5000; round++) {
        tl_nav_lattice tile = whole;
        tile.first_x = (int32_t)test_random_below(&random, 60000) - 9;
        tile.first_z = (int32_t)test_random_below(&random, 60000) - 9;
        tl_lattice_map a = tl_lattice_map_make(&whole, 0.3f, 0.2f), b = tl_lattice_map_make(&tile, 0.3f, 0.2f);
        tl_vec3 v = test_random_point(&random, tl_vec3_make(-9000, -50, -9000), tl_vec3_make(9000, 50, 9000));
        tl_voxel_point p = tl_lattice_map_point(&a, v), q = tl_lattice_map_point(&b, v);
        TEST_CHECK(p.x - tile.first_x == q.x && p.z - tile.first_z == q.z && p.y == q.y);
        TEST_CHECK(floor(p.x * 1024) == p.x * 1024 && floor(p.z * 1024) == p.z * 1024);
        TEST_CHECK(fabs(p.x - ((double)v.x - (double)whole.origin.x) / (double)0.3f) <= 0.5001 / 1024);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(agrees_with_clipping),
        cmocka_unit_test(borders_belong_to_one_side),
        cmocka_unit_test(the_far_side_is_closed_on_request),
        cmocka_unit_test(heights_are_cut_to_the_field),
        cmocka_unit_test(bands_and_seams_lose_nothing),
        cmocka_unit_test(maps_of_tiles_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
