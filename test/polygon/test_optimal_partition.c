// SPDX-License-Identifier: MIT

#include "polygon/optimal/optimal_partition.h"

#include "polygon/triangulate/triangulate.h"
#include "polygon_random_shapes.h"

enum { MAX_POINTS = 128, MAX_EXHAUSTED = 12, MAX_CAP = 12 };

static oracle_point points[MAX_POINTS];
static tl_lattice_point lattice[MAX_POINTS];
static uint32_t triangles[3 * MAX_POINTS], twins[3 * MAX_POINTS], identity[MAX_POINTS];

// The oracle: for the part of the outline behind a chord, every subset of its corners is tried as the polygon at the
// chord.
typedef struct exhaustion {
    uint32_t max_corners;
    bool sees[MAX_EXHAUSTED][MAX_EXHAUSTED];
    uint32_t known[MAX_EXHAUSTED][MAX_EXHAUSTED];
} exhaustion;

static bool is_convex(const uint32_t *corners, uint32_t count)
{
    for (uint32_t k = 0; k < count; k++) {
        if (oracle_area2(points[corners[k]], points[corners[(k + 1) % count]], points[corners[(k + 2) % count]]) >= 0) {
            return false;
        }
    }
    return true;
}

static uint32_t exhaust(exhaustion *e, uint32_t i, uint32_t j)
{
    if (j == i + 1) {
        return 0;
    }
    if (e->known[i][j] != 0) {
        return e->known[i][j];
    }
    uint32_t best = UINT32_MAX;
    for (uint32_t subset = 1; subset < 1u << (j - i - 1); subset++) {
        uint32_t corners[MAX_EXHAUSTED], count = 0;
        corners[count++] = i;
        for (uint32_t k = i + 1; k < j; k++) {
            if (subset >> (k - i - 1) & 1) {
                corners[count++] = k;
            }
        }
        corners[count++] = j;
        bool fits = (e->max_corners == 0 || count <= e->max_corners) && is_convex(corners, count);
        for (uint32_t k = 0; fits && k + 1 < count; k++) {
            fits = e->sees[corners[k]][corners[k + 1]];
        }
        uint32_t sum = 1;
        for (uint32_t k = 0; fits && k + 1 < count; k++) {
            sum += exhaust(e, corners[k], corners[k + 1]);
        }
        best = fits && sum < best ? sum : best;
    }
    e->known[i][j] = best;
    return best;
}

static uint32_t fewest_by_exhaustion(uint32_t n, uint32_t max_corners)
{
    exhaustion e;
    memset(&e, 0, sizeof e);
    e.max_corners = max_corners;
    for (uint32_t i = 0; i < n; i++) {
        for (uint32_t j = i + 1; j < n; j++) {
            e.sees[i][j] = j == i + 1 || (i == 0 && j == n - 1) || oracle_sees(points, identity, n, i, j);
        }
    }
    return exhaust(&e, 0, n - 1);
}

// The other oracle, for all that tl_partition_optimally promises: dynamic programming in its plain form, over every
// chain of corners behind a chord by its second corner, its last edge and its number of corners, none left out.
typedef struct plain_program {
    uint32_t n, most;
    uint8_t sees[MAX_POINTS][MAX_POINTS];
    uint32_t fewest[MAX_POINTS][MAX_POINTS];
    uint32_t chain[MAX_POINTS][MAX_POINTS][MAX_CAP + 1]; // by last edge and corners, for one first edge
} plain_program;

static plain_program plain;

static bool bends_in(uint32_t a, uint32_t b, uint32_t c)
{
    return oracle_area2(points[a], points[b], points[c]) < 0;
}

// Grows all chains that begin with the edge (i, second), and closes them.
static void grow_chains(uint32_t i, uint32_t second, bool has_cap)
{
    const uint32_t n = plain.n;
    for (uint32_t u = second; u < n; u++) {
        memset(plain.chain[u], 0xff, sizeof plain.chain[u]);
    }
    memset(plain.chain[i], 0xff, sizeof plain.chain[i]);
    plain.chain[i][second][has_cap ? 2 : 0] = plain.fewest[i][second];
    for (uint32_t v = second; v < n; v++) {
        for (uint32_t u = i; u < v && plain.sees[i][v]; u = u == i ? second : u + 1) {
            for (uint32_t count = 0; count <= plain.most; count++) {
                const uint32_t cost = plain.chain[u][v][count];
                if (cost == UINT32_MAX) {
                    continue;
                }
                const uint32_t longer = has_cap ? count + 1 : count;
                for (uint32_t w = v + 1; w < n && longer <= plain.most; w++) {
                    uint32_t *to = &plain.chain[v][w][longer];
                    if (plain.sees[i][w] && plain.sees[v][w] && bends_in(u, v, w) && cost + plain.fewest[v][w] < *to) {
                        *to = cost + plain.fewest[v][w];
                    }
                }
                if (v > second && bends_in(u, v, i) && bends_in(v, i, second) && cost + 1 < plain.fewest[i][v]) {
                    plain.fewest[i][v] = cost + 1;
                }
            }
        }
    }
}

