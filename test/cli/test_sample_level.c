// SPDX-License-Identifier: MIT
#include "talus_test.h"

#include "cli/sample/sample_carving.h"
#include "cli/sample/sample_level.h"

#include <string.h>

static const uint32_t sizes[] = { 500, 777, 1000, 2500, 10000, 60000 };

static void build(const tl_sample_level *level, uint32_t triangles, uint64_t seed, tl_sample_mesh *mesh)
{
    TEST_RESULT(tl_sample_build_level(level, triangles, seed, mesh), TL_OK);
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        TEST_CHECK(tl_is_finite(mesh->vertices[i]));
    }
    for (uint32_t i = 0; i < 3 * mesh->triangle_count; ++i) {
        TEST_CHECK(mesh->indices[i] < mesh->vertex_count);
    }
}

static void test_reaches_the_size(void **state)
{
    (void)state;
    uint32_t count;
    const tl_sample_level *levels = tl_sample_levels(&count);
    assert_int_equal(count, 4);
    for (uint32_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < sizeof(sizes) / sizeof(sizes[0]); ++k) {
            for (uint64_t seed = 0; seed < 4; ++seed) {
                tl_sample_mesh mesh;
                build(&levels[i], sizes[k], seed, &mesh);
                assert_in_range(mesh.triangle_count, sizes[k] - 7, sizes[k]);
                tl_sample_mesh_free(&mesh);
            }
        }
    }
}

// A large request is met by extent, not by rocks: four times the triangles is about four times the ground.
static void test_grows_by_extent(void **state)
{
    (void)state;
    uint32_t count;
    const tl_sample_level *levels = tl_sample_levels(&count);
    for (uint32_t i = 0; i < count; ++i) {
        double ground[2];
        for (unsigned k = 0; k < 2; ++k) {
            tl_sample_mesh mesh;
            build(&levels[i], k == 0 ? 250000 : 1000000, 1, &mesh);
            tl_aabb bounds = tl_aabb_empty();
            for (uint32_t v = 0; v < mesh.vertex_count; ++v) {
                bounds = tl_aabb_add_point(bounds, mesh.vertices[v]);
            }
            tl_vec3 size = tl_aabb_size(bounds);
            ground[k] = (double)size.x * (double)size.z;
            tl_sample_mesh_free(&mesh);
        }
        TEST_CHECK(ground[1] > 3.2 * ground[0] && ground[1] < 4.8 * ground[0]);
    }
}

static void test_too_small_gives_the_smallest(void **state)
{
    (void)state;
    uint32_t count;
    const tl_sample_level *levels = tl_sample_levels(&count);
    for (uint32_t i = 0; i < count; ++i) {
        tl_sample_mesh mesh;
        build(&levels[i], 0, 1, &mesh);
        assert_in_range(mesh.triangle_count, 1, levels[i].smallest_triangles);
        tl_sample_mesh_free(&mesh);
        TEST_RESULT(tl_sample_build_level(&levels[i], UINT32_MAX, 1, &mesh), TL_ERR_LIMIT);
        assert_null(mesh.vertices);
    }
    assert_null(tl_sample_find_level("castle"));
    assert_ptr_equal(tl_sample_find_level("city"), &levels[3]);
}

static uint64_t fold(uint64_t hash, const void *bytes, size_t size)
{
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < size; ++i) {
        hash = (hash ^ byte[i]) * 0x100000001b3u; // FNV-1a
    }
    return hash;
}

static uint64_t hash_of(const char *name, uint32_t triangles, uint64_t seed)
{
    tl_sample_mesh mesh;
    build(tl_sample_find_level(name), triangles, seed, &mesh);
    uint64_t hash = fold(0xcbf29ce484222325u, mesh.vertices, mesh.vertex_count * sizeof(tl_vec3));
    hash = fold(hash, mesh.indices, 3 * (size_t)mesh.triangle_count * sizeof(uint32_t));
    tl_sample_mesh_free(&mesh);
    return hash;
}

