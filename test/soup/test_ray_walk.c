// SPDX-License-Identifier: MIT
//
// ray_walk.inl in each of its compilations: all bits equal over instruction sets, and equal to a loop over all
// triangles, both in the soup's own arithmetic and, independently, in double from the source mesh.
//
// An argument raises the number of rays a model: test_ray_walk 100000.

#include "ray_without_tree.h"
#include "soup/ray/ray_job.h"
#include "soup_models.h"

#include <float.h>

static uint32_t rays_asked = 0;

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

// The closest hit by the same decision for every lane of every leaf, without the tree and the float filters.
static bool search_without_tree(const tl_soup *soup, tl_vec3 origin, tl_vec3 target, bool is_segment, float tmax,
                                tl_ray_job *job)
{
    job->soup = soup;
    job->filter = NULL;
    job->is_segment = is_segment;
    job->t = tmax;
    if (!tl_ray_prepare(job, origin, target)) {
        return false;
    }
    return test_decide_all_lanes(soup, job);
}

static bool cast_without_tree(const tl_soup *soup, const tl_ray *ray, tl_ray_job *job)
{
    return search_without_tree(soup, ray->origin, ray->direction, false, ray->tmax, job);
}

typedef struct double_answer {
    bool hit;
    bool unsure; // a sign was too close for double
    double t;
    double t_error;
} double_answer;

// The closest hit over the source triangles by triple products in double.
static double_answer cast_in_double(const model *m, const tl_ray *ray)
{
    double_answer best = { false, false, (double)ray->tmax, 0 };
    double ox = (double)ray->origin.x, oy = (double)ray->origin.y, oz = (double)ray->origin.z;
    double dx = (double)ray->direction.x, dy = (double)ray->direction.y, dz = (double)ray->direction.z;
    double dmax = fabs(dx) + fabs(dy) + fabs(dz);
    for (uint32_t i = 0; i < m->triangle_count; i++) {
        const uint32_t *corner = m->indices + 3 * (size_t)i;
        tl_vec3 a = m->vertices[corner[0]], b = m->vertices[corner[1]], c = m->vertices[corner[2]];
        double ax = (double)a.x - ox, ay = (double)a.y - oy, az = (double)a.z - oz;
        double bx = (double)b.x - ox, by = (double)b.y - oy, bz = (double)b.z - oz;
        double cx = (double)c.x - ox, cy = (double)c.y - oy, cz = (double)c.z - oz;
        // d x p for each corner, then its product with the next corner.
        double pax = dy * az - dz * ay, pay = dz * ax - dx * az, paz = dx * ay - dy * ax;
        double pbx = dy * bz - dz * by, pby = dz * bx - dx * bz, pbz = dx * by - dy * bx;
        double pcx = dy * cz - dz * cy, pcy = dz * cx - dx * cz, pcz = dx * cy - dy * cx;
        double w = pax * bx + pay * by + paz * bz;
        double u = pbx * cx + pby * cy + pbz * cz;
        double v = pcx * ax + pcy * ay + pcz * az;
        double size = fabs(ax) + fabs(ay) + fabs(az) + fabs(bx) + fabs(by) + fabs(bz) + fabs(cx) + fabs(cy) + fabs(cz);
        double error = 8 * 1.2e-16 * dmax * size * size;
        if ((u < -error || v < -error || w < -error) && (u > error || v > error || w > error)) {
            continue;
        }
        double nx = (by - ay) * (cz - az) - (bz - az) * (cy - ay);
        double ny = (bz - az) * (cx - ax) - (bx - ax) * (cz - az);
        double nz = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
        double across = nx * ax + ny * ay + nz * az, along = nx * dx + ny * dy + nz * dz;
        double t_error =
            64 * 1.2e-16 * size * size * size / fabs(along); // absolute; grazing triangles have a large one
        double t = across / along;
        bool unsure = fabs(u) <= error || fabs(v) <= error || fabs(w) <= error || fabs(t) <= t_error ||
                      fabs(t - (double)ray->tmax) <= t_error || !(t_error <= 1e-3 * fabs(t));
        if (unsure && t <= best.t + t_error) {
            best.unsure = true;
        }
        if (!unsure && t >= 0 && t <= best.t) {
            best.hit = true;
            best.t = t;
            best.t_error = t_error;
        }
    }
    return best;
}

