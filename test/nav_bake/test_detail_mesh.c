// SPDX-License-Identifier: MIT
//
// Detail mesh, from floors to patches, checked by brute force on random storeys.

#include "nav_contour_checks.h"

#include <math.h>

#include "nav_bake/detail/detail.h"

typedef struct level {
    tl_nav_compact compact;
    tl_nav_config config;
    tl_nav_contours contours;
    tl_polygon_mesh polygons;
    tl_nav_detail detail;
} level;

static void build_level(level *l, tl_nav_compact compact, tl_nav_config config)
{
    l->compact = compact;
    l->config = config;
    make_contours(&l->compact, &l->config, &l->contours);
    tl_polygon_def def = tl_default_polygon_def();
    TEST_RESULT(tl_polygon_mesh_bake(&l->contours.set, &def, &l->polygons, NULL), TL_OK);
    TEST_RESULT(tl_nav_bake_detail(&l->config, &l->compact, &l->polygons, NULL, &l->detail, NULL), TL_OK);
}

static void free_level(level *l)
{
    tl_nav_detail_free(&l->detail);
    tl_polygon_mesh_free(&l->polygons);
    tl_nav_contours_free(&l->contours);
    fixture_compact_free(&l->compact);
}

static tl_nav_config detail_config(test_random *random, int round)
{
    uint32_t min_area = test_random_below(random, 20);
    tl_nav_config config = region_config((tl_nav_partition)(round % 3), min_area, test_random_below(random, 300));
    config.max_simplification_error = test_random_range(random, 0.5f, 2.0f);
    config.max_edge_len = round % 2 == 0 ? 0 : 5 + test_random_below(random, 30);
    config.detail_sample_dist = 0.5f * test_random_range(random, 0.9f, 6.0f); // columns of 0.5 m
    config.detail_sample_max_error = 0.25f * test_random_range(random, 0.0f, 3.0f);
    return config;
}

static tl_nav_compact random_level(test_random *random, int round)
{
    uint32_t width = test_random_below(random, 50), height = test_random_below(random, 50);
    if (round % 7 == 6) {
        return fixture_spiral(10 + width / 2, 2, 3);
    }
    uint32_t holes = test_random_below(random, 4), border = round % 3 == 2 ? 3 : 0;
    return fixture_random(random, 10 + width, 10 + height, 1 + round % 3, holes, border);
}

// A vertex of the detail mesh in columns of the tile, exact to the rounding of floats.
static void to_columns(const level *l, tl_vec3 v, double *x, double *y, double *z)
{
    const tl_nav_lattice *lattice = &l->compact.lattice;
    *x = ((double)v.x - (double)lattice->origin.x) / (double)l->compact.cell_size - l->compact.border_size;
    *y = ((double)v.y - (double)lattice->origin.y) / (double)l->compact.cell_height;
    *z = ((double)v.z - (double)lattice->origin.z) / (double)l->compact.cell_size - l->compact.border_size;
}

// The fixture's coordinates stay within 64 m, where a float's half ulp is 2^-18 m, or 2^-17 columns of 0.5 m.
#define ROUNDING (1.0 / (1 << 16))

static double cross_columns(const level *l, tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    double ax, ay, az, bx, by, bz, cx, cy, cz;
    to_columns(l, a, &ax, &ay, &az);
    to_columns(l, b, &bx, &by, &bz);
    to_columns(l, c, &cx, &cy, &cz);
    return (cx - ax) * (bz - az) - (bx - ax) * (cz - az); // > 0 in the polygons' winding
}

