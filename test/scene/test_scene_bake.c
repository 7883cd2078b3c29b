// SPDX-License-Identifier: MIT
//
// scene_bake.c, scene_fit.c, instance_box.c: the tree's shape, boxes that hold their instances, refits, bad instances,
// failing memory, the same bytes.

#include "scene_models.h"

#include "base/hash.h"
#include "scene/scene_layout.h"

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

static void check_below(const tl_scene *scene, uint32_t n, uint32_t depth, uint8_t *seen, uint32_t *deepest)
{
    const tl_scene_node *node = &tl_scene_nodes(scene)[n];
    *deepest = depth > *deepest ? depth : *deepest;
    for (uint32_t i = 0; i < TL_SCENE_WIDTH; i++) {
        uint32_t child = node->child[i];
        if (child == 0) {
            TEST_CHECK(node->plane[0][i] > node->plane[1][i] && node->mask[i] == 0);
        } else if ((child & TL_CHILD_INSTANCE) != 0) {
            TEST_CHECK(seen[child & ~TL_CHILD_INSTANCE]++ == 0);
            TEST_CHECK(tl_scene_places(scene)[child & ~TL_CHILD_INSTANCE].lane == n * TL_SCENE_WIDTH + i);
        } else {
            TEST_CHECK(child > n && child < scene->node_count);
            const tl_scene_node *below = &tl_scene_nodes(scene)[child];
            uint32_t mask = 0;
            for (uint32_t k = 0; k < TL_SCENE_WIDTH; k++) {
                mask |= below->mask[k];
                for (uint32_t axis = 0; axis < 3; axis++) {
                    TEST_CHECK(below->plane[2 * axis][k] >= node->plane[2 * axis][i]);
                    TEST_CHECK(below->plane[2 * axis + 1][k] <= node->plane[2 * axis + 1][i]);
                }
            }
            TEST_CHECK(mask == node->mask[i]);
            check_below(scene, child, depth + 1, seen, deepest);
        }
    }
}

// Every instance once, boxes in boxes; corners of soups within their boxes.
static void check_tree(const tl_scene *scene, const tl_scene_instance *instances, uint32_t count)
{
    tl_scene_stats stats = tl_scene_get_stats(scene);
    TEST_CHECK(stats.instance_count == count && stats.depth <= TL_SCENE_MAX_DEPTH && stats.cost >= 1);
    uint8_t *seen = calloc(count + 1, 1);
    TEST_CHECK(seen != NULL);
    uint32_t deepest = 0;
    check_below(scene, 0, 1, seen, &deepest);
    TEST_CHECK(deepest == stats.depth);
    for (uint32_t i = 0; i < count; i++) {
        TEST_CHECK(seen[i] == 1);
        uint32_t lane = tl_scene_places(scene)[i].lane;
        const tl_scene_node *node = &tl_scene_nodes(scene)[lane / TL_SCENE_WIDTH];
        lane %= TL_SCENE_WIDTH;
        tl_aabb box = { vec(node->plane[0][lane], node->plane[2][lane], node->plane[4][lane]),
                        vec(node->plane[1][lane], node->plane[3][lane], node->plane[5][lane]) };
        TEST_CHECK(node->mask[lane] == instances[i].mask);
        if ((instances[i].soup == NULL && instances[i].shape == NULL) || instances[i].mask == 0) {
            TEST_CHECK(tl_aabb_is_empty(box));
            continue;
        }
        if (instances[i].shape != NULL) {
            tl_scaled_convex room;
            tl_aabb own = tl_convex_bounds(scene_scaled_shape(&instances[i], &room), instances[i].pose);
            // As bounds are rounded outward themselves, by less than boxes are.
            TEST_CHECK(tl_aabb_contains(box, own.min) && tl_aabb_contains(box, own.max));
            continue;
        }
        tl_frame frame = tl_frame_from(instances[i].pose);
        uint64_t cursor = 0;
        tl_soup_triangle triangle;
        while (tl_soup_next_triangle(instances[i].soup, &cursor, &triangle)) {
            for (uint32_t k = 0; k < 3; k++) {
                tl_vec3 s = tl_scale_is_one(instances[i].scale) ? vec(1, 1, 1) : instances[i].scale;
                tl_vec3d p = tl_frame_point(&frame, tl_vec3d_from(tl_mul(triangle.corners[k], s)));
                TEST_CHECK(p.x > (double)box.min.x && p.y > (double)box.min.y && p.z > (double)box.min.z);
                TEST_CHECK(p.x < (double)box.max.x && p.y < (double)box.max.y && p.z < (double)box.max.z);
            }
        }
    }
    free(seen);
}

