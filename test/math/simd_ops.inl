// SPDX-License-Identifier: MIT
//
// The body of simd_ops_*.c: runs every operation of the vocabulary. The file defines SIMD_OPS, the function's name.

#include "math/simd.h"
#include "math/simd16.h"
#include "math/simd4d.h"
#include "math/simd8.h"
#include "simd_ops.h"
#if TL_SIMD_LEVEL >= 1
#include "math/simd_f64.h"
#endif

#include <math.h>

static simd_output *next_output(simd_output **out, const char *name, simd_promise promise, uint32_t size)
{
    simd_output *o = (*out)++;
    memset(o, 0, sizeof *o);
    o->name = name;
    o->promise = promise;
    o->size = size;
    return o;
}

static void put_x4(simd_output **out, const char *name, simd_promise promise, tl_f32x4 v)
{
    tl_f32x4_store(next_output(out, name, promise, 16)->value.f32, v);
}

static void put_x8(simd_output **out, const char *name, simd_promise promise, tl_f32x8 v)
{
    tl_f32x8_store(next_output(out, name, promise, 32)->value.f32, v);
}

static void put_x16(simd_output **out, const char *name, simd_promise promise, tl_f32x16 v)
{
    tl_f32x16_store_bits(next_output(out, name, promise, 64)->value.u32, v);
}

static void put_f64x4(simd_output **out, const char *name, tl_f64x4 v)
{
    tl_f64x4_store(next_output(out, name, SIMD_NUMBER_64, 32)->value.f64, v);
}

static void put_f32(simd_output **out, const char *name, simd_promise promise, float value)
{
    next_output(out, name, promise, 4)->value.f32[0] = value;
}

static void put_f64(simd_output **out, const char *name, double value)
{
    next_output(out, name, SIMD_NUMBER_64, 8)->value.f64[0] = value;
}

static void put_bits(simd_output **out, const char *name, uint32_t bits)
{
    next_output(out, name, SIMD_EXACT, 4)->value.u32[0] = bits;
}

static void run_x4(const simd_input *in, simd_output **out)
{
    tl_f32x4 a = tl_f32x4_load(in->a), b = tl_f32x4_load(in->b), c = tl_f32x4_load(in->c), d = tl_f32x4_load(in->d);
    put_x4(out, "f32x4_load", SIMD_EXACT, a);
    put_x4(out, "f32x4_all", SIMD_EXACT, tl_f32x4_all(in->a[1]));
    put_x4(out, "f32x4_make", SIMD_EXACT, tl_f32x4_make(in->a[3], in->a[1], in->b[0], in->b[2]));
    put_x4(out, "f32x4_load_three", SIMD_EXACT, tl_f32x4_load_three(in->a + 1));
    put_x4(out, "f32x4_gather_four", SIMD_EXACT, tl_f32x4_gather_four(in->a + 2, in->b, in->a, in->b + 3));
    put_x4(out, "f32x4_zip_low", SIMD_EXACT, tl_f32x4_zip_low(a, b));
    put_x4(out, "f32x4_zip_high", SIMD_EXACT, tl_f32x4_zip_high(a, b));
    put_x4(out, "f32x4_twice_z_and_low", SIMD_EXACT, tl_f32x4_twice_z_and_low(a, b));
    put_x4(out, "f32x4_twice_z_and_high", SIMD_EXACT, tl_f32x4_twice_z_and_high(a, b));
    put_f32(out, "f32x4_get_x", SIMD_EXACT, tl_f32x4_get_x(a));
    put_f32(out, "f32x4_get_y", SIMD_EXACT, tl_f32x4_get_y(a));
    put_f32(out, "f32x4_get_z", SIMD_EXACT, tl_f32x4_get_z(a));
    put_x4(out, "f32x4_permute", SIMD_EXACT, tl_f32x4_permute(a, in->order));
    put_x4(out, "f32x4_add", SIMD_NUMBER_32, tl_f32x4_add(a, b));
    put_x4(out, "f32x4_sub", SIMD_NUMBER_32, tl_f32x4_sub(a, b));
    put_x4(out, "f32x4_mul", SIMD_NUMBER_32, tl_f32x4_mul(a, b));
    put_x4(out, "f32x4_div", SIMD_NUMBER_32, tl_f32x4_div(a, b));
    put_x4(out, "f32x4_sqrt", SIMD_NUMBER_32, tl_f32x4_sqrt(a));
    put_x4(out, "f32x4_rotate_three", SIMD_EXACT, tl_f32x4_rotate_three(a));
    put_x4(out, "f32x4_min", SIMD_EXACT, tl_f32x4_min(a, b));
    put_x4(out, "f32x4_max", SIMD_EXACT, tl_f32x4_max(a, b));
    put_x4(out, "f32x4_or", SIMD_EXACT, tl_f32x4_or(a, b));
    put_x4(out, "f32x4_neg", SIMD_EXACT, tl_f32x4_neg(a));
    put_x4(out, "f32x4_mul_add", SIMD_FUSED, tl_f32x4_mul_add(a, b, c));
    put_x4(out, "f32x4_mul_sub_from", SIMD_UNFUSED, tl_f32x4_mul_sub_from(a, b, c));
    put_x4(out, "f32x4_choose", SIMD_EXACT, tl_f32x4_choose(a, b, c));
    put_x4(out, "f32x4_abs", SIMD_EXACT, tl_f32x4_abs(a));
    put_x4(out, "f32x4_if_less", SIMD_EXACT, tl_f32x4_if_less(a, b, c, d));
    put_bits(out, "f32x4_less_equal", tl_f32x4_less_equal(a, b));
    put_bits(out, "f32x4_ascending", tl_f32x4_ascending(a, b, c));
    put_bits(out, "f32x4_signs", tl_f32x4_signs(a));
    tl_f32x4 small = tl_f32x4_min(tl_f32x4_max(a, tl_f32x4_all(-9.0f)), tl_f32x4_all(1e9f));
    tl_f32x4_store_whole(next_output(out, "f32x4_store_whole", SIMD_EXACT, 16)->value.i32, small);
    put_x4(out, "f32x4_max_of_three", SIMD_EXACT, tl_f32x4_max_of_three(a));
    put_f32(out, "f32x4_least_of_three", SIMD_EXACT, tl_f32x4_least_of_three(a));
}