// Triangles are wound as the polygon, cover its area, each inner edge has one partner, each outer edge is flagged.
static void check_topology(const level *l, uint32_t p)
{
    const tl_nav_detail_patch *patch = &l->detail.patches[p];
    const tl_vec3 *v = l->detail.vertices + patch->first_vertex;
    const tl_nav_detail_triangle *t = l->detail.triangles + patch->first_triangle;
    uint32_t corner_count = l->polygons.first[p + 1] - l->polygons.first[p], outline = 0;
    TEST_CHECK(patch->vertex_count >= corner_count);
    double area2 = 0, polygon_area2 = 0;
    uint8_t *used = calloc(patch->vertex_count, 1);
    for (uint32_t k = 0; k < patch->triangle_count; k++) {
        double triangle_area2 = cross_columns(l, v[t[k].corner[0]], v[t[k].corner[1]], v[t[k].corner[2]]);
        TEST_CHECK(triangle_area2 > -ROUNDING * 100);
        area2 += triangle_area2;
        for (int e = 0; e < 3; e++) {
            uint32_t a = t[k].corner[e], b = t[k].corner[(e + 1) % 3], partners = 0;
            used[a] = 1;
            for (uint32_t j = 0; j < patch->triangle_count; j++) {
                for (int f = 0; f < 3; f++) {
                    TEST_CHECK(j == k || t[j].corner[f] != a || t[j].corner[(f + 1) % 3] != b);
                    partners += t[j].corner[f] == b && t[j].corner[(f + 1) % 3] == a;
                }
            }
            bool flagged = (t[k].edge_flags & (1u << e)) != 0;
            TEST_CHECK(partners == (flagged ? 0 : 1));
            outline += flagged;
        }
    }
    for (uint32_t k = 2; k < corner_count; k++) {
        polygon_area2 += cross_columns(l, v[0], v[k - 1], v[k]);
    }
    TEST_CHECK(fabs(area2 - polygon_area2) <= ROUNDING * 60 * patch->vertex_count);
    for (uint32_t k = 0; k < patch->vertex_count; k++) {
        TEST_CHECK(used[k]);
    }
    TEST_CHECK(patch->triangle_count == 2 * patch->vertex_count - outline - 2); // Euler
    free(used);
}

// The patch's surface at a place, in voxels; NAN outside.
static double surface_at(const level *l, uint32_t p, double x, double z)
{
    const tl_nav_detail_patch *patch = &l->detail.patches[p];
    const tl_vec3 *v = l->detail.vertices + patch->first_vertex;
    const tl_nav_detail_triangle *t = l->detail.triangles + patch->first_triangle;
    double best = (double)NAN, best_inside = -1e-3;
    for (uint32_t k = 0; k < patch->triangle_count; k++) {
        double cx[3], cy[3], cz[3], weight[3], inside = 1;
        for (int e = 0; e < 3; e++) {
            to_columns(l, v[t[k].corner[e]], &cx[e], &cy[e], &cz[e]);
        }
        double area2 = (cx[2] - cx[0]) * (cz[1] - cz[0]) - (cx[1] - cx[0]) * (cz[2] - cz[0]);
        for (int e = 0; e < 3; e++) {
            int f = (e + 1) % 3, g = (e + 2) % 3;
            weight[e] = ((cx[g] - x) * (cz[f] - z) - (cx[f] - x) * (cz[g] - z)) / area2;
            inside = weight[e] < inside ? weight[e] : inside;
        }
        if (inside > best_inside) {
            best_inside = inside;
            best = weight[0] * cy[0] + weight[1] * cy[1] + weight[2] * cy[2];
        }
    }
    return best;
}

static uint32_t span_of_region(const tl_nav_compact *compact, int64_t x, int64_t z, uint32_t region)
{
    if (x < 0 || z < 0 || x >= compact->width || z >= compact->height) {
        return TL_NAV_NO_SPAN;
    }
    uint32_t column = (uint32_t)z * compact->width + (uint32_t)x;
    for (uint32_t i = compact->first_span[column]; i < compact->first_span[column + 1]; i++) {
        if (compact->region[i] == region) {
            return i;
        }
    }
    return TL_NAV_NO_SPAN;
}

