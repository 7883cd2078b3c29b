// SPDX-License-Identifier: MIT
//
// Levels at the limits, each made of flat slabs whose walkable area is known: 20 km wide, 2,000 m high in voxels of
// 0.1 m, 300 floors over one another. `test_nav_limits heavy` adds a field of more than 2^24 spans, and one of more
// vertices than 16 bits can count. What can't be built is refused by name before any work.

#include "talus_test.h"

#include <talus/nav_bake.h>

#include <math.h>
#include <string.h>

typedef struct slabs {
    tl_vec3 *vertices;
    uint32_t *indices;
    uint32_t count, capacity;
} slabs;

static slabs slabs_make(uint32_t capacity)
{
    slabs s = { malloc(4 * (size_t)capacity * sizeof(tl_vec3)), malloc(6 * (size_t)capacity * sizeof(uint32_t)), 0,
                capacity };
    return s;
}

static void slabs_free(slabs *s)
{
    free(s->vertices);
    free(s->indices);
}

// A horizontal rectangle, seen from above.
static void add_slab(slabs *s, float x, float y, float z, float width, float depth)
{
    static const uint32_t corners[] = { 0, 1, 2, 0, 2, 3 };
    TEST_CHECK(s->count < s->capacity);
    tl_vec3 *v = s->vertices + 4 * (size_t)s->count;
    v[0] = tl_vec3_make(x, y, z);
    v[1] = tl_vec3_make(x, y, z + depth);
    v[2] = tl_vec3_make(x + width, y, z + depth);
    v[3] = tl_vec3_make(x + width, y, z);
    for (uint32_t k = 0; k < 6; k++) {
        s->indices[6 * (size_t)s->count + k] = 4 * s->count + corners[k];
    }
    s->count++;
}

static tl_nav_input input_of(const slabs *s)
{
    tl_nav_input input;
    memset(&input, 0, sizeof input);
    input.mesh = (tl_mesh_view){ s->vertices, 4 * s->count, s->indices, 2 * s->count, NULL };
    return input;
}

static double polygon_area(const tl_polygon_mesh *mesh)
{
    double sum = 0;
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        const uint32_t *corner = mesh->indices + mesh->first[p];
        const int32_t *a = mesh->vertices + 3 * (size_t)corner[0];
        for (uint32_t k = 2; k < mesh->first[p + 1] - mesh->first[p]; k++) {
            const int32_t *b = mesh->vertices + 3 * (size_t)corner[k - 1], *c = mesh->vertices + 3 * (size_t)corner[k];
            sum -= (double)((int64_t)(b[0] - a[0]) * (c[2] - a[2]) - (int64_t)(c[0] - a[0]) * (b[2] - a[2])) / 2;
        }
    }
    return sum * (double)mesh->cell_size * (double)mesh->cell_size;
}

typedef struct built {
    tl_nav_bake_report report;
    double area;
    float highest;
} built;

// Builds every tile of a level, checks each, and sums them up.
static built build(const slabs *s, const tl_nav_def *def)
{
    const tl_nav_input input = input_of(s);
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t i = 0; i < 4 * s->count; i++) {
        bounds = tl_aabb_add_point(bounds, s->vertices[i]);
    }
    uint32_t tiles_x, tiles_z;
    TEST_RESULT(tl_nav_tile_grid(def, bounds, &tiles_x, &tiles_z, NULL), TL_OK);
    built sum;
    memset(&sum, 0, sizeof sum);
    for (uint32_t t = 0; t < tiles_x * tiles_z; t++) {
        tl_nav_config config;
        tl_nav_stages stages;
        tl_nav_bake_report report;
        tl_nav_tile *tile;
        memset(&stages, 0, sizeof stages);
        TEST_RESULT(tl_nav_config_from_def(def, bounds, t % tiles_x, t / tiles_x, &config, NULL), TL_OK);
        TEST_RESULT(tl_nav_tile_bake(&config, &input, NULL, &stages, &tile, &report), TL_OK);
        TEST_CHECK(tile != NULL);
        TEST_RESULT(tl_nav_tile_check(tile, ((const tl_blob *)tile)->size, NULL), TL_OK);
        sum.area += polygon_area(&stages.polygons);
        sum.report.span_count += report.span_count;
        sum.report.polygon_count += report.polygon_count;
        sum.report.vertex_count += report.vertex_count;
        for (uint32_t v = 0; v < stages.polygons.vertex_count; v++) {
            const float y = (float)stages.polygons.vertices[3 * (size_t)v + 1] * def->cell_height;
            sum.highest = y > sum.highest ? y : sum.highest;
        }
        tl_blob_free(tile);
        tl_nav_stages_free(&stages);
    }
    return sum;
}

