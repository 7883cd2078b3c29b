// SPDX-License-Identifier: MIT
//
// Cover: the hidden places with the shortest paths.
//
// A line of sight costs a tenth of a path, so each place is first tested for sight, and paths are searched to hidden
// ones only. No path is shorter than the straight distance: places are tried square by square around the agent, and
// once the next square is farther than the longest of `capacity` paths, no place beyond can be better. Squares are cut
// to what of the navmesh lies within max_length: each step of a loop tries a place, and places are counted.

#include "base/assert.h"
#include "base/min_max.h"
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
    uint32_t bands;  // of a column
    uint32_t budget; // places that may still be tried
    bool gave_up;
} cover_search;

// Points of the grid, in spacings.
typedef struct cover_grid {
    int64_t middle_x, middle_z; // the agent's
    int64_t first_x, last_x, first_z, last_z;
} cover_grid;

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
static tl_result try_column(cover_search *s, int64_t at_x, int64_t at_z)
{
    // Bands overlap by the rounding of their limits, so that no floor lies between two.
    const float half_band = 0.5f * s->band + TL_FLOAT_GAMMA(4) * tl_maxf(fabsf(s->low), fabsf(s->high));
    const float x = (float)((double)at_x * (double)s->def->spacing),
                z = (float)((double)at_z * (double)s->def->spacing);
    tl_nav_location last = { TL_NAV_NO_REF, { 0.0f, 0.0f, 0.0f } };
    if (s->budget < s->bands) {
        return TL_ERR_LIMIT;
    }
    s->budget -= s->bands;
    for (uint32_t i = 0; i < s->bands; i++) {
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

// The points of a row that lie on a square's rim.
static tl_result try_row(cover_search *s, const cover_grid *grid, int64_t z, int64_t ring)
{
    const int64_t low = grid->middle_x - ring, high = grid->middle_x + ring;
    const bool is_edge = z == grid->middle_z - ring || z == grid->middle_z + ring;
    if (z < grid->first_z || z > grid->last_z) {
        return TL_OK;
    }
    if (is_edge) {
        const int64_t last = tl_min_i64(high, grid->last_x);
        for (int64_t x = tl_max_i64(low, grid->first_x); x <= last; x++) {
            TL_TRY(try_column(s, x, z));
        }
        return TL_OK;
    }
    if (low >= grid->first_x && low <= grid->last_x) {
        TL_TRY(try_column(s, low, z));
    }
    return high >= grid->first_x && high <= grid->last_x ? try_column(s, high, z) : TL_OK;
}

// The rim of a square of the grid, row by row.
static tl_result try_square(cover_search *s, const cover_grid *grid, int64_t ring)
{
    const int64_t low = grid->middle_x - ring, high = grid->middle_x + ring;
    const int64_t last_z = tl_min_i64(grid->middle_z + ring - 1, grid->last_z);
    TL_TRY(try_row(s, grid, grid->middle_z - ring, ring));
    if ((low >= grid->first_x && low <= grid->last_x) || (high >= grid->first_x && high <= grid->last_x)) {
        for (int64_t z = tl_max_i64(grid->middle_z - ring + 1, grid->first_z); z <= last_z; z++) {
            TL_TRY(try_row(s, grid, z, ring));
        }
    }
    return ring > 0 ? try_row(s, grid, grid->middle_z + ring, ring) : TL_OK;
}

// How many points a middle lies outside of a range.
static int64_t points_outside(int64_t middle, int64_t first, int64_t last)
{
    return tl_max_i64(0, tl_max_i64(first - middle, middle - last));
}

static tl_result search_squares(cover_search *s, const cover_grid *grid)
{
    const double spacing = (double)s->def->spacing;
    const int64_t first = tl_max_i64(points_outside(grid->middle_x, grid->first_x, grid->last_x),
                                     points_outside(grid->middle_z, grid->first_z, grid->last_z));
    const int64_t wide = tl_max_i64(grid->middle_x - grid->first_x, grid->last_x - grid->middle_x);
    const int64_t deep = tl_max_i64(grid->middle_z - grid->first_z, grid->last_z - grid->middle_z);
    // The agent lies up to half a spacing beside the middle.
    for (int64_t ring = first;
         ring <= tl_max_i64(wide, deep) && ((double)ring - 0.5) * spacing <= (double)longest_useful(s); ring++) {
        TL_TRY(try_square(s, grid, ring));
    }
    return TL_OK;
}

// Of the navmesh, what lies within max_length of the agent along every axis; min > max: nothing.
static tl_aabb box_in_reach(const cover_search *s)
{
    const tl_vec3 agent = s->request->agent.point;
    const float reach = s->def->max_length;
    tl_aabb box = tl_aabb_empty();
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(s->request->navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(s->request->navmesh, slot);
        box = tile != NULL ? tl_aabb_union(box, tile->bounds) : box;
    }
    box.min = tl_max(box.min, tl_sub(agent, tl_vec3_make(reach, reach, reach)));
    box.max = tl_min(box.max, tl_add(agent, tl_vec3_make(reach, reach, reach)));
    return box;
}

// The points of the grid from `low` to `high`, and one more on either side for rounding. False: their numbers are too
// large for a double.
static bool grid_range(float low, float high, float middle, float spacing, int64_t *first_out, int64_t *last_out,
                       int64_t *middle_out)
{
    const double first = floor((double)low / (double)spacing) - 1.0, last = ceil((double)high / (double)spacing) + 1.0;
    const double at = floor((double)middle / (double)spacing + 0.5), most = 0x1p52;
    if (!(fabs(first) < most && fabs(last) < most && fabs(at) < most)) {
        return false;
    }
    *first_out = (int64_t)first;
    *last_out = (int64_t)last;
    *middle_out = (int64_t)at;
    return true;
}

static tl_result search_cover(cover_search *s)
{
    const tl_aabb box = box_in_reach(s);
    const tl_vec3 agent = s->request->agent.point;
    cover_grid grid;
    TL_TRY(try_place(s, &s->request->agent));
    if (!(box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z)) {
        return TL_OK;
    }
    const float bands = ceilf((box.max.y - box.min.y) / s->band);
    if (!(bands < (float)TL_NAV_MAX_COVER_PLACES) ||
        !grid_range(box.min.x, box.max.x, agent.x, s->def->spacing, &grid.first_x, &grid.last_x, &grid.middle_x) ||
        !grid_range(box.min.z, box.max.z, agent.z, s->def->spacing, &grid.first_z, &grid.last_z, &grid.middle_z)) {
        return TL_ERR_LIMIT;
    }
    s->low = box.min.y;
    s->high = box.max.y;
    s->bands = (uint32_t)bands + 1;
    s->budget = TL_NAV_MAX_COVER_PLACES;
    return search_squares(s, &grid);
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
    cover_search s = { query, request, def, covers_out, capacity, 0, tile->agent_height, 0.0f, 0.0f, 0, 0, false };
    const tl_result result = search_cover(&s);
    if (result != TL_OK && result != TL_ERR_LIMIT) {
        return result;
    }
    *count_out = s.count;
    return result == TL_OK && s.gave_up ? TL_ERR_NODES : result;
}
