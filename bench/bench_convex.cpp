// SPDX-License-Identifier: MIT
//
// Pairs of convex shapes, nanoseconds a query, one thread: apart, coherent with a cache, shallow and deep penetration,
// casts and rays. Bullet and libccd answer the same queries in the same process where they are installed.
//
//   bench_convex [--json FILE] [N...]      hulls of N points on a sphere; by default 8 .. 1024
//
// A figure is the best of several repetitions in CPU time over the same pairs; the libraries take turns, so that what
// slows the machine slows all. Beside it stands the fraction of wrong answers: a wrong decision, or a length that
// misses talus's proven bounds by more than 1e-4 of the size. Casts are wrong when they miss what the bounds of the
// distance prove to be hit, or are later or earlier than 1e-4 of the size.

#include "base/random.h"
#include "bench_options.h"
#include "measure.h"
#include "report.h"

#include <talus/convex.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#ifdef TALUS_HAVE_BULLET
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#endif
#ifdef TALUS_HAVE_CCD
#include <ccd/ccd.h>
#endif

namespace
{

constexpr int pair_count = 96, steps = 16;

double now()
{
    return 1e9 * bench_thread_seconds();
}

uint64_t random_state = 1;

float random_unit()
{
    return tl_random_unit_float(&random_state);
}

tl_vec3 random_direction()
{
    for (;;) {
        float x = 2 * random_unit() - 1, y = 2 * random_unit() - 1, z = 2 * random_unit() - 1;
        tl_vec3 d = tl_vec3_make(x, y, z);
        if (tl_length_sq(d) > 0.01f && tl_length_sq(d) < 1.0f) {
            return tl_normalize(d);
        }
    }
}

tl_quat random_rotation()
{
    tl_vec3 a = random_direction();
    tl_quat q = { a.x, a.y, a.z, 2 * random_unit() - 1 };
    return tl_quat_normalize(q);
}

struct shape {
    tl_hull *hull;
    tl_convex convex;
    std::vector<tl_vec3> points;
#ifdef TALUS_HAVE_BULLET
    btConvexHullShape *bullet;
#endif
};

shape make_shape(int count)
{
    shape s;
    for (int i = 0; i < count; i++) {
        s.points.push_back(random_direction());
    }
    if (tl_hull_bake(s.points.data(), (uint32_t)count, nullptr, &s.hull, nullptr) != TL_OK) {
        std::fprintf(stderr, "no hull\n");
        std::exit(1);
    }
    s.convex = tl_convex_from_hull(s.hull, 0.0f);
#ifdef TALUS_HAVE_BULLET
    s.bullet = new btConvexHullShape(&s.points[0].x, count, (int)sizeof(tl_vec3));
    s.bullet->setMargin(0);
#endif
    return s;
}

struct query {
    shape *a, *b;
    tl_transform pose_a, pose_b;
    tl_vec3 motion;
};

// The answer of one library to one query: signed distance, or the time of a cast, 2 when it misses.
using ask = float (*)(const query &q, int warm);

enum kind { kind_distance, kind_overlap, kind_cast, kind_ray };

struct truth {
    double low, high; // signed distance
    bool hit;
    double t_low, t_high;
};

tl_simplex_cache caches[pair_count];

float talus_distance(const query &q, int warm)
{
    tl_separation s;
    tl_convex_distance(&q.a->convex, q.pose_a, &q.b->convex, q.pose_b, warm >= 0 ? &caches[warm] : nullptr, &s);
    return s.distance;
}

float talus_penetration(const query &q, int)
{
    tl_penetration p;
    return tl_convex_penetration(&q.a->convex, q.pose_a, &q.b->convex, q.pose_b, nullptr, &p) ? -p.depth : 0.0f;
}

float talus_overlap(const query &q, int)
{
    return tl_convex_overlap(&q.a->convex, q.pose_a, &q.b->convex, q.pose_b, nullptr) ? -1.0f : 1.0f;
}

float talus_cast(const query &q, int)
{
    tl_convex_hit hit;
    return tl_convex_cast(&q.a->convex, q.pose_a, &q.b->convex, q.pose_b, q.motion, &hit) ? hit.t : 2.0f;
}

// B's origin is the ray's; it goes where B goes.
float talus_ray(const query &q, int)
{
    tl_convex_hit hit;
    return tl_convex_cast_ray(&q.a->convex, q.pose_a, q.pose_b.position, q.motion, 1.0f, &hit) ? hit.t : 2.0f;
}

#ifdef TALUS_HAVE_BULLET
btTransform bullet_transform(tl_transform t)
{
    return btTransform(btQuaternion(t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w),
                       btVector3(t.position.x, t.position.y, t.position.z));
}

float bullet_distance(const query &q, int)
{
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver epa;
    btGjkPairDetector detector(q.a->bullet, q.b->bullet, &simplex, &epa);
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = bullet_transform(q.pose_a);
    input.m_transformB = bullet_transform(q.pose_b);
    btPointCollector output;
    detector.getClosestPoints(input, output, nullptr);
    return output.m_hasResult ? (float)output.m_distance : 1e9f;
}

float bullet_cast(const query &q, int)
{
    btVoronoiSimplexSolver simplex;
    btGjkEpaPenetrationDepthSolver epa;
    btContinuousConvexCollision cast(q.a->bullet, q.b->bullet, &simplex, &epa);
    btTransform a = bullet_transform(q.pose_a), from = bullet_transform(q.pose_b), to = from;
    to.setOrigin(from.getOrigin() + btVector3(q.motion.x, q.motion.y, q.motion.z));
    btConvexCast::CastResult result;
    result.m_fraction = 1;
    return cast.calcTimeOfImpact(a, a, from, to, result) ? (float)result.m_fraction : 2.0f;
}

// As its world does it: a cast of a point.
float bullet_ray(const query &q, int)
{
    btSphereShape point(0);
    point.setMargin(0);
    btVoronoiSimplexSolver simplex;
    btSubsimplexConvexCast cast(&point, q.a->bullet, &simplex);
    btTransform from = btTransform::getIdentity(), a = bullet_transform(q.pose_a);
    from.setOrigin(btVector3(q.pose_b.position.x, q.pose_b.position.y, q.pose_b.position.z));
    btTransform to = from;
    to.setOrigin(from.getOrigin() + btVector3(q.motion.x, q.motion.y, q.motion.z));
    btConvexCast::CastResult result;
    result.m_fraction = 1;
    return cast.calcTimeOfImpact(from, to, a, a, result) ? (float)result.m_fraction : 2.0f;
}
#endif

#ifdef TALUS_HAVE_CCD
struct ccd_shape {
    const shape *s;
    tl_transform pose;
};

// libccd has no shapes of its own: as its examples do, a scan.
void ccd_support(const void *object, const ccd_vec3_t *direction, ccd_vec3_t *out)
{
    const ccd_shape *o = (const ccd_shape *)object;
    tl_vec3 d = tl_inverse_rotate(o->pose.rotation,
                                  tl_vec3_make((float)direction->v[0], (float)direction->v[1], (float)direction->v[2]));
    const tl_vec3 *best = &o->s->points[0];
    float best_dot = tl_dot(*best, d);
    for (const tl_vec3 &p : o->s->points) {
        float dot = tl_dot(p, d);
        if (dot > best_dot) {
            best_dot = dot;
            best = &p;
        }
    }
    tl_vec3 p = tl_transform_point(o->pose, *best);
    ccdVec3Set(out, (double)p.x, (double)p.y, (double)p.z);
}

ccd_t ccd_settings()
{
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = ccd.support2 = ccd_support;
    ccd.max_iterations = 100;
    ccd.epa_tolerance = 1e-5;
    return ccd;
}

float ccd_overlap(const query &q, int)
{
    ccd_t ccd = ccd_settings();
    ccd_shape a = { q.a, q.pose_a }, b = { q.b, q.pose_b };
    return ccdGJKIntersect(&a, &b, &ccd) ? -1.0f : 1.0f;
}

float ccd_penetration(const query &q, int)
{
    ccd_t ccd = ccd_settings();
    ccd_shape a = { q.a, q.pose_a }, b = { q.b, q.pose_b };
    ccd_real_t depth;
    ccd_vec3_t direction, position;
    return ccdGJKPenetration(&a, &b, &ccd, &depth, &direction, &position) == 0 ? -(float)depth : 1e9f;
}
#endif

// Vertex against vertex along a random direction, `gap` apart.
query place(shape *a, shape *b, float gap)
{
    query q = { a, b, { random_rotation(), random_direction() }, { random_rotation(), { 0, 0, 0 } }, { 0, 0, 0 } };
    tl_vec3 n = random_direction();
    uint32_t va = tl_hull_support(a->hull, tl_inverse_rotate(q.pose_a.rotation, n), TL_NO_VERTEX);
    uint32_t vb = tl_hull_support(b->hull, tl_inverse_rotate(q.pose_b.rotation, tl_neg(n)), TL_NO_VERTEX);
    tl_vec3 end = tl_transform_point(q.pose_a, tl_hull_vertices(a->hull)[va]);
    tl_vec3 begin = tl_rotate(q.pose_b.rotation, tl_hull_vertices(b->hull)[vb]);
    q.pose_b.position = tl_mul_add(tl_sub(end, begin), n, gap);
    q.motion = tl_add(tl_scale(tl_sub(q.pose_a.position, q.pose_b.position), 1.5f), tl_scale(random_direction(), 0.5f));
    return q;
}

// The time of impact between bounds: the distance of the shapes at a time proves what is before it.
truth find_truth(const query &q, kind k)
{
    truth t = { 0, 0, false, 0, 0 };
    tl_separation s;
    tl_penetration p;
    tl_convex point = tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.0f), *moving = k == kind_ray ? &point : &q.b->convex;
    if (k == kind_distance) {
        tl_convex_distance(&q.a->convex, q.pose_a, &q.b->convex, q.pose_b, nullptr, &s);
        tl_convex_penetration(&q.a->convex, q.pose_a, &q.b->convex, q.pose_b, nullptr, &p);
        t.low = s.overlap ? -(double)p.upper_bound : (double)s.lower_bound;
        t.high = s.overlap ? -(double)p.lower_bound : (double)s.distance;
        return t;
    }
    // Advance by the lower bound of the distance over the speed: slow, and needs no cast.
    double time = 0, speed = (double)tl_length(q.motion);
    for (int i = 0; i < 4000 && time <= 1.0; i++) {
        query moved = q;
        moved.pose_b.position = tl_mul_add(q.pose_b.position, q.motion, (float)time);
        tl_convex_distance(&q.a->convex, moved.pose_a, moving, moved.pose_b, nullptr, &s);
        if (s.overlap || s.lower_bound < 2e-6f) {
            t.hit = true;
            t.t_low = t.t_high = time;
            return t;
        }
        time += (double)s.lower_bound / speed;
    }
    return t;
}

