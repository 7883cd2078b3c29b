// SPDX-License-Identifier: MIT
//
// Where links from a ledge land. Down: over the edge, then onto the first floor that a ray meets, if it is walkable.
// Across: the first walkable place straight ahead, or 37 degrees to the left or right of it.

#include "nav_links/ledges.h"

#include "base/exact_floats.h"

#include <math.h>

// The navmesh ends one radius before the ledge, and below it begins one radius from the wall: two radii at least lie
// between them; voxels make that some cells more.
enum { CELLS_BEYOND = 5 };

// Both ends of a link, as paths will have them.
static void set_ends(tl_nav_link_candidate *candidate, tl_vec3 start, tl_vec3 end, float off_middle)
{
    candidate->link.start = start;
    candidate->link.end = end;
    candidate->cost = tl_distance(start, end);
    // Short links before long ones, and of two equally long ones the one nearer to the middle of its ledge.
    candidate->rank = candidate->cost + off_middle / 16.0f;
}

// The walkable floor under a place that is at most `down` metres lower.
static bool find_floor_below(const tl_nav_landing_search *search, tl_vec3 from, float down, tl_vec3 *point_out)
{
    tl_ray ray = { tl_vec3_make(from.x, from.y + search->lift, from.z), tl_vec3_make(0.0f, -1.0f, 0.0f),
                   down + search->lift };
    tl_ray_hit hit;
    if (!tl_soup_cast_ray(search->walker.soup, &ray, NULL, &hit)) {
        return false;
    }
    tl_nav_location floor;
    tl_vec3 center = tl_vec3_make(from.x, ray.origin.y - hit.t, from.z);
    tl_vec3 half = tl_vec3_make(search->cell, search->lift, search->cell);
    if (tl_navmesh_find_nearest(search->navmesh, NULL, center, half, &floor) != TL_OK) {
        return false;
    }
    *point_out = floor.point;
    return true;
}

static void try_down(const tl_nav_landing_search *search, const tl_nav_ledge_point *place,
                     tl_nav_link_candidate *candidate)
{
    float reach = fmaxf(search->def->max_drop, search->def->max_climb);
    candidate->fate = TL_NAV_CANDIDATE_NO_LANDING;
    candidate->link.kind = TL_NAV_LINK_DROP;
    for (int i = 1; i <= CELLS_BEYOND && candidate->fate != TL_NAV_CANDIDATE_FREE; i++) {
        tl_vec3 beyond = tl_add(place->point, tl_scale(place->out, 2.0f * search->radius + (float)i * search->cell));
        tl_vec3 floor;
        if (!find_floor_below(search, beyond, reach, &floor)) {
            continue;
        }
        float height = place->point.y - floor.y;
        bool climbs = height <= search->def->max_climb;
        if (height <= search->lift || (!climbs && height > search->def->max_drop)) {
            continue;
        }
        candidate->link.kind = climbs ? TL_NAV_LINK_CLIMB : TL_NAV_LINK_DROP;
        candidate->link.both_ways = climbs ? 1 : 0;
        set_ends(candidate, place->point, floor, place->off_middle);
        candidate->fate =
            tl_nav_link_is_free(&search->walker, &candidate->link) ? TL_NAV_CANDIDATE_FREE : TL_NAV_CANDIDATE_BLOCKED;
    }
}

static double plane_distance(tl_vec3 a, tl_vec3 b)
{
    const double x = (double)b.x - (double)a.x, z = (double)b.z - (double)a.z;
    return sqrt(x * x + z * z);
}

static bool is_jump_in_range(const tl_nav_links_def *def, tl_vec3 start, tl_vec3 end)
{
    return plane_distance(start, end) <= (double)def->max_jump && end.y - start.y <= def->jump_height &&
           start.y - end.y <= def->max_drop;
}

