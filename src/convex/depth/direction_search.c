// SPDX-License-Identifier: MIT
//
// Penetration depth by branch and bound over directions. The depth is the minimum of the support function h(d) of the
// Minkowski difference A - B over unit directions d. The sphere of directions is divided into cones of three corners,
// the octants first; a cone is discarded when h is proven to be nowhere in it below the lowest value known, else
// halved.
//
// Concentric balls of a thousand facets are, to a thousandth, as deep along all of these as along the best one. EPA
// then needs a polytope with as many faces; it has space for a few, since a query must not allocate. Cones are visited
// depth first, so a stack of a few dozen suffices for any shape. EPA goes first, because a common pair converges in ten
// of its steps.
//
// The bound of a cone: let p be any convex combination of its corners' support points. p is in A - B, so h(d) >= p . d,
// and within a cone p . d is least at a corner. The best p is the solution of a 3 x 3 matrix game. Where one facet of
// A - B faces the whole cone it is the facet's point nearest to the origin, and the bound is short by the cosine of the
// cone's angle only.
//
// A search with a fine gap that runs out of steps would leave some cones unseen and so prove nothing. So each pass
// narrows the gap, and the bounds of the last complete pass stand.

#include "convex/depth/direction_search.h"

#include "base/min_max.h"
#include "math/tolerance.h"

// Bounds closer than sixteen float roundings of the size, a millionth, are equal. EPA asks for four; here, where many
// directions are as deep to that, it would cost four times as many cones.
#define SEARCH_DEPTH_GAP (16.0 * (double)TL_FLOAT_ROUNDING)

// A point of A - B is off by 16 roundings.
#define SEARCH_POINT_ERROR TL_DOUBLE_GAMMA(16)

// On curved shapes each pass takes up to one over this as many steps as the last; so all before the last are cheap.
#define GAP_STEP 0.25

// A pass that took less than so many times the steps of the last has found facets: finer ones will not take more, and
// the next may be the last.
#define FACET_GROWTH 2.0

// A cut halves the longest edge of a cone, so two cuts about halve it: 64 levels make it 2^-32 wide, where h cannot be
// told from a corner's. The deepest of 619 searches took 24.
enum { MAX_CONES = 64 };

typedef struct cone_corner {
    tl_vec3d direction, point; // unit; the support point along it
} cone_corner;

typedef struct direction_cone {
    cone_corner corners[3];
} direction_cone;

typedef struct direction_search {
    tl_minkowski *pair;
    tl_core_depth *depth;
    cone_corner axes[6]; // both ways along each axis
    double reach;        // largest |w| of the points seen
    uint32_t max_steps;
    uint32_t steps;
} direction_search;

static void sample_direction(direction_search *s, tl_vec3d direction, cone_corner *corner_out)
{
    tl_minkowski_point point;
    tl_minkowski_support(s->pair, direction, &point);
    corner_out->direction = direction;
    corner_out->point = point.w;
    double reach = tl_vec3d_size(point.w), upper = tl_vec3d_dot(direction, point.w);
    s->reach = reach > s->reach ? reach : s->reach;
    if (upper < s->depth->upper) {
        s->depth->upper = upper;
        s->depth->normal = direction;
    }
    s->steps++;
}

static double min_of_three(double a, double b, double c)
{
    return fmin(a, fmin(b, c));
}

// The best mixture of two rows of the game: where two of its three columns are equal.
static double mix_two(const double a[3], const double b[3])
{
    double best = -(double)INFINITY;
    for (int j = 0; j < 3; j++) {
        int k = (j + 1) % 3;
        double da = a[j] - a[k], db = b[k] - b[j], sum = da + db;
        if (da * db > 0.0) {
            double t = db / sum, u = da / sum;
            best = fmax(best, min_of_three(t * a[0] + u * b[0], t * a[1] + u * b[1], t * a[2] + u * b[2]));
        }
    }
    return best;
}

typedef struct game {
    double m[3][3];  // row: point, column: corner
    double facet[3]; // the foot of the origin on the three points' plane, seen from each corner
    tl_vec3d normal; // unit, of that plane, when the foot lies between the points
    bool has_facet;
} game;

static void find_facet(const direction_cone *c, game *g)
{
    const tl_vec3d a = c->corners[0].point, b = c->corners[1].point, p = c->corners[2].point;
    tl_vec3d n = tl_vec3d_cross(tl_vec3d_sub(b, a), tl_vec3d_sub(p, a));
    double area_sq = tl_vec3d_dot(n, n), along = tl_vec3d_dot(n, a);
    g->has_facet = area_sq > 0.0 && along != 0.0 && tl_vec3d_dot(n, tl_vec3d_cross(b, p)) > 0.0 &&
                   tl_vec3d_dot(n, tl_vec3d_cross(p, a)) > 0.0 && tl_vec3d_dot(n, tl_vec3d_cross(a, b)) > 0.0;
    if (g->has_facet) {
        tl_vec3d foot = tl_vec3d_scale(n, along / area_sq);
        for (int j = 0; j < 3; j++) {
            g->facet[j] = tl_vec3d_dot(foot, c->corners[j].direction);
        }
        g->normal = tl_vec3d_scale(n, (along < 0.0 ? -1.0 : 1.0) / sqrt(area_sq));
    }
}

