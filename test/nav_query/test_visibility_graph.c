// SPDX-License-Identifier: MIT
//
// Prepared navmeshes: the same lengths as without the graph, whatever tiles and links come and go; memory.
// That these are the shortest of all is tested beside the search over polygons (test_shortest_path.c).

#include "base/hash.h"
#include "nav_fixture.h"
#include "nav_query/prepared/visibility_graph.h"

#include <math.h>
#include <talus/nav_prepare.h>

// Random pairs on two navmeshes of the same tiles; returns how many had a path that turns.
static uint32_t compare(const tl_navmesh *prepared, const tl_navmesh *plain, test_random *random, uint32_t pairs)
{
    tl_nav_query *query = fixture_query(1 << 16);
    fixture_refs all = fixture_all_refs(plain);
    uint32_t turning = 0;
    for (uint32_t i = 0; i < pairs && all.count > 0; i++) {
        tl_nav_location start = fixture_random_location(plain, &all, random);
        tl_nav_location goal = fixture_random_location(plain, &all, random);
        tl_nav_shortest_path a, b;
        tl_nav_path path;
        tl_nav_ref polygons[512];
        TEST_RESULT(
            tl_nav_query_find_shortest_path(query, prepared, &(tl_nav_path_request){ NULL, start, goal }, NULL, &a),
            TL_OK);
        TEST_RESULT(
            tl_nav_query_find_shortest_path(query, plain, &(tl_nav_path_request){ NULL, start, goal }, NULL, &b),
            TL_OK);
        TEST_RESULT(
            tl_nav_query_find_path(query, prepared, &(tl_nav_path_request){ NULL, start, goal }, polygons, 512, &path),
            TL_OK);
        TEST_CHECK(a.status == b.status && path.status == a.status);
        TEST_CHECK(fabs(a.length - b.length) <= 1e-5 * (1.0 + b.length));
        if (a.status == TL_NAV_PATH_COMPLETE) {
            TEST_CHECK(fabs((double)path.cost - b.length) <= 1e-5 * (1.0 + b.length));
            TEST_CHECK(polygons[0] == start.polygon && polygons[path.polygon_count - 1] == goal.polygon);
            TEST_CHECK(a.lower_bound <= a.length && a.lower_bound >= a.length * (1.0 - 1e-5) - 1e-5);
        }
        turning += a.status == TL_NAV_PATH_COMPLETE && a.corner_count > 2;
    }
    free(all.refs);
    tl_nav_query_destroy(query);
    return turning;
}

// Each edit invalidates the graph, and preparing brings it back.
static void test_edits(void **state)
{
    (void)state;
    test_random random = { 5 };
    uint32_t turning = 0;
    for (uint32_t round = 0; round < 12; round++) {
        fixture_level level = fixture_random(&random, round % 6, 9);
        level.tile_cells = 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL), *twin = fixture_build(&level, NULL);
        for (uint32_t edit = 0; edit < 8; edit++) {
            int32_t x = (int32_t)test_random_below(&random, 3), z = (int32_t)test_random_below(&random, 3);
            TEST_RESULT(tl_navmesh_prepare(navmesh, NULL, NULL), TL_OK);
            turning += compare(navmesh, twin, &random, 12);
            bool was_prepared = tl_navmesh_is_prepared(navmesh);
            TEST_RESULT(tl_navmesh_prepare(navmesh, NULL, NULL), TL_OK);
            TEST_CHECK(tl_navmesh_is_prepared(navmesh) == was_prepared);
            if (tl_navmesh_remove_tile(navmesh, x, z) == TL_OK) {
                TEST_RESULT(tl_navmesh_remove_tile(twin, x, z), TL_OK);
            } else {
                tl_nav_tile *tile = fixture_build_tile(&level, x, z, NULL);
                tl_nav_tile *copy = fixture_build_tile(&level, x, z, NULL);
                if (tile == NULL) {
                    continue;
                }
                TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
                TEST_RESULT(tl_navmesh_add_tile(twin, copy, TL_NAV_TILE_OWNED), TL_OK);
            }
            TEST_CHECK(!tl_navmesh_is_prepared(navmesh));
            turning += compare(navmesh, twin, &random, 4);
        }
        tl_navmesh_destroy(navmesh);
        tl_navmesh_destroy(twin);
    }
    TEST_CHECK(turning > 300);
}

