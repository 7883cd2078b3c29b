// SPDX-License-Identifier: MIT
//
// An agent walks over a world's file while tiles come and go around it under a budget: what a frame takes for that, and
// whether every path is that of the world in memory whole. Loads run on a thread of their own; a frame is an update,
// loads handed back and others begun. Exits with 1 when an answer is wrong.
//
//   bench_world_walk FILE.talus [--metres N (20000)] [--budget MIB (64)] [--radius METRES (1500)] [--reach METRES
//   (1000)]
//                    [--read-ms N (0): what each read takes longer] [--seed N (1)] [--json]

#define _POSIX_C_SOURCE 200809L

#include "measure.h"
#include "world/job/route_file.h"
#include "world_walk.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef struct walk_options {
    const char *file;
    double metres, budget, radius, reach, read_ms, seed;
    bool json;
} walk_options;

typedef struct walk_disk {
    tl_world_reader reader;
    struct timespec pause;
    pthread_t frames_thread;
    uint64_t by_frames; // reads that a frame did itself
} walk_disk;

// What frames took.
typedef struct frame_times {
    double *wall; // seconds, of frames that kept their frame of reference
    size_t count, capacity;
    double worst_processor, worst_move; // of these by this thread's clock; of those that moved it
    uint32_t over_1ms, moves;
} frame_times;

static void must(bool holds, const char *what)
{
    if (!holds) {
        fprintf(stderr, "bench_world_walk: %s\n", what);
        exit(2);
    }
}

static tl_result read_disk(uint64_t offset, void *bytes, size_t size, void *user)
{
    walk_disk *disk = user;
    if (pthread_equal(pthread_self(), disk->frames_thread)) {
        disk->by_frames++;
    } else if (disk->pause.tv_nsec > 0) {
        nanosleep(&disk->pause, NULL);
    }
    return tl_world_reader_read(offset, bytes, size, &disk->reader);
}

// All tiles, in one frame of reference with its origin at the middle.
static void load_whole(tl_nav_world *world, const double middle[3])
{
    const tl_nav_world_interest all = { { middle[0], middle[1], middle[2] }, 1e9 };
    tl_nav_world_load load;
    for (;;) {
        must(!tl_is_error(tl_nav_world_update(world, &all, 1, 1024)), "update");
        int begun = 0;
        while (begun < 1024 && tl_nav_world_begin_load(world, &load) == TL_OK) {
            must(tl_nav_world_run_load(&load) == TL_OK && tl_nav_world_end_load(&load) == TL_OK, "load");
            begun++;
        }
        if (begun == 0 && tl_nav_world_update(world, &all, 1, 1024) == TL_NOT_FOUND) {
            return;
        }
    }
}

static void note_frame(frame_times *times, double wall, double processor, bool moved)
{
    if (moved) {
        times->moves++;
        times->worst_move = wall > times->worst_move ? wall : times->worst_move;
        return;
    }
    if (times->count == times->capacity) {
        times->capacity = times->capacity > 0 ? 2 * times->capacity : 65536;
        times->wall = realloc(times->wall, times->capacity * sizeof *times->wall);
        must(times->wall != NULL, "out of memory");
    }
    times->wall[times->count++] = wall;
    times->over_1ms += wall > 1e-3;
    times->worst_processor = processor > times->worst_processor ? processor : times->worst_processor;
}

// 60 frames a second at 6 m/s, as fast as they go.
static void walk_frames(world_walk *walk, const walk_options *options, walk_loader *loader, frame_times *times)
{
    uint32_t failed = 0, frames_before = 0;
    tl_nav_world_state state;
    for (uint64_t frame = 0; walk->walked < options->metres; frame++) {
        const tl_nav_world_interest interest = { { walk->at[0], walk->at[1], walk->at[2] }, options->radius };
        const double wall = bench_wall_seconds(), processor = bench_thread_seconds();
        must(!tl_is_error(tl_nav_world_update(walk->part, &interest, 1, 1)), "update");
        must(walk_exchange_loads(loader, walk->part, &failed) == TL_OK && failed == 0, "a load failed");
        const double took = bench_wall_seconds() - wall, used = bench_thread_seconds() - processor;
        must(tl_nav_world_get_state(walk->part, &state) == TL_OK, "state");
        note_frame(times, took, used, state.frames != frames_before);
        frames_before = state.frames;
        const bool walks = walk_on(walk, 0.1);
        if (frame % (walks ? 60 : 20) == 0) {
            walk_choose(walk);
        }
    }
}

static bool read_options(int argc, char **argv, walk_options *options)
{
    const walk_options defaults = { NULL, 20000.0, 64.0, 1500.0, 1000.0, 0.0, 1.0, false };
    *options = defaults;
    const struct {
        const char *name;
        double *value;
    } numbers[] = { { "--metres", &options->metres },   { "--budget", &options->budget },
                    { "--radius", &options->radius },   { "--reach", &options->reach },
                    { "--read-ms", &options->read_ms }, { "--seed", &options->seed } };
    for (int i = 1; i < argc; i++) {
        bool known = strcmp(argv[i], "--json") == 0;
        options->json = options->json || known;
        for (size_t k = 0; k < sizeof numbers / sizeof numbers[0] && i + 1 < argc && !known; k++) {
            if (strcmp(argv[i], numbers[k].name) == 0) {
                char *end;
                *numbers[k].value = strtod(argv[++i], &end);
                known = *end == '\0' && *numbers[k].value >= 0.0;
                break;
            }
        }
        if (!known && (argv[i][0] == '-' || options->file != NULL)) {
            return false;
        }
        options->file = known ? options->file : argv[i];
    }
    return options->file != NULL && options->read_ms < 1000.0;
}

