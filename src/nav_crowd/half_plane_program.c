// SPDX-License-Identifier: MIT
//
// Linear programming in two dimensions, one half-plane at a time: while the answer so far keeps the next one, nothing
// is done; else the new answer lies on its line, cut by the half-planes before. An agent has some ten of them, and the
// nearest neighbours come first, which decide most. Where nothing is left the half-planes of neighbours are pushed
// outward at one speed until something is: the highest lower bound of three dimensions, solved in two on the bisectors
// of each pair.
//
// Sources: de Berg, Cheong, van Kreveld, Overmars, Computational Geometry, 2008, chapter 4; van den Berg, Guy, Lin,
// Manocha, Reciprocal n-Body Collision Avoidance, 2011, section 5.3, for the second program.

#include "nav_crowd/half_plane_program.h"

#include "base/assert.h"
#include "base/min_max.h"

#include <math.h>
#include <stdbool.h>

// The sine of two directions below which their lines do not cross at a usable place: each direction is rounded by some
// 1e-7, so the crossing would be off by more than a hundredth of its distance.
#define PARALLEL_SINE 1e-5f

typedef struct goal_point {
    float x, z;
    bool is_direction; // unit: as far as possible that way
} goal_point;

static float cross(float ax, float az, float bx, float bz)
{
    return ax * bz - az * bx;
}

// How far a point lies outside a half-plane; <= 0 within.
static float excess(const tl_half_plane *plane, float x, float z)
{
    return cross(plane->along_x, plane->along_z, plane->x - x, plane->z - z);
}

// The best point on the line of plane `at`, within the planes before it and the disc. False: there is none.
static bool solve_on_line(const tl_half_plane *planes, uint32_t at, float radius, const goal_point *goal, float out[2])
{
    const tl_half_plane *line = &planes[at];
    float middle = -(line->x * line->along_x + line->z * line->along_z);
    float off = cross(line->along_x, line->along_z, line->x, line->z);
    float half_sq = radius * radius - off * off;
    if (!(half_sq >= 0.0f)) {
        return false;
    }
    float half = sqrtf(half_sq);
    float low = middle - half;
    float high = middle + half;
    for (uint32_t k = 0; k < at; k++) {
        float sine = cross(line->along_x, line->along_z, planes[k].along_x, planes[k].along_z);
        float behind = cross(planes[k].along_x, planes[k].along_z, line->x - planes[k].x, line->z - planes[k].z);
        if (fabsf(sine) <= PARALLEL_SINE) {
            if (behind < 0.0f) {
                return false;
            }
            continue;
        }
        float t = behind / sine;
        if (sine >= 0.0f) {
            high = tl_min_f32(high, t);
        } else {
            low = tl_max_f32(low, t);
        }
        if (low > high) {
            return false;
        }
    }
    float t;
    if (goal->is_direction) {
        t = goal->x * line->along_x + goal->z * line->along_z > 0.0f ? high : low;
    } else {
        t = line->along_x * (goal->x - line->x) + line->along_z * (goal->z - line->z);
        t = tl_clamp_f32(t, low, high);
    }
    out[0] = line->x + t * line->along_x;
    out[1] = line->z + t * line->along_z;
    return true;
}

// Returns how many planes the answer keeps: all, or the number of the first one with which there is none.
static uint32_t solve(const tl_half_plane *planes, uint32_t count, float radius, const goal_point *goal, float out[2])
{
    float scale = goal->is_direction ? radius : 1.0f;
    out[0] = goal->x * scale;
    out[1] = goal->z * scale;
    for (uint32_t k = 0; k < count; k++) {
        if (excess(&planes[k], out[0], out[1]) > 0.0f) {
            float better[2];
            if (!solve_on_line(planes, k, radius, goal, better)) {
                return k;
            }
            out[0] = better[0];
            out[1] = better[1];
        }
    }
    return count;
}

// Where `a` is violated no more than `b`: the difference of both, which is linear. Found without the crossing of the
// two lines, which may lie anywhere. False: they run the same way, and one holds the other.
static bool bisector(const tl_half_plane *a, const tl_half_plane *b, tl_half_plane *out)
{
    float x = a->along_x - b->along_x;
    float z = a->along_z - b->along_z;
    float length = sqrtf(x * x + z * z);
    if (!(length > PARALLEL_SINE)) {
        return false;
    }
    float off = (cross(a->along_x, a->along_z, a->x, a->z) - cross(b->along_x, b->along_z, b->x, b->z)) / length;
    out->along_x = x / length;
    out->along_z = z / length;
    out->x = -out->along_z * off;
    out->z = out->along_x * off;
    return true;
}

// From the plane on with which there was no answer: lets each plane be violated, by as little as it must.
static void solve_relaxed(const tl_half_plane_program *program, uint32_t first, float out[2])
{
    float distance = 0.0f;
    tl_half_plane planes[TL_MAX_HALF_PLANES];
    for (uint32_t i = 0; i < program->hard_count; i++) {
        planes[i] = program->planes[i];
    }
    for (uint32_t i = first; i < program->count; i++) {
        const tl_half_plane *plane = &program->planes[i];
        if (excess(plane, out[0], out[1]) <= distance) {
            continue;
        }
        uint32_t count = program->hard_count;
        for (uint32_t k = program->hard_count; k < i; k++) {
            count += bisector(&program->planes[k], plane, &planes[count]);
        }
        const goal_point goal = { -plane->along_z, plane->along_x, true };
        float better[2];
        // By its construction the answer so far is feasible; where rounding says otherwise it is kept.
        if (solve(planes, count, program->max_length, &goal, better) == count) {
            out[0] = better[0];
            out[1] = better[1];
        }
        distance = excess(plane, out[0], out[1]);
    }
}

void tl_half_plane_solve(const tl_half_plane_program *program, float velocity_out[2])
{
    TL_ASSERT(program->count <= TL_MAX_HALF_PLANES && program->hard_count <= program->count);
    const goal_point goal = { program->wanted_x, program->wanted_z, false };
    uint32_t kept = solve(program->planes, program->count, program->max_length, &goal, velocity_out);
    if (kept < program->count) {
        solve_relaxed(program, kept < program->hard_count ? program->hard_count : kept, velocity_out);
    }
}
