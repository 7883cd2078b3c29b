// SPDX-License-Identifier: MIT
//
// Sliding: the nearest motion that all contacts allow, swept; where something new is met, the same for the rest.
//
// A contact allows what does not come nearer than the gap, so motion along a wall keeps it, and contacts that are
// nearer are left by the same step. Walking measures motions with heights at an eighth: then the nearest one that a
// slope allows is the one that keeps its horizontal speed and climbs. Steep ground is a plane and a wall, both: it can
// be slid down, never climbed.

#include "character/mover.h"

#include <float.h>

// A gap short by less than this share of it is no reason to move: what stands, stands still. Two roundings of a
// position, as the gap is sixteen at least.
#define SHORT_SHARE 0.125

// Shares of the gap, 2 mm by default. 2^-20 of it: planes are kept to that, a thousand times what doubles lose at 10 km
// (1e-12 m). 2^-16: motions shorter than that are none, so that what a plane's slack lets through is never a motion.
#define SLACK_SHARE 9.5367431640625e-07
#define STILL_SHARE 1.52587890625e-05

// Pushed out is who has this share of the gap free.
#define ENOUGH_SHARE 0.25

// Walking, a metre up counts as an eighth of one ahead: at 45 degrees 1.5 % of the speed is lost.
#define HEIGHT_SHARE 0.125

// Normals within this are one: 1 - cosine, of 1.4e-5 radians.
#define SAME_NORMAL 1e-10

// Upright: a hundredth of a degree or so.
#define UPRIGHT_COSINE 1e-4

// Less steep than this, no wall can be made of it.
#define LEAN_SINE 0.1

enum { MAX_SLIDES = 12, MAX_PUSHES = 16 };

// More than TL_MAX_MOVER_PLANES steer no more; sweeps mind them all the same.
static uint32_t add_plane(tl_mover_plane *planes, uint32_t count, tl_vec3d normal, double least)
{
    for (uint32_t i = 0; i < count; i++) {
        if (tl_vec3d_dot(planes[i].normal, normal) >= 1.0 - SAME_NORMAL) {
            planes[i].least = least > planes[i].least ? least : planes[i].least;
            return count;
        }
    }
    if (count < TL_MAX_MOVER_PLANES) {
        planes[count].normal = normal;
        planes[count].least = least;
        count++;
    }
    return count;
}

static bool acts_as_wall(const tl_character_mover *m, const tl_mover_slide *slide, const tl_mover_contact *c)
{
    return c->normal.y < m->cos_slope || (slide->walking && !c->face && c->point.y > slide->highest);
}

// Metres to be gained (or, below zero, that may be lost) along the contact's normal.
static double least_along(const tl_character_mover *m, const tl_mover_contact *c)
{
    double lacks = m->gap - c->gap;
    return lacks > 0.0 && lacks < SHORT_SHARE * m->gap ? 0.0 : lacks;
}

uint32_t tl_mover_planes(const tl_character_mover *m, const tl_mover_slide *slide, tl_mover_plane *planes)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < m->contact_count; i++) {
        const tl_mover_contact *c = &m->contacts[i];
        double least = least_along(m, c), lost = least < 0.0 ? least : 0.0;
        double flat = sqrt(c->normal.x * c->normal.x + c->normal.z * c->normal.z);
        if (c->normal.y > UPRIGHT_COSINE && flat > LEAN_SINE && acts_as_wall(m, slide, c)) {
            // Who walks is pushed back by it, not up: else the foot of a steep slope would lift it off the ground.
            tl_vec3d aside = tl_vec3d_make(c->normal.x / flat, 0.0, c->normal.z / flat);
            count = add_plane(planes, count, aside, (slide->walking ? least : lost) / flat);
            least = slide->walking ? lost : least;
        }
        count = add_plane(planes, count, c->normal, least);
    }
    return count;
}

// Planes and wish in a space where heights count less.
static bool allowed_motion(const tl_mover_plane *planes, uint32_t count, const tl_mover_slide *slide, double slack,
                           bool push, tl_vec3d *motion)
{
    tl_mover_plane scaled[TL_MAX_MOVER_PLANES];
    const double height = slide->walking ? HEIGHT_SHARE : 1.0;
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3d n = planes[i].normal;
        n.y /= height;
        double scale = 1.0 / tl_vec3d_length(n);
        scaled[i].normal = tl_vec3d_scale(n, scale);
        scaled[i].least = (push || planes[i].least < 0.0 ? planes[i].least : 0.0) * scale;
    }
    tl_vec3d wish = slide->wish;
    wish.y *= height;
    bool found = tl_allowed_motion(scaled, count, wish, slack, motion);
    motion->y /= height;
    return found;
}

static tl_character_surface surface_of(const tl_character_mover *m, const tl_mover_contact *c)
{
    return c->supports                     ? TL_CHARACTER_GROUND
           : c->normal.y >= UPRIGHT_COSINE ? (c->normal.y >= m->cos_slope ? TL_CHARACTER_GROUND : TL_CHARACTER_SLOPE)
           : c->normal.y <= -m->cos_slope  ? TL_CHARACTER_CEILING
                                           : TL_CHARACTER_WALL;
}

static void add_hit(tl_character_mover *m, const tl_mover_contact *c)
{
    tl_character_report *r = m->report;
    const tl_mover_item *item = &m->items[c->item];
    uint32_t kept = r->hit_count < TL_MAX_CHARACTER_HITS ? r->hit_count : TL_MAX_CHARACTER_HITS;
    for (uint32_t i = 0; i < kept; i++) {
        if (r->hits[i].instance == item->instance && r->hits[i].triangle == item->triangle) {
            return;
        }
    }
    if (kept < TL_MAX_CHARACTER_HITS) {
        tl_character_hit *hit = &r->hits[kept];
        hit->point = tl_vec3d_to_float(c->point);
        hit->normal = tl_vec3d_to_float(c->normal);
        hit->instance = item->instance;
        hit->triangle = item->triangle;
        hit->material = item->material;
        hit->surface = surface_of(m, c);
    }
    r->hit_count++;
}

