// SPDX-License-Identifier: MIT
//
// Cover: the hidden places with the shortest paths.
//
// A line of sight costs a tenth of a path, so each place is first tested for sight, and paths are searched to hidden
// ones only. No path is shorter than the straight distance: places are tried square by square around the agent, and
// once the next square is farther than the longest of `capacity` paths, no place beyond can be better.

#include "base/assert.h"
#include "math/tolerance.h"

#include <talus/nav_sight.h>

#include <math.h>
#include <string.h>

typedef struct cover_search {
    tl_nav_query *query;
    const tl_nav_cover_request *request;
    const tl_nav_cover_def *def;
    tl_nav_cover *covers; // sorted by length
    uint32_t capacity, count;
    float band;      // metres: two floors of a column lie at least this far apart
    float low, high; // metres: floors are looked for between
    bool gave_up;
} cover_search;

tl_nav_cover_def tl_default_nav_cover_def(void)
{
    static const float heights[] = { 0.3f, 1.0f, 1.6f };
    tl_nav_cover_def def;
    memset(&def, 0, sizeof def);
    memcpy(def.heights, heights, sizeof heights);
    def.height_count = 3;
    def.spacing = 1.0f;
    def.max_length = 30.0f;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

static tl_result check_cover_def(const tl_nav_cover_def *def)
{
    bool sound = def->cookie == TL_DEF_COOKIE && def->height_count >= 1 &&
                 def->height_count <= TL_NAV_MAX_COVER_HEIGHTS && isfinite(def->spacing) && def->spacing > 0.0f &&
                 isfinite(def->max_length) && def->max_length >= 0.0f;
    for (uint32_t i = 0; sound && i < def->height_count; i++) {
        sound = isfinite(def->heights[i]);
    }
    return sound ? TL_OK : TL_ERR_ARGUMENT;
}

static bool is_hidden(const cover_search *s, tl_vec3 place)
{
    for (uint32_t i = 0; i < s->def->height_count; i++) {
        const tl_vec3 part = { place.x, place.y + s->def->heights[i], place.z };
        if (tl_soup_line_of_sight(s->request->soup, s->request->threat, part, s->def->sight_filter)) {
            return false;
        }
    }
    return true;
}

// Longer paths cannot become part of the answer.
static float longest_useful(const cover_search *s)
{
    return s->count == s->capacity && s->capacity > 0 ? s->covers[s->count - 1].length : s->def->max_length;
}

static void insert_cover(cover_search *s, const tl_nav_location *place, float length)
{
    uint32_t at = s->count < s->capacity ? s->count++ : s->count - 1;
    for (; at > 0 && s->covers[at - 1].length > length; at--) {
        s->covers[at] = s->covers[at - 1];
    }
    s->covers[at].location = *place;
    s->covers[at].length = length;
}

static tl_result try_place(cover_search *s, const tl_nav_location *place)
{
    const tl_vec3 agent = s->request->agent.point;
    const float dx = place->point.x - agent.x, dz = place->point.z - agent.z, straight = sqrtf(dx * dx + dz * dz);
    const bool full = s->count == s->capacity;
    if (straight > longest_useful(s) || (full && straight >= longest_useful(s)) || !is_hidden(s, place->point)) {
        return TL_OK;
    }
    tl_nav_shortest_path path;
    const tl_nav_path_request request = { s->request->filter, s->request->agent, *place };
    TL_TRY(tl_nav_query_find_shortest_path(s->query, s->request->navmesh, &request, NULL, &path));
    s->gave_up = s->gave_up || path.status == TL_NAV_PATH_OUT_OF_NODES;
    const float length = (float)path.length;
    if (path.status == TL_NAV_PATH_COMPLETE && length <= s->def->max_length && (!full || length < longest_useful(s))) {
        insert_cover(s, place, length);
    }
    return TL_OK;
}

static bool is_agents_place(const cover_search *s, const tl_nav_location *place)
{
    const tl_vec3 agent = s->request->agent.point;
    return place->polygon == s->request->agent.polygon && place->point.x == agent.x && place->point.z == agent.z;
}

// All floors at a point of the grid: one query per band of heights, each as high as two floors are apart at least.
static tl_result try_column(cover_search *s, float x, float z)
{
    // Bands overlap by the rounding of their limits, so that no floor lies between two.
    const float half_band = 0.5f * s->band + TL_FLOAT_GAMMA(4) * tl_maxf(fabsf(s->low), fabsf(s->high));
    const uint32_t bands = (uint32_t)ceilf((s->high - s->low) / s->band) + 1;
    tl_nav_location last = { TL_NAV_NO_REF, { 0.0f, 0.0f, 0.0f } };
    for (uint32_t i = 0; i < bands; i++) {
        const tl_vec3 center = { x, s->low + s->band * (float)i, z }, half = { 0.0f, half_band, 0.0f };
        tl_nav_location place;
        const tl_result result = tl_navmesh_find_nearest(s->request->navmesh, s->request->filter, center, half, &place);
        if (result == TL_NOT_FOUND) {
            continue;
        }
        TL_TRY(result);
        if (place.polygon != last.polygon && !is_agents_place(s, &place)) { // it may lie in two bands
            TL_TRY(try_place(s, &place));
        }
        last = place;
    }
    return TL_OK;
}

// The rim of a square of the grid, row by row.
static tl_result try_square(cover_search *s, int64_t middle_x, int64_t middle_z, int64_t ring)
{
    const double spacing = (double)s->def->spacing;
    for (int64_t z = middle_z - ring; z <= middle_z + ring; z++) {
        const int64_t step = z == middle_z - ring || z == middle_z + ring || ring == 0 ? 1 : 2 * ring;
        for (int64_t x = middle_x - ring; x <= middle_x + ring; x += step) {
            TL_TRY(try_column(s, (float)((double)x * spacing), (float)((double)z * spacing)));
        }
    }
    return TL_OK;
}

static tl_result search_squares(cover_search *s)
{
    const double spacing = (double)s->def->spacing;
    const int64_t middle_x = (int64_t)floor((double)s->request->agent.point.x / spacing + 0.5);
    const int64_t middle_z = (int64_t)floor((double)s->request->agent.point.z / spacing + 0.5);
    // The agent lies up to half a spacing beside the middle.
    for (int64_t ring = 0; ((double)ring - 0.5) * spacing <= (double)longest_useful(s); ring++) {
        TL_TRY(try_square(s, middle_x, middle_z, ring));
    }
    return TL_OK;
}

// The range of heights in which floors are looked for: of the navmesh, within max_length of the agent.
static void find_height_range(cover_search *s)
{
    s->low = INFINITY;
    s->high = -INFINITY;
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(s->request->navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(s->request->navmesh, slot);
        s->low = tile != NULL ? tl_minf(s->low, tile->bounds.min.y) : s->low;
        s->high = tile != NULL ? tl_maxf(s->high, tile->bounds.max.y) : s->high;
    }
    s->low = tl_maxf(s->low, s->request->agent.point.y - s->def->max_length);
    s->high = tl_minf(s->high, s->request->agent.point.y + s->def->max_length);
}

tl_result tl_nav_query_find_cover(tl_nav_query *query, const tl_nav_cover_request *request, const tl_nav_cover_def *def,
                                  tl_nav_cover *covers_out, uint32_t capacity, uint32_t *count_out)
{
    const tl_nav_cover_def default_def = tl_default_nav_cover_def();
    const tl_nav_tile *tile;
    if (count_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    if (query == NULL || request == NULL || request->navmesh == NULL || request->soup == NULL ||
        (covers_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    def = def != NULL ? def : &default_def;
    TL_TRY(check_cover_def(def));
    if (!tl_is_finite(request->threat) || !tl_is_finite(request->agent.point)) {
        return TL_ERR_NOT_FINITE;
    }
    if (tl_navmesh_resolve(request->navmesh, request->agent.polygon, &tile, NULL) != TL_OK) {
        return TL_ERR_STALE;
    }
    if (capacity == 0) {
        return TL_OK;
    }
    cover_search s = { query, request, def, covers_out, capacity, 0, tile->agent_height, 0.0f, 0.0f, false };
    find_height_range(&s);
    TL_TRY(try_place(&s, &request->agent));
    TL_TRY(search_squares(&s));
    *count_out = s.count;
    return s.gave_up ? TL_ERR_NODES : TL_OK;
}
