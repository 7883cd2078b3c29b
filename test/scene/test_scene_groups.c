// SPDX-License-Identifier: MIT
//
// Groups inside groups: each instance is where long double matrices put it, in the order that the header says, and
// keeps its bits where nothing is done to it; a copy that is placed anew carries what is inside; what cannot be laid
// out is refused by name, at once, and nothing is changed.

#include "scene_models.h"

#include <talus/scene_groups.h>

enum { GROUPS = 9, MOST = 6, TRIALS = 300 };

typedef struct fixture {
    tl_scene_group groups[GROUPS];
    tl_scene_instance instances[GROUPS][MOST];
    tl_scene_placement placements[GROUPS][MOST];
    uint32_t root;
} fixture;

static tl_transform random_pose(test_random *random)
{
    tl_transform pose = tl_transform_identity();
    const uint32_t kind = test_random_below(random, 4);
    const tl_vec3 far = tl_vec3_make(100, 100, 100);
    pose.position = kind != 0 ? test_random_point(random, tl_neg(far), far) : pose.position;
    if (kind >= 2) {
        pose.rotation = scene_rotation(random);
        const float length = kind == 3 ? test_random_range(random, 0.1f, 30.0f) : 1.0f; // it is normalized before use
        tl_quat *q = &pose.rotation;
        q->x *= length, q->y *= length, q->z *= length, q->w *= length;
    }
    return pose;
}

static float random_scale(test_random *random)
{
    static const float scales[] = { 0, 1, 2, 0.3f, -1, -1.7f };
    return scales[test_random_below(random, 6)];
}

// Groups that place groups of higher indices only, in an order of indices that tells nothing.
static void make_groups(fixture *f, test_random *random)
{
    memset(f, 0, sizeof *f);
    uint32_t order[GROUPS];
    for (uint32_t i = 0; i < GROUPS; i++) {
        order[i] = i;
        const uint32_t other = test_random_below(random, i + 1);
        order[i] = order[other];
        order[other] = i;
    }
    for (uint32_t rank = 0; rank < GROUPS; rank++) {
        const uint32_t g = order[rank];
        tl_scene_group *group = &f->groups[g];
        group->instances = f->instances[g];
        group->placements = f->placements[g];
        group->instance_count = test_random_below(random, MOST);
        group->placement_count = rank + 1 < GROUPS ? test_random_below(random, 4) : 0;
        for (uint32_t i = 0; i < group->instance_count; i++) {
            tl_scene_instance *instance = &f->instances[g][i];
            instance->pose = random_pose(random);
            instance->mask = 16 * g + i + 1;
            instance->scale = i % 2 ? tl_vec3_make(1, 2, -3) : tl_vec3_make(0, 0, 0);
        }
        for (uint32_t i = 0; i < group->placement_count; i++) {
            const uint32_t below = order[rank + 1 + test_random_below(random, GROUPS - rank - 1)];
            const tl_scene_placement at = { below, random_pose(random), random_scale(random) };
            f->placements[g][i] = at;
        }
    }
    f->root = order[0];
}

// A linear map and where the origin goes.
typedef struct map {
    long double m[3][3], at[3];
} map;

static map map_of(tl_transform pose, tl_vec3 scale)
{
    const tl_quat q = pose.rotation;
    const long double x = (long double)q.x, y = (long double)q.y, z = (long double)q.z, w = (long double)q.w;
    const long double n = x * x + y * y + z * z + w * w;
    const tl_vec3 s = tl_scale_factors(scale);
    const long double factors[3] = { (long double)s.x, (long double)s.y, (long double)s.z };
    map r = { { { n - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w) },
                { 2 * (x * y + z * w), n - 2 * (x * x + z * z), 2 * (y * z - x * w) },
                { 2 * (x * z - y * w), 2 * (y * z + x * w), n - 2 * (x * x + y * y) } },
              { (long double)pose.position.x, (long double)pose.position.y, (long double)pose.position.z } };
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            r.m[i][k] = r.m[i][k] / n * factors[k];
        }
    }
    return r;
}

static map map_after(const map *outer, const map *inner)
{
    map r;
    for (int i = 0; i < 3; i++) {
        r.at[i] = outer->at[i];
        for (int k = 0; k < 3; k++) {
            r.at[i] += outer->m[i][k] * inner->at[k];
            r.m[i][k] = 0;
            for (int j = 0; j < 3; j++) {
                r.m[i][k] += outer->m[i][j] * inner->m[j][k];
            }
        }
    }
    return r;
}

