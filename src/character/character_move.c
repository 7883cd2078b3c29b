// SPDX-License-Identifier: MIT
//
// One move of a character: carried, pushed out, moved.
//
// What is near is collected once for the whole motion where that is at most a radius, and else in parts; the parts of a
// walk let it follow the ground at any speed. Positions are doubles within a move and rounded to floats at its end,
// by far less than the gap.
//
// How others do it, and what their users report. Quake's PM_StepSlideMove and Unreal's CharacterMovement clip the
// motion at one plane after the other, PhysX' controller sweeps up, aside and down: all stop or tremble in acute
// corners. Jolt's CharacterVirtual and Rapier's controller sweep with contacts at a padding: ghost hits at inner edges,
// tremor at the foot of steep slopes, a padding that is lost on the way, and characters that sink into lifts. Box3D's
// mover solves all planes at once, by relaxation, and leaves steps and slopes to the game. Here the planes are solved
// exactly (allowed_motion.c), inner edges make none (mover_contacts.c), the gap is a constraint like any other and
// grows back, and what a lift moves is carried by its very motion.

#include "base/assert.h"
#include "base/host.h"
#include "character/mover.h"
#include "math/tolerance.h"

#include <string.h>

// The gap is no less than this share of the coordinates: sixteen roundings of a position.
#define GAP_SHARE (16.0 * (double)TL_FLOAT_ROUNDING)

// A gap wider than this, in radii, is none to walk with.
#define WIDEST_GAP 0.25

// A motion in parts goes down to a part of a quarter of the radius; and after so many parts more than it is long, in
// radii, it leads nowhere.
#define LEAST_PART  0.25
#define SPARE_PARTS 16u

// Beside the motion, in gaps, for what is pushed back to the gap.
#define ROOM_GAPS 4.0

// Who is nearer than this, in gaps, is pushed out first.
#define OVERLAP_GAPS 0.25

// Overlaps by more than this, in gaps, are named at the end of a move.
#define OVERLAP_SHARE 0.03125

static_assert(sizeof(tl_character) == 22 * sizeof(float), "a state has no padding");

// What a move works on.
typedef struct move_state {
    tl_vec3d feet, motion;
    bool walking;
} move_state;

static tl_result check_move(const tl_character_level *level, const tl_character_step *step, const tl_character *c,
                            tl_report *report)
{
    if ((level->soup != NULL) == (level->scene != NULL)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "level", "set its soup or its scene, one of the two");
    }
    if (level->scene != NULL && level->instances == NULL && tl_scene_get_stats(level->scene).instance_count > 0) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "level", "give the scene's instances");
    }
    if (!(step->seconds >= 0.0f) || !isfinite(step->seconds)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "seconds", "make it >= 0 and finite");
    }
    if (!tl_is_finite(step->velocity)) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, "velocity", "make it finite");
    }
    if (!tl_is_finite(c->position)) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, "position", "make it finite");
    }
    tl_vec3d motion = tl_vec3d_scale(tl_vec3d_from(step->velocity), (double)step->seconds);
    if (tl_vec3d_length(motion) > (double)TL_MAX_CHARACTER_MOTION) {
        return tl_report_field(report, TL_ERR_RANGE, "velocity", "move at most TL_MAX_CHARACTER_MOTION at once");
    }
    return TL_OK;
}

// Where the feet may be during a motion: the nearest motions that planes allow end in the ball over the wish as its
// diameter (Thales), and so do all slides of the rest together. Walking leads over slopes besides; what a step and the
// way down need is collected when they are tried.
static bool collect_around(tl_character_mover *m, tl_vec3d feet, tl_vec3d motion, bool walking, double room)
{
    double half = 0.5 * tl_vec3d_length(motion), climb = walking ? 2.0 * m->tan_slope * half : 0.0;
    tl_vec3d middle = tl_vec3d_mul_add(feet, motion, 0.5);
    half += room + ROOM_GAPS * m->gap;
    tl_vec3d reach = tl_vec3d_make(half, half + climb, half);
    return tl_mover_collect(m, tl_vec3d_sub(middle, reach), tl_vec3d_add(middle, reach));
}

// The longest part of the motion whose surroundings fit into the scratch.
static bool collect_part(tl_character_mover *m, const move_state *s, tl_vec3d *part_out)
{
    double length = tl_vec3d_length(s->motion), least = LEAST_PART * m->radius;
    double part = s->walking && length > m->radius ? m->radius : length;
    for (;; part = 0.5 * part > least ? 0.5 * part : least) {
        *part_out = tl_vec3d_scale(s->motion, part < length ? part / length : 1.0);
        if (collect_around(m, s->feet, *part_out, s->walking, 0.0)) {
            return true;
        }
        if (part <= least) {
            return false;
        }
    }
}

static tl_result refuse_crowded(tl_character_report *report)
{
    return tl_report_field(&report->base, TL_ERR_LIMIT, "max_triangles",
                           "more triangles than this are near: make a mover that takes more");
}

