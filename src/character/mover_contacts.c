// SPDX-License-Identifier: MIT
//
// Where the capsule is near the level.
//
// A contact at an edge or corner counts only where the point is a local minimum of the distance to the whole level:
// when a triangle that holds the point rises above the plane across the normal there, it has a nearer point, and a
// contact of its own. So the inner edges of flat floors and walls make no contacts, whatever the triangles are and
// whether they share vertices; nothing has to be marked when a level is baked, and nothing is lost, as sweeps mind
// every triangle.

#include "character/mover.h"
#include "math/tolerance.h"

// As in the soup's contacts: how far a corner may rise, over its distance, and how near triangles meet.
#define MOVER_RISE          1e-4
#define MOVER_MEETING_SHARE (16.0 * (double)TL_FLOAT_ROUNDING)

// A normal this near to the triangle's is the triangle's: 1 - cos of a thousandth.
#define MOVER_FACE_ANGLE 5e-7

// Contacts are within the gap and a quarter of it.
#define CONTACT_SHARE 1.25

// What is outside of a triangle's edge by more than this, in gaps, is none, with room for rounding.
#define BEYOND_SHARE 1.3125

// Upper faces of shapes are looked for so far inside of an edge, in radii.
#define INWARD_SHARE 0.0625

static bool rises_at(const tl_character_mover *m, const tl_mover_contact *edge, tl_mover_item *other)
{
    double meeting = MOVER_MEETING_SHARE * (tl_vec3d_size(edge->point) + m->core_length + m->radius);
    tl_mover_core point = { edge->point, 0.0, 0.0 };
    if (other->shape != NULL || tl_mover_is_far(other, &point, meeting)) {
        return false;
    }
    bool may_rise = false;
    for (int k = 0; k < 3 && !may_rise; k++) {
        may_rise = tl_vec3d_dot(tl_vec3d_sub(other->corners[k], edge->point), edge->normal) > -meeting;
    }
    tl_mover_nearest nearest;
    if (!may_rise) {
        return false;
    }
    tl_mover_nearest_of(other, &point, 2.0 * meeting, &nearest);
    bool rises = false;
    for (int k = 0; k < 3 && nearest.distance <= meeting; k++) {
        tl_vec3d to = tl_vec3d_sub(other->corners[k], nearest.point);
        rises = rises || tl_vec3d_dot(to, edge->normal) > MOVER_RISE * tl_vec3d_length(to);
    }
    return rises;
}

static void drop_inner_edges(tl_character_mover *m)
{
    uint32_t kept = 0;
    // Only a nearer one hides another, so the nearest stays. All are judged before any is dropped: one that goes still
    // tells that another has to.
    for (uint32_t i = 0; i < m->contact_count; i++) {
        const tl_mover_contact *c = &m->contacts[i];
        bool inner = false;
        for (uint32_t j = 0; j < m->contact_count && !c->face && !inner && c->gap > -m->radius; j++) {
            inner = m->contacts[j].gap < c->gap && m->items[c->item].shape == NULL &&
                    rises_at(m, c, &m->items[m->contacts[j].item]);
        }
        m->contacts[i].inner = inner;
    }
    for (uint32_t i = 0; i < m->contact_count; i++) {
        if (!m->contacts[i].inner) {
            m->contacts[kept++] = m->contacts[i];
        }
    }
    m->contact_count = kept;
}

// How level the upper face beside the point is: |cosine|.
static double top_cosine(const tl_character_mover *m, const tl_mover_contact *c)
{
    const tl_mover_item *item = &m->items[c->item];
    if (item->shape == NULL) {
        return fabs(item->normal.y);
    }
    double inward = INWARD_SHARE * m->radius;
    tl_vec3d above = c->point;
    double flat = sqrt(c->normal.x * c->normal.x + c->normal.z * c->normal.z);
    if (flat > 0.0) {
        above.x -= c->normal.x / flat * inward;
        above.z -= c->normal.z / flat * inward;
    }
    above.y += m->radius;
    tl_convex_hit hit;
    tl_scaled_convex room;
    bool found = tl_convex_cast_ray(tl_mover_shape(item, &room), *item->pose, tl_vec3d_to_float(above),
                                    tl_vec3_make(0.0f, -1.0f, 0.0f), 2.0f * (float)m->radius, &hit);
    return found && !hit.initial_overlap ? (double)hit.normal.y : 0.0;
}