// The largest difference, of the linear part and of the place, in shares of what is there.
static long double difference(const map *a, const map *b)
{
    long double most = 0, size = 1e-30L, way = 0, far = 1;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            most = fmaxl(most, fabsl(a->m[i][k] - b->m[i][k]));
            size = fmaxl(size, fabsl(a->m[i][k]));
        }
        way = fmaxl(way, fabsl(a->at[i] - b->at[i]));
        far = fmaxl(far, fabsl(a->at[i]));
    }
    return fmaxl(most / size, way / far);
}

typedef struct walk {
    const fixture *f;
    const tl_scene_expansion *e;
    uint32_t instances, copies, deepest;
    long double worst;
} walk;

// Goes into a group as the header says, and compares all that it meets.
static void check_copy(walk *w, uint32_t group, uint32_t parent, uint32_t placement, const map *place, uint32_t depth)
{
    const tl_scene_group *g = &w->f->groups[group];
    const uint32_t index = w->copies++;
    const tl_scene_copy copy = w->e->copies[index];
    TEST_CHECK(copy.group == group && copy.parent == parent && copy.first_instance == w->instances);
    TEST_CHECK(parent == TL_NO_COPY || copy.placement == placement);
    const map at = map_of(copy.pose, tl_vec3_make(copy.scale, copy.scale, copy.scale));
    w->worst = fmaxl(w->worst, difference(place, &at));
    w->deepest = depth > w->deepest ? depth : w->deepest;
    for (uint32_t i = 0; i < g->instance_count; i++) {
        const tl_scene_instance *got = &w->e->instances[w->instances];
        TEST_CHECK(got->mask == g->instances[i].mask && tl_scene_copy_of(w->e, w->instances) == index);
        const map inner = map_of(g->instances[i].pose, g->instances[i].scale), is = map_of(got->pose, got->scale);
        const map ought = map_after(place, &inner);
        w->worst = fmaxl(w->worst, difference(&ought, &is));
        w->instances++;
    }
    for (uint32_t i = 0; i < g->placement_count; i++) {
        const tl_scene_placement *p = &g->placements[i];
        const float s = p->scale != 0 ? p->scale : 1;
        const map inner = map_of(p->pose, tl_vec3_make(s, s, s));
        const map ought = map_after(place, &inner);
        check_copy(w, p->group, index, i, &ought, depth + 1);
    }
    TEST_CHECK(copy.copy_count == w->copies - index && copy.instance_count == w->instances - copy.first_instance);
}

static void test_random_groups(void **state)
{
    (void)state;
    test_random random = { 11 };
    fixture f;
    uint32_t deepest = 0, instances = 0;
    long double worst = 0;
    for (uint32_t trial = 0; trial < TRIALS; trial++) {
        make_groups(&f, &random);
        tl_scene_expansion e;
        TEST_RESULT(tl_scene_groups_expand(f.groups, GROUPS, f.root, NULL, &e, NULL), TL_OK);
        walk w = { &f, &e, 0, 0, 0, 0 };
        const map world = map_of(tl_transform_identity(), tl_vec3_make(1, 1, 1));
        check_copy(&w, f.root, TL_NO_COPY, 0, &world, 0);
        TEST_CHECK(w.copies == e.copy_count && w.instances == e.instance_count);
        TEST_CHECK(tl_scene_copy_of(&e, e.instance_count) == TL_NO_COPY);
        deepest = w.deepest > deepest ? w.deepest : deepest;
        worst = fmaxl(worst, w.worst);
        instances += e.instance_count;
        tl_scene_expansion_free(&e);
    }
    print_message("%u instances, %u deep, worst difference %.2Lg\n", instances, deepest, worst);
    TEST_CHECK(deepest >= 6 && instances > 5000);
    TEST_CHECK(worst < 2e-6L); // a few float roundings a level
}

// At the identity nothing is touched, not even a quaternion that is not normalized.
static void test_identity_keeps_bits(void **state)
{
    (void)state;
    test_random random = { 3 };
    fixture f;
    make_groups(&f, &random);
    tl_scene_placement at = { f.root, tl_transform_identity(), 0 };
    at.pose.rotation.w = 0;
    const tl_scene_group groups[2] = { f.groups[f.root], { NULL, 0, &at, 1 } };
    for (uint32_t i = 0; i < groups[0].instance_count; i++) {
        f.instances[f.root][i].pose.rotation.w = -0.0f;
    }
    at.group = 0;
    f.groups[f.root].placement_count = 0;
    const tl_scene_group flat[2] = { f.groups[f.root], groups[1] };
    tl_scene_expansion e;
    TEST_RESULT(tl_scene_groups_expand(flat, 2, 1, NULL, &e, NULL), TL_OK);
    TEST_CHECK(e.instance_count == flat[0].instance_count && e.instance_count > 0 && e.copy_count == 2);
    for (uint32_t i = 0; i < e.instance_count; i++) {
        TEST_CHECK(memcmp(&e.instances[i].pose, &flat[0].instances[i].pose, sizeof e.instances[i].pose) == 0);
        TEST_CHECK(memcmp(&e.instances[i].scale, &flat[0].instances[i].scale, sizeof e.instances[i].scale) == 0);
    }
    tl_scene_expansion_free(&e);
}

