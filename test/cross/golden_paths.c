// SPDX-License-Identifier: MIT
//
// What a navmesh answers: paths, rays, moves, walls, floods, zones, corridors; prepared data; sight.

#include "golden.h"

#include <stdlib.h>
#include <string.h>

enum { PATHS = 120, CAPACITY = 1024 };

typedef struct nav_buffers {
    tl_nav_ref polygons[CAPACITY];
    tl_nav_corner corners[CAPACITY];
    tl_nav_field_entry entries[CAPACITY];
    tl_nav_wall_segment walls[256];
} nav_buffers;

typedef struct nav_digests {
    digest path, shortest, wide, ray, move, around, corridor;
} nav_digests;

typedef struct nav_task {
    const tl_navmesh *navmesh;
    tl_nav_query *query;
    nav_buffers *buffers;
    tl_nav_path_request request;
} nav_task;

static uint64_t roll_long(dice *random)
{
    const uint64_t high = roll(random, 0x80000000u);
    return high << 33 | (uint64_t)roll(random, 0x80000000u) << 2;
}

static void ask_path(nav_task *task, digest *d)
{
    nav_buffers *b = task->buffers;
    tl_nav_path path;
    digest_u32(
        d, (uint32_t)tl_nav_query_find_path(task->query, task->navmesh, &task->request, b->polygons, CAPACITY, &path));
    digest_found(d, path.status == TL_NAV_PATH_COMPLETE);
    digest_f32(d, path.cost);
    digest_vec3(d, path.end.point);
    for (uint32_t i = 0; i < path.polygon_count && i < CAPACITY; i++) {
        digest_u64(d, b->polygons[i]);
    }
    if (path.polygon_count == 0) {
        return;
    }
    const tl_nav_polygon_path along = { b->polygons, path.polygon_count, task->request.start.point, path.end.point };
    uint32_t count = 0;
    float length = 0;
    if (digest_result(d, tl_navmesh_straight_path(task->navmesh, &along, b->corners, CAPACITY, &count, &length))) {
        digest_f32(d, length);
        for (uint32_t i = 0; i < count; i++) {
            digest_vec3(d, b->corners[i].point);
        }
    }
}

static void ask_shortest(nav_task *task, digest *d)
{
    nav_buffers *b = task->buffers;
    const tl_nav_path_buffers out = { b->polygons, CAPACITY, b->corners, CAPACITY };
    tl_nav_shortest_path path;
    digest_u32(d, (uint32_t)tl_nav_query_find_shortest_path(task->query, task->navmesh, &task->request, &out, &path));
    digest_found(d, path.status == TL_NAV_PATH_COMPLETE);
    digest_f64(d, path.length);
    digest_f64(d, path.lower_bound);
    for (uint32_t i = 0; i < path.corner_count && i < CAPACITY; i++) {
        digest_vec3(d, b->corners[i].point);
    }
}

static void ask_wide(nav_task *task, digest *d)
{
    nav_buffers *b = task->buffers;
    tl_nav_wide_path path;
    digest_u32(d, (uint32_t)tl_nav_query_find_wide_path(task->query, task->navmesh, &task->request, 1.0f, b->corners,
                                                        CAPACITY, &path));
    digest_found(d, path.status == TL_NAV_WIDE_COMPLETE);
    digest_f64(d, path.length);
    for (uint32_t i = 0; i < path.corner_count && i < CAPACITY; i++) {
        digest_vec3(d, b->corners[i].point);
    }
}

