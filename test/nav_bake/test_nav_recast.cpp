// SPDX-License-Identifier: MIT
//
// The pipeline against Recast's, same settings, on the built-in levels and on whatever real levels are there.
//
// Spans differ from Recast's where the noise of its float lattice puts a wall that lies on a cell's border to the one
// or the other side, and where the order of triangles decided an area; floors by the same, and where a gap is exactly
// as high as the agent, which newer versions of Recast let pass and Debian's does not. So counts are compared, with
// narrow bounds. The built-in levels are modelled in decimetres and full of walls on borders: they are compared with
// cells of a quarter metre, whose lattice is exact in floats, so that the noise plays no part. An argument sets another
// size for all, and files behind it take the place of all levels: test_nav_recast 0.1 [LEVEL ...].

#include "recast_pipeline.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <math.h>
#include <stdlib.h>
#include <string>

extern "C" {
#include "math/cos_degrees.h"
#include "nav_bake/input/level_mesh.h"
}

// Last: cmocka takes the word fail from the standard headers.
#include "level_list.hpp"

namespace
{

const std::vector<std::string> FILES = { "nav_test",    "dungeon",           "undulating",
                                         "proto-level", "collision_mesh_01", "test_map01" };

tl_nav_config make_config(const level &l, tl_nav_partition partition)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = l.cell_size;
    def.agent_max_slope = l.max_slope;
    def.partition = partition;
    tl_nav_config config;
    TEST_RESULT(tl_nav_config_from_def(&def, l.bounds(), 0, 0, &config, nullptr), TL_OK);
    return config;
}

void lattice_is_recasts(void **)
{
    for (const level &l : all_levels(20000, FILES)) {
        tl_nav_config config = make_config(l, TL_NAV_WATERSHED);
        tl_aabb box = l.bounds();
        int width, height;
        rcCalcGridSize(&box.min.x, &box.max.x, config.cell_size, &width, &height);
        TEST_CHECK(config.width == (uint32_t)width && config.height == (uint32_t)height);
        TEST_CHECK(std::memcmp(&config.bounds.min, &box.min, sizeof box.min) == 0);
    }
}

// Of triangles of any slope, and of such that are exactly as steep as the limit but for their rounding, which decides.
void slopes_are_recasts(void **)
{
    test_random random = { 12 };
    uint32_t walkable = 0, at_limit = 0;
    for (uint32_t i = 0; i < 200000; i++) {
        float corners[9];
        const int triangle[3] = { 0, 1, 2 };
        for (float &value : corners) {
            value = test_random_range(&random, -20, 20);
        }
        const bool is_bevel = i % 2 == 0; // a quarter turn's half about an axis along a wall
        if (is_bevel) {
            const float turn = test_random_range(&random, 0, 6.28f), run = test_random_range(&random, 0.05f, 4);
            const float dx = std::cos(turn), dz = std::sin(turn);
            corners[3] = corners[0] - dz, corners[4] = corners[1], corners[5] = corners[2] + dx;
            corners[6] = corners[0] + dx * run, corners[7] = corners[1] + run, corners[8] = corners[2] + dz * run;
        }
        unsigned char area = 0;
        rcContext context(false);
        rcMarkWalkableTriangles(&context, 45.0f, corners, 3, triangle, 1, &area);
        const tl_vec3 *v = reinterpret_cast<const tl_vec3 *>(corners);
        TEST_CHECK(tl_triangle_is_walkable(v[0], v[1], v[2], tl_cos_degrees(45.0f)) == (area != 0));
        walkable += area != 0;
        at_limit += is_bevel && area != 0;
    }
    TEST_CHECK(walkable > 40000 && at_limit > 10000 && at_limit < 90000);
}

struct span_counts {
    uint64_t columns, equal_columns, near_columns, spans, recast_spans;
};

// A column is near when it has as many spans as Recast's, none off by more than a voxel.
span_counts compare_spans(const tl_nav_heightfield &field, const rcHeightfield &recast)
{
    span_counts counts = {};
    counts.columns = (uint64_t)field.width * field.height;
    counts.spans = field.span_count;
    for (uint64_t c = 0; c < counts.columns; c++) {
        bool equal = true, close = true;
        uint32_t i = field.first_span[c];
        for (const rcSpan *span = recast.spans[c]; span != nullptr; span = span->next, i++) {
            counts.recast_spans++;
            if (i >= field.first_span[c + 1]) {
                equal = close = false;
                continue;
            }
            int below = field.spans[i].min - (int)span->smin, above = field.spans[i].max - (int)span->smax;
            equal = equal && below == 0 && above == 0;
            close = close && std::abs(below) <= 1 && std::abs(above) <= 1;
        }
        equal = equal && i == field.first_span[c + 1];
        close = close && i == field.first_span[c + 1];
        counts.equal_columns += equal;
        counts.near_columns += close;
    }
    return counts;
}

