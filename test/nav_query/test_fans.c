// SPDX-License-Identifier: MIT
//
// Edges over a seam know where they stand in the ring across: a tile of many strips beside one large polygon is added
// without a search through that polygon's ring for each of them. Rings take no more memory than their edges, and
// numbers of 16 bits where those do.

#include "nav_fixture.h"

#include "nav_query/navmesh/area_table.h"
#include "nav_query/navmesh/fans.h"
#include "nav_query/navmesh/ring_step.h"
#include "nav_row.h"

#include <math.h>
#include <talus/nav_around.h>

static void seams_know_their_twins(void **state)
{
    (void)state;
    static const char *const ROWS[4] = { "00000000", "00000000", "00000000", "00000000" };
    uint32_t seams = 0;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        fixture_level level = fixture_make(ROWS, 4);
        level.tile_cells = 4;
        level.shake = (int32_t)(seed % 4);
        level.seed = seed;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        for (uint32_t slot = 0; slot < 2; slot++) {
            const tl_nav_rings *rings = &navmesh->slots[slot].rings;
            for (uint32_t p = 0; p < rings->polygon_count; p++) {
                const tl_nav_ring ring = tl_nav_ring_of(rings, p);
                for (uint32_t k = 0; k < ring.count; k++) {
                    if (tl_nav_ring_is_seam(tl_nav_ring_to(&ring, k))) {
                        const tl_nav_ring_place twin = tl_nav_ring_twin(navmesh, slot, p, &ring, k);
                        const tl_nav_ring across = tl_nav_ring_at(navmesh, twin.slot, twin.polygon);
                        const tl_nav_ring_edge edge = tl_nav_ring_edge_at(&ring, k);
                        TEST_CHECK(tl_nav_seam_twin_hint(rings, edge, across.count) == twin.edge);
                        seams += twin.edge > 0;
                    }
                }
            }
        }
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(seams > 50);
}

// How many points of its own a ring has: all of them where one is no corner of its polygon, else none.
static uint32_t own_points_of(const tl_nav_tile *tile, const tl_nav_rings *rings, uint32_t polygon)
{
    uint32_t corner_count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &corner_count);
    const tl_nav_ring ring = tl_nav_ring_of(rings, polygon);
    const bool are_corners =
        ring.count == corner_count && memcmp(ring.points, corners, corner_count * sizeof *corners) == 0;
    TEST_CHECK((ring.points == corners) == are_corners);
    return are_corners ? 0 : ring.count;
}

