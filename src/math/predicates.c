// SPDX-License-Identifier: MIT
//
// Robust predicates. Each determinant is first computed in double with a bound on its rounding error; where the bound
// does not decide, the determinant is summed exactly as an expansion, a list of doubles that do not overlap, and the
// sign is that of its largest component.
// Source: Jonathan Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates,
// Discrete & Computational Geometry 18, 1997: theorems 7 (two-sum), 10 (grow-expansion), 17 and 18 (split and
// two-product), and the error analysis of section 4.
//
// Why no overflow or underflow can invalidate it: a finite float is a multiple of 2^-149 below 2^128. A difference of
// two is a multiple of 2^-149 and at most 2^129, and is held exactly as head + tail (the error of one addition is a
// double). Every product of three such numbers, every partial sum and every rounding error of these is a multiple of
// 2^-447 and below 2^390 * 2; the splitter adds 28 bits. Doubles reach from 2^-1074 to 2^1024.
//
// Why one accumulator and not Shewchuk's ladder of four adaptive stages: with float input the tails of the differences
// are nearly always zero, so most terms vanish and the exact sum has two to four components; the middle stages decide
// few cases and are most of his code. Grow-expansion needs no more of its input than that it does not overlap, so the
// proof is one theorem.
//
// The compiler must neither fuse multiply-adds nor keep excess precision: the build sets -ffp-contract=off, and
// base/exact_floats.h refuses x87 arithmetic.

#include "math/predicates.h"

#include "base/compiler.h"
#include "math/vec3d.h"

#include <assert.h>
#include <float.h>

static_assert(DBL_MANT_DIG == 53, "predicates need plain IEEE doubles");

// Half an ulp of 1: the relative rounding error of one double operation.
#define ROUNDING 1.1102230246251565e-16

// Shewchuk's bounds of the determinant's error, as a share of its permanent (the same sum over absolute values), for
// the exact orders of operation below: section 4.3, ccwerrboundA and o3derrboundA.
#define ORIENT2D_BOUND ((3.0 + 16.0 * ROUNDING) * ROUNDING)
#define ORIENT3D_BOUND ((7.0 + 56.0 * ROUNDING) * ROUNDING)
// Three exact products each rounded once by their difference, then two sums: each term meets three roundings.
#define ALONG_BOUND ((3.0 + 16.0 * ROUNDING) * ROUNDING)

// A determinant of three rows has 6 products of three differences; each difference has 2 parts, which makes 8
// products, and each of these has at most 4 parts: 192. Each part adds at most one component to the sum.
#define MAX_COMPONENTS 192

typedef struct exact_sum {
    int count;
    double components[MAX_COMPONENTS]; // increasing magnitude, non-overlapping, none zero
} exact_sum;

// A number as an unevaluated sum: head + tail, where |tail| is at most half an ulp of head.
typedef struct exact_pair {
    double head, tail;
} exact_pair;

static inline exact_pair two_sum(double a, double b)
{
    exact_pair r;
    r.head = a + b;
    double b_virtual = r.head - a;
    double a_virtual = r.head - b_virtual;
    r.tail = (a - a_virtual) + (b - b_virtual);
    return r;
}

static inline exact_pair split_double(double a)
{
    double c = 134217729.0 * a; // 2^27 + 1
    exact_pair r;
    r.head = c - (c - a);
    r.tail = a - r.head;
    return r;
}

static inline exact_pair two_product(double a, double b)
{
    exact_pair r;
    r.head = a * b;
    exact_pair x = split_double(a);
    exact_pair y = split_double(b);
    r.tail = x.tail * y.tail - (((r.head - x.head * y.head) - x.tail * y.head) - x.head * y.tail);
    return r;
}

// Grow-expansion with zero elimination.
static void add_term(exact_sum *sum, double term)
{
    if (term == 0.0) {
        return;
    }
    double carry = term;
    int kept = 0;
    for (int i = 0; i < sum->count; i++) {
        exact_pair r = two_sum(carry, sum->components[i]);
        carry = r.head;
        if (r.tail != 0.0) {
            sum->components[kept++] = r.tail;
        }
    }
    if (carry != 0.0) {
        sum->components[kept++] = carry;
    }
    sum->count = kept;
}

static int exact_sign(const exact_sum *sum)
{
    if (sum->count == 0) {
        return 0;
    }
    return sum->components[sum->count - 1] > 0.0 ? 1 : -1;
}

static void add_product2(exact_sum *sum, double a, double b)
{
    exact_pair ab = two_product(a, b);
    add_term(sum, ab.tail);
    add_term(sum, ab.head);
}

