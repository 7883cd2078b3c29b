// SPDX-License-Identifier: MIT
//
// The table of levels, and how a level comes to the number of triangles that was asked for: count levels of growing
// extent until the next one would be too large, then spend what is left on rocks, large ones first.

#include "cli/sample/sample_level.h"

#include <string.h>

static const tl_sample_level levels[] = {
    { "courtyard", "walled wards with wall-walks, gates, a bridge over the court, pits, colonnades and garden fences",
      6000, 500, tl_sample_build_courtyard, tl_sample_courtyard_prop_place },
    { "dungeon", "rooms and corridors on several heights: stairs, ramps, pits with bridges, galleries, thin partitions",
      8000, 500, tl_sample_build_dungeon, tl_sample_dungeon_prop_place },
    { "terrain", "hills and plateaus with covered gorges and overhanging arches", 20000, 500, tl_sample_build_terrain,
      tl_sample_terrain_prop_place },
    { "city", "streets with kerbs, houses with windows, doors, rooms and stairs, flat and gable roofs, footbridges",
      30000, 500, tl_sample_build_city, tl_sample_city_prop_place },
};

enum { MAX_ROCK_LEVEL = 4 };

const tl_sample_level *tl_sample_levels(uint32_t *count_out)
{
    *count_out = (uint32_t)(sizeof(levels) / sizeof(levels[0]));
    return levels;
}

const tl_sample_level *tl_sample_find_level(const char *name)
{
    for (size_t i = 0; i < sizeof(levels) / sizeof(levels[0]); ++i) {
        if (strcmp(levels[i].name, name) == 0) {
            return &levels[i];
        }
    }
    return NULL;
}

static uint32_t floor_sqrt(uint32_t n)
{
    uint32_t root = 0;
    for (uint32_t bit = 1u << 15; bit != 0; bit >>= 1) {
        uint64_t trial = root | bit;
        if (trial * trial <= n) {
            root |= bit;
        }
    }
    return root;
}

// As square as it gets: columns * rows is at most `cells` and close to it.
static tl_sample_plan plan_of(uint32_t cells, uint32_t detail, uint64_t seed)
{
    tl_sample_plan plan;
    plan.columns = floor_sqrt(cells);
    plan.rows = cells / plan.columns;
    plan.detail = detail;
    plan.seed = seed;
    return plan;
}

static uint32_t count_level_triangles(const tl_sample_level *level, uint32_t cells, uint32_t detail, uint64_t seed)
{
    tl_sample_mesh counter = { 0 };
    counter.counting = true;
    tl_sample_plan plan = plan_of(cells, detail, seed);
    level->build(&plan, &counter);
    return counter.result == TL_OK ? counter.triangle_count : UINT32_MAX;
}

// The count grows nearly in proportion to the cells, so a few proportional steps come close. `low` cells fit and `high`
// cells do not; a step never leaves the two, and ends when no rectangle of cells lies between.
static tl_sample_plan choose_plan(const tl_sample_level *level, uint32_t triangle_count, uint64_t seed)
{
    enum { PROBES = 20 };
    uint32_t detail = count_level_triangles(level, 1, 1, seed) <= triangle_count ? 1 : 0;
    uint64_t low = 1;
    uint64_t high = (uint64_t)triangle_count + 2; // a cell has at least one triangle
    uint64_t guess = 4;
    for (uint32_t probe = 0; probe < PROBES && guess > low && guess < high; ++probe) {
        uint32_t count = count_level_triangles(level, (uint32_t)guess, detail, seed);
        tl_sample_plan plan = plan_of((uint32_t)guess, detail, seed);
        if (count > triangle_count) {
            high = (uint64_t)plan.columns * plan.rows;
        } else {
            low = guess;
            if (count >= triangle_count - triangle_count / 64) {
                break;
            }
        }
        uint64_t next = guess * triangle_count / (count > 0 ? count : 1);
        next = next > low ? next : low + 1 + low / 64;
        guess = next < high ? next : high - 1;
    }
    return plan_of((uint32_t)low, detail, seed);
}

// A rock level is used while at least four of it fit, so that what is left is strewn in all sizes and not in one.
static void strew_rocks(const tl_sample_level *level, const tl_sample_plan *plan, uint32_t triangle_count,
                        tl_sample_mesh *mesh)
{
    uint64_t serial = 0;
    while (mesh->result == TL_OK && mesh->triangle_count + 8 <= triangle_count) {
        uint32_t rest = triangle_count - mesh->triangle_count;
        uint32_t rock_level = MAX_ROCK_LEVEL;
        while (rock_level > 0 && (32u << (2 * rock_level)) > rest) {
            rock_level--;
        }
        tl_sample_random random = tl_sample_random_make(plan->seed ^ 0x726f636bu, serial++, rock_level);
        float radius = tl_sample_random_range(&random, 0.2f, 0.3f) + 0.12f * (float)rock_level;
        tl_vec3 place = level->prop_place(plan, radius, &random);
        place.y += 0.4f * radius;
        tl_sample_place(mesh, tl_vec3_make(0, 0, 0), 0);
        tl_sample_rock(mesh, place, radius, rock_level, tl_sample_random_u64(&random));
    }
}

tl_result tl_sample_build_level(const tl_sample_level *level, uint32_t triangle_count, uint64_t seed,
                                tl_sample_mesh *mesh_out)
{
    tl_sample_mesh empty = { 0 };
    *mesh_out = empty;
    if (triangle_count > TL_MAX_MESH_TRIANGLES / 4) {
        return TL_ERR_LIMIT;
    }
    tl_sample_plan plan = choose_plan(level, triangle_count, seed);
    level->build(&plan, mesh_out);
    strew_rocks(level, &plan, triangle_count, mesh_out);
    return mesh_out->result;
}