// Too few nodes for the graph, and for the polygons too.
static void test_nodes(void **state)
{
    (void)state;
    test_random random = { 6 };
    fixture_level level = fixture_random(&random, 4, 12);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    TEST_RESULT(tl_navmesh_prepare(navmesh, NULL, NULL), TL_OK);
    TEST_CHECK(tl_navmesh_is_prepared(navmesh));
    fixture_refs all = fixture_all_refs(navmesh);
    tl_nav_query *large = fixture_query(4096);
    uint32_t gave_up = 0, complete = 0;
    for (uint32_t i = 0; i < 120; i++) {
        const uint32_t max_nodes = 2 + i % 20;
        tl_nav_query *small = fixture_query(max_nodes);
        tl_nav_location start = fixture_random_location(navmesh, &all, &random);
        tl_nav_location goal = fixture_random_location(navmesh, &all, &random);
        tl_nav_shortest_path found, expected;
        TEST_RESULT(
            tl_nav_query_find_shortest_path(small, navmesh, &(tl_nav_path_request){ NULL, start, goal }, NULL, &found),
            TL_OK);
        TEST_RESULT(tl_nav_query_find_shortest_path(large, navmesh, &(tl_nav_path_request){ NULL, start, goal }, NULL,
                                                    &expected),
                    TL_OK);
        TEST_CHECK(found.node_count <= max_nodes);
        TEST_CHECK(found.status == expected.status || found.status == TL_NAV_PATH_OUT_OF_NODES);
        TEST_CHECK(found.status != TL_NAV_PATH_COMPLETE || fabs(found.length - expected.length) < 1e-4);
        gave_up += found.status == TL_NAV_PATH_OUT_OF_NODES;
        complete += found.status == TL_NAV_PATH_COMPLETE;
        tl_nav_query_destroy(small);
    }
    TEST_CHECK(gave_up > 3 && complete > 20);
    tl_nav_query_destroy(large);
    free(all.refs);
    tl_navmesh_destroy(navmesh);
}

// A table keeps the polygons of edges; a graph without one walks along them. Where both turn at the same corners, their
// polygons are the same, with room for all of them or for some.
static uint32_t compare_kept(const tl_navmesh *kept, const tl_navmesh *walked, test_random *random, uint32_t *long_ones)
{
    enum { ROOM = 512 };
    static tl_nav_ref polygons[2][ROOM], few[ROOM];
    static tl_nav_corner corners[2][ROOM];
    tl_nav_query *query = fixture_query(4096);
    fixture_refs all = fixture_all_refs(kept);
    uint32_t same = 0;
    for (uint32_t i = 0; i < 60; i++) {
        const tl_nav_path_request request = { NULL, fixture_random_location(kept, &all, random),
                                              fixture_random_location(kept, &all, random) };
        tl_nav_shortest_path a, b, c;
        const tl_nav_path_buffers room_a = { polygons[0], ROOM, corners[0], ROOM };
        const tl_nav_path_buffers room_b = { polygons[1], ROOM, corners[1], ROOM };
        TEST_RESULT(tl_nav_query_find_shortest_path(query, kept, &request, &room_a, &a), TL_OK);
        TEST_RESULT(tl_nav_query_find_shortest_path(query, walked, &request, &room_b, &b), TL_OK);
        TEST_CHECK(a.status == b.status);
        bool turns_alike = a.corner_count == b.corner_count;
        for (uint32_t k = 0; k < a.corner_count && turns_alike; k++) {
            turns_alike =
                corners[0][k].point.x == corners[1][k].point.x && corners[0][k].point.z == corners[1][k].point.z;
        }
        if (!turns_alike) {
            continue;
        }
        TEST_CHECK(a.polygon_count == b.polygon_count);
        TEST_CHECK(memcmp(polygons[0], polygons[1], a.polygon_count * sizeof(tl_nav_ref)) == 0);
        for (uint32_t k = 0; k < a.corner_count; k++) {
            TEST_CHECK(corners[0][k].polygon == corners[1][k].polygon && corners[0][k].flags == corners[1][k].flags);
        }
        const uint32_t part = a.polygon_count / 2;
        const tl_nav_path_buffers room_c = { few, part, NULL, 0 };
        few[part] = 77;
        tl_nav_query_find_shortest_path(query, kept, &request, &room_c, &c);
        TEST_CHECK(c.polygon_count == a.polygon_count && few[part] == 77);
        TEST_CHECK(memcmp(few, polygons[0], part * sizeof(tl_nav_ref)) == 0);
        same++;
        *long_ones += a.corner_count > 4;
    }
    free(all.refs);
    tl_nav_query_destroy(query);
    return same;
}

