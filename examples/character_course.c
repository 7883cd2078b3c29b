// SPDX-License-Identifier: MIT
//
// A character on an obstacle course, drawn from the side: stairs, a ramp, a ledge to climb and one to fall off, a wall
// that asks for a jump, a lift that carries it up, and a slope too steep at the end.
//
//   character_course [OUT.svg]

#include <talus/character.h>
#include <talus/scene.h>

#include <stdio.h>
#include <string.h>

enum { MAX_PROFILE = 64, MOST_TICKS = 60 * 60, GROUND = 0, LIFT = 1, PARTS = 2 };

static const float TICK = 1.0f / 60.0f, SPEED = 3.0f, LIFT_LOW = -0.2f, LIFT_HIGH = 1.8f;

// The ground, from the side: corners in x and y. Extruded to z from -2 to 2.
typedef struct course {
    float x[MAX_PROFILE], y[MAX_PROFILE];
    uint32_t count;
    tl_vec3 vertices[2 * MAX_PROFILE];
    uint32_t indices[6 * MAX_PROFILE];
} course;

static void add(course *c, float x, float y)
{
    c->x[c->count] = x;
    c->y[c->count] = y;
    c->vertices[2 * c->count] = tl_vec3_make(x, y, -2);
    c->vertices[2 * c->count + 1] = tl_vec3_make(x, y, 2);
    if (c->count > 0) {
        const uint32_t a = 2 * c->count - 2, sides[6] = { a, a + 1, a + 3, a, a + 3, a + 2 };
        memcpy(c->indices + 6 * (c->count - 1), sides, sizeof sides);
    }
    c->count++;
}

static void build_course(course *c)
{
    memset(c, 0, sizeof *c);
    add(c, -1, 0);
    for (int i = 0; i < 8; i++) { // stairs of 25 cm
        add(c, 2.0f + 0.3f * (float)i, 0.25f * (float)i);
        add(c, 2.0f + 0.3f * (float)i, 0.25f * (float)(i + 1));
    }
    add(c, 6, 2);
    add(c, 9, 0);         // a ramp of 34 degrees
    add(c, 10, 0);        //
    add(c, 10, 0.4f);     // as high as a step may be
    add(c, 11.5f, 0.4f);  //
    add(c, 11.5f, -0.8f); // a fall
    add(c, 14, -0.8f);    //
    add(c, 14, LIFT_LOW); // 60 cm: too high for a step
    add(c, 16, LIFT_LOW); //
    add(c, 16, -1);       // the lift's pit
    add(c, 18.02f, -1);   //
    add(c, 18.02f, LIFT_HIGH);
    add(c, 22, LIFT_HIGH);
    add(c, 23, LIFT_HIGH + 1.75f); // 60 degrees: too steep
    add(c, 26, LIFT_HIGH + 1.75f);
}

// What the player does: runs to the right, jumps at a wall, waits on the lift until it is up.
static tl_character_step decide(const tl_character *c, bool blocked, float lift)
{
    tl_character_step step = { .velocity = { SPEED, 0, 0 }, .seconds = TICK };
    if (c->grounded == 0) {
        step.velocity.y = c->velocity.y - 9.81f * TICK;
    } else if (c->ground_instance == LIFT && c->position.x > 17.0f && lift < LIFT_HIGH) {
        step.velocity.x = 0;
    } else if (blocked && c->position.x < 15.0f) {
        step.velocity.y = 4.5f;
        step.leave_ground = true;
    }
    return step;
}

// Centimetres, y down.
static void draw_capsule(FILE *svg, const tl_character *c, float top)
{
    fprintf(svg, "<rect class=\"%s\" x=\"%.1f\" y=\"%.1f\" width=\"60\" height=\"180\" rx=\"30\"/>\n",
            c->grounded != 0 ? "walks" : "flies", (double)(100.0f * c->position.x - 30.0f),
            (double)(100.0f * (top - c->position.y) - 180.0f));
}

static void draw_course(FILE *svg, const course *c, float top)
{
    fprintf(svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-100 0 2700 760\">\n"
            "<style>.walks{fill:none;stroke:#1f6fb2;stroke-width:3}.flies{fill:none;stroke:#d9822b;stroke-width:3}"
            ".lift{fill:#8a9a5b;opacity:.15}.ground{fill:#c9c2b8;stroke:#6b645c;stroke-width:4}"
            "text{font:36px sans-serif;fill:#333;text-anchor:middle}</style>\n"
            "<rect x=\"-100\" width=\"2700\" height=\"760\" fill=\"#fff\"/>\n<path class=\"ground\" d=\"M-100 760");
    for (uint32_t i = 0; i < c->count; i++) {
        fprintf(svg, " L%.0f %.0f", (double)(100.0f * c->x[i]), (double)(100.0f * (top - c->y[i])));
    }
    fprintf(svg, " L2600 760Z\"/>\n");
    static const char *const NAMES[] = { "stairs", "ramp", "step", "fall", "jump", "lift", "too steep" };
    static const int AT[] = { 380, 780, 1060, 1240, 1400, 1700, 2310 };
    for (int i = 0; i < 7; i++) {
        fprintf(svg, "<text x=\"%d\" y=\"740\">%s</text>\n", AT[i], NAMES[i]);
    }
}

