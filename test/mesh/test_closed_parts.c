// SPDX-License-Identifier: MIT
//
// Closed parts: boxes apart, side by side, on open floors, inside out, with a hole; shuffled triangles; and the rule
// itself as an oracle on random soups of few vertices.

#include "talus_test.h"

#include <string.h>
#include <talus/mesh.h>

enum { MAX_VERTICES = 512, MAX_TRIANGLES = 512 };

typedef struct scene {
    tl_vec3 vertices[MAX_VERTICES];
    uint32_t indices[3 * MAX_TRIANGLES];
    uint32_t vertex_count, triangle_count;
} scene;

// Corners at equal places are one, as in a welded mesh.
static uint32_t vertex(scene *s, float x, float y, float z)
{
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        if (s->vertices[i].x == x && s->vertices[i].y == y && s->vertices[i].z == z) {
            return i;
        }
    }
    TEST_CHECK(s->vertex_count < MAX_VERTICES);
    s->vertices[s->vertex_count] = tl_vec3_make(x, y, z);
    return s->vertex_count++;
}

static void triangle(scene *s, uint32_t a, uint32_t b, uint32_t c)
{
    TEST_CHECK(s->triangle_count < MAX_TRIANGLES);
    uint32_t *corner = s->indices + 3 * s->triangle_count++;
    corner[0] = a;
    corner[1] = b;
    corner[2] = c;
}

static void quad(scene *s, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    triangle(s, a, b, c);
    triangle(s, a, c, d);
}

