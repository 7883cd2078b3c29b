// SPDX-License-Identifier: MIT
//
// Characters that follow paths of a baked navmesh physically: what a step costs, whether they arrive, and whether they
// are ever in the level. Times are of this thread alone, over whole walks; the judge, which is other code, runs outside
// of them.
//
//   bench_character [--paths N (1000)] [--cell METRES (0.15)] [--json FILE] [LEVEL...]
//
// LEVEL is a file of a mesh. Without one: generated levels, and those of the data folder.

#include "base/random.h"
#include "bench_options.h"
#include "measure.h"
#include "path_walker.h"
#include "report.h"
#include "soup_levels.h"

#include <stdio.h>
#include <stdlib.h>
#include <talus/nav_around.h>
#include <talus/nav_bake.h>

// Of a level of many islands few pairs of places have a path.
enum { MAX_TICKS = 60 * 300, MAX_TRIES = 20000 };

static const float TOO_DEEP = 0.001f; // metres

typedef struct walk_sums {
    uint32_t walks, arrived, gave_up, fell, slow;
    uint64_t steps, sweeps, asked, deep, crossed;
    double seconds, worst_walk; // the most that a step took in the mean of one walk
} walk_sums;

typedef struct walk_place {
    tl_vec3 from, to;
} walk_place;

// Where the ticks of a walk were: the judge looks at them when the clock has stopped.
static walk_place track[MAX_TICKS];

static void judge_track(const path_walker *w, uint32_t count, walk_sums *sums)
{
    tl_character_def def = tl_default_character_def();
    tl_convex thin = tl_convex_capsule(tl_vec3_make(0, def.radius, 0), tl_vec3_make(0, def.height - def.radius, 0),
                                       def.radius - TOO_DEEP);
    for (uint32_t i = 0; i < count; i++) {
        tl_transform pose = { { 0, 0, 0, 1 }, track[i].to };
        tl_vec3 from = track[i].from, to = track[i].to;
        bool overlaps = false;
        (void)tl_soup_overlaps(w->level.soup, &thin, pose, NULL, &overlaps);
        from.y += 0.5f * def.height;
        to.y += 0.5f * def.height;
        sums->deep += overlaps;
        sums->crossed += i > 0 && !tl_soup_line_of_sight(w->level.soup, from, to, NULL);
    }
}

static void walk_path(path_walker *w, walk_sums *sums)
{
    uint32_t ticks = 0;
    walker_state state = WALKER_WALKS;
    uint64_t sweeps = 0;
    double begin = bench_thread_seconds();
    while (state == WALKER_WALKS && ticks < MAX_TICKS) {
        track[ticks].from = w->character.position;
        state = walker_tick(w);
        track[ticks++].to = w->character.position;
        sweeps += w->report.sweeps;
    }
    double seconds = bench_thread_seconds() - begin;
    sums->seconds += seconds;
    sums->worst_walk = seconds / ticks > sums->worst_walk ? seconds / ticks : sums->worst_walk;
    sums->walks++;
    sums->steps += ticks;
    sums->sweeps += sweeps;
    sums->asked += w->routes - 1;
    sums->arrived += state == WALKER_ARRIVED;
    sums->gave_up += state == WALKER_GAVE_UP;
    sums->fell += state == WALKER_FELL;
    sums->slow += state == WALKER_WALKS;
    judge_track(w, ticks, sums);
    if (state != WALKER_ARRIVED && getenv("TALUS_BENCH_LOST") != NULL) {
        printf("  %s at %g,%g,%g, goal %g,%g,%g\n", state == WALKER_FELL ? "fell" : "stays",
               (double)w->character.position.x, (double)w->character.position.y, (double)w->character.position.z,
               (double)w->goal.x, (double)w->goal.y, (double)w->goal.z);
    }
}

static bool next_pair(path_walker *w, uint64_t *random)
{
    for (int tries = 0; tries < MAX_TRIES; tries++) {
        const uint64_t numbers[4] = { tl_random_bits(random), tl_random_bits(random), tl_random_bits(random),
                                      tl_random_bits(random) };
        tl_nav_location start, goal;
        if (tl_navmesh_random_point(w->navmesh, NULL, numbers, &start) != TL_OK ||
            tl_navmesh_random_point(w->navmesh, NULL, numbers + 2, &goal) != TL_OK) {
            return false;
        }
        memset(&w->character, 0, sizeof w->character);
        w->character.position = start.point;
        w->character.position.y += 0.05f;
        w->goal = goal.point;
        w->routes = 0;
        if (walker_ask(w) && w->corner_count > 0) {
            return true;
        }
    }
    return false;
}