typedef struct regimes {
    uint32_t rays, hit, miss, unsure, axis_parallel, brute, cut, denormal, saturated, cut_segments;
} regimes;

// Bits equal over all walks, and what they say.
static bool cast_with_all(const tl_soup *soup, const tl_ray *ray, tl_ray_hit *hit_out)
{
    tl_ray_hit first = { 0 };
    bool found = tl_soup_cast_ray_with(tl_ray_walk_scalar, soup, ray, NULL, &first);
    for (tl_ray_isa isa = TL_RAY_SCALAR; isa < TL_RAY_ISA_COUNT; isa++) {
        tl_ray_walk_fn *walk = tl_ray_walk_for(isa);
        if (walk != NULL) {
            tl_ray_hit hit = { 0 };
            TEST_CHECK(tl_soup_cast_ray_with(walk, soup, ray, NULL, &hit) == found);
            TEST_CHECK(memcmp(&hit, &first, sizeof hit) == 0);
            TEST_CHECK(tl_soup_occluded_with(walk, soup, ray, NULL) == found);
        }
    }
    tl_ray_hit chosen = { 0 };
    TEST_CHECK(tl_soup_cast_ray(soup, ray, NULL, &chosen) == found && memcmp(&chosen, &first, sizeof first) == 0);
    *hit_out = first;
    return found;
}

static tl_ray random_ray(test_random *random, const model *m, tl_aabb bounds, uint32_t i)
{
    tl_vec3 size = tl_aabb_size(bounds);
    tl_vec3 low = tl_mul_add(bounds.min, size, -0.2f), high = tl_mul_add(bounds.max, size, 0.2f);
    tl_ray ray = { test_random_point(random, low, high), test_random_direction(random), INFINITY };
    if (i % 4 == 1) { // toward a corner or an edge
        const uint32_t *corner = m->indices + 3 * (size_t)test_random_below(random, m->triangle_count);
        float s = i % 8 == 1 ? 0 : test_random_unit(random);
        ray.direction = tl_sub(tl_lerp(m->vertices[corner[0]], m->vertices[corner[1]], s), ray.origin);
    } else if (i % 4 == 2) { // parallel to an axis, now and then through a vertex
        float sign = i % 8 == 2 ? 1.0f : -1.0f;
        uint32_t axis = test_random_below(random, 3);
        ray.direction = vec(axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : -0.0f);
        if (i % 16 < 8) {
            tl_vec3 v = m->vertices[m->indices[test_random_below(random, 3 * m->triangle_count)]];
            ray.origin = tl_sub(v, tl_mul(ray.direction, size));
        }
    } else if (i % 16 == 3) { // far away
        ray.origin = tl_mul_add(tl_aabb_center(bounds), ray.direction, -25 * tl_length(size));
    } else if (i % 16 == 7) {
        ray.tmax = tl_length(size) * 0.2f;
    }
    return ray;
}

