// SPDX-License-Identifier: MIT
//
// Places divided into layers: the same polygons, links, islands, paths, rays and slides as undivided ones, on built-in
// levels, towers and bridges; the same links whatever layers came and went before.

#include "nav_fixture.h"
#include "stacked_levels.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <talus/nav_bake.h>
#include <talus/nav_prepare.h>
#include <talus/nav_wide.h>

enum { MAX_LINKS = 256, PAIRS = 40 };

// ---------------------------------------------------------------------------------------------------------
// Two navmeshes and which polygon of the one is which of the other.

typedef struct polygon_id {
    uint32_t slot, polygon;
} polygon_id;

typedef struct pair_of_meshes {
    tl_nav_tiles tiles[2]; // undivided, divided
    tl_navmesh *mesh[2];
    polygon_id *twin[2]; // [of all polygons of the one] in the other, by first[slot] + polygon
    uint32_t *first[2];
    uint32_t count;
} pair_of_meshes;

static void number_polygons(pair_of_meshes *p, int side)
{
    const uint32_t slots = tl_navmesh_slot_count(p->mesh[side]);
    p->first[side] = calloc(slots + 1u, sizeof(uint32_t));
    for (uint32_t s = 0; s < slots; s++) {
        p->first[side][s + 1] = p->first[side][s] + tl_navmesh_slot_tile(p->mesh[side], s)->polygon_count;
    }
    TEST_CHECK(side == 0 || p->first[side][slots] == p->count);
    p->count = p->first[side][slots];
    p->twin[side] = calloc(p->count + 1u, sizeof(polygon_id));
}

// Corners, surface, area and flags, bit by bit.
static bool same_polygon(const tl_nav_tile *a, uint32_t p, const tl_nav_tile *b, uint32_t q)
{
    uint32_t n = 0, m = 0;
    const tl_vec3 *u = tl_nav_tile_corners(a, p, &n), *v = tl_nav_tile_corners(b, q, &m);
    const tl_nav_surface s = tl_nav_tile_surface(a, p), t = tl_nav_tile_surface(b, q);
    return n == m && memcmp(u, v, n * sizeof *u) == 0 && s.vertex_count == t.vertex_count &&
           s.triangle_count == t.triangle_count &&
           memcmp(s.vertices, t.vertices, s.vertex_count * sizeof *s.vertices) == 0 && fixture_same_triangles(&s, &t) &&
           tl_nav_tile_area(a, p) == tl_nav_tile_area(b, q) && tl_nav_tile_flags(a, p) == tl_nav_tile_flags(b, q);
}

// The polygons of an undivided tile stand in its layers in the same order: each is the next one of some layer.
static void find_twins(pair_of_meshes *p)
{
    uint32_t *next = calloc(p->tiles[1].tile_count, sizeof *next);
    for (uint32_t s = 0; s < p->tiles[0].tile_count; s++) {
        const tl_nav_tile *whole = p->tiles[0].tiles[s];
        for (uint32_t q = 0; q < whole->polygon_count; q++) {
            uint32_t t = 0;
            for (; t < p->tiles[1].tile_count; t++) {
                const tl_nav_tile *part = p->tiles[1].tiles[t];
                if (part->tile_x == whole->tile_x && part->tile_z == whole->tile_z && next[t] < part->polygon_count &&
                    same_polygon(whole, q, part, next[t])) {
                    break;
                }
            }
            TEST_CHECK(t < p->tiles[1].tile_count);
            const polygon_id there = { t, next[t] }, here = { s, q };
            p->twin[0][p->first[0][s] + q] = there;
            p->twin[1][p->first[1][t] + next[t]] = here;
            next[t]++;
        }
    }
    for (uint32_t t = 0; t < p->tiles[1].tile_count; t++) {
        TEST_CHECK(next[t] == p->tiles[1].tiles[t]->polygon_count);
    }
    free(next);
}