static void run_x8(const simd_input *in, simd_output **out)
{
    tl_f32x8 a = tl_f32x8_load(in->a), b = tl_f32x8_load(in->b), c = tl_f32x8_load(in->c), d = tl_f32x8_load(in->d);
    tl_f32x8 rows[4] = { a, b, c, d };
    put_x8(out, "f32x8_load", SIMD_EXACT, a);
    put_x8(out, "f32x8_all", SIMD_EXACT, tl_f32x8_all(in->a[1]));
    put_x8(out, "f32x8_from_bytes", SIMD_EXACT, tl_f32x8_from_bytes(in->bytes));
    put_f32(out, "f32x8_first", SIMD_EXACT, tl_f32x8_first(a));
    put_x8(out, "f32x8_largest", SIMD_EQUAL, tl_f32x8_largest(a));
    put_x8(out, "f32x8_load_twice", SIMD_EXACT, tl_f32x8_load_twice(in->a + 1));
    put_x8(out, "f32x8_load_halves", SIMD_EXACT, tl_f32x8_load_halves(in->a + 3, in->b + 1));
    put_x8(out, "f32x8_swap_halves", SIMD_EXACT, tl_f32x8_swap_halves(a));
    tl_f32x8_transpose(rows);
    put_x8(out, "f32x8_transpose 0", SIMD_EXACT, rows[0]);
    put_x8(out, "f32x8_transpose 1", SIMD_EXACT, rows[1]);
    put_x8(out, "f32x8_transpose 2", SIMD_EXACT, rows[2]);
    put_x8(out, "f32x8_transpose 3", SIMD_EXACT, rows[3]);
    put_x8(out, "f32x8_min", SIMD_EXACT, tl_f32x8_min(a, b));
    put_x8(out, "f32x8_max", SIMD_EXACT, tl_f32x8_max(a, b));
    put_x8(out, "f32x8_add", SIMD_NUMBER_32, tl_f32x8_add(a, b));
    put_x8(out, "f32x8_sub", SIMD_NUMBER_32, tl_f32x8_sub(a, b));
    put_x8(out, "f32x8_mul", SIMD_NUMBER_32, tl_f32x8_mul(a, b));
    put_x8(out, "f32x8_div", SIMD_NUMBER_32, tl_f32x8_div(a, b));
    put_x8(out, "f32x8_mul_add", SIMD_FUSED, tl_f32x8_mul_add(a, b, c));
    put_x8(out, "f32x8_mul_sub_from", SIMD_UNFUSED, tl_f32x8_mul_sub_from(a, b, c));
    put_x8(out, "f32x8_min_bits", SIMD_EXACT, tl_f32x8_min_bits(a, b));
    put_x8(out, "f32x8_max_bits", SIMD_EXACT, tl_f32x8_max_bits(a, b));
    put_bits(out, "f32x8_less_bits", tl_f32x8_less_bits(a, b));
    put_x8(out, "f32x8_where_less_bits", SIMD_EXACT, tl_f32x8_where_less_bits(a, b));
    put_bits(out, "f32x8_least_bits", tl_f32x8_least_bits(a));
    put_x8(out, "f32x8_and", SIMD_EXACT, tl_f32x8_and(a, b));
    put_x8(out, "f32x8_or", SIMD_EXACT, tl_f32x8_or(a, b));
    put_bits(out, "f32x8_signs", tl_f32x8_signs(a));
    put_bits(out, "f32x8_less", tl_f32x8_less(a, b));
    put_bits(out, "f32x8_not_less", tl_f32x8_not_less(a, b));
    put_x8(out, "f32x8_if_less", SIMD_EXACT, tl_f32x8_if_less(a, b, c, d));
    put_x8(out, "f32x8_abs", SIMD_EXACT, tl_f32x8_abs(a));
}

