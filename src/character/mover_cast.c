// SPDX-License-Identifier: MIT
//
// Sweeping the capsule past what is near: conservative advancement, item by item.
//
// The distance of two convex sets is a convex function of their motion, so Newton's iteration on it comes from the free
// side and is never late; and where the distance grows at the start, it grows for ever. So an item that is too near
// already, whether the character was pushed into it or rounding brought it there, stops only motion towards it.
//
// Source: Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, 1996; as in soup/query/capsule_cast.c, which
// casts through the tree, one triangle at a time. Here the triangles are at hand.

#include "character/mover.h"

// Half of the gap is a sweep's to use; and what is nearer still may come so much nearer, in gaps, by rounding.
#define CAST_SHARE  0.5
#define CREEP_SHARE 0.015625

// The iteration ends this near to its goal, in gaps; what stays so much farther it never reaches.
#define CLOSE_SHARE 0.00390625
#define MISS_SHARE  0.0078125

enum { MAX_ADVANCES = 64 };

// What a cast is to all items: the box of the core along the whole motion, and what it keeps from them.
typedef struct cast_sweep {
    tl_vec3d low, high;
    double length; // of the motion
    double keep, miss;
} cast_sweep;

static cast_sweep sweep_core(const tl_character_mover *m, const tl_mover_core *core, tl_vec3d by)
{
    const double keep = m->radius + CAST_SHARE * m->gap;
    cast_sweep box = { core->low, core->low, tl_vec3d_length(by), keep, keep + MISS_SHARE * m->gap };
    box.high.y += core->length;
    box.low.x = by.x < 0.0 ? box.low.x + by.x : box.low.x;
    box.low.y = by.y < 0.0 ? box.low.y + by.y : box.low.y;
    box.low.z = by.z < 0.0 ? box.low.z + by.z : box.low.z;
    box.high.x = by.x > 0.0 ? box.high.x + by.x : box.high.x;
    box.high.y = by.y > 0.0 ? box.high.y + by.y : box.high.y;
    box.high.z = by.z > 0.0 ? box.high.z + by.z : box.high.z;
    return box;
}

// Whether the capsule stays clear of the item's box along the whole motion. Along one axis `keep` is enough; else as
// far as a miss, since what comes nearer than that ends a motion already.
static bool sweep_misses_box(const tl_mover_item *item, const cast_sweep *sweep)
{
    const double x = tl_mover_between(item->low.x, item->high.x, sweep->low.x, sweep->high.x);
    const double y = tl_mover_between(item->low.y, item->high.y, sweep->low.y, sweep->high.y);
    const double z = tl_mover_between(item->low.z, item->high.z, sweep->low.z, sweep->high.z);
    const double keep = sweep->keep;
    return x > keep || y > keep || z > keep || x * x + y * y + z * z > sweep->miss * sweep->miss;
}

// The same of the motion until something else is met. What keeps as far off as a miss until then, ends nothing before
// it.
static bool is_met_later(const tl_mover_item *item, const cast_sweep *until)
{
    const double x = tl_mover_between(item->low.x, item->high.x, until->low.x, until->high.x);
    const double y = tl_mover_between(item->low.y, item->high.y, until->low.y, until->high.y);
    const double z = tl_mover_between(item->low.z, item->high.z, until->low.z, until->high.z);
    return x * x + y * y + z * z > until->miss * until->miss;
}

// The time at which the core may first be within reach of the triangle's plane; INFINITY: it never is.
static double reaches_plane(const tl_mover_item *t, const tl_mover_core *core, tl_vec3d motion, double reach)
{
    double first = tl_vec3d_dot(t->normal, tl_vec3d_sub(core->low, t->corners[0]));
    double second = first + t->normal.y * core->length, speed = tl_vec3d_dot(t->normal, motion);
    double low = first < second ? first : second, high = first < second ? second : first;
    if (low > reach) {
        return speed < 0.0 ? (low - reach) / -speed : (double)INFINITY;
    }
    if (high < -reach) {
        return speed > 0.0 ? (-high - reach) / speed : (double)INFINITY;
    }
    return 0.0;
}

static void cast_at_item(const tl_character_mover *m, const tl_mover_core *core, tl_vec3d motion,
                         const cast_sweep *sweep, uint32_t index, tl_mover_sweep *best)
{
    tl_mover_item *item = &m->items[index];
    double keep = sweep->keep;
    tl_mover_know(item);
    double t = item->shape == NULL ? reaches_plane(item, core, motion, keep) : 0.0;
    bool started = t > 0.0;
    for (uint32_t i = 0; t < best->t; i++) {
        tl_mover_core at = *core;
        at.low = tl_vec3d_mul_add(core->low, motion, t);
        tl_mover_nearest nearest;
        tl_mover_nearest_of(item, &at, sweep->miss + (best->t - t) * sweep->length, &nearest);
        double closing = nearest.distance < (double)INFINITY ? -tl_vec3d_dot(nearest.normal, motion) : 0.0;
        if (!(closing > 0.0)) {
            return;
        }
        if (!started) {
            started = true;
            double creep = nearest.distance - (nearest.distance > m->radius ? CREEP_SHARE * m->gap : 0.0);
            keep = creep < keep ? creep : keep;
        }
        double rest = nearest.distance - keep;
        if (rest <= CLOSE_SHARE * m->gap || i == MAX_ADVANCES) {
            best->t = t;
            best->hit = true;
            best->item = index;
            best->normal = nearest.normal;
            best->point = nearest.point;
            return;
        }
        t += rest / closing;
    }
}

// The share of a motion from `at` that stays between low and high.
static double share_within(double at, double by, double low, double high)
{
    double room = by > 0.0 ? high - at : at - low, length = fabs(by);
    return room >= length ? 1.0 : room > 0.0 ? room / length : 0.0;
}

tl_mover_sweep tl_mover_cast(tl_character_mover *m, tl_vec3d feet, tl_vec3d motion)
{
    const tl_mover_core core = tl_mover_core_at(m, feet);
    tl_mover_sweep best = { 1.0, false, 0, { 0, 0, 0 }, { 0, 0, 0 } };
    double x = share_within(feet.x, motion.x, m->feet_low.x, m->feet_high.x);
    double y = share_within(feet.y, motion.y, m->feet_low.y, m->feet_high.y);
    double z = share_within(feet.z, motion.z, m->feet_low.z, m->feet_high.z);
    best.t = x < y ? x : y;
    best.t = z < best.t ? z : best.t;
    const cast_sweep sweep = sweep_core(m, &core, motion);
    m->report->sweeps++;
    // What it was in contact with last is likely to be met first, and then most others are told off at once.
    const uint32_t first = m->contact_count > 0 ? m->contacts[m->contact_count - 1].item : 0;
    const float most_sq = tl_mover_measure_boxes(m, sweep.low, sweep.high, sweep.miss);
    cast_sweep until = sweep; // something is met
    for (uint32_t i = 0; i < m->item_count; i++) {
        const uint32_t index = i == 0 ? first : i <= first ? i - 1 : i;
        const tl_mover_item *item = &m->items[index];
        if (tl_mover_is_box_away(m, index, most_sq) || (m->has_boxes && best.hit && is_met_later(item, &until))) {
            continue;
        }
        if (item->instance != m->ignored_instance && !sweep_misses_box(item, &sweep)) {
            cast_at_item(m, &core, motion, &sweep, index, &best);
            if (m->has_boxes && best.hit && best.item == index) {
                until = sweep_core(m, &core, tl_vec3d_scale(motion, best.t));
            }
        }
    }
    return best;
}