static tl_navmesh *mesh_of(const tl_nav_tiles *tiles)
{
    tl_navmesh *navmesh;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    for (uint32_t i = 0; i < tiles->tile_count; i++) {
        TEST_RESULT(tl_nav_tile_check(tiles->tiles[i], tiles->tiles[i]->blob.size, NULL), TL_OK);
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tiles->tiles[i], TL_NAV_TILE_BORROWED), TL_OK);
        TEST_CHECK(tl_navmesh_slot_tile(navmesh, i) == tiles->tiles[i]);
    }
    return navmesh;
}

// Each polygon in a layer of its own choice: cuts everywhere.
static void divide_at_random(const tl_nav_tiles *whole, uint32_t layer_count, test_random *random, tl_nav_tiles *out)
{
    memset(out, 0, sizeof *out);
    uint32_t room = whole->tile_count * layer_count;
    tl_nav_tile **tiles = calloc(room, sizeof *tiles);
    for (uint32_t t = 0; t < whole->tile_count; t++) {
        const tl_nav_tile *tile = whole->tiles[t];
        uint32_t *layers = malloc(tile->polygon_count * sizeof *layers);
        for (uint32_t p = 0; p < tile->polygon_count; p++) {
            layers[p] = 3 * test_random_below(random, layer_count);
        }
        tl_nav_tile_stack stack;
        TEST_RESULT(tl_nav_tile_divide(tile, layers, NULL, &stack, NULL), TL_OK);
        for (uint32_t i = 0; i < stack.count; i++) {
            TEST_CHECK(i == 0 || tiles[out->tile_count - 1]->layer < stack.tiles[i]->layer);
            tiles[out->tile_count++] = stack.tiles[i];
            stack.tiles[i] = NULL;
        }
        tl_nav_tile_stack_free(&stack);
        free(layers);
    }
    // As long as their number, and of the standard allocator: tl_nav_tiles_free rests on both.
    out->tiles = test_blob_alloc(out->tile_count * sizeof *tiles);
    memcpy(out->tiles, tiles, out->tile_count * sizeof *tiles);
    free(tiles);
}

// tile_height < 0: that many layers at random.
static void make_pair(const tl_nav_def *def, const tl_nav_input *input, float tile_height, pair_of_meshes *p)
{
    memset(p, 0, sizeof *p);
    for (int side = 0; side < 2; side++) {
        tl_nav_def own = *def;
        own.tile_height = side == 0 || tile_height < 0 ? 0.0f : tile_height;
        tl_nav_bake_report report;
        test_random random = { 3 };
        if (side == 1 && tile_height < 0) {
            divide_at_random(&p->tiles[0], (uint32_t)-tile_height, &random, &p->tiles[1]);
        } else {
            TEST_RESULT(tl_nav_bake(&own, input, &p->tiles[side], &report), TL_OK);
            TEST_CHECK(report.tile_count == p->tiles[side].tile_count);
        }
        p->mesh[side] = mesh_of(&p->tiles[side]);
        number_polygons(p, side);
    }
    find_twins(p);
}

static void free_pair(pair_of_meshes *p)
{
    for (int side = 0; side < 2; side++) {
        tl_navmesh_destroy(p->mesh[side]);
        tl_nav_tiles_free(&p->tiles[side]);
        free(p->twin[side]);
        free(p->first[side]);
    }
}

static polygon_id id_of(const tl_navmesh *navmesh, tl_nav_ref ref)
{
    polygon_id id = { (uint32_t)(ref >> 28) & 0xfffffu, (uint32_t)ref & 0xfffffffu };
    TEST_CHECK(tl_navmesh_polygon_ref(navmesh, id.slot, id.polygon) == ref);
    return id;
}

static tl_nav_ref twin_ref(const pair_of_meshes *p, int side, tl_nav_ref ref)
{
    const polygon_id id = id_of(p->mesh[side], ref);
    const polygon_id twin = p->twin[side][p->first[side][id.slot] + id.polygon];
    return tl_navmesh_polygon_ref(p->mesh[1 - side], twin.slot, twin.polygon);
}