// What of the contacts is in the way of the wish.
static void note_contacts(tl_character_mover *m, tl_mover_slide *slide)
{
    const double still = STILL_SHARE * m->gap;
    for (uint32_t i = 0; i < m->contact_count; i++) {
        const tl_mover_contact *c = &m->contacts[i];
        double into = -tl_vec3d_dot(c->normal, slide->wish);
        if (into <= still) {
            continue;
        }
        bool wall = acts_as_wall(m, slide, c);
        slide->blocked = slide->blocked || (wall && c->normal.y > -m->cos_slope);
        if (!slide->quiet) {
            m->report->hit_ceiling = m->report->hit_ceiling || c->normal.y < -UPRIGHT_COSINE;
            add_hit(m, c);
        }
    }
}

// Who comes down on ground that can be walked on has landed: the rest of the fall does not slide it along.
static void land(const tl_character_mover *m, tl_mover_slide *slide)
{
    const tl_mover_contact *ground =
        slide->walking || slide->wish.y >= 0.0 ? NULL : tl_mover_support(m, (double)INFINITY);
    if (ground != NULL && tl_vec3d_dot(ground->normal, slide->wish) < 0.0) {
        slide->wish.y = 0.0;
    }
}

void tl_mover_fall_aside(const tl_character_mover *m, tl_vec3d *wish)
{
    tl_mover_plane walls[TL_MAX_MOVER_PLANES];
    uint32_t count = 0;
    for (uint32_t i = 0; i < m->contact_count && wish->y < 0.0; i++) {
        const tl_vec3d n = m->contacts[i].normal;
        const double flat = sqrt(n.x * n.x + n.z * n.z);
        if (n.y > UPRIGHT_COSINE && n.y < m->cos_slope && flat > LEAN_SINE) {
            count = add_plane(walls, count, tl_vec3d_make(n.x / flat, 0.0, n.z / flat), 0.0);
        }
    }
    tl_vec3d aside = { wish->x, 0.0, wish->z };
    if (count > 0 && !tl_allowed_motion(walls, count, aside, SLACK_SHARE * m->gap, &aside)) {
        aside = tl_vec3d_make(0.0, 0.0, 0.0);
    }
    wish->x = aside.x;
    wish->z = aside.z;
}

void tl_mover_slide_along(tl_character_mover *m, tl_mover_slide *slide)
{
    tl_mover_plane planes[TL_MAX_MOVER_PLANES];
    const double slack = SLACK_SHARE * m->gap, still = STILL_SHARE * m->gap;
    slide->blocked = false;
    slide->rest = tl_vec3d_make(0.0, 0.0, 0.0);
    for (uint32_t i = 0; i < MAX_SLIDES; i++) {
        tl_mover_find_contacts(m, slide->feet);
        note_contacts(m, slide);
        land(m, slide);
        if (!slide->walking) {
            tl_mover_fall_aside(m, &slide->wish);
        }
        uint32_t count = tl_mover_planes(m, slide, planes);
        tl_vec3d motion;
        if (!allowed_motion(planes, count, slide, slack, true, &motion) &&
            !allowed_motion(planes, count, slide, slack, false, &motion)) {
            return;
        }
        if (tl_vec3d_dot(motion, motion) <= still * still) {
            return;
        }
        tl_mover_sweep sweep = tl_mover_cast(m, slide->feet, motion);
        slide->feet = tl_vec3d_mul_add(slide->feet, motion, sweep.t);
        slide->wish = tl_vec3d_scale(slide->wish, 1.0 - sweep.t);
        if (!sweep.hit) {
            slide->rest = slide->wish;
            return;
        }
    }
}

void tl_mover_push_out(tl_character_mover *m, tl_vec3d *feet)
{
    tl_mover_plane planes[TL_MAX_MOVER_PLANES];
    const double slack = SLACK_SHARE * m->gap, enough = ENOUGH_SHARE * m->gap, still = STILL_SHARE * m->gap;
    const tl_vec3d begin = *feet;
    tl_mover_slide none = { *feet, { 0, 0, 0 }, { 0, 0, 0 }, false, true, 0.0, false };
    for (uint32_t i = 0; i < MAX_PUSHES && tl_mover_find_contacts(m, *feet) < enough; i++) {
        tl_vec3d motion;
        uint32_t count = tl_mover_planes(m, &none, planes);
        if (!allowed_motion(planes, count, &none, slack, true, &motion)) {
            // They contradict each other: out of the deepest first.
            uint32_t deepest = 0;
            for (uint32_t k = 1; k < m->contact_count; k++) {
                deepest = m->contacts[k].gap < m->contacts[deepest].gap ? k : deepest;
            }
            const tl_mover_contact *c = &m->contacts[deepest];
            motion = tl_vec3d_scale(c->normal, m->gap - c->gap);
        }
        tl_mover_sweep sweep = tl_mover_cast(m, *feet, motion);
        *feet = tl_vec3d_mul_add(*feet, motion, sweep.t);
        if (tl_vec3d_dot(motion, motion) * sweep.t * sweep.t <= still * still) {
            break;
        }
    }
    m->report->pushed += (float)tl_vec3d_length(tl_vec3d_sub(*feet, begin));
}
