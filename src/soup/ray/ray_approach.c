// SPDX-License-Identifier: MIT
//
// Rays from far away begin their walk in front of the soup.
//
// The pad of a slab grows with the distance from the origin: from 10^8 m it is 100 m, so the ray would enter every box
// of a level, and beyond 10^15 m there are no filters. So the filters get an origin that has moved along the line to
// about the size of the soup's box before it. That origin is found in double words, nearly exact however far the ray
// comes from: a step s of 24 bits makes s D exact, and leaves at most 2^-19 of the way. What is hit, and its t, are
// decided from the ray as it was given. Of its t many are equal after rounding (8 m apart at 10^8 m), so lanes are not
// told apart by intervals: each that the line may meet is decided.
//
// With M the distance gone, a step's sum errs by 2^-105 of it at most (2^-106 times 2 for a double word and a double,
// Joldes, Muller, Popescu, Tight and Rigorous Error Bounds for Basic Building Blocks of Double-Word Arithmetic, 2017);
// the first step is exact. The slab test in double is Kay's and Kajiya's, 1986.

#include "base/min_max.h"
#include "soup/ray/ray_prepare.h"

#include <string.h>

enum { MAX_STEPS = 9 }; // 19 bits each, of a way of 2^128 to the least box that floats have

// Errors of one step in double words, with a margin.
#define STEP_ERROR 0x1p-104
// Of the slab test: positions and planes round by 2^-53, a segment's direction, the quotient.
#define SLAB_ERROR 0x1p-48

typedef struct double_word {
    double high, low;
} double_word;

// A point on the line, and where.
typedef struct line_place {
    double_word at[3];
    double t;
    double error[3]; // metres
} line_place;

typedef struct approached_line {
    double origin[3];
    double base[3]; // a point of the line is origin + t (target - base)
    double target[3];
    double direction[3];
    double low[3], high[3]; // the soup's box
    double size;            // its largest side
} approached_line;

// Both parts of a + b, exactly (Knuth).
static double_word sum_with_rest(double a, double b)
{
    double sum = a + b, other = sum - a;
    double_word r = { sum, (a - (sum - other)) + (b - other) };
    return r;
}

static double_word add_to_word(double_word a, double b)
{
    double_word sum = sum_with_rest(a.high, b);
    double low = sum.low + a.low;
    double_word r = { sum.high + low, low - ((sum.high + low) - sum.high) };
    return r;
}

