// SPDX-License-Identifier: MIT
//
// A sweep of random contours, simple and not, divided by every method and proved right by trying everything.
//
//   test_polygon_sweep [CONTOURS]    default 25,000, a few seconds; 1,000,000 take some minutes

#include "polygon_proof.h"
#include "polygon_shapes.h"

#include <stdio.h>

enum { MAX_POINTS = 256, METHODS = 3 };

static uint32_t contours_asked = 25000;

// Where a contour comes from.
typedef enum origin { UNTANGLED, CELLS, SCRIBBLE, SPOILT, HOLES, HALVES, ORIGINS } origin;
static const char *const origin_names[ORIGINS] = {
    "untangled points",           "piles of cells",     "scribbles",
    "outlines spoilt on purpose", "with bridged holes", "in two contours",
};

typedef struct tally {
    uint64_t made[ORIGINS], simple, bridged, touching, crossing, no_area;
    uint64_t polygons[METHODS], faults[METHODS][PROOF_FAULT_COUNT], named[METHODS];
    double largest_rounding; // of the area, by the outline's length
} tally;

static oracle_point points[MAX_POINTS];
static tl_contour_vertex vertices[MAX_POINTS];
static tally sums;

static uint32_t random_side(test_random *random, uint32_t least, uint32_t max_bits)
{
    uint32_t bits = test_random_below(random, max_bits);
    return least << bits;
}

static uint32_t insert_point(uint32_t n, uint32_t at, oracle_point p)
{
    memmove(points + at + 1, points + at, (n - at) * sizeof *points);
    points[at] = p;
    return n + 1;
}

// Duplicates, spikes, corners in straight runs, the wrong direction.
static uint32_t spoil(test_random *random, uint32_t n, uint32_t side)
{
    for (uint32_t times = 1 + test_random_below(random, 3); times > 0; times--) {
        uint32_t at = test_random_below(random, n);
        oracle_point p = points[at], next = points[(at + 1) % n];
        oracle_point far = { test_random_below(random, side), test_random_below(random, side) };
        oracle_point middle = { (p.x + next.x) / 2, (p.z + next.z) / 2 };
        switch (test_random_below(random, 5)) {
        case 0:
            n = insert_point(n, at, p);
            break;
        case 1: // there and back
            n = insert_point(n, at + 1, p);
            n = insert_point(n, at + 1, far);
            break;
        case 2: // a corner of its own, somewhere else
            n = insert_point(n, at + 1, far);
            break;
        case 3: // on the edge, or near it
            n = insert_point(n, at + 1, middle);
            break;
        default:
            for (uint32_t low = 0, high = n - 1; low < high; low++, high--) {
                oracle_point t = points[low];
                points[low] = points[high];
                points[high] = t;
            }
        }
    }
    return n;
}

static bool is_inside(uint32_t n, oracle_point at)
{
    bool inside = false;
    for (uint32_t i = 0; i < n; i++) {
        oracle_point a = points[i], b = points[(i + 1) % n];
        if ((a.x <= at.x) != (b.x <= at.x)) {
            // Which side of the edge, seen along rising x.
            inside ^= (oracle_area2(a, b, at) > 0) == (a.x < b.x);
        }
    }
    return inside;
}

static bool meets_outline(uint32_t n, oracle_point a, oracle_point b, const oracle_point *allowed)
{
    for (uint32_t i = 0; i < n; i++) {
        oracle_point c = points[i], d = points[(i + 1) % n];
        if ((allowed == NULL || (!oracle_same(c, *allowed) && !oracle_same(d, *allowed))) &&
            oracle_segments_meet(a, b, c, d)) {
            return true;
        }
    }
    return false;
}

