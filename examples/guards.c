// SPDX-License-Identifier: MIT
//
// A guard that sees and chases: lines of sight through the soup, paths over the navmesh. An intruder walks from the
// gate to the vault; the guard notices him when nothing stands between their eyes, runs to where he is going, and
// catches him.
//
//   example_guards              runs the chase and checks it
//   example_guards chase.svg    and draws it: intruder blue, guard red, lines of sight grey

#include <talus/nav_bake.h>
#include <talus/nav_query.h>
#include <talus/soup.h>

#include <math.h>
#include <stdio.h>

enum { MAX_CORNERS = 64, MAX_POLYGONS = 256, MAX_TICKS = 600, WALLS = 6 };

static const float TICK = 0.1f;  // seconds
static const float EYE = 1.6f;   // metres above the soles
static const float FAR = 18.0f;  // metres that the guard sees
static const float ARM = 1.0f;   // metres at which he catches
static const float AHEAD = 4.0f; // metres that he runs on when he has lost sight

// Floor and walls of a yard of 30 by 20 m: x0, z0, x1, z1, height.
static const float BLOCKS[WALLS][5] = {
    { 8, 0, 9, 12, 3 },    { 16, 8, 17, 20, 3 },  { 22, 0, 23, 7, 3 },
    { 22, 11, 30, 12, 3 }, { 11, 14, 13, 16, 3 }, { 25, 3, 27, 5, 1 } // a crate that one can look over
};

typedef struct level {
    tl_vec3 vertices[8 * (WALLS + 1)];
    uint32_t indices[36 * (WALLS + 1)];
    tl_mesh_view mesh;
} level;

static void add_box(level *l, const float *box, float low, float high)
{
    static const uint32_t sides[36] = { 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                        2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5 };
    for (uint32_t i = 0; i < 36; i++) {
        l->indices[3 * l->mesh.triangle_count + i] = l->mesh.vertex_count + sides[i];
    }
    for (uint32_t i = 0; i < 8; i++) {
        // Bit 0 of a corner is x, bit 1 y, bit 2 z.
        l->vertices[l->mesh.vertex_count++] =
            tl_vec3_make(box[i % 2 != 0 ? 2 : 0], i / 2 % 2 != 0 ? high : low, box[i / 4 != 0 ? 3 : 1]);
    }
    l->mesh.triangle_count += 12;
}

static void make_level(level *l)
{
    static const float ground[4] = { 0, 0, 30, 20 };
    l->mesh.vertex_count = l->mesh.triangle_count = 0;
    add_box(l, ground, -1, 0);
    for (int i = 0; i < WALLS; i++) {
        add_box(l, BLOCKS[i], 0, BLOCKS[i][4]);
    }
    l->mesh.vertices = l->vertices;
    l->mesh.indices = l->indices;
    l->mesh.materials = NULL;
}

typedef struct world {
    tl_nav_tiles tiles;
    tl_navmesh *navmesh; // borrows the tiles
    tl_nav_query *query;
    tl_soup *soup;
} world;

static tl_result make_world(const level *l, world *w)
{
    tl_nav_def def = tl_default_nav_def();
    const tl_nav_input input = { l->mesh, NULL, NULL, 0 };
    tl_nav_query_def query_def = tl_default_nav_query_def();
    tl_result result = tl_soup_bake(&l->mesh, NULL, &w->soup, NULL);
    result = result == TL_OK ? tl_nav_query_create(&query_def, &w->query, NULL) : result;
    result = result == TL_OK ? tl_navmesh_create(NULL, &w->navmesh) : result;
    result = result == TL_OK ? tl_nav_bake(&def, &input, &w->tiles, NULL) : result;
    if (result != TL_OK) {
        return result;
    }
    return tl_navmesh_add_tiles(w->navmesh, w->tiles.tiles, w->tiles.tile_count, TL_NAV_TILE_BORROWED, NULL);
}

typedef struct actor {
    tl_vec3 place;  // soles
    tl_vec3 facing; // unit, in the plane
    tl_vec3 goal;
    float speed; // metres a second
    tl_vec3 track[MAX_TICKS];
} actor;

// One tick along the shortest path to the goal.
static tl_result walk(const world *w, actor *a)
{
    tl_nav_ref polygons[MAX_POLYGONS];
    tl_nav_corner corners[MAX_CORNERS];
    const tl_nav_path_buffers buffers = { polygons, MAX_POLYGONS, corners, MAX_CORNERS };
    tl_nav_route route;
    const tl_nav_route_request request = { .start = a->place, .goal = a->goal, .half_extents = { AHEAD, 2, AHEAD } };
    tl_result result = tl_nav_query_find_route(w->query, w->navmesh, &request, &buffers, &route);
    float left = a->speed * TICK;
    for (uint32_t i = 1; result == TL_OK && i < route.corner_count && left > 0.0f; i++) {
        const tl_vec3 to = tl_sub(corners[i].point, a->place);
        const float length = tl_length(to);
        if (length > 0.0f) {
            a->facing = tl_normalize(tl_vec3_make(to.x, 0, to.z));
            a->place = tl_mul_add(a->place, to, tl_minf(left / length, 1.0f));
        }
        left -= length;
    }
    return result;
}