static void check_count(const scene_parts *parts, uint32_t count, tl_vec3 center, float range)
{
    test_random random = { count };
    tl_scene_instance *instances = malloc((count + 1) * sizeof *instances);
    TEST_CHECK(instances != NULL);
    for (uint32_t i = 0; i < count; i++) {
        instances[i] = scene_instance(parts, &random, center, range);
        instances[i].mask = i % 13 == 0 ? 0 : instances[i].mask;
    }
    tl_scene *scene = scene_build(instances, count), *again = scene_build(instances, count);
    check_tree(scene, instances, count);
    TEST_CHECK(memcmp(scene, again, ((const tl_blob *)scene)->size) == 0);
    tl_scene_stats before = tl_scene_get_stats(scene);
    float growth = 0;
    TEST_RESULT(tl_scene_refit(scene, instances, count, &growth, NULL), TL_OK);
    TEST_CHECK(growth == 1 && memcmp(scene, again, before.size) == 0); // nothing moved
    for (uint32_t i = 0; i < count; i++) {
        instances[i] = scene_instance(parts, &random, tl_scale(center, -1), range);
        instances[i].mask = i % 11 == 0 ? 0 : instances[i].mask;
    }
    TEST_RESULT(tl_scene_refit(scene, instances, count, &growth, NULL), TL_OK);
    check_tree(scene, instances, count);
    TEST_CHECK(count < 100 || growth > 1.2f); // all mixed
    if (count > 0) {
        // A bad instance leaves everything as it was.
        tl_blob_free(again);
        again = scene_build(instances, count);
        TEST_RESULT(tl_scene_refit(again, instances, count, NULL, NULL), TL_OK);
        tl_scene *kept = malloc(before.size);
        TEST_CHECK(kept != NULL);
        uint64_t size = tl_scene_get_stats(scene).size;
        memcpy(kept, scene, size);
        instances[0].pose.position.x += 1;
        instances[count - 1].pose.rotation.y = NAN;
        tl_report report;
        TEST_RESULT(tl_scene_refit(scene, instances, count, NULL, &report), TL_ERR_NOT_FINITE);
        TEST_CHECK(report.element_index == count - 1 && memcmp(scene, kept, size) == 0);
        free(kept);
    }
    TEST_RESULT(tl_scene_refit(scene, instances, count + 1, NULL, NULL), TL_ERR_ARGUMENT);
    tl_blob_free(scene);
    tl_blob_free(again);
    free(instances);
}

static void test_trees(void **state)
{
    (void)state;
    scene_parts parts;
    scene_parts_make(&parts, 1);
    for (uint32_t count = 0; count < 40; count++) {
        check_count(&parts, count, vec(0, 0, 0), 5);
    }
    check_count(&parts, 300, vec(1000, 0, 500), 20);
    check_count(&parts, 3000, vec(0, 0, 0), 0); // all in one place
    check_count(&parts, 10000, vec(0, 0, 0), 200);
    check_count(&parts, 100, vec(1e9f, 1e9f, -1e9f), 1e8f);
    scene_parts_free(&parts);
}

// Each instance twice as far away as the one before, and all of them in one place: the worst for costs, and for bins.
static void test_depth(void **state)
{
    (void)state;
    scene_parts parts;
    scene_parts_make(&parts, 1e-3f);
    enum { COUNT = 4000 };
    tl_scene_instance *instances = calloc(COUNT, sizeof *instances);
    TEST_CHECK(instances != NULL);
    for (uint32_t i = 0; i < COUNT; i++) {
        instances[i].shape = &parts.shapes[3];
        instances[i].mask = 1;
        instances[i].pose = tl_transform_identity();
        instances[i].pose.position = vec(ldexpf(1, (int)(i % 40)), i < COUNT / 2 ? 0 : ldexpf(1, (int)(i % 37)), 0);
    }
    tl_scene *scene = scene_build(instances, COUNT);
    check_tree(scene, instances, COUNT);
    print_message("depth %u\n", tl_scene_get_stats(scene).depth);
    TEST_CHECK(tl_scene_get_stats(scene).depth >= 6);
    tl_blob_free(scene);
    free(instances);
    scene_parts_free(&parts);
}