static bool same_placing(const tl_scene_expansion *a, const tl_scene_expansion *b)
{
    bool same = a->instance_count == b->instance_count && a->copy_count == b->copy_count;
    for (uint32_t i = 0; same && i < a->instance_count; i++) {
        same = memcmp(&a->instances[i].pose, &b->instances[i].pose, sizeof a->instances[i].pose) == 0 &&
               memcmp(&a->instances[i].scale, &b->instances[i].scale, sizeof a->instances[i].scale) == 0;
    }
    for (uint32_t i = 0; same && i < a->copy_count; i++) {
        same = memcmp(&a->copies[i].pose, &b->copies[i].pose, sizeof a->copies[i].pose) == 0 &&
               a->copies[i].scale == b->copies[i].scale;
    }
    return same;
}

// Placing a copy where the root's placement says is expanding anew; and placing any where it is changes nothing.
static void test_place(void **state)
{
    (void)state;
    test_random random = { 17 };
    fixture f;
    uint32_t moved = 0;
    for (uint32_t trial = 0; trial < TRIALS; trial++) {
        make_groups(&f, &random);
        tl_scene_expansion e, fresh;
        TEST_RESULT(tl_scene_groups_expand(f.groups, GROUPS, f.root, NULL, &e, NULL), TL_OK);
        for (uint32_t copy = 1; copy < e.copy_count && copy < 40; copy++) {
            tl_scene_expansion before;
            TEST_RESULT(tl_scene_groups_expand(f.groups, GROUPS, f.root, NULL, &before, NULL), TL_OK);
            const tl_scene_placement same = { 99, e.copies[copy].pose, e.copies[copy].scale };
            TEST_RESULT(tl_scene_groups_place(f.groups, GROUPS, &e, copy, &same, NULL), TL_OK);
            TEST_CHECK(same_placing(&e, &before));
            tl_scene_expansion_free(&before);
        }
        for (uint32_t copy = 1; copy < e.copy_count; copy++) {
            if (e.copies[copy].parent != 0) {
                continue;
            }
            tl_scene_placement *at = &f.placements[f.root][e.copies[copy].placement];
            at->pose = random_pose(&random);
            at->scale = random_scale(&random);
            TEST_RESULT(tl_scene_groups_place(f.groups, GROUPS, &e, copy, at, NULL), TL_OK);
            moved += e.copies[copy].instance_count;
        }
        TEST_RESULT(tl_scene_groups_expand(f.groups, GROUPS, f.root, NULL, &fresh, NULL), TL_OK);
        TEST_CHECK(same_placing(&e, &fresh));
        tl_scene_expansion_free(&fresh);
        tl_scene_expansion_free(&e);
    }
    TEST_CHECK(moved > 2000);
}