static uint32_t fewest_by_plain_program(uint32_t n, uint32_t max_corners)
{
    plain.n = n;
    plain.most = max_corners;
    TEST_CHECK(max_corners <= MAX_CAP);
    memset(plain.fewest, 0xff, sizeof plain.fewest);
    memset(plain.sees, 0, sizeof plain.sees);
    for (uint32_t i = 0; i < n; i++) {
        for (uint32_t j = i + 1; j < n; j++) {
            plain.sees[i][j] = j == i + 1 || (i == 0 && j == n - 1) || oracle_sees(points, identity, n, i, j);
        }
    }
    for (uint32_t i = n - 1; i-- > 0;) {
        plain.fewest[i][i + 1] = 0;
        for (uint32_t second = i + 1; second < n; second++) {
            if (plain.sees[i][second]) {
                grow_chains(i, second, max_corners != 0);
            }
        }
    }
    return plain.fewest[0][n - 1];
}

// Partitions, and checks that the parts are convex, small enough, and together the outline's area. 0: given up.
static uint32_t partition(uint32_t n, uint32_t max_corners, uint64_t max_steps)
{
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    for (uint32_t i = 0; i < n; i++) {
        lattice[i].x = (int32_t)points[i].x;
        lattice[i].z = (int32_t)points[i].z;
        identity[i] = i;
    }
    bool found;
    tl_visibility visibility;
    tl_convex_parts parts;
    const tl_triangulate_input input = { lattice, n, NULL, NULL, TL_EARS_BY_SIZE, NULL };
    TEST_RESULT(tl_triangulate(&arena, &input, triangles, twins), TL_OK);
    const tl_triangulated_outline outline = { lattice, n, triangles, twins };
    TEST_RESULT(tl_find_visibility(&arena, &outline, UINT32_MAX, &visibility, &found), TL_OK);
    TEST_CHECK(found);
    TEST_RESULT(tl_partition_optimally(&arena, &outline, &visibility, max_corners, max_steps, &parts, &found), TL_OK);
    int64_t area = 0;
    for (uint32_t p = 0; found && p < parts.count; p++) {
        const uint32_t *corners = parts.corners + parts.first[p];
        uint32_t count = parts.first[p + 1] - parts.first[p];
        TEST_CHECK(count >= 3 && (max_corners == 0 || count <= max_corners) && is_convex(corners, count));
        for (uint32_t k = 1; k + 1 < count; k++) {
            area -= oracle_area2(points[corners[0]], points[corners[k]], points[corners[k + 1]]);
        }
    }
    TEST_CHECK(!found || area == oracle_contour_area2(points, n));
    tl_arena_free(&arena);
    return found ? parts.count : 0;
}

static uint32_t merged_triangles(uint32_t n, uint32_t max_corners)
{
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    tl_convex_parts parts;
    const tl_merge_input input = { lattice, triangles, twins, n - 2, max_corners, NULL, NULL, NULL };
    TEST_RESULT(tl_merge_triangles(&arena, &input, &parts), TL_OK);
    tl_arena_free(&arena);
    return parts.count;
}

static void equals_exhaustion(void **state)
{
    (void)state;
    static const uint32_t caps[6] = { 0, 3, 4, 5, 6, 8 };
    test_random random = { 31 };
    uint32_t compared = 0, large = 0, better = 0, straight = 0;
    for (uint32_t round = 0; round < 3000; round++) {
        uint32_t n = 3 + test_random_below(&random, 10);
        bool is_good = shape_untangled(&random, points, n, 4u << test_random_below(&random, 8));
        if (round % 8 == 0) {
            n = shape_cells(&random, 8, 2 + test_random_below(&random, 5), points, MAX_EXHAUSTED);
            is_good = n >= 4 && oracle_is_simple(points, n);
            straight += is_good;
        }
        if (!is_good) {
            continue;
        }
        uint32_t cap = caps[test_random_below(&random, 6)];
        uint32_t count = partition(n, cap, UINT64_MAX);
        TEST_CHECK(count == fewest_by_exhaustion(n, cap));
        compared++;
        large += n >= 11;
        better += count < merged_triangles(n, cap);
    }
    TEST_CHECK(compared > 1500 && large > 200 && better > 100 && straight > 40);
}

