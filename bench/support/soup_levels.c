// SPDX-License-Identifier: MIT

#define _POSIX_C_SOURCE 200809L

#include "soup_levels.h"

#include "base/random.h"
#include "cli/sample/sample_level.h"
#include "io/mesh/mesh_import.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *copy_of(const void *data, size_t size)
{
    void *copy = malloc(size);
    if (copy == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(1);
    }
    memcpy(copy, data, size);
    return copy;
}

static void keep(const tl_mesh_view *view, bench_level *level)
{
    memset(&level->view, 0, sizeof level->view);
    level->view.vertices = copy_of(view->vertices, view->vertex_count * sizeof *view->vertices);
    level->view.vertex_count = view->vertex_count;
    level->view.indices = copy_of(view->indices, 3 * (size_t)view->triangle_count * sizeof *view->indices);
    level->view.triangle_count = view->triangle_count;
}

bool bench_load_file(const char *path, bench_level *level)
{
    tl_imported_mesh mesh;
    if (tl_import_mesh(path, NULL, &mesh, NULL) != TL_OK) {
        return false;
    }
    tl_mesh_view view = tl_imported_mesh_as_view(&mesh);
    keep(&view, level);
    tl_imported_mesh_free(&mesh);
    const char *slash = strrchr(path, '/');
    snprintf(level->name, sizeof level->name, "%s", slash != NULL ? slash + 1 : path);
    char *dot = strrchr(level->name, '.');
    if (dot != NULL) {
        *dot = '\0';
    }
    return true;
}

bool bench_make_sample(const char *name, uint32_t triangles, bench_level *level)
{
    tl_sample_mesh mesh;
    bool made = tl_sample_build_level(tl_sample_find_level(name), triangles, 1, &mesh) == TL_OK;
    if (made) {
        tl_mesh_view view = tl_sample_mesh_as_view(&mesh);
        keep(&view, level);
        snprintf(level->name, sizeof level->name, "sample %s %uk", name, triangles / 1000);
    }
    tl_sample_mesh_free(&mesh);
    return made;
}

uint32_t bench_load_levels(bench_level levels[BENCH_MAX_LEVELS], const char *only)
{
    static const char *const files[] = { "nav_test",    "dungeon",           "undulating",
                                         "proto-level", "collision_mesh_01", "test_map01" };
    static const struct {
        const char *name;
        uint32_t triangles;
    } samples[] = { { "dungeon", 8000 }, { "dungeon", 50000 }, { "dungeon", 200000 },
                    { "city", 8000 },    { "city", 100000 },   { "city", 1000000 } };
    uint32_t count = 0;
    for (uint32_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/levels/%s.obj", TALUS_DATA_DIR, files[i]);
        count += (only == NULL || strstr(files[i], only) != NULL) && bench_load_file(path, &levels[count]);
    }
    for (uint32_t i = 0; i < sizeof samples / sizeof samples[0]; i++) {
        char name[64];
        snprintf(name, sizeof name, "sample %s %uk", samples[i].name, samples[i].triangles / 1000);
        count += (only == NULL || strstr(name, only) != NULL) &&
                 bench_make_sample(samples[i].name, samples[i].triangles, &levels[count]);
    }
    return count;
}

void bench_free_levels(bench_level *levels, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        free((void *)(uintptr_t)levels[i].view.vertices);
        free((void *)(uintptr_t)levels[i].view.indices);
    }
}

tl_vec3 bench_point_in(uint64_t *random, tl_aabb box)
{
    tl_vec3 size = tl_aabb_size(box);
    float x = tl_random_unit_float(random), y = tl_random_unit_float(random), z = tl_random_unit_float(random);
    return tl_vec3_make(box.min.x + x * size.x, box.min.y + y * size.y, box.min.z + z * size.z);
}

tl_vec3 bench_direction(uint64_t *random)
{
    for (;;) {
        float x = tl_random_unit_float(random), y = tl_random_unit_float(random), z = tl_random_unit_float(random);
        tl_vec3 d = tl_vec3_make(2 * x - 1, 2 * y - 1, 2 * z - 1);
        float l = tl_length_sq(d);
        if (l > 0.01f && l <= 1) {
            return tl_normalize(d);
        }
    }
}
