// SPDX-License-Identifier: MIT
//
// The pieces of sample levels. Circles are made of rational points ((1 - t^2) / (1 + t^2), 2t / (1 + t^2)) instead of
// sines, which differ between C libraries.

#include "cli/sample/sample_mesh.h"

#include "base/random.h"

#include <stdlib.h>

void tl_sample_mesh_free(tl_sample_mesh *mesh)
{
    free(mesh->vertices);
    free(mesh->indices);
    tl_sample_mesh zero = { 0 };
    *mesh = zero;
}

tl_mesh_view tl_sample_mesh_as_view(const tl_sample_mesh *mesh)
{
    tl_mesh_view view = { 0 };
    view.vertices = mesh->vertices;
    view.vertex_count = mesh->vertex_count;
    view.indices = mesh->indices;
    view.triangle_count = mesh->triangle_count;
    return view;
}

void tl_sample_place(tl_sample_mesh *mesh, tl_vec3 origin, unsigned quarter_turns)
{
    mesh->origin = origin;
    mesh->quarter_turns = quarter_turns & 3;
}

// Doubles the array when it is full.
static bool reserve_elements(tl_sample_mesh *mesh, void **array, uint32_t count, uint32_t *capacity, size_t size)
{
    if (count < *capacity) {
        return true;
    }
    if (*capacity > UINT32_MAX / 2) {
        mesh->result = TL_ERR_LIMIT;
        return false;
    }
    uint32_t grown = *capacity > 0 ? 2 * *capacity : 1024;
    void *moved = realloc(*array, grown * size);
    if (moved == NULL) {
        mesh->result = TL_ERR_MEMORY;
        return false;
    }
    *array = moved;
    *capacity = grown;
    return true;
}

static tl_vec3 turn_point(tl_vec3 p, unsigned quarter_turns)
{
    switch (quarter_turns) {
    case 1:
        return tl_vec3_make(p.z, p.y, -p.x);
    case 2:
        return tl_vec3_make(-p.x, p.y, -p.z);
    case 3:
        return tl_vec3_make(-p.z, p.y, p.x);
    default:
        return p;
    }
}

uint32_t tl_sample_vertex(tl_sample_mesh *mesh, tl_vec3 local)
{
    if (mesh->counting || mesh->result != TL_OK) {
        return 0;
    }
    void *array = mesh->vertices;
    if (!reserve_elements(mesh, &array, mesh->vertex_count, &mesh->vertex_capacity, sizeof(tl_vec3))) {
        return 0;
    }
    mesh->vertices = array;
    mesh->vertices[mesh->vertex_count] = tl_add(mesh->origin, turn_point(local, mesh->quarter_turns));
    return mesh->vertex_count++;
}

void tl_sample_triangle(tl_sample_mesh *mesh, uint32_t a, uint32_t b, uint32_t c)
{
    if (mesh->result != TL_OK) {
        return;
    }
    if (!mesh->counting) {
        void *array = mesh->indices;
        if (!reserve_elements(mesh, &array, mesh->triangle_count, &mesh->triangle_capacity, 3 * sizeof(uint32_t))) {
            return;
        }
        mesh->indices = array;
        uint32_t *corner = mesh->indices + 3 * (size_t)mesh->triangle_count;
        corner[0] = a;
        corner[1] = b;
        corner[2] = c;
    }
    mesh->triangle_count++;
}

void tl_sample_quad(tl_sample_mesh *mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    tl_sample_triangle(mesh, a, b, c);
    tl_sample_triangle(mesh, a, c, d);
}

void tl_sample_box(tl_sample_mesh *mesh, tl_aabb box)
{
    uint32_t v[8];
    for (unsigned i = 0; i < 8; ++i) {
        v[i] = tl_sample_vertex(mesh, tl_vec3_make(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                                                   i & 4 ? box.max.z : box.min.z));
    }
    tl_sample_quad(mesh, v[0], v[4], v[6], v[2]); // -x
    tl_sample_quad(mesh, v[1], v[3], v[7], v[5]); // +x
    tl_sample_quad(mesh, v[0], v[1], v[5], v[4]); // -y
    tl_sample_quad(mesh, v[2], v[6], v[7], v[3]); // +y
    tl_sample_quad(mesh, v[0], v[2], v[3], v[1]); // -z
    tl_sample_quad(mesh, v[4], v[5], v[7], v[6]); // +z
}