// ---------------------------------------------------------------------------------------------------------
// What has to be the same.

// Every link of each has its twin; returns how many lead over cuts.
static uint32_t check_links(const pair_of_meshes *p)
{
    uint32_t cuts = 0;
    TEST_CHECK(tl_navmesh_link_count(p->mesh[0]) == tl_navmesh_link_count(p->mesh[1]));
    for (uint32_t s = 0; s < p->tiles[0].tile_count; s++) {
        for (uint32_t q = 0; q < p->tiles[0].tiles[s]->polygon_count; q++) {
            tl_nav_link links[2][MAX_LINKS];
            uint32_t count[2];
            const tl_nav_ref ref = tl_navmesh_polygon_ref(p->mesh[0], s, q), twin = twin_ref(p, 0, ref);
            TEST_RESULT(tl_navmesh_links(p->mesh[0], ref, links[0], MAX_LINKS, &count[0]), TL_OK);
            TEST_RESULT(tl_navmesh_links(p->mesh[1], twin, links[1], MAX_LINKS, &count[1]), TL_OK);
            TEST_CHECK(count[0] == count[1]);
            for (uint32_t i = 0; i < count[0]; i++) {
                const tl_nav_link *a = &links[0][i];
                uint32_t k = 0;
                while (k < count[1] && (links[1][k].edge != a->edge || links[1][k].to != twin_ref(p, 0, a->to) ||
                                        memcmp(&links[1][k].left, &a->left, sizeof a->left) != 0 ||
                                        memcmp(&links[1][k].right, &a->right, sizeof a->right) != 0)) {
                    k++;
                }
                TEST_CHECK(k < count[1]);
                cuts += id_of(p->mesh[0], a->to).slot == s &&
                        id_of(p->mesh[1], links[1][k].to).slot != id_of(p->mesh[1], twin).slot;
                links[1][k].edge = UINT32_MAX; // each once
            }
        }
    }
    return cuts;
}

static void check_islands(const pair_of_meshes *p)
{
    // The island of a polygon here must be the same whenever it is there, and the other way around.
    enum { SEEN = 1 << 16 };
    uint32_t *seen = malloc(2 * SEEN * sizeof *seen);
    memset(seen, 0xff, 2 * SEEN * sizeof *seen);
    for (uint32_t s = 0; s < p->tiles[0].tile_count; s++) {
        for (uint32_t q = 0; q < p->tiles[0].tiles[s]->polygon_count; q++) {
            uint32_t a = 0, b = 0;
            const tl_nav_ref ref = tl_navmesh_polygon_ref(p->mesh[0], s, q);
            TEST_RESULT(tl_navmesh_island(p->mesh[0], ref, &a), TL_OK);
            TEST_RESULT(tl_navmesh_island(p->mesh[1], twin_ref(p, 0, ref), &b), TL_OK);
            TEST_CHECK(a < SEEN && b < SEEN);
            TEST_CHECK((seen[a] == UINT32_MAX || seen[a] == b) &&
                       (seen[SEEN + b] == UINT32_MAX || seen[SEEN + b] == a));
            seen[a] = b;
            seen[SEEN + b] = a;
        }
    }
    free(seen);
}

static bool random_place(const pair_of_meshes *p, test_random *random, tl_aabb bounds, tl_nav_location places[2])
{
    const tl_vec3 at = test_random_point(random, bounds.min, bounds.max);
    const tl_vec3 reach = { 2, 3, 2 };
    const tl_result a = tl_navmesh_find_nearest(p->mesh[0], NULL, at, reach, &places[0]);
    TEST_RESULT(tl_navmesh_find_nearest(p->mesh[1], NULL, at, reach, &places[1]), a);
    if (a == TL_OK) {
        // Two polygons may be as near.
        const tl_vec3 d = tl_sub(at, places[0].point), e = tl_sub(at, places[1].point);
        TEST_CHECK(tl_dot(d, d) == tl_dot(e, e));
        places[1].polygon = twin_ref(p, 0, places[0].polygon);
        places[1].point = places[0].point;
    }
    return a == TL_OK;
}

