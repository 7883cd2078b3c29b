// SPDX-License-Identifier: MIT
//
// An agent walks to a door, which a crate blocks before it arrives: its path corridor is repaired, and it takes the
// other door. With a file's name as argument it draws what happened, as SVG.

#include <talus/nav_corridor.h>
#include <talus/nav_obstacles.h>

#include <stdio.h>

enum { MAX_BOXES = 4, MAX_STEPS = 400, ROOM = 64 };

typedef struct level {
    tl_vec3 vertices[8 * MAX_BOXES];
    uint32_t indices[36 * MAX_BOXES];
    uint32_t boxes;
} level;

static void add_box(level *l, tl_vec3 low, tl_vec3 high)
{
    static const uint32_t SIDES[36] = { 0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                        2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3 };
    for (uint32_t i = 0; i < 8; i++) {
        l->vertices[8 * l->boxes + i] =
            tl_vec3_make(i & 4 ? high.x : low.x, i & 2 ? high.y : low.y, i & 1 ? high.z : low.z);
    }
    for (uint32_t i = 0; i < 36; i++) {
        l->indices[36 * l->boxes + i] = 8 * l->boxes + SIDES[i];
    }
    l->boxes++;
}

// Outlines of the polygons, the crate, and where the agent went.
static void draw(const char *file, const tl_navmesh *navmesh, const tl_nav_obstacle *crate, const tl_vec3 *trail,
                 uint32_t count)
{
    FILE *out = fopen(file, "w");
    if (out == NULL) {
        return;
    }
    fprintf(out, "<svg xmlns='http://www.w3.org/2000/svg' viewBox='-1 -1 32 22' width='960'>\n"
                 "<rect x='-1' y='-1' width='32' height='22' fill='#444'/>\n");
    for (uint32_t s = 0; s < tl_navmesh_slot_count(navmesh); s++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, s);
        for (uint32_t p = 0; tile != NULL && p < tile->polygon_count; p++) {
            uint32_t corners = 0;
            const tl_vec3 *corner = tl_nav_tile_corners(tile, p, &corners);
            fprintf(out, "<polygon fill='#cde' stroke='#789' stroke-width='.05' points='");
            for (uint32_t k = 0; k < corners; k++) {
                fprintf(out, "%g,%g ", (double)corner[k].x, (double)corner[k].z);
            }
            fprintf(out, "'/>\n");
        }
    }
    fprintf(
        out,
        "<circle cx='%g' cy='%g' r='%g' fill='#b52'/>\n<polyline fill='none' stroke='#160' stroke-width='.2' points='",
        (double)crate->base.x, (double)crate->base.z, (double)crate->radius);
    for (uint32_t i = 0; i < count; i++) {
        fprintf(out, "%g,%g ", (double)trail[i].x, (double)trail[i].z);
    }
    fprintf(out, "'/>\n</svg>\n");
    fclose(out);
}

// Follows the corridor until its end; the crate falls after 20 steps. Returns the number of steps.
static uint32_t follow(tl_nav_corridor *corridor, tl_nav_query *query, tl_navmesh *navmesh, tl_nav_obstacles *obstacles,
                       const tl_nav_obstacle *crate, tl_vec3 *trail)
{
    const tl_vec3 extents = { 1.0f, 2.0f, 1.0f };
    tl_nav_obstacle_id id;
    tl_nav_path path;
    tl_nav_corner corners[2];
    uint32_t count = 0, waiting = 0, step = 0;
    for (; step < MAX_STEPS; step++) {
        trail[step] = corridor->position;
        if (step == 20 && (tl_nav_obstacles_add(obstacles, crate, &id, NULL) != TL_OK ||
                           tl_nav_obstacles_update(obstacles, navmesh, UINT32_MAX, &waiting, NULL) != TL_OK)) {
            break;
        }
        if (tl_nav_corridor_repair(corridor, query, navmesh, NULL, extents, &path) != TL_OK || !corridor->reaches) {
            break;
        }
        if (path.node_count > 0) {
            printf("step %u: the way is blocked, %u polygons around it\n", step, corridor->count);
        }
        tl_nav_corridor_corners(corridor, navmesh, corners, 2, &count);
        tl_vec3 way = tl_sub(corners[1].point, corridor->position);
        float metres = tl_length(way), stride = 0.25f;
        if (metres < 0.01f) {
            return step;
        }
        tl_vec3 to = metres < stride ? corners[1].point : tl_mul_add(corridor->position, way, stride / metres);
        tl_nav_corridor_move(corridor, query, navmesh, NULL, to);
    }
    return MAX_STEPS;
}

int main(int argc, char **argv)
{
    // A floor of 30 m by 20 m, a wall across it with two doors.
    level l = { { { 0.0f, 0.0f, 0.0f } }, { 0 }, 0 };
    add_box(&l, tl_vec3_make(0, -1, 0), tl_vec3_make(30, 0, 20));
    add_box(&l, tl_vec3_make(14, 0, 0), tl_vec3_make(15, 3, 4));
    add_box(&l, tl_vec3_make(14, 0, 7), tl_vec3_make(15, 3, 15));
    add_box(&l, tl_vec3_make(14, 0, 18), tl_vec3_make(15, 3, 20));
    tl_nav_input input = { { l.vertices, 8 * l.boxes, l.indices, 12 * l.boxes, NULL }, NULL, NULL, 0 };
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = 32;
    def.bounds.min = tl_vec3_make(0, -1, 0);
    def.bounds.max = tl_vec3_make(30, 3, 20);

    tl_navmesh *navmesh = NULL;
    tl_nav_obstacles *obstacles = NULL;
    tl_nav_query *query = NULL;
    tl_nav_query_def query_def = tl_default_nav_query_def();
    tl_nav_ref room[ROOM];
    tl_nav_corridor corridor = tl_nav_corridor_init(room, ROOM);
    tl_nav_location start, goal;
    tl_nav_path path;
    uint32_t waiting = 0, steps = MAX_STEPS;
    tl_vec3 trail[MAX_STEPS], extents = { 1.0f, 2.0f, 1.0f };
    tl_nav_obstacle crate = { 0 };
    crate.shape = TL_NAV_OBSTACLE_CYLINDER;
    crate.base = tl_vec3_make(14.5f, 0, 5.5f);
    crate.radius = 1.2f;
    crate.height = 2.0f;
    if (tl_navmesh_create(NULL, &navmesh) == TL_OK && tl_nav_query_create(&query_def, &query, NULL) == TL_OK &&
        tl_nav_obstacles_bake(&def, &input, &obstacles, NULL, NULL) == TL_OK &&
        tl_nav_obstacles_update(obstacles, navmesh, UINT32_MAX, &waiting, NULL) == TL_OK &&
        tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(3, 0, 6), extents, &start) == TL_OK &&
        tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(27, 0, 6), extents, &goal) == TL_OK) {
        tl_nav_corridor_reset(&corridor, &start);
        if (tl_nav_corridor_find(&corridor, query, navmesh, NULL, &goal, &path) == TL_OK) {
            printf("%u polygons to the goal\n", corridor.count);
            steps = follow(&corridor, query, navmesh, obstacles, &crate, trail);
        }
        if (argc > 1 && steps < MAX_STEPS) {
            draw(argv[1], navmesh, &crate, trail, steps + 1);
        }
    }
    printf(steps < MAX_STEPS ? "there after %u steps\n" : "not there after %u steps\n", steps);
    tl_nav_obstacles_destroy(obstacles);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
    // Straight through the first door it would be 96 steps; the path back and through the other one is longer.
    return steps > 110 && steps < 200 ? 0 : 1;
}