// A slab's area without the ledge's cell and the agent's radius on each side; exact when its sides are whole cells.
static double slab_area(const tl_nav_def *def, float width, float depth)
{
    const double lost = 2 * (double)def->cell_size * (1 + ceil((double)(def->agent_radius / def->cell_size) - 1e-6));
    return ((double)width - lost) * ((double)depth - lost);
}

static void expect_area(const built *b, double area)
{
    if (fabs(b->area / area - 1) > 1e-6) {
        fail_msg("area %.3f, expected %.3f", b->area, area);
    }
}

static void twenty_kilometres(void **state)
{
    (void)state;
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.25f;
    slabs s = slabs_make(1);
    add_slab(&s, 0, 0, 0, 20000, 8);
    built whole = build(&s, &def); // 80,000 columns a row: links are indices
    expect_area(&whole, slab_area(&def, 20000, 8));
    def.tile_size = 1024;
    built tiled = build(&s, &def);
    expect_area(&tiled, slab_area(&def, 20000, 8));
    TEST_CHECK(tiled.report.polygon_count >= 79);
    slabs_free(&s);

    // More than 2^31 places of tiles: refused by name.
    def.tile_size = 64;
    uint32_t tiles_x, tiles_z;
    tl_report report;
    const tl_aabb square = { tl_vec3_make(0, 0, 0), tl_vec3_make(800000, 10, 800000) };
    TEST_RESULT(tl_nav_tile_grid(&def, square, &tiles_x, &tiles_z, &report), TL_ERR_LIMIT);
    assert_string_equal(report.field, "tile_size");
    TEST_CHECK(report.advice != NULL);
}

// Small islands in the corners of a square of 20 km: 1.5 million places, a few tiles. What is baked, and what that
// takes, is what two islands side by side take.
static void twenty_kilometres_square(void **state)
{
    (void)state;
    static const float far[] = { 40, 20000, 400000 };
    uint64_t peak[3];
    for (uint32_t i = 0; i < 3; i++) {
        tl_nav_def def = tl_default_nav_def();
        def.cell_size = 0.25f;
        def.tile_size = 64;
        slabs s = slabs_make(4);
        for (uint32_t k = 0; k < 4; k++) {
            add_slab(&s, k % 2 == 0 ? 0 : far[i] - 16, 0, k / 2 == 0 ? 0 : far[i] - 16, 16, 16);
        }
        const tl_nav_input input = input_of(&s);
        tl_nav_tiles tiles;
        tl_nav_bake_report report;
        TEST_RESULT(tl_nav_bake(&def, &input, &tiles, &report), TL_OK);
        TEST_CHECK(tiles.tile_count >= 4 && tiles.tile_count <= 16);
        TEST_CHECK(i < 1 || (uint64_t)tiles.tiles_x * tiles.tiles_z > 1u << 20);
        for (uint32_t t = 0; t < tiles.tile_count; t++) {
            TEST_CHECK(tiles.tiles[t]->polygon_count > 0);
        }
        peak[i] = report.base.peak_bytes;
        print_message("%u x %u places, %u tiles, %.2f MB\n", tiles.tiles_x, tiles.tiles_z, tiles.tile_count,
                      (double)peak[i] / 1e6);
        // A block of all of them would need a stack for each place.
        const tl_nav_tile_range all = { 0, 0, tiles.tiles_x, tiles.tiles_z };
        tl_nav_tile_block block;
        TEST_RESULT(tl_nav_bake_range(&def, &input, all, NULL, &block, &report), i == 0 ? TL_OK : TL_ERR_LIMIT);
        TEST_CHECK(i == 0 || strcmp(report.base.field, "range") == 0);
        tl_nav_tile_block_free(&block);
        tl_nav_tiles_free(&tiles);
        slabs_free(&s);
    }
    TEST_CHECK(peak[1] < 2 * peak[0] && peak[2] < 2 * peak[0]);
}