static bool bake_level(const bench_level *level, float cell, tl_navmesh *navmesh, tl_nav_tiles *tiles)
{
    tl_nav_input input = { level->view, NULL, NULL, 0 };
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = cell;
    def.cell_height = 0.1f;
    def.agent_radius = 4.0f * cell; // erosion leaves (2 * 4 - 1) / sqrt 5 cells of it, less the contour's error
    def.agent_max_climb = 0.4f;
    def.tile_size = 256;
    return tl_nav_bake(&def, &input, tiles, NULL) == TL_OK && tiles->tile_count > 0 &&
           tl_navmesh_add_tiles(navmesh, tiles->tiles, tiles->tile_count, TL_NAV_TILE_BORROWED, NULL) == TL_OK;
}

static void print_sums(const char *name, const walk_sums *s, bench_report *report)
{
    double step = 1e6 * s->seconds / (double)s->steps;
    printf("%-26.26s %6u %7.2f %5u %5u %5u %8.2f %9llu %7.3f %7.3f %6llu %6llu\n", name, s->walks,
           100.0 * s->arrived / s->walks, s->gave_up, s->fell, s->slow, (double)s->asked / s->walks,
           (unsigned long long)s->steps, step, 1e6 * s->worst_walk, (unsigned long long)s->deep,
           (unsigned long long)s->crossed);
    fflush(stdout);
    bench_report_value(report, "a step", "talus", name, step);
}

static void walk_level(const bench_level *level, uint32_t paths, float cell, bench_report *report, walk_sums *all)
{
    static path_walker w;
    memset(&w, 0, sizeof w);
    tl_nav_tiles tiles = { 0 };
    tl_navmesh *navmesh = NULL;
    tl_soup *soup = NULL;
    tl_character_def def = tl_default_character_def();
    def.max_triangles = 16384;
    bool ready = tl_navmesh_create(NULL, &navmesh) == TL_OK && bake_level(level, cell, navmesh, &tiles) &&
                 tl_soup_bake(&level->view, NULL, &soup, NULL) == TL_OK &&
                 tl_nav_query_create(NULL, &w.query, NULL) == TL_OK &&
                 tl_character_mover_create(&def, &w.mover, NULL) == TL_OK;
    if (ready) {
        walk_sums sums;
        memset(&sums, 0, sizeof sums);
        uint64_t random = 1;
        w.navmesh = navmesh;
        w.level.soup = soup;
        w.speed = 4.0f;
        w.floor = tl_soup_bounds(soup).min.y - 2.0f;
        for (uint32_t i = 0; i < paths && next_pair(&w, &random); i++) {
            walk_path(&w, &sums);
        }
        if (sums.walks > 0) {
            print_sums(level->name, &sums, report);
            all->walks += sums.walks;
            all->arrived += sums.arrived;
            all->fell += sums.fell;
            all->deep += sums.deep + sums.crossed;
            all->steps += sums.steps;
            all->seconds += sums.seconds;
        }
    } else {
        printf("%-26.26s has no navmesh\n", level->name);
    }
    tl_character_mover_destroy(w.mover);
    tl_nav_query_destroy(w.query);
    tl_blob_free(soup);
    tl_navmesh_destroy(navmesh);
    tl_nav_tiles_free(&tiles);
}

int main(int argc, char **argv)
{
    uint32_t paths = 1000;
    float cell = 0.15f;
    const bench_option options[] = { { "paths", BENCH_COUNT, &paths, "paths a level" },
                                     { "cell", BENCH_NUMBER, &cell, "metres, of the navmesh's voxels" },
                                     { 0 } };
    const char **words = calloc((size_t)argc, sizeof *words), *json;
    int word_count = bench_parse(argc, argv, options, words, &json);
    bench_report *report = bench_report_new("character", "us", NULL);
    bench_level levels[BENCH_MAX_LEVELS];
    walk_sums all;
    memset(&all, 0, sizeof all);
    printf("%-26s %6s %7s %5s %5s %5s %8s %9s %7s %7s %6s %6s\n", "level", "paths", "arrive%", "stay", "fall", "slow",
           "asked", "steps", "us/step", "worst", "> 1 mm", "pierce");
    uint32_t count = word_count > 0 ? 0 : bench_load_levels(levels, NULL);
    for (uint32_t i = 0; i < count; i++) {
        if (levels[i].view.triangle_count <= 200000) {
            walk_level(&levels[i], paths, cell, report, &all);
        }
    }
    bench_free_levels(levels, count);
    for (int i = 0; i < word_count; i++) {
        bench_level level;
        if (bench_load_file(words[i], &level)) {
            walk_level(&level, paths, cell, report, &all);
            bench_free_levels(&level, 1);
        }
    }
    if (all.steps > 0) {
        (void)bench_report_at_most(report, "us a step, path queries included", 1e6 * all.seconds / (double)all.steps,
                                   2.0);
        (void)bench_report_at_least(report, "share of the walks that arrive", (double)all.arrived / all.walks, 1.0);
        (void)bench_report_at_most(report, "walks that fall out of the level", all.fell, 0.0);
        (void)bench_report_at_most(report, "steps deeper than 1 mm, or through a sheet", (double)all.deep, 0.0);
    }
    bench_report_print_claims(report);
    free((void *)words);
    return bench_report_close(report, json);
}
