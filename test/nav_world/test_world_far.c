// SPDX-License-Identifier: MIT
//
// A level 1e7 m from the origin and farther: its triangles in the frame that a world keeps beside the agent, with the
// world's tiles. Rays through the triangles, rays and paths over the navmesh, and the audit of one against the other
// are bit by bit those of the level at the origin.

#include "nav_audit_level.h"
#include "nav_world_file.h"

#include <math.h>
#include <talus/nav_audit.h>

enum { PLACES = 5, RAYS = 400, PATHS = 200 };

// The level's 0 in the world. A double tells the level's floats apart at all of them.
static const double FAR[PLACES][3] = {
    { 0, 0, 0 }, { 1e7, 0, -1e7 }, { -10000000.5, 512, 9999999.75 }, { 3e9, -1024, 123456789 }, { 4096.5, 8, 1e9 }
};

typedef struct far_level {
    test_level baked, now; // now: a block stands on the floor that the navmesh does not know, and one is gone
    tl_nav_def def;
    tl_nav_tiles tiles;
} far_level;

static void make_level(far_level *level)
{
    memset(level, 0, sizeof *level);
    test_level_make(&level->baked, tl_vec3_make(0, 0, 0));
    test_level_make(&level->now, tl_vec3_make(0, 0, 0));
    audit_block(&level->now, 18, 0, 3, 19, 2, 5);
    audit_floor(&level->now, 5.5f, 2, 6.5f, 6, 0.25f);
    level->def = tl_default_nav_def();
    level->def.tile_size = 24;
    level->def.bounds = test_level_bounds(&level->baked);
    const tl_nav_input input = { level->baked.mesh, NULL, NULL, 0 };
    TEST_RESULT(tl_nav_bake(&level->def, &input, &level->tiles, NULL), TL_OK);
    TEST_CHECK(level->tiles.tile_count > 8);
}

// Sixteenths, so that it is the same number at any origin of FAR.
static void place_near(test_random *random, const far_level *level, const double origin[3], double out[3])
{
    const tl_aabb *box = &level->def.bounds;
    const float low[3] = { box->min.x, 0, box->min.z }, high[3] = { box->max.x, 4, box->max.z };
    for (int i = 0; i < 3; i++) {
        out[i] = origin[i] + floor((double)test_random_range(random, low[i], high[i]) * 16.0) / 16.0;
    }
}

static uint64_t hash_bytes(uint64_t hash, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    for (size_t i = 0; i < size; i++) {
        hash = fixture_hash(hash, at[i]);
    }
    return hash;
}

static uint64_t hash_vec3(uint64_t hash, tl_vec3 v)
{
    const float all[3] = { v.x, v.y, v.z };
    return hash_bytes(hash, all, sizeof all);
}

// The triangles of the level as they stand in the world, in the world's frame.
static tl_soup *bake_soup_there(const far_level *level, const tl_nav_world *world, const double origin[3])
{
    test_level there = level->now;
    tl_soup *soup = NULL;
    for (uint32_t i = 0; i < there.mesh.vertex_count; i++) {
        const tl_vec3 v = level->now.vertices[i];
        const double at[3] = { origin[0] + (double)v.x, origin[1] + (double)v.y, origin[2] + (double)v.z };
        there.vertices[i] = tl_nav_world_place_in(world, at);
    }
    there.mesh.vertices = there.vertices;
    there.mesh.indices = there.indices;
    TEST_RESULT(tl_soup_bake(&there.mesh, NULL, &soup, NULL), TL_OK);
    return soup;
}

static uint64_t ask_rays(const far_level *level, const tl_nav_world *world, const tl_soup *soup, const double origin[3],
                         uint32_t *hits)
{
    test_random random = { 8 };
    uint64_t hash = 0;
    for (uint32_t i = 0; i < RAYS; i++) {
        double from[3], to[3];
        tl_ray_hit hit;
        memset(&hit, 0, sizeof hit);
        place_near(&random, level, origin, from);
        place_near(&random, level, origin, to);
        const tl_vec3 a = tl_nav_world_place_in(world, from), b = tl_nav_world_place_in(world, to);
        if (tl_length_sq(tl_sub(b, a)) == 0.0f) {
            continue;
        }
        const tl_ray ray = { a, tl_sub(b, a), 2.0f };
        *hits += tl_soup_cast_ray(soup, &ray, NULL, &hit);
        hash = hash_bytes(fixture_hash(hash, hit.triangle), &hit.t, sizeof hit.t);
        hash = hash_vec3(hash, hit.normal);
    }
    return hash;
}

