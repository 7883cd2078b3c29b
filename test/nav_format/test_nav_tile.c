// SPDX-License-Identifier: MIT
//
// The baked tile: what goes in comes out, bad sources are refused by name, and no bytes upset the check.

#include "nav_fixture.h"

#include "base/byte_order.h"

#include <math.h>

static const char *const ROOM[] = { "00#0", "0000", "#r..", "0.1." };

static void test_example(void **state)
{
    (void)state;
    fixture_level level = fixture_make(ROOM, 4);
    level.cell_size = 0.3f;
    level.origin = tl_vec3_make(1000.1f, -3.0f, 2000.7f);
    tl_nav_tile *tile = fixture_build_tile(&level, 0, 0, NULL);
    TEST_CHECK(tile->polygon_count == 18); // open cells, both floors counted
    TEST_CHECK(tile->portal_count == 0);
    double expected = 18 * (FIXTURE_STEP * (double)0.3f) * (FIXTURE_STEP * (double)0.3f);
    TEST_CHECK(fabs(tile->area - expected) < 1e-9 * expected);
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, 0, &count);
    TEST_CHECK(count == 4);
    TEST_CHECK(corners[0].x == 1000.1f && corners[0].y == -3.0f && corners[0].z == 2000.7f);
    TEST_CHECK(corners[2].x == (float)((double)1000.1f + 16 * (double)0.3f));
    TEST_CHECK(tl_nav_tile_neighbour(tile, 0, 0) == TL_NO_POLYGON);
    TEST_CHECK(tl_nav_tile_neighbour(tile, 0, 2) == 1);
    TEST_CHECK(tl_nav_tile_lattice(tile, 0, 2).at[0] == FIXTURE_STEP &&
               tl_nav_tile_lattice(tile, 0, 2).at[2] == FIXTURE_STEP);
    TEST_CHECK(tl_nav_tile_area(tile, 0) == TL_NAV_MAX_AREA && tl_nav_tile_flags(tile, 0) == 1);
    tl_nav_surface surface = tl_nav_tile_surface(tile, 0);
    TEST_CHECK(surface.vertex_count == 4 && surface.triangle_count == 2);
    tl_blob_free(tile);
}

static void test_portals(void **state)
{
    (void)state;
    fixture_level level = fixture_make(ROOM, 4);
    level.tile_cells = 2;
    tl_nav_tile *tile = fixture_build_tile(&level, 0, 0, NULL);
    TEST_CHECK(tile->portal_count == 8); // 2 x 2 open cells: two a side
    for (uint32_t side = 0; side < 4; side++) {
        TEST_CHECK(tl_nav_tile_side_first(tile, side + 1) - tl_nav_tile_side_first(tile, side) == 2);
        const tl_nav_portal *portal = tl_nav_tile_portals(tile) + tl_nav_tile_side_first(tile, side);
        TEST_CHECK(portal[0].low == 0 && portal[0].high == 16 && portal[1].low == 16 && portal[1].high == 32);
        uint32_t first = tl_nav_tile_first_corner(tile, portal->polygon);
        TEST_CHECK(tl_nav_tile_neighbour(tile, portal->polygon, portal->corner - first) == (TL_PORTAL | side));
    }
    tl_blob_free(tile);
}

// A vertex of the detail mesh in the middle of a portal edge makes a bend in its profile.
static void test_profile(void **state)
{
    (void)state;
    const char *const rows[] = { "0" };
    fixture_level level = fixture_make(rows, 1);
    level.tile_cells = 1;
    level.detail = true;
    fixture_mesh mesh = fixture_build_mesh(&level, 0, 0);
    mesh.detail.vertices[4] = tl_vec3_make(0.0f, 3.0f, 1.0f); // on side 0, 4 lattice units along z
    tl_nav_tile_source source = fixture_source(&mesh);
    tl_nav_tile *tile = NULL;
    TEST_RESULT(tl_nav_tile_encode(&source, NULL, &tile, NULL), TL_OK);
    uint32_t counts[2];
    const tl_nav_profile_point *profile = tl_nav_tile_profile(tile, 0, &counts[0]);
    tl_nav_tile_profile(tile, 1, &counts[1]);
    TEST_CHECK(counts[0] == 1 && counts[1] == 0 && tile->profile_count == 1);
    TEST_CHECK(profile[0].along == 4.0f && profile[0].height == 3.0f);
    tl_blob_free(tile);
    fixture_free_mesh(&mesh);
}