static void rings_have_no_room_to_spare(void **state)
{
    (void)state;
    test_random random = { 3 };
    uint64_t seams_in_all = 0, points_in_all = 0, edges_in_all = 0, walls_in_all = 0;
    for (uint32_t kind = 0; kind < 6; kind++) {
        fixture_level level = fixture_random(&random, kind, 16);
        level.tile_cells = 4;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        for (uint32_t slot = 0; slot < navmesh->slot_count; slot++) {
            const tl_nav_rings *rings = &navmesh->slots[slot].rings;
            const tl_nav_tile *tile = navmesh->slots[slot].tile;
            const uint64_t edges = rings->edge_count, polygons = rings->polygon_count;
            uint64_t seams = 0, points = 0;
            for (uint64_t k = 0; k < edges; k++) {
                const tl_nav_ring_edge edge = tl_nav_edge_of(rings, k);
                const uint32_t walls = tl_nav_walls_number(edge);
                seams += tl_nav_ring_is_seam(edge.to);
                TEST_CHECK(walls < rings->walls_count);
                TEST_CHECK(walls >= TL_NAV_WALLS_FIRST || tl_nav_turn_of(rings, edge) == 0);
            }
            for (uint32_t p = 0; p < polygons; p++) {
                points += own_points_of(tile, rings, p);
            }
            seams_in_all += seams;
            points_in_all += points;
            edges_in_all += edges;
            walls_in_all += rings->walls_count - TL_NAV_WALLS_FIRST;
            TEST_CHECK(tl_nav_rings_size(rings) == edges * sizeof *rings->edges.narrow + points * sizeof(tl_vec3) +
                                                       seams * sizeof *rings->seams +
                                                       (points > 0 ? 2 * (polygons + 1) * sizeof(uint32_t) : 0) +
                                                       (3 * polygons + tile->node_count) * sizeof(uint16_t));
            TEST_CHECK(!rings->has_wide_edges);
            TEST_CHECK((rings->first == tl_nav_tile_at(tile, tile->first_corner)) == (points == 0));
        }
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(seams_in_all > 200);
    TEST_CHECK(points_in_all > 100 && points_in_all < edges_in_all / 2);
    TEST_CHECK(3 * walls_in_all < 2 * edges_in_all); // all edges of a fan have theirs in common
}

// More edges than a mark has room for: what lies across is looked for from the last place that one can name.
static void far_twins_are_found(void **state)
{
    (void)state;
    enum { CORNERS = 150 };
    tl_nav_ring_edge edges[3 + CORNERS];
    tl_vec3 points[3 + CORNERS];
    memset(edges, 0, sizeof edges);
    memset(points, 0, sizeof points);
    for (uint32_t k = 0; k < 3 + CORNERS; k++) {
        points[k].x = (float)k;
        edges[k].to = TL_NAV_RING_WALL;
    }
    const uint32_t first[3] = { 0, 3, 3 + CORNERS };
    tl_nav_slot slot;
    memset(&slot, 0, sizeof slot);
    slot.rings.first = slot.rings.first_point = first;
    slot.rings.edges.wide = edges;
    slot.rings.has_wide_edges = slot.rings.has_wide_firsts = true;
    slot.rings.points[0] = points;
    slot.rings.polygon_count = 2;
    tl_navmesh navmesh;
    memset(&navmesh, 0, sizeof navmesh);
    navmesh.slots = &slot;
    for (uint32_t twin = 0; twin < CORNERS; twin++) {
        const tl_nav_ring ring = tl_nav_ring_of(&slot.rings, 0);
        edges[1].to = 1;
        edges[1] = tl_nav_with_twin(edges[1], twin);
        edges[3 + twin].to = 0;
        points[3 + twin].x = points[2].x; // where the edge ends
        TEST_CHECK(tl_nav_ring_twin(&navmesh, 0, 0, &ring, 1).edge == twin);
        TEST_CHECK(tl_nav_inner_twin(&slot.rings, 0, 1) == twin);
        edges[3 + twin].to = TL_NAV_RING_WALL;
        points[3 + twin].x = (float)(3 + twin);
    }
}

// Over a seam the place is known however many edges the ring across has: else adding a tile of many strips beside one
// polygon takes quadratic time.
static void seam_twins_are_near(void **state)
{
    (void)state;
    static const uint32_t COUNTS[7] = { 3, 64, 150, 4096, 1u << 18, 1000003, UINT32_MAX };
    test_random random = { 7 };
    for (int c = 0; c < 7; c++) {
        for (uint32_t i = 0; i < 1000; i++) {
            tl_nav_ring_seam seam = { TL_NAV_MAX_TILES - 1, 5 };
            tl_nav_rings rings;
            memset(&rings, 0, sizeof rings);
            rings.seams = &seam;
            tl_nav_short_edge edges[2] = { { 0, 0 }, { -3, 77u << TL_NAV_RING_TWIN_BITS } }; // seam 0
            rings.edges.narrow = edges;
            const uint32_t twin = i == 0 ? COUNTS[c] - 1 : test_random_below(&random, COUNTS[c]);
            tl_nav_set_seam_twin(&rings, 1, 0, COUNTS[c]);
            tl_nav_set_seam_twin(&rings, 1, twin, COUNTS[c]);
            const tl_nav_ring_edge edge = tl_nav_edge_of(&rings, 1);
            const uint32_t near = tl_nav_seam_twin_hint(&rings, edge, COUNTS[c]);
            TEST_CHECK(near <= twin && twin - near <= COUNTS[c] >> 14);
            TEST_CHECK(tl_nav_ring_seam_of(&rings, edge.to).slot == TL_NAV_MAX_TILES - 1);
            TEST_CHECK(tl_nav_walls_number(edge) == 77);
        }
    }
}

// Whichever comes first, the hub or its strips, each strip knows where it lies in the hub's ring.
static void check_hub(uint32_t strips)
{
    for (uint32_t hub = 0; hub < 2; hub++) {
        tl_navmesh *navmesh = NULL;
        TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
        TEST_RESULT(tl_navmesh_add_tile(navmesh, nav_row_tile(hub == 0 ? 1 : strips, strips, 0), TL_NAV_TILE_OWNED),
                    TL_OK);
        TEST_RESULT(tl_navmesh_add_tile(navmesh, nav_row_tile(hub == 1 ? 1 : strips, strips, 1), TL_NAV_TILE_OWNED),
                    TL_OK);
        const tl_nav_rings *rings = &navmesh->slots[1 - hub].rings;
        TEST_CHECK(!rings->is_wide && rings->has_wide_edges == (strips > TL_NAV_SHORT_WALLS / 2));
        uint32_t seams = 0, hub_edges = 0;
        hub_edges = tl_nav_ring_at(navmesh, hub, 0).count;
        TEST_CHECK(rings->polygon_count == strips && hub_edges == strips + 3);
        for (uint32_t p = 0; p < strips; p++) {
            const tl_nav_ring ring = tl_nav_ring_of(rings, p);
            for (uint32_t k = 0; k < ring.count; k++) {
                if (tl_nav_ring_is_open(tl_nav_ring_to(&ring, k))) {
                    const tl_nav_ring_place twin = tl_nav_ring_twin(navmesh, 1 - hub, p, &ring, k);
                    TEST_CHECK(tl_nav_seam_twin_hint(rings, tl_nav_ring_edge_at(&ring, k), hub_edges) == twin.edge);
                    seams++;
                }
            }
        }
        TEST_CHECK(seams == strips);
        tl_navmesh_destroy(navmesh);
    }
}

static void strips_know_their_place_in_a_hub(void **state)
{
    (void)state;
    check_hub(1000);
    check_hub(5000); // more vertices on a side than a short edge names walls
}

// A tile that says it is the next one while its vertices are not: links lead over the seam to edges that are not the
// same, some of them walls.
static void tiles_that_do_not_meet_are_added(void **state)
{
    (void)state;
    static const char *const ROWS[4] = { "000000000000", "000000000000", "000000000000", "000000000000" };
    uint32_t apart = 0;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        fixture_level level = fixture_make(ROWS, 4);
        level.tile_cells = 4;
        level.shake = (int32_t)(seed % 4);
        level.seed = seed;
        tl_navmesh *navmesh = NULL;
        TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
        for (int32_t i = 0; i < 2; i++) {
            tl_nav_tile *tile = fixture_build_tile(&level, 1, 0, NULL);
            tile->tile_x = 1 + i;
            TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
        }
        const tl_nav_rings *rings = &navmesh->slots[0].rings;
        for (uint32_t k = 0; k < rings->edge_count; k++) {
            apart += tl_nav_ring_is_seam(tl_nav_edge_of(rings, k).to);
        }
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(apart > 50);
}

enum { STRIP_LENGTH = 235, STRIPS = 140, SQUARE = 600 }; // more than TL_NAV_MAX_SHORT_NUMBER squares

// One tile: strips of squares that do not touch one another.
static tl_nav_tile *make_strips(void)
{
    const uint32_t count = STRIP_LENGTH * STRIPS;
    tl_polygon_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    mesh.vertex_count = 2 * (STRIP_LENGTH + 1) * STRIPS;
    mesh.polygon_count = count;
    mesh.index_count = 4 * count;
    mesh.vertices = calloc(3 * (size_t)mesh.vertex_count, sizeof *mesh.vertices);
    mesh.first = calloc(count + 1, sizeof *mesh.first);
    mesh.indices = calloc(4 * count, sizeof *mesh.indices);
    mesh.neighbours = calloc(4 * count, sizeof *mesh.neighbours);
    mesh.regions = calloc(count, sizeof *mesh.regions);
    mesh.areas = calloc(count, sizeof *mesh.areas);
    mesh.contours = calloc(count, sizeof *mesh.contours);
    mesh.cell_size = 0.01f;
    mesh.cell_height = 0.2f;
    mesh.max_verts_per_poly = 4;
    for (uint32_t v = 0; v < mesh.vertex_count; v++) {
        const uint32_t in_strip = v % (2 * (STRIP_LENGTH + 1)), strip = v / (2 * (STRIP_LENGTH + 1));
        mesh.vertices[3 * v] = (int32_t)(in_strip / 2 * SQUARE);
        mesh.vertices[3 * v + 2] = (int32_t)((2 * strip + in_strip % 2) * SQUARE);
    }
    for (uint32_t p = 0; p < count; p++) {
        const uint32_t v = 2 * (p + p / STRIP_LENGTH);
        const uint32_t corners[4] = { v, v + 1, v + 3, v + 2 };
        const bool begins = p % STRIP_LENGTH == 0, ends = (p + 1) % STRIP_LENGTH == 0;
        const uint32_t across[4] = { begins ? TL_NO_POLYGON : p - 1, TL_NO_POLYGON, ends ? TL_NO_POLYGON : p + 1,
                                     TL_NO_POLYGON };
        memcpy(mesh.indices + 4 * p, corners, sizeof corners);
        memcpy(mesh.neighbours + 4 * p, across, sizeof across);
        mesh.first[p + 1] = 4 * (p + 1);
        mesh.areas[p] = 63;
    }
    tl_nav_tile_source source;
    memset(&source, 0, sizeof source);
    source.polygons = &mesh;
    source.agent_height = 2.0f;
    source.agent_radius = 0.5f;
    source.agent_max_climb = 0.5f;
    tl_nav_tile *tile = NULL;
    TEST_RESULT(tl_nav_tile_encode(&source, NULL, &tile, NULL), TL_OK);
    void *const arrays[7] = { mesh.vertices, mesh.first, mesh.indices, mesh.neighbours,
                              mesh.regions,  mesh.areas, mesh.contours };
    for (int i = 0; i < 7; i++) {
        free(arrays[i]);
    }
    return tile;
}

// Numbers of polygons and sums of areas that 16 and 32 bits have no room for.
static void large_tiles_have_wide_numbers(void **state)
{
    (void)state;
    tl_navmesh *navmesh = NULL;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    tl_nav_tile *tile = make_strips();
    TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
    const tl_nav_slot *slot = &navmesh->slots[0];
    TEST_CHECK((tile->wide & TL_NAV_WIDE_LINKS) != 0 && (tile->wide & TL_NAV_WIDE_FIRSTS) != 0);
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_OK);
    TEST_CHECK(slot->rings.is_wide && slot->rings.has_wide_edges && slot->areas.is_wide &&
               slot->rings.component_count == STRIPS);
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        TEST_CHECK(tl_nav_component_of(&slot->rings, p) == p / STRIP_LENGTH);
        TEST_CHECK(tl_nav_area_before(slot, p + 1) == 2 * (uint64_t)SQUARE * SQUARE * (p + 1));
    }
    test_random random = { 5 };
    for (uint32_t i = 0; i < 200; i++) {
        const uint32_t from = test_random_below(&random, tile->polygon_count);
        const uint32_t at = test_random_below(&random, tile->polygon_count);
        const tl_vec3 point =
            tl_vec3_make(6.0f * (float)(at % STRIP_LENGTH) + 3.0f, 0.0f, 12.0f * (float)(at / STRIP_LENGTH) + 3.0f);
        const uint32_t nearest = from / STRIP_LENGTH * STRIP_LENGTH + at % STRIP_LENGTH;
        tl_nav_location found;
        TEST_RESULT(tl_navmesh_find_nearest_reachable(navmesh, NULL, tl_nav_make_ref(navmesh, 0, from), point, &found),
                    TL_OK);
        TEST_CHECK(found.polygon == tl_nav_make_ref(navmesh, 0, nearest));
        const uint64_t numbers[2] = { test_random_u64(&random), test_random_u64(&random) };
        TEST_RESULT(tl_navmesh_random_point(navmesh, NULL, numbers, &found), TL_OK);
        uint32_t of_slot = 0, polygon = 0;
        TEST_CHECK(tl_nav_split_ref(navmesh, found.polygon, &of_slot, &polygon));
        TEST_CHECK((uint32_t)(found.point.x / 6.0f) == polygon % STRIP_LENGTH);
        TEST_CHECK((uint32_t)(found.point.z / 12.0f) == polygon / STRIP_LENGTH);
    }
    tl_navmesh_destroy(navmesh);
}

