// SPDX-License-Identifier: MIT
//
// Filing points under faces: with every kernel that this machine has, hulls are those of plain C, and so are the points
// that a limit or a tolerance leaves outside, the faces that they are filed under, and the bits of their heights.

#include "talus_test.h"

#include "base/hash.h"
#include "hull/bake/file_points.h"
#include "hull_shapes.h"

#include <stdlib.h>

enum { N = 3000, LEVELS = 4 };

// The hull's polygons, and what is left outside, as one hash.
static uint64_t hull_of(const tl_vec3 *points, uint32_t count, const tl_hull_def *def, tl_file_points_fn *kernel)
{
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    tl_quickhull hull;
    tl_stage stage = { .name = "hull", .total = count };
    tl_quickhull_init(&hull, points, count, &arena, &stage);
    hull.file_points = kernel;
    tl_hull_polygons polygons;
    uint32_t copies;
    TEST_RESULT(tl_quickhull_build(&hull, def, NULL, &copies, &polygons), TL_OK);
    uint64_t hash = tl_hash_bytes(polygons.points, polygons.vertex_count * sizeof *polygons.points, hull.waiting);
    hash = tl_hash_bytes(polygons.half_edges, polygons.half_edge_count * sizeof *polygons.half_edges, hash);
    for (uint32_t face = 0; face < hull.face_count; face++) {
        const tl_quickhull_conflicts *conflicts = &hull.conflicts[face];
        if (conflicts->live && conflicts->first != TL_NONE) {
            hash = tl_hash_bytes(&conflicts->first, sizeof conflicts->first, hash);
            hash = tl_hash_bytes(&conflicts->farthest_value, sizeof conflicts->farthest_value, hash);
        }
    }
    tl_arena_free(&arena);
    return hash;
}

static void kernels_make_the_hulls_of_plain_c(void **state)
{
    (void)state;
    tl_vec3 *points = malloc(N * sizeof *points);
    uint32_t kernels = 0;
    for (int level = 1; level < LEVELS; level++) {
        kernels += tl_file_points_for(level) != NULL;
    }
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        for (int variant = 0; variant < 6; variant++) {
            test_random random = { (uint64_t)(10 * kind + variant) };
            const uint32_t count = shape_make((shape_kind)kind, &random, points, variant % 2 == 0 ? N : 700);
            const float shift = variant >= 3 ? 1000.0f : 0.0f; // heights that do not tell
            for (uint32_t i = 0; i < count; i++) {
                points[i] = tl_add(points[i], tl_vec3_make(shift, -shift, 0.5f * shift));
            }
            tl_hull_def def = tl_default_hull_def();
            def.max_vertices = variant % 3 == 1 ? 100 : 0;
            def.tolerance = variant % 3 == 2 ? 1e-3f : 0.0f;
            const uint64_t plain = hull_of(points, count, &def, NULL);
            for (int level = 1; level < LEVELS; level++) {
                tl_file_points_fn *kernel = tl_file_points_for(level);
                TEST_CHECK(kernel == NULL || hull_of(points, count, &def, kernel) == plain);
            }
        }
    }
    TEST_CHECK(kernels > 0 || TL_CPU_LEVELS == 0 || !tl_cpu_has_level(1));
    print_message("%u kernels beside plain C\n", kernels);
    free(points);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(kernels_make_the_hulls_of_plain_c) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