// The navmesh is looked for in boxes as wide as two cells, so what is found may lie a diagonal too far, where its
// polygon may still begin near enough.
static bool shorten_jump(const tl_nav_landing_search *search, tl_vec3 start, tl_nav_location *target)
{
    return is_jump_in_range(search->def, start, target->point) ||
           (tl_navmesh_closest_point(search->navmesh, target->polygon, start, &target->point, NULL) == TL_OK &&
            is_jump_in_range(search->def, start, target->point));
}

// The lowest jump that is slow enough and free.
static tl_nav_candidate_fate prove_jump(const tl_nav_landing_search *search, tl_nav_jump_link *link)
{
    const tl_nav_links_def *def = search->def;
    static const float HEIGHTS[] = { 0.25f, 0.5f, 1.0f };
    float up = link->end.y - link->start.y;
    double length = plane_distance(link->start, link->end);
    tl_nav_candidate_fate fate = TL_NAV_CANDIDATE_TOO_FAST;
    for (int i = 0; i < 3; i++) {
        link->apex = HEIGHTS[i] * def->jump_height;
        if (link->apex < up) {
            continue;
        }
        // It falls by gravity * seconds^2 / 2.
        double seconds = sqrt(2.0 * (double)tl_nav_parabola_of(up, link->apex).fall / (double)def->gravity);
        if (length > (double)def->max_speed * seconds) {
            continue;
        }
        link->both_ways = link->apex - up <= def->jump_height && up <= def->max_drop ? 1 : 0;
        fate = TL_NAV_CANDIDATE_BLOCKED;
        if (tl_nav_link_is_free(&search->walker, link)) {
            return TL_NAV_CANDIDATE_FREE;
        }
    }
    return fate;
}

static void try_jump(const tl_nav_landing_search *search, const tl_nav_ledge_point *place, tl_vec3 direction,
                     tl_nav_link_candidate *candidate)
{
    const tl_nav_links_def *def = search->def;
    // From the deepest landing to the highest.
    float middle = (def->jump_height - def->max_drop) / 2.0f;
    tl_vec3 half = tl_vec3_make(search->cell, (def->jump_height + def->max_drop) / 2.0f, search->cell);
    candidate->fate = TL_NAV_CANDIDATE_NO_LANDING;
    candidate->link.kind = TL_NAV_LINK_JUMP;
    for (float out = 2.0f * search->cell; out <= search->reach; out += 2.0f * search->cell) {
        tl_vec3 center = tl_add(place->point, tl_scale(direction, out));
        center.y += middle;
        tl_nav_location target;
        if (tl_navmesh_find_nearest(search->navmesh, NULL, center, half, &target) != TL_OK ||
            !shorten_jump(search, place->point, &target)) {
            continue;
        }
        set_ends(candidate, place->point, target.point, place->off_middle);
        candidate->fate = prove_jump(search, &candidate->link);
        return;
    }
}

void tl_nav_find_candidates(const tl_nav_landing_search *search, const tl_nav_ledge_point *place,
                            tl_nav_link_candidate candidates[TL_NAV_CANDIDATES_PER_PLACE])
{
    static const tl_nav_link_candidate NO_CANDIDATE = { 0 };
    for (uint32_t i = 0; i < TL_NAV_CANDIDATES_PER_PLACE; i++) {
        candidates[i] = NO_CANDIDATE;
    }
    if (search->def->max_drop > 0.0f || search->def->max_climb > 0.0f) {
        try_down(search, place, &candidates[0]);
    }
    // Ahead, and turned left and right by an angle of the triangle with sides 3, 4, 5.
    static const float TURNS[3][2] = { { 1.0f, 0.0f }, { 0.8f, 0.6f }, { 0.8f, -0.6f } };
    for (uint32_t i = 0; i < 3 && search->def->max_jump > 0.0f && search->def->jump_height > 0.0f; i++) {
        tl_vec3 out = place->out;
        tl_vec3 direction =
            tl_vec3_make(TURNS[i][0] * out.x - TURNS[i][1] * out.z, 0.0f, TURNS[i][1] * out.x + TURNS[i][0] * out.z);
        try_jump(search, place, direction, &candidates[1 + i]);
    }
}