static void check_bad(tl_scene_instance instance, tl_result expected)
{
    tl_convex sphere = tl_convex_sphere(vec(0, 0, 0), 1);
    tl_scene_instance instances[3] = { { .shape = &sphere, .mask = 1 }, { .mask = 1 } };
    instances[2] = instance;
    tl_scene *scene = NULL;
    tl_report report;
    TEST_RESULT(tl_scene_bake(instances, 3, NULL, &scene, &report), expected);
    TEST_CHECK(scene == NULL && report.element_index == 2 && strcmp(report.element, "instance") == 0);
    TEST_CHECK(report.advice != NULL);
}

static void test_bad_instances(void **state)
{
    (void)state;
    scene_parts parts;
    scene_parts_make(&parts, 1);
    tl_scene_instance good = { .soup = parts.soups[0], .pose = tl_transform_identity(), .mask = 1 }, bad = good;
    bad.pose.position.y = NAN;
    check_bad(bad, TL_ERR_NOT_FINITE);
    bad.pose.position.y = INFINITY;
    check_bad(bad, TL_ERR_NOT_FINITE);
    bad = good;
    bad.pose.rotation.w = INFINITY;
    check_bad(bad, TL_ERR_NOT_FINITE);
    bad = good;
    bad.pose.position.z = -2e12f;
    check_bad(bad, TL_ERR_RANGE);
    bad = good;
    bad.shape = &parts.shapes[0];
    check_bad(bad, TL_ERR_ARGUMENT);
    tl_convex shape = tl_convex_sphere(vec(0, 0, 0), -1);
    bad.soup = NULL;
    bad.shape = &shape;
    check_bad(bad, TL_ERR_ARGUMENT);
    shape.radius = NAN;
    check_bad(bad, TL_ERR_ARGUMENT);
    shape = tl_convex_sphere(vec(0, NAN, 0), 1);
    check_bad(bad, TL_ERR_NOT_FINITE);
    shape = tl_convex_sphere(vec(0, 3e12f, 0), 1);
    check_bad(bad, TL_ERR_RANGE);
    tl_scene *scene = NULL;
    TEST_RESULT(tl_scene_bake(&good, TL_MAX_SCENE_INSTANCES + 1u, NULL, &scene, NULL), TL_ERR_LIMIT);
    scene_parts_free(&parts);
}

// The bytes are those of any compiler and machine.
static void test_same_bytes(void **state)
{
    (void)state;
    scene_parts parts;
    scene_parts_make(&parts, 1);
    test_random random = { 31 };
    tl_scene_instance instances[1000];
    scene_fill(&parts, &random, vec(100, 0, -30), 40, instances, 1000);
    tl_scene *scene = scene_build(instances, 1000);
    uint64_t built = tl_hash_bytes(scene, tl_scene_get_stats(scene).size, 0);
    for (uint32_t i = 0; i < 1000; i += 3) {
        instances[i].pose.position.x += 1;
    }
    TEST_RESULT(tl_scene_refit(scene, instances, 1000, NULL, NULL), TL_OK);
    uint64_t moved = tl_hash_bytes(scene, tl_scene_get_stats(scene).size, 0);
    print_message("%016llx %016llx\n", (unsigned long long)built, (unsigned long long)moved);
    TEST_CHECK(built == 0x9043b52ea66ec02eu && moved == 0x88718ee069d9bb20u);
    tl_blob_free(scene);
    scene_parts_free(&parts);
}

static void test_failing_memory(void **state)
{
    (void)state;
    scene_parts parts;
    scene_parts_make(&parts, 1);
    test_random random = { 1 };
    tl_scene_instance instances[500];
    scene_fill(&parts, &random, vec(0, 0, 0), 10, instances, 500);
    tl_result result = TL_ERR_MEMORY;
    uint32_t failures = 0;
    for (uint64_t at = 1; result != TL_OK; at++) {
        test_allocator memory;
        test_allocator_init(&memory, at);
        tl_host host = { &memory.allocator, NULL, NULL };
        tl_scene *scene = NULL;
        result = tl_scene_bake(instances, 500, &host, &scene, NULL);
        TEST_CHECK(result == TL_OK || (result == TL_ERR_MEMORY && scene == NULL && memory.live_blocks == 0));
        failures += result != TL_OK;
        memory.fail_at = 0;
        tl_blob_free(scene);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
    }
    TEST_CHECK(failures >= 2);
    scene_parts_free(&parts);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_trees),      cmocka_unit_test(test_depth),          cmocka_unit_test(test_bad_instances),
        cmocka_unit_test(test_same_bytes), cmocka_unit_test(test_failing_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