void spans_and_floors_agree(void **)
{
    for (const level &l : all_levels(20000, FILES)) {
        tl_nav_config config = make_config(l, TL_NAV_WATERSHED);
        tl_mesh_view mesh = l.view();
        recast_pipeline recast;
        TEST_CHECK(recast.rasterize(config, mesh, l.max_slope));
        tl_nav_heightfield field;
        TEST_RESULT(tl_nav_rasterize(&config, &mesh, nullptr, nullptr, &field, nullptr), TL_OK);
        span_counts counts = compare_spans(field, *recast.heightfield);
        double equal = (double)counts.equal_columns / (double)counts.columns;
        double close = (double)counts.near_columns / (double)counts.columns;
        double more = (double)counts.spans / (double)counts.recast_spans - 1;

        recast.filter(config);
        tl_nav_filter_low_hanging_obstacles(&config, &field);
        tl_nav_filter_ledge_spans(&config, &field);
        tl_nav_filter_walkable_low_height_spans(&config, &field);
        TEST_CHECK(recast.build_compact(config) && recast.erode(config));
        tl_nav_compact compact;
        TEST_RESULT(tl_nav_bake_compact(&config, &field, nullptr, &compact, nullptr), TL_OK);
        TEST_RESULT(tl_nav_erode(&config, nullptr, &compact, nullptr), TL_OK);
        uint64_t walkable = 0, recast_walkable = 0;
        for (uint32_t i = 0; i < compact.span_count; i++) {
            walkable += compact.area[i] != TL_NAV_NULL_AREA;
        }
        for (int i = 0; i < recast.compact->spanCount; i++) {
            recast_walkable += recast.compact->areas[i] != RC_NULL_AREA;
        }
        double floors = (double)walkable / (double)recast_walkable - 1;
        std::printf("%-18s columns equal %.3f%%, within a voxel %.3f%%; spans %+.3f%%; eroded floors %+.3f%%\n",
                    l.name.c_str(), 100 * equal, 100 * close, 100 * more, 100 * floors);
        // Whoever brings a level may have modelled it on the lines between cells: its figures are only printed.
        TEST_CHECK(!wanted_files.empty() || (equal > 0.98 && close > 0.985));
        TEST_CHECK(!wanted_files.empty() || (std::fabs(more) < 0.005 && std::fabs(floors) < 0.01));
        tl_nav_compact_free(&compact);
        tl_nav_heightfield_free(&field);
    }
}

bool is_strictly_convex(const tl_polygon_mesh &mesh, uint32_t polygon)
{
    const uint32_t *corner = mesh.indices + mesh.first[polygon];
    const uint32_t count = mesh.first[polygon + 1] - mesh.first[polygon];
    for (uint32_t k = 0; k < count; k++) {
        const int32_t *a = mesh.vertices + 3 * (size_t)corner[k];
        const int32_t *b = mesh.vertices + 3 * (size_t)corner[(k + 1) % count];
        const int32_t *c = mesh.vertices + 3 * (size_t)corner[(k + 2) % count];
        if ((int64_t)(b[0] - a[0]) * (c[2] - a[2]) - (int64_t)(c[0] - a[0]) * (b[2] - a[2]) >= 0) {
            return false;
        }
    }
    return count >= 3 && count <= mesh.max_verts_per_poly;
}

double polygon_area(const tl_polygon_mesh &mesh)
{
    double sum = 0;
    for (uint32_t p = 0; p < mesh.polygon_count; p++) {
        const uint32_t *corner = mesh.indices + mesh.first[p];
        const int32_t *a = mesh.vertices + 3 * (size_t)corner[0];
        for (uint32_t k = 2; k < mesh.first[p + 1] - mesh.first[p]; k++) {
            const int32_t *b = mesh.vertices + 3 * (size_t)corner[k - 1];
            const int32_t *c = mesh.vertices + 3 * (size_t)corner[k];
            sum -= (double)((int64_t)(b[0] - a[0]) * (c[2] - a[2]) - (int64_t)(c[0] - a[0]) * (b[2] - a[2])) / 2;
        }
    }
    return sum * (double)mesh.cell_size * (double)mesh.cell_size;
}

void polygons_agree(void **)
{
    const tl_nav_partition partitions[] = { TL_NAV_WATERSHED, TL_NAV_MONOTONE };
    for (const level &l : all_levels(20000, FILES)) {
        for (tl_nav_partition partition : partitions) {
            tl_nav_config config = make_config(l, partition);
            tl_mesh_view mesh = l.view();
            recast_pipeline recast;
            TEST_CHECK(recast.rasterize(config, mesh, l.max_slope) && recast.filter(config) &&
                       recast.build_compact(config) && recast.erode(config) && recast.distance_field() &&
                       recast.regions(config) && recast.build_contours(config) && recast.build_polygons(config));
            tl_nav_input input = {};
            input.mesh = mesh;
            tl_nav_stages stages = {};
            tl_nav_tile *tile;
            tl_nav_bake_report report;
            TEST_RESULT(tl_nav_tile_bake(&config, &input, nullptr, &stages, &tile, &report), TL_OK);
            double area = polygon_area(stages.polygons), recast_area = recast.polygon_area();
            std::printf("%-18s %s: %5u polygons, Recast %5d; area %10.1f, Recast %+.3f%%; contours mended %u\n",
                        l.name.c_str(), partition == TL_NAV_WATERSHED ? "watershed" : "monotone",
                        stages.polygons.polygon_count, recast.polygons->npolys, area, 100 * (recast_area / area - 1),
                        report.repaired_contours);
            TEST_CHECK((tile != nullptr) == (recast.polygons->npolys > 0));
            TEST_CHECK(std::fabs(area - recast_area) <= 0.01 * recast_area);
            TEST_CHECK(tile != nullptr || !wanted_files.empty());
            for (uint32_t p = 0; p < stages.polygons.polygon_count; p++) {
                TEST_CHECK(is_strictly_convex(stages.polygons, p));
            }
            tl_blob_free(tile);
            tl_nav_stages_free(&stages);
        }
    }
}

} // namespace

int main(int argc, char **argv)
{
    take_level_arguments(argc, argv);
    const struct CMUnitTest tests[] = { cmocka_unit_test(lattice_is_recasts), cmocka_unit_test(slopes_are_recasts),
                                        cmocka_unit_test(spans_and_floors_agree), cmocka_unit_test(polygons_agree) };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