// A tile with wider elements where it needs them: it says what it was made from, can be taken apart, has the other byte
// order and back, and is refused where it says another width than it needs.
static void check_widths(const fixture_mesh *mesh, uint32_t expected)
{
    uint64_t flags[32] = { 1, 255 };
    flags[2] = (expected & TL_NAV_WIDE_FLAGS) != 0 ? (uint64_t)1 << 63 | 256 : 7;
    tl_nav_tile_source source = fixture_source(mesh);
    TEST_CHECK(source.polygons->polygon_count <= sizeof flags / sizeof flags[0]);
    source.flags = flags;
    const tl_polygon_mesh *polygons = source.polygons;
    tl_nav_tile *tile = NULL, *again = NULL;
    TEST_RESULT(tl_nav_tile_encode(&source, NULL, &tile, NULL), TL_OK);
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_OK);
    TEST_CHECK(tile->wide == expected);
    for (uint32_t k = 0; k < polygons->index_count; k++) {
        const tl_nav_lattice_point at = tl_nav_tile_vertex(tile, tl_nav_tile_corner_vertex(tile, k));
        TEST_CHECK(memcmp(at.at, polygons->vertices + 3 * (size_t)polygons->indices[k], sizeof at.at) == 0);
    }
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        const tl_nav_surface surface = tl_nav_tile_surface(tile, p);
        TEST_CHECK(tl_nav_tile_flags(tile, p) == flags[p]);
        TEST_CHECK(surface.vertex_count == source.detail->patches[p].vertex_count);
        for (uint32_t i = 0; i < surface.triangle_count; i++) {
            const tl_nav_detail_triangle triangle = tl_nav_surface_triangle(&surface, i);
            TEST_CHECK(memcmp(&triangle, source.detail->triangles + source.detail->patches[p].first_triangle + i,
                              sizeof triangle) == 0);
        }
    }
    uint8_t *keep = malloc(tile->polygon_count);
    memset(keep, 1, tile->polygon_count);
    TEST_RESULT(tl_nav_tile_subset(tile, keep, NULL, &again, NULL), TL_OK);
    tl_byte_swap swap = { (uint8_t *)tile, tile->blob.size, false, true };
    tl_nav_tile_swap_words(&swap);
    TEST_CHECK(swap.fits && tile->blob.size != swap.size);
    swap.to_host = true;
    tl_nav_tile_swap_words(&swap);
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_OK);
    TEST_RESULT(tl_nav_tile_check(again, again->blob.size, NULL), TL_OK);
    TEST_CHECK(again->wide == (expected & ~TL_NAV_WIDE_CORNERS)); // without vertices that no polygon has
    for (uint32_t bit = 1; bit <= TL_NAV_WIDE_FIRSTS; bit *= 2) {
        tile->wide ^= bit;
        TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_ERR_CORRUPT);
        tile->wide ^= bit;
    }
    tile->wide |= 2 * TL_NAV_WIDE_FIRSTS;
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_ERR_CORRUPT);
    tile->wide = expected;
    tl_report report;
    tile->cell_height = 0.9f * TL_NAV_MIN_CELL;
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, &report), TL_ERR_CORRUPT);
    assert_string_equal(report.element, "header");
    free(keep);
    tl_blob_free(again);
    tl_blob_free(tile);
}