static void add_product3(exact_sum *sum, double a, double b, double c)
{
    if (a == 0.0 || b == 0.0 || c == 0.0) {
        return;
    }
    exact_pair ab = two_product(a, b);
    if (ab.tail != 0.0) {
        add_product2(sum, ab.tail, c);
    }
    add_product2(sum, ab.head, c);
}

static void add_pair_product2(exact_sum *sum, exact_pair a, exact_pair b)
{
    if (a.tail != 0.0 || b.tail != 0.0) {
        add_product2(sum, a.tail, b.tail);
        add_product2(sum, a.tail, b.head);
        add_product2(sum, a.head, b.tail);
    }
    add_product2(sum, a.head, b.head);
}

static void add_pair_product3(exact_sum *sum, exact_pair a, exact_pair b, exact_pair c)
{
    if (a.tail != 0.0 || b.tail != 0.0 || c.tail != 0.0) {
        add_product3(sum, a.tail, b.tail, c.tail);
        add_product3(sum, a.tail, b.tail, c.head);
        add_product3(sum, a.tail, b.head, c.tail);
        add_product3(sum, a.tail, b.head, c.head);
        add_product3(sum, a.head, b.tail, c.tail);
        add_product3(sum, a.head, b.tail, c.head);
        add_product3(sum, a.head, b.head, c.tail);
    }
    add_product3(sum, a.head, b.head, c.head);
}

static inline exact_pair negated(exact_pair a)
{
    exact_pair r = { -a.head, -a.tail };
    return r;
}

static inline int sign_of_double(double value)
{
    return (value > 0.0) - (value < 0.0);
}

static inline double absolute(double value)
{
    return value < 0.0 ? -value : value;
}

static inline exact_pair difference(float a, float b)
{
    return two_sum((double)a, -(double)b);
}

static void orient2d_exact(exact_sum *sum, float ax, float ay, float bx, float by, float cx, float cy)
{
    sum->count = 0;
    add_pair_product2(sum, difference(bx, ax), difference(cy, ay));
    add_pair_product2(sum, negated(difference(by, ay)), difference(cx, ax));
}

int tl_orient2d(float ax, float ay, float bx, float by, float cx, float cy)
{
    double left = ((double)bx - (double)ax) * ((double)cy - (double)ay);
    double right = ((double)by - (double)ay) * ((double)cx - (double)ax);
    double determinant = left - right;
    double permanent = absolute(left) + absolute(right);
    if (absolute(determinant) > ORIENT2D_BOUND * permanent) {
        return sign_of_double(determinant);
    }
    if (permanent == 0.0) {
        return 0;
    }
    exact_sum sum;
    orient2d_exact(&sum, ax, ay, bx, by, cx, cy);
    return exact_sign(&sum);
}

double tl_area2d(float ax, float ay, float bx, float by, float cx, float cy)
{
    double left = ((double)bx - (double)ax) * ((double)cy - (double)ay);
    double right = ((double)by - (double)ay) * ((double)cx - (double)ax);
    double determinant = left - right;
    // At most six bits cancelled: 3 * 2^-53 * 2^6 is below 2^-45.
    if (absolute(determinant) >= 0.015625 * (absolute(left) + absolute(right))) {
        return determinant;
    }
    exact_sum sum;
    orient2d_exact(&sum, ax, ay, bx, by, cx, cy);
    // Components do not overlap: from small to large each addition rounds once, and only the last ones matter.
    double value = 0.0;
    for (int i = 0; i < sum.count; i++) {
        value += sum.components[i];
    }
    return value;
}

// Rows of a 3 x 3 determinant.
typedef struct exact_row {
    exact_pair x, y, z;
} exact_row;

static exact_row row_difference(tl_vec3 a, tl_vec3 b)
{
    exact_row r = { difference(a.x, b.x), difference(a.y, b.y), difference(a.z, b.z) };
    return r;
}

static void determinant_sum(exact_sum *sum, const exact_row *u, const exact_row *v, const exact_row *w)
{
    sum->count = 0;
    add_pair_product3(sum, u->y, v->z, w->x);
    add_pair_product3(sum, negated(u->z), v->y, w->x);
    add_pair_product3(sum, u->z, v->x, w->y);
    add_pair_product3(sum, negated(u->x), v->z, w->y);
    add_pair_product3(sum, u->x, v->y, w->z);
    add_pair_product3(sum, negated(u->y), v->x, w->z);
}