static void test_kept_legs(void **state)
{
    (void)state;
    test_random random = { 17 };
    uint32_t same = 0, long_ones = 0;
    for (uint32_t round = 0; round < 24; round++) {
        fixture_level level = fixture_random(&random, round % 6, 12);
        level.tile_cells = round % 2 == 0 ? 0 : 5;
        tl_navmesh *kept = fixture_build(&level, NULL), *walked = fixture_build(&level, NULL);
        tl_nav_prepare_def def = tl_default_nav_prepare_def();
        tl_nav_prepared made;
        TEST_RESULT(tl_navmesh_prepare(kept, &def, &made), TL_OK);
        def.table_bytes = 0;
        TEST_RESULT(tl_navmesh_prepare(walked, &def, NULL), TL_OK);
        same += made.kind == TL_NAV_PREPARED_TABLE ? compare_kept(kept, walked, &random, &long_ones) : 0;
        tl_navmesh_destroy(kept);
        tl_navmesh_destroy(walked);
    }
    TEST_CHECK(same > 500 && long_ones > 100);
}

// A budget that is too small is named, and what is left finds the same paths.
static void test_budgets(void **state)
{
    (void)state;
    test_random random = { 8 };
    fixture_level level = fixture_random(&random, 4, 12);
    tl_navmesh *navmesh = fixture_build(&level, NULL), *twin = fixture_build(&level, NULL);
    tl_nav_prepared made, none;
    tl_nav_prepare_def def = tl_default_nav_prepare_def();
    TEST_RESULT(tl_navmesh_prepare(navmesh, NULL, &made), TL_OK);
    TEST_CHECK(made.kind == TL_NAV_PREPARED_TABLE && made.corner_vertex_count > 10 &&
               made.edge_count >= made.corner_vertex_count);
    TEST_CHECK(made.table_bytes == 6ull * made.corner_vertex_count * made.corner_vertex_count &&
               made.bytes > made.table_bytes);
    TEST_CHECK(compare(navmesh, twin, &random, 40) > 4);
    // The graph stays where the table goes and comes.
    uint64_t graph_bytes = 0;
    for (uint32_t i = 0; i < 4; i++) {
        def.table_bytes = made.table_bytes - (i % 2 == 0 ? 1 : 0);
        TEST_RESULT(tl_navmesh_prepare(navmesh, &def, &none), TL_OK);
        TEST_CHECK(none.kind == (i % 2 == 0 ? TL_NAV_PREPARED_GRAPH : TL_NAV_PREPARED_TABLE));
        TEST_CHECK(none.table_bytes == made.table_bytes && none.edge_count == made.edge_count);
        // With the table go the polygons of edges.
        graph_bytes = i == 0 ? none.bytes : graph_bytes;
        TEST_CHECK(none.bytes == (i % 2 == 0 ? graph_bytes : made.bytes));
        TEST_CHECK(graph_bytes < made.bytes - made.table_bytes);
        TEST_CHECK(tl_navmesh_is_prepared(navmesh) && compare(navmesh, twin, &random, 40) > 4);
    }
    TEST_CHECK(strcmp(tl_nav_prepared_kind_name(TL_NAV_PREPARED_TABLE), "table") == 0);
    TEST_CHECK(strcmp(tl_nav_prepared_kind_name((tl_nav_prepared_kind)77), "unknown") == 0);
    tl_navmesh_destroy(navmesh);
    tl_navmesh_destroy(twin);
}