// A street of three houses with two crates each: rays find the crates, and a house is left out as a range.
static void test_rays(void **state)
{
    (void)state;
    const tl_convex box = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.5f, 0.5f, 0.5f), 0);
    const tl_scene_instance crates[2] = { { .shape = &box, .pose = tl_transform_identity(), .mask = 1 },
                                          { .shape = &box, .pose = tl_transform_identity(), .mask = 1 } };
    tl_scene_placement in_house[2], in_street[3];
    for (uint32_t i = 0; i < 2; i++) {
        const tl_scene_placement at = { 0, tl_transform_identity(), 1 };
        in_house[i] = at;
        in_house[i].pose.position = tl_vec3_make(0, 0, 4.0f * (float)i);
    }
    for (uint32_t i = 0; i < 3; i++) {
        const tl_scene_placement at = { 1, tl_transform_identity(), i == 1 ? 2.0f : 1.0f };
        in_street[i] = at;
        in_street[i].pose.position = tl_vec3_make(20.0f * (float)i, 0, 0);
    }
    const tl_scene_group groups[3] = { { crates, 1, NULL, 0 }, { NULL, 0, in_house, 2 }, { NULL, 0, in_street, 3 } };
    tl_scene_expansion e;
    TEST_RESULT(tl_scene_groups_expand(groups, 3, 2, NULL, &e, NULL), TL_OK);
    TEST_CHECK(e.instance_count == 6 && e.copy_count == 10);
    tl_scene *scene = NULL;
    TEST_RESULT(tl_scene_bake(e.instances, e.instance_count, NULL, &scene, NULL), TL_OK);
    const tl_ray ray = { tl_vec3_make(20, 0, -10), tl_vec3_make(0, 0, 1), INFINITY };
    tl_scene_hit hit;
    TEST_CHECK(tl_scene_cast_ray(scene, e.instances, &ray, NULL, &hit));
    TEST_CHECK(fabsf(hit.hit.t - 9.0f) < 1e-4f); // the house is twice as large, so its crates are 2 m wide
    const uint32_t crate = tl_scene_copy_of(&e, hit.instance), house = e.copies[crate].parent;
    TEST_CHECK(e.copies[crate].group == 0 && e.copies[crate].placement == 0);
    TEST_CHECK(e.copies[house].group == 1 && e.copies[house].placement == 1 && e.copies[house].parent == 0);
    const tl_scene_filter without = { .first_ignored = e.copies[house].first_instance,
                                      .ignored_count = e.copies[house].instance_count };
    TEST_CHECK(!tl_scene_cast_ray(scene, e.instances, &ray, &without, &hit));
    const tl_scene_placement away = { 1, { { 0, 0, 0, 1 }, { 0, 500, 0 } }, 1 };
    TEST_RESULT(tl_scene_groups_place(groups, 3, &e, house, &away, NULL), TL_OK);
    TEST_RESULT(tl_scene_refit(scene, e.instances, e.instance_count, NULL, NULL), TL_OK);
    TEST_CHECK(!tl_scene_cast_ray(scene, e.instances, &ray, NULL, &hit));
    tl_blob_free(scene);
    tl_scene_expansion_free(&e);
}

static void expect(tl_result expected, const tl_scene_group *groups, uint32_t count, uint32_t root, uint64_t element)
{
    tl_scene_expansion e;
    memset(&e, 7, sizeof e);
    tl_report report;
    TEST_RESULT(tl_scene_groups_expand(groups, count, root, NULL, &e, &report), expected);
    TEST_CHECK(e.instances == NULL && e.copies == NULL && e.instance_count == 0 && e.copy_count == 0);
    TEST_CHECK(report.element_index == element && strcmp(report.element, "group") == 0 && report.advice != NULL);
}

enum { DOUBLINGS = 62 };

static void test_refused_by_name(void **state)
{
    (void)state;
    tl_scene_placement twice[DOUBLINGS][2];
    tl_scene_group groups[DOUBLINGS + 1];
    const tl_scene_instance instance = { .pose = tl_transform_identity() };
    for (uint32_t i = 0; i < DOUBLINGS; i++) {
        const tl_scene_placement below = { i + 1, tl_transform_identity(), 1 };
        twice[i][0] = twice[i][1] = below;
        const tl_scene_group group = { NULL, 0, twice[i], 2 };
        groups[i] = group;
    }
    const tl_scene_group last = { &instance, 1, NULL, 0 };
    groups[DOUBLINGS] = last;
    expect(TL_ERR_LIMIT, groups, DOUBLINGS + 1, 0, DOUBLINGS - 28); // 2^29 - 1 copies are too many
    tl_scene_expansion e;
    TEST_RESULT(tl_scene_groups_expand(groups, DOUBLINGS + 1, DOUBLINGS - 10, NULL, &e, NULL), TL_OK);
    TEST_CHECK(e.instance_count == 1024 && e.copy_count == 2047);
    tl_scene_expansion_free(&e);

    expect(TL_ERR_INDEX, groups, DOUBLINGS + 1, DOUBLINGS + 1, DOUBLINGS + 1);
    expect(TL_ERR_INDEX, groups, DOUBLINGS, DOUBLINGS - 3, DOUBLINGS - 1); // the last one is not there
    twice[DOUBLINGS - 1][1].group = DOUBLINGS - 4;
    expect(TL_ERR_ARGUMENT, groups, DOUBLINGS + 1, DOUBLINGS - 6, DOUBLINGS - 4); // inside itself
    twice[DOUBLINGS - 1][1].group = DOUBLINGS - 1;
    expect(TL_ERR_ARGUMENT, groups, DOUBLINGS + 1, DOUBLINGS - 1, DOUBLINGS - 1);
    twice[DOUBLINGS - 1][1].group = DOUBLINGS;

    static const float scales[] = { 1e-7f, -2e6f, NAN, INFINITY };
    for (uint32_t i = 0; i < 4; i++) {
        twice[DOUBLINGS - 1][1].scale = scales[i];
        expect(i < 2 ? TL_ERR_RANGE : TL_ERR_NOT_FINITE, groups, DOUBLINGS + 1, DOUBLINGS - 2, DOUBLINGS - 1);
    }
    twice[DOUBLINGS - 1][1].scale = 1;
    twice[DOUBLINGS - 1][1].pose.rotation.y = NAN;
    expect(TL_ERR_NOT_FINITE, groups, DOUBLINGS + 1, DOUBLINGS - 2, DOUBLINGS - 1);
    twice[DOUBLINGS - 1][1].pose.rotation.y = 0;
    groups[DOUBLINGS].instances = NULL;
    expect(TL_ERR_ARGUMENT, groups, DOUBLINGS + 1, DOUBLINGS - 2, DOUBLINGS);
}

