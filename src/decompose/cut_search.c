// SPDX-License-Identifier: MIT
//
// The best plane across one direction, by a sweep.
//
// The part is divided into up to 64 slabs. Each gets the slab hull of what lies in it; sums from both ends give the
// slab hulls of both sides of every plane between two slabs. What a plane costs is the excess of both: over all cells
// that the two hulls hold, how far they are beyond the tolerance. So it is the volume that must still be cut away,
// weighed by its depth: it falls with every useful cut, where the largest depth, which other methods take, stays the
// same until the last of several handles is cut. Cells that belong to another part of the body cost nothing, since a
// hull may reach into it.
//
// The best plane is then moved onto the faces parallel to it, if some lie within its two slabs: a cut along a face
// leaves both sides without a sliver.

#include "decompose/cut_search.h"

#include "base/assert.h"
#include "base/min_max.h"
#include "decompose/slab_hull.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { MAX_SLABS = 64 };

typedef struct cut_sweep {
    const tl_part *part;
    const tl_distance_grid *grid;
    tl_vec3d direction;
    tl_slab_axes axes;
    double low, width; // metres along the direction: where the first slab begins, and how wide they are
    uint32_t count;
    tl_slab_hull slabs[MAX_SLABS];  // what lies in each
    tl_slab_hull behind[MAX_SLABS]; // in it and in all after it
} cut_sweep;

static double place_along(const cut_sweep *s, tl_vec3d p)
{
    return tl_vec3d_dot(s->direction, p);
}

static uint32_t slab_of(const cut_sweep *s, double along)
{
    return (uint32_t)tl_clamp_f64((along - s->low) / s->width, 0.0, (double)(s->count - 1));
}

// Divides what the part extends over into slabs of a cell at least. False: it is too thin for two.
static bool make_slabs(cut_sweep *s)
{
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (size_t i = 0; i < 3 * (size_t)s->part->triangle_count; i++) {
        const double along = place_along(s, tl_vec3d_from(s->part->corners[i]));
        low = tl_min_f64(low, along);
        high = tl_max_f64(high, along);
    }
    const double extent = high - low;
    s->count = (uint32_t)tl_clamp_f64(ceil(extent / s->grid->cell), 2.0, (double)MAX_SLABS);
    s->low = low;
    s->width = extent / s->count;
    for (uint32_t i = 0; i < s->count; i++) {
        tl_slab_hull_clear(&s->slabs[i]);
    }
    return extent > 16.0 * s->grid->noise;
}

static void add_to_slab(cut_sweep *s, uint32_t slab, tl_vec3d p)
{
    const tl_vec3d at = tl_vec3d_scale(tl_vec3d_sub(p, s->grid->origin), 1.0 / s->grid->cell);
    tl_slab_hull_add_point(&s->slabs[slab], &s->axes, (float)at.x, (float)at.y, (float)at.z);
}

// An edge's first end, and where it crosses from one slab into another.
static void add_edge(cut_sweep *s, tl_vec3d a, tl_vec3d b)
{
    const double along_a = place_along(s, a), along_b = place_along(s, b);
    const uint32_t slab_a = slab_of(s, along_a), slab_b = slab_of(s, along_b);
    add_to_slab(s, slab_a, a);
    const uint32_t last = slab_a > slab_b ? slab_a : slab_b;
    for (uint32_t slab = slab_a < slab_b ? slab_a : slab_b; slab < last; slab++) {
        const double t = (s->low + (slab + 1) * s->width - along_a) / (along_b - along_a);
        const tl_vec3d p = tl_vec3d_mul_add(a, tl_vec3d_sub(b, a), tl_clamp_f64(t, 0.0, 1.0));
        add_to_slab(s, slab, p);
        add_to_slab(s, slab + 1, p);
    }
}

static void fill_slabs(cut_sweep *s)
{
    for (uint32_t i = 0; i < s->part->triangle_count; i++) {
        const tl_vec3 *corners = s->part->corners + 3 * (size_t)i;
        const tl_vec3d a = tl_vec3d_from(corners[0]), b = tl_vec3d_from(corners[1]), c = tl_vec3d_from(corners[2]);
        add_edge(s, a, b);
        add_edge(s, b, c);
        add_edge(s, c, a);
    }
}

