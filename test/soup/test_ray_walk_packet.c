// SPDX-License-Identifier: MIT
//
// ray_walk_packet.inl: sixteen rays at once give the bits of single rays, whatever they have in common.

#define _DEFAULT_SOURCE // pthread_attr_setstack

#include "painted_stack.h"
#include "soup/ray/ray_job.h"
#include "soup_models.h"

// Packets with a stack and doubts that overflow soon, that count the rays they give up, and none of whose rays are
// left.
#define TL_SIMD_LEVEL        0
#define TL_PACKET_STACK_SIZE 32
#define TL_PACKET_DOUBTS     8
#define TL_RAY_WALK          test_walk
#define TL_RAY_WALK_MANY     test_walk_many
#define TL_RAY_PACKETS       test_packets
#define tl_ray_batch_one     count_alone
#define tl_ray_batch_apart   count_apart
tl_ray_walk_fn test_walk; // not used here, so not static
static tl_ray_packets_fn test_packets;
static void count_alone(const tl_ray_batch *batch, uint32_t index);
static void count_apart(const tl_ray_batch *batch, uint32_t first, uint32_t end);
#include "soup/ray/ray_walk.inl"
#include "soup/ray/ray_walk_packet.inl"
#undef tl_ray_batch_one
#undef tl_ray_batch_apart

static uint32_t alone, apart;

static void count_alone(const tl_ray_batch *batch, uint32_t index)
{
    alone++;
    tl_ray_batch_one(batch, index);
}

static void count_apart(const tl_ray_batch *batch, uint32_t first, uint32_t end)
{
    apart += end - first;
    tl_ray_batch_apart(batch, first, end);
}

enum { SIDE = 48, COUNT = SIDE * SIDE };

// What sixteen rays in a row have in common.
typedef enum ray_family {
    FAMILY_CAMERA,   // an origin; they look around, so octants and axes change
    FAMILY_AXES,     // directions in planes of the axes
    FAMILY_PARALLEL, // a direction, from a square
    FAMILY_LIGHT,    // a camera's, whose segments run the other way: to one place
    FAMILY_PLACES,   // fans from places that change, so that rays of one octant and axis come from several
    FAMILY_CORNERS,  // aimed at corners and middles of edges from one point
    FAMILY_SPOILED,  // a camera's with short, wrong, long and tiny ones among them
    FAMILY_NOTHING,
    FAMILIES
} ray_family;

typedef struct packet_rays {
    tl_ray rays[COUNT];
    tl_segment segments[COUNT];
} packet_rays;

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

static tl_vec3 aimed_at(const model *m, test_random *random)
{
    const uint32_t *corners = m->indices + 3 * (size_t)test_random_below(random, m->triangle_count);
    tl_vec3 a = m->vertices[corners[0]], b = m->vertices[corners[1]];
    return test_random_below(random, 2) == 0 ? a : tl_scale(tl_add(a, b), 0.5f);
}

static void spoil(tl_ray *ray, uint32_t i, float size)
{
    if (i % 50 == 3) {
        ray->tmax = size * 0.2f;
    } else if (i % 97 == 5) {
        ray->direction.x = NAN;
    } else if (i % 131 == 7) {
        ray->origin.y = 1e16f;
    } else if (i % 151 == 9) {
        ray->direction = tl_scale(ray->direction, 1e-20f);
    } else if (i % 171 == 11) {
        ray->tmax = i % 2 == 0 ? -1.0f : 0.0f;
    } else if (i % 191 == 13) {
        ray->direction = vec(0, 0, 0);
    }
}

static void make_rays(const model *m, tl_aabb box, ray_family family, uint64_t seed, packet_rays *out)
{
    test_random random = { seed };
    tl_vec3 eye = test_random_point(&random, box.min, box.max), side = tl_sub(box.max, box.min);
    float size = side.x > side.y ? side.x : side.y, turn = test_random_range(&random, -1, 1);
    for (uint32_t i = 0; i < COUNT; i++) {
        float x = (float)(i % SIDE) / SIDE * 2 - 1, y = (float)i / COUNT * 2 - 1;
        tl_vec3 origin = eye, direction = vec(0.6f * x + turn, y * 0.7f - 0.2f, 1 - 0.6f * turn * x);
        switch (family) {
        case FAMILY_AXES:
            direction = i / 64 % 3 == 0 ? vec(0, -1, 0) : i / 64 % 3 == 1 ? vec(x, -1, 0) : vec(0, y, -x);
            break;
        case FAMILY_PARALLEL:
            direction = vec(turn, -1, 0.2f);
            origin = tl_add(eye, tl_scale(vec(x, 0, y), 0.02f * size));
            break;
        case FAMILY_PLACES:
            if (i % 32 == 0) {
                eye = test_random_point(&random, box.min, box.max);
                side = tl_sub(test_random_point(&random, box.min, box.max), eye);
            }
            origin = eye;
            direction = tl_scale(tl_mul_add(side, test_random_direction(&random), 0.03f * size), 2.0f / size);
            break;
        case FAMILY_CORNERS:
            direction = tl_sub(aimed_at(m, &random), eye);
            break;
        case FAMILY_NOTHING:
            origin = test_random_point(&random, box.min, box.max);
            direction = test_random_direction(&random);
            break;
        default:
            break;
        }
        tl_ray ray = { origin, direction, i % 7 == 0 ? 0.7f * size : INFINITY };
        if (family == FAMILY_SPOILED) {
            spoil(&ray, i, size);
        }
        out->rays[i] = ray;
        float length = family == FAMILY_CORNERS ? 1.0f : size * 0.4f;
        tl_vec3 end = tl_mul_add(ray.origin, ray.direction, length);
        tl_segment segment = { ray.origin, end }, back = { end, ray.origin };
        out->segments[i] = family == FAMILY_LIGHT ? back : segment;
    }
}