typedef struct tally {
    uint64_t cuts, paths, equal_bits, rays, slides, over_layers, wide, wide_equal;
    double worst;
} tally;

static double check_path(const pair_of_meshes *p, tl_nav_query *query, const tl_nav_location from[2],
                         const tl_nav_location to[2], tally *sum)
{
    tl_nav_shortest_path path[2];
    for (int side = 0; side < 2; side++) {
        TEST_RESULT(tl_nav_query_find_shortest_path(
                        query, p->mesh[side], &(tl_nav_path_request){ NULL, from[side], to[side] }, NULL, &path[side]),
                    TL_OK);
    }
    TEST_CHECK(path[0].status == path[1].status);
    sum->paths += path[0].status == TL_NAV_PATH_COMPLETE;
    sum->equal_bits += path[0].status == TL_NAV_PATH_COMPLETE && path[0].length == path[1].length;
    return path[0].length > 0 ? fabs(path[0].length - path[1].length) / path[0].length : 0.0;
}

// Whether an agent wider than the mesh's own gets there, from places where it has room.
static void check_wide(const pair_of_meshes *p, tl_nav_query *query, const tl_nav_location from[2],
                       const tl_nav_location to[2], tally *sum)
{
    tl_nav_location ends[2][2];
    if (tl_nav_query_find_wide_place(query, p->mesh[0], &(tl_nav_around_request){ NULL, from[0], 2.0f }, 0.9f,
                                     &ends[0][0]) != TL_OK ||
        tl_nav_query_find_wide_place(query, p->mesh[0], &(tl_nav_around_request){ NULL, to[0], 2.0f }, 0.9f,
                                     &ends[0][1]) != TL_OK) {
        return;
    }
    tl_nav_wide_path path[2];
    for (int side = 0; side < 2; side++) {
        for (int i = 0; i < 2; i++) {
            ends[1][i].polygon = twin_ref(p, 0, ends[0][i].polygon);
            ends[1][i].point = ends[0][i].point;
        }
        TEST_RESULT(tl_nav_query_find_wide_path(query, p->mesh[side],
                                                &(tl_nav_path_request){ NULL, ends[side][0], ends[side][1] }, 0.9f,
                                                NULL, 0, &path[side]),
                    path[side].corner_count > 0 ? TL_INCOMPLETE : TL_OK);
    }
    TEST_CHECK(path[0].status == path[1].status);
    sum->wide += path[0].status == TL_NAV_WIDE_COMPLETE;
    sum->wide_equal += path[0].status == TL_NAV_WIDE_COMPLETE && path[0].length == path[1].length;
}

static void check_queries(const pair_of_meshes *p, tl_nav_query *query, tl_aabb bounds, tally *sum)
{
    test_random random = { 11 };
    for (uint32_t i = 0; i < PAIRS; i++) {
        tl_nav_location from[2], to[2];
        if (!random_place(p, &random, bounds, from) || !random_place(p, &random, bounds, to)) {
            continue;
        }
        const double off = check_path(p, query, from, to, sum);
        sum->worst = off > sum->worst ? off : sum->worst;
        sum->over_layers += id_of(p->mesh[0], from[0].polygon).slot == id_of(p->mesh[0], to[0].polygon).slot &&
                            id_of(p->mesh[1], from[1].polygon).slot != id_of(p->mesh[1], to[1].polygon).slot;
        check_wide(p, query, from, to, sum);
        tl_nav_ray_hit hit[2];
        tl_nav_move move[2];
        for (int side = 0; side < 2; side++) {
            const tl_nav_move_request request = { NULL, from[side], tl_lerp(from[side].point, to[side].point, 0.2f) };
            TEST_RESULT(tl_navmesh_cast_ray(p->mesh[side], NULL, &from[side], to[side].point, NULL, 0, &hit[side]),
                        TL_OK);
            TEST_RESULT(tl_nav_query_move_along_surface(query, p->mesh[side], &request, NULL, 0, &move[side]), TL_OK);
        }
        TEST_CHECK(hit[0].hit == hit[1].hit && hit[0].t == hit[1].t && hit[0].polygon_count == hit[1].polygon_count &&
                   twin_ref(p, 0, hit[0].polygon) == hit[1].polygon);
        TEST_CHECK(move[0].end.point.x == move[1].end.point.x && move[0].end.point.z == move[1].end.point.z);
        sum->rays++;
        sum->slides++;
    }
}