// Every column centre of the sampling grid that lies deep enough inside the polygon is within the error.
static uint32_t check_inner_samples(const level *l, uint32_t p)
{
    const tl_polygon_mesh *m = &l->polygons;
    double spacing = (double)l->config.detail_sample_dist / (double)l->compact.cell_size;
    double max_error = (double)l->config.detail_sample_max_error / (double)l->compact.cell_height;
    uint32_t begin = m->first[p], count = m->first[p + 1] - begin, checked = 0;
    if (m->regions[p] == TL_SEVERAL_REGIONS) {
        return 0;
    }
    for (double i = 0; i * spacing < l->contours.set.height; i += 1) {
        for (double j = 0; j * spacing < l->contours.set.width; j += 1) {
            double x = floor(j * spacing) + 0.5, z = floor(i * spacing) + 0.5, depth = (double)INFINITY;
            for (uint32_t k = 0; k < count; k++) {
                const int32_t *a = m->vertices + 3 * m->indices[begin + k];
                const int32_t *b = m->vertices + 3 * m->indices[begin + (k + 1) % count];
                double dx = b[0] - a[0], dz = b[2] - a[2];
                double d = ((x - a[0]) * dz - dx * (z - a[2])) / sqrt(dx * dx + dz * dz);
                depth = d < depth ? d : depth;
            }
            uint32_t border = l->compact.border_size;
            uint32_t span = span_of_region(&l->compact, (int64_t)x + border, (int64_t)z + border, m->regions[p]);
            if (depth > 0.5 * spacing + 1e-9 && span != TL_NAV_NO_SPAN) {
                double surface = surface_at(l, p, x, z);
                TEST_CHECK(fabs(surface - l->compact.floor[span]) <= max_error + 1e-2);
                checked++;
            }
        }
    }
    return checked;
}

// Vertices on an outline edge of a patch, from corner a to corner b, in the order along it; coordinates and all.
static uint32_t edge_vertices(const level *l, uint32_t p, uint32_t corner, tl_vec3 *out)
{
    const tl_nav_detail_patch *patch = &l->detail.patches[p];
    const tl_nav_detail_triangle *t = l->detail.triangles + patch->first_triangle;
    uint32_t corner_count = l->polygons.first[p + 1] - l->polygons.first[p];
    uint32_t at = corner, end = (corner + 1) % corner_count, count = 0;
    while (at != end) {
        uint32_t next = UINT32_MAX;
        for (uint32_t k = 0; k < patch->triangle_count; k++) {
            for (int e = 0; e < 3; e++) {
                if (t[k].corner[e] == at && (t[k].edge_flags & (1u << e)) != 0) {
                    TEST_CHECK(next == UINT32_MAX);
                    next = t[k].corner[(e + 1) % 3];
                }
            }
        }
        TEST_CHECK(next != UINT32_MAX);
        at = next;
        out[count++] = l->detail.vertices[patch->first_vertex + at];
        TEST_CHECK(at < corner_count || count < 600);
    }
    return count; // the end corner included
}

static uint32_t check_shared_edges(const level *l)
{
    const tl_polygon_mesh *m = &l->polygons;
    tl_vec3 mine[700], theirs[700];
    uint32_t with_samples = 0;
    for (uint32_t p = 0; p < m->polygon_count; p++) {
        uint32_t count = m->first[p + 1] - m->first[p];
        for (uint32_t k = 0; k < count; k++) {
            uint32_t other = m->neighbours[m->first[p] + k];
            if (other >= m->polygon_count) {
                continue;
            }
            uint32_t a = m->indices[m->first[p] + k], b = m->indices[m->first[p] + (k + 1) % count];
            uint32_t other_count = m->first[other + 1] - m->first[other], j = 0;
            while (m->indices[m->first[other] + j] != b || m->indices[m->first[other] + (j + 1) % other_count] != a) {
                j++;
                TEST_CHECK(j < other_count);
            }
            uint32_t n = edge_vertices(l, p, k, mine), n_other = edge_vertices(l, other, j, theirs);
            TEST_CHECK(n == n_other);
            for (uint32_t i = 0; i + 1 < n; i++) {
                TEST_CHECK(memcmp(&mine[i], &theirs[n - 2 - i], sizeof mine[i]) == 0);
            }
            with_samples += n > 1;
        }
    }
    return with_samples;
}