// In front of the guard, 60 degrees to either side, near enough, and nothing between their eyes.
static bool sees(const world *w, const actor *guard, const actor *intruder)
{
    const tl_vec3 to = tl_sub(intruder->place, guard->place), up = tl_vec3_make(0, EYE, 0);
    return tl_length(to) <= FAR && tl_dot(to, guard->facing) >= 0.5f * tl_length(to) &&
           tl_soup_line_of_sight(w->soup, tl_add(guard->place, up), tl_add(intruder->place, up), NULL);
}

typedef struct chase {
    uint32_t ticks, first_seen, times_lost;
    bool caught;
    bool seen[MAX_TICKS];
} chase;

static tl_result run(const world *w, actor *guard, actor *intruder, chase *c)
{
    bool chasing = false, before = false;
    tl_result result = TL_OK;
    for (; c->ticks < MAX_TICKS && !c->caught && result == TL_OK; c->ticks++) {
        const bool now = sees(w, guard, intruder);
        if (now) {
            c->first_seen = chasing ? c->first_seen : c->ticks;
            chasing = true;
            // Once he is out of sight: the place to which he was running.
            guard->goal = tl_mul_add(intruder->place, intruder->facing, AHEAD);
        }
        c->times_lost += before && !now;
        before = c->seen[c->ticks] = now;
        guard->track[c->ticks] = guard->place;
        intruder->track[c->ticks] = intruder->place;
        result = walk(w, intruder);
        if (result == TL_OK && chasing) {
            result = walk(w, guard);
        }
        c->caught = tl_distance(guard->place, intruder->place) <= ARM;
    }
    return result;
}

static void draw_track(FILE *file, const actor *a, uint32_t ticks, const char *colour)
{
    fprintf(file, "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"0.16\" points=\"", colour);
    for (uint32_t i = 0; i < ticks; i++) {
        fprintf(file, "%.2f,%.2f ", (double)a->track[i].x, (double)a->track[i].z);
    }
    fprintf(file, "\"/>\n<circle cx=\"%.2f\" cy=\"%.2f\" r=\"0.35\" fill=\"%s\"/>\n", (double)a->track[0].x,
            (double)a->track[0].z, colour);
}

static bool draw(const char *path, const actor *guard, const actor *intruder, const chase *c)
{
    FILE *file = fopen(path, "w");
    if (file == NULL) {
        return false;
    }
    fprintf(file, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"900\" height=\"600\" viewBox=\"0 0 30 20\">\n"
                  "<rect x=\"0\" y=\"0\" width=\"30\" height=\"20\" fill=\"#f4f1ea\"/>\n");
    for (int i = 0; i < WALLS; i++) {
        const float *b = BLOCKS[i];
        fprintf(file, "<rect x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\" fill=\"%s\"/>\n", (double)b[0], (double)b[1],
                (double)(b[2] - b[0]), (double)(b[3] - b[1]), b[4] < EYE ? "#cdb98f" : "#6b6f76");
    }
    for (uint32_t i = 0; i < c->ticks; i += 4) {
        if (c->seen[i]) {
            fprintf(file,
                    "<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" stroke=\"#9a9a9a\" "
                    "stroke-width=\"0.05\"/>\n",
                    (double)guard->track[i].x, (double)guard->track[i].z, (double)intruder->track[i].x,
                    (double)intruder->track[i].z);
        }
    }
    draw_track(file, intruder, c->ticks, "#2471a3");
    draw_track(file, guard, c->ticks, "#c0392b");
    fprintf(file, "</svg>\n");
    return fclose(file) == 0;
}

int main(int count, char **words)
{
    static level yard;
    static actor guard = { { 28, 0, 2 }, { -0.8f, 0, 0.6f }, { 28, 0, 2 }, 2.6f, { { 0, 0, 0 } } };
    static actor intruder = { { 3, 0, 3 }, { 1, 0, 0 }, { 27, 0, 17 }, 2.0f, { { 0, 0, 0 } } };
    static chase c;
    world w = { 0 };
    make_level(&yard);
    tl_result result = make_world(&yard, &w);
    if (result == TL_OK) {
        result = run(&w, &guard, &intruder, &c);
    }
    tl_navmesh_destroy(w.navmesh);
    tl_nav_tiles_free(&w.tiles);
    tl_nav_query_destroy(w.query);
    tl_blob_free(w.soup);
    if (result != TL_OK) {
        fprintf(stderr, "talus: %s\n", tl_result_text(result));
        return 1;
    }
    printf("seen after %.1f s, lost from sight %u times, %s after %.1f s at %g,%g\n",
           (double)(TICK * (float)c.first_seen), c.times_lost, c.caught ? "caught" : "not caught",
           (double)(TICK * (float)c.ticks), (double)guard.place.x, (double)guard.place.z);
    if (count > 1 && !draw(words[1], &guard, &intruder, &c)) {
        fprintf(stderr, "%s: cannot be written\n", words[1]);
        return 1;
    }
    // Behind the first wall he is not seen; around the others he is lost now and then; the guard is faster.
    return !c.seen[0] && c.first_seen > 20 && c.times_lost > 0 && c.caught ? 0 : 1;
}