static bool same_hit(const tl_ray_hit *a, const tl_ray_hit *b)
{
    return memcmp(&a->t, &b->t, sizeof a->t) == 0 && a->triangle == b->triangle &&
           memcmp(&a->u, &b->u, sizeof a->u) == 0 && memcmp(&a->v, &b->v, sizeof a->v) == 0 &&
           memcmp(&a->normal, &b->normal, sizeof a->normal) == 0 && a->material == b->material && a->back == b->back;
}

// Single rays or segments in plain C. Returns the hits.
static uint32_t trace_alone(const tl_soup *soup, const tl_ray *rays, const tl_segment *segments, uint32_t count,
                            tl_ray_hit *hits)
{
    tl_ray_batch batch = { soup, rays, segments, count, NULL, hits, NULL, true };
    uint32_t found = 0;
    for (uint32_t i = 0; i < count; i++) {
        const tl_vec3 *origin, *target;
        float tmax;
        tl_ray_of_batch(&batch, i, &origin, &target, &tmax);
        bool met = tl_ray_walk_scalar(soup, origin, target, tmax, rays == NULL, NULL, &hits[i]);
        tl_ray_report(&batch, i, met);
        found += met;
    }
    return found;
}

// Closest and any hits by one function against those.
static void check_packets(tl_ray_packets_fn *packets, const tl_soup *soup, const tl_ray *rays,
                          const tl_segment *segments, uint32_t count, const tl_ray_hit *expected)
{
    static tl_ray_hit hits[COUNT];
    static bool answers[COUNT];
    memset(hits, 0xff, sizeof hits);
    tl_ray_batch closest = { soup, rays, segments, count, NULL, hits, NULL, true };
    tl_ray_batch any = { soup, rays, segments, count, NULL, NULL, answers, rays != NULL };
    packets(&closest);
    packets(&any);
    for (uint32_t i = 0; i < count; i++) {
        TEST_CHECK(same_hit(&hits[i], &expected[i]));
        TEST_CHECK(answers[i] == ((expected[i].triangle != TL_NO_TRIANGLE) == (rays != NULL)));
    }
}

static uint32_t check_all(const tl_soup *soup, const packet_rays *all, uint32_t count)
{
    static tl_ray_hit of_rays[COUNT], of_segments[COUNT];
    uint32_t found = trace_alone(soup, all->rays, NULL, count, of_rays);
    found += trace_alone(soup, NULL, all->segments, count, of_segments);
    for (tl_ray_isa isa = TL_RAY_SCALAR; isa <= TL_RAY_ISA_COUNT; isa++) {
        tl_ray_packets_fn *packets = isa == TL_RAY_ISA_COUNT ? test_packets : tl_ray_packets_for(isa);
        if (packets != NULL) {
            check_packets(packets, soup, all->rays, NULL, count, of_rays);
            check_packets(packets, soup, NULL, all->segments, count, of_segments);
        }
    }
    return found;
}

// Rays alone, by packets that are watched. Returns the hits.
static uint32_t watch(const tl_soup *soup, const packet_rays *all)
{
    static tl_ray_hit expected[COUNT];
    uint32_t found = trace_alone(soup, all->rays, NULL, COUNT, expected);
    alone = apart = 0;
    check_packets(test_packets, soup, all->rays, NULL, COUNT, expected);
    return found;
}

static void scale_model(model *m, float scale, tl_vec3 move)
{
    for (uint32_t i = 0; i < m->vertex_count; i++) {
        m->vertices[i] = tl_mul_add(move, m->vertices[i], scale);
    }
}

static void check_model(const model *m, uint64_t seed)
{
    static packet_rays all;
    uint32_t found = 0;
    tl_soup *soup = model_soup(m, NULL);
    for (ray_family family = 0; family < FAMILIES; family++) {
        for (uint32_t i = 0; i < 3; i++) {
            make_rays(m, tl_soup_bounds(soup), family, seed + i, &all);
            found += check_all(soup, &all, COUNT);
        }
    }
    TEST_CHECK(found > COUNT);
    tl_blob_free(soup);
}