enum { SIDE = 3, BENDS = 3, SPOTS = BENDS + 1, POINTS = (SIDE + 1) * (SIDE + 1), LINES = 2 * POINTS };

// A square of squares whose sides have further vertices on them, 300 lattice units long: two neighbours share several
// edges in line.
typedef struct bent_squares {
    int32_t vertices[3 * (POINTS + LINES * BENDS)];
    uint32_t first[SIDE * SIDE + 1], indices[4 * SPOTS * SIDE * SIDE], neighbours[4 * SPOTS * SIDE * SIDE];
    uint32_t regions[SIDE * SIDE], areas[SIDE * SIDE], contours[SIDE * SIDE];
} bent_squares;

static uint32_t point_at(uint32_t x, uint32_t z)
{
    return z * (SIDE + 1) + x;
}

// The vertices of the line from a point along x or z.
static uint32_t bend_at(uint32_t point, bool along_z, uint32_t k)
{
    return POINTS + (2 * point + (along_z ? 1 : 0)) * BENDS + k;
}

static void place_bends(bent_squares *b, test_random *random)
{
    for (uint32_t i = 0; i < POINTS; i++) {
        const int32_t at[2] = { (int32_t)(i % (SIDE + 1)) * 300, (int32_t)(i / (SIDE + 1)) * 300 };
        b->vertices[3 * i] = at[0];
        b->vertices[3 * i + 2] = at[1];
        for (uint32_t line = 0; line < 2; line++) {
            int32_t along = 0;
            for (uint32_t k = 0; k < BENDS; k++) {
                along += 1 + (int32_t)test_random_below(random, k % 2 == 0 ? 4 : 140);
                int32_t *v = b->vertices + 3 * bend_at(i, line != 0, k);
                v[0] = at[0] + (line == 0 ? along : 0);
                v[2] = at[1] + (line != 0 ? along : 0);
            }
        }
    }
}

