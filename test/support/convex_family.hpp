// SPDX-License-Identifier: MIT
//
// The fourteen families of shapes that distance, depth and casts are compared over, and what is known of a pair without
// the library: a brute force in double where both cores are polyhedra, flat or thin; else the separation along any
// direction, from supports of its own.

#ifndef TALUS_TEST_CONVEX_FAMILY_HPP
#define TALUS_TEST_CONVEX_FAMILY_HPP

#include <algorithm>
#include <cmath>
#include <vector>

// C headers that do not say so themselves; the last, since cmocka takes the word fail from the standard headers.
extern "C" {
#include "convex_oracle.h"
}

enum family {
    family_box,
    family_sphere, // a hull of points on a sphere
    family_needle, // 1000 : 1
    family_plate,  // 1000 : 1
    family_prism,
    family_cloud, // hulls of real clouds where there are some, else of points in a ball
    family_flat,  // a convex polygon, as points
    family_point,
    family_segment,
    family_triangle,
    family_ball, // a point with a radius
    family_capsule,
    family_cylinder,
    family_cone,
    family_count
};

inline const char *family_name(int f)
{
    static const char *const names[] = { "box",   "sphere",  "needle",   "plate", "prism",   "cloud",    "flat",
                                         "point", "segment", "triangle", "ball",  "capsule", "cylinder", "cone" };
    return names[f];
}

// Clouds of the data folder whose hulls are small enough for the brute force.
struct cloud_list {
    std::vector<std::vector<tl_vec3>> clouds;

    cloud_list()
    {
        shape_each_cloud(TALUS_DATA_DIR "/hulls/hulls_dev.txt", add, this);
    }

    static void add(tl_vec3 *points, uint32_t count, void *user)
    {
        auto *list = static_cast<cloud_list *>(user);
        tl_hull *hull = nullptr;
        if (list->clouds.size() < 500 && count <= 120 &&
            tl_hull_bake(points, count, nullptr, &hull, nullptr) == TL_OK) {
            if (hull->vertex_count <= 40) {
                list->clouds.emplace_back(points, points + count);
            }
            tl_blob_free(hull);
        }
    }
};

struct family_body {
    family kind;
    tl_hull *hull = nullptr;
    std::vector<tl_vec3> points; // of the core, where it is not a hull; of a cylinder or cone both ends
    float disc = 0, radius = 0, size = 0;
    tl_convex shape;

    family_body(family f, test_random &random, float scale, const cloud_list &clouds) : kind(f)
    {
        tl_vec3 zero = tl_vec3_make(0, 0, 0), end = tl_scale(test_random_direction(&random), scale);
        float wide = scale * test_random_range(&random, 0.1f, 1);
        switch (f) {
        case family_box:
            make_box(test_random_point(&random, tl_scale(tl_vec3_make(1, 0.1f, 0.1f), scale),
                                       tl_scale(tl_vec3_make(1, 1, 1), scale)));
            break;
        case family_cloud:
            make_cloud(random, scale, clouds);
            break;
        case family_flat:
            make_flat(random, scale);
            break;
        case family_point:
        case family_ball:
            points = { zero };
            radius = f == family_ball ? scale : 0;
            shape = tl_convex_sphere(zero, radius);
            size = scale;
            break;
        case family_segment:
        case family_capsule:
            points = { tl_neg(end), end };
            radius = f == family_capsule ? wide : 0;
            shape = tl_convex_capsule(points[0], points[1], radius);
            size = 2 * scale + 2 * radius;
            break;
        case family_triangle:
            points = { end, tl_scale(test_random_direction(&random), scale), tl_neg(end) };
            shape = tl_convex_triangle(points[0], points[1], points[2], 0);
            size = 2 * scale;
            break;
        case family_cylinder:
        case family_cone:
            points = { tl_neg(end), end };
            disc = wide;
            shape = f == family_cylinder ? tl_convex_cylinder(points[0], points[1], disc, 0)
                                         : tl_convex_cone(points[0], points[1], disc, 0);
            size = 2 * scale;
            break;
        default:
            make_hull(f, random, scale);
        }
    }
    ~family_body()
    {
        tl_blob_free(hull);
    }
    family_body(const family_body &) = delete;
    family_body &operator=(const family_body &) = delete;

    bool is_round() const
    {
        return disc > 0;
    }