static void test_widths(void **state)
{
    (void)state;
    fixture_level level = fixture_make(ROOM, 4);
    level.detail = true;
    for (uint32_t kind = 0; kind < 16; kind++) {
        const uint32_t wide = kind % 8 + kind / 8 * TL_NAV_WIDE_FLAGS;
        fixture_mesh mesh = fixture_build_mesh(&level, 0, 0);
        if ((wide & TL_NAV_WIDE_TRIANGLES) != 0) {
            // A patch that uses one more vertex than bytes tell apart.
            tl_nav_detail_patch *patch = &mesh.detail.patches[2];
            const uint32_t first = mesh.detail.vertex_count, before = patch->vertex_count;
            mesh.detail.vertices = realloc(mesh.detail.vertices, (first + 257u) * sizeof *mesh.detail.vertices);
            memcpy(mesh.detail.vertices + first, mesh.detail.vertices + patch->first_vertex,
                   before * sizeof *mesh.detail.vertices);
            for (uint32_t i = before; i < 257; i++) {
                mesh.detail.vertices[first + i] = mesh.detail.vertices[first + before - 1];
            }
            mesh.detail.vertex_count += 257;
            patch->first_vertex = first;
            patch->vertex_count = 257;
            mesh.detail.triangles[patch->first_triangle].corner[2] = 256;
        }
        if ((wide & TL_NAV_WIDE_LATTICE) != 0) {
            for (uint32_t i = 0; i < mesh.mesh.vertex_count; i++) {
                mesh.mesh.vertices[3 * (size_t)i] +=
                    (wide & TL_NAV_WIDE_CORNERS) == 0 ? -3 : UINT16_MAX - 8; // below, or above
            }
        }
        if ((wide & TL_NAV_WIDE_CORNERS) != 0) {
            const uint32_t count = UINT16_MAX + 2u;
            mesh.mesh.vertices = realloc(mesh.mesh.vertices, 3 * (size_t)count * sizeof *mesh.mesh.vertices);
            memset(mesh.mesh.vertices + 3 * (size_t)mesh.mesh.vertex_count, 0,
                   3 * (size_t)(count - mesh.mesh.vertex_count) * sizeof *mesh.mesh.vertices);
            memcpy(mesh.mesh.vertices + 3 * (size_t)(count - 1), mesh.mesh.vertices + 3 * (size_t)mesh.mesh.indices[0],
                   3 * sizeof *mesh.mesh.vertices);
            mesh.mesh.vertex_count = count;
        }
        check_widths(&mesh, wide);
        fixture_free_mesh(&mesh);
    }
}

// A copy has the tile's bytes, or flags of 64 bits and all else as it was.
static void test_copies(void **state)
{
    (void)state;
    fixture_level level = fixture_make(ROOM, 4);
    tl_nav_tile *tile = fixture_build_tile(&level, 0, 0, NULL), *copy = NULL, *wide = NULL;
    TEST_RESULT(tl_nav_tile_copy(tile, false, NULL, &copy), TL_OK);
    TEST_CHECK(copy->blob.size == tile->blob.size && memcmp(copy, tile, tile->blob.size) == 0);
    TEST_RESULT(tl_nav_tile_copy(tile, true, NULL, &wide), TL_OK);
    TEST_CHECK(wide->wide == (tile->wide | TL_NAV_WIDE_FLAGS));
    TEST_RESULT(tl_nav_tile_check(wide, wide->blob.size, NULL), TL_OK);
    tl_nav_tile_set_flags(wide, 1, UINT64_MAX);
    TEST_RESULT(tl_nav_tile_check(wide, wide->blob.size, NULL), TL_OK);
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        TEST_CHECK(tl_nav_tile_flags(wide, p) == (p == 1 ? UINT64_MAX : tl_nav_tile_flags(tile, p)));
        TEST_CHECK(tl_nav_tile_area(wide, p) == tl_nav_tile_area(tile, p));
    }
    tl_blob_free(wide);
    TEST_RESULT(tl_nav_tile_copy(copy, true, NULL, &wide), TL_OK);
    tl_blob_free(copy);
    TEST_RESULT(tl_nav_tile_copy(wide, false, NULL, &copy), TL_OK); // it keeps them
    TEST_CHECK(copy->blob.size == wide->blob.size && memcmp(copy, wide, wide->blob.size) == 0);
    tl_blob_free(copy);
    tl_blob_free(wide);
    tl_blob_free(tile);
}

static void refuse(fixture_mesh *mesh, const tl_nav_tile_source *source, tl_result expected, const char *name)
{
    tl_nav_tile *tile = NULL;
    tl_report report;
    TEST_RESULT(tl_nav_tile_encode(source, NULL, &tile, &report), expected);
    TEST_CHECK(tile == NULL);
    assert_string_equal(report.field != NULL ? report.field : report.element, name);
    fixture_free_mesh(mesh);
}

#define REFUSE(change, expected, element)                                                                              \
    do {                                                                                                               \
        fixture_mesh m = fixture_build_mesh(&level, 0, 0);                                                             \
        tl_nav_tile_source s = fixture_source(&m);                                                                     \
        change;                                                                                                        \
        refuse(&m, &s, expected, element);                                                                             \
    } while (0)