static void find_limits(const tl_nav_world *world, world_walk *walk)
{
    tl_aabb box = tl_aabb_empty();
    const tl_navmesh *navmesh = tl_nav_world_navmesh(world);
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        box = tile != NULL ? tl_aabb_union(box, tile->bounds) : box;
    }
    double low[3], high[3];
    tl_nav_world_place_out(world, box.min, low);
    tl_nav_world_place_out(world, box.max, high);
    for (int i = 0; i < 2; i++) {
        walk->low[i] = low[2 * i] < high[2 * i] ? low[2 * i] : high[2 * i];
        walk->high[i] = low[2 * i] < high[2 * i] ? high[2 * i] : low[2 * i];
        walk->at[2 * i] = 0.5 * (low[2 * i] + high[2 * i]);
    }
    walk->at[1] = 0.5 * (low[1] + high[1]);
}

static void print_walk(const walk_options *options, const world_walk *walk, const walk_disk *disk, frame_times *times)
{
    tl_nav_world_state part, whole;
    must(tl_nav_world_get_state(walk->part, &part) == TL_OK && tl_nav_world_get_state(walk->whole, &whole) == TL_OK,
         "state");
    const double median = bench_quantile(times->wall, times->count, 0.5);
    const double rare = bench_quantile(times->wall, times->count, 0.9999), worst = times->wall[times->count - 1];
    printf(options->json
               ? "{\"metres\": %.0f, \"frames\": %zu, \"frame_us_median\": %.2f, \"frame_us_9999\": %.1f, "
                 "\"frame_us_worst\": %.1f, \"frame_us_worst_processor\": %.1f, \"frames_over_1ms\": %u, "
                 "\"reads_by_frames\": %llu, \"frame_moves\": %u, \"worst_move_ms\": %.1f, \"paths\": %u, "
                 "\"proven\": %u, \"unreachable\": %u, \"nowhere\": %u, \"open\": %u, \"wrong\": %u, \"jumps\": %u, "
                 "\"peak_bytes\": %llu, \"whole_bytes\": %llu, \"read_bytes\": %llu}\n"
               : "walked %.0f m in %zu frames; the world takes of each %.2f us (median), %.1f us (99.99%%), %.1f us "
                 "(worst; %.1f us of processor), %u over 1 ms, reads by frames: %llu\n"
                 "moved its origin %u times, at worst %.1f ms\n"
                 "paths %u: %u proven, %u unreachable, %u nowhere, %u said to be open, %u wrong; %u jumps\n"
                 "budget used %llu bytes, all would take %llu; read %llu bytes\n",
           walk->walked, times->count, median * 1e6, rare * 1e6, worst * 1e6, times->worst_processor * 1e6,
           (unsigned)times->over_1ms, (unsigned long long)disk->by_frames, (unsigned)times->moves,
           times->worst_move * 1e3, (unsigned)walk->paths, (unsigned)walk->proven, (unsigned)walk->unreachable,
           (unsigned)walk->nowhere, (unsigned)walk->open, (unsigned)walk->wrong, (unsigned)walk->jumps,
           (unsigned long long)part.peak_bytes, (unsigned long long)whole.bytes, (unsigned long long)part.read_bytes);
}

int main(int argc, char **argv)
{
    static world_walk walk;
    walk_options options;
    walk_disk disk;
    walk_loader loader;
    frame_times times;
    tl_io_error error;
    memset(&disk, 0, sizeof disk);
    memset(&times, 0, sizeof times);
    must(read_options(argc, argv, &options),
         "FILE.talus [--metres N] [--budget MIB] [--radius METRES] [--reach METRES] [--read-ms N] [--seed N] [--json]");
    must(tl_world_reader_open(options.file, &disk.reader, &error) == TL_OK, "cannot open the file");
    disk.frames_thread = pthread_self();
    disk.pause.tv_nsec = (long)(options.read_ms * 1e6);
    walk.part = walk_open(read_disk, &disk, (uint64_t)(options.budget * 1048576.0), 4096.0);
    walk.whole = walk_open(read_disk, &disk, (uint64_t)1 << 40, 1e9);
    must(walk.part != NULL && walk.whole != NULL, "the file is no world");
    must(tl_nav_query_create(NULL, &walk.query, NULL) == TL_OK, "out of memory");
    load_whole(walk.whole, walk.at);
    find_limits(walk.whole, &walk);
    walk.reach = options.reach;
    walk.extents = tl_vec3_make(4.0f, 500.0f, 4.0f);
    walk.random = (uint64_t)options.seed;
    disk.by_frames = 0;
    must(walk_loader_begin(&loader), "no thread");
    walk_frames(&walk, &options, &loader, &times);
    walk_loader_end(&loader);
    print_walk(&options, &walk, &disk, &times);
    tl_nav_query_destroy(walk.query);
    tl_nav_world_destroy(walk.part);
    tl_nav_world_destroy(walk.whole);
    tl_world_reader_close(&disk.reader);
    free(times.wall);
    return walk.wrong > 0 ? 1 : 0;
}
