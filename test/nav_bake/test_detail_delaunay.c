// SPDX-License-Identifier: MIT
//
// The detail mesh's triangulation: valid at every step, Delaunay, samples in their triangles.

#include "talus_test.h"

#include "nav_bake/detail/detail.h"

#include <string.h>

enum { MAX_POINTS = 400, MAX_SAMPLES = 300 };

typedef struct rig {
    tl_detail_mesh mesh;
    tl_detail_point points[MAX_POINTS];
    tl_detail_triangle triangles[2 * MAX_POINTS];
    uint32_t triangle_of[MAX_POINTS], next_sample[MAX_SAMPLES], changed[2 * MAX_POINTS + 4], stack[MAX_POINTS + 4];
    tl_detail_point samples[MAX_SAMPLES];
} rig;

static void rig_init(rig *r)
{
    memset(r, 0, sizeof *r);
    r->mesh.points = r->points;
    r->mesh.triangles = r->triangles;
    r->mesh.triangle_of = r->triangle_of;
    r->mesh.samples = r->samples;
    r->mesh.next_sample = r->next_sample;
    r->mesh.changed = r->changed;
    r->mesh.stack = r->stack;
}

// A convex polygon with `count` corners, strictly convex, in the polygons' winding.
static uint32_t make_polygon(test_random *random, tl_detail_point *points, uint32_t wanted)
{
    // Steps sorted by direction make a convex outline.
    static const int steps[16][2] = { { 0, 5 },   { 1, 4 },  { 2, 3 },  { 3, 3 },  { 4, 2 },  { 5, 1 },
                                      { 5, 0 },   { 4, -1 }, { 3, -3 }, { 1, -4 }, { 0, -5 }, { -2, -4 },
                                      { -3, -2 }, { -5, 0 }, { -4, 1 }, { -2, 3 } };
    int32_t x = 0, z = 0;
    uint32_t count = 0;
    bool use[16] = { false };
    for (uint32_t k = 0; k < 16; k++) {
        use[k] = test_random_below(random, 16) < wanted;
    }
    for (uint32_t k = 0; k < 16; k++) {
        if (use[k]) {
            tl_detail_point p = { x, z, (int32_t)test_random_below(random, 50) };
            points[count++] = p;
            x += steps[k][0] * (int32_t)(1024 * (1 + test_random_below(random, 20)));
            z += steps[k][1] * (int32_t)(1024 * (1 + test_random_below(random, 20)));
        }
    }
    return count; // the last edge closes it; the caller checks that it is convex
}

static bool is_convex(const tl_detail_point *p, uint32_t count)
{
    for (uint32_t k = 0; k < count; k++) {
        for (uint32_t j = 0; j < count; j++) {
            if (j != k && j != (k + 1) % count && tl_detail_orient(&p[k], &p[(k + 1) % count], &p[j]) <= 0) {
                return false;
            }
        }
    }
    return count >= 3;
}

static int64_t doubled_area(const rig *r)
{
    int64_t area2 = 0;
    for (uint32_t t = 0; t < r->mesh.triangle_count; t++) {
        const uint32_t *c = r->triangles[t].corner;
        area2 += tl_detail_orient(&r->points[c[0]], &r->points[c[1]], &r->points[c[2]]);
    }
    return area2;
}

static double in_circle(const tl_detail_point *a, const tl_detail_point *b, const tl_detail_point *c,
                        const tl_detail_point *d)
{
    const tl_detail_point *p[3] = { a, b, c };
    long double x[3], z[3], lift[3], sum = 0, size = 0;
    for (int k = 0; k < 3; k++) {
        x[k] = (long double)p[k]->x - d->x;
        z[k] = (long double)p[k]->z - d->z;
        lift[k] = x[k] * x[k] + z[k] * z[k];
    }
    for (int k = 0; k < 3; k++) {
        int l = (k + 1) % 3, m = (k + 2) % 3;
        sum += lift[k] * (x[m] * z[l] - x[l] * z[m]);
        size += lift[k] * (fabsl(x[m] * z[l]) + fabsl(x[l] * z[m]));
    }
    return size > 0 ? (double)(sum / size) : 0;
}

// Orientation, links both ways, area, and that no neighbour's far corner is inside a triangle's circle.
static void check_mesh(const rig *r, int64_t area2)
{
    const tl_detail_mesh *m = &r->mesh;
    uint32_t outline = 0;
    TEST_CHECK(doubled_area(r) == area2);
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        const tl_detail_triangle *tri = &m->triangles[t];
        TEST_CHECK(
            tl_detail_orient(&m->points[tri->corner[0]], &m->points[tri->corner[1]], &m->points[tri->corner[2]]) > 0);
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t other = tri->across[k];
            if (other == TL_DETAIL_NONE) {
                outline++;
                continue;
            }
            const tl_detail_triangle *o = &m->triangles[other];
            uint32_t j = 0;
            while (j < 3 && o->across[j] != t) {
                j++;
            }
            TEST_CHECK(j < 3 && o->corner[j] == tri->corner[(k + 1) % 3] && o->corner[(j + 1) % 3] == tri->corner[k]);
            TEST_CHECK(in_circle(&m->points[tri->corner[0]], &m->points[tri->corner[1]], &m->points[tri->corner[2]],
                                 &m->points[o->corner[(j + 2) % 3]]) < 1e-14);
        }
        for (uint32_t s = tri->first_sample; s != TL_DETAIL_NONE; s = m->next_sample[s]) {
            for (uint32_t k = 0; k < 3; k++) {
                TEST_CHECK(tl_detail_orient(&m->points[tri->corner[k]], &m->points[tri->corner[(k + 1) % 3]],
                                            &m->samples[s]) >= 0);
            }
        }
    }
    TEST_CHECK(m->triangle_count == 2 * m->point_count - outline - 2);
    for (uint32_t p = 0; p < m->point_count; p++) {
        const uint32_t *c = m->triangles[m->triangle_of[p]].corner;
        TEST_CHECK(c[0] == p || c[1] == p || c[2] == p);
    }
}

