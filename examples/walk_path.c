// SPDX-License-Identifier: MIT
//
// A character that walks a navmesh path physically: the level is baked twice, to a soup that it walks on and to a
// navmesh that knows the way; up a flight of stairs and over a bridge.

#include <talus/character.h>
#include <talus/nav_bake.h>
#include <talus/nav_query.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { STEPS = 10, BOXES = STEPS + 3, MAX_POLYGONS = 64, MAX_CORNERS = 64 };

typedef struct box_level {
    tl_vec3 vertices[8 * BOXES];
    uint32_t indices[36 * BOXES], box_count;
} box_level;

static void add_box(box_level *l, tl_vec3 low, tl_vec3 high)
{
    static const uint32_t SIDES[36] = { 0, 1, 2, 0, 2, 3, 4, 7, 6, 4, 6, 5, 0, 4, 5, 0, 5, 1,
                                        1, 5, 6, 1, 6, 2, 2, 6, 7, 2, 7, 3, 3, 7, 4, 3, 4, 0 };
    uint32_t first = 8 * l->box_count;
    for (uint32_t i = 0; i < 8; i++) {
        bool far_x = i % 4 == 1 || i % 4 == 2, far_z = i % 4 >= 2;
        l->vertices[first + i] = tl_vec3_make(far_x ? high.x : low.x, i < 4 ? low.y : high.y, far_z ? high.z : low.z);
    }
    for (uint32_t i = 0; i < 36; i++) {
        l->indices[36 * l->box_count + i] = first + SIDES[i];
    }
    l->box_count++;
}

// A yard with a wall across, ten steps of 20 cm up to its top, and a way along it.
static void build_level(box_level *l)
{
    memset(l, 0, sizeof *l);
    add_box(l, tl_vec3_make(-10, -1, -10), tl_vec3_make(10, 0, 10));
    add_box(l, tl_vec3_make(-1, -1, -10), tl_vec3_make(1, 2, 10));
    add_box(l, tl_vec3_make(1, -1, -9), tl_vec3_make(3, 2, -6));
    for (uint32_t i = 0; i < STEPS; i++) {
        float near = -6 + 0.3f * (float)i;
        add_box(l, tl_vec3_make(1, -1, near), tl_vec3_make(3, 2 - 0.2f * (float)(i + 1), near + 0.3f));
    }
}

static bool find_corners(const tl_mesh_view *view, tl_vec3 from, tl_vec3 to, tl_nav_corner *corners, uint32_t *count)
{
    tl_nav_input input = { *view, NULL, NULL, 0 };
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.15f;
    def.cell_height = 0.1f;
    def.agent_max_climb = 0.4f; // as the character's step_height
    tl_nav_tiles tiles = { 0 };
    tl_navmesh *navmesh = NULL;
    tl_nav_query *query = NULL;
    tl_nav_ref polygons[MAX_POLYGONS];
    tl_nav_path_buffers buffers = { polygons, MAX_POLYGONS, corners, MAX_CORNERS };
    tl_nav_route route = { 0 };
    const tl_nav_route_request request = { .start = from, .goal = to, .half_extents = { 1, 2, 1 } };
    bool found = tl_nav_bake(&def, &input, &tiles, NULL) == TL_OK && tl_navmesh_create(NULL, &navmesh) == TL_OK &&
                 tl_navmesh_add_tiles(navmesh, tiles.tiles, tiles.tile_count, TL_NAV_TILE_BORROWED, NULL) == TL_OK &&
                 tl_nav_query_create(NULL, &query, NULL) == TL_OK &&
                 tl_nav_query_find_route(query, navmesh, &request, &buffers, &route) == TL_OK &&
                 route.path.status == TL_NAV_PATH_COMPLETE;
    *count = route.corner_count;
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
    tl_nav_tiles_free(&tiles);
    return found;
}

// At the corners one after the other, 3 m/s; true when the last one is reached.
static bool walk(const tl_soup *soup, const tl_nav_corner *corners, uint32_t count, tl_character *c)
{
    tl_character_mover *mover;
    if (tl_character_mover_create(NULL, &mover, NULL) != TL_OK) {
        return false;
    }
    const tl_character_level level = { .soup = soup };
    const float tick = 1.0f / 60.0f;
    uint32_t next = 0;
    for (int i = 0; i < 60 * 60 && next < count; i++) {
        tl_vec3 to = tl_sub(corners[next].point, c->position);
        to.y = 0;
        float distance = tl_length(to), speed = fminf(3.0f, distance / tick);
        if (distance < 0.05f) {
            printf("%5.2f s: at %.2f %.2f %.2f\n", (double)i * (double)tick, (double)c->position.x,
                   (double)c->position.y, (double)c->position.z);
            next++;
            continue;
        }
        tl_character_step step = { .velocity = tl_scale(to, speed / distance), .seconds = tick };
        step.velocity.y = c->grounded != 0 ? 0 : c->velocity.y - 9.81f * tick;
        if (tl_character_move(mover, &level, &step, c, NULL) != TL_OK) {
            break;
        }
    }
    tl_character_mover_destroy(mover);
    return next == count;
}

int main(void)
{
    static box_level yard;
    build_level(&yard);
    tl_mesh_view view = { yard.vertices, 8 * yard.box_count, yard.indices, 12 * yard.box_count, NULL };
    const tl_vec3 from = { 6, 0, 6 }, to = { 0, 2, 8 };
    tl_nav_corner corners[MAX_CORNERS];
    uint32_t count;
    tl_soup *soup;
    if (!find_corners(&view, from, to, corners, &count) || tl_soup_bake(&view, NULL, &soup, NULL) != TL_OK) {
        return 1;
    }
    tl_character character;
    memset(&character, 0, sizeof character);
    character.position = from;
    bool arrived = walk(soup, corners, count, &character);
    tl_blob_free(soup);
    printf("%s, on ground with the normal %g %g %g\n", arrived ? "arrived" : "did not arrive",
           (double)character.ground_normal.x, (double)character.ground_normal.y, (double)character.ground_normal.z);
    return arrived && fabsf(character.position.y - 2.0f) < 0.01f ? 0 : 1;
}