bool is_wrong(const truth &t, float answer, kind k)
{
    const double slack = 2e-4; // 1e-4 of a size of two
    switch (k) {
    case kind_overlap:
        return (answer < 0.0f) != (t.high <= 0.0);
    case kind_cast:
    case kind_ray:
        return (answer <= 1.0f) != t.hit || (t.hit && std::fabs((double)answer - t.t_low) > slack);
    default:
        return !((double)answer >= t.low - slack && (double)answer <= t.high + slack);
    }
}

// One library's answer to a query, and how it did.
struct contender {
    const char *name;
    ask answer;
    kind k;
    bool warm;
    double ns, wrong; // share
};

void measure(const std::vector<query> &queries, const std::vector<truth> &truths, std::vector<contender> &all)
{
    for (contender &c : all) {
        c.ns = 1e30;
        size_t wrong = 0;
        for (size_t i = 0; i < queries.size(); i++) {
            wrong += is_wrong(truths[i], c.answer(queries[i], -1), c.k);
        }
        c.wrong = (double)wrong / (double)queries.size();
    }
    for (int repetition = 0; repetition < 9; repetition++) {
        for (contender &c : all) {
            std::memset(caches, 0, sizeof caches);
            double begin = now();
            volatile float sink = 0;
            for (size_t i = 0; i < queries.size(); i++) {
                sink = sink + c.answer(queries[i], c.warm ? (int)(i / steps) : -1);
            }
            c.ns = std::fmin(c.ns, (now() - begin) / (double)queries.size());
        }
    }
}