// A path by whatever was prepared ends a search in slices that its query has under way.
static void test_slices(void **state)
{
    (void)state;
    const char *const rows[] = { "000", "0#0", "000" };
    fixture_level level = fixture_make(rows, 3);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    const tl_nav_prepare_def defs[2] = { { .table_bytes = UINT64_MAX - 1, .cookie = TL_DEF_COOKIE },
                                         { .cookie = TL_DEF_COOKIE } };
    tl_nav_location start = { tl_navmesh_polygon_ref(navmesh, 0, 0), { 2, 0, 2 } };
    tl_nav_location goal = { tl_navmesh_polygon_ref(navmesh, 0, 7), { 10, 0, 10 } };
    tl_nav_query *query = fixture_query(1000);
    for (uint32_t i = 0; i < 2; i++) {
        tl_nav_path_progress progress;
        tl_nav_shortest_path path;
        TEST_RESULT(tl_navmesh_prepare(navmesh, &defs[i], NULL), TL_OK);
        TEST_RESULT(tl_nav_query_begin_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }), TL_OK);
        TEST_RESULT(tl_nav_query_step_path(query, 1, &progress), TL_OK);
        TEST_CHECK(progress.status == TL_NAV_PATH_UNFINISHED);
        TEST_RESULT(
            tl_nav_query_find_shortest_path(query, navmesh, &(tl_nav_path_request){ NULL, goal, start }, NULL, &path),
            TL_OK);
        TEST_CHECK(path.corner_count == 3);
        TEST_RESULT(tl_nav_query_step_path(query, 1, &progress), TL_ERR_STALE);
    }
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

// A link is a way that the graph does not know.
static void test_links(void **state)
{
    (void)state;
    const char *const rows[] = { "0#0", "0#0", "000" };
    fixture_level level = fixture_make(rows, 3);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_query *query = fixture_query(1000);
    tl_nav_location start, goal;
    tl_vec3 near_by = tl_vec3_make(0.5f, 1.0f, 0.5f);
    TEST_RESULT(tl_navmesh_prepare(navmesh, NULL, NULL), TL_OK);
    TEST_CHECK(tl_navmesh_is_prepared(navmesh));
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(2, 0, 2), near_by, &start), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(10, 0, 2), near_by, &goal), TL_OK);
    tl_nav_offmesh link;
    memset(&link, 0, sizeof link);
    link = tl_default_nav_offmesh();
    link.start = tl_vec3_make(3.5f, 0, 2);
    link.end = tl_vec3_make(8.5f, 0, 2);
    tl_nav_ref added = TL_NAV_NO_REF;
    tl_nav_shortest_path path;
    TEST_RESULT(
        tl_nav_query_find_shortest_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, NULL, &path),
        TL_OK);
    TEST_CHECK(path.length > 12.0);
    TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &link, &added, NULL), TL_OK);
    TEST_RESULT(
        tl_nav_query_find_shortest_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, NULL, &path),
        TL_OK);
    TEST_CHECK(path.length < 9.0);
    TEST_RESULT(tl_navmesh_remove_offmesh(navmesh, added), TL_OK);
    TEST_RESULT(tl_navmesh_prepare(navmesh, NULL, NULL), TL_OK);
    TEST_RESULT(
        tl_nav_query_find_shortest_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, NULL, &path),
        TL_OK);
    TEST_CHECK(path.length > 12.0);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

// Takes two random tiles out of both, and puts equal ones back in an order that gives them each other's slots.
static void exchange_slots(const fixture_level *level, tl_navmesh *const both[2], test_random *random)
{
    const uint32_t tiles = fixture_tiles(level->width, level->tile_cells);
    const int32_t first = (int32_t)test_random_below(random, tiles), second = (int32_t)test_random_below(random, tiles);
    const int32_t z = (int32_t)test_random_below(random, tiles);
    for (int i = 0; i < 2; i++) {
        TEST_CHECK(!tl_is_error(tl_navmesh_remove_tile(both[i], first, z)));
        TEST_CHECK(!tl_is_error(tl_navmesh_remove_tile(both[i], second, z)));
        for (int k = 0; k < (first != second ? 2 : 1); k++) {
            tl_nav_tile *tile = fixture_build_tile(level, k == 0 ? first : second, z, NULL);
            TEST_RESULT(tile != NULL ? tl_navmesh_add_tile(both[i], tile, TL_NAV_TILE_OWNED) : TL_OK, TL_OK);
        }
    }
}

// What a graph holds, whatever its numbers and order: sums of hashes.
typedef struct graph_content {
    uint64_t vertices, edges, cones;
} graph_content;

static uint64_t name_of_polygon(const tl_navmesh *navmesh, uint32_t slot, uint32_t polygon)
{
    const tl_nav_tile *tile = navmesh->slots[slot].tile;
    const int32_t place[4] = { tile->tile_x, tile->tile_z, (int32_t)tile->layer, (int32_t)polygon };
    return tl_hash_bytes(place, sizeof place, 1);
}