static tl_f32x16 numbers_of(const float *sixteen)
{
    float numbers[16];
    for (int i = 0; i < 16; i++) {
        numbers[i] = isnan(sixteen[i]) ? (float)i : sixteen[i];
    }
    return tl_f32x16_load(numbers);
}

static void run_x16(const simd_input *in, simd_output **out)
{
    tl_f32x16 a = tl_f32x16_load(in->a), b = tl_f32x16_load(in->b), c = tl_f32x16_load(in->c);
    put_x16(out, "f32x16_load", SIMD_EXACT, a);
    put_x16(out, "f32x16_all", SIMD_EXACT, tl_f32x16_all(in->a[1]));
    put_x16(out, "f32x16_from_bytes", SIMD_EXACT, tl_f32x16_from_bytes(in->bytes));
    put_x16(out, "f32x16_mul_add", SIMD_FUSED, tl_f32x16_mul_add(a, b, c));
    put_x16(out, "f32x16_min_bits", SIMD_EXACT, tl_f32x16_min_bits(a, b));
    put_x16(out, "f32x16_max_bits", SIMD_EXACT, tl_f32x16_max_bits(a, b));
    put_bits(out, "f32x16_less_equal_bits", tl_f32x16_less_equal_bits(a, b));
    put_x16(out, "f32x16_where_less_bits", SIMD_EXACT, tl_f32x16_where_less_bits(a, b));
    put_x16(out, "f32x16_and", SIMD_EXACT, tl_f32x16_and(a, b));
    put_x16(out, "f32x16_or", SIMD_EXACT, tl_f32x16_or(a, b));
    put_bits(out, "f32x16_least_bits", tl_f32x16_least_bits(a));
    put_x16(out, "f32x16_add", SIMD_NUMBER_32, tl_f32x16_add(a, b));
    put_x16(out, "f32x16_sub", SIMD_NUMBER_32, tl_f32x16_sub(a, b));
    put_x16(out, "f32x16_mul", SIMD_NUMBER_32, tl_f32x16_mul(a, b));
    put_x16(out, "f32x16_div", SIMD_NUMBER_32, tl_f32x16_div(a, b));
    put_x16(out, "f32x16_mul_sub_from", SIMD_UNFUSED, tl_f32x16_mul_sub_from(a, b, c));
    put_x16(out, "f32x16_abs", SIMD_EXACT, tl_f32x16_abs(a));
    put_x16(out, "f32x16_min", SIMD_EXACT, tl_f32x16_min(a, b));
    put_x16(out, "f32x16_max", SIMD_EXACT, tl_f32x16_max(a, b));
    put_bits(out, "f32x16_less", tl_f32x16_less(a, b));
    put_f32(out, "f32x16_first", SIMD_EXACT, tl_f32x16_first(a));
    tl_f32x16 numbers[3] = { numbers_of(in->a), numbers_of(in->b), numbers_of(in->c) };
    put_f32(out, "f32x16_largest", SIMD_EQUAL, tl_f32x16_largest(numbers[0]));
    put_x16(out, "f32x16_choose", SIMD_EXACT, tl_f32x16_choose(in->bytes[0] | (uint32_t)in->bytes[1] << 8, a, b));
    put_x4(out, "f32x16_largest_of_each", SIMD_EQUAL, tl_f32x16_largest_of_each(numbers[0], numbers[1], numbers[2]));
    tl_f32x4 quarters[3] = { tl_f32x4_load(in->a), tl_f32x4_load(in->b + 4), tl_f32x4_load(in->c + 8) };
    put_x16(out, "f32x16_join", SIMD_EXACT, tl_f32x16_join(quarters[0], quarters[1], quarters[2], quarters[0]));
    uint32_t words[16];
    memcpy(words, in->a, sizeof words);
    put_bits(out, "u32x16_equal", tl_u32x16_equal(words, words[3]));
    tl_u32x16_store_where(words, in->bytes[2] | (uint32_t)in->bytes[3] << 8, 0xff812345u);
    memcpy(next_output(out, "u32x16_store_where", SIMD_EXACT, 64)->value.u32, words, sizeof words);
    uint32_t high[16], low[16];
    memcpy(high, in->a, sizeof high);
    memcpy(low, in->b, sizeof low);
    simd_output *pairs = next_output(out, "u32x16_compress_pairs", SIMD_EXACT, 0);
    tl_u32x16_compress_pairs(pairs->value.u64, in->mask, high, low);
    pairs->size = 8 * tl_bit_count(in->mask);
}