// ---------------------------------------------------------------------------------------------------------

static void check_level(const level_source *source, const uint32_t *sizes, uint32_t size_count, tl_nav_query *query,
                        tally *sum)
{
    static const float heights[] = { 1.0f, 2.9f, 6.0f, 500.0f, -2.0f, -5.0f };
    enum { HEIGHTS = sizeof heights / sizeof *heights };
    tl_sample_mesh mesh;
    make_level(source, &mesh);
    const tl_nav_input input = { tl_sample_mesh_as_view(&mesh), NULL, NULL, 0 };
    for (uint32_t k = 0; k < HEIGHTS * size_count; k++) {
        pair_of_meshes p;
        tl_nav_def def = tl_default_nav_def();
        const float height = heights[k % HEIGHTS];
        def.tile_size = sizes[k / HEIGHTS];
        def.partition = (tl_nav_partition)((k + k / HEIGHTS) % 3);
        make_pair(&def, &input, height, &p);
        const tl_aabb bounds = bounds_of(&mesh);
        sum->cuts += check_links(&p);
        check_islands(&p);
        check_queries(&p, query, bounds, sum);
        const tl_nav_wide_def wide = tl_default_nav_wide_def();
        for (int side = 0; side < 2; side++) {
            TEST_RESULT(tl_navmesh_prepare_wide(p.mesh[side], &wide, NULL), TL_OK);
            TEST_RESULT(tl_navmesh_prepare(p.mesh[side], NULL, NULL), TL_OK);
        }
        TEST_CHECK(tl_navmesh_is_prepared(p.mesh[0]) == tl_navmesh_is_prepared(p.mesh[1]));
        check_queries(&p, query, bounds, sum);
        if (height == 500.0f) {
            TEST_CHECK(p.tiles[0].tile_count == p.tiles[1].tile_count);
        }
        free_pair(&p);
    }
    tl_sample_mesh_free(&mesh);
}

static void test_same_as_undivided(void **state)
{
    (void)state;
    static const uint32_t sizes[] = { 0, 24, 48 };
    tl_nav_query *query;
    const tl_nav_query_def def = tl_default_nav_query_def();
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    tally all = { 0, 0, 0, 0, 0, 0, 0, 0, 0.0 };
    for (size_t i = 0; i < sizeof STACKED_LEVELS / sizeof *STACKED_LEVELS; i++) {
        tally sum = { 0, 0, 0, 0, 0, 0, 0, 0, 0.0 };
        check_level(&STACKED_LEVELS[i], sizes, 3, query, &sum);
        printf("%-10s %5llu links over cuts, %5llu paths (%llu equal to the bit, the others to %.1e), %5llu rays, %llu "
               "wide paths (%llu "
               "equal)\n",
               STACKED_LEVELS[i].name, (unsigned long long)sum.cuts, (unsigned long long)sum.paths,
               (unsigned long long)sum.equal_bits, sum.worst, (unsigned long long)sum.rays,
               (unsigned long long)sum.wide, (unsigned long long)sum.wide_equal);
        TEST_CHECK(sum.worst < 1e-6);
        all.cuts += sum.cuts;
        all.paths += sum.paths;
        all.wide += sum.wide;
        all.over_layers += sum.over_layers;
        all.worst = sum.worst > all.worst ? sum.worst : all.worst;
    }
    TEST_CHECK(all.cuts > 1000 && all.paths > 1000 && all.over_layers > 100 && all.wide > 1000);
    tl_nav_query_destroy(query);
}