// Edges of a ring are cut where tiles were that have left: their numbers are no part of the name.
static uint64_t name_of_vertex(const tl_navmesh *navmesh, uint32_t v)
{
    const tl_nav_corner_vertex *vertex = &navmesh->graph->vertices[v];
    const tl_nav_rings *rings = &navmesh->slots[vertex->place.slot].rings;
    const tl_nav_ring ring = tl_nav_ring_of(rings, vertex->place.polygon);
    const tl_vec3 *at = &ring.points[vertex->place.edge];
    TEST_CHECK(vertex->turn != 0 && navmesh->graph->marks[v] == 0);
    TEST_CHECK(vertex->turn == tl_nav_turn_of(rings, tl_nav_ring_edge_at(&ring, vertex->place.edge)));
    TEST_CHECK(vertex->x == at->x && vertex->y == at->y && vertex->z == at->z);
    const float values[7] = {
        vertex->x,           vertex->y, vertex->z, vertex->walls.first_x, vertex->walls.first_z, vertex->walls.last_x,
        vertex->walls.last_z
    };
    return tl_hash_bytes(values, sizeof values, name_of_polygon(navmesh, vertex->place.slot, vertex->place.polygon));
}

static void add_cones(const tl_navmesh *navmesh, uint32_t slot, const uint64_t *names, graph_content *content)
{
    const tl_nav_corner_cones *cones = &navmesh->graph->tiles[slot].cones;
    TEST_CHECK(cones->polygon_count == navmesh->slots[slot].tile->polygon_count);
    for (uint32_t p = 0; p < cones->polygon_count; p++) {
        for (uint32_t i = cones->first[p]; i < cones->first[p + 1]; i++) {
            const int16_t ends[4] = { cones->left_x[i], cones->left_z[i], cones->right_x[i], cones->right_z[i] };
            const uint64_t cone[2] = { names[tl_nav_cone_vertex(cones, i)], cones->vertex[i] >> 24 };
            content->cones +=
                tl_hash_bytes(ends, sizeof ends, tl_hash_bytes(cone, sizeof cone, name_of_polygon(navmesh, slot, p)));
        }
    }
}

// Landmarks are no longer than edges let them be.
static void check_landmarks(const tl_nav_visibility_graph *graph, uint32_t v)
{
    const tl_nav_corner_vertex *from = &graph->vertices[v];
    for (uint32_t e = 0; e < from->edge_count; e++) {
        const tl_nav_corner_vertex *to = &graph->vertices[from->edges[e].to];
        const double x = (double)to->x - (double)from->x, z = (double)to->z - (double)from->z;
        const double most = sqrt(x * x + z * z) + (double)graph->landmark_error;
        for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
            const float a = graph->landmarks[v][k], b = graph->landmarks[from->edges[e].to][k];
            TEST_CHECK(isfinite(a) && fabs((double)a - (double)b) <= most);
        }
    }
}

static graph_content content_of(const tl_navmesh *navmesh)
{
    graph_content content = { 0, 0, 0 };
    const tl_nav_visibility_graph *graph = navmesh->graph;
    uint64_t *names = calloc(graph->vertex_room + 1, sizeof *names);
    uint32_t vertices = 0, edges = 0;
    for (uint32_t v = 0; v < graph->vertex_room; v++) {
        names[v] = graph->vertices[v].turn != 0 ? name_of_vertex(navmesh, v) : 0;
        content.vertices += names[v];
        vertices += graph->vertices[v].turn != 0;
    }
    for (uint32_t v = 0; v < graph->vertex_room; v++) {
        const tl_nav_corner_vertex *vertex = &graph->vertices[v];
        for (uint32_t e = 0; e < vertex->edge_count; e++) {
            const uint64_t ends[2] = { names[v], names[vertex->edges[e].to] };
            TEST_CHECK(e == 0 || vertex->edges[e - 1].to < vertex->edges[e].to);
            content.edges += tl_hash_bytes(ends, sizeof ends, 1);
        }
        edges += vertex->edge_count;
        check_landmarks(graph, v);
    }
    for (uint32_t slot = 0; slot < navmesh->slot_count; slot++) {
        if (navmesh->slots[slot].tile != NULL) {
            add_cones(navmesh, slot, names, &content);
        }
    }
    TEST_CHECK(vertices == graph->vertex_count && edges == graph->edge_count);
    free(names);
    return content;
}

