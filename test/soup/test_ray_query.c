// SPDX-License-Identifier: MIT
//
// ray_query.c: what a ray hits, by example, against integer arithmetic, and without leaks.

#include "soup/ray/ray_job.h"
#include "soup_models.h"

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

static tl_ray make_ray(tl_vec3 origin, tl_vec3 direction, float tmax)
{
    tl_ray ray = { origin, direction, tmax };
    return ray;
}

static void test_hit_describes_place(void **state)
{
    (void)state;
    model m = model_one_triangle();
    tl_soup *soup = model_soup(&m, NULL);
    tl_ray ray = make_ray(vec(1, 3, 2), vec(0, -2, 0), 10);
    tl_ray_hit hit;
    TEST_CHECK(tl_soup_cast_ray(soup, &ray, NULL, &hit));
    TEST_CHECK(hit.t == 1.5f && hit.triangle == 0);
    TEST_CHECK(hit.u == 0.25f && hit.v == 0.5f);
    TEST_CHECK(hit.normal.x == 0 && hit.normal.y == -1 && hit.normal.z == 0);
    TEST_CHECK(hit.back && hit.material == 0);
    ray = make_ray(vec(1, -3, 2), vec(0, 1, 0), 10);
    TEST_CHECK(tl_soup_cast_ray(soup, &ray, NULL, &hit) && hit.t == 3 && !hit.back);
    tl_blob_free(soup);
    model_free(&m);
}

static bool hits(const tl_soup *soup, tl_vec3 origin, tl_vec3 direction, float tmax)
{
    tl_ray ray = make_ray(origin, direction, tmax);
    tl_ray_hit hit;
    bool closest = tl_soup_cast_ray(soup, &ray, NULL, &hit);
    TEST_CHECK(closest == tl_soup_occluded(soup, &ray, NULL));
    return closest;
}

static void test_ends_and_edges_are_inclusive(void **state)
{
    (void)state;
    model m = model_one_triangle();
    tl_soup *soup = model_soup(&m, NULL);
    tl_vec3 down = vec(0, -1, 0);
    TEST_CHECK(hits(soup, vec(0, 1, 0), down, 2)); // corners
    TEST_CHECK(hits(soup, vec(4, 1, 0), down, 2));
    TEST_CHECK(hits(soup, vec(0, 1, 4), down, 2));
    TEST_CHECK(hits(soup, vec(2, 1, 0), down, 2)); // edges
    TEST_CHECK(hits(soup, vec(0, 1, 2), down, 2));
    TEST_CHECK(hits(soup, vec(2, 1, 2), down, 2));
    float beside = nextafterf(2.0f, 3.0f);
    TEST_CHECK(!hits(soup, vec(beside, 1, 2), down, 2));
    TEST_CHECK(!hits(soup, vec(2, 1, -1e-38f), down, 2));
    TEST_CHECK(hits(soup, vec(1, 1, 1), down, 1)); // tmax
    TEST_CHECK(!hits(soup, vec(1, 1, 1), down, nextafterf(1, 0)));
    TEST_CHECK(hits(soup, vec(1, 0, 1), down, 0)); // origin on the surface
    TEST_CHECK(hits(soup, vec(1, 0, 1), down, INFINITY));
    TEST_CHECK(!hits(soup, vec(1, -1e-30f, 1), down, INFINITY)); // just behind
    TEST_CHECK(hits(soup, vec(1, 1e-30f, 1), down, INFINITY));
    TEST_CHECK(hits(soup, vec(1, 1, 1), vec(0, -1e-40f, 0), INFINITY)); // denormal direction
    TEST_CHECK(hits(soup, vec(1, 1, 1), vec(1e-40f, -1, 0), INFINITY));
    TEST_CHECK(hits(soup, vec(1, 1, 1), vec(-0.0f, -3e38f, 0), INFINITY));
    TEST_CHECK(hits(soup, vec(1, 3e38f, 1), down, INFINITY));       // far, far away
    TEST_CHECK(!hits(soup, vec(-1, 0, 1), vec(1, 0, 0), INFINITY)); // in the plane
    tl_blob_free(soup);
    model_free(&m);
}