// ---------------------------------------------------------------------------------------------------------
// Layers that come and go.

// Random shortest paths are as long in both, which rests on where paths may turn.
static uint32_t check_same_paths(const tl_navmesh *meshes[2], tl_nav_query *query, tl_aabb bounds, test_random *random)
{
    uint32_t complete = 0;
    for (uint32_t i = 0; i < 6; i++) {
        const tl_vec3 at[2] = { test_random_point(random, bounds.min, bounds.max),
                                test_random_point(random, bounds.min, bounds.max) };
        tl_nav_shortest_path path[2];
        uint32_t found = 0;
        for (int m = 0; m < 2; m++) {
            tl_nav_location ends[2];
            const tl_vec3 reach = { 2, 3, 2 };
            if (tl_navmesh_find_nearest(meshes[m], NULL, at[0], reach, &ends[0]) == TL_OK &&
                tl_navmesh_find_nearest(meshes[m], NULL, at[1], reach, &ends[1]) == TL_OK) {
                TEST_RESULT(tl_nav_query_find_shortest_path(
                                query, meshes[m], &(tl_nav_path_request){ NULL, ends[0], ends[1] }, NULL, &path[m]),
                            TL_OK);
                found++;
            }
        }
        TEST_CHECK(found == 0 || found == 2);
        if (found == 2) {
            TEST_CHECK(path[0].status == path[1].status && fabs(path[0].length - path[1].length) < 1e-6);
            complete += path[0].status == TL_NAV_PATH_COMPLETE;
        }
    }
    return complete;
}

// The same links in the same order as a navmesh of the same tiles that was made afresh, and the same islands.
static uint32_t check_against_fresh(const tl_navmesh *edited, const pair_of_meshes *p, const bool *present,
                                    tl_nav_query *query, tl_aabb bounds, test_random *random)
{
    tl_navmesh *fresh;
    TEST_RESULT(tl_navmesh_create(NULL, &fresh), TL_OK);
    for (uint32_t i = p->tiles[1].tile_count; i-- > 0;) {
        if (present[i]) {
            TEST_RESULT(tl_navmesh_add_tile(fresh, p->tiles[1].tiles[i], TL_NAV_TILE_BORROWED), TL_OK);
        }
    }
    const tl_navmesh *meshes[2] = { fresh, edited };
    TEST_CHECK(tl_navmesh_link_count(fresh) == tl_navmesh_link_count(edited));
    for (uint32_t s = 0; s < tl_navmesh_slot_count(fresh); s++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(fresh, s);
        uint32_t other = 0;
        while (tl_navmesh_slot_tile(edited, other) != tile) {
            other++;
        }
        for (uint32_t q = 0; q < tile->polygon_count; q++) {
            tl_nav_link links[2][MAX_LINKS];
            uint32_t count[2], islands[2][2];
            for (int m = 0; m < 2; m++) {
                const tl_nav_ref ref = tl_navmesh_polygon_ref(meshes[m], m == 0 ? s : other, q);
                TEST_RESULT(tl_navmesh_links(meshes[m], ref, links[m], MAX_LINKS, &count[m]), TL_OK);
                TEST_RESULT(tl_navmesh_island(meshes[m], ref, &islands[m][0]), TL_OK);
            }
            TEST_CHECK(count[0] == count[1]);
            for (uint32_t i = 0; i < count[0]; i++) {
                const tl_nav_tile *to[2];
                uint32_t polygon[2];
                for (int m = 0; m < 2; m++) {
                    TEST_RESULT(tl_navmesh_resolve(meshes[m], links[m][i].to, &to[m], &polygon[m]), TL_OK);
                    TEST_RESULT(tl_navmesh_island(meshes[m], links[m][i].to, &islands[m][1]), TL_OK);
                    TEST_CHECK(islands[m][0] == islands[m][1]);
                }
                TEST_CHECK(to[0] == to[1] && polygon[0] == polygon[1] && links[0][i].edge == links[1][i].edge &&
                           memcmp(&links[0][i].left, &links[1][i].left, sizeof(tl_vec3)) == 0 &&
                           memcmp(&links[0][i].right, &links[1][i].right, sizeof(tl_vec3)) == 0);
            }
        }
    }
    const uint32_t paths = check_same_paths(meshes, query, bounds, random);
    tl_navmesh_destroy(fresh);
    return paths;
}

