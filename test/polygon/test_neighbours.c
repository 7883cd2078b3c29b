// SPDX-License-Identifier: MIT

#include "polygon/mesh/polygon_store.h"
#include "polygon_proof.h"
#include "polygon_shapes.h"

typedef struct fixture {
    tl_arena arena;
    tl_polygon_store store;
    tl_contour_set set;
    tl_polygon_report report;
} fixture;

static void begin(fixture *f)
{
    memset(f, 0, sizeof *f);
    tl_arena_init(&f->arena, NULL);
    const tl_polygon_def def = tl_default_polygon_def();
    TEST_RESULT(tl_polygon_store_init(&f->store, &f->arena, &def, 4), TL_OK);
}

static uint32_t vertex(fixture *f, int32_t x, int32_t y, int32_t z)
{
    uint32_t index = 0;
    TEST_RESULT(tl_polygon_store_vertex(&f->store, x, y, z, false, &index), TL_OK);
    return index;
}

// A unit square, its corners in the contours' direction: left, upper, right, lower edge.
static void add_square(fixture *f, int32_t x, int32_t y, int32_t z)
{
    const uint32_t corners[4] = { vertex(f, x, y, z), vertex(f, x, y, z + 1), vertex(f, x + 1, y, z + 1),
                                  vertex(f, x + 1, y, z) };
    const tl_stored_polygon of = { 0, 0, 1, 63, 0 };
    TEST_RESULT(tl_polygon_store_add(&f->store, corners, 4, NULL, &of), TL_OK);
}

static void link(fixture *f)
{
    TEST_RESULT(tl_link_neighbours(&f->store, &f->arena, &f->set, &f->report), TL_OK);
}

static bool links_are(const fixture *f, uint32_t polygon, uint32_t left, uint32_t upper, uint32_t right, uint32_t lower)
{
    const uint32_t *n = f->store.neighbours + f->store.polygons[polygon].first;
    return n[0] == left && n[1] == upper && n[2] == right && n[3] == lower;
}

static void edges_run_along_in_opposite_directions_are_linked(void **state)
{
    (void)state;
    const uint32_t none = TL_NO_POLYGON;
    fixture f;
    begin(&f);
    add_square(&f, 0, 0, 0);
    add_square(&f, 1, 0, 0);
    add_square(&f, 1, 0, 1);
    add_square(&f, 2, 9, 0); // on another floor
    link(&f);
    TEST_CHECK(links_are(&f, 0, none, none, 1, none) && links_are(&f, 1, 0, 2, none, none));
    TEST_CHECK(links_are(&f, 2, none, none, none, 1) && links_are(&f, 3, none, none, none, none));
    TEST_CHECK(f.report.link_count == 2 && f.report.portal_count == 0 && f.report.non_manifold_edges == 0);
    tl_arena_free(&f.arena);
}

static void sides_of_a_tile_are_portals(void **state)
{
    (void)state;
    const uint32_t none = TL_NO_POLYGON;
    fixture f;
    begin(&f);
    f.set.width = 2;
    f.set.height = 1;
    f.set.border_size = 3;
    add_square(&f, 0, 0, 0);
    add_square(&f, 1, 0, 0);
    link(&f);
    TEST_CHECK(links_are(&f, 0, TL_PORTAL | 0u, TL_PORTAL | 1u, 1, TL_PORTAL | 3u));
    TEST_CHECK(links_are(&f, 1, 0, TL_PORTAL | 1u, TL_PORTAL | 2u, TL_PORTAL | 3u));
    TEST_CHECK(f.report.link_count == 1 && f.report.portal_count == 6);
    tl_arena_free(&f.arena);
    // Without a border there is no tile to go on to.
    begin(&f);
    f.set.width = 1;
    f.set.height = 1;
    add_square(&f, 0, 0, 0);
    link(&f);
    TEST_CHECK(links_are(&f, 0, none, none, none, none) && f.report.portal_count == 0);
    tl_arena_free(&f.arena);
}