static void run_f64x4(const simd_input *in, simd_output **out)
{
    tl_f64x4 a = tl_f64x4_of_floats(tl_f32x4_load(in->a)), b = tl_f64x4_of_floats(tl_f32x4_load(in->b));
    put_f64x4(out, "f64x4_of_floats", a);
    put_f64x4(out, "f64x4_all", tl_f64x4_all(in->p[0]));
    put_f64x4(out, "f64x4_gather_three", tl_f64x4_gather_three(in->a + 1, 5));
    put_f64x4(out, "f64x4_add", tl_f64x4_add(a, b));
    put_f64x4(out, "f64x4_sub", tl_f64x4_sub(a, b));
    put_f64x4(out, "f64x4_mul", tl_f64x4_mul(a, b));
    put_f64x4(out, "f64x4_max", tl_f64x4_max(a, b));
    put_f64x4(out, "f64x4_min", tl_f64x4_min(a, b));
    put_f64x4(out, "f64x4_div", tl_f64x4_div(a, b));
    put_f64x4(out, "f64x4_sqrt", tl_f64x4_sqrt(tl_f64x4_mul(a, a)));
    put_f64x4(out, "f64x4_next", tl_f64x4_next(a, b));
    put_f64x4(out, "f64x4_where_less", tl_f64x4_where_less(a, b, b, a));
    put_bits(out, "f64x4_equal", tl_f64x4_equal(a, tl_f64x4_max(a, b)));
    put_bits(out, "f64x4_less", tl_f64x4_less(a, b));
    static const uint32_t places[4] = { 2, 0, 1, 2 };
    put_f64x4(out, "f64x4_gather", tl_f64x4_gather(in->p, places));
    tl_f64x4 x, y, z;
    tl_f64x4_gather_points(in->a, places, &x, &y, &z);
    put_f64x4(out, "f64x4_gather_points x", x);
    put_f64x4(out, "f64x4_gather_points y", y);
    put_f64x4(out, "f64x4_gather_points z", z);
    tl_f64x4_load_points(in->a, &x, &y, &z);
    put_f64x4(out, "f64x4_load_points x", x);
    put_f64x4(out, "f64x4_load_points y", y);
    put_f64x4(out, "f64x4_load_points z", z);
    put_f64x4(out, "f64x4_rotate_three", tl_f64x4_rotate_three(a));
    put_f64x4(out, "f64x4_swap_lanes", tl_f64x4_swap_lanes(a));
    put_f64x4(out, "f64x4_swap_halves", tl_f64x4_swap_halves(a));
    put_f64x4(out, "f64x4_cross", tl_f64x4_cross(a, b));
    put_f64x4(out, "f64x4_abs", tl_f64x4_abs(a));
    put_f64(out, "f64x4_get_x", tl_f64x4_get_x(a));
    put_f64(out, "f64x4_get_y", tl_f64x4_get_y(a));
    put_f64(out, "f64x4_get_z", tl_f64x4_get_z(a));
    put_x4(out, "f64x4_to_floats", SIMD_NUMBER_32, tl_f64x4_to_floats(tl_f64x4_mul(a, b)));
    tl_f64x4_store_floats(next_output(out, "f64x4_store_floats", SIMD_NUMBER_32, 16)->value.f32, tl_f64x4_mul(a, b));
}