static void test_what_hits_nothing(void **state)
{
    (void)state;
    model m = model_one_triangle();
    tl_soup *soup = model_soup(&m, NULL);
    TEST_CHECK(!hits(soup, vec(1, 1, 1), vec(0, 0, 0), INFINITY));
    TEST_CHECK(!hits(soup, vec(1, 1, 1), vec(0, -1, 0), -1));
    TEST_CHECK(!hits(soup, vec(1, 1, 1), vec(0, -1, 0), NAN));
    TEST_CHECK(!hits(soup, vec(NAN, 1, 1), vec(0, -1, 0), 9));
    TEST_CHECK(!hits(soup, vec(1, INFINITY, 1), vec(0, -1, 0), 9));
    TEST_CHECK(!hits(soup, vec(1, 1, 1), vec(0, -INFINITY, 0), 9));
    TEST_CHECK(!hits(soup, vec(1, 1, 1), vec(0, NAN, 0), 9));
    tl_ray_hit hit;
    TEST_CHECK(!tl_soup_cast_segment(soup, vec(1, 0, 1), vec(1, 0, 1), NULL, &hit));
    TEST_CHECK(tl_soup_line_of_sight(soup, vec(1, 0, 1), vec(1, 0, 1), NULL));
    tl_blob_free(soup);
    model_free(&m);
}

// A folded pair: both triangles lie above each other and share the edge along x = 0.
static void test_culling_and_folded_pair(void **state)
{
    (void)state;
    model m = { 0 };
    model_vertex(&m, 0, 0, 0);
    model_vertex(&m, 0, 0, 4);
    model_vertex(&m, 4, 0, 2);
    model_vertex(&m, 4, 1, 2);
    model_triangle(&m, 0, 1, 2); // front up
    model_triangle(&m, 1, 0, 3); // front down, above the first
    tl_soup *soup = model_soup(&m, NULL);
    TEST_CHECK(tl_soup_get_stats(soup).pair_count == 1);
    tl_ray down = make_ray(vec(2, 5, 2), vec(0, -1, 0), INFINITY);
    tl_ray_filter filter = { 0 };
    tl_ray_hit hit;
    TEST_CHECK(tl_soup_cast_ray(soup, &down, &filter, &hit) && hit.triangle == 1 && hit.t == 4.5f && hit.back);
    filter.cull = TL_RAY_CULL_BACK;
    TEST_CHECK(tl_soup_cast_ray(soup, &down, &filter, &hit) && hit.triangle == 0 && hit.t == 5 && !hit.back);
    filter.cull = TL_RAY_CULL_FRONT;
    TEST_CHECK(tl_soup_cast_ray(soup, &down, &filter, &hit) && hit.triangle == 1);
    tl_ray up = make_ray(vec(2, -5, 2), vec(0, 1, 0), INFINITY);
    TEST_CHECK(tl_soup_cast_ray(soup, &up, &filter, &hit) && hit.triangle == 0 && hit.back);
    filter.cull = TL_RAY_CULL_BACK;
    TEST_CHECK(tl_soup_cast_ray(soup, &up, &filter, &hit) && hit.triangle == 1 && !hit.back);
    down.tmax = 4.75f;
    TEST_CHECK(!tl_soup_occluded(soup, &down, &filter) && tl_soup_occluded(soup, &down, NULL));
    tl_blob_free(soup);
    model_free(&m);
}

static bool not_this_one(uint32_t triangle, uint16_t material, void *user)
{
    (void)material;
    return triangle != *(const uint32_t *)user;
}