static uint64_t ask_paths(const far_level *level, const tl_nav_world *world, const double origin[3], uint32_t *found)
{
    const tl_vec3 extents = { 2, 5, 2 };
    test_random random = { 9 };
    tl_nav_query *query = NULL;
    uint64_t hash = 0;
    TEST_RESULT(tl_nav_query_create(NULL, &query, NULL), TL_OK);
    for (uint32_t i = 0; i < PATHS; i++) {
        double ends[2][3];
        tl_nav_location at[2];
        tl_nav_corner corners[64];
        const tl_nav_path_buffers buffers = { NULL, 0, corners, 64 };
        tl_result result = TL_OK;
        for (int e = 0; e < 2; e++) {
            place_near(&random, level, origin, ends[e]);
            const tl_result nearest = tl_nav_world_find_nearest(world, NULL, ends[e], extents, &at[e]);
            hash = hash_vec3(fixture_hash(hash, (uint64_t)nearest), at[e].point);
            result = nearest != TL_OK ? nearest : result;
        }
        if (result != TL_OK) {
            continue;
        }
        const tl_nav_path_request request = { NULL, at[0], at[1] };
        tl_nav_shortest_path path;
        tl_nav_ray_hit hit;
        TEST_RESULT(tl_nav_world_find_path(world, query, &request, &buffers, &path), TL_OK);
        hash = hash_bytes(fixture_hash(hash, (uint64_t)path.status), &path.length, sizeof path.length);
        for (uint32_t c = 0; c < path.corner_count && c < 64; c++) {
            hash = hash_vec3(hash, corners[c].point);
        }
        TEST_RESULT(tl_nav_world_cast_ray(world, NULL, &at[0], ends[1], &hit), TL_OK);
        hash = hash_vec3(hash_bytes(fixture_hash(hash, hit.hit), &hit.t, sizeof hit.t), hit.point);
        *found += path.status == TL_NAV_PATH_COMPLETE;
    }
    tl_nav_query_destroy(query);
    return hash;
}

static uint64_t ask_audit(const far_level *level, const tl_nav_world *world, const tl_soup *soup,
                          const double origin[3], uint32_t *findings)
{
    tl_nav_audit_def def = tl_default_nav_audit_def();
    tl_nav_audit audit;
    uint64_t hash = 0;
    const tl_aabb *box = &level->def.bounds;
    const double low[3] = { origin[0] + (double)box->min.x, origin[1] + (double)box->min.y,
                            origin[2] + (double)box->min.z };
    const double high[3] = { origin[0] + (double)box->max.x, origin[1] + (double)box->max.y,
                             origin[2] + (double)box->max.z };
    def.nav = level->def;
    def.nav.bounds.min = tl_nav_world_place_in(world, low);
    def.nav.bounds.max = tl_nav_world_place_in(world, high);
    def.path_count = 50;
    TEST_RESULT(tl_nav_audit_run(&def, tl_nav_world_navmesh(world), soup, &audit, NULL), TL_OK);
    hash = fixture_hash(fixture_hash(hash, audit.step_count), audit.tolerated_count);
    hash = fixture_hash(fixture_hash(hash, audit.floor_samples), audit.contradictions);
    hash = hash_bytes(hash, &audit.path_metres, sizeof audit.path_metres);
    for (uint32_t i = 0; i < audit.finding_count; i++) {
        const tl_nav_finding *finding = &audit.findings[i];
        hash = fixture_hash(fixture_hash(hash, (uint64_t)finding->kind), finding->triangle);
        hash = hash_vec3(hash_vec3(hash, finding->point), finding->contact);
        hash = hash_bytes(hash, &finding->depth, sizeof finding->depth);
    }
    *findings += audit.finding_count;
    tl_nav_audit_free(&audit);
    return hash;
}

static void test_all_as_at_the_origin(void **state)
{
    (void)state;
    static far_level level;
    uint64_t rays[PLACES], paths[PLACES], audits[PLACES];
    uint32_t hits = 0, found = 0, findings = 0;
    make_level(&level);
    for (int i = 0; i < PLACES; i++) {
        world_file file = world_file_pack(&level.def, &level.tiles, FAR[i], TL_PACK_AXES_Y_UP);
        tl_nav_world *world = world_open(&file, (uint64_t)64 << 20, 4096.0);
        const tl_nav_world_interest interest = world_interest(FAR[i], 12.5, 9.5, 100.0);
        world_settle(world, &interest, 1);
        TEST_CHECK(world_state(world).loaded == world_state(world).places);
        tl_soup *soup = bake_soup_there(&level, world, FAR[i]);
        rays[i] = ask_rays(&level, world, soup, FAR[i], &hits);
        paths[i] = ask_paths(&level, world, FAR[i], &found);
        audits[i] = ask_audit(&level, world, soup, FAR[i], &findings);
        TEST_CHECK(rays[i] == rays[0]);
        TEST_CHECK(paths[i] == paths[0]);
        TEST_CHECK(audits[i] == audits[0]);
        tl_blob_free(soup);
        tl_nav_world_destroy(world);
        world_file_free(&file);
    }
    print_message("at %d places: %u rays hit, %u paths, %u findings of the audit\n", PLACES, hits, found, findings);
    TEST_CHECK(hits > 500 && found > 300 && findings > 5);
    tl_nav_tiles_free(&level.tiles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_as_at_the_origin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