// Squares, so that a plane that halves what is to be done beats one that shaves off a sliver: of a ring both halves
// hold the whole disk, and only the sliver lessens the sum.
static double plane_cost(uint64_t below, uint64_t above)
{
    return (double)below * (double)below + (double)above * (double)above;
}

// Weighs the planes before slabs 1 to count - 1, and chooses one.
static void weigh_planes(cut_sweep *s, float *scratch, tl_cut_choice *choice)
{
    s->behind[s->count - 1] = s->slabs[s->count - 1];
    for (uint32_t i = s->count - 1; i-- > 0;) {
        s->behind[i] = s->slabs[i];
        tl_slab_hull_add(&s->behind[i], &s->behind[i + 1]);
    }
    tl_slab_hull before;
    tl_slab_hull_clear(&before);
    for (uint32_t i = 1; i < s->count; i++) {
        tl_slab_hull_add(&before, &s->slabs[i - 1]);
        const tl_cut_choice plane = {
            { s->direction, s->low + i * s->width },
            plane_cost(tl_slab_hull_excess(&before, &s->axes, s->grid, scratch),
                       tl_slab_hull_excess(&s->behind[i], &s->axes, s->grid, scratch)),
            (2 * i > s->count ? s->count - i : i) * s->width,
        };
        *choice = tl_cut_is_better(&plane, choice) ? plane : *choice;
    }
}

// Faces count as parallel to the plane when they climb less than this share of a slab's width.
static const double FACE_RISE = 1.0 / 256.0;

// Whether a plane leaves a good share of a slab on either side.
static bool leaves_both(const cut_sweep *s, double place)
{
    const double spare = s->width / 4.0;
    return place - s->low > spare && s->low + s->count * s->width - place > spare;
}

// The place of the most area among the faces that are parallel to the plane and no farther than a slab from it.
static double snap_to_faces(const cut_sweep *s, double place)
{
    double best_area = 0.0, best = place;
    enum { PLACES = 32 };
    double areas[PLACES] = { 0 }, sums[PLACES] = { 0 };
    for (uint32_t i = 0; i < s->part->triangle_count; i++) {
        const tl_vec3 *corners = s->part->corners + 3 * (size_t)i;
        const tl_vec3d a = tl_vec3d_from(corners[0]), b = tl_vec3d_from(corners[1]), c = tl_vec3d_from(corners[2]);
        const double at[3] = { place_along(s, a), place_along(s, b), place_along(s, c) };
        const double low = tl_min_f64(at[0], tl_min_f64(at[1], at[2]));
        const double high = tl_max_f64(at[0], tl_max_f64(at[1], at[2]));
        const double from = (low - place) / s->width;
        if (!(high - low <= FACE_RISE * s->width) || !(fabs(from) < 1.0) || !leaves_both(s, low)) {
            continue;
        }
        const double area = tl_vec3d_length(tl_vec3d_cross(tl_vec3d_sub(b, a), tl_vec3d_sub(c, a)));
        const uint32_t bin = (uint32_t)((from + 1.0) * (PLACES / 2));
        areas[bin] += area;
        sums[bin] += area * (low + high) / 2.0;
        if (areas[bin] > best_area) {
            best_area = areas[bin];
            best = sums[bin] / areas[bin];
        }
    }
    return best;
}

tl_result tl_cut_search(const tl_part *part, tl_vec3d direction, const tl_distance_grid *grid,
                        const tl_allocator *allocator, tl_cut_choice *choice_out)
{
    memset(choice_out, 0, sizeof *choice_out);
    choice_out->cost = (double)INFINITY;
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    cut_sweep *s = TL_PUSH(&arena, cut_sweep, 1);
    float *scratch = TL_PUSH(&arena, float, 2 * (uint64_t)grid->size[1]);
    tl_result result = s != NULL && scratch != NULL ? TL_OK : TL_ERR_MEMORY;
    if (result == TL_OK) {
        s->part = part;
        s->grid = grid;
        s->direction = direction;
        tl_slab_axes_make(&s->axes);
        if (make_slabs(s)) {
            fill_slabs(s);
            weigh_planes(s, scratch, choice_out);
            choice_out->plane.offset = snap_to_faces(s, choice_out->plane.offset);
        }
    }
    tl_arena_free(&arena);
    return result;
}