// A graph that is mended after edits has the vertices, edges and cones of one that is baked at once.
static void test_mended(void **state)
{
    (void)state;
    test_random random = { 11 };
    const tl_nav_prepare_def def = { .table_bytes = 0, .cookie = TL_DEF_COOKIE };
    uint32_t turning = 0, mended = 0, renewed = 0, vertices = 0;
    for (uint32_t round = 0; round < 10; round++) {
        fixture_level level = fixture_random(&random, round % 5, 24);
        level.tile_cells = 4;
        tl_navmesh *const both[2] = { fixture_build(&level, NULL), fixture_build(&level, NULL) };
        tl_nav_prepared made, anew;
        TEST_RESULT(tl_navmesh_prepare(both[0], &def, &made), TL_OK);
        TEST_CHECK(made.renewed_count == made.corner_vertex_count);
        for (uint32_t edit = 0; edit < 30; edit++) {
            for (uint32_t i = 0; i < 1 + edit % 3; i++) {
                fixture_change_cell(&level, both, &random);
            }
            if (edit % 5 == 4) {
                exchange_slots(&level, both, &random);
            }
            TEST_RESULT(tl_navmesh_prepare(both[0], &def, &made), TL_OK);
            turning += compare(both[0], both[1], &random, 6);
            TEST_RESULT(tl_navmesh_prepare(both[1], &def, &anew), TL_OK);
            TEST_CHECK(made.kind == anew.kind && made.corner_vertex_count == anew.corner_vertex_count);
            TEST_CHECK(made.edge_count == anew.edge_count);
            if (made.kind != TL_NAV_PREPARED_NONE) {
                const graph_content a = content_of(both[0]), b = content_of(both[1]);
                TEST_CHECK(a.vertices == b.vertices && a.edges == b.edges && a.cones == b.cones);
            }
            tl_nav_free_visibility_graph(&both[1]->allocator, both[1]->graph);
            both[1]->graph = NULL;
            mended += made.renewed_count < made.corner_vertex_count;
            renewed += made.renewed_count;
            vertices += made.corner_vertex_count;
            TEST_RESULT(tl_navmesh_prepare(both[0], &def, &made), TL_OK);
            TEST_CHECK(made.renewed_count == 0);
        }
        tl_navmesh_destroy(both[0]);
        tl_navmesh_destroy(both[1]);
    }
    TEST_CHECK(turning > 600 && mended > 240 && renewed < vertices / 3 * 2);
}

// A thousand edits of the same tiles leave no more memory than one, and no other graph.
static void test_many_edits(void **state)
{
    (void)state;
    test_random random = { 12 };
    const tl_nav_prepare_def def = { .table_bytes = 0, .cookie = TL_DEF_COOKIE };
    fixture_level level = fixture_random(&random, 1, 16);
    level.tile_cells = 4;
    tl_navmesh *navmesh = fixture_build(&level, NULL), *fresh = fixture_build(&level, NULL);
    tl_nav_prepared first, made;
    TEST_RESULT(tl_navmesh_prepare(navmesh, &def, &first), TL_OK);
    for (uint32_t edit = 0; edit < 1000; edit++) {
        const int32_t x = (int32_t)test_random_below(&random, 2), z = (int32_t)test_random_below(&random, 2);
        tl_nav_tile *tile = fixture_build_tile(&level, x, z, NULL);
        if (tile != NULL) {
            TEST_RESULT(tl_navmesh_remove_tile(navmesh, x, z), TL_OK);
            TEST_RESULT(edit % 3 == 0 ? tl_navmesh_prepare(navmesh, &def, NULL) : TL_OK, TL_OK);
            TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
        }
        TEST_RESULT(tl_navmesh_prepare(navmesh, &def, &made), TL_OK);
        TEST_CHECK(made.bytes == first.bytes && made.edge_count == first.edge_count);
        TEST_CHECK(edit % 3 == 0 || made.renewed_count == 0); // an equal tile changes nothing
    }
    TEST_RESULT(tl_navmesh_prepare(fresh, &def, NULL), TL_OK);
    const graph_content a = content_of(navmesh), b = content_of(fresh);
    TEST_CHECK(a.vertices == b.vertices && a.edges == b.edges && a.cones == b.cones);
    tl_navmesh_destroy(navmesh);
    tl_navmesh_destroy(fresh);
}

static tl_nav_location location_of(const tl_navmesh *navmesh, const tl_nav_corner_vertex *vertex)
{
    const tl_nav_location location = { tl_nav_make_ref(navmesh, vertex->place.slot, vertex->place.polygon),
                                       tl_vec3_make(vertex->x, vertex->y, vertex->z) };
    return location;
}