// A hole inside the outline with a bridge to it, both touching nothing else. Tries a few times.
static uint32_t add_hole(test_random *random, uint32_t n, uint32_t side, bool *added)
{
    uint32_t left[MAX_POINTS];
    for (uint32_t i = 0; i < n; i++) {
        left[i] = i;
    }
    *added = false;
    for (uint32_t tries = 0; tries < 40; tries++) {
        oracle_point hole[5];
        uint32_t corners = 3 + test_random_below(random, 3), reach = 2 + test_random_below(random, 1 + side / 4);
        oracle_point at = { test_random_below(random, side), test_random_below(random, side) };
        shape_random_points(random, hole, corners, reach);
        shape_make_outer(hole, corners);
        bool good = oracle_is_simple(hole, corners);
        for (uint32_t k = 0; k < corners; k++) {
            hole[k].x += at.x;
            hole[k].z += at.z;
        }
        for (uint32_t k = 0; k < corners && good; k++) {
            good = !meets_outline(n, hole[k], hole[(k + 1) % corners], NULL);
        }
        uint32_t from = test_random_below(random, n), to = test_random_below(random, corners);
        good = good && is_inside(n, hole[0]) && oracle_in_angle(points, left, n, from, hole[to]) &&
               !meets_outline(n, points[from], hole[to], &points[from]);
        for (uint32_t k = 0; k < n && good; k++) { // a bridge along an edge
            good = !oracle_between(points[from], hole[to], points[k]) || oracle_same(points[k], points[from]);
        }
        for (uint32_t k = 0; k < corners && good; k++) {
            uint32_t next = (k + 1) % corners;
            good = k == to || next == to ? !oracle_between(points[from], hole[to], hole[k == to ? next : k])
                                         : !oracle_segments_meet(points[from], hole[to], hole[k], hole[next]);
        }
        if (good) {
            oracle_point bridge = points[from];
            n = insert_point(n, from + 1, bridge);
            // A hole runs the other way around than the outline.
            for (uint32_t k = 0; k <= corners; k++) {
                n = insert_point(n, from + 1, hole[(to + k) % corners]);
            }
            *added = true;
            return n;
        }
    }
    return n;
}

static uint32_t make_contour(test_random *random, origin kind, bool *bridged)
{
    uint32_t n = 3 + test_random_below(random, kind == SCRIBBLE ? 10 : 22);
    uint32_t side = random_side(random, 4, kind == UNTANGLED ? 28 : 11);
    *bridged = false;
    switch (kind) {
    case CELLS:
        return shape_cells(random, 2 + test_random_below(random, 7), 1 + test_random_below(random, 40), points,
                           MAX_POINTS);
    case SCRIBBLE:
        shape_random_points(random, points, n, random_side(random, 2, 12));
        return n;
    case HOLES:
        side = random_side(random, 16, 9);
        n = 4 + test_random_below(random, 9);
        if (!shape_untangled(random, points, n, side)) {
            return 0;
        }
        for (uint32_t holes = 1 + test_random_below(random, 4); holes > 0; holes--) {
            bool added;
            n = add_hole(random, n, side, &added);
            *bridged |= added;
        }
        return n;
    default:
        break;
    }
    // What stays tangled goes too, but not so large that its floor is more than doubles can hold.
    if (!shape_untangled(random, points, n, side) && (kind != UNTANGLED || side > 1u << 13)) {
        return 0;
    }
    return kind == SPOILT ? spoil(random, n, side) : n;
}

// One contour, or two that a chord inside it parts.
static uint32_t fill_contours(test_random *random, origin kind, uint32_t n, tl_contour contours[2])
{
    if (kind != HALVES) {
        return 1;
    }
    uint32_t left[MAX_POINTS];
    for (uint32_t i = 0; i < n; i++) {
        left[i] = i;
    }
    uint32_t from = test_random_below(random, n);
    for (uint32_t step = 2; step + 1 < n; step++) {
        uint32_t to = (from + step) % n;
        if (!oracle_sees(points, left, n, from, to)) {
            continue;
        }
        // Turned so that `from` is first: then `to` ends the first contour, and begins the second one, which goes on
        // to the first vertex.
        tl_contour_vertex turned[MAX_POINTS];
        for (uint32_t i = 0; i < n; i++) {
            turned[i] = vertices[(from + i) % n];
        }
        memcpy(vertices, turned, (step + 1) * sizeof *vertices);
        memcpy(vertices + step + 1, turned + step, (n - step) * sizeof *vertices);
        vertices[n + 1] = turned[0];
        contours[0].vertex_count = step + 1;
        contours[1] = contours[0];
        contours[1].first_vertex = step + 1;
        contours[1].vertex_count = n - step + 1;
        contours[1].region = 2;
        return 2;
    }
    return 1;
}