// Whether h is proven to be nowhere in the cone below `limit`. Cheap proofs first.
static bool is_proven(const direction_cone *c, double limit, game *g)
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            g->m[i][j] = tl_vec3d_dot(c->corners[i].point, c->corners[j].direction);
        }
        if (min_of_three(g->m[i][0], g->m[i][1], g->m[i][2]) >= limit) {
            return true;
        }
    }
    find_facet(c, g);
    return (g->has_facet && min_of_three(g->facet[0], g->facet[1], g->facet[2]) >= limit) ||
           mix_two(g->m[0], g->m[1]) >= limit || mix_two(g->m[1], g->m[2]) >= limit ||
           mix_two(g->m[2], g->m[0]) >= limit;
}

static double edge_sq(const direction_cone *c, int i)
{
    tl_vec3d d = tl_vec3d_sub(c->corners[i].direction, c->corners[(i + 1) % 3].direction);
    return tl_vec3d_dot(d, d);
}

// Cuts the cone across its longest edge; it becomes one half.
static void halve_cone(direction_search *s, direction_cone *c, direction_cone *other)
{
    double edges[3] = { edge_sq(c, 0), edge_sq(c, 1), edge_sq(c, 2) };
    int i = edges[0] >= edges[1] && edges[0] >= edges[2] ? 0 : edges[1] >= edges[2] ? 1 : 2, j = (i + 1) % 3;
    tl_vec3d middle = tl_vec3d_add(c->corners[i].direction, c->corners[j].direction);
    cone_corner half;
    sample_direction(s, tl_vec3d_scale(middle, 1.0 / tl_vec3d_length(middle)), &half);
    *other = *c;
    c->corners[j] = half;
    other->corners[i] = half;
}

// Whether no direction of an octant is less deep than the upper bound less the gap.
static bool prove_octant(direction_search *s, uint32_t octant, double gap)
{
    direction_cone stack[MAX_CONES];
    uint32_t count = 1;
    for (uint32_t i = 0; i < 3; i++) {
        stack[0].corners[i] = s->axes[2 * i + (octant >> i & 1u)];
    }
    while (count > 0) {
        direction_cone *c = &stack[count - 1];
        game g;
        if (is_proven(c, s->depth->upper - gap, &g)) {
            count--;
            continue;
        }
        if (count == MAX_CONES || s->steps >= s->max_steps) {
            return false;
        }
        // A facet that is nearer than any known: its own direction is better than any corner's.
        if (g.has_facet && tl_vec3d_dot(g.normal, c->corners[0].point) < s->depth->upper - gap) {
            cone_corner unused;
            sample_direction(s, g.normal, &unused);
        }
        halve_cone(s, c, &stack[count]);
        count++;
    }
    return true;
}

static bool prove(direction_search *s, double gap)
{
    for (uint32_t octant = 0; octant < 8; octant++) {
        if (!prove_octant(s, octant, gap)) {
            return false;
        }
    }
    return true;
}

// Where the shapes touch when B is moved out along the normal, moved back.
static void find_search_witness(const direction_search *s)
{
    tl_core_depth *depth = s->depth;
    tl_vec3d out = tl_vec3d_scale(depth->normal, depth->upper + SEARCH_DEPTH_GAP * s->reach);
    tl_minkowski moved = *s->pair;
    tl_gjk gjk;
    tl_minkowski_shift(&moved, out);
    tl_gjk_run(&moved, NULL, -1.0, &gjk);
    tl_simplex_witness(&gjk.simplex, &depth->on_a, &depth->on_b);
    depth->on_b = tl_vec3d_sub(depth->on_b, out);
}

void tl_direction_search(tl_minkowski *pair, tl_core_depth *depth)
{
    static const tl_vec3d axes[6] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
    direction_search s;
    s.pair = pair;
    s.depth = depth;
    s.reach = 0.0;
    s.steps = 0;
    uint32_t left = pair->depth_steps - depth->iterations;
    s.max_steps = left < TL_MAX_DIRECTION_STEPS ? left : TL_MAX_DIRECTION_STEPS;
    for (int i = 0; i < 6; i++) {
        sample_direction(&s, axes[i], &s.axes[i]);
    }
    depth->status = TL_CONVEX_ITERATIONS;
    double gap = GAP_STEP * depth->upper, last_steps = 0.0;
    for (;;) {
        double finest = SEARCH_DEPTH_GAP * s.reach;
        uint32_t before = s.steps;
        gap = tl_max_f64(finest, gap);
        if (!prove(&s, gap)) {
            break;
        }
        double lower = depth->upper - gap - SEARCH_POINT_ERROR * pair->scale, steps = (double)(s.steps - before);
        depth->lower = lower > depth->lower ? lower : depth->lower;
        if (gap <= SEARCH_DEPTH_GAP * s.reach) {
            depth->status = TL_CONVEX_CONVERGED;
            break;
        }
        gap = steps < FACET_GROWTH * last_steps ? 0.0 : GAP_STEP * gap;
        last_steps = steps;
    }
    depth->iterations += s.steps;
    find_search_witness(&s);
}