static double with_24_bits(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    bits &= ~(uint64_t)0x1fffffff;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static approached_line describe_line(const tl_ray_job *job)
{
    approached_line line;
    const float *low = &job->soup->bounds_min.x, *high = &job->soup->bounds_max.x;
    line.size = 0.0;
    for (int i = 0; i < 3; i++) {
        line.origin[i] = (double)job->origin.lane[i];
        line.target[i] = (double)job->target.lane[i];
        line.base[i] = job->is_segment ? line.origin[i] : 0.0;
        line.direction[i] = line.target[i] - line.base[i];
        line.low[i] = (double)low[i];
        line.high[i] = (double)high[i];
        line.size = tl_max_f64(line.size, line.high[i] - line.low[i]);
    }
    return line;
}

// From the line's origin. Of a segment's t 24 bits behind the point, so that 1 - t is exact too.
static void leap(const approached_line *line, double t, bool is_segment, line_place *place)
{
    place->t = is_segment ? floor(tl_min_f64(t, 1.0) * 0x1p24) * 0x1p-24 : with_24_bits(t);
    double rest = is_segment ? 1.0 - place->t : 1.0;
    for (int i = 0; i < 3; i++) {
        place->at[i] = sum_with_rest(rest * line->origin[i], place->t * line->target[i]);
    }
}

static void step(const approached_line *line, double t, line_place *place)
{
    t = with_24_bits(t);
    place->t += t;
    for (int i = 0; i < 3; i++) {
        double there = t * line->target[i], here = t * line->base[i];
        place->error[i] += STEP_ERROR * (fabs(place->at[i].high) + fabs(there) + fabs(here));
        place->at[i] = add_to_word(add_to_word(place->at[i], there), -here);
    }
}

// Along the axis z of the largest component to a box's size in front of the box. False: the origin is not before it.
static bool approach_box(const approached_line *line, uint32_t z, bool is_segment, line_place *place)
{
    bool ascends = line->direction[z] > 0.0;
    double goal = ascends ? line->low[z] - line->size : line->high[z] + line->size;
    memset(place, 0, sizeof *place);
    leap(line, 0.0, is_segment, place);
    for (int i = 0; i < MAX_STEPS; i++) {
        double rest = (goal - place->at[z].high) / line->direction[z] * (1.0 - 0x1p-20); // never beyond the goal
        if (!(rest * fabs(line->direction[z]) > line->size)) {
            break;
        }
        if (i == 0) {
            leap(line, rest, is_segment, place);
        } else {
            step(line, rest, place);
        }
    }
    double ahead = ascends ? line->low[z] - place->at[z].high : place->at[z].high - line->high[z];
    return ahead > 0.5 * line->size && ahead < 3.0 * line->size;
}

// Whether the line surely misses the box, from `place` on and up to box t `end`.
static bool misses_box(const approached_line *line, const line_place *place, double end)
{
    double first = 0.0, last = end;
    for (int i = 0; i < 3; i++) {
        double at = place->at[i].high, d = line->direction[i];
        double margin = SLAB_ERROR * (fabs(at) + fabs(line->low[i]) + fabs(line->high[i])) + place->error[i];
        double below = line->low[i] - at - margin, above = line->high[i] - at + margin;
        if (d == 0.0) {
            last = below > 0.0 || above < 0.0 ? -1.0 : last;
        } else {
            first = tl_max_f64(first, (d > 0.0 ? below : above) / d);
            last = tl_min_f64(last, (d > 0.0 ? above : below) / d);
        }
    }
    return first > last;
}

// The filters' constants from the place. Its coordinates are rounded to floats: slabs and corners take that too.
static void prepare_filters_at(tl_ray_job *job, const approached_line *line, const line_place *place)
{
    float origin[4] = { 0 }, direction[4] = { 0 };
    double largest = 0.0;
    for (int i = 0; i < 3; i++) {
        largest = tl_max_f64(largest, fabs(line->direction[i]));
    }
    double scale = tl_ray_power_scale(largest);
    for (int i = 0; i < 3; i++) {
        origin[i] = (float)place->at[i].high;
        direction[i] = (float)(line->direction[i] * scale);
    }
    tl_f32x4 scaled = tl_f32x4_load(direction), size = tl_f32x4_abs(scaled);
    job->box_t.scale = (float)(1.0 / scale);
    tl_ray_prepare_filters(job, tl_f32x4_load(origin), scaled, size, tl_f32x4_max_of_three(size));
    for (int i = 0; i < 3; i++) {
        // A rounding of the origin, and one of the sums.
        double moved = 2.0 * (double)TL_FLOAT_ROUNDING * fabs(place->at[i].high) + 1.01 * place->error[i];
        float share = i == (int)job->axes[2] ? tl_max_f32(fabsf(job->shear[0]), fabsf(job->shear[1])) : 1.0f;
        float shift = (float)moved * 1.01f + FLT_MIN, pad = shift * fabsf(job->plane_scale[i]);
        job->near_base[i] -= pad;
        job->far_base[i] += pad;
        job->corner_error += 1.01f * share * shift;
    }
}

bool tl_ray_approach(tl_ray_job *job)
{
    approached_line line = describe_line(job);
    line_place place;
    bool before = approach_box(&line, job->axes[2], job->is_segment, &place);
    if (!before && place.t != 0.0) {
        return true; // a soup that is too small for double words at this distance
    }
    // What is hit has a t that was rounded, to a denormal if need be.
    double end = ((double)job->t * (1.0 + 0x1p-22) + 0x1p-149) - place.t;
    if (misses_box(&line, &place, job->t < FLT_MAX ? end : (double)INFINITY)) {
        return false;
    }
    if (before) {
        prepare_filters_at(job, &line, &place);
        job->box_t.start = place.t;
        job->has_intervals = false;
        job->box_limit = tl_ray_box_limit(job, job->t);
    }
    return true;
}
