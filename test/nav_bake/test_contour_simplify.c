// SPDX-License-Identifier: MIT
//
// Contour simplification: error, edge length, and the same edges on both sides.

#include "nav_contour_checks.h"

#include "nav_bake/contours/contours.h"

typedef struct simplified {
    tl_nav_compact compact;
    tl_nav_config config;
    tl_arena arena;
    tl_contour_work work;
} simplified;

static void simplify(simplified *s, tl_nav_compact compact, tl_nav_config config)
{
    s->compact = compact;
    s->config = config;
    TEST_RESULT(tl_nav_distance_field(NULL, &s->compact, NULL), TL_OK);
    TEST_RESULT(tl_nav_bake_regions(&s->config, NULL, &s->compact, NULL), TL_OK);
    tl_arena_init(&s->arena, NULL);
    memset(&s->work, 0, sizeof s->work);
    s->work.config = &s->config;
    s->work.compact = &s->compact;
    s->work.arena = &s->arena;
    TEST_RESULT(tl_contours_trace(&s->work), TL_OK);
    TEST_RESULT(tl_contours_simplify(&s->work), TL_OK);
}

static void end(simplified *s)
{
    tl_arena_free(&s->arena);
    fixture_compact_free(&s->compact);
}

static double distance(const tl_contour_vertex *p, const tl_contour_vertex *a, const tl_contour_vertex *b)
{
    double dx = b->x - a->x, dz = b->z - a->z, length_sq = dx * dx + dz * dz;
    double t = length_sq > 0 ? ((p->x - a->x) * dx + (p->z - a->z) * dz) / length_sq : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(p->x - (a->x + t * dx), p->z - (a->z + t * dz));
}

static uint32_t next_kept(const tl_contour_work *work, uint32_t vertex)
{
    do {
        vertex = tl_contour_next(work, vertex);
    } while (!work->keep[vertex]);
    return vertex;
}

static tl_nav_config random_config(test_random *random, int round)
{
    uint32_t min_area = test_random_below(random, 20);
    tl_nav_config config = region_config((tl_nav_partition)(round % 3), min_area, test_random_below(random, 200));
    config.max_simplification_error = round % 6 == 0 ? 0.0f : test_random_range(random, 0.3f, 4.0f);
    config.max_edge_len = round % 2 == 0 ? 0 : 2 + test_random_below(random, 20);
    return config;
}

// Walls and area borders stay within max_error, walls within max_edge_len; nothing else is bent.
static void within_error_and_length(void **state)
{
    (void)state;
    test_random random = { 61 };
    uint32_t removed = 0, split = 0, straight = 0;
    for (int round = 0; round < 90; round++) {
        simplified s;
        tl_nav_config config = random_config(&random, round);
        simplify(&s,
                 fixture_random(&random, 45, 45, 1 + round % 3, test_random_below(&random, 12), round % 5 == 4 ? 3 : 0),
                 config);
        const tl_contour_work *work = &s.work;
        for (uint32_t k = 0; k < work->vertex_count; k++) {
            if (!work->keep[k]) {
                continue;
            }
            uint32_t stop = next_kept(work, k);
            const tl_contour_vertex *a = &work->vertices[k], *b = &work->vertices[stop];
            bool wall = work->across[k] == 0;
            bool fitted = wall || (a->flags & TL_CONTOUR_AREA_BORDER) != 0;
            uint32_t steps = 1;
            for (uint32_t v = tl_contour_next(work, k); v != stop; v = tl_contour_next(work, v), steps++) {
                TEST_CHECK(work->across[v] == work->across[k]);
                TEST_CHECK(!fitted || distance(&work->vertices[v], a, b) <=
                                          (double)config.max_simplification_error * (1 + 1e-12) + 1e-12);
                removed++;
            }
            double length = hypot(b->x - a->x, b->z - a->z);
            TEST_CHECK(!wall || config.max_edge_len == 0 || steps == 1 || length <= config.max_edge_len);
            split += wall && config.max_edge_len > 0 && length > 0.4 * config.max_edge_len;
            straight += !fitted && steps > 3;
        }
        end(&s);
    }
    TEST_CHECK(removed > 5000 && split > 200 && straight > 50);
}

// Across each edge between two regions the other region keeps the very same vertices.
static void both_sides_agree(void **state)
{
    (void)state;
    test_random random = { 62 };
    uint32_t shared = 0, inner = 0;
    for (int round = 0; round < 120; round++) {
        simplified s;
        tl_nav_config config = random_config(&random, round);
        simplify(&s,
                 round % 6 == 5 ? fixture_spiral(12 + test_random_below(&random, 20), 2, 3)
                                : fixture_random(&random, 45, 45, 1 + round % 3, test_random_below(&random, 14),
                                                 round % 5 == 4 ? 3 : 0),
                 config);
        for (int repaired = 0; repaired < 2; repaired++) {
            const tl_contour_work *work = &s.work;
            for (uint32_t k = 0; k < work->vertex_count; k++) {
                uint32_t twin = work->twin[k];
                if (twin == TL_NO_TWIN) {
                    continue;
                }
                // The edge's begin is the twin's end.
                TEST_CHECK(work->keep[k] == work->keep[tl_contour_next(work, twin)]);
                TEST_CHECK(work->keep[tl_contour_next(work, k)] == work->keep[twin]);
                shared++;
                inner += work->keep[k];
            }
            TEST_RESULT(tl_contours_repair(&s.work), TL_OK);
        }
        end(&s);
    }
    TEST_CHECK(shared > 5000 && inner > 500);
}

static void example_rectangle(void **state)
{
    (void)state;
    static const char *const rows[] = { "000000", "000000", "000000" };
    simplified s;
    tl_nav_config config = region_config(TL_NAV_MONOTONE, 0, 0);
    config.max_simplification_error = 1.0f;
    simplify(&s, fixture_from_rows(rows, 3, 0), config);
    uint32_t room[18];
    tl_contour_path path = { room, 0 };
    tl_contours_simplified(&s.work, 0, &path);
    static const int expected[4][2] = { { 0, 0 }, { 0, 3 }, { 6, 3 }, { 6, 0 } };
    TEST_CHECK(path.count == 4);
    for (int k = 0; k < 4; k++) {
        TEST_CHECK(s.work.vertices[room[k]].x == expected[k][0] && s.work.vertices[room[k]].z == expected[k][1]);
    }
    end(&s);
}

// A corridor whose end is one column wide simplifies to a spike: gone from the path.
static void spikes_are_dropped(void **state)
{
    (void)state;
    static const char *const rows[] = { "00000      ", "00000000000", "00000      ", "00000      " };
    simplified s;
    tl_nav_config config = region_config(TL_NAV_MONOTONE, 0, 100);
    config.max_simplification_error = 1.5f;
    simplify(&s, fixture_from_rows(rows, 4, 0), config);
    uint32_t room[64];
    tl_contour_path path = { room, 0 };
    tl_contours_simplified(&s.work, 0, &path);
    TEST_CHECK(path.count >= 3);
    for (uint32_t k = 0; k < path.count; k++) {
        const tl_contour_vertex *a = &s.work.vertices[room[k]], *c = &s.work.vertices[room[(k + 2) % path.count]];
        TEST_CHECK(a->x != c->x || a->z != c->z);
    }
    end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(within_error_and_length),
        cmocka_unit_test(both_sides_agree),
        cmocka_unit_test(example_rectangle),
        cmocka_unit_test(spikes_are_dropped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