#if TL_SIMD_LEVEL >= 1

static void put_f64x8(simd_output **out, const char *name, tl_f64x8 v)
{
    tl_f64x8_store(next_output(out, name, SIMD_NUMBER_64, 64)->value.f64, v);
}

static void run_f64x8(const simd_input *in, simd_output **out)
{
    tl_f64x8 p = tl_f64x8_load(in->p), q = tl_f64x8_load(in->q), r = tl_f64x8_load(in->r);
    tl_mask64x8 less = tl_f64x8_less(p, q), other = tl_f64x8_less(q, r);
    put_f64x8(out, "f64x8_all", tl_f64x8_all(in->p[1]));
    put_f64x8(out, "f64x8_add", tl_f64x8_add(p, q));
    put_f64x8(out, "f64x8_sub", tl_f64x8_sub(p, q));
    put_f64x8(out, "f64x8_mul", tl_f64x8_mul(p, q));
    put_f64x8(out, "f64x8_div", tl_f64x8_div(p, q));
    put_f64x8(out, "f64x8_less select", tl_f64x8_select(less, p, r));
    put_f64x8(out, "mask64x8_and", tl_f64x8_select(tl_mask64x8_and(less, other), p, r));
    put_f64x8(out, "mask64x8_without", tl_f64x8_select(tl_mask64x8_without(less, other), p, r));
    put_bits(out, "mask64x8_any", tl_mask64x8_any(tl_mask64x8_and(less, other)));
    put_bits(out, "f64x8_equal", tl_f64x8_equal(p, q));
    // Of numbers, which zeros of either sign are equal among.
    tl_f64x8 number = tl_f64x8_select(tl_f64x8_less(p, tl_f64x8_all((double)INFINITY)), p, tl_f64x8_all(1.0));
    tl_f64x8 finite =
        tl_f64x8_select(tl_f64x8_less(tl_f64x8_all(-(double)INFINITY), number), number, tl_f64x8_all(-1.0));
    put_f64(out, "f64x8_largest", tl_f64x8_largest(finite) + 0.0);
    put_f64(out, "f64x8_smallest", tl_f64x8_smallest(finite) + 0.0);
}

#else

// There is no plain C branch of eight doubles: what they mean.
static void run_f64x8(const simd_input *in, simd_output **out)
{
    static const char *const names[] = { "f64x8_all", "f64x8_add",         "f64x8_sub",    "f64x8_mul",
                                         "f64x8_div", "f64x8_less select", "mask64x8_and", "mask64x8_without" };
    simd_output *first = *out;
    for (int k = 0; k < 8; k++) {
        next_output(out, names[k], SIMD_NUMBER_64, 64);
    }
    uint32_t any = 0, equal = 0;
    double largest = -(double)INFINITY, smallest = (double)INFINITY;
    for (int i = 0; i < 8; i++) {
        double p = in->p[i], q = in->q[i], r = in->r[i];
        uint32_t less = p < q, other = q < r;
        const double lane[8] = { in->p[1],
                                 p + q,
                                 p - q,
                                 p * q,
                                 p / q,
                                 less ? p : r,
                                 (less & other) != 0 ? p : r,
                                 (less & !other) != 0 ? p : r };
        for (int k = 0; k < 8; k++) {
            first[k].value.f64[i] = lane[k];
        }
        any |= less & other;
        equal |= (uint32_t)(p == q) << i;
        double finite = p < (double)INFINITY ? p : 1.0;
        finite = -(double)INFINITY < finite ? finite : -1.0;
        largest = finite > largest ? finite : largest;
        smallest = finite < smallest ? finite : smallest;
    }
    put_bits(out, "mask64x8_any", any);
    put_bits(out, "f64x8_equal", equal);
    put_f64(out, "f64x8_largest", largest + 0.0);
    put_f64(out, "f64x8_smallest", smallest + 0.0);
}

#endif

uint32_t SIMD_OPS(const simd_input *in, simd_output *out)
{
    simd_output *end = out;
    run_x4(in, &end);
    run_x8(in, &end);
    run_x16(in, &end);
    run_f64x4(in, &end);
    run_f64x8(in, &end);
    return (uint32_t)(end - out);
}