static void test_masks_filters_and_ties(void **state)
{
    (void)state;
    model m = { 0 };
    uint16_t materials[6] = { 0, 3, 62, 63, 700, 5 };
    for (uint32_t i = 0; i < 6; i++) {
        float y = i < 5 ? (float)(5 - i) : 1.0f; // triangles 4 and 5 coincide
        uint32_t a = model_vertex(&m, 0, y, 0);
        model_vertex(&m, 4, y, 0);
        model_vertex(&m, 0, y, 4);
        model_triangle(&m, a, a + 1, a + 2);
    }
    tl_mesh_view view = model_view(&m);
    view.materials = materials;
    tl_soup *soup;
    TEST_RESULT(tl_soup_bake(&view, NULL, &soup, NULL), TL_OK);
    tl_ray ray = make_ray(vec(1, 9, 1), vec(0, -1, 0), INFINITY);
    tl_ray_filter filter = { 0 };
    tl_ray_hit hit;
    for (uint32_t i = 0; i < 5; i++) {
        TEST_CHECK(tl_soup_cast_ray(soup, &ray, &filter, &hit));
        TEST_CHECK(hit.triangle == i && hit.material == materials[i] && hit.t == 4 + (float)i);
        filter.ignored_materials |= 1ull << (materials[i] < 63 ? materials[i] : 63);
        if (i == 2) {
            break; // 63 and 700 share a bit
        }
    }
    TEST_CHECK(tl_soup_cast_ray(soup, &ray, &filter, &hit) && hit.triangle == 3);
    filter.ignored_materials |= 1ull << 63;
    TEST_CHECK(tl_soup_cast_ray(soup, &ray, &filter, &hit) && hit.triangle == 5);
    filter.ignored_materials = 0;
    uint32_t unwanted = 0;
    filter.accept = not_this_one;
    filter.accept_user = &unwanted;
    TEST_CHECK(tl_soup_cast_ray(soup, &ray, &filter, &hit) && hit.triangle == 1);
    // From below, 4 and 5 are met at the same t: the lower index wins, and the other when that is passed by.
    ray = make_ray(vec(1, 0, 1), vec(0, 1, 0), INFINITY);
    TEST_CHECK(tl_soup_cast_ray(soup, &ray, NULL, &hit) && hit.triangle == 4 && hit.t == 1);
    unwanted = 4;
    TEST_CHECK(tl_soup_cast_ray(soup, &ray, &filter, &hit) && hit.triangle == 5 && hit.t == 1);
    tl_blob_free(soup);
    model_free(&m);
}

// ------------------------------------------------------------------------------------------ integer oracle

typedef struct ivec {
    int64_t x, y, z;
} ivec;

static ivec isub(ivec a, ivec b)
{
    ivec r = { a.x - b.x, a.y - b.y, a.z - b.z };
    return r;
}