static bool same_pose(const tl_transform *a, const tl_transform *b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

// Carried along with the instance that it stands on: that one is where it is now, so it is ignored; others stop it.
static tl_result carry(tl_character_mover *m, const tl_character *c, double seconds, move_state *s)
{
    const tl_character_level *level = m->level;
    if (c->grounded == 0 || level->scene == NULL ||
        c->ground_instance >= tl_scene_get_stats(level->scene).instance_count ||
        same_pose(&level->instances[c->ground_instance].pose, &c->ground_pose)) {
        return TL_OK;
    }
    tl_frame then = tl_frame_from(c->ground_pose), now = tl_frame_from(level->instances[c->ground_instance].pose);
    tl_vec3d seen = tl_frame_rotate_back(&then, tl_vec3d_sub(s->feet, then.origin));
    tl_vec3d by = tl_vec3d_sub(tl_frame_point(&now, seen), s->feet);
    if (!(tl_vec3d_length(by) <= (double)TL_MAX_CHARACTER_MOTION)) {
        return TL_OK; // it is somewhere else now: gone, for who stood on it
    }
    tl_quatd q = tl_quatd_between(tl_quatd_from(tl_quat_conjugate(level->instances[c->ground_instance].pose.rotation)),
                                  tl_quatd_from(tl_quat_conjugate(c->ground_pose.rotation)));
    double scale = 1.0 / sqrt(q.length_sq);
    tl_quat turned = { (float)(q.x * scale), (float)(q.y * scale), (float)(q.z * scale), (float)(q.w * scale) };
    m->report->turned = turned;
    if (!collect_around(m, s->feet, by, false, 0.0)) {
        return refuse_crowded(m->report);
    }
    tl_mover_slide ride = { s->feet, by, { 0, 0, 0 }, false, true, 0.0, false };
    m->ignored_instance = c->ground_instance;
    tl_mover_slide_along(m, &ride);
    m->ignored_instance = TL_NO_INSTANCE;
    m->contacts_known = false;
    tl_vec3d carried = tl_vec3d_sub(ride.feet, s->feet);
    m->report->carried = tl_vec3d_to_float(carried);
    if (seconds > 0.0) {
        m->report->ground_velocity = tl_vec3d_to_float(tl_vec3d_scale(by, 1.0 / seconds));
    }
    s->feet = ride.feet;
    m->ground_height += carried.y;
    return TL_OK;
}

// One part; false when it led nowhere.
static bool move_part(tl_character_mover *m, move_state *s, tl_vec3d part, bool last)
{
    const tl_vec3d from = s->feet;
    s->motion = last ? tl_vec3d_make(0.0, 0.0, 0.0) : tl_vec3d_sub(s->motion, part);
    if (s->walking) {
        s->walking = tl_mover_walk(m, &s->feet, part);
    } else {
        tl_mover_slide slide = { s->feet, part, { 0, 0, 0 }, false, false, 0.0, false };
        tl_mover_slide_along(m, &slide);
        m->report->blocked = m->report->blocked || slide.blocked;
        s->feet = slide.feet;
        s->motion = tl_vec3d_add(s->motion, slide.rest);
    }
    tl_vec3d moved = tl_vec3d_sub(s->feet, from);
    return tl_vec3d_dot(moved, moved) > 0.0;
}

static tl_result move_all(tl_character_mover *m, move_state *s)
{
    double radii = tl_vec3d_length(s->motion) / (LEAST_PART * m->radius);
    uint32_t parts = SPARE_PARTS + (uint32_t)(radii < 1e9 ? radii : 1e9);
    for (uint32_t i = 0; i < parts; i++) {
        tl_vec3d part;
        if (!collect_part(m, s, &part)) {
            return refuse_crowded(m->report);
        }
        if (i == 0 && tl_mover_find_contacts(m, s->feet) < OVERLAP_GAPS * m->gap) {
            if (!collect_around(m, s->feet, part, s->walking, m->radius)) {
                return refuse_crowded(m->report);
            }
            tl_mover_push_out(m, &s->feet);
            if (!collect_part(m, s, &part)) {
                return refuse_crowded(m->report);
            }
        }
        bool last = tl_vec3d_size(tl_vec3d_sub(s->motion, part)) == 0.0;
        bool moved = move_part(m, s, part, last);
        if (!moved || tl_vec3d_size(s->motion) == 0.0) {
            break;
        }
    }
    return m->crowded ? refuse_crowded(m->report) : TL_OK;
}

static double largest_coordinate(tl_vec3d a)
{
    double x = fabs(a.x), y = fabs(a.y), z = fabs(a.z), xy = x > y ? x : y;
    return xy > z ? xy : z;
}

// What of the velocity the contacts at the end allow.
static tl_vec3d allowed_velocity(const tl_character_mover *m, tl_vec3d velocity, bool grounded)
{
    tl_mover_plane planes[TL_MAX_MOVER_PLANES];
    if (!grounded) {
        tl_mover_fall_aside(m, &velocity);
    }
    tl_mover_slide here = { { 0, 0, 0 }, velocity, { 0, 0, 0 }, false, true, 0.0, false };
    uint32_t count = tl_mover_planes(m, &here, planes), kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        planes[i].least = 0.0;
        // The ground takes no speed from who walks on it.
        if (!grounded || planes[i].normal.y < m->cos_slope) {
            planes[kept++] = planes[i];
        }
    }
    tl_vec3d allowed;
    double slack = TL_DOUBLE_GAMMA(64) * tl_vec3d_size(velocity);
    if (!tl_allowed_motion(planes, kept, velocity, slack, &allowed)) {
        allowed = tl_vec3d_make(0.0, 0.0, 0.0);
    }
    allowed.y = grounded ? 0.0 : allowed.y;
    return allowed;
}