// The end of step i in both sides: foot, the tread's far end, and the riser's top and bottom at its near end.
typedef struct step_end {
    uint32_t foot, low, high;
} step_end;

static step_end add_step_end(tl_sample_mesh *mesh, float x, float foot, float low, float high, float z)
{
    step_end end = { tl_sample_vertex(mesh, tl_vec3_make(x, foot, z)), tl_sample_vertex(mesh, tl_vec3_make(x, low, z)),
                     tl_sample_vertex(mesh, tl_vec3_make(x, high, z)) };
    return end;
}

// The end `steps` has no riser above: its low and high coincide, and the back wall joins its foot and low.
void tl_sample_stairs(tl_sample_mesh *mesh, tl_aabb box, uint32_t steps)
{
    float y = box.min.y;
    float rise = (box.max.y - y) / (float)steps;
    float run = (box.max.x - box.min.x) / (float)steps;
    step_end near_z = add_step_end(mesh, box.min.x, y, y, y + rise, box.min.z);
    step_end far_z = add_step_end(mesh, box.min.x, y, y, y + rise, box.max.z);
    for (uint32_t i = 0; i < steps; ++i) {
        bool last = i + 1 == steps;
        float x = last ? box.max.x : box.min.x + run * (float)(i + 1);
        float low = last ? box.max.y : y + rise * (float)(i + 1);
        float high = last ? box.max.y : y + rise * (float)(i + 2);
        step_end next_near = add_step_end(mesh, x, y, low, high, box.min.z);
        step_end next_far = add_step_end(mesh, x, y, low, high, box.max.z);
        tl_sample_quad(mesh, near_z.low, far_z.low, far_z.high, near_z.high);         // riser
        tl_sample_quad(mesh, near_z.high, far_z.high, next_far.low, next_near.low);   // tread
        tl_sample_quad(mesh, near_z.foot, next_near.foot, next_far.foot, far_z.foot); // underside
        tl_sample_triangle(mesh, next_near.foot, near_z.high, next_near.low);         // sides: fans about the foot
        tl_sample_triangle(mesh, next_far.foot, next_far.low, far_z.high);            // of the far end, so that
        tl_sample_triangle(mesh, next_near.foot, near_z.low, near_z.high);            // neither lacks the corner
        tl_sample_triangle(mesh, next_far.foot, far_z.high, far_z.low);               // between two steps
        if (i > 0) {
            tl_sample_triangle(mesh, next_near.foot, near_z.foot, near_z.low);
            tl_sample_triangle(mesh, next_far.foot, far_z.low, far_z.foot);
        }
        near_z = next_near;
        far_z = next_far;
    }
    tl_sample_quad(mesh, near_z.foot, near_z.low, far_z.low, far_z.foot); // back
}

void tl_sample_ramp(tl_sample_mesh *mesh, tl_aabb box)
{
    uint32_t a = tl_sample_vertex(mesh, box.min);
    uint32_t b = tl_sample_vertex(mesh, tl_vec3_make(box.max.x, box.min.y, box.min.z));
    uint32_t c = tl_sample_vertex(mesh, tl_vec3_make(box.max.x, box.max.y, box.min.z));
    uint32_t d = tl_sample_vertex(mesh, tl_vec3_make(box.min.x, box.min.y, box.max.z));
    uint32_t e = tl_sample_vertex(mesh, tl_vec3_make(box.max.x, box.min.y, box.max.z));
    uint32_t f = tl_sample_vertex(mesh, box.max);
    tl_sample_quad(mesh, a, d, f, c); // slope
    tl_sample_quad(mesh, a, b, e, d); // underside
    tl_sample_quad(mesh, b, c, f, e); // back
    tl_sample_triangle(mesh, a, c, b);
    tl_sample_triangle(mesh, d, e, f);
}