static void two_thousand_metres_high(void **state)
{
    (void)state;
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.25f;
    def.cell_height = 0.1f;
    slabs s = slabs_make(2);
    add_slab(&s, 0, 0, 0, 16, 16);
    add_slab(&s, 0, 2000, 0, 16, 16);
    built b = build(&s, &def);
    expect_area(&b, 2 * slab_area(&def, 16, 16));
    TEST_CHECK(fabsf(b.highest - 2000) < 0.3f);
    slabs_free(&s);

    def.cell_height = 0.03f; // 66,667 voxels
    tl_nav_config config;
    tl_report report;
    const tl_aabb bounds = { tl_vec3_make(0, 0, 0), tl_vec3_make(16, 2000, 16) };
    TEST_RESULT(tl_nav_config_from_def(&def, bounds, 0, 0, &config, &report), TL_ERR_LIMIT);
    assert_string_equal(report.field, "cell_height");
}

static void three_hundred_floors(void **state)
{
    (void)state;
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.25f;
    slabs s = slabs_make(300);
    for (uint32_t k = 0; k < 300; k++) {
        add_slab(&s, 0, 3.0f * (float)k, 0, 12, 12);
    }
    for (int partition = TL_NAV_WATERSHED; partition <= TL_NAV_LAYERS; partition++) {
        def.partition = (tl_nav_partition)partition;
        built b = build(&s, &def);
        expect_area(&b, 300 * slab_area(&def, 12, 12));
        TEST_CHECK(b.report.polygon_count == 300 && b.report.span_count == 300 * 48 * 48);
    }
    slabs_free(&s);
}

static void seventy_thousand_vertices(void **state)
{
    (void)state;
    enum { SIDE = 135 };
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.25f;
    def.agent_radius = 0.25f;
    def.region_min_size = 2;
    slabs s = slabs_make(SIDE * SIDE);
    for (uint32_t k = 0; k < SIDE * SIDE; k++) {
        add_slab(&s, 4.0f * (float)(k % SIDE), 0, 4.0f * (float)(k / SIDE), 3, 3);
    }
    built b = build(&s, &def);
    expect_area(&b, SIDE * SIDE * slab_area(&def, 3, 3));
    TEST_CHECK(b.report.polygon_count == SIDE * SIDE && b.report.vertex_count > 70000);
    slabs_free(&s);
}

static void seventeen_million_spans(void **state)
{
    (void)state;
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.25f;
    def.detail_sample_dist = 0;
    slabs s = slabs_make(1);
    add_slab(&s, 0, 0, 0, 1040, 1040);
    for (int partition = TL_NAV_WATERSHED; partition <= TL_NAV_LAYERS; partition++) {
        def.partition = (tl_nav_partition)partition;
        built b = build(&s, &def);
        TEST_CHECK(b.report.span_count == 4160 * 4160 && b.report.span_count > 1 << 24);
        expect_area(&b, slab_area(&def, 1040, 1040));
    }
    slabs_free(&s);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(twenty_kilometres), cmocka_unit_test(twenty_kilometres_square),
                                        cmocka_unit_test(two_thousand_metres_high),
                                        cmocka_unit_test(three_hundred_floors) };
    const struct CMUnitTest heavy[] = { cmocka_unit_test(seventy_thousand_vertices),
                                        cmocka_unit_test(seventeen_million_spans) };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    if (argc > 1 && strcmp(argv[1], "heavy") == 0) {
        failed += cmocka_run_group_tests(heavy, NULL, NULL);
    }
    return failed;
}