// Can be stood on: within the slope, or the edge of a face that is, no higher than a step.
static bool can_support(const tl_character_mover *m, tl_vec3d feet, const tl_mover_contact *c)
{
    if (c->normal.y >= m->cos_slope) {
        return true;
    }
    return !c->face && c->normal.y > MOVER_RISE && c->point.y - feet.y <= m->step_height + m->gap &&
           top_cosine(m, c) >= m->cos_slope;
}

// Whether the core lies on one side of the plane, farther than `reach`.
static bool is_off_plane(const tl_mover_item *t, const tl_mover_core *core, double reach)
{
    double low = tl_vec3d_dot(t->normal, tl_vec3d_sub(core->low, t->corners[0])),
           high = low + t->normal.y * core->length;
    return (low > reach && high > reach) || (low < -reach && high < -reach);
}

double tl_mover_find_contacts(tl_character_mover *m, tl_vec3d feet)
{
    const tl_vec3d at = m->contacts_at;
    if (m->contacts_known && feet.x == at.x && feet.y == at.y && feet.z == at.z) {
        return m->least_gap;
    }
    const tl_mover_core core = tl_mover_core_at(m, feet);
    const double reach = m->radius + CONTACT_SHARE * m->gap, beyond = m->radius + BEYOND_SHARE * m->gap;
    double least = (double)INFINITY;
    m->contact_count = 0;
    tl_vec3d top = core.low;
    top.y += core.length;
    const float most_sq = tl_mover_measure_boxes(m, core.low, top, reach);
    for (uint32_t i = 0; i < m->item_count; i++) {
        if (tl_mover_is_box_away(m, i, most_sq)) {
            continue;
        }
        tl_mover_item *item = &m->items[i];
        if (item->instance == m->ignored_instance || tl_mover_is_far(item, &core, reach)) {
            continue;
        }
        tl_mover_know(item);
        if (is_off_plane(item, &core, reach)) {
            continue;
        }
        tl_mover_nearest nearest;
        tl_mover_nearest_of(item, &core, beyond, &nearest);
        if (nearest.distance > reach) {
            continue;
        }
        tl_mover_contact *c = &m->contacts[m->contact_count++];
        c->normal = nearest.normal;
        c->point = nearest.point;
        c->gap = nearest.distance - m->radius;
        c->item = i;
        c->face = nearest.face;
        double cosine = tl_vec3d_dot(c->normal, item->normal);
        if (fabs(cosine) >= 1.0 - MOVER_FACE_ANGLE) { // just beside the face: a tilt that is none
            c->normal = cosine < 0.0 ? tl_vec3d_neg(item->normal) : item->normal;
            c->face = true;
        }
        c->inner = c->supports = false;
        least = c->gap < least ? c->gap : least;
    }
    drop_inner_edges(m);
    for (uint32_t i = 0; i < m->contact_count; i++) {
        m->contacts[i].supports = can_support(m, feet, &m->contacts[i]);
    }
    m->contacts_known = true;
    m->contacts_at = feet;
    m->least_gap = least;
    return least;
}

const tl_mover_contact *tl_mover_support(const tl_character_mover *m, double highest)
{
    const tl_mover_contact *best = NULL;
    for (uint32_t i = 0; i < m->contact_count; i++) {
        const tl_mover_contact *c = &m->contacts[i];
        bool counts = c->supports && (c->face || c->point.y <= highest);
        if (counts && (best == NULL || c->normal.y > best->normal.y)) {
            best = c;
        }
    }
    return best;
}

const tl_mover_contact *tl_mover_steep_support(const tl_character_mover *m)
{
    const tl_mover_contact *best = NULL;
    for (uint32_t i = 0; i < m->contact_count; i++) {
        const tl_mover_contact *c = &m->contacts[i];
        if (c->normal.y > MOVER_RISE && (best == NULL || c->normal.y > best->normal.y)) {
            best = c;
        }
    }
    return best;
}