struct scene {
    const char *title;
    float gap;
    kind k;
};

std::vector<contender> contenders_of(const scene &s)
{
    std::vector<contender> all;
    auto add = [&](const char *name, ask answer, kind k, bool warm) { all.push_back({ name, answer, k, warm, 0, 0 }); };
    bool apart = s.gap > 0.0f;
    if (s.k == kind_cast) {
        add("talus", talus_cast, kind_cast, false);
    } else if (s.k == kind_ray) {
        add("talus", talus_ray, kind_ray, false);
    } else {
        add("talus", apart ? talus_distance : talus_penetration, kind_distance, false);
        if (apart) {
            add("talus cached", talus_distance, kind_distance, true);
        }
        add("talus overlap", talus_overlap, kind_overlap, false);
    }
#ifdef TALUS_HAVE_BULLET
    add("Bullet", s.k == kind_cast ? bullet_cast : s.k == kind_ray ? bullet_ray : bullet_distance, s.k, false);
#endif
#ifdef TALUS_HAVE_CCD
    if (s.k == kind_distance) {
        add("libccd overlap", ccd_overlap, kind_overlap, false);
        if (!apart) {
            add("libccd", ccd_penetration, kind_distance, false);
        }
    }
#endif
    return all;
}

std::vector<query> queries_of(const scene &s, std::vector<shape> &shapes, std::vector<truth> *truths)
{
    std::vector<query> queries;
    for (int i = 0; i < pair_count; i++) {
        query q = place(&shapes[(size_t)(2 * i) % shapes.size()], &shapes[(size_t)(2 * i + 1) % shapes.size()], s.gap);
        tl_quat turn = { 0, 0.0087265f, 0, 0.9999619f }; // one degree
        for (int step = 0; step < steps; step++) {
            q.pose_b.rotation = tl_quat_normalize(tl_quat_mul(q.pose_b.rotation, turn));
            truth t = find_truth(q, s.k);
            // A depth is asked of pairs that overlap.
            if (s.gap > 0.0f || t.high < 0.0) {
                queries.push_back(q);
                truths->push_back(t);
            }
        }
    }
    return queries;
}