static void test_bad_sources(void **state)
{
    (void)state;
    fixture_level level = fixture_make(ROOM, 4);
    level.detail = true;
    REFUSE(m.mesh.polygon_count = 0, TL_ERR_EMPTY, "polygon");
    REFUSE(m.mesh.cell_size = 0.0f, TL_ERR_ARGUMENT, "cell_size");
    REFUSE(m.mesh.cell_height = NAN, TL_ERR_ARGUMENT, "cell_height");
    REFUSE(m.mesh.cell_size = 0.9f * TL_NAV_MIN_CELL, TL_ERR_ARGUMENT, "cell_size");
    REFUSE(m.mesh.cell_height = 0.9f * TL_NAV_MIN_CELL, TL_ERR_ARGUMENT, "cell_height");
    REFUSE(s.agent_height = 0.0f, TL_ERR_ARGUMENT, "agent_height");
    REFUSE(s.agent_max_climb = -1.0f, TL_ERR_ARGUMENT, "agent_max_climb");
    REFUSE(s.tile_x = 1, TL_ERR_ARGUMENT, "tile_x"); // without a tile size
    REFUSE(s.origin.x += 0.2f, TL_ERR_ARGUMENT, "origin");
    REFUSE(s.origin.x = NAN, TL_ERR_NOT_FINITE, "origin");
    REFUSE(m.mesh.vertices[7] = TL_MAX_CONTOUR_COORDINATE + 1, TL_ERR_RANGE, "vertex");
    REFUSE(m.mesh.first[1] = 2, TL_ERR_INDEX, "polygon");
    REFUSE(m.mesh.indices[0] = m.mesh.vertex_count, TL_ERR_INDEX, "polygon");
    REFUSE(m.mesh.indices[0] = m.mesh.indices[2], TL_ERR_DEGENERATE, "polygon");
    REFUSE(m.mesh.indices[1] = m.mesh.indices[3], TL_ERR_DEGENERATE, "polygon");
    uint32_t swap = 0;
    REFUSE((swap = m.mesh.indices[1], m.mesh.indices[1] = m.mesh.indices[3], m.mesh.indices[3] = swap), TL_ERR_WINDING,
           "polygon");
    REFUSE(m.mesh.vertices[0] += FIXTURE_STEP - 1; m.mesh.vertices[2] += FIXTURE_STEP - 1, TL_ERR_WINDING, "polygon");
    REFUSE(m.mesh.areas[3] = 0, TL_ERR_ARGUMENT, "polygon");
    REFUSE(m.mesh.areas[3] = 256, TL_ERR_ARGUMENT, "polygon");
    REFUSE(m.mesh.neighbours[2] = 2, TL_ERR_NON_MANIFOLD, "polygon");
    REFUSE(m.mesh.neighbours[2] = 999, TL_ERR_INDEX, "polygon");
    REFUSE(m.mesh.neighbours[2] = TL_PORTAL | 4, TL_ERR_INDEX, "polygon");
    REFUSE(m.detail.patch_count--, TL_ERR_ARGUMENT, "detail");
    REFUSE(m.detail.patches[1].vertex_count = 3, TL_ERR_INDEX, "patch");
    REFUSE(m.detail.patches[1].triangle_count = 0, TL_ERR_INDEX, "patch");
    REFUSE(m.detail.patches[1].first_vertex = 4000, TL_ERR_INDEX, "patch");
    REFUSE(m.detail.vertices[9].y = NAN, TL_ERR_NOT_FINITE, "patch");
    REFUSE(m.detail.vertices[9].y = 1e13f, TL_ERR_RANGE, "patch");
    REFUSE(m.detail.triangles[0].corner[1] = 5, TL_ERR_INDEX, "patch");
}

// Link every neighbour pair by vertices; contained boxes; seams of random tiles have equal bits on both sides.
static void test_random_tiles(void **state)
{
    (void)state;
    test_random random = { 11 };
    uint32_t shared_vertices = 0;
    for (uint32_t round = 0; round < 40; round++) {
        fixture_level level = fixture_random(&random, round % 6, 8);
        level.tile_cells = 4;
        level.shake = 0; // so that border vertices of both tiles coincide
        level.origin =
            tl_vec3_make(test_random_range(&random, -9000, 9000), 0, test_random_range(&random, -9000, 9000));
        level.cell_size = test_random_range(&random, 0.05f, 0.7f);
        tl_nav_tile *a = fixture_build_tile(&level, 0, 0, NULL);
        tl_nav_tile *b = fixture_build_tile(&level, 1, 0, NULL);
        for (uint32_t i = 0; a != NULL && b != NULL && i < a->corner_count; i++) {
            tl_vec3 corner = fixture_corner(a, i);
            for (uint32_t k = 0; k < b->corner_count; k++) {
                tl_vec3 other = fixture_corner(b, k);
                if (tl_distance(corner, other) < 0.5f * level.cell_size) {
                    TEST_CHECK(memcmp(&corner, &other, sizeof corner) == 0);
                    shared_vertices++;
                }
            }
        }
        tl_blob_free(a);
        tl_blob_free(b);
    }
    TEST_CHECK(shared_vertices > 200);
}

