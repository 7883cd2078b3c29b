// SPDX-License-Identifier: MIT
//
// Distance, depth, overlap and casts over fourteen families of shapes in all pairs and nine classes of gap, against
// brute force in double, with libccd and Bullet in the same table where they are installed.
//
//   test_convex_families [rounds]      each round takes other shapes and places, and another scale
//
// An answer is wrong when it says overlap of what is a millionth of the size apart, or the other way round, or when its
// length is off by more than a hundred-thousandth of the size; for the peers a ten-thousandth, and they are asked where
// the scale is 1 only, since their tolerances are absolute.

#include <cstdio>
#include <cstring>

#include "convex_peers.hpp"

namespace
{

constexpr double DECISION_SLACK = 1e-6, LENGTH_SLACK = 1e-5, PEER_SLACK = 1e-4, CAST_SLACK = 1e-4;
constexpr float scales[] = { 1.0f, 1e-3f, 1e3f, 3e-6f, 1e6f };
constexpr int scale_count = 5;

int rounds = 6;

struct tally {
    int cases = 0, overlaps = 0, wrong = 0, unended = 0, moved = 0;
    double error = 0;
    int peer_cases[2] = {}, peer_wrong[2] = {};

    void add(const tally &t)
    {
        cases += t.cases;
        overlaps += t.overlaps;
        wrong += t.wrong;
        unended += t.unended;
        moved += t.moved;
        error = std::max(error, t.error);
        for (int i = 0; i < 2; i++) {
            peer_cases[i] += t.peer_cases[i];
            peer_wrong[i] += t.peer_wrong[i];
        }
    }
};

struct query {
    const family_body *a, *b;
    tl_transform pose_a, pose_b;
    double size;
};

// The answer of the library: the signed distance, and its normal.
struct answer {
    tl_separation s;
    tl_penetration p;
    double value;
    tl_vec3d normal;
};

answer ask(const query &q)
{
    answer r;
    tl_convex_distance(&q.a->shape, q.pose_a, &q.b->shape, q.pose_b, nullptr, &r.s);
    tl_convex_penetration(&q.a->shape, q.pose_a, &q.b->shape, q.pose_b, nullptr, &r.p);
    r.value = r.s.overlap ? -(double)r.p.depth : (double)r.s.distance;
    r.normal = tl_vec3d_from(r.s.overlap ? r.p.normal : r.s.normal);
    return r;
}

// By how much the answer can be off. Where a shape is round: no direction parts them by more than the answer, its own
// normal parts them by that much, and the witnesses of a distance are points of the shapes.
double find_error(const query &q, const answer &r, const placed_body &a, const placed_body &b, test_random &random,
                  double *truth_out)
{
    if (!q.a->is_round() && !q.b->is_round()) {
        *truth_out = brute_separation(a, b);
        return std::fabs(r.value - *truth_out);
    }
    double length = tl_vec3d_length(r.normal);
    tl_vec3d normal = length > 0 ? tl_vec3d_scale(r.normal, 1 / length) : tl_vec3d_make(1, 0, 0);
    double along = separation_along(a, b, normal), best = along;
    if (r.s.overlap) {
        best = std::max(best, searched_separation(a, b, normal, random));
    }
    *truth_out = best;
    double error = std::max(std::fabs(r.value - along), best - r.value);
    if (!r.s.overlap) {
        tl_vec3d on_a = tl_vec3d_from(r.s.point_a), on_b = tl_vec3d_from(r.s.point_b);
        double apart = tl_vec3d_length(tl_vec3d_sub(on_a, on_b)) + a.outside(on_a) + b.outside(on_b);
        error = std::max(error, r.value - apart);
    }
    return error;
}

// The same bits at the origin and ten thousand sizes away, with B on a lattice that floats hold there too.
bool is_same_far_away(const query &q)
{
    query near = q, far = q;
    float unit = std::exp2(std::ceil(std::log2((float)q.size)));
    tl_vec3 d = tl_sub(q.pose_b.position, q.pose_a.position),
            offset = tl_scale(tl_vec3_make(16384, -16384, 8192), unit);
    near.pose_a.position = tl_vec3_make(0, 0, 0);
    near.pose_b.position =
        tl_scale(tl_vec3_make(std::rint(d.x / unit * 256), std::rint(d.y / unit * 256), std::rint(d.z / unit * 256)),
                 unit / 256);
    far.pose_a.position = offset;
    far.pose_b.position = tl_add(near.pose_b.position, offset);
    answer x = ask(near), y = ask(far);
    return std::memcmp(&x.value, &y.value, sizeof x.value) == 0 &&
           std::memcmp(&x.normal, &y.normal, sizeof x.normal) == 0;
}

void ask_peers(const query &q, const placed_body &a, const placed_body &b, double truth, tally *t)
{
    peer_body peer_a = { &a, tl_vec3d_from(q.pose_a.position) }, peer_b = { &b, tl_vec3d_from(q.pose_b.position) };
    auto judge = [&](int peer, const peer_answer &r) {
        bool wrong = r.overlap ? truth > DECISION_SLACK * q.size : truth < -DECISION_SLACK * q.size;
        wrong = wrong || (r.has_separation && !(std::fabs(r.separation - truth) <= PEER_SLACK * q.size));
        t->peer_cases[peer]++;
        t->peer_wrong[peer] += wrong;
    };
    (void)judge;
#ifdef TALUS_HAVE_CCD
    judge(0, ask_ccd(peer_a, peer_b, q.size));
#endif
#ifdef TALUS_HAVE_BULLET
    judge(1, ask_bullet(peer_a, peer_b, q.size));
#endif
}

tl_quat random_quarter_turn(test_random &random)
{
    static const tl_quat turns[] = { { 0, 0, 0, 1 }, { 1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 0, 0, 1, 1 } };
    return turns[test_random_below(&random, 4)]; // of any length: the library normalizes
}

// Turns both and moves b so that, along a direction, it begins `gap` behind where a ends. One in four pairs is turned
// by right angles and moved along an axis: faces lie on faces, edges on edges.
query place(const family_body &a, const family_body &b, gap_class gap, test_random &random)
{
    static const float gaps[] = { 0, -0.5f, -0.01f, 0, 1e-6f, 1e-4f, 1e-2f, 1, 100 };
    float size = std::max(a.size, b.size);
    query q = { &a, &b, {}, {}, (double)size };
    bool square = test_random_below(&random, 4) == 0;
    q.pose_a.rotation = square ? random_quarter_turn(random) : test_random_rotation(&random);
    q.pose_b.rotation = square ? random_quarter_turn(random) : test_random_rotation(&random);
    q.pose_a.position = q.pose_b.position = tl_scale(test_random_direction(&random), size);
    if (gap != GAP_CONCENTRIC) {
        placed_body pa(a, q.pose_a), pb(b, q.pose_b);
        tl_vec3d n = square ? tl_vec3d_make(0, 1, 0) : tl_vec3d_from(test_random_direction(&random));
        n = tl_vec3d_scale(n, 1 / tl_vec3d_length(n));
        double wanted = (double)(gaps[gap] * (gap <= GAP_SHALLOW ? std::min(a.size, b.size) : size));
        tl_vec3d move = tl_vec3d_scale(n, wanted - separation_along(pa, pb, n));
        q.pose_b.position = tl_vec3d_to_float(tl_vec3d_add(tl_vec3d_from(q.pose_b.position), move));
    }
    return q;
}

tally check(const query &q, bool with_peers, test_random &random)
{
    tally t;
    placed_body a(*q.a, q.pose_a), b(*q.b, q.pose_b);
    answer r = ask(q);
    double truth, error = find_error(q, r, a, b, random, &truth);
    t.cases = 1;
    t.overlaps = r.s.overlap;
    // Far apart distances and witnesses are floats too: three roundings of that are not counted.
    t.error = std::max(0.0, error - 4e-7 * std::fabs(truth)) / q.size;
    bool touch = tl_convex_overlap(&q.a->shape, q.pose_a, &q.b->shape, q.pose_b, nullptr);
    for (bool overlap : { r.s.overlap, r.p.overlap, touch }) {
        t.wrong += overlap ? truth > DECISION_SLACK * q.size : truth < -DECISION_SLACK * q.size;
    }
    t.wrong += t.error > LENGTH_SLACK;
    t.wrong += r.s.overlap ? (double)r.p.lower_bound > -truth + DECISION_SLACK * q.size
                           : (double)r.s.lower_bound > truth * (1 + 1e-7) + DECISION_SLACK * q.size;
    t.unended = r.s.status == TL_CONVEX_ITERATIONS || r.p.status == TL_CONVEX_ITERATIONS;
    t.moved = !is_same_far_away(q);
    if (with_peers) {
        ask_peers(q, a, b, truth, &t);
    }
    return t;
}

void print_share(const tally &t, int peer)
{
    if (t.peer_cases[peer] == 0) {
        std::printf("      -");
    } else {
        std::printf(" %5.1f%%", 100.0 * t.peer_wrong[peer] / t.peer_cases[peer]);
    }
}

void print_head(const char *first)
{
    std::printf("%-10s", first);
    for (const char *name : { "centre", "deep", "shallow", "touch", "1e-6", "1e-4", "1e-2", "1", "100" }) {
        std::printf(" %8s", name);
    }
}

void print_table(const tally table[family_count][GAP_COUNT])
{
    tally all, columns[GAP_COUNT];
    std::printf("largest error of a distance or a depth, in sizes; wrong answers\n");
    print_head("family");
    std::printf(" |  cases overlap | talus libccd Bullet\n");
    for (int f = 0; f < family_count; f++) {
        tally row;
        std::printf("%-10s", family_name(f));
        for (int gap = 0; gap < GAP_COUNT; gap++) {
            std::printf(" %8.1e", table[f][gap].error);
            row.add(table[f][gap]);
            columns[gap].add(table[f][gap]);
        }
        std::printf(" | %6d %7d | %5d", row.cases, row.overlaps, row.wrong);
        print_share(row, 0);
        print_share(row, 1);
        std::printf("\n");
        all.add(row);
    }
    for (int peer = 0; peer < 2; peer++) {
        std::printf("%-10s", peer == 0 ? "libccd" : "Bullet");
        for (const tally &column : columns) {
            std::printf("  ");
            print_share(column, peer);
        }
        std::printf(" | wrong\n");
    }
    std::printf("%d cases, %d overlap: %d wrong, %d did not end, %d differ far away; largest error %.1e; wrong:",
                all.cases, all.overlaps, all.wrong, all.unended, all.moved, all.error);
    print_share(all, 0);
    print_share(all, 1);
    std::printf("\n");
}

void test_all_pairs(void **)
{
    static tally table[family_count][GAP_COUNT];
    cloud_list clouds;
    test_random random = { 51 };
    tally all;
    for (int round = 0; round < rounds; round++) {
        float scale = scales[round % scale_count];
        for (int fa = 0; fa < family_count; fa++) {
            for (int fb = 0; fb < family_count; fb++) {
                family_body a((family)fa, random, scale, clouds), b((family)fb, random, scale, clouds);
                for (int gap = 0; gap < GAP_COUNT; gap++) {
                    query q = place(a, b, (gap_class)gap, random);
                    tally t = check(q, round % scale_count == 0, random);
                    if (t.wrong > 0 || t.unended > 0 || t.moved > 0) {
                        std::printf("wrong: %s, %s, gap class %d, round %d: error %.3g\n", family_name(fa),
                                    family_name(fb), gap, round, t.error);
                    }
                    table[fa][gap].add(t);
                    all.add(t);
                }
            }
        }
    }
    print_table(table);
    TEST_CHECK(all.wrong == 0 && all.unended == 0 && all.moved == 0);
    TEST_CHECK(all.cases == rounds * family_count * family_count * GAP_COUNT);
    TEST_CHECK(all.overlaps > all.cases / 6 && all.overlaps < all.cases / 2);
}

// When B, moving, is first within `near` metres of A: by steps that the distance proves to be free. Not below 0; 2 when
// it never is.
double find_impact(const query &q, tl_vec3 motion, double near)
{
    double speed = (double)tl_length(motion), t = 0;
    for (int i = 0; i < 2000 && t <= 1; i++) {
        tl_transform moved = q.pose_b;
        moved.position = tl_mul_add(moved.position, motion, (float)t);
        tl_separation s;
        tl_convex_distance(&q.a->shape, q.pose_a, &q.b->shape, moved, nullptr, &s);
        if (s.overlap || (double)s.lower_bound <= near) {
            return t;
        }
        t += (double)s.lower_bound / speed;
    }
    return t <= 1 ? t : 2;
}

struct cast_tally {
    int cases = 0, hits = 0, starts = 0, grazing = 0, wrong = 0, unended = 0;
    double error = 0;
};

// How near B comes to A along the motion is known from the distance, which the other test proves.
void check_cast(const query &q, tl_vec3 motion, cast_tally *t)
{
    tl_convex_hit hit;
    tl_convex_cast(&q.a->shape, q.pose_a, &q.b->shape, q.pose_b, motion, &hit);
    double first = find_impact(q, motion, DECISION_SLACK * q.size), speed = (double)tl_length(motion);
    t->cases++;
    t->hits += hit.hit;
    t->starts += hit.initial_overlap;
    t->unended += hit.status == TL_CONVEX_ITERATIONS;
    tl_transform there = q.pose_b;
    there.position = tl_mul_add(there.position, motion, hit.hit ? hit.t : 0);
    tl_separation s;
    tl_convex_distance(&q.a->shape, q.pose_a, &q.b->shape, there, nullptr, &s);
    if (!hit.hit) {
        // What passes within a few millionths of the size may be said to pass; what overlaps may not.
        tl_penetration p;
        double low = 0;
        for (int i = 0; i <= 64; i++) {
            there.position = tl_mul_add(q.pose_b.position, motion, (float)i / 64);
            tl_convex_penetration(&q.a->shape, q.pose_a, &q.b->shape, there, nullptr, &p);
            low = std::max(low, (double)p.lower_bound);
        }
        bool wrong = low > DECISION_SLACK * q.size;
        t->wrong += wrong;
        t->grazing += first <= 1 && !wrong;
        return;
    }
    // Hit: they touch there, and not before.
    bool touch = hit.initial_overlap ? s.overlap || (double)s.distance <= DECISION_SLACK * q.size
                                     : (double)s.distance <= 2 * DECISION_SLACK * q.size;
    double closing = hit.initial_overlap ? 1 : -(double)tl_dot(hit.normal, motion) / speed;
    double error = (first - (double)hit.t) * speed / q.size;
    t->wrong += !touch || first > 1;
    if (closing > 0.02) {
        t->wrong += std::fabs(error) > CAST_SLACK;
        t->error = std::max(t->error, std::fabs(error));
    } else {
        t->grazing++;
    }
}

void test_casts(void **)
{
    cloud_list clouds;
    test_random random = { 52 };
    cast_tally all;
    std::printf("casts: family, hits, overlaps at the start, grazing, wrong, largest error in sizes\n");
    for (int fa = 0; fa < family_count; fa++) {
        cast_tally row;
        for (int i = 0; i < rounds * family_count; i++) {
            float scale = scales[i / family_count % scale_count];
            family_body a((family)fa, random, scale, clouds), b((family)(i % family_count), random, scale, clouds);
            for (gap_class gap : { GAP_DEEP, GAP_TOUCHING, GAP_1E_4, GAP_1E_2, GAP_ONE, GAP_ONE }) {
                query q = place(a, b, gap, random);
                tl_vec3 toward = tl_sub(q.pose_a.position, q.pose_b.position);
                tl_vec3 aside = tl_scale(test_random_direction(&random), 0.5f * (float)q.size);
                tl_vec3 motion = tl_mul_add(aside, toward, test_random_range(&random, 0, 2));
                int wrong = row.wrong;
                check_cast(q, motion, &row);
                if (row.wrong > wrong) {
                    std::printf("wrong: %s, %s, gap class %d\n", family_name(fa), family_name(i % family_count), gap);
                }
            }
        }
        std::printf("%-10s %5d %5d %5d %5d %5d  %8.1e\n", family_name(fa), row.cases, row.hits, row.starts, row.grazing,
                    row.wrong, row.error);
        all.cases += row.cases;
        all.hits += row.hits;
        all.starts += row.starts;
        all.grazing += row.grazing;
        all.wrong += row.wrong;
        all.unended += row.unended;
        all.error = std::max(all.error, row.error);
    }
    std::printf("%d casts, %d hits, %d at the start, %d grazing: %d wrong, %d did not end, largest error %.1e\n",
                all.cases, all.hits, all.starts, all.grazing, all.wrong, all.unended, all.error);
    TEST_CHECK(all.wrong == 0 && all.unended == 0);
    TEST_CHECK(all.hits > all.cases / 4 && all.hits < all.cases && all.starts > 20 && all.grazing < all.cases / 10);
}

} // namespace

int main(int argc, char **argv)
{
    rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : rounds;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_pairs),
        cmocka_unit_test(test_casts),
    };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