// What the polygons must cover: exactly, but where crossings are rounded to the lattice.
static bool covers(int64_t covered2, int64_t area2, uint32_t n, proof_contact contact, bool *has_floor)
{
    if (contact == PROOF_SIMPLE) {
        *has_floor = area2 > 0;
        return covered2 == (area2 > 0 ? area2 : 0);
    }
    double floor2 = proof_floor_area2(points, n);
    if (contact == PROOF_TOUCHING) {
        *has_floor = floor2 > 0.5;
        return covered2 == (int64_t)(floor2 + 0.5);
    }
    // Each point of the outline moves by less than a lattice unit's diagonal in each of a few rounds.
    double rounding = ((double)covered2 - floor2) / proof_perimeter(points, n);
    rounding = rounding < 0 ? -rounding : rounding;
    sums.largest_rounding = rounding > sums.largest_rounding ? rounding : sums.largest_rounding;
    *has_floor = floor2 > 2.0 * proof_perimeter(points, n);
    return rounding < 2.0;
}

static uint64_t count_faults(uint32_t method)
{
    uint64_t count = sums.named[method];
    for (int fault = 0; fault < PROOF_FAULT_COUNT; fault++) {
        count += sums.faults[method][fault];
    }
    return count;
}

static void print_contour(const tl_polygon_def *def, uint32_t n)
{
    printf("faulty: method %d, %u corners a polygon, contour", (int)def->method, def->max_verts_per_poly);
    for (uint32_t i = 0; i < n; i++) {
        printf(" %lld,%lld", (long long)points[i].x, (long long)points[i].z);
    }
    printf("\n");
}

static void divide(const tl_contour_set *set, const tl_polygon_def *def, uint32_t n, proof_contact contact,
                   bool is_clean)
{
    tl_polygon_mesh mesh;
    tl_polygon_report report;
    uint64_t *faults = sums.faults[def->method];
    const uint64_t faults_before = count_faults(def->method);
    TEST_RESULT(tl_polygon_mesh_bake(set, def, &mesh, &report), TL_OK);
    proof_count_faults(&mesh, faults);
    int64_t covered2 = 0;
    for (uint32_t p = 0; p < mesh.polygon_count; p++) {
        covered2 += proof_polygon_area2(&mesh, p);
        TEST_CHECK(mesh.first[p + 1] - mesh.first[p] >= 3);
        TEST_CHECK(def->max_verts_per_poly == 0 || mesh.first[p + 1] - mesh.first[p] <= def->max_verts_per_poly);
    }
    bool has_floor;
    faults[PROOF_AREA] += !covers(covered2, oracle_contour_area2(points, n), n, contact, &has_floor);
    faults[PROOF_LOST] += (has_floor && mesh.polygon_count == 0) || report.refused_contours > 0;
    // Without a fault there is no word of one, and with one the word is right.
    TEST_CHECK(!is_clean || mesh.note_count == 0);
    TEST_CHECK(mesh.note_count == 0 || mesh.notes[0].covered_area2 == covered2);
    sums.named[def->method] += tl_polygon_mesh_check(&mesh, set, NULL, NULL) != TL_OK;
    if (count_faults(def->method) > faults_before) {
        print_contour(def, n);
    }
    sums.polygons[def->method] += mesh.polygon_count;
    sums.no_area += def->method == TL_PARTITION_CLASSIC && mesh.polygon_count == 0;
    tl_polygon_mesh_free(&mesh);
}