static void check_model(const model *m, uint32_t ray_count, uint64_t seed, regimes *seen)
{
    test_random random = { seed };
    tl_soup_def def = tl_default_soup_def();
    tl_soup *soup = model_soup(m, &def);
    // The same answers however it is stored, with pairs and without.
    enum { OTHERS = 2 * MODEL_STORAGES };
    tl_soup *others[OTHERS];
    for (uint32_t k = 0; k < OTHERS; k++) {
        def = model_soup_def((model_storage)(k / 2));
        def.pair_triangles = k % 2 == 0;
        others[k] = model_soup(m, &def);
    }
    tl_aabb bounds = tl_soup_bounds(soup);
    for (uint32_t i = 0; i < ray_count; i++) {
        tl_ray ray = random_ray(&random, m, bounds, i);
        tl_ray_hit hit;
        bool found = cast_with_all(soup, &ray, &hit);
        for (uint32_t k = 0; k < OTHERS; k++) {
            tl_ray_hit other = { 0 };
            bool same = k / 2 == MODEL_COMPACT ? cast_with_all(others[k], &ray, &other)
                                               : tl_soup_cast_ray(others[k], &ray, NULL, &other);
            TEST_CHECK(same == found);
            TEST_CHECK(!found || memcmp(&hit, &other, sizeof hit) == 0);
            TEST_CHECK(tl_soup_occluded(others[k], &ray, NULL) == found);
        }
        double_answer truth = cast_in_double(m, &ray);
        if (truth.unsure) {
            seen->unsure++;
        } else {
            TEST_CHECK(found == truth.hit);
            // Half an ulp and an eighth of our own, and the error of this test's t.
            TEST_CHECK(!found || fabs((double)hit.t - truth.t) <= truth.t_error + 1.2e-7 * truth.t);
        }
        if (truth.unsure || i % 16 == 0) {
            tl_ray_job job;
            TEST_CHECK(cast_without_tree(soup, &ray, &job) == found);
            TEST_CHECK(!found || (job.t == hit.t && job.triangle == hit.triangle));
            seen->brute++;
        }
        seen->rays++;
        seen->hit += found;
        seen->miss += !found;
        seen->axis_parallel += i % 4 == 2;
    }
    seen->cut += tl_soup_get_stats(others[2 * MODEL_SPLITS]).reference_count >
                 tl_soup_get_stats(others[2 * MODEL_BOXES]).reference_count;
    tl_blob_free(soup);
    for (uint32_t k = 0; k < OTHERS; k++) {
        tl_blob_free(others[k]);
    }
}

static void test_generated_models(void **state)
{
    (void)state;
    regimes seen = { 0 };
    uint32_t rays = rays_asked != 0 ? rays_asked : 3000;
    model m = model_random(1500, 10, 2, 1);
    check_model(&m, rays, 1, &seen);
    model_free(&m);
    m = model_random(700, 1e-6f, 1e-6f, 2);
    check_model(&m, rays, 2, &seen);
    model_free(&m);
    m = model_random(700, 1e9f, 3e8f, 3);
    check_model(&m, rays, 3, &seen);
    model_free(&m);
    m = model_ball(4, 0.05f, 0.05f, vec(0, 0, 0), 4);
    check_model(&m, rays, 4, &seen);
    model_free(&m);
    m = model_terrain(24, 2, vec(5000, 0, -5000), 5);
    check_model(&m, rays, 5, &seen);
    model_free(&m);
    m = model_terrain(24, 0, vec(0, 0, 0), 6); // flat ground: everything in one plane but the boxes
    check_model(&m, rays, 6, &seen);
    model_free(&m);
    for (uint32_t count = 1; count <= 400; count += count < 20 ? 1 : 10) { // every shape of small tree
        m = model_random(count, 3, count < 20 ? 2.0f : 0.7f, 100 + count);
        check_model(&m, 200, count, &seen);
        model_free(&m);
    }
    print_message("rays %u, hits %u, misses %u, too close for double %u, axis-parallel %u, without tree %u\n",
                  seen.rays, seen.hit, seen.miss, seen.unsure, seen.axis_parallel, seen.brute);
    TEST_CHECK(seen.hit > 8000 && seen.miss > 5000 && seen.axis_parallel > 4000 && seen.brute > 1000);
    TEST_CHECK(seen.cut > 10);
    TEST_CHECK(seen.unsure > 500 && seen.unsure < seen.rays / 2);
}