static void stand_on(const tl_character_mover *m, const tl_mover_contact *ground, tl_character *c)
{
    const tl_mover_item *item = &m->items[ground->item];
    tl_vec3d normal = ground->normal;
    if (item->shape == NULL && fabs(item->normal.y) >= m->cos_slope) {
        normal = item->normal.y < 0.0 ? tl_vec3d_neg(item->normal) : item->normal;
    }
    c->grounded = 1;
    c->ground_normal = tl_vec3d_to_float(normal);
    c->ground_point = tl_vec3d_to_float(ground->point);
    c->ground_triangle = item->triangle;
    c->ground_instance = item->instance;
    c->ground_pose = m->level->scene != NULL ? m->level->instances[item->instance].pose : tl_transform_identity();
}

// The new state, from where the move ended.
static tl_character finish_move(tl_character_mover *m, const move_state *s, const tl_character_step *step,
                                const tl_character *before, bool walked)
{
    tl_character c;
    memset(&c, 0, sizeof c);
    c.position = tl_vec3d_to_float(s->feet);
    c.ground_triangle = TL_NO_TRIANGLE;
    double least = tl_mover_find_contacts(m, s->feet);
    m->report->stuck = least < -OVERLAP_SHARE * m->gap;
    tl_vec3d velocity = tl_vec3d_from(step->velocity);
    velocity.y = walked ? 0.0 : velocity.y;
    const tl_mover_contact *ground = tl_mover_support(m, (double)INFINITY);
    ground = ground == NULL && s->walking && m->climbing ? tl_mover_steep_support(m) : ground;
    // Who goes up and away from the ground has not landed on it.
    bool leaves = !walked && ground != NULL && velocity.y > 0.0 && tl_vec3d_dot(ground->normal, velocity) > 0.0;
    if (ground != NULL && !leaves) {
        stand_on(m, ground, &c);
    }
    c.velocity = tl_vec3d_to_float(allowed_velocity(m, velocity, c.grounded != 0));
    if (before->grounded != 0 && c.grounded == 0) {
        c.velocity = tl_add(c.velocity, m->report->ground_velocity); // that of the lift it jumped from
    }
    m->report->landed = before->grounded == 0 && c.grounded != 0;
    m->report->left_ground = before->grounded != 0 && c.grounded == 0;
    return c;
}

tl_result tl_character_move(tl_character_mover *mover, const tl_character_level *level, const tl_character_step *step,
                            tl_character *character, tl_character_report *report_out)
{
    tl_character_report unwanted, *report = report_out != NULL ? report_out : &unwanted;
    memset(report, 0, sizeof *report);
    tl_report_begin(&report->base, "move");
    TL_REFUSE_NULL(mover, &report->base);
    TL_REFUSE_NULL(level, &report->base);
    TL_REFUSE_NULL(step, &report->base);
    TL_REFUSE_NULL(character, &report->base);
    TL_TRY(check_move(level, step, character, &report->base));
    mover->level = level;
    mover->report = report;
    mover->ignored_instance = TL_NO_INSTANCE;
    mover->crowded = mover->climbing = false;
    report->turned.w = 1.0f;
    move_state s = { tl_vec3d_from(character->position),
                     tl_vec3d_scale(tl_vec3d_from(step->velocity), (double)step->seconds),
                     character->grounded != 0 && !step->leave_ground };
    s.motion.y = s.walking ? 0.0 : s.motion.y;
    double least_gap = GAP_SHARE * (largest_coordinate(s.feet) + tl_vec3d_length(s.motion));
    if (least_gap > WIDEST_GAP * mover->radius) {
        return tl_report_field(&report->base, TL_ERR_RANGE, "position", "keep it within 2^18 radii of the origin");
    }
    mover->gap = least_gap > (double)mover->def.gap ? least_gap : (double)mover->def.gap;
    const bool walked = s.walking;
    mover->ground_height = s.walking ? (double)character->ground_point.y : s.feet.y;
    TL_TRY(carry(mover, character, (double)step->seconds, &s));
    TL_TRY(move_all(mover, &s));
    *character = finish_move(mover, &s, step, character, walked);
    return TL_OK;
}