// The largest ratio of a scene's time to another contender's; 0: nothing is claimed.
double limit_of(const scene &s, int count, const std::string &name, const std::string &other)
{
    if (name == "talus cached") {
        return other == "talus" ? 0.6 : 0;
    }
    if (name == "talus overlap") {
        return other == "libccd overlap" ? 1.0 : 0;
    }
    if (name != "talus" || other != "Bullet") {
        return 0;
    }
    switch (s.k) {
    case kind_cast:
        return 0.3;
    case kind_ray:
        return 0;
    default:
        return s.gap < 0.0f ? 0.5 : count == 8 ? 0.6 : count == 32 ? 0.4 : count == 256 ? 0.15 : 0;
    }
}

void claim(bench_report *report, const scene &s, int count, const std::vector<contender> &all)
{
    std::string place = std::string(s.title) + ", N = " + std::to_string(count) + ": ";
    for (const contender &c : all) {
        for (const contender &other : all) {
            double limit = limit_of(s, count, c.name, other.name);
            if (limit > 0) {
                bench_report_speed(report, (place + c.name).c_str(), other.name, other.ns / c.ns, 1.0 / limit);
            }
        }
        if (std::strncmp(c.name, "talus", 5) == 0) {
            bench_report_at_most(report, (place + c.name + ", wrong answers").c_str(), c.wrong, 0);
        }
    }
}

void run(bench_report *report, const scene &s, int count, std::vector<shape> &shapes)
{
    std::vector<truth> truths;
    std::vector<query> queries = queries_of(s, shapes, &truths);
    std::vector<contender> all = contenders_of(s);
    measure(queries, truths, all);
    for (const contender &c : all) {
        std::printf("%5d  %-18s %-15s %8.0f ns  %5.1f%% wrong ", count, s.title, c.name, c.ns, 100 * c.wrong);
        for (const contender &other : all) {
            double limit = limit_of(s, count, c.name, other.name);
            if (limit > 0) {
                std::printf("  %.2f times as fast as %s (bar %.2g)", other.ns / c.ns, other.name, 1.0 / limit);
            }
        }
        std::printf("\n");
        bench_report_point(report, s.title, c.name, count, c.ns);
    }
    claim(report, s, count, all);
}

} // namespace

int main(int argc, char **argv)
{
    const bench_option options[] = { { nullptr, BENCH_COUNT, nullptr, nullptr } };
    std::vector<const char *> words((size_t)argc);
    const char *json = nullptr;
    words.resize((size_t)bench_parse(argc, argv, options, words.data(), &json));
    bench_report *report = bench_report_new("convex", "ns a query", "points of each hull");
    std::vector<int> counts = { 8, 32, 64, 128, 256, 1024 };
    if (!words.empty()) {
        counts.clear();
    }
    for (const char *word : words) {
        counts.push_back(std::max(4, std::atoi(word)));
    }
    const scene scenes[] = { { "apart, 0.5", 0.5f, kind_distance },
                             { "penetrating, 0.1", -0.1f, kind_distance },
                             { "deep, 0.8", -0.8f, kind_distance },
                             { "cast", 1.0f, kind_cast },
                             { "ray", 1.0f, kind_ray } };
    for (int count : counts) {
        std::vector<shape> shapes;
        for (int i = 0; i < 16; i++) {
            shapes.push_back(make_shape(count));
        }
        for (const scene &s : scenes) {
            run(report, s, count, shapes);
        }
        for (shape &s : shapes) {
            tl_blob_free(s.hull);
#ifdef TALUS_HAVE_BULLET
            delete s.bullet;
#endif
        }
    }
    bench_report_print_claims(report);
    return bench_report_close(report, json);
}