// No spikes: an added vertex has the height of a floor that one can walk to from the polygon's region.
static uint32_t check_heights(const level *l, uint32_t p)
{
    const tl_nav_detail_patch *patch = &l->detail.patches[p];
    uint32_t corner_count = l->polygons.first[p + 1] - l->polygons.first[p], own = 0;
    for (uint32_t k = 0; k < patch->vertex_count; k++) {
        double x, y, z;
        to_columns(l, l->detail.vertices[patch->first_vertex + k], &x, &y, &z);
        TEST_CHECK(fabs(y - floor(y + 0.5)) < 1e-2);
        if (k < corner_count) {
            const int32_t *v = l->polygons.vertices + 3 * l->polygons.indices[l->polygons.first[p] + k];
            TEST_CHECK(fabs(x - v[0]) < ROUNDING && fabs(y - v[1]) < 1e-2 && fabs(z - v[2]) < ROUNDING);
            continue;
        }
        bool found = false;
        int64_t column_x = (int64_t)floor(x + ROUNDING) + l->compact.border_size;
        int64_t column_z = (int64_t)floor(z + ROUNDING) + l->compact.border_size;
        for (int64_t dz = -3; dz <= 3 && !found; dz++) {
            for (int64_t dx = -3; dx <= 3 && !found; dx++) {
                if (column_x + dx < 0 || column_z + dz < 0 || column_x + dx >= l->compact.width ||
                    column_z + dz >= l->compact.height) {
                    continue;
                }
                uint32_t column = (uint32_t)(column_z + dz) * l->compact.width + (uint32_t)(column_x + dx);
                for (uint32_t i = l->compact.first_span[column]; i < l->compact.first_span[column + 1]; i++) {
                    found |= fabs(y - l->compact.floor[i]) < 1e-2;
                }
            }
        }
        TEST_CHECK(found);
        own++;
    }
    return own;
}

static void invariants(void **state)
{
    (void)state;
    test_random random = { 4242 };
    uint32_t checked = 0, added = 0, shared = 0, polygons = 0;
    for (int round = 0; round < 90; round++) {
        level l;
        tl_nav_compact compact = random_level(&random, round);
        build_level(&l, compact, detail_config(&random, round));
        TEST_CHECK(l.detail.patch_count == l.polygons.polygon_count && l.detail.limited_patches == 0);
        TEST_CHECK((double)l.detail.max_error <= (double)l.config.detail_sample_max_error * 1.000001);
        for (uint32_t p = 0; p < l.polygons.polygon_count; p++) {
            check_topology(&l, p);
            checked += check_inner_samples(&l, p);
            added += check_heights(&l, p);
        }
        shared += check_shared_edges(&l);
        polygons += l.polygons.polygon_count;
        free_level(&l);
    }
    TEST_CHECK(polygons > 1000 && checked > 3000 && added > 1000 && shared > 300);
}

// Without samples a patch is its polygon, triangulated.
static void no_samples(void **state)
{
    (void)state;
    test_random random = { 5 };
    level l;
    tl_nav_config config = detail_config(&random, 0);
    config.detail_sample_dist = 0;
    build_level(&l, fixture_random(&random, 40, 40, 2, 2, 0), config);
    for (uint32_t p = 0; p < l.polygons.polygon_count; p++) {
        uint32_t corner_count = l.polygons.first[p + 1] - l.polygons.first[p];
        TEST_CHECK(l.detail.patches[p].vertex_count == corner_count);
        TEST_CHECK(l.detail.patches[p].triangle_count == corner_count - 2);
        check_topology(&l, p);
    }
    TEST_CHECK(l.detail.max_error == 0);
    free_level(&l);
}