static void ask_ray_and_move(nav_task *task, nav_digests *d, dice *random)
{
    nav_buffers *b = task->buffers;
    const tl_nav_location start = task->request.start;
    tl_nav_ray_hit hit;
    digest_u32(&d->ray, (uint32_t)tl_navmesh_cast_ray(task->navmesh, NULL, &start, task->request.goal.point,
                                                      b->polygons, CAPACITY, &hit));
    digest_found(&d->ray, hit.hit);
    digest_f32(&d->ray, hit.t);
    digest_vec3(&d->ray, hit.point);
    digest_vec3(&d->ray, hit.normal);
    const tl_aabb step = { { -3, 0, -3 }, { 3, 0, 3 } };
    tl_nav_move_request request = { NULL, start, tl_add(start.point, roll_in_box(random, step)) };
    tl_nav_move move;
    if (digest_result(&d->move, tl_nav_query_move_along_surface(task->query, task->navmesh, &request, b->polygons,
                                                                CAPACITY, &move))) {
        digest_vec3(&d->move, move.end.point);
    }
}

static void ask_around(nav_task *task, digest *d, dice *random)
{
    nav_buffers *b = task->buffers;
    const tl_nav_around_request request = { NULL, task->request.start, 6.0f };
    tl_nav_wall wall;
    if (digest_result(d, tl_nav_query_find_wall(task->query, task->navmesh, &request, &wall))) {
        digest_f32(d, wall.distance);
        digest_vec3(d, wall.point);
    }
    uint32_t count = 0;
    digest_result(d, tl_nav_query_find_walls(task->query, task->navmesh, &request, b->walls, 256, &count));
    for (uint32_t i = 0; i < count && i < 256; i++) {
        digest_vec3(d, b->walls[i].start);
        digest_vec3(d, b->walls[i].end);
    }
    tl_nav_field_def field = tl_default_nav_field_def();
    field.max_cost = 15;
    digest_result(
        d, tl_nav_query_flood(task->query, task->navmesh, &request.center, &field, b->entries, CAPACITY, &count));
    for (uint32_t i = 0; i < count && i < CAPACITY; i++) {
        digest_u64(d, b->entries[i].polygon);
        digest_f32(d, b->entries[i].cost);
    }
    const uint64_t dice_pair[2] = { roll_long(random), roll_long(random) };
    tl_nav_location place;
    if (digest_result(d, tl_nav_query_random_reachable(task->query, task->navmesh, &request, dice_pair, &place))) {
        digest_vec3(d, place.point);
    }
    const tl_nav_zone zone = tl_nav_zone_circle(request.center.point, 4);
    digest_result(d, tl_navmesh_find_polygons(task->navmesh, NULL, &zone, NULL, b->polygons, CAPACITY, &count));
    for (uint32_t i = 0; i < count && i < CAPACITY; i++) {
        digest_u64(d, b->polygons[i]);
    }
}

static void ask_corridor(nav_task *task, digest *d)
{
    nav_buffers *b = task->buffers;
    tl_nav_corridor corridor = tl_nav_corridor_init(b->polygons, CAPACITY);
    tl_nav_corridor_reset(&corridor, &task->request.start);
    tl_nav_path path;
    digest_result(d, tl_nav_corridor_find(&corridor, task->query, task->navmesh, NULL, &task->request.goal, &path));
    for (int i = 0; i < 10; i++) {
        uint32_t count = 0;
        const tl_result result = tl_nav_corridor_corners(&corridor, task->navmesh, b->corners, 4, &count);
        digest_u32(d, (uint32_t)result);
        if (tl_is_error(result) || count == 0) {
            return;
        }
        const tl_vec3 next = b->corners[count > 1 ? 1 : 0].point;
        const tl_vec3 to = tl_lerp(corridor.position, next, 0.25f);
        digest_u32(d, (uint32_t)tl_nav_corridor_move(&corridor, task->query, task->navmesh, NULL, to));
        digest_vec3(d, corridor.position);
        digest_u32(d, corridor.count);
    }
}