static void test_same_bits(void **state)
{
    (void)state;
    model models[] = { model_terrain(40, 4, vec(0, 0, 0), 1), model_ball(4, 5, 0.2f, vec(90, 3, -20), 2),
                       model_random(2000, 10, 2, 3), model_terrain(12, 3, vec(0, 0, 0), 4) };
    model_repeat_triangles(&models[3]);
    for (uint32_t i = 0; i < sizeof models / sizeof models[0]; i++) {
        check_model(&models[i], 10 * i);
        scale_model(&models[i], 1e-5f, vec(0, 0, 0));
        check_model(&models[i], 10 * i + 3);
        scale_model(&models[i], 1e8f, vec(-3e4f, 2e4f, 0));
        check_model(&models[i], 10 * i + 6);
        model_free(&models[i]);
    }
}

static void test_counts(void **state)
{
    (void)state;
    static packet_rays all;
    model terrain = model_terrain(60, 4, vec(0, 0, 0), 1);
    tl_soup *soup = model_soup(&terrain, NULL);
    make_rays(&terrain, tl_soup_bounds(soup), FAMILY_CAMERA, 5, &all);
    for (uint32_t count = 0; count < 70; count++) {
        (void)check_all(soup, &all, count);
    }
    // A camera's rays are traced together, also where octant and axis change in a row.
    (void)watch(soup, &all);
    TEST_CHECK(apart == 0 && alone < COUNT / 5);
    // So are lines to a light, from wherever they begin.
    make_rays(&terrain, tl_soup_bounds(soup), FAMILY_LIGHT, 5, &all);
    static bool answers[COUNT];
    tl_ray_batch sight = { soup, NULL, all.segments, COUNT, NULL, NULL, answers, false };
    alone = apart = 0;
    test_packets(&sight);
    TEST_CHECK(apart == 0 && alone < COUNT / 5);
    // Rays without order are not, and few of them are looked at.
    make_rays(&terrain, tl_soup_bounds(soup), FAMILY_NOTHING, 5, &all);
    (void)watch(soup, &all);
    TEST_CHECK(apart == 2 * COUNT && alone == 0);
    tl_blob_free(soup);
    model_free(&terrain);
    // Large triangles on one another: rays enter all boxes, and stacks overflow.
    model heap = model_random(3000, 1, 40, 2);
    soup = model_soup(&heap, NULL);
    make_rays(&heap, tl_soup_bounds(soup), FAMILY_PARALLEL, 6, &all);
    (void)watch(soup, &all);
    TEST_CHECK(alone > COUNT / 4);
    tl_blob_free(soup);
    model_free(&heap);
}

// Triangles a rounding apart do not break packets up: the nearest two of a ray are told apart in the packet. Coincident
// ones are one.
static void test_rivals(void **state)
{
    (void)state;
    static packet_rays all;
    model m = model_terrain(30, 4, vec(0, 0, 0), 1);
    uint32_t count = m.triangle_count, vertices = m.vertex_count;
    for (uint32_t i = 0; i < vertices; i++) {
        model_vertex(&m, m.vertices[i].x, nextafterf(m.vertices[i].y, INFINITY), m.vertices[i].z);
    }
    for (uint32_t lifted = 0; lifted < 2; lifted++) {
        const uint32_t to = lifted != 0 ? vertices : 0;
        m.triangle_count = count;
        for (uint32_t i = 0; i < count; i++) {
            model_triangle(&m, to + m.indices[3 * i + 2], to + m.indices[3 * i + 1], to + m.indices[3 * i]);
        }
        tl_soup *soup = model_soup(&m, NULL);
        make_rays(&m, tl_soup_bounds(soup), FAMILY_PARALLEL, 5, &all);
        TEST_CHECK(watch(soup, &all) > COUNT / 4);
        TEST_CHECK(apart == 0 && alone < COUNT / 10);
        tl_blob_free(soup);
    }
    model_free(&m);
}

static void *run_nothing(void *user)
{
    (void)user;
    return NULL;
}

static void *run_batches(void *user)
{
    static packet_rays all;
    static tl_ray_hit hits[COUNT];
    const tl_soup *soup = user;
    for (ray_family family = 0; family < FAMILIES; family++) {
        if (family != FAMILY_CORNERS) { // those are aimed at a model
            make_rays(NULL, tl_soup_bounds(soup), family, 1, &all);
            tl_soup_cast_rays(soup, all.rays, COUNT, NULL, NULL, hits);
        }
    }
    return NULL;
}

// Packets, several rays in flight and single ones use the promised stack, together.
static void test_stack(void **state)
{
    (void)state;
    model terrain = model_terrain(360, 4, vec(0, 0, 0), 1); // large enough for all of them
    tl_soup *soup = model_soup(&terrain, NULL);
    size_t base = painted_stack_used(run_nothing, NULL), used = painted_stack_used(run_batches, soup) - base;
#ifdef FRAMES_ARE_WIDER
    TEST_CHECK(used > 0);
#else
    TEST_CHECK(used > 0 && used < PROMISED_STACK);
#endif
    print_message("batches of rays use %zu bytes of stack\n", used);
    tl_blob_free(soup);
    model_free(&terrain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_bits),
        cmocka_unit_test(test_counts),
        cmocka_unit_test(test_rivals),
        cmocka_unit_test(test_stack),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
