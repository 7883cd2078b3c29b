// SPDX-License-Identifier: MIT
//
// Samples kept along edges: within the error, at exact places, shared by both polygons.

#include "nav_contour_checks.h"

#include "nav_bake/detail/detail.h"

static uint32_t reverse_of(const tl_polygon_mesh *m, uint32_t other, uint32_t from, uint32_t to)
{
    uint32_t count = m->first[other + 1] - m->first[other];
    for (uint32_t k = 0; k < count; k++) {
        if (m->indices[m->first[other] + k] == to && m->indices[m->first[other] + (k + 1) % count] == from) {
            return m->first[other] + k;
        }
    }
    return UINT32_MAX;
}

static void within_error(void **state)
{
    (void)state;
    test_random random = { 900 };
    uint32_t kept = 0, dropped = 0, shared = 0;
    for (int round = 0; round < 40; round++) {
        tl_nav_compact compact =
            fixture_random(&random, 50, 50, 1 + round % 3, test_random_below(&random, 3), round % 3 == 2 ? 3 : 0);
        tl_nav_config config = region_config((tl_nav_partition)(round % 3), 10, 200);
        config.max_simplification_error = 1.3f;
        tl_nav_contours contours;
        make_contours(&compact, &config, &contours);
        tl_polygon_def def = tl_default_polygon_def();
        tl_polygon_mesh polygons;
        TEST_RESULT(tl_polygon_mesh_bake(&contours.set, &def, &polygons, NULL), TL_OK);
        tl_arena arena;
        tl_arena_init(&arena, NULL);
        tl_detail_work work;
        memset(&work, 0, sizeof work);
        work.config = &config;
        work.compact = &compact;
        work.polygons = &polygons;
        work.arena = &arena;
        work.spacing = (double)test_random_range(&random, 1.0f, 6.0f);
        work.max_error = (double)test_random_range(&random, 0.0f, 2.0f);
        TEST_RESULT(tl_detail_sample_edges(&work), TL_OK);
        for (uint32_t p = 0; p < polygons.polygon_count; p++) {
            tl_detail_floors floors = tl_detail_polygon_floors(&work, p);
            uint32_t count = polygons.first[p + 1] - polygons.first[p];
            for (uint32_t c = 0; c < count; c++) {
                uint32_t k = polygons.first[p] + c, from = polygons.indices[k];
                uint32_t to = polygons.indices[polygons.first[p] + (c + 1) % count], other = polygons.neighbours[k];
                const tl_detail_edge *edge = &work.edges.edges[k];
                uint32_t reverse = other < p ? reverse_of(&polygons, other, from, to) : UINT32_MAX;
                if (reverse != UINT32_MAX) {
                    TEST_CHECK(memcmp(edge, &work.edges.edges[reverse], sizeof *edge) == 0);
                    shared++;
                    continue;
                }
                const int32_t *a = polygons.vertices + 3 * from, *b = polygons.vertices + 3 * to;
                bool forward = a[0] < b[0] || (a[0] == b[0] && a[2] < b[2]);
                const int32_t *low = forward ? a : b, *high = forward ? b : a;
                int32_t steps = 1 << edge->bits, last_step = 0, last_y = low[1];
                double length = hypot(high[0] - low[0], high[2] - low[2]);
                TEST_CHECK(length / steps <= work.spacing && (steps == 1 || 2 * length / steps > work.spacing));
                for (uint32_t s = 0; s <= edge->count; s++) {
                    const tl_detail_edge_sample *sample = s < edge->count ? &work.edges.samples[edge->first + s] : NULL;
                    int32_t step = sample != NULL ? sample->step : steps;
                    int32_t y = sample != NULL ? sample->y : high[1];
                    TEST_CHECK(step > last_step && step <= steps);
                    for (int32_t m = last_step + 1; m <= step && m < steps; m++) {
                        double x = low[0] + (double)(high[0] - low[0]) * m / steps;
                        double z = low[2] + (double)(high[2] - low[2]) * m / steps;
                        int32_t fallback = (int32_t)(low[1] + (int64_t)(high[1] - low[1]) * m / steps);
                        int32_t floor_y = tl_detail_floor_at(&floors, (int64_t)floor(x) + compact.border_size,
                                                             (int64_t)floor(z) + compact.border_size, false, fallback);
                        double line = last_y + (double)(y - last_y) * (m - last_step) / (step - last_step);
                        TEST_CHECK(fabs(line - floor_y) <= work.max_error + 1e-9);
                        TEST_CHECK(m < step || y == floor_y);
                        dropped += m < step;
                        kept += m == step;
                    }
                    last_step = step;
                    last_y = y;
                }
            }
        }
        tl_arena_free(&arena);
        tl_polygon_mesh_free(&polygons);
        tl_nav_contours_free(&contours);
        fixture_compact_free(&compact);
    }
    TEST_CHECK(kept > 500 && dropped > 2000 && shared > 500);
}

// An edge longer than 512 steps is marked.
static void long_edges_are_coarse(void **state)
{
    (void)state;
    fixture_map map = fixture_map_make(1300, 3);
    for (uint32_t x = 0; x < 1300; x++) {
        for (uint32_t z = 0; z < 3; z++) {
            fixture_add_floor(&map, x, z, 4, TL_NAV_WALKABLE_AREA);
        }
    }
    tl_nav_compact compact = fixture_compact_make(&map, 0);
    tl_nav_config config = region_config(TL_NAV_LAYERS, 0, 0);
    config.detail_sample_dist = 0.5f; // one column
    config.detail_sample_max_error = 0.25f;
    tl_nav_contours contours;
    make_contours(&compact, &config, &contours);
    tl_polygon_def def = tl_default_polygon_def();
    tl_polygon_mesh polygons;
    TEST_RESULT(tl_polygon_mesh_bake(&contours.set, &def, &polygons, NULL), TL_OK);
    tl_nav_detail detail;
    TEST_RESULT(tl_nav_bake_detail(&config, &compact, &polygons, NULL, &detail, NULL), TL_OK);
    TEST_CHECK(detail.patch_count == 1 && detail.limited_patches == 1 && detail.vertex_count == 4);
    tl_nav_detail_free(&detail);
    tl_polygon_mesh_free(&polygons);
    tl_nav_contours_free(&contours);
    fixture_compact_free(&compact);
    fixture_map_free(&map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(within_error),
        cmocka_unit_test(long_edges_are_coarse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