static void sweep_contour(test_random *random, origin kind)
{
    static const uint32_t caps[8] = { 6, 3, 4, 5, 0, 6, 12, 64 };
    bool bridged;
    uint32_t n = make_contour(random, kind, &bridged);
    if (n == 0) {
        return;
    }
    proof_contact contact = proof_find_contact(points, n);
    // On both sides of zero, and far away where no doubles are needed to prove it.
    int64_t shift = contact == PROOF_SIMPLE ? test_random_below(random, 2) * test_random_below(random, 1u << 27) : 0;
    for (uint32_t i = 0; i < n; i++) {
        points[i].x -= shift;
        points[i].z -= shift;
    }
    tl_contour contours[2];
    tl_contour_set set = shape_as_set(points, n, vertices, contours);
    if (kind == HALVES && contact != PROOF_SIMPLE) {
        return;
    }
    set.contour_count = fill_contours(random, kind, n, contours);
    set.vertex_count = n + (set.contour_count == 2 ? 2 : 0);
    bool is_clean = bridged || (contact == PROOF_SIMPLE && oracle_contour_area2(points, n) > 0);
    sums.made[kind] += set.contour_count;
    sums.bridged += bridged;
    sums.simple += contact == PROOF_SIMPLE ? set.contour_count : 0;
    sums.touching += contact == PROOF_TOUCHING && !bridged;
    sums.crossing += contact == PROOF_CROSSING;
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = caps[test_random_below(random, 8)];
    // Merging of two contours makes polygons of both, whose areas no note splits.
    def.drop_straight_vertices = set.contour_count == 1 && test_random_below(random, 4) == 0;
    for (int method = 0; method < METHODS; method++) {
        def.method = (tl_partition_method)method;
        divide(&set, &def, n, contact, is_clean);
    }
}

static uint64_t total_made(void)
{
    uint64_t total = 0;
    for (int kind = 0; kind < ORIGINS; kind++) {
        total += sums.made[kind];
    }
    return total;
}

static void print_tally(void)
{
    static const char *const methods[METHODS] = { "classic", "optimal", "delaunay" };
    printf("%llu contours\n", (unsigned long long)total_made());
    for (int kind = 0; kind < ORIGINS; kind++) {
        printf("  %9llu %s\n", (unsigned long long)sums.made[kind], origin_names[kind]);
    }
    printf(
        "of these %llu simple, %llu with bridges, %llu that touch themselves, %llu that cross themselves; %llu hold no "
        "floor\n",
        (unsigned long long)sums.simple, (unsigned long long)sums.bridged, (unsigned long long)sums.touching,
        (unsigned long long)sums.crossing, (unsigned long long)sums.no_area);
    printf("%-9s %10s", "method", "polygons");
    for (int fault = 0; fault < PROOF_FAULT_COUNT; fault++) {
        printf(" %11s", proof_fault_names[fault]);
    }
    printf(" %11s\n", "validator");
    for (int method = 0; method < METHODS; method++) {
        printf("%-9s %10llu", methods[method], (unsigned long long)sums.polygons[method]);
        for (int fault = 0; fault < PROOF_FAULT_COUNT; fault++) {
            printf(" %11llu", (unsigned long long)sums.faults[method][fault]);
        }
        printf(" %11llu\n", (unsigned long long)sums.named[method]);
    }
    printf("rounding of crossings moved the area by at most %.3f of half the outline's length\n",
           sums.largest_rounding);
}

static void no_contour_goes_wrong(void **state)
{
    (void)state;
    test_random random = { 2026 };
    for (uint32_t round = 0; total_made() < contours_asked; round++) {
        sweep_contour(&random, (origin)(round % ORIGINS));
    }
    print_tally();
    for (int method = 0; method < METHODS; method++) {
        for (int fault = 0; fault < PROOF_FAULT_COUNT; fault++) {
            TEST_CHECK(sums.faults[method][fault] == 0);
        }
        TEST_CHECK(sums.named[method] == 0 && sums.polygons[method] > contours_asked);
    }
    uint64_t enough = contours_asked / 50;
    TEST_CHECK(sums.simple > enough && sums.bridged > enough && sums.touching > enough && sums.crossing > enough &&
               sums.no_area > enough / 10);
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        contours_asked = (uint32_t)strtoul(argv[1], NULL, 10);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_contour_goes_wrong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