// A cube that faces outwards; `faces` are left out where their bit is not set.
static void box(scene *s, float x, float y, float z, float size, uint32_t faces)
{
    uint32_t v[8];
    for (uint32_t i = 0; i < 8; i++) {
        v[i] = vertex(s, x + (i & 1 ? size : 0), y + (i & 2 ? size : 0), z + (i & 4 ? size : 0));
    }
    static const uint8_t corners[6][4] = { { 2, 6, 7, 3 }, { 0, 1, 5, 4 }, { 0, 4, 6, 2 },
                                           { 1, 3, 7, 5 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
    for (uint32_t f = 0; f < 6; f++) {
        if (faces >> f & 1) {
            quad(s, v[corners[f][0]], v[corners[f][1]], v[corners[f][2]], v[corners[f][3]]);
        }
    }
}

static void turn_inside_out(scene *s, uint32_t from)
{
    for (uint32_t t = from; t < s->triangle_count; t++) {
        const uint32_t b = s->indices[3 * t + 1];
        s->indices[3 * t + 1] = s->indices[3 * t + 2];
        s->indices[3 * t + 2] = b;
    }
}

static tl_closed_parts find(const scene *s)
{
    const tl_mesh_view view = { s->vertices, s->vertex_count, s->indices, s->triangle_count, NULL };
    tl_closed_parts parts;
    TEST_RESULT(tl_closed_parts_find(&view, NULL, &parts, NULL), TL_OK);
    return parts;
}

static void boxes_are_closed_whatever_they_touch(void **state)
{
    (void)state;
    static scene s;
    memset(&s, 0, sizeof s);
    // An open floor of two quads that shares edges with boxes.
    quad(&s, vertex(&s, 0, 0, 0), vertex(&s, 0, 0, 2), vertex(&s, 2, 0, 2), vertex(&s, 2, 0, 0));
    quad(&s, vertex(&s, 2, 0, 0), vertex(&s, 2, 0, 2), vertex(&s, 4, 0, 2), vertex(&s, 4, 0, 0));
    box(&s, 4, 0, 0, 2, 63); // on the floor's edge
    box(&s, 6, 0, 0, 2, 63); // face to face with it: one part
    box(&s, 20, 0, 0, 3, 63);
    const uint32_t room = s.triangle_count;
    box(&s, 30, 0, 0, 10, 63);
    turn_inside_out(&s, room);
    box(&s, 50, 0, 0, 2, 31); // with a hole
    tl_closed_parts parts = find(&s);
    TEST_CHECK(parts.part_count == 3 && parts.open_part_count == 2);
    for (uint32_t t = 0; t < s.triangle_count; t++) {
        const uint32_t expected = t < 4 ? TL_NO_PART : t < 28 ? 0 : t < 40 ? 1 : t < 52 ? 2 : TL_NO_PART;
        TEST_CHECK(parts.part_of[t] == expected);
    }
    TEST_CHECK(fabs(parts.volumes[0] - 16.0) < 1e-9 && fabs(parts.volumes[1] - 27.0) < 1e-9);
    TEST_CHECK(fabs(parts.volumes[2] + 1000.0) < 1e-9);
    tl_closed_parts_free(&parts);
    // A triangle the wrong way round opens its box.
    const uint32_t b = s.indices[3 * 30 + 1];
    s.indices[3 * 30 + 1] = s.indices[3 * 30 + 2];
    s.indices[3 * 30 + 2] = b;
    parts = find(&s);
    TEST_CHECK(parts.part_count == 2 && parts.part_of[28] == TL_NO_PART && parts.part_of[40] == 1);
    tl_closed_parts_free(&parts);
}

// The definition, triangle by triangle: spread across balanced edges, then sum each edge over the part.
static int32_t sum_of_edge(const scene *s, uint32_t a, uint32_t b, const uint32_t *part, uint32_t only)
{
    int32_t sum = 0;
    for (uint32_t i = 0; i < 3 * s->triangle_count; i++) {
        const uint32_t from = s->indices[i], to = s->indices[i - i % 3 + (i + 1) % 3];
        if (part == NULL || part[i / 3] == only) {
            sum += from == a && to == b ? 1 : from == b && to == a ? -1 : 0;
        }
    }
    return sum;
}

static bool share_balanced_edge(const scene *s, uint32_t t, uint32_t u)
{
    for (uint32_t k = 0; k < 9; k++) {
        const uint32_t *p = s->indices + 3 * t, *q = s->indices + 3 * u;
        const uint32_t a = p[k % 3], b = p[(k + 1) % 3], c = q[k / 3], d = q[(k / 3 + 1) % 3];
        if (((a == c && b == d) || (a == d && b == c)) && sum_of_edge(s, a, b, NULL, 0) == 0) {
            return true;
        }
    }
    return false;
}

static void random_soups_follow_the_rule(void **state)
{
    (void)state;
    static scene s;
    test_random random = { 11 };
    uint32_t closed = 0, open = 0;
    for (uint32_t run = 0; run < 400; run++) {
        memset(&s, 0, sizeof s);
        const uint32_t vertices = 5 + test_random_below(&random, 4);
        s.vertex_count = vertices;
        for (uint32_t i = 0; i < 3; i++) { // tetrahedra over common vertices, some with a face missing
            uint32_t v[4];
            for (uint32_t k = 0; k < 4; k++) {
                v[k] = (test_random_below(&random, vertices - 3) + k) % vertices;
            }
            if (v[0] == v[1] || v[0] == v[2] || v[0] == v[3] || v[1] == v[2] || v[1] == v[3] || v[2] == v[3]) {
                continue;
            }
            const uint32_t missing = test_random_below(&random, 8);
            static const uint8_t faces[4][3] = { { 0, 1, 2 }, { 0, 3, 1 }, { 1, 3, 2 }, { 0, 2, 3 } };
            for (uint32_t f = 0; f < 4; f++) {
                if (f != missing) {
                    triangle(&s, v[faces[f][0]], v[faces[f][1]], v[faces[f][2]]);
                }
            }
        }
        uint32_t part[MAX_TRIANGLES];
        for (uint32_t t = 0; t < s.triangle_count; t++) {
            part[t] = t;
        }
        for (bool moved = true; moved;) {
            moved = false;
            for (uint32_t t = 0; t < s.triangle_count; t++) {
                for (uint32_t u = 0; u < s.triangle_count; u++) {
                    if (part[u] < part[t] && share_balanced_edge(&s, t, u)) {
                        part[t] = part[u];
                        moved = true;
                    }
                }
            }
        }
        tl_closed_parts parts = find(&s);
        for (uint32_t t = 0; t < s.triangle_count; t++) {
            bool is_closed = true;
            for (uint32_t i = 0; i < 3 * s.triangle_count; i++) {
                if (part[i / 3] == part[t]) {
                    is_closed = is_closed &&
                                sum_of_edge(&s, s.indices[i], s.indices[i - i % 3 + (i + 1) % 3], part, part[t]) == 0;
                }
            }
            TEST_CHECK((parts.part_of[t] != TL_NO_PART) == is_closed);
            closed += is_closed;
            open += !is_closed;
            for (uint32_t u = 0; is_closed && u < t; u++) {
                TEST_CHECK((parts.part_of[u] == parts.part_of[t]) == (part[u] == part[t]));
            }
        }
        tl_closed_parts_free(&parts);
    }
    TEST_CHECK(closed > 500 && open > 500);
}

static void failing_memory_leaves_nothing(void **state)
{
    (void)state;
    static scene s;
    memset(&s, 0, sizeof s);
    box(&s, 0, 0, 0, 1, 63);
    const tl_mesh_view view = { s.vertices, s.vertex_count, s.indices, s.triangle_count, NULL };
    for (uint64_t k = 1;; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k);
        const tl_host host = { &memory.allocator, NULL, NULL };
        tl_closed_parts parts;
        const tl_result result = tl_closed_parts_find(&view, &host, &parts, NULL);
        TEST_CHECK(result == TL_OK || parts.part_of == NULL);
        tl_closed_parts_free(&parts);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
        if (result == TL_OK) {
            TEST_CHECK(k > 3);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(boxes_are_closed_whatever_they_touch),
                                        cmocka_unit_test(random_soups_follow_the_rule),
                                        cmocka_unit_test(failing_memory_leaves_nothing) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