void tl_sample_gable(tl_sample_mesh *mesh, tl_aabb box)
{
    float middle = 0.5f * (box.min.z + box.max.z);
    uint32_t v[6];
    for (unsigned i = 0; i < 2; ++i) {
        float x = i ? box.max.x : box.min.x;
        v[3 * i] = tl_sample_vertex(mesh, tl_vec3_make(x, box.min.y, box.min.z));
        v[3 * i + 1] = tl_sample_vertex(mesh, tl_vec3_make(x, box.min.y, box.max.z));
        v[3 * i + 2] = tl_sample_vertex(mesh, tl_vec3_make(x, box.max.y, middle));
    }
    tl_sample_quad(mesh, v[0], v[2], v[5], v[3]); // slope towards -z
    tl_sample_quad(mesh, v[1], v[4], v[5], v[2]); // slope towards +z
    tl_sample_quad(mesh, v[0], v[3], v[4], v[1]); // underside
    tl_sample_triangle(mesh, v[0], v[1], v[2]);
    tl_sample_triangle(mesh, v[3], v[5], v[4]);
}

// Point i of 4 * quarter_sides on the unit circle in the plane of two axes.
static void circle_point(uint32_t i, uint32_t quarter_sides, float *u_out, float *v_out)
{
    float t = (float)(i % quarter_sides) / (float)quarter_sides;
    float scale = 1.0f / (1.0f + t * t);
    float c = (1.0f - t * t) * scale;
    float s = 2.0f * t * scale;
    uint32_t quarter = i / quarter_sides % 4;
    *u_out = quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s;
    *v_out = quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c;
}

void tl_sample_pillar(tl_sample_mesh *mesh, tl_vec3 base, float radius, float height, uint32_t quarter_sides)
{
    uint32_t sides = 4 * quarter_sides;
    uint32_t first = 0;
    for (uint32_t i = 0; i < sides; ++i) {
        float u, v;
        circle_point(i, quarter_sides, &u, &v);
        tl_vec3 foot = tl_add(base, tl_vec3_make(radius * u, 0.0f, radius * v));
        uint32_t index = tl_sample_vertex(mesh, foot);
        tl_sample_vertex(mesh, tl_vec3_make(foot.x, base.y + height, foot.z));
        first = i == 0 ? index : first;
    }
    for (uint32_t i = 0; i < sides; ++i) {
        uint32_t a = first + 2 * i;
        uint32_t b = first + 2 * ((i + 1) % sides);
        tl_sample_quad(mesh, a, a + 1, b + 1, b);
        if (i >= 2) { // both ends are fans about point 0
            tl_sample_triangle(mesh, first, a - 2, a);
            tl_sample_triangle(mesh, first + 1, a + 1, a - 1);
        }
    }
}

void tl_sample_arch(tl_sample_mesh *mesh, tl_vec3 base, float inner_radius, float outer_radius, float depth,
                    uint32_t segments)
{
    uint32_t quarter = (segments + 1) / 2;
    uint32_t first = 0;
    for (uint32_t i = 0; i <= 2 * quarter; ++i) {
        float u, v;
        circle_point(i, quarter, &u, &v);
        for (unsigned k = 0; k < 4; ++k) {
            float radius = k & 1 ? outer_radius : inner_radius;
            float z = k & 2 ? 0.5f * depth : -0.5f * depth;
            uint32_t index = tl_sample_vertex(mesh, tl_add(base, tl_vec3_make(radius * u, radius * v, z)));
            first = i == 0 && k == 0 ? index : first;
        }
    }
    for (uint32_t i = 0; i < 2 * quarter; ++i) {
        uint32_t a = first + 4 * i;
        uint32_t b = a + 4;
        tl_sample_quad(mesh, a, a + 2, b + 2, b);         // inside
        tl_sample_quad(mesh, a + 1, b + 1, b + 3, a + 3); // outside
        tl_sample_quad(mesh, a, b, b + 1, a + 1);         // towards -z
        tl_sample_quad(mesh, a + 2, a + 3, b + 3, b + 2); // towards +z
    }
    uint32_t last = first + 8 * quarter;
    tl_sample_quad(mesh, first, first + 1, first + 3, first + 2);
    tl_sample_quad(mesh, last, last + 2, last + 3, last + 1);
}