static uint32_t count_samples(const tl_detail_mesh *m)
{
    uint32_t count = 0;
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        for (uint32_t s = m->triangles[t].first_sample; s != TL_DETAIL_NONE; s = m->next_sample[s]) {
            count++;
        }
    }
    return count;
}

static void grows_point_by_point(void **state)
{
    (void)state;
    test_random random = { 2718 };
    uint32_t polygons = 0, on_edges = 0, inside = 0, on_outline = 0;
    static rig r;
    for (int round = 0; round < 400; round++) {
        rig_init(&r);
        uint32_t corners = make_polygon(&random, r.points, 3 + test_random_below(&random, 12));
        if (!is_convex(r.points, corners)) {
            continue;
        }
        polygons++;
        tl_detail_start(&r.mesh, corners);
        int64_t area2 = doubled_area(&r);
        check_mesh(&r, area2);
        // Points on the outline: quarters of each edge.
        for (uint32_t k = 0; k < corners; k++) {
            tl_detail_point a = r.points[k], b = r.points[(k + 1) % corners];
            uint32_t before = k;
            for (int32_t step = 1; step < 4; step++) {
                if (test_random_below(&random, 2) == 0 || (b.x - a.x) % 4 != 0 || (b.z - a.z) % 4 != 0) {
                    continue;
                }
                tl_detail_point p = { a.x + (b.x - a.x) / 4 * step, a.z + (b.z - a.z) / 4 * step, 7 };
                r.points[r.mesh.point_count++] = p;
                tl_detail_insert_on_outline(&r.mesh, before);
                r.mesh.changed_count = 0;
                before = r.mesh.point_count - 1;
                on_outline++;
                check_mesh(&r, area2);
            }
        }
        // Samples on a coarse grid, so that many lie on edges and circles.
        uint32_t samples = 0, t = 0;
        for (int tries = 0; tries < 2000 && samples < MAX_SAMPLES; tries++) {
            tl_detail_point p = { (int32_t)test_random_below(&random, 200) * 2048 - 40 * 2048,
                                  (int32_t)test_random_below(&random, 200) * 2048 - 100 * 2048, 3 };
            bool in = true, taken = false;
            for (uint32_t k = 0; k < corners; k++) {
                in = in && tl_detail_orient(&r.points[k], &r.points[(k + 1) % corners], &p) > 0;
            }
            for (uint32_t s = 0; s < samples; s++) {
                taken |= r.samples[s].x == p.x && r.samples[s].z == p.z;
            }
            if (in && !taken) {
                r.samples[samples] = p;
                t = tl_detail_locate(&r.mesh, &p, t);
                r.next_sample[samples] = r.triangles[t].first_sample;
                r.triangles[t].first_sample = samples++;
            }
        }
        check_mesh(&r, area2);
        // Samples become points, in order.
        for (uint32_t s = 0; s < samples && r.mesh.point_count < MAX_POINTS; s++) {
            t = tl_detail_locate(&r.mesh, &r.samples[s], 0);
            uint32_t *link = NULL;
            for (uint32_t u = 0; u < r.mesh.triangle_count && link == NULL; u++) {
                for (uint32_t *l = &r.triangles[u].first_sample; *l != TL_DETAIL_NONE; l = &r.next_sample[*l]) {
                    if (*l == s) {
                        link = l;
                        t = u;
                        break;
                    }
                }
            }
            TEST_CHECK(link != NULL);
            *link = r.next_sample[s];
            uint32_t before = r.mesh.triangle_count;
            for (int k = 0; k < 3; k++) {
                on_edges += tl_detail_orient(&r.points[r.triangles[t].corner[k]],
                                             &r.points[r.triangles[t].corner[(k + 1) % 3]], &r.samples[s]) == 0;
            }
            r.points[r.mesh.point_count++] = r.samples[s];
            r.mesh.changed_count = 0;
            tl_detail_insert_inside(&r.mesh, t);
            inside++;
            TEST_CHECK(r.mesh.triangle_count == before + 2);
            TEST_CHECK(count_samples(&r.mesh) == samples - s - 1);
            if (s % 16 == 0) {
                check_mesh(&r, area2);
            }
        }
        check_mesh(&r, area2);
    }
    TEST_CHECK(polygons > 100 && on_outline > 300 && inside > 5000 && on_edges > 200);
}

// The largest polygon that is taken: areas and side tests stay exact.
static void largest_extent(void **state)
{
    (void)state;
    static rig r;
    rig_init(&r);
    int32_t far = TL_DETAIL_MAX_EXTENT * TL_DETAIL_ONE - 1; // 2^30, less what keeps it in an int32_t with room
    tl_detail_point square[4] = { { 0, 0, 0 }, { 0, far, 0 }, { far, far, 0 }, { far, 0, 0 } };
    memcpy(r.points, square, sizeof square);
    tl_detail_start(&r.mesh, 4);
    int64_t area2 = 2 * (int64_t)far * far;
    check_mesh(&r, area2);
    tl_detail_point inner[3] = { { far / 2, far / 2, 0 }, { 1, 1, 0 }, { far - 1, 2, 0 } };
    for (int k = 0; k < 3; k++) {
        uint32_t t = tl_detail_locate(&r.mesh, &inner[k], 0);
        r.points[r.mesh.point_count++] = inner[k];
        r.mesh.changed_count = 0;
        tl_detail_insert_inside(&r.mesh, t);
        check_mesh(&r, area2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grows_point_by_point),
        cmocka_unit_test(largest_extent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