// Boxes of the tree hold what lies below, near the origin and far from it, and no side of a leaf's is a step too far
// out.
static void test_boxes(void **state)
{
    (void)state;
    test_random random = { 12 };
    const float fars[4] = { 0.0f, 1e3f, -3e5f, 2e7f }, cells[3] = { 0.3f, 1e-3f, 50.0f };
    uint32_t flat = 0, loose = 0, sides = 0;
    for (uint32_t round = 0; round < 48; round++) {
        fixture_level level = fixture_random(&random, round % 6, 8);
        level.origin = tl_vec3_make(fars[round % 4], fars[round / 4 % 4], -fars[round % 4]);
        level.cell_size = cells[round % 3];
        tl_nav_tile *tile = fixture_build_tile(&level, 0, 0, NULL);
        const tl_nav_tile_node *nodes = tl_nav_tile_nodes(tile);
        const tl_vec3 step = tl_nav_tile_node_steps(tile);
        flat += step.y == 0.0f;
        for (uint32_t i = tile->node_count; i-- > 0;) {
            const tl_aabb box = tl_nav_tile_node_box(tile, &nodes[i]);
            if ((nodes[i].link & TL_NAV_NODE_LEAF) == 0) {
                const tl_aabb a = tl_nav_tile_node_box(tile, &nodes[i + 1]);
                const tl_aabb b = tl_nav_tile_node_box(tile, &nodes[tl_nav_tile_node_skip(nodes, i + 1)]);
                const tl_aabb both = tl_aabb_union(a, b);
                TEST_CHECK(memcmp(&both, &box, sizeof box) == 0);
                continue;
            }
            const tl_nav_surface surface = tl_nav_tile_surface(tile, nodes[i].link & ~TL_NAV_NODE_LEAF);
            tl_aabb own = tl_aabb_empty();
            for (uint32_t k = 0; k < surface.vertex_count; k++) {
                own = tl_aabb_add_point(own, surface.vertices[k]);
            }
            TEST_CHECK(tl_aabb_contains(box, own.min) && tl_aabb_contains(box, own.max));
            tl_nav_tile_node inner = nodes[i];
            inner.min[0]++;
            inner.max[2]--;
            const tl_aabb within = tl_nav_tile_node_box(tile, &inner);
            loose += (step.x > 0.0f && nodes[i].min[0] < UINT16_MAX && within.min.x <= own.min.x) ||
                     (step.z > 0.0f && nodes[i].max[2] > 0 && within.max.z >= own.max.z);
            sides++;
        }
        TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_OK);
        tile->node_steps ^= 1u << round % 32;
        TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_ERR_CORRUPT);
        tl_blob_free(tile);
    }
    TEST_CHECK(flat > 0 && sides > 500 && loose == 0);
}

static void test_same_bytes(void **state)
{
    (void)state;
    test_random random = { 5 };
    fixture_level level = fixture_random(&random, 5, 10);
    tl_nav_tile *a = fixture_build_tile(&level, 0, 0, NULL);
    test_allocator counting;
    test_allocator_init(&counting, 0);
    tl_nav_tile *b = fixture_build_tile(&level, 0, 0, &counting.allocator);
    TEST_CHECK(a->blob.size == b->blob.size && memcmp(a, b, a->blob.size) == 0);
    tl_blob_free(b);
    TEST_CHECK(counting.live_blocks == 0);
    tl_blob_free(a);
}