typedef struct rock_shape {
    tl_vec3 center;
    float radius;
    uint64_t seed;
} rock_shape;

// A dent by direction: the same for equal directions, so that split edges meet.
static tl_vec3 rock_point(const rock_shape *rock, tl_vec3 direction)
{
    tl_vec3 d = tl_normalize(direction);
    float swell = 1.0f;
    for (uint64_t k = 0; k < 5; ++k) {
        tl_sample_random random = tl_sample_random_make(rock->seed, k, 17);
        tl_vec3 axis = { tl_sample_random_range(&random, -1, 1), tl_sample_random_range(&random, -1, 1),
                         tl_sample_random_range(&random, -1, 1) };
        float along = tl_dot(d, tl_normalize(axis));
        swell -= 0.35f * tl_maxf(along - 0.55f, 0.0f);
    }
    return tl_mul_add(rock->center, d, rock->radius * swell);
}

static void split_rock_face(tl_sample_mesh *mesh, const rock_shape *rock, tl_vec3 a, tl_vec3 b, tl_vec3 c,
                            uint32_t level)
{
    if (level == 0) {
        uint32_t i = tl_sample_vertex(mesh, rock_point(rock, a));
        uint32_t j = tl_sample_vertex(mesh, rock_point(rock, b));
        uint32_t k = tl_sample_vertex(mesh, rock_point(rock, c));
        tl_sample_triangle(mesh, i, j, k);
        return;
    }
    tl_vec3 ab = tl_scale(tl_add(a, b), 0.5f);
    tl_vec3 bc = tl_scale(tl_add(b, c), 0.5f);
    tl_vec3 ca = tl_scale(tl_add(c, a), 0.5f);
    split_rock_face(mesh, rock, a, ab, ca, level - 1);
    split_rock_face(mesh, rock, ab, b, bc, level - 1);
    split_rock_face(mesh, rock, ca, bc, c, level - 1);
    split_rock_face(mesh, rock, ab, bc, ca, level - 1);
}

void tl_sample_rock(tl_sample_mesh *mesh, tl_vec3 center, float radius, uint32_t level, uint64_t seed)
{
    if (mesh->counting) {
        mesh->triangle_count += 8u << (2 * level);
        return;
    }
    const rock_shape rock = { center, radius, seed };
    for (unsigned i = 0; i < 8; ++i) {
        tl_vec3 x = tl_vec3_make(i & 1 ? -1.0f : 1.0f, 0, 0);
        tl_vec3 y = tl_vec3_make(0, i & 2 ? -1.0f : 1.0f, 0);
        tl_vec3 z = tl_vec3_make(0, 0, i & 4 ? -1.0f : 1.0f);
        bool mirrored = ((i & 1) + (i >> 1 & 1) + (i >> 2 & 1)) % 2 != 0;
        split_rock_face(mesh, &rock, x, mirrored ? z : y, mirrored ? y : z, level);
    }
}

tl_sample_random tl_sample_random_make(uint64_t seed, uint64_t x, uint64_t z)
{
    tl_sample_random random = { seed };
    random.state = tl_sample_random_u64(&random) ^ (x * 0x9e3779b97f4a7c15u);
    random.state = tl_sample_random_u64(&random) ^ (z * 0xc2b2ae3d27d4eb4fu);
    return random;
}

uint64_t tl_sample_random_u64(tl_sample_random *random)
{
    return tl_random_bits(&random->state);
}

uint32_t tl_sample_random_below(tl_sample_random *random, uint32_t bound)
{
    return tl_random_below(&random->state, bound);
}

float tl_sample_random_range(tl_sample_random *random, float low, float high)
{
    float unit = (float)(tl_sample_random_u64(random) >> 40) * (1.0f / 16777216.0f);
    return low + (high - low) * unit;
}