static void draw_lift(FILE *svg, float height, float top)
{
    fprintf(svg, "<rect class=\"lift\" x=\"1600\" y=\"%.1f\" width=\"200\" height=\"30\"/>\n",
            (double)(100.0f * (top - height)));
}

// A tick of the lift: up while somebody is on it, down else.
static float move_lift(float height, const tl_character *c)
{
    const bool is_used = c->grounded != 0 && c->ground_instance == LIFT && c->position.x > 17.0f;
    const float moved = height + (is_used ? 1.0f : -1.0f) * TICK;
    return moved < LIFT_LOW ? LIFT_LOW : moved > LIFT_HIGH ? LIFT_HIGH : moved;
}

static bool run(const course *c, tl_scene *scene, tl_scene_instance parts[PARTS], FILE *svg)
{
    tl_character_mover *mover;
    if (tl_character_mover_create(NULL, &mover, NULL) != TL_OK) {
        return false;
    }
    const tl_character_level level = { .scene = scene, .instances = parts };
    const float top = 5.5f;
    tl_character player;
    tl_character_report did;
    memset(&player, 0, sizeof player);
    memset(&did, 0, sizeof did);
    float lift = LIFT_LOW, climbed = 0, carried = 0;
    uint32_t jumps = 0, blocked_for = 0;
    if (svg != NULL) {
        draw_course(svg, c, top);
    }
    for (int i = 0; i < MOST_TICKS && blocked_for < 60; i++) {
        lift = move_lift(lift, &player);
        parts[LIFT].pose.position.y = lift;
        const tl_character_step step = decide(&player, did.blocked, lift);
        if (tl_scene_refit(scene, parts, PARTS, NULL, NULL) != TL_OK ||
            tl_character_move(mover, &level, &step, &player, &did) != TL_OK || did.stuck) {
            break;
        }
        jumps += step.leave_ground;
        climbed += did.stepped_up;
        carried += did.carried.y;
        blocked_for = did.blocked && player.grounded != 0 ? blocked_for + 1 : 0;
        if (svg != NULL && i % 12 == 0 && blocked_for < 12) {
            draw_lift(svg, lift, top);
            draw_capsule(svg, &player, top);
        }
    }
    if (svg != NULL) {
        fprintf(svg, "</svg>\n");
    }
    tl_character_mover_destroy(mover);
    printf("stands at %.2f %.2f before the slope; climbed %.2f m of steps, jumped %u times, was carried %.2f m\n",
           (double)player.position.x, (double)player.position.y, (double)climbed, jumps, (double)carried);
    return player.position.x > 21.0f && player.position.x < 23.0f && jumps > 0 && carried > 1.9f;
}

int main(int argc, char **argv)
{
    static course ground;
    build_course(&ground);
    const tl_mesh_view view = { ground.vertices, 2 * ground.count, ground.indices, 2 * (ground.count - 1), NULL };
    const tl_convex deck = tl_convex_box(tl_vec3_make(17, -0.15f, 0), tl_vec3_make(1, 0.15f, 2), 0.0f);
    tl_scene_instance parts[PARTS];
    memset(parts, 0, sizeof parts);
    tl_soup *soup = NULL;
    tl_scene *scene = NULL;
    parts[GROUND].mask = parts[LIFT].mask = 1;
    parts[LIFT].shape = &deck;
    parts[LIFT].pose.position.y = LIFT_LOW;
    bool done = tl_soup_bake(&view, NULL, &soup, NULL) == TL_OK;
    parts[GROUND].soup = soup;
    if (done && tl_scene_bake(parts, PARTS, NULL, &scene, NULL) == TL_OK) {
        FILE *svg = argc > 1 ? fopen(argv[1], "w") : NULL;
        done = run(&ground, scene, parts, svg) && (argc < 2 || svg != NULL);
        if (svg != NULL && fclose(svg) != 0) {
            done = false;
        }
    }
    tl_blob_free(scene);
    tl_blob_free(soup);
    return done ? 0 : 1;
}