// Every edge of a graph is a line of sight: the search over polygons knows no longer way between its ends. Walls that
// run on in line over many small tiles are where an edge once led around a corner.
static void test_edges_are_sights(void **state)
{
    (void)state;
    test_random random = { 31 };
    tl_nav_query *query = fixture_query(1 << 16);
    uint32_t edges = 0;
    for (uint32_t round = 0; round < 20; round++) {
        fixture_level level = fixture_random(&random, round % 5, 24);
        level.tile_cells = 4;
        tl_navmesh *navmesh = fixture_build(&level, NULL), *plain = fixture_build(&level, NULL);
        TEST_RESULT(tl_navmesh_prepare(navmesh, NULL, NULL), TL_OK);
        const tl_nav_visibility_graph *graph = navmesh->graph;
        for (uint32_t i = 0; graph != NULL && i < graph->vertex_room; i++) {
            const tl_nav_corner_vertex *from = &graph->vertices[i];
            for (uint32_t k = 0; k < from->edge_count; k++) {
                const tl_nav_corner_vertex *to = &graph->vertices[from->edges[k].to];
                const tl_nav_path_request request = { NULL, location_of(plain, from), location_of(plain, to) };
                tl_nav_shortest_path path;
                TEST_RESULT(tl_nav_query_find_shortest_path(query, plain, &request, NULL, &path), TL_OK);
                const double x = (double)to->x - (double)from->x, z = (double)to->z - (double)from->z;
                TEST_CHECK(path.length <= sqrt(x * x + z * z) * (1.0 + 1e-5) + 1e-5);
                edges++;
            }
        }
        tl_navmesh_destroy(navmesh);
        tl_navmesh_destroy(plain);
    }
    TEST_CHECK(edges > 5000);
    tl_nav_query_destroy(query);
}

static void test_memory(void **state)
{
    (void)state;
    test_random random = { 7 };
    fixture_level level = fixture_random(&random, 1, 8);
    level.tile_cells = 4;
    test_allocator failing;
    test_allocator_init(&failing, 0);
    tl_navmesh *navmesh = fixture_build(&level, &failing.allocator);
    uint64_t before = failing.live_blocks, failures = 0;
    const tl_nav_prepare_def defs[2] = { { .table_bytes = UINT64_MAX - 1, .cookie = TL_DEF_COOKIE },
                                         { .cookie = TL_DEF_COOKIE } };
    for (uint32_t i = 0; i < 2; i++) {
        tl_result result = TL_ERR_MEMORY;
        for (uint64_t k = 1; result != TL_OK; k++) {
            failing.calls = 0;
            failing.fail_at = k;
            result = tl_navmesh_prepare(navmesh, &defs[i], NULL);
            TEST_CHECK(result == TL_OK || (result == TL_ERR_MEMORY && failing.live_blocks == before));
            TEST_CHECK(tl_navmesh_is_prepared(navmesh) == (result == TL_OK));
            failures += result != TL_OK;
        }
        // An edit ends what was prepared; it is freed by the next call, or here by one that fails.
        failing.fail_at = 0;
        tl_nav_tile *tile = fixture_build_tile(&level, 0, 0, &failing.allocator);
        TEST_RESULT(tl_navmesh_remove_tile(navmesh, 0, 0), TL_OK);
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
        failing.calls = 0;
        failing.fail_at = 1;
        TEST_RESULT(tl_navmesh_prepare(navmesh, &defs[i], NULL), TL_ERR_MEMORY);
        before = failing.live_blocks;
    }
    TEST_CHECK(failures > 60);
    failing.fail_at = 0;
    tl_navmesh_destroy(navmesh);
    TEST_CHECK(failing.live_blocks == 0);
    // Nothing to prepare.
    tl_nav_prepared made;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    TEST_RESULT(tl_navmesh_prepare(navmesh, NULL, &made), TL_OK);
    TEST_CHECK(made.corner_vertex_count == 0 && made.edge_count == 0 && made.table_bytes == 0);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_edits),
        cmocka_unit_test(test_nodes),
        cmocka_unit_test(test_budgets),
        cmocka_unit_test(test_kept_legs),
        cmocka_unit_test(test_slices),
        cmocka_unit_test(test_links),
        cmocka_unit_test(test_edges_are_sights),
        cmocka_unit_test(test_mended),
        cmocka_unit_test(test_many_edits),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