// Scales that multiply to what no instance may have come out as such, not as 1: the scene refuses them.
static void test_scales_that_vanish(void **state)
{
    (void)state;
    const tl_convex ball = tl_convex_sphere(tl_vec3_make(0, 0, 0), 1);
    const tl_scene_instance instance = { .shape = &ball, .mask = 1, .scale = { 1e-6f, 1e-6f, 1e-6f } };
    tl_scene_placement chain[8];
    tl_scene_group groups[9];
    for (uint32_t i = 0; i < 8; i++) {
        const tl_scene_placement below = { i + 1, tl_transform_identity(), 1e-6f };
        chain[i] = below;
        const tl_scene_group group = { NULL, 0, &chain[i], 1 };
        groups[i] = group;
    }
    const tl_scene_group last = { &instance, 1, NULL, 0 };
    groups[8] = last;
    tl_scene_expansion e;
    TEST_RESULT(tl_scene_groups_expand(groups, 9, 0, NULL, &e, NULL), TL_OK);
    tl_scene *scene = NULL;
    tl_report report;
    TEST_RESULT(tl_scene_bake(e.instances, e.instance_count, NULL, &scene, &report), TL_ERR_RANGE);
    TEST_CHECK(report.element_index == 0);
    tl_scene_expansion_free(&e);
}

static void test_place_refuses_other_groups(void **state)
{
    (void)state;
    test_random random = { 23 };
    fixture f;
    do {
        make_groups(&f, &random);
    } while (f.groups[f.root].placement_count < 2 || f.groups[f.root].instance_count < 2);
    tl_scene_expansion e, before;
    TEST_RESULT(tl_scene_groups_expand(f.groups, GROUPS, f.root, NULL, &e, NULL), TL_OK);
    TEST_RESULT(tl_scene_groups_expand(f.groups, GROUPS, f.root, NULL, &before, NULL), TL_OK);
    tl_scene_placement at = { 0, tl_transform_identity(), 3 };
    tl_report report;
    tl_scene_group *root = &f.groups[f.root];
    TEST_RESULT(tl_scene_groups_place(f.groups, GROUPS, &e, e.copy_count, &at, &report), TL_ERR_INDEX);
    for (int change = 0; change < 5; change++) {
        fixture other = f;
        root = &other.groups[f.root];
        root->instance_count -= change == 0;
        root->placement_count -= change == 1;
        root->placement_count += change == 2;
        root->placements = other.placements[f.root];
        other.placements[f.root][0].group =
            change == 3 ? (other.placements[f.root][0].group + 1) % GROUPS : other.placements[f.root][0].group;
        at.scale = change == 4 ? NAN : 3;
        const tl_result result = tl_scene_groups_place(other.groups, GROUPS, &e, 0, &at, &report);
        TEST_CHECK(result == (change == 4 ? TL_ERR_NOT_FINITE : TL_ERR_ARGUMENT));
        TEST_CHECK(same_placing(&e, &before));
    }
    tl_scene_expansion_free(&before);
    tl_scene_expansion_free(&e);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random_groups),
        cmocka_unit_test(test_identity_keeps_bits),
        cmocka_unit_test(test_place),
        cmocka_unit_test(test_rays),
        cmocka_unit_test(test_refused_by_name),
        cmocka_unit_test(test_scales_that_vanish),
        cmocka_unit_test(test_place_refuses_other_groups),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