// Layers of triangles on a lattice, in random order, so that a ray meets many of them at the same t: at every size down
// to denormals, with directions of every length, the tree and its filters must leave the lowest index.
static void check_scaled(int size, uint32_t ray_count, uint64_t seed, regimes *seen)
{
    test_random random = { seed };
    model m = { 0 };
    for (uint32_t i = 0; i < 360; i++) {
        uint32_t first = m.vertex_count;
        for (uint32_t k = 0; k < 3; k++) {
            float x = (float)test_random_below(&random, 17), z = (float)test_random_below(&random, 17);
            float y = i % 8 == 0 ? (float)test_random_below(&random, 9) : (float)(i % 4);
            model_vertex(&m, ldexpf(x, size), ldexpf(y, size), ldexpf(z, size));
        }
        model_triangle(&m, first, first + 1, first + 2);
    }
    tl_soup *soup = model_soup(&m, NULL);
    tl_soup_def def = model_soup_def(MODEL_COMPACT);
    tl_soup *compact = model_soup(&m, &def);
    for (uint32_t i = 0; i < ray_count; i++) {
        static const float limits[4] = { INFINITY, INFINITY, FLT_MAX, 12.0f };
        int length = (int)test_random_below(&random, i % 4 == 0 ? 260 : 121) - (i % 4 == 0 ? 140 : 60);
        float x = (float)test_random_below(&random, 33) * 0.5f, z = (float)test_random_below(&random, 33) * 0.5f;
        tl_ray ray = { vec(ldexpf(x, size), ldexpf(-3, size), ldexpf(z, size)), vec(0, ldexpf(1, length), 0),
                       i % 4 == 3 ? ldexpf(limits[3], size - length) : limits[i % 4] };
        if (i % 3 != 0) {
            ray.direction.x = ldexpf((float)test_random_below(&random, 9) - 4, length - (i % 3 == 1 ? 2 : 9));
            ray.direction.z = ldexpf((float)test_random_below(&random, 9) - 4, length - 3);
        }
        tl_ray_hit hit, small;
        tl_ray_job job;
        bool found = cast_with_all(soup, &ray, &hit);
        TEST_CHECK(cast_without_tree(soup, &ray, &job) == found);
        if (found && (job.t != hit.t || job.triangle != hit.triangle)) {
            fail_msg("size 2^%d, direction 2^%d: t %a of %u, without the tree %a of %u", size, length, (double)hit.t,
                     hit.triangle, (double)job.t, job.triangle);
        }
        TEST_CHECK(cast_with_all(compact, &ray, &small) == found && memcmp(&small, &hit, sizeof hit) == 0);
        tl_vec3 end = tl_add(ray.origin, vec(ldexpf(x - z, size - 4), ldexpf((float)(i % 8), size), 0));
        bool cut = search_without_tree(soup, ray.origin, end, true, 1.0f, &job);
        for (tl_ray_isa isa = TL_RAY_SCALAR; isa < TL_RAY_ISA_COUNT; isa++) {
            tl_ray_walk_fn *walk = tl_ray_walk_for(isa);
            tl_ray_hit at;
            TEST_CHECK(walk == NULL || tl_soup_cast_segment_with(walk, soup, ray.origin, end, NULL, &at) == cut);
            TEST_CHECK(walk == NULL || !cut || (at.t == job.t && at.triangle == job.triangle));
        }
        seen->cut_segments += cut;
        seen->rays++;
        seen->hit += found;
        seen->miss += !found;
        seen->denormal += found && hit.t > 0 && hit.t < FLT_MIN;
        seen->saturated += found && hit.t == FLT_MAX;
    }
    tl_blob_free(soup);
    tl_blob_free(compact);
    model_free(&m);
}

static void test_scales(void **state)
{
    (void)state;
    regimes seen = { 0 };
    for (int size = -149; size <= 34; size += size < -100 || size > 0 ? 5 : 2) {
        check_scaled(size, rays_asked != 0 ? rays_asked / 10 : 400, (uint64_t)(size + 200), &seen);
    }
    print_message("rays %u, hits %u, misses %u, t denormal %u, beyond FLT_MAX %u, segments that hit %u\n", seen.rays,
                  seen.hit, seen.miss, seen.denormal, seen.saturated, seen.cut_segments);
    TEST_CHECK(seen.hit > 10000 && seen.miss > 500 && seen.denormal > 100 && seen.saturated > 50);
    TEST_CHECK(seen.cut_segments > 5000 && seen.cut_segments < seen.rays / 10 * 9);
}

static bool accepts_high(uint32_t triangle, uint16_t material, void *user)
{
    (void)material;
    return triangle >= *(const uint32_t *)user;
}