static void equals_the_plain_program(void **state)
{
    (void)state;
    static const uint32_t caps[6] = { 6, 0, 3, 4, 12, 5 };
    test_random random = { 33 };
    uint32_t compared = 0, large = 0, better = 0;
    for (uint32_t round = 0; round < 400; round++) {
        uint32_t n = 3 + test_random_below(&random, MAX_POINTS - 2);
        switch (round % 4) {
        case 0: // the plain program is a check of the other oracle too
            n = 3 + n % (MAX_EXHAUSTED - 2);
            shape_random_star(&random, points, n, 1e6, 0.2);
            break;
        case 1:
            shape_random_star(&random, points, n, 1e6, 0.1);
            break;
        case 2:
            n = n % 48 + 3;
            if (!shape_untangled(&random, points, n, 1u << 12)) {
                continue;
            }
            break;
        default:
            n = shape_cells(&random, 14, 10 + test_random_below(&random, 90), points, MAX_POINTS);
        }
        if (n < 3 || !oracle_is_simple(points, n)) {
            continue;
        }
        uint32_t cap = caps[test_random_below(&random, 6)];
        uint32_t count = partition(n, cap, UINT64_MAX);
        uint32_t fewest = fewest_by_plain_program(n, cap);
        TEST_CHECK(count == fewest && (n > MAX_EXHAUSTED || count == fewest_by_exhaustion(n, cap)));
        compared++;
        large += n > 100;
        better += count < merged_triangles(n, cap);
    }
    TEST_CHECK(compared > 300 && large > 15 && better > 100);
    // The largest size promised, with the most chords.
    shape_star(points, MAX_POINTS, 1e8, 1e8);
    TEST_CHECK(partition(MAX_POINTS, 6, UINT64_MAX) == 32);
    shape_random_star(&random, points, MAX_POINTS, 1e6, 0.9);
    TEST_CHECK(partition(MAX_POINTS, 6, UINT64_MAX) == fewest_by_plain_program(MAX_POINTS, 6));
}

static void is_never_worse_than_merging(void **state)
{
    (void)state;
    static const uint32_t caps[4] = { 0, 4, 6, 12 };
    test_random random = { 32 };
    uint32_t compared = 0, better = 0;
    for (uint32_t round = 0; round < 250; round++) {
        uint32_t n = 13 + test_random_below(&random, 60);
        bool is_good = shape_untangled(&random, points, n, 8u << test_random_below(&random, 10));
        if (round % 2 == 0) {
            n = shape_cells(&random, 14, 10 + test_random_below(&random, 60), points, MAX_POINTS);
            is_good = n >= 4 && oracle_is_simple(points, n);
        }
        if (is_good) {
            uint32_t cap = caps[test_random_below(&random, 4)];
            uint32_t count = partition(n, cap, UINT64_MAX);
            uint32_t merged = merged_triangles(n, cap);
            TEST_CHECK(count <= merged);
            TEST_CHECK(cap == 0 || count >= (n - 2 + cap - 3) / (cap - 2));
            better += count < merged;
            compared++;
        }
    }
    TEST_CHECK(compared > 100 && better > 30);
}

static void known_shapes(void **state)
{
    (void)state;
    shape_star(points, 128, 1e8, 1e8);
    TEST_CHECK(partition(128, 0, UINT64_MAX) == 1);
    TEST_CHECK(partition(128, 6, UINT64_MAX) == 32);
    TEST_CHECK(partition(128, 3, UINT64_MAX) == 126);
    for (double inner = 100.0; inner < 1000.0; inner += 100.0) {
        shape_star(points, 12, 1000.0, inner);
        TEST_CHECK(partition(12, 0, UINT64_MAX) == fewest_by_exhaustion(12, 0));
        TEST_CHECK(partition(12, 4, UINT64_MAX) == fewest_by_exhaustion(12, 4));
    }
    // Coordinates at the limits.
    const int64_t limit = 1 << 29;
    const oracle_point notch[5] = {
        { -limit, -limit }, { -limit, limit }, { 1, 0 }, { limit, limit }, { limit, -limit }
    };
    memcpy(points, notch, sizeof notch);
    shape_make_outer(points, 5);
    TEST_CHECK(partition(5, 6, UINT64_MAX) == 2);
    // One unit to the side, and no chord makes both parts strictly convex.
    points[2].x = 0;
    TEST_CHECK(partition(5, 6, UINT64_MAX) == 3);
}

static void gives_up_above_the_limit(void **state)
{
    (void)state;
    shape_star(points, 100, 1e6, 1e6);
    TEST_CHECK(partition(100, 6, 1 << 22) == 25);
    TEST_CHECK(partition(100, 6, 1000) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equals_exhaustion),           cmocka_unit_test(equals_the_plain_program),
        cmocka_unit_test(is_never_worse_than_merging), cmocka_unit_test(known_shapes),
        cmocka_unit_test(gives_up_above_the_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