void golden_nav_answers(const tl_navmesh *navmesh, const char *kind)
{
    nav_digests d = { digest_begin(), digest_begin(), digest_begin(), digest_begin(),
                      digest_begin(), digest_begin(), digest_begin() };
    nav_task task;
    memset(&task, 0, sizeof task);
    task.navmesh = navmesh;
    task.buffers = malloc(sizeof *task.buffers);
    must(task.buffers != NULL ? TL_OK : TL_ERR_MEMORY, "malloc");
    MUST(tl_nav_query_create(NULL, &task.query, NULL));
    dice random = { 15 };
    for (uint32_t i = 0; i < PATHS; i++) {
        const uint64_t at[4] = { roll_long(&random), roll_long(&random), roll_long(&random), roll_long(&random) };
        MUST(tl_navmesh_random_point(navmesh, NULL, at, &task.request.start));
        MUST(tl_navmesh_random_point(navmesh, NULL, at + 2, &task.request.goal));
        ask_path(&task, &d.path);
        ask_ray_and_move(&task, &d, &random);
        if (i % 4 == 0) {
            ask_shortest(&task, &d.shortest);
            ask_wide(&task, &d.wide);
            ask_around(&task, &d.around, &random);
            ask_corridor(&task, &d.corridor);
        }
    }
    tl_nav_query_destroy(task.query);
    free(task.buffers);
    digest_print(&d.path, kind, "paths");
    digest_print(&d.shortest, kind, "shortest");
    digest_print(&d.wide, kind, "wide");
    digest_print(&d.ray, kind, "rays");
    digest_print(&d.move, kind, "moves");
    digest_print(&d.around, kind, "around");
    digest_print(&d.corridor, kind, "corridors");
}

void golden_nav_prepared(tl_navmesh *navmesh)
{
    static const struct {
        const char *kind;
        uint64_t table_bytes;
    } KINDS[] = { { "prepared-graph", 0 }, { "prepared-table", 1u << 28 } };
    for (int i = 0; i < 2; i++) {
        tl_nav_prepare_def def = tl_default_nav_prepare_def();
        def.table_bytes = KINDS[i].table_bytes;
        tl_nav_prepared prepared;
        MUST(tl_navmesh_prepare(navmesh, &def, &prepared));
        digest d = digest_begin();
        digest_u32(&d, (uint32_t)prepared.kind);
        digest_u32(&d, prepared.edge_count);
        d.found = prepared.corner_vertex_count;
        digest_print(&d, KINDS[i].kind, "counts");
        golden_nav_answers(navmesh, KINDS[i].kind);
    }
    MUST(tl_navmesh_prepare_wide(navmesh, NULL, NULL));
    golden_nav_answers(navmesh, "prepared-wide");
}

void golden_nav_sight(const tl_navmesh *navmesh, const tl_soup *soup)
{
    tl_nav_pvs_def def = tl_default_nav_pvs_def();
    def.max_distance = 15;
    tl_nav_pvs *pvs;
    MUST(tl_nav_pvs_bake(&def, navmesh, soup, &pvs, NULL));
    digest d = digest_begin();
    digest_blob(&d, pvs);
    d.found = pvs->pair_count;
    digest_print(&d, "sight", "blob");
    tl_blob_free(pvs);

    tl_nav_query *query;
    MUST(tl_nav_query_create(NULL, &query, NULL));
    dice random = { 16 };
    d = digest_begin();
    for (int i = 0; i < 40; i++) {
        const uint64_t at[4] = { roll_long(&random), roll_long(&random), roll_long(&random), roll_long(&random) };
        tl_nav_location threat;
        tl_nav_cover_request request;
        memset(&request, 0, sizeof request);
        request.navmesh = navmesh;
        request.soup = soup;
        MUST(tl_navmesh_random_point(navmesh, NULL, at, &request.agent));
        MUST(tl_navmesh_random_point(navmesh, NULL, at + 2, &threat));
        request.threat = tl_add(threat.point, tl_vec3_make(0, 1.5f, 0));
        tl_nav_cover covers[8];
        uint32_t count = 0;
        digest_result(&d, tl_nav_query_find_cover(query, &request, NULL, covers, 8, &count));
        for (uint32_t k = 0; k < count && k < 8; k++) {
            digest_vec3(&d, covers[k].location.point);
            digest_f32(&d, covers[k].length);
        }
    }
    digest_print(&d, "sight", "cover");
    tl_nav_query_destroy(query);
}
