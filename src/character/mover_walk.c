// SPDX-License-Identifier: MIT
//
// Walking: slide; where a wall is in the way, try the same from a step's height; then down to the ground.
//
// Up, ahead and down is Quake's way over stairs (PM_StepSlideMove), kept because it asks nothing of the level. Three of
// its known faults are mended: a step counts only when it leads farther than sliding and ends on ground that can be
// walked on, so it lifts nobody up a steep slope or onto a ledge above step_height; an edge is judged by its face, not
// by the capsule's slanted normal, so slow characters climb too; and edges above the step's height are walls for the
// trial.

#include "character/mover.h"

// The cosine of a wall's normal to the vertical, 84 degrees: walls that lean by less do not carry, and the way down
// leads along them. Edges of steps do.
#define LEAN_COSINE 0.1

// A step leads farther when it does by this share of the gap: far above rounding, far below what a frame walks.
#define FARTHER_SHARE 0.0625

// Triangles are collected for a look one radius ahead: as far as that reaches, in radii, with room for the capsule's
// gap.
#define AHEAD_RADII 1.5

// Who is at the gap to this share of it, 2 um, stands there.
#define STAND_SHARE 0.0009765625

enum { MAX_DESCENTS = 4 };

static double flat_length(tl_vec3d a)
{
    return sqrt(a.x * a.x + a.z * a.z);
}

static bool has_support(tl_character_mover *m, tl_vec3d feet)
{
    tl_mover_find_contacts(m, feet);
    return tl_mover_support(m, (double)INFINITY) != NULL;
}

// Down by at most `drop`, along what leans by less than `lean`, to where the gap is whole: half of it is left by the
// sweep, and taken back.
static tl_vec3d descend(tl_character_mover *m, tl_vec3d feet, double drop, double lean, bool *hit_out)
{
    *hit_out = false;
    tl_vec3d motion = tl_vec3d_make(0.0, -drop, 0.0);
    for (int i = 0; i < MAX_DESCENTS; i++) {
        tl_mover_sweep sweep = tl_mover_cast(m, feet, motion);
        double moved = -motion.y * sweep.t;
        if (sweep.hit && (sweep.normal.y >= lean || has_support(m, tl_vec3d_mul_add(feet, motion, sweep.t)))) {
            double back = 0.5 * m->gap / sweep.normal.y, most = 0.5 * moved;
            back = sweep.normal.y < LEAN_COSINE && back > most ? most : back;
            *hit_out = true;
            return tl_vec3d_mul_add(feet, motion, moved > back ? sweep.t * ((moved - back) / moved) : 0.0);
        }
        feet = tl_vec3d_mul_add(feet, motion, sweep.t);
        if (!sweep.hit) {
            break;
        }
        motion = tl_vec3d_scale(motion, 1.0 - sweep.t);
        motion = tl_vec3d_mul_add(motion, sweep.normal, -tl_vec3d_dot(motion, sweep.normal));
    }
    return feet;
}

// Makes known what is near between two heights of the feet.
static bool reach_heights(tl_character_mover *m, double low, double high)
{
    tl_vec3d from = m->feet_low, to = m->feet_high;
    if (from.y <= low && to.y >= high) {
        return true;
    }
    from.y = low < from.y ? low : from.y;
    to.y = high > to.y ? high : to.y;
    m->crowded = m->crowded || !tl_mover_collect(m, from, to);
    return !m->crowded;
}

static bool settle_within(tl_character_mover *m, tl_vec3d *feet, double drop, double lean, double highest)
{
    bool hit;
    tl_vec3d low = descend(m, *feet, drop, lean, &hit);
    if (!hit) {
        return false;
    }
    tl_mover_find_contacts(m, low);
    const tl_mover_contact *ground = tl_mover_support(m, highest);
    if (ground == NULL) {
        return false;
    }
    m->ground_height = ground->point.y;
    *feet = low;
    return true;
}

// To the ground within `drop`, from where it may stand already, when it can be stood on, no edge above `highest`; else
// the feet stay. False: there is no such ground. It is mostly near, so what is farther down is collected only where it
// is not.
static bool settle_down(tl_character_mover *m, tl_vec3d *feet, double drop, double lean, double highest)
{
    tl_mover_find_contacts(m, *feet);
    const tl_mover_contact *here = tl_mover_support(m, highest);
    if (here != NULL && here->normal.y >= lean && fabs(here->gap - m->gap) <= STAND_SHARE * m->gap) {
        m->ground_height = here->point.y;
        return true;
    }
    double known = feet->y - m->feet_low.y;
    if (known > 0.0 && known < drop && settle_within(m, feet, known, lean, highest)) {
        return true;
    }
    if (reach_heights(m, feet->y - drop, feet->y) && settle_within(m, feet, drop, lean, highest)) {
        return true;
    }
    tl_mover_find_contacts(m, *feet);
    return tl_mover_support(m, highest) != NULL;
}