// The same on every compiler, optimisation level and machine: a changed hash is a changed level.
static void test_golden(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        uint64_t hash;
    } golden[] = {
        { "courtyard", 0x10ed80d4410cd5bb },
        { "dungeon", 0x0ddca139c86407f0 },
        { "terrain", 0x2e0c333b925a03d4 },
        { "city", 0x633897e1ac1d1941 },
    };
    for (size_t i = 0; i < 4; ++i) {
        uint64_t hash = hash_of(golden[i].name, 30000, 1);
        TEST_CHECK(hash != hash_of(golden[i].name, 30000, 2));
        if (hash != golden[i].hash) {
            print_error("%s: 0x%016llx\n", golden[i].name, (unsigned long long)hash);
        }
        TEST_CHECK(hash == golden[i].hash);
    }
}

typedef struct edge {
    tl_vec3 low, high;
    int direction;
} edge;

static int compare_points(tl_vec3 a, tl_vec3 b)
{
    int by_x = (a.x > b.x) - (a.x < b.x);
    int by_y = (a.y > b.y) - (a.y < b.y);
    int by_z = (a.z > b.z) - (a.z < b.z);
    return by_x ? by_x : by_y ? by_y : by_z;
}

static int compare_edges(const void *a, const void *b)
{
    const edge *x = a;
    const edge *y = b;
    int by_low = compare_points(x->low, y->low);
    return by_low ? by_low : compare_points(x->high, y->high);
}

// Edges, by position, that are not run through as often one way as the other.
static uint32_t count_open_edges(const tl_sample_mesh *mesh)
{
    uint32_t count = 3 * mesh->triangle_count;
    edge *edges = malloc(count * sizeof(edge));
    assert_non_null(edges);
    for (uint32_t i = 0; i < count; ++i) {
        tl_vec3 a = mesh->vertices[mesh->indices[i]];
        tl_vec3 b = mesh->vertices[mesh->indices[i % 3 == 2 ? i - 2 : i + 1]];
        bool forward = compare_points(a, b) < 0;
        edges[i].low = forward ? a : b;
        edges[i].high = forward ? b : a;
        edges[i].direction = forward ? 1 : -1;
    }
    qsort(edges, count, sizeof(edge), compare_edges);
    uint32_t open = 0;
    for (uint32_t i = 0; i < count;) {
        int sum = 0;
        uint32_t end = i;
        while (end < count && compare_edges(&edges[i], &edges[end]) == 0) {
            sum += edges[end++].direction;
        }
        open += sum != 0;
        i = end;
    }
    free(edges);
    return open;
}

static void test_closed_levels_are_closed(void **state)
{
    (void)state;
    static const char *const closed[] = { "courtyard", "city" };
    for (size_t i = 0; i < 2; ++i) {
        for (uint64_t seed = 0; seed < 5; ++seed) {
            tl_sample_mesh mesh;
            build(tl_sample_find_level(closed[i]), 40000, seed, &mesh);
            assert_int_equal(count_open_edges(&mesh), 0);
            tl_sample_mesh_free(&mesh);
        }
    }
}

static void test_no_flat_triangle(void **state)
{
    (void)state;
    uint32_t count;
    const tl_sample_level *levels = tl_sample_levels(&count);
    for (uint32_t i = 0; i < count; ++i) {
        tl_sample_mesh mesh;
        build(&levels[i], 60000, 3, &mesh);
        for (uint32_t k = 0; k < mesh.triangle_count; ++k) {
            tl_vec3 a = mesh.vertices[mesh.indices[3 * k]];
            tl_vec3 b = mesh.vertices[mesh.indices[3 * k + 1]];
            tl_vec3 c = mesh.vertices[mesh.indices[3 * k + 2]];
            TEST_CHECK(tl_length_sq(tl_cross(tl_sub(b, a), tl_sub(c, a))) > 1e-8f); // 1 cm by 1 cm
        }
        tl_sample_mesh_free(&mesh);
    }
}