static void flat_floor_needs_nothing(void **state)
{
    (void)state;
    static const char *const rows[] = { "33333333333333333333", "33333333333333333333", "33333333333333333333",
                                        "33333333333333333333", "33333333333333333333", "33333333333333333333",
                                        "33333333333333333333", "33333333333333333333" };
    test_random random = { 6 };
    level l;
    tl_nav_config config = detail_config(&random, 1);
    config.detail_sample_dist = 1.0f;
    config.max_edge_len = 0;
    build_level(&l, fixture_from_rows(rows, 8, 0), config);
    TEST_CHECK(l.detail.patch_count == 1 && l.detail.vertex_count == 4 && l.detail.triangle_count == 2);
    TEST_CHECK(fabsf(l.detail.vertices[0].y - 3 * 0.25f) < 1e-6f);
    free_level(&l);
}

static void empty_mesh(void **state)
{
    (void)state;
    static const char *const rows[] = { "##", "##" };
    test_random random = { 7 };
    level l;
    build_level(&l, fixture_from_rows(rows, 2, 0), detail_config(&random, 2));
    TEST_CHECK(l.detail.patch_count == 0 && l.contours.set.contour_count == 0);
    free_level(&l);
}

static void same_bytes_again(void **state)
{
    (void)state;
    test_random random = { 77 };
    level l;
    build_level(&l, fixture_random(&random, 50, 50, 3, 2, 0), detail_config(&random, 3));
    tl_nav_detail again;
    TEST_RESULT(tl_nav_bake_detail(&l.config, &l.compact, &l.polygons, NULL, &again, NULL), TL_OK);
    TEST_CHECK(again.vertex_count == l.detail.vertex_count && again.triangle_count == l.detail.triangle_count);
    assert_memory_equal(again.vertices, l.detail.vertices, again.vertex_count * sizeof *again.vertices);
    assert_memory_equal(again.triangles, l.detail.triangles, again.triangle_count * sizeof *again.triangles);
    tl_nav_detail_free(&again);
    free_level(&l);
}

static void fails_at_each_allocation(void **state)
{
    (void)state;
    test_random random = { 8 };
    level l;
    build_level(&l, fixture_random(&random, 60, 60, 3, 1, 0), detail_config(&random, 4));
    test_allocator test;
    uint64_t k = 1;
    for (;; k++) {
        test_allocator_init(&test, k);
        tl_host host = { &test.allocator, NULL, NULL };
        tl_nav_detail detail;
        tl_report report;
        tl_result result = tl_nav_bake_detail(&l.config, &l.compact, &l.polygons, &host, &detail, &report);
        if (result == TL_OK) {
            TEST_CHECK(test.live_blocks == 1);
            tl_nav_detail_free(&detail);
            TEST_CHECK(test.live_blocks == 0 && test.live_bytes == 0);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
        TEST_CHECK(test.live_blocks == 0 && detail.block == NULL && detail.patches == NULL);
    }
    TEST_CHECK(k > 2);
    free_level(&l);
}

static bool cancel_late(const char *stage, uint64_t done, uint64_t total, void *user)
{
    (void)stage;
    (void)user;
    return done < total;
}

static void cancelled(void **state)
{
    (void)state;
    test_random random = { 9 };
    level l;
    build_level(&l, fixture_random(&random, 20, 20, 1, 0, 0), detail_config(&random, 5));
    tl_progress progress = { cancel_late, NULL };
    test_allocator test;
    test_allocator_init(&test, 0);
    tl_host host = { &test.allocator, NULL, &progress };
    tl_nav_detail detail;
    TEST_RESULT(tl_nav_bake_detail(&l.config, &l.compact, &l.polygons, &host, &detail, NULL), TL_ERR_CANCELLED);
    TEST_CHECK(test.live_blocks == 0 && detail.block == NULL);
    free_level(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(invariants), cmocka_unit_test(no_samples),       cmocka_unit_test(flat_floor_needs_nothing),
        cmocka_unit_test(empty_mesh), cmocka_unit_test(same_bytes_again), cmocka_unit_test(fails_at_each_allocation),
        cmocka_unit_test(cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