  private:
    void use_hull(std::vector<tl_vec3> &cloud)
    {
        TEST_RESULT(tl_hull_bake(cloud.data(), (uint32_t)cloud.size(), nullptr, &hull, nullptr), TL_OK);
        shape = tl_convex_from_hull(hull, 0);
        tl_vec3 extents = tl_aabb_size(hull->bounds);
        size = std::max(extents.x, std::max(extents.y, extents.z));
    }
    // The shape is a box of its own kind; the hull is for the brute force.
    void make_box(tl_vec3 half)
    {
        std::vector<tl_vec3> corners;
        for (int i = 0; i < 8; i++) {
            corners.push_back(
                tl_vec3_make(i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z));
        }
        use_hull(corners);
        shape = tl_convex_box(tl_vec3_make(0, 0, 0), half, 0);
    }
    void make_hull(family f, test_random &random, float scale)
    {
        shape_kind kinds[] = { SHAPE_SPHERE, SHAPE_SPHERE, SHAPE_NEEDLE, SHAPE_PLATE, SHAPE_PRISM };
        std::vector<tl_vec3> cloud(f == family_prism ? 2 * (3 + test_random_below(&random, 8)) : 24);
        shape_make(kinds[f], &random, cloud.data(), (uint32_t)cloud.size());
        for (tl_vec3 &p : cloud) {
            p = tl_scale(p, scale * (f == family_needle || f == family_plate ? 1e-3f : 1.0f));
        }
        use_hull(cloud);
    }
    void make_cloud(test_random &random, float scale, const cloud_list &clouds)
    {
        std::vector<tl_vec3> cloud(32);
        if (clouds.clouds.empty()) {
            shape_make(SHAPE_BALL, &random, cloud.data(), (uint32_t)cloud.size());
        } else {
            cloud = clouds.clouds[test_random_below(&random, (uint32_t)clouds.clouds.size())];
            // Where it lies in its own frame stays; its size becomes the others'.
            tl_aabb box = { cloud[0], cloud[0] };
            for (tl_vec3 p : cloud) {
                box.min = tl_min(box.min, p);
                box.max = tl_max(box.max, p);
            }
            scale *= 2 / tl_length(tl_aabb_size(box));
        }
        for (tl_vec3 &p : cloud) {
            p = tl_scale(p, scale);
        }
        use_hull(cloud);
    }
    void make_flat(test_random &random, float scale)
    {
        uint32_t count = 3 + test_random_below(&random, 9);
        for (uint32_t i = 0; i < count; i++) {
            tl_vec3 p = shape_on_ring(i, count);
            points.push_back(tl_scale(tl_vec3_make(p.x, 0, 0.5f * p.z), scale));
        }
        shape = tl_convex_from_points(points.data(), count, 0);
        size = 2 * scale;
    }
};

// A body in the world, in double.
struct placed_body {
    const family_body *body;
    oracle_body core; // of what is not round
    tl_vec3d ends[2];

    placed_body(const family_body &b, tl_transform pose) : body(&b)
    {
        if (b.is_round()) {
            ends[0] = oracle_transform(pose, b.points[0]);
            ends[1] = oracle_transform(pose, b.points[1]);
        } else if (b.hull != nullptr) {
            oracle_from_hull(&core, b.hull, pose);
        } else {
            oracle_from_points(&core, b.points.data(), (uint32_t)b.points.size(), pose);
        }
    }

    tl_vec3d core_support(tl_vec3d d) const
    {
        if (!body->is_round()) {
            return oracle_support(&core, d);
        }
        tl_vec3d axis = tl_vec3d_sub(ends[1], ends[0]);
        // Across the axis even where it is mere rounding.
        tl_vec3d across = tl_vec3d_cross(axis, tl_vec3d_cross(d, axis));
        double length = tl_vec3d_length(across);
        tl_vec3d rim = tl_vec3d_scale(across, length > 0 ? (double)body->disc / length : 0);
        tl_vec3d first = tl_vec3d_add(ends[0], rim),
                 second = body->kind == family_cone ? ends[1] : tl_vec3d_add(ends[1], rim);
        return tl_vec3d_dot(d, first) > tl_vec3d_dot(d, second) ? first : second;
    }