static void test_edits(void **state)
{
    (void)state;
    static const float heights[] = { 2.9f, -3.0f };
    test_random random = { 8 };
    tl_nav_query *query;
    const tl_nav_query_def query_def = tl_default_nav_query_def();
    TEST_RESULT(tl_nav_query_create(&query_def, &query, NULL), TL_OK);
    uint32_t paths = 0;
    for (uint32_t k = 0; k < 8; k++) {
        tl_sample_mesh mesh;
        make_level(&STACKED_LEVELS[k / 2], &mesh);
        const tl_nav_input input = { tl_sample_mesh_as_view(&mesh), NULL, NULL, 0 };
        pair_of_meshes p;
        tl_nav_def def = tl_default_nav_def();
        def.tile_size = 32;
        make_pair(&def, &input, heights[k % 2], &p);
        const uint32_t count = p.tiles[1].tile_count;
        bool *present = malloc(count);
        const tl_aabb bounds = bounds_of(&mesh);
        memset(present, 1, count);
        for (uint32_t edit = 0; edit < 60; edit++) {
            const uint32_t t = test_random_below(&random, count);
            const tl_nav_tile *tile = p.tiles[1].tiles[t];
            const tl_nav_tile *there = tl_navmesh_find_layer(p.mesh[1], tile->tile_x, tile->layer, tile->tile_z);
            TEST_CHECK(there == (present[t] ? tile : NULL));
            if (present[t]) {
                TEST_RESULT(tl_navmesh_add_tile(p.mesh[1], tile, TL_NAV_TILE_BORROWED), TL_ERR_ARGUMENT);
                TEST_RESULT(tl_navmesh_remove_layer(p.mesh[1], tile->tile_x, tile->layer, tile->tile_z), TL_OK);
            } else {
                TEST_RESULT(tl_navmesh_remove_layer(p.mesh[1], tile->tile_x, tile->layer, tile->tile_z), TL_NOT_FOUND);
                TEST_RESULT(tl_navmesh_add_tile(p.mesh[1], tile, TL_NAV_TILE_BORROWED), TL_OK);
            }
            present[t] = !present[t];
            paths += check_against_fresh(p.mesh[1], &p, present, query, bounds, &random);
        }
        // All of a place at once, and all back.
        const tl_nav_tile *first = p.tiles[1].tiles[0];
        (void)tl_navmesh_remove_tile(p.mesh[1], first->tile_x, first->tile_z);
        TEST_CHECK(tl_navmesh_find_tile(p.mesh[1], first->tile_x, first->tile_z) == NULL);
        for (uint32_t t = 0; t < count; t++) {
            const tl_nav_tile *tile = p.tiles[1].tiles[t];
            if (tl_navmesh_find_layer(p.mesh[1], tile->tile_x, tile->layer, tile->tile_z) == NULL) {
                TEST_RESULT(tl_navmesh_add_tile(p.mesh[1], tile, TL_NAV_TILE_BORROWED), TL_OK);
            }
            present[t] = true;
        }
        check_against_fresh(p.mesh[1], &p, present, query, bounds, &random);
        free(present);
        free_pair(&p);
        tl_sample_mesh_free(&mesh);
    }
    printf("%u paths\n", paths);
    TEST_CHECK(paths > 100);
    tl_nav_query_destroy(query);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_same_as_undivided), cmocka_unit_test(test_edits) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