static uint32_t square_at(int32_t x, int32_t z)
{
    return x >= 0 && z >= 0 && x < SIDE && z < SIDE ? (uint32_t)(z * SIDE + x) : TL_NO_POLYGON;
}

// One side of a square, from its corner on; `ahead`: along the line, else against it.
static void add_side(bent_squares *b, uint32_t *at, uint32_t corner, uint32_t line, bool along_z, bool ahead,
                     uint32_t across)
{
    for (uint32_t k = 0; k < SPOTS; k++, ++*at) {
        b->indices[*at] = k == 0 ? corner : bend_at(line, along_z, ahead ? k - 1 : BENDS - k);
        b->neighbours[*at] = across;
    }
}

static tl_nav_tile *make_bent_squares(test_random *random, tl_vec3 origin)
{
    static bent_squares b;
    memset(&b, 0, sizeof b);
    place_bends(&b, random);
    uint32_t at = 0;
    for (uint32_t p = 0; p < SIDE * SIDE; p++) {
        const uint32_t x = p % SIDE, z = p / SIDE;
        const int32_t sx = (int32_t)x, sz = (int32_t)z;
        b.areas[p] = 63;
        add_side(&b, &at, point_at(x, z), point_at(x, z), true, true, square_at(sx - 1, sz));
        add_side(&b, &at, point_at(x, z + 1), point_at(x, z + 1), false, true, square_at(sx, sz + 1));
        add_side(&b, &at, point_at(x + 1, z + 1), point_at(x + 1, z), true, false, square_at(sx + 1, sz));
        add_side(&b, &at, point_at(x + 1, z), point_at(x, z), false, false, square_at(sx, sz - 1));
        b.first[p + 1] = at;
    }
    tl_polygon_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    mesh.vertex_count = POINTS + LINES * BENDS;
    mesh.polygon_count = SIDE * SIDE;
    mesh.index_count = at;
    mesh.vertices = b.vertices;
    mesh.first = b.first;
    mesh.indices = b.indices;
    mesh.neighbours = b.neighbours;
    mesh.regions = b.regions;
    mesh.areas = b.areas;
    mesh.contours = b.contours;
    mesh.cell_size = 0.01f;
    mesh.cell_height = 0.2f;
    mesh.max_verts_per_poly = 4 * SPOTS;
    mesh.bounds.min = mesh.bounds.max = origin;
    tl_nav_tile_source source;
    memset(&source, 0, sizeof source);
    source.polygons = &mesh;
    source.origin = origin;
    source.agent_height = 2.0f;
    source.agent_radius = 0.5f;
    source.agent_max_climb = 0.5f;
    tl_nav_tile *tile = NULL;
    TEST_RESULT(tl_nav_tile_encode(&source, NULL, &tile, NULL), TL_OK);
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_OK);
    return tile;
}

