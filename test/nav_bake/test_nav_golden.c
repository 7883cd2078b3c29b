// SPDX-License-Identifier: MIT
//
// The same bytes: from shuffled triangles, on any number of threads, and, by golden hashes, with any compiler and
// optimisation level. With arguments: prints the hash of each level file, to compare two builds on levels of one's own.

#include "base/hash.h"
#include "cli/sample/sample_level.h"
#include "io/mesh/mesh_import.h"

#include "talus_test.h"

#include <talus/nav_bake.h>

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

typedef struct thread_run {
    tl_task_fn *task;
    void *task_user;
    uint32_t count;
    atomic_uint next;
} thread_run;

typedef struct thread_worker {
    thread_run *run;
    uint32_t index;
} thread_worker;

static void *work(void *user)
{
    thread_worker *worker = user;
    thread_run *run = worker->run;
    for (uint32_t i; (i = atomic_fetch_add(&run->next, 1)) < run->count;) {
        run->task(i, worker->index, run->task_user);
    }
    return NULL;
}

static void run_on_two_threads(tl_task_fn *task, uint32_t count, void *task_user, void *user)
{
    (void)user;
    thread_run run = { task, task_user, count, 0 };
    thread_worker workers[2] = { { &run, 0 }, { &run, 1 } };
    pthread_t other;
    const bool started = pthread_create(&other, NULL, work, &workers[1]) == 0;
    work(&workers[0]);
    if (started) {
        pthread_join(other, NULL);
    }
}

static uint64_t hash_of_build(const tl_nav_def *def, const tl_mesh_view *mesh, uint64_t seed)
{
    const tl_nav_input input = { *mesh, NULL, NULL, 0 };
    tl_nav_tiles tiles;
    TEST_RESULT(tl_nav_bake(def, &input, &tiles, NULL), TL_OK);
    uint64_t hash = seed;
    for (uint32_t t = 0; t < tiles.tile_count; t++) {
        hash = tl_hash_bytes(tiles.tiles[t], ((const tl_blob *)tiles.tiles[t])->size, hash);
    }
    TEST_CHECK(tiles.tile_count > 0);
    tl_nav_tiles_free(&tiles);
    return hash;
}

// Of the three partitions, in one piece and in tiles, at two cell sizes.
static uint64_t hash_of_level(const tl_mesh_view *mesh, const tl_tasks *tasks)
{
    static const float cells[] = { 0.3f, 0.2f };
    uint64_t hash = 0;
    for (uint32_t k = 0; k < 12; k++) {
        tl_nav_def def = tl_default_nav_def();
        def.partition = (tl_nav_partition)(k % 3);
        def.tile_size = k % 2 == 0 ? 0 : 48;
        def.cell_size = cells[k / 6];
        def.host.tasks = tasks;
        hash = hash_of_build(&def, mesh, hash);
    }
    return hash;
}

static void shuffle_triangles(tl_sample_mesh *mesh, uint32_t triangle_count)
{
    test_random random = { 1 };
    for (uint32_t i = triangle_count; i > 1; i--) {
        uint32_t k = test_random_below(&random, i), triangle[3];
        uint32_t *a = mesh->indices + 3 * (size_t)(i - 1), *b = mesh->indices + 3 * (size_t)k;
        memcpy(triangle, a, sizeof triangle);
        memmove(a, b, sizeof triangle);
        memcpy(b, triangle, sizeof triangle);
    }
}

static void built_in_levels(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        uint64_t hash, layered_hash;
    } golden[] = { { "courtyard", 0xef1013d3c2bf10ca, 0xe9c8f0c62cac1fac },
                   { "dungeon", 0x4451e9ae365bd656, 0x582950d4b33a3428 },
                   { "terrain", 0x691d00de9b50ad86, 0xd57f47c8842e315f },
                   { "city", 0x75cc17f3d75493b8, 0x0caee0d7ca3e095c } };
    const tl_tasks two = { run_on_two_threads, 2, NULL };
    bool equal = true;
    for (size_t i = 0; i < 4; i++) {
        tl_sample_mesh mesh;
        TEST_RESULT(tl_sample_build_level(tl_sample_find_level(golden[i].name), 3000, 1, &mesh), TL_OK);
        tl_mesh_view view = tl_sample_mesh_as_view(&mesh);
        uint64_t hash = hash_of_level(&view, NULL);
        if (hash != golden[i].hash) {
            print_error("%s: 0x%016llx\n", golden[i].name, (unsigned long long)hash);
        }
        equal = equal && hash == golden[i].hash;
        TEST_CHECK(hash == hash_of_level(&view, &two));
        tl_nav_def layered = tl_default_nav_def();
        layered.tile_size = 48;
        layered.tile_height = 2.0f;
        const uint64_t layered_hash = hash_of_build(&layered, &view, 0);
        if (layered_hash != golden[i].layered_hash) {
            print_error("%s in layers: 0x%016llx\n", golden[i].name, (unsigned long long)layered_hash);
        }
        equal = equal && layered_hash == golden[i].layered_hash;
        layered.host.tasks = &two;
        TEST_CHECK(layered_hash == hash_of_build(&layered, &view, 0));
        shuffle_triangles(&mesh, view.triangle_count);
        TEST_CHECK(hash == hash_of_level(&view, NULL));
        tl_sample_mesh_free(&mesh);
    }
    TEST_CHECK(equal);
}

static int print_hashes(int count, char **paths)
{
    for (int i = 0; i < count; i++) {
        tl_imported_mesh mesh;
        if (tl_import_mesh(paths[i], NULL, &mesh, NULL) != TL_OK) {
            fprintf(stderr, "%s: not read\n", paths[i]);
            return 1;
        }
        tl_mesh_view view = tl_imported_mesh_as_view(&mesh);
        printf("%016llx %s\n", (unsigned long long)hash_of_level(&view, NULL), paths[i]);
        tl_imported_mesh_free(&mesh);
    }
    return 0;
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        return print_hashes(argc - 1, argv + 1);
    }
    const struct CMUnitTest tests[] = { cmocka_unit_test(built_in_levels) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