// Floors upon each other: of each direction the earliest claims are linked, pair by pair; the others are counted.
static void crowded_edges_are_counted(void **state)
{
    (void)state;
    const uint32_t none = TL_NO_POLYGON;
    fixture f;
    begin(&f);
    add_square(&f, 0, 0, 0);
    add_square(&f, 0, 0, 0);
    add_square(&f, 1, 0, 0);
    link(&f);
    // Four edges of the doubled square are claimed twice in one direction.
    TEST_CHECK(links_are(&f, 0, none, none, 2, none) && links_are(&f, 1, none, none, none, none));
    TEST_CHECK(links_are(&f, 2, 0, none, none, none) && f.report.link_count == 1 && f.report.non_manifold_edges > 0);
    tl_arena_free(&f.arena);
    begin(&f);
    add_square(&f, 0, 0, 0);
    add_square(&f, 0, 0, 0);
    add_square(&f, 1, 0, 0);
    add_square(&f, 1, 0, 0);
    link(&f);
    TEST_CHECK(links_are(&f, 0, none, none, 2, none) && links_are(&f, 1, none, none, 3, none));
    TEST_CHECK(links_are(&f, 2, 0, none, none, none) && links_are(&f, 3, 1, none, none, none));
    tl_arena_free(&f.arena);
}

// Piles of random cells: every link against a search of all edges.
static void random_cells_link_as_a_search_says(void **state)
{
    (void)state;
    test_random random = { 71 };
    uint64_t links = 0;
    for (uint32_t round = 0; round < 200; round++) {
        bool used[8][8];
        memset(used, 0, sizeof used);
        fixture f;
        begin(&f);
        for (uint32_t i = 1 + test_random_below(&random, 50); i > 0; i--) {
            uint32_t x = test_random_below(&random, 8), z = test_random_below(&random, 8);
            if (!used[x][z]) {
                used[x][z] = true;
                add_square(&f, (int32_t)x, (int32_t)(3 * ((x + z) % 5 == 0)), (int32_t)z);
            }
        }
        link(&f);
        tl_polygon_mesh mesh;
        memset(&mesh, 0, sizeof mesh);
        mesh.polygon_count = f.store.polygon_count;
        mesh.vertex_count = f.store.vertex_count;
        mesh.indices = f.store.indices;
        mesh.neighbours = f.store.neighbours;
        mesh.vertices = f.store.vertices;
        uint32_t first[65];
        for (uint32_t p = 0; p <= mesh.polygon_count; p++) {
            first[p] = 4 * p;
        }
        mesh.first = first;
        for (uint32_t p = 0; p < mesh.polygon_count; p++) {
            for (uint32_t k = 4 * p; k < 4 * p + 4; k++) {
                TEST_CHECK(mesh.neighbours[k] == proof_across(&mesh, p, k));
            }
        }
        links += f.report.link_count;
        TEST_CHECK(f.report.non_manifold_edges == 0);
        tl_arena_free(&f.arena);
    }
    TEST_CHECK(links > 1000);
}

// An edge by the doubled place of its middle: on a lattice of triangles no two edges have the same one.
typedef struct placed_edge {
    int64_t middle;
    uint32_t polygon, neighbour;
} placed_edge;

static int by_middle(const void *a, const void *b)
{
    const placed_edge *x = a, *y = b;
    return (x->middle > y->middle) - (x->middle < y->middle);
}