// Which edge across is the same one is told by its ends. Far from the origin vertices have the same floats, and several
// edges of one polygon may then name one of the other: going around a vertex need not come back to where it began.
static void collapsed_vertices_have_walls(void **state)
{
    (void)state;
    const float fars[6] = { 0.0f, 3e5f, 1e6f, 3e6f, 2e7f, -1e9f };
    test_random random = { 11 };
    uint32_t astray = 0;
    for (uint32_t i = 0; i < 600; i++) {
        tl_navmesh *navmesh = NULL;
        TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
        const tl_vec3 origin = tl_vec3_make(fars[i % 6], 0.0f, i % 4 == 0 ? fars[i / 6 % 6] : 0.0f);
        TEST_RESULT(tl_navmesh_add_tile(navmesh, make_bent_squares(&random, origin), TL_NAV_TILE_OWNED), TL_OK);
        const tl_nav_rings *rings = &navmesh->slots[0].rings;
        for (uint32_t p = 0; p < SIDE * SIDE; p++) {
            const tl_nav_ring ring = tl_nav_ring_of(rings, p);
            for (uint32_t k = 0; k < ring.count; k++) {
                TEST_CHECK(tl_nav_walls_number(tl_nav_ring_edge_at(&ring, k)) < rings->walls_count);
                if (tl_nav_ring_is_open(tl_nav_ring_to(&ring, k))) {
                    const uint32_t twin = tl_nav_inner_twin(rings, p, k);
                    const tl_nav_ring across = tl_nav_ring_of(rings, tl_nav_ring_to(&ring, k));
                    TEST_CHECK(twin < across.count);
                    astray += tl_nav_ring_to(&across, twin) != p ||
                              tl_nav_inner_twin(rings, tl_nav_ring_to(&ring, k), twin) != k;
                }
            }
        }
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(astray > 1000);
}

// A ramp leads up along a tile's border to an upper floor, beside flat floor: the ramp is linked with that over the
// border, the upper floor is not. So a slit begins where the ramp ends, with floor all around its end, which lies in
// the middle of an edge on the flat side. The shortest path from the upper floor to the flat one beside it turns there.
static void slits_end_in_corners(void **state)
{
    (void)state;
    static const char *const ROWS[8] = { "###", "###", "###", "0r1", "000", "###", "###", "###" };
    tl_nav_query *query = fixture_query(256);
    for (uint64_t seed = 1; seed <= 20; seed++) {
        fixture_level level = fixture_make(ROWS, 8);
        level.tile_cells = 4;
        level.shake = 3;
        level.seed = seed;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        const float cell = (float)FIXTURE_STEP * level.cell_size, border = 4.0f * cell, x = 2.5f * cell;
        tl_nav_path_request request = { NULL, { TL_NAV_NO_REF, { 0, 0, 0 } }, { TL_NAV_NO_REF, { 0, 0, 0 } } };
        const tl_vec3 upper = tl_vec3_make(x, 2.5f, border - 1.0f), flat = tl_vec3_make(x, 0.0f, border + 1.0f);
        const tl_vec3 extents = { 0.1f, 0.5f, 0.1f };
        TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, upper, extents, &request.start), TL_OK);
        TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, flat, extents, &request.goal), TL_OK);
        tl_nav_corner corners[4];
        const tl_nav_path_buffers buffers = { NULL, 0, corners, 4 };
        tl_nav_shortest_path path;
        TEST_RESULT(tl_nav_query_find_shortest_path(query, navmesh, &request, &buffers, &path), TL_OK);
        TEST_CHECK(path.status == TL_NAV_PATH_COMPLETE && path.corner_count == 3);
        TEST_CHECK(corners[1].point.z == border && corners[1].point.x > 0.0f && corners[1].point.x < 2.25f * cell);
        const double aside = (double)x - (double)corners[1].point.x;
        TEST_CHECK(fabs(path.length - 2.0 * sqrt(aside * aside + 1.0)) < 1e-5);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
}