// Segments to the surface itself, to before it and beyond it; with a filter that leaves only the copies.
static void check_segments(const model *m, const tl_soup *plain, const tl_soup *soup, regimes *seen)
{
    test_random random = { 11 };
    tl_aabb bounds = tl_soup_bounds(soup);
    uint32_t originals = m->triangle_count / 2;
    tl_ray_filter filters[2];
    memset(filters, 0, sizeof filters);
    filters[1].accept = accepts_high;
    filters[1].accept_user = &originals;
    for (uint32_t i = 0; i < 1500; i++) {
        const uint32_t *corner = m->indices + 3 * (size_t)test_random_below(&random, m->triangle_count);
        tl_vec3 a = test_random_point(&random, bounds.min, bounds.max);
        tl_vec3 b = tl_lerp(m->vertices[corner[0]], m->vertices[corner[i % 3]], test_random_unit(&random));
        b = i % 2 == 0 ? b : tl_lerp(a, b, test_random_unit(&random) * 2.0f);
        const tl_ray_filter *filter = i % 4 < 2 ? NULL : &filters[1];
        tl_ray_job job;
        job.filter = NULL;
        bool cut = search_without_tree(plain, a, b, true, 1.0f, &job);
        tl_ray_hit first = { 0 };
        bool met = tl_soup_cast_segment_with(tl_ray_walk_scalar, soup, a, b, filter, &first);
        TEST_CHECK(filter != NULL || met == cut);
        TEST_CHECK(filter != NULL || !cut || (first.t == job.t && first.triangle == job.triangle));
        TEST_CHECK(filter == NULL || !met || (cut && first.triangle >= originals && first.t >= job.t));
        for (tl_ray_isa isa = TL_RAY_SCALAR; isa < TL_RAY_ISA_COUNT; isa++) {
            tl_ray_walk_fn *walk = tl_ray_walk_for(isa);
            tl_ray_hit hit = { 0 };
            TEST_CHECK(walk == NULL || tl_soup_cast_segment_with(walk, soup, a, b, filter, &hit) == met);
            TEST_CHECK(walk == NULL || !met || memcmp(&hit, &first, sizeof hit) == 0);
            TEST_CHECK(walk == NULL || tl_soup_line_of_sight_with(walk, soup, a, b, filter) == !met);
        }
        TEST_CHECK(tl_soup_line_of_sight(soup, a, b, filter) == !met);
        seen->cut_segments += cut;
        seen->saturated += cut && job.t == 1.0f;
    }
}

// Coincident triangles, as two-sided walls and decals have: which of them is hit is decided by t and index alone.
static void test_coincident_triangles(void **state)
{
    (void)state;
    regimes seen = { 0 };
    model models[] = { model_terrain(24, 2, vec(0, 0, 0), 7), model_ball(4, 5, 0.2f, vec(900, 3, -20), 8),
                       model_random(300, 10, 4, 9) };
    for (uint32_t i = 0; i < sizeof models / sizeof models[0]; i++) {
        model_repeat_triangles(&models[i]);
        check_model(&models[i], rays_asked != 0 ? rays_asked : 2000, 50 + i, &seen);
        tl_soup *soup = model_soup(&models[i], NULL);
        tl_soup_def def = model_soup_def(MODEL_COMPACT);
        tl_soup *compact = model_soup(&models[i], &def);
        check_segments(&models[i], soup, soup, &seen);
        check_segments(&models[i], soup, compact, &seen);
        tl_blob_free(soup);
        tl_blob_free(compact);
        model_free(&models[i]);
    }
    print_message("rays %u, hits %u, segments that hit %u, at their end %u\n", seen.rays, seen.hit, seen.cut_segments,
                  seen.saturated);
    TEST_CHECK(seen.hit > 2000 && seen.cut_segments > 3000 && seen.saturated > 100);
}

static void test_levels(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < sizeof model_levels / sizeof model_levels[0]; i++) {
        model m = model_load(model_levels[i]);
        if (m.triangle_count > 0) {
            regimes seen = { 0 };
            uint32_t rays = rays_asked != 0 ? rays_asked : 20000000 / m.triangle_count;
            check_model(&m, rays < 20000 || rays_asked != 0 ? rays : 20000, i, &seen);
            print_message("%s: rays %u, hits %u, misses %u, too close for double %u, without tree %u\n",
                          model_levels[i], seen.rays, seen.hit, seen.miss, seen.unsure, seen.brute);
            TEST_CHECK(seen.hit > seen.rays / 10 && seen.miss > seen.rays / 20 && seen.unsure < seen.rays / 2);
        }
        model_free(&m);
    }
}

int main(int argc, char **argv)
{
    rays_asked = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 0;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_generated_models),
        cmocka_unit_test(test_scales),
        cmocka_unit_test(test_coincident_triangles),
        cmocka_unit_test(test_levels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