    // How far a point lies outside, in metres; at least this.
    double outside(tl_vec3d p) const
    {
        tl_vec3d axis = tl_vec3d_sub(ends[1], ends[0]), from = tl_vec3d_sub(p, ends[0]);
        if (!body->is_round()) {
            oracle_body point;
            point.vertex_count = 1;
            point.edge_count = point.triangle_count = 0;
            point.solid = false;
            point.vertices[0] = p;
            return std::max(0.0, oracle_distance(&core, &point) - (double)body->radius);
        }
        double height = tl_vec3d_length(axis), z = tl_vec3d_dot(from, axis) / height;
        double r = tl_vec3d_length(tl_vec3d_mul_add(from, axis, -z / height)), disc = (double)body->disc;
        double along = std::max(-z, z - height);
        double side = body->kind == family_cone
                          ? (r * height + z * disc - disc * height) / std::sqrt(disc * disc + height * height)
                          : r - disc;
        return std::max(0.0, std::max(along, side));
    }
};

// How far the two are apart along a unit direction from A to B; negative: by how much they overlap.
inline double separation_along(const placed_body &a, const placed_body &b, tl_vec3d d)
{
    return tl_vec3d_dot(d, b.core_support(tl_vec3d_neg(d))) - tl_vec3d_dot(d, a.core_support(d)) -
           (double)a.body->radius - (double)b.body->radius;
}

// Signed distance by brute force. Neither is round.
inline double brute_separation(const placed_body &a, const placed_body &b)
{
    double radii = (double)a.body->radius + (double)b.body->radius;
    double apart = oracle_distance(&a.core, &b.core);
    // An edge that runs exactly through another one pierces no triangle next to it, in rounded arithmetic; so of what
    // touches to rounding the depth is asked, which is 0 then, or shows that it is more.
    if (apart > 1e-9 * (double)std::max(a.body->size, b.body->size)) {
        return apart - radii;
    }
    double depth = oracle_depth(&a.core, &b.core);
    return (depth < INFINITY ? -depth : 0) - radii; // no axis at all: points and parallel segments are 0 deep
}

// The largest separation along any of many directions, each then improved as far as it goes. Not above the signed
// distance, and where nothing is narrow equal to it.
inline double searched_separation(const placed_body &a, const placed_body &b, tl_vec3d guess, test_random &random)
{
    struct start {
        tl_vec3d d;
        double value;
    };
    std::vector<start> starts;
    auto add = [&](tl_vec3d d) {
        double length = tl_vec3d_length(d);
        if (length > 0) {
            d = tl_vec3d_scale(d, 1 / length);
            starts.push_back({ d, separation_along(a, b, d) });
            starts.push_back({ tl_vec3d_neg(d), separation_along(a, b, tl_vec3d_neg(d)) });
        }
    };
    for (int i = 0; i < 300; i++) {
        add(tl_vec3d_from(test_random_direction(&random)));
    }
    for (const placed_body *p : { &a, &b }) {
        const placed_body &q = p == &a ? b : a;
        tl_vec3d axis = p->body->is_round() ? tl_vec3d_sub(p->ends[1], p->ends[0]) : tl_vec3d_make(0, 0, 0);
        add(axis);
        for (uint32_t t = 0; !p->body->is_round() && t < p->core.triangle_count; t++) {
            const tl_vec3d *v = p->core.vertices;
            const uint32_t *i = p->core.triangles + 3 * t;
            add(tl_vec3d_cross(tl_vec3d_sub(v[i[1]], v[i[0]]), tl_vec3d_sub(v[i[2]], v[i[0]])));
        }
        for (uint32_t e = 0; !q.body->is_round() && p->body->is_round() && e < q.core.edge_count; e++) {
            tl_vec3d edge =
                tl_vec3d_sub(q.core.vertices[q.core.edges[2 * e + 1]], q.core.vertices[q.core.edges[2 * e]]);
            add(tl_vec3d_cross(axis, edge));
            add(tl_vec3d_cross(edge, tl_vec3d_cross(axis, edge)));
        }
    }
    std::sort(starts.begin(), starts.end(), [](const start &x, const start &y) { return x.value > y.value; });
    starts.resize(std::min<size_t>(starts.size(), 12));
    add(guess);
    double best = -INFINITY;
    for (start &s : starts) {
        for (double step = 0.2; step > 1e-9; step *= 0.5) {
            for (int tries = 0, all = 0; tries < 12 && all < 200; tries++, all++) {
                tl_vec3d d = tl_vec3d_mul_add(s.d, tl_vec3d_from(test_random_direction(&random)), step);
                d = tl_vec3d_scale(d, 1 / tl_vec3d_length(d));
                double value = separation_along(a, b, d);
                if (value > s.value) {
                    s = { d, value };
                    tries = 0;
                }
            }
        }
        best = std::max(best, s.value);
    }
    return best;
}

#endif