static void test_memory(void **state)
{
    (void)state;
    test_random random = { 6 };
    fixture_level level = fixture_random(&random, 5, 6);
    level.tile_cells = 6;
    level.detail = true;
    fixture_mesh mesh = fixture_build_mesh(&level, 0, 0);
    tl_nav_tile_source source = fixture_source(&mesh);
    uint32_t failures = 0;
    for (uint64_t k = 1;; k++) {
        test_allocator failing;
        test_allocator_init(&failing, k);
        tl_nav_tile *tile = NULL;
        tl_result result = tl_nav_tile_encode(&source, &failing.allocator, &tile, NULL);
        if (result == TL_OK) {
            tl_blob_free(tile);
            TEST_CHECK(failing.live_blocks == 0);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
        TEST_CHECK(tile == NULL && failing.live_blocks == 0);
        failures++;
    }
    TEST_CHECK(failures >= 2);
    fixture_free_mesh(&mesh);
}

static void test_truncated(void **state)
{
    (void)state;
    fixture_level level = fixture_make(ROOM, 2);
    level.tile_cells = 2;
    tl_nav_tile *tile = fixture_build_tile(&level, 0, 0, NULL);
    for (uint64_t size = 0; size < tile->blob.size; size++) {
        // A copy of exactly this size, so that a sanitizer sees a read beyond it.
        void *copy = malloc(size > 0 ? size : 1);
        memcpy(copy, tile, size);
        TEST_RESULT(tl_nav_tile_check(copy, size, NULL), TL_ERR_TRUNCATED);
        free(copy);
    }
    tl_blob_free(tile);
}

// A flipped bit is either refused, or it changed a value that may have any value; then every query must still be safe.
static void test_bit_flips(void **state)
{
    (void)state;
    fixture_level level = fixture_make(ROOM, 3);
    level.tile_cells = 3;
    level.detail = true;
    tl_nav_tile *tile = fixture_build_tile(&level, 0, 0, NULL);
    size_t size = (size_t)tile->blob.size;
    uint8_t *copy = test_blob_alloc(size);
    memcpy(copy, tile, size);
    uint32_t refused = 0, passed = 0;
    for (size_t bit = 0; bit < 8 * size; bit++) {
        copy[bit / 8] ^= (uint8_t)(1u << bit % 8);
        if (tl_nav_tile_check(copy, size, NULL) == TL_OK) {
            passed++;
            tl_navmesh *navmesh = NULL;
            tl_nav_location nearest;
            tl_nav_ray_hit hit;
            TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
            TEST_RESULT(tl_navmesh_add_tile(navmesh, (const tl_nav_tile *)(const void *)copy, TL_NAV_TILE_BORROWED),
                        TL_OK);
            if (tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(3, 0, 3), tl_vec3_make(9, 9, 9), &nearest) ==
                TL_OK) {
                TEST_RESULT(tl_navmesh_cast_ray(navmesh, NULL, &nearest, tl_vec3_make(11, 0, 8), NULL, 0, &hit), TL_OK);
            }
            tl_navmesh_destroy(navmesh);
        } else {
            refused++;
        }
        copy[bit / 8] ^= (uint8_t)(1u << bit % 8);
    }
    // Areas, flags, sizes of the agent, and within bounds the detail mesh are free; all else is tied down.
    TEST_CHECK(passed > 100 && refused > 4 * passed);
    test_blob_free(copy);
    tl_blob_free(tile);
}

static void test_other_bytes(void **state)
{
    (void)state;
    fixture_level level = fixture_make(ROOM, 4);
    tl_nav_tile *tile = fixture_build_tile(&level, 0, 0, NULL);
    tl_report report;
    TEST_RESULT(tl_nav_tile_check((const char *)tile + 4, 64, NULL), TL_ERR_ARGUMENT);
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size + 64, &report), TL_ERR_CORRUPT);
    for (uint32_t version = 1; version < TL_NAV_TILE_VERSION; version++) {
        tile->blob.version = version;
        TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, &report), TL_ERR_VERSION);
        TEST_CHECK(strcmp(report.advice, "bake the level again") == 0);
    }
    tile->blob.version = TL_NAV_TILE_VERSION + 1;
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_ERR_VERSION);
    tile->blob.magic++;
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_ERR_MAGIC);
    tile->blob.magic--;
    tile->blob.version--;
    tile->polygon_count = UINT32_MAX;
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, &report), TL_ERR_CORRUPT);
    TEST_CHECK(strcmp(report.element, "header") == 0);
    tl_blob_free(tile);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_example),      cmocka_unit_test(test_widths),    cmocka_unit_test(test_copies),
        cmocka_unit_test(test_portals),      cmocka_unit_test(test_profile),   cmocka_unit_test(test_bad_sources),
        cmocka_unit_test(test_random_tiles), cmocka_unit_test(test_boxes),     cmocka_unit_test(test_same_bytes),
        cmocka_unit_test(test_memory),       cmocka_unit_test(test_truncated), cmocka_unit_test(test_bit_flips),
        cmocka_unit_test(test_other_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