// Random pairs, for which the exact search must end as find_path does, with at most so many nodes. Returns how many of
// them have a path.
static uint32_t check_random_pairs(tl_nav_query *query, const tl_navmesh *navmesh, test_random *random, uint32_t count,
                                   uint32_t most_nodes)
{
    const fixture_refs all = fixture_all_refs(navmesh);
    uint32_t reached = 0;
    for (uint32_t i = 0; i < count; i++) {
        const tl_nav_path_request request = { NULL, fixture_random_location(navmesh, &all, random),
                                              fixture_random_location(navmesh, &all, random) };
        tl_nav_path path;
        tl_nav_ref polygons[1024];
        tl_nav_shortest_path shortest;
        TEST_RESULT(tl_nav_query_find_path(query, navmesh, &request, polygons, 1024, &path), TL_OK);
        TEST_RESULT(tl_nav_query_find_shortest_path(query, navmesh, &request, NULL, &shortest), TL_OK);
        TEST_CHECK(path.status == shortest.status);
        TEST_CHECK(shortest.node_count <= most_nodes);
        reached += path.status == TL_NAV_PATH_COMPLETE;
    }
    free(all.refs);
    return reached;
}

// Where floors fork, over one another or at ramps along tiles' borders, the exact search reaches what find_path does.
static void forks_are_passed(void **state)
{
    (void)state;
    test_random random = { 11 };
    tl_nav_query *query = fixture_query(1 << 16);
    uint32_t reached = 0;
    for (uint32_t round = 0; round < 200; round++) {
        fixture_level level = fixture_random(&random, 5, 24);
        level.tile_cells = round % 2 == 0 ? 24 : 4;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        reached += check_random_pairs(query, navmesh, &random, 20, UINT32_MAX);
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(reached > 1000);
    tl_nav_query_destroy(query);
}

static void check_pairs_arrive(tl_nav_query *query, uint64_t seed, uint32_t tile_cells)
{
    test_random random = { seed };
    fixture_level level = fixture_random(&random, 5, 12);
    level.tile_cells = tile_cells;
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    TEST_CHECK(check_random_pairs(query, navmesh, &random, 40, 2500) > 20);
    tl_navmesh_destroy(navmesh);
}

// In small tiles most polygons have links of two floors that run back and forth: one within another, or seen past one
// another's ends. Paths that are as long as one another, along a seam, are searched once: they double at each link.
static void links_lie_within_others(void **state)
{
    (void)state;
    static const uint32_t SEEDS_OF_TWO[] = { 8, 70, 80, 201, 242 };
    static const uint32_t SEEDS_OF_THREE[] = { 17, 23, 129, 211, 242, 248, 380, 397, 603, 712 };
    tl_nav_query *query = fixture_query(1 << 14);
    for (uint32_t i = 0; i < 5; i++) {
        check_pairs_arrive(query, SEEDS_OF_TWO[i], 2);
    }
    for (uint32_t i = 0; i < 10; i++) {
        check_pairs_arrive(query, SEEDS_OF_THREE[i], 3);
    }
    tl_nav_query_destroy(query);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(seams_know_their_twins),
                                        cmocka_unit_test(rings_have_no_room_to_spare),
                                        cmocka_unit_test(far_twins_are_found),
                                        cmocka_unit_test(seam_twins_are_near),
                                        cmocka_unit_test(strips_know_their_place_in_a_hub),
                                        cmocka_unit_test(tiles_that_do_not_meet_are_added),
                                        cmocka_unit_test(large_tiles_have_wide_numbers),
                                        cmocka_unit_test(collapsed_vertices_have_walls),
                                        cmocka_unit_test(slits_end_in_corners),
                                        cmocka_unit_test(forks_are_passed),
                                        cmocka_unit_test(links_lie_within_others) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