// Not inlined: the filter nearly always decides, and needs none of the stack.
static TL_NOINLINE int determinant_exact(const exact_row *u, const exact_row *v, const exact_row *w)
{
    exact_sum sum;
    determinant_sum(&sum, u, v, w);
    return exact_sign(&sum);
}

// The filter for rows u, v, w: 0 when it cannot decide, 2 when the determinant is surely zero.
static inline int determinant_filter(tl_vec3d u, tl_vec3d v, tl_vec3d w)
{
    double uyvz = u.y * v.z, uzvy = u.z * v.y;
    double uzvx = u.z * v.x, uxvz = u.x * v.z;
    double uxvy = u.x * v.y, uyvx = u.y * v.x;
    double determinant = w.x * (uyvz - uzvy) + w.y * (uzvx - uxvz) + w.z * (uxvy - uyvx);
    double permanent = (absolute(uyvz) + absolute(uzvy)) * absolute(w.x) +
                       (absolute(uzvx) + absolute(uxvz)) * absolute(w.y) +
                       (absolute(uxvy) + absolute(uyvx)) * absolute(w.z);
    if (absolute(determinant) > ORIENT3D_BOUND * permanent) {
        return sign_of_double(determinant);
    }
    return permanent == 0.0 ? 2 : 0;
}

int tl_orient3d(tl_vec3 a, tl_vec3 b, tl_vec3 c, tl_vec3 d)
{
    tl_vec3d origin = tl_vec3d_from(a);
    int sign = determinant_filter(tl_vec3d_sub(tl_vec3d_from(b), origin), tl_vec3d_sub(tl_vec3d_from(c), origin),
                                  tl_vec3d_sub(tl_vec3d_from(d), origin));
    if (sign != 0) {
        return sign == 2 ? 0 : sign;
    }
    exact_row u = row_difference(b, a);
    exact_row v = row_difference(c, a);
    exact_row w = row_difference(d, a);
    return determinant_exact(&u, &v, &w);
}

int tl_line_side(tl_vec3 origin, tl_vec3 direction, tl_vec3 a, tl_vec3 b)
{
    tl_vec3d from = tl_vec3d_from(origin);
    int sign = determinant_filter(tl_vec3d_from(direction), tl_vec3d_sub(tl_vec3d_from(a), from),
                                  tl_vec3d_sub(tl_vec3d_from(b), from));
    if (sign != 0) {
        return sign == 2 ? 0 : sign;
    }
    exact_row u = row_difference(direction, tl_vec3_make(0.0f, 0.0f, 0.0f));
    exact_row v = row_difference(a, origin);
    exact_row w = row_difference(b, origin);
    return determinant_exact(&u, &v, &w);
}

double tl_normal_dot(tl_vec3 a, tl_vec3 b, tl_vec3 c, tl_vec3 p, tl_vec3 q)
{
    exact_row u = row_difference(b, a);
    exact_row v = row_difference(c, a);
    exact_row w = row_difference(p, q);
    exact_sum sum;
    determinant_sum(&sum, &u, &v, &w);
    // Each component is below the last bit of the next, so all but the last two sums only round the last bits.
    double value = 0.0;
    for (int i = 0; i < sum.count; i++) {
        value += sum.components[i];
    }
    return value;
}

int tl_compare_along(tl_vec3 direction, tl_vec3 p, tl_vec3 q)
{
    // A product of two floats has 48 bits: exact in double.
    double px = (double)direction.x * (double)p.x, qx = (double)direction.x * (double)q.x;
    double py = (double)direction.y * (double)p.y, qy = (double)direction.y * (double)q.y;
    double pz = (double)direction.z * (double)p.z, qz = (double)direction.z * (double)q.z;
    double x = px - qx, y = py - qy, z = pz - qz;
    double sum = (x + y) + z;
    double magnitude = (absolute(x) + absolute(y)) + absolute(z);
    if (absolute(sum) > ALONG_BOUND * magnitude) {
        return sign_of_double(sum);
    }
    if (magnitude == 0.0) {
        return 0;
    }
    exact_sum exact;
    exact.count = 0;
    add_term(&exact, px);
    add_term(&exact, -qx);
    add_term(&exact, py);
    add_term(&exact, -qy);
    add_term(&exact, pz);
    add_term(&exact, -qz);
    return exact_sign(&exact);
}

bool tl_is_collinear(tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    return tl_orient2d(a.x, a.y, b.x, b.y, c.x, c.y) == 0 && tl_orient2d(a.y, a.z, b.y, b.z, c.y, c.z) == 0 &&
           tl_orient2d(a.z, a.x, b.z, b.x, c.z, c.x) == 0;
}