// The volume inside a closed surface by the divergence theorem: pieces look outward and fill what they say.
static double volume_of(const tl_sample_mesh *mesh)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < mesh->triangle_count; ++i) {
        tl_vec3 a = mesh->vertices[mesh->indices[3 * i]];
        tl_vec3 b = mesh->vertices[mesh->indices[3 * i + 1]];
        tl_vec3 c = mesh->vertices[mesh->indices[3 * i + 2]];
        sum += (double)tl_dot(a, tl_cross(b, c)) / 6.0;
    }
    return sum;
}

static void check_piece(tl_sample_mesh *mesh, double low, double high)
{
    TEST_RESULT(mesh->result, TL_OK);
    assert_int_equal(count_open_edges(mesh), 0);
    double volume = volume_of(mesh);
    TEST_CHECK(volume >= low && volume <= high);
    tl_sample_mesh_free(mesh);
}

static void test_pieces(void **state)
{
    (void)state;
    tl_aabb box = tl_sample_bounds(1, 0, 2, 5, 2, 4);
    for (unsigned turns = 0; turns < 4; ++turns) {
        tl_sample_mesh mesh = { 0 };
        tl_sample_place(&mesh, tl_vec3_make(3, -1, 2), turns);
        tl_sample_box(&mesh, box);
        check_piece(&mesh, 15.999, 16.001);
        tl_sample_place(&mesh, tl_vec3_make(3, -1, 2), turns);
        tl_sample_ramp(&mesh, box);
        check_piece(&mesh, 7.999, 8.001);
        tl_sample_gable(&mesh, box);
        check_piece(&mesh, 7.999, 8.001);
        tl_sample_stairs(&mesh, box, 4); // 16 * (1 + 2 + 3 + 4) / 16
        check_piece(&mesh, 9.999, 10.001);
        tl_sample_stairs(&mesh, box, 1);
        check_piece(&mesh, 15.999, 16.001);
        tl_sample_pillar(&mesh, tl_vec3_make(0, 0, 0), 1.0f, 2.0f, 8); // a little less than 2 pi
        check_piece(&mesh, 6.2, 6.2832);
        tl_sample_arch(&mesh, tl_vec3_make(0, 0, 0), 1.0f, 2.0f, 1.0f, 32); // a little less than 3 pi / 2
        check_piece(&mesh, 4.68, 4.7124);
        tl_sample_rock(&mesh, tl_vec3_make(4, 0, 0), 1.0f, 3, 9);
        check_piece(&mesh, 1.0, 4.1888);
    }
}

static void test_carving(void **state)
{
    (void)state;
    tl_sample_mesh mesh = { 0 };
    tl_sample_carving wall = { 0 };
    tl_sample_carving_add(&wall, 0, 0, 0, 4, 3, 0.25f);
    tl_sample_carving_cut(&wall, 1, 0, 0, 2, 2, 0.25f);
    tl_sample_carving_cut(&wall, 3, 1, -1, 3.5f, 2, 1);
    tl_sample_carving_finish(&wall, NULL, &mesh);
    check_piece(&mesh, 2.3749, 2.3751); // 3 - 0.5 - 0.125

    // Two halves of a corridor in rock meet at their windows, and together are closed: a volume of -2 * 8.
    tl_sample_carving rock = { 0 };
    rock.rock_outside = true;
    for (unsigned half = 0; half < 2; ++half) {
        tl_aabb window = tl_sample_bounds(-4, 0, -4, 4, 0, 4);
        tl_sample_place(&mesh, tl_vec3_make(half ? 8.0f : 0.0f, 0, 0), 2 * half);
        tl_sample_carving_cut(&rock, 2, 0, -1, 4, 2, 1);
        tl_sample_carving_finish(&rock, &window, &mesh);
        if (half == 0) {
            TEST_CHECK(count_open_edges(&mesh) == 4);
        }
    }
    check_piece(&mesh, -16.001, -15.999);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reaches_the_size),
        cmocka_unit_test(test_grows_by_extent),
        cmocka_unit_test(test_too_small_gives_the_smallest),
        cmocka_unit_test(test_golden),
        cmocka_unit_test(test_closed_levels_are_closed),
        cmocka_unit_test(test_no_flat_triangle),
        cmocka_unit_test(test_pieces),
        cmocka_unit_test(test_carving),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