// Far beyond 16 bits: 304,200 polygons of 152,100 contours, 152,881 vertices, 457,080 edges. Links are proved by place,
// not by vertex number.
static void three_hundred_thousand_polygons_are_linked_right(void **state)
{
    (void)state;
    enum { ACROSS = 390, SQUARES = ACROSS * ACROSS };
    tl_contour_vertex *corners = malloc(4 * SQUARES * sizeof *corners);
    tl_contour *contours = malloc(SQUARES * sizeof *contours);
    placed_edge *edges = malloc(6 * SQUARES * sizeof *edges);
    test_random random = { 17 };
    for (uint32_t i = 0; i < SQUARES; i++) {
        contours[i].first_vertex = 4 * i;
    }
    // In random order, so that neighbours are far apart in the mesh.
    for (uint32_t i = SQUARES; i-- > 1;) {
        uint32_t j = test_random_below(&random, i + 1), t = contours[i].first_vertex;
        contours[i].first_vertex = contours[j].first_vertex;
        contours[j].first_vertex = t;
    }
    for (int32_t i = 0; i < SQUARES; i++) {
        int32_t x = 2 * (i % ACROSS), z = 2 * (i / ACROSS);
        const tl_contour_vertex square[4] = {
            { x, 0, z, 0 }, { x, 0, z + 2, 0 }, { x + 2, 0, z + 2, 0 }, { x + 2, 0, z, 0 }
        };
        memcpy(corners + 4 * i, square, sizeof square);
        contours[i].vertex_count = 4;
        contours[i].region = (uint32_t)i + 1;
        contours[i].area = 63;
    }
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = corners;
    set.vertex_count = 4 * SQUARES;
    set.contours = contours;
    set.contour_count = SQUARES;
    set.cell_size = set.cell_height = 1.0f;
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = 3;
    tl_polygon_mesh mesh;
    tl_polygon_report report;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, &report), TL_OK);
    TEST_CHECK(mesh.polygon_count == 2 * SQUARES && mesh.vertex_count == (ACROSS + 1) * (ACROSS + 1));
    TEST_CHECK(report.link_count == SQUARES + 2 * ACROSS * (ACROSS - 1) && report.non_manifold_edges == 0);
    for (uint32_t p = 0; p < mesh.polygon_count; p++) {
        for (uint32_t k = mesh.first[p]; k < mesh.first[p + 1]; k++) {
            oracle_point a = proof_corner(&mesh, k), b = proof_corner(&mesh, proof_next(&mesh, p, k));
            placed_edge edge = { (a.x + b.x) << 32 | (a.z + b.z), p, mesh.neighbours[k] };
            edges[k] = edge;
        }
    }
    qsort(edges, mesh.index_count, sizeof *edges, by_middle);
    uint32_t open = 0;
    for (uint32_t i = 0; i < mesh.index_count;) {
        bool is_shared = i + 1 < mesh.index_count && edges[i].middle == edges[i + 1].middle;
        if (is_shared) {
            TEST_CHECK(edges[i].neighbour == edges[i + 1].polygon && edges[i + 1].neighbour == edges[i].polygon);
        } else {
            TEST_CHECK(edges[i].neighbour == TL_NO_POLYGON);
            open++;
        }
        i += is_shared ? 2 : 1;
    }
    TEST_CHECK(open == 4 * ACROSS);
    TEST_RESULT(tl_polygon_mesh_check(&mesh, &set, NULL, NULL), TL_OK);
    tl_polygon_mesh_free(&mesh);
    free(corners);
    free(contours);
    free(edges);
}

static void memory_may_run_out(void **state)
{
    (void)state;
    uint32_t failures = 0;
    for (uint64_t fail_at = 1;; fail_at++) {
        fixture f;
        begin(&f);
        for (int32_t x = 0; x < 2000; x++) {
            add_square(&f, x, 0, 0);
        }
        test_allocator allocator;
        test_allocator_init(&allocator, fail_at);
        tl_arena scratch;
        tl_arena_init(&scratch, &allocator.allocator);
        tl_result result = tl_link_neighbours(&f.store, &scratch, &f.set, &f.report);
        tl_arena_free(&scratch);
        tl_arena_free(&f.arena);
        TEST_CHECK(allocator.live_blocks == 0);
        if (result == TL_OK) {
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
        failures++;
    }
    TEST_CHECK(failures >= 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_run_along_in_opposite_directions_are_linked),
        cmocka_unit_test(sides_of_a_tile_are_portals),
        cmocka_unit_test(crowded_edges_are_counted),
        cmocka_unit_test(random_cells_link_as_a_search_says),
        cmocka_unit_test(three_hundred_thousand_polygons_are_linked_right),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