// How far down the ground may be after a walk: a step, and what slopes fall on the way. Who has rolled half over an
// edge measures from the edge.
static double ground_below(const tl_character_mover *m, tl_vec3d from, tl_vec3d to)
{
    double rise = to.y > from.y ? to.y - from.y : 0.0;
    double sunk = m->ground_height > from.y ? m->ground_height - from.y : 0.0;
    sunk = sunk < m->radius ? sunk : m->radius;
    double drop = m->step_height + m->tan_slope * flat_length(tl_vec3d_sub(to, from)) + rise - sunk;
    return drop > 0.0 ? drop + m->gap : m->gap;
}

// Whether `to` is farther along the wish than `than`.
static bool leads_farther(const tl_character_mover *m, tl_vec3d to, tl_vec3d than, tl_vec3d wish)
{
    return tl_vec3d_dot(tl_vec3d_sub(to, than), wish) > FARTHER_SHARE * m->gap * tl_vec3d_length(wish);
}

// Whether there is ground no higher than a step where `far` leads to from a step's height, or down the other side
// there; not down the same side.
static bool finds_ground(tl_character_mover *m, const tl_mover_slide *slid, tl_vec3d from, tl_vec3d lifted,
                         tl_vec3d far)
{
    const tl_vec3d half = tl_vec3d_mul_add(lifted, far, 0.5);
    tl_mover_slide probe = { lifted, far, { 0, 0, 0 }, true, true, slid->highest, false };
    tl_mover_slide_along(m, &probe);
    tl_vec3d top = probe.feet;
    double known = m->ground_height;
    bool found = leads_farther(m, top, half, far) &&
                 settle_down(m, &top, ground_below(m, from, top), m->cos_slope, slid->highest) &&
                 leads_farther(m, top, half, far);
    m->ground_height = known;
    return found;
}

// Steps with sides that are too steep, as a rock's or a beam's: what the wish leads to cannot be stood on, but a radius
// farther, or half of one, is ground no higher than a step. Then it climbs the side, held as if on ground, and a slow
// character is not stopped by it.
static bool climbs_side(tl_character_mover *m, const tl_mover_slide *slid, tl_vec3d from, tl_vec3d lifted,
                        tl_vec3d wish, tl_vec3d *feet)
{
    double reach = AHEAD_RADII * m->radius;
    tl_vec3d room = tl_vec3d_make(reach, 0.0, reach), far = tl_vec3d_scale(wish, m->radius / flat_length(wish));
    m->crowded = m->crowded || !tl_mover_collect(m, tl_vec3d_sub(m->feet_low, room), tl_vec3d_add(m->feet_high, room));
    bool found =
        finds_ground(m, slid, from, lifted, far) || finds_ground(m, slid, from, lifted, tl_vec3d_scale(far, 0.5));
    bool hit;
    *feet = descend(m, lifted, ground_below(m, from, lifted), LEAN_COSINE, &hit);
    tl_mover_find_contacts(m, *feet);
    const tl_mover_contact *side = tl_mover_steep_support(m);
    bool held = hit && side != NULL && side->normal.y >= LEAN_COSINE;
    m->climbing = found && held && !m->crowded && leads_farther(m, *feet, slid->feet, wish);
    return m->climbing;
}

static bool walk_over_step(tl_character_mover *m, const tl_mover_slide *slid, tl_vec3d from, tl_vec3d wish,
                           tl_vec3d *feet)
{
    double slope = m->feet_high.y - from.y;
    if (!reach_heights(m, from.y - m->step_height, from.y + m->step_height + slope)) {
        return false;
    }
    tl_mover_sweep up = tl_mover_cast(m, from, tl_vec3d_make(0.0, m->step_height, 0.0));
    double lifted = up.t * m->step_height;
    if (lifted <= m->gap) {
        return false;
    }
    tl_mover_slide ahead = { from, wish, { 0, 0, 0 }, true, true, slid->highest, false };
    ahead.feet.y += lifted;
    tl_mover_slide_along(m, &ahead);
    tl_vec3d end = ahead.feet;
    if (!leads_farther(m, end, slid->feet, wish)) {
        return false;
    }
    bool settled = settle_down(m, &end, ground_below(m, from, end), LEAN_COSINE, slid->highest);
    if (settled ? !leads_farther(m, end, slid->feet, wish) : !climbs_side(m, slid, from, ahead.feet, wish, &end)) {
        return false;
    }
    m->report->stepped_up += end.y > from.y ? (float)(end.y - from.y) : 0.0f;
    *feet = end;
    return true;
}

bool tl_mover_walk(tl_character_mover *m, tl_vec3d *feet, tl_vec3d wish)
{
    const tl_vec3d from = *feet;
    m->climbing = false;
    tl_mover_slide slide = { from, wish, { 0, 0, 0 }, true, false, from.y + m->step_height + m->gap, false };
    tl_mover_slide_along(m, &slide);
    if (slide.blocked && m->step_height > 0.0 && walk_over_step(m, &slide, from, wish, feet)) {
        return true;
    }
    m->report->blocked = m->report->blocked || slide.blocked;
    *feet = slide.feet;
    return settle_down(m, feet, ground_below(m, from, slide.feet), LEAN_COSINE, slide.highest);
}