static ivec icross(ivec a, ivec b)
{
    ivec r = { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
    return r;
}

static int64_t idot(ivec a, ivec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static ivec ivec_of(tl_vec3 v)
{
    ivec r = { (int64_t)v.x, (int64_t)v.y, (int64_t)v.z };
    return r;
}

typedef struct regimes {
    uint32_t misses, inner, edge, corner, coplanar, at_origin, ties;
} regimes;

// Whether the ray meets the triangle, by its definition, in exact integers.
static bool integer_hit(ivec o, ivec d, const ivec v[3], float *t_out, regimes *seen)
{
    int64_t e[3];
    int zeros = 0, positive = 0, negative = 0;
    for (int k = 0; k < 3; k++) {
        e[k] = idot(d, icross(isub(v[(k + 1) % 3], o), isub(v[(k + 2) % 3], o)));
        zeros += e[k] == 0;
        positive += e[k] > 0;
        negative += e[k] < 0;
    }
    if (zeros == 3) {
        seen->coplanar++;
        return false;
    }
    if (positive && negative) {
        return false;
    }
    ivec n = icross(isub(v[1], v[0]), isub(v[2], v[0]));
    int64_t across = idot(n, isub(v[0], o)), along = idot(n, d);
    if ((across < 0 && along > 0) || (across > 0 && along < 0)) {
        return false;
    }
    seen->inner += zeros == 0;
    seen->edge += zeros == 1;
    seen->corner += zeros == 2;
    seen->at_origin += across == 0;
    *t_out = (float)fabs((double)across / (double)along);
    return true;
}

static tl_vec3 lattice_point(test_random *random, int range)
{
    float x = (float)((int)test_random_below(random, (uint32_t)(2 * range + 1)) - range);
    float y = (float)((int)test_random_below(random, (uint32_t)(2 * range + 1)) - range);
    float z = (float)((int)test_random_below(random, (uint32_t)(2 * range + 1)) - range);
    return tl_vec3_make(x, y, z);
}

// Coordinates are small integers, so edges, corners, planes and ties are met all the time, and int64 knows the truth.
// A filter counts on soups of one material too, which keep no array of it: 5, and all from 63 up under one bit.
static void test_one_material(void **state)
{
    (void)state;
    static const uint16_t kinds[] = { 0, 5, 63, 700 };
    const tl_vec3 corners[] = { { 0, 0, 0 }, { 0, 0, 4 }, { 4, 0, 0 } };
    const uint32_t indices[] = { 0, 1, 2 };
    for (uint32_t i = 0; i < 4; i++) {
        tl_mesh_view view = { corners, 3, indices, 1, &kinds[i] };
        tl_soup *soup;
        TEST_RESULT(tl_soup_bake(&view, NULL, &soup, NULL), TL_OK);
        tl_ray ray = make_ray(vec(1, 1, 1), vec(0, -1, 0), INFINITY);
        tl_ray_hit hits[4];
        tl_ray_filter filter = { .ignored_materials = ~(1ull << (kinds[i] < 63 ? kinds[i] : 63)) };
        TEST_CHECK(tl_soup_cast_ray(soup, &ray, &filter, &hits[0]) && hits[0].material == kinds[i]);
        tl_soup_cast_rays(soup, &ray, 1, &filter, NULL, hits);
        TEST_CHECK(hits[0].triangle == 0);
        filter.ignored_materials = ~filter.ignored_materials;
        TEST_CHECK(!tl_soup_cast_ray(soup, &ray, &filter, &hits[0]) && !tl_soup_occluded(soup, &ray, &filter));
        tl_soup_cast_rays(soup, &ray, 1, &filter, NULL, hits);
        TEST_CHECK(hits[0].triangle == TL_NO_TRIANGLE);
        filter.ignored_materials = 0;
        filter.cull = TL_RAY_CULL_FRONT;
        TEST_CHECK(!tl_soup_cast_ray(soup, &ray, &filter, &hits[0]));
        tl_blob_free(soup);
    }
}

static void test_lattice_against_integers(void **state)
{
    (void)state;
    test_random random = { 7 };
    regimes seen = { 0 };
    for (uint32_t round = 0; round < 300; round++) {
        int range = round % 3 == 0 ? 2 : round % 3 == 1 ? 8 : 64;
        model m = { 0 };
        uint32_t count = 1 + test_random_below(&random, 60);
        for (uint32_t i = 0; i < 3 * count / 2 + 3; i++) {
            tl_vec3 p = lattice_point(&random, range);
            model_vertex(&m, p.x, p.y, p.z);
        }
        for (uint32_t i = 0; i < count; i++) {
            model_triangle(&m, test_random_below(&random, m.vertex_count), test_random_below(&random, m.vertex_count),
                           test_random_below(&random, m.vertex_count));
        }
        tl_mesh_view view = model_view(&m);
        tl_soup *soup;
        tl_result result = tl_soup_bake(&view, NULL, &soup, NULL);
        TEST_CHECK(result == TL_OK || result == TL_ERR_DEGENERATE);
        for (uint32_t i = 0; result == TL_OK && i < 300; i++) {
            tl_vec3 from = lattice_point(&random, range + range / 2);
            tl_vec3 toward = i % 4 == 0 ? lattice_point(&random, 1) : lattice_point(&random, range);
            bool segment = i % 4 == 1;
            tl_vec3 direction = segment ? tl_sub(toward, from) : toward;
            float tmax = segment ? 1.0f : i % 2 == 0 ? INFINITY : 1.5f;
            float best_t = tmax;
            uint32_t best = UINT32_MAX;
            for (uint32_t k = 0; k < count && tl_length_sq(direction) > 0; k++) {
                const uint32_t *corner = m.indices + 3 * (size_t)k;
                ivec v[3] = { ivec_of(m.vertices[corner[0]]), ivec_of(m.vertices[corner[1]]),
                              ivec_of(m.vertices[corner[2]]) };
                float t;
                if (integer_hit(ivec_of(from), ivec_of(direction), v, &t, &seen) && t <= best_t) {
                    if (best == UINT32_MAX || t < best_t) {
                        best = k;
                    } else {
                        seen.ties++;
                    }
                    best_t = t;
                }
            }
            tl_ray ray = make_ray(from, direction, tmax);
            tl_ray_hit hit;
            bool found = segment ? tl_soup_cast_segment(soup, from, toward, NULL, &hit)
                                 : tl_soup_cast_ray(soup, &ray, NULL, &hit);
            TEST_CHECK(found == (best != UINT32_MAX));
            if (found && !(hit.t == best_t && hit.triangle == best)) {
                fail_msg("t %a triangle %u, expected %a triangle %u, segment %d", (double)hit.t, hit.triangle,
                         (double)best_t, best, segment);
            }
            if (segment) {
                TEST_CHECK(tl_soup_line_of_sight(soup, from, toward, NULL) == !found);
                TEST_CHECK(tl_soup_line_of_sight(soup, toward, from, NULL) == !found);
            } else {
                TEST_CHECK(tl_soup_occluded(soup, &ray, NULL) == found);
            }
            seen.misses += !found;
        }
        if (result == TL_OK) {
            tl_blob_free(soup);
        }
        model_free(&m);
    }
    TEST_CHECK(seen.misses > 10000 && seen.inner > 10000 && seen.edge > 10000 && seen.corner > 5000);
    TEST_CHECK(seen.coplanar > 10000 && seen.at_origin > 5000 && seen.ties > 5000);
}

// ------------------------------------------------------------------------------------------------- leaks

enum { AT_CORNER, AT_MIDDLE, AT_EDGE, AIMS };

typedef struct aimed {
    uint32_t inside[AIMS]; // from within the surface
    uint32_t far[AIMS];    // from 25 diagonals away
} aimed;

static void aim(const tl_soup *soup, tl_vec3 from, tl_vec3 at, uint32_t *count)
{
    tl_vec3 direction = tl_sub(at, from);
    if (tl_length_sq(direction) > 0) {
        TEST_CHECK(hits(soup, from, direction, INFINITY));
        (*count)++;
    }
}

// A line that passes through a ball within the surface must cross the surface.
static void aim_from_afar(const tl_soup *soup, test_random *random, tl_vec3 center, float ball, float diagonal,
                          tl_vec3 at, uint32_t *count)
{
    tl_vec3 outward = tl_normalize(tl_sub(at, center));
    tl_vec3 away = tl_normalize(tl_mul_add(outward, test_random_direction(random), 0.5f));
    tl_vec3 from = tl_mul_add(center, away, 25 * diagonal);
    tl_vec3 along = tl_normalize(tl_sub(at, from));
    if (tl_length(tl_cross(along, tl_sub(center, from))) < 0.9f * ball) {
        aim(soup, from, at, count);
    }
}

// From inside a closed surface every ray must hit, and so must those through its middle from afar: aimed at each
// corner, at edge midpoints and at random edge points.
static void test_closed_surface_has_no_leak(void **state)
{
    (void)state;
    test_random random = { 11 };
    static const struct {
        float radius, bump;
        float offset;
    } cases[] = { { 10, 0.05f, 0 },  { 0.05f, 0.05f, 0 }, { 10, 0.05f, 5000 }, { 1e-6f, 0.1f, 0 },
                  { 1e9f, 0.1f, 0 }, { 10, 0, 0 },        { 1, 0.3f, -700 } };
    aimed seen = { { 0 }, { 0 } };
    for (uint32_t c = 0; c < sizeof cases / sizeof cases[0]; c++) {
        float radius = cases[c].radius;
        tl_vec3 center = vec(cases[c].offset, cases[c].offset * 0.5f, -cases[c].offset);
        model m = model_ball(5, radius, cases[c].bump, center, c + 1);
        tl_soup *soup = model_soup(&m, NULL);
        float diagonal = tl_length(tl_aabb_size(tl_soup_bounds(soup)));
        // Its triangles are a thirtieth as wide as the surface, so they cut off less than a hundredth.
        float ball = radius * (0.98f - 1.1f * cases[c].bump);
        for (uint32_t i = 0; i < 3 * m.triangle_count; i++) {
            tl_vec3 inside =
                tl_mul_add(center, test_random_direction(&random), radius * test_random_range(&random, 0, 0.5f));
            tl_vec3 a = m.vertices[m.indices[i]];
            tl_vec3 b = m.vertices[m.indices[i % 3 == 2 ? i - 2 : i + 1]];
            tl_vec3 at[AIMS] = { a, tl_lerp(a, b, 0.5f), tl_lerp(a, b, test_random_unit(&random)) };
            for (uint32_t k = 0; k < AIMS; k++) {
                aim(soup, inside, at[k], &seen.inside[k]);
                aim_from_afar(soup, &random, center, ball, diagonal, at[k], &seen.far[k]);
            }
            aim(soup, center, a, &seen.inside[AT_CORNER]);
        }
        tl_blob_free(soup);
        model_free(&m);
    }
    print_message("leaks 0; aimed from inside at corners %u, middles of edges %u, edges %u; from 25 diagonals away %u, "
                  "%u, %u\n",
                  seen.inside[AT_CORNER], seen.inside[AT_MIDDLE], seen.inside[AT_EDGE], seen.far[AT_CORNER],
                  seen.far[AT_MIDDLE], seen.far[AT_EDGE]);
    for (uint32_t k = 0; k < AIMS; k++) {
        TEST_CHECK(seen.inside[k] > 150000 && seen.far[k] > 100000);
    }
}

typedef struct hit_set {
    uint32_t triangle[64];
    uint32_t count;
} hit_set;

static bool collect(uint32_t triangle, uint16_t material, void *user)
{
    (void)material;
    hit_set *set = user;
    for (uint32_t i = 0; i < set->count; i++) {
        if (set->triangle[i] == triangle) {
            return false;
        }
    }
    TEST_CHECK(set->count < 64);
    set->triangle[set->count++] = triangle;
    return false;
}

// A random line crosses a closed surface an even number of times. The filter sees every triangle and refuses it.
static void test_full_lines_cross_an_even_number_of_times(void **state)
{
    (void)state;
    test_random random = { 13 };
    model m = model_ball(5, 10, 0.2f, vec(0, 0, 0), 3);
    tl_soup *soup = model_soup(&m, NULL);
    uint32_t crossed = 0, twice = 0;
    for (uint32_t i = 0; i < 20000; i++) {
        tl_vec3 from = tl_scale(test_random_direction(&random), 30);
        tl_vec3 at = tl_scale(test_random_direction(&random), test_random_range(&random, 0, 13));
        hit_set set = { { 0 }, 0 };
        tl_ray_filter filter = { 0 };
        filter.accept = collect;
        filter.accept_user = &set;
        tl_ray ray = make_ray(from, tl_sub(at, from), INFINITY);
        TEST_CHECK(!tl_soup_occluded(soup, &ray, &filter));
        TEST_CHECK(set.count % 2 == 0);
        crossed += set.count > 0;
        twice += set.count > 2;
    }
    TEST_CHECK(crossed > 10000 && twice > 1000);
    tl_blob_free(soup);
    model_free(&m);
}

// Sight is symmetric, also where an end touches the surface: corners, and points computed to lie on triangles.
static void test_line_of_sight_is_symmetric(void **state)
{
    (void)state;
    test_random random = { 17 };
    model m = model_terrain(24, 3, vec(0, 0, 0), 5);
    tl_soup *soup = model_soup(&m, NULL);
    uint32_t seen = 0, blocked = 0;
    for (uint32_t i = 0; i < 60000; i++) {
        tl_vec3 end[2];
        for (uint32_t k = 0; k < 2; k++) {
            const uint32_t *corner = m.indices + 3 * (size_t)test_random_below(&random, m.triangle_count);
            tl_vec3 p = tl_lerp(m.vertices[corner[0]], m.vertices[corner[1]], test_random_unit(&random));
            p = tl_lerp(p, m.vertices[corner[2]], i % 5 == 0 ? 0.0f : test_random_unit(&random));
            end[k] = i % 2 == 0 || (i + k) % 3 == 0 ? test_random_point(&random, vec(0, 0, 0), vec(24, 12, 24)) : p;
        }
        bool sight = tl_soup_line_of_sight(soup, end[0], end[1], NULL);
        TEST_CHECK(sight == tl_soup_line_of_sight(soup, end[1], end[0], NULL));
        seen += sight;
        blocked += !sight;
    }
    TEST_CHECK(seen > 5000 && blocked > 5000);
    tl_blob_free(soup);
    model_free(&m);
}

static bool third(uint32_t triangle, uint16_t material, void *user)
{
    (void)material;
    (void)user;
    return triangle % 3 != 0;
}

// What a filter ignores is told by the float filters where they are sure of a hit, and else in double, as for all hits.
// Every order of corners, so that pairs are stored in all of theirs.
static void test_filters_of_sure_hits(void **state)
{
    (void)state;
    model m = model_ball(3, 4, 0.3f, vec(0, 0, 0), 1);
    uint16_t *materials = malloc(m.triangle_count * sizeof *materials);
    TEST_CHECK(materials != NULL);
    for (uint32_t i = 0; i < m.triangle_count; i++) {
        uint32_t *corner = m.indices + 3 * (size_t)i, kept[3] = { corner[0], corner[1], corner[2] };
        for (uint32_t k = 0; k < 3; k++) {
            corner[k] = kept[(i % 2 == 0 ? k + i : 2 * k + i) % 3]; // 1 in 2 runs the other way round
        }
        materials[i] = (uint16_t)(i % 5);
    }
    tl_ray_filter filters[5] = { 0 };
    filters[0].cull = TL_RAY_CULL_BACK;
    filters[1].cull = TL_RAY_CULL_FRONT;
    filters[2].ignored_materials = 0x15;
    filters[3].accept = third;
    filters[4] = (tl_ray_filter){ TL_RAY_CULL_BACK, 2, third, NULL };
    tl_mesh_view view = model_view(&m);
    view.materials = materials;
    for (model_storage storage = 0; storage < MODEL_STORAGES; storage++) {
        tl_soup_def def = model_soup_def(storage);
        tl_soup *soup = NULL;
        TEST_CHECK(tl_soup_bake(&view, &def, &soup, NULL) == TL_OK);
        test_random random = { 5 };
        uint32_t met = 0, missed = 0;
        for (uint32_t i = 0; i < 4000; i++) {
            tl_vec3 from = test_random_point(&random, vec(-6, -6, -6), vec(6, 6, 6));
            tl_ray ray = { from, test_random_direction(&random), i % 3 == 0 ? 5.0f : INFINITY };
            const tl_ray_filter *filter = &filters[i % 5];
            tl_ray_hit hit, first;
            uint32_t count;
            TEST_CHECK(!tl_is_error(tl_soup_cast_ray_all(soup, &ray, TL_HITS_TOUCHED, filter, &first, 1, &count)));
            for (tl_ray_isa isa = TL_RAY_SCALAR; isa < TL_RAY_ISA_COUNT; isa++) {
                tl_ray_walk_fn *walk = tl_ray_walk_for(isa);
                if (walk != NULL) {
                    bool found = tl_soup_cast_ray_with(walk, soup, &ray, filter, &hit);
                    TEST_CHECK(found == (count != 0) && tl_soup_occluded_with(walk, soup, &ray, filter) == found);
                    TEST_CHECK(!found ||
                               (hit.t == first.t && hit.triangle == first.triangle && hit.back == first.back));
                }
            }
            met += count != 0;
            missed += count == 0;
        }
        TEST_CHECK(met > 400 && missed > 400);
        tl_blob_free(soup);
    }
    free(materials);
    model_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hit_describes_place),
        cmocka_unit_test(test_ends_and_edges_are_inclusive),
        cmocka_unit_test(test_what_hits_nothing),
        cmocka_unit_test(test_culling_and_folded_pair),
        cmocka_unit_test(test_masks_filters_and_ties),
        cmocka_unit_test(test_filters_of_sure_hits),
        cmocka_unit_test(test_one_material),
        cmocka_unit_test(test_lattice_against_integers),
        cmocka_unit_test(test_closed_surface_has_no_leak),
        cmocka_unit_test(test_full_lines_cross_an_even_number_of_times),
        cmocka_unit_test(test_line_of_sight_is_symmetric),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
