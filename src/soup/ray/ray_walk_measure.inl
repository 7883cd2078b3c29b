// SPDX-License-Identifier: MIT
//
// Measuring triangles that a ray surely meets, by ray_measure.h: one that is alone in its lane, and of several that
// coincide there each for itself, unless the lowest one has the t of all. Part of ray_walk.inl.

static TL_ALWAYS_INLINE void keep_better(tl_ray_job *job, const tl_ray_place *place, uint32_t triangle)
{
    if (place->t < job->t || (place->t == job->t && triangle < job->triangle)) {
        job->t = place->t;
        job->box_limit = tl_ray_box_limit(job, place->t);
        job->triangle = triangle;
        job->back = place->back;
        job->u = place->u;
        job->v = place->v;
        memcpy(job->normal, place->normal, sizeof job->normal);
    }
}

// A triangle that the line surely meets needs no test, only its t: the better of it and the best so far stays. Of a
// lane, each triangle for itself. False when they must be decided exactly, as at a segment's end.
static TL_NOINLINE bool measure_each(tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t n, uint32_t bit)
{
    uint32_t id = ((const uint32_t *)(const void *)(leaf + 1))[lane_of_bit(bit, n)];
    const uint32_t *word = tl_soup_coincident(job->soup, id);
    for (bool last = false; !last;) {
        id = word != NULL ? *word : id;
        last = word == NULL || (*word++ & TL_ID_LAST) != 0;
        tl_ray_place place;
        if (!tl_ray_find_place(job, leaf, n, bit, id, &place)) {
            return false;
        }
        const bool is_past = job->is_segment && !(place.t < 1.0f);
        if (!place.behind && is_past && !(place.t > SURELY_BEYOND_END)) {
            return false;
        }
        const uint32_t triangle = id & TL_ID_INDEX;
        const tl_seen seen = place.back ? TL_SEEN_BACK : TL_SEEN_FRONT;
        if (!place.behind && !is_past && tl_ray_filter_accepts(job->soup, job->filter, triangle, seen)) {
            keep_better(job, &place, triangle);
        }
    }
    return true;
}

// The lowest of the triangles that coincide in a lane, where it has the t of all; else TL_NO_TRIANGLE.
static TL_NOINLINE uint32_t lowest_of_lane(const tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t id, double along,
                                           double across)
{
    const double least = tl_ray_least_across((double)leaf->extent, (double)job->reach);
    const bool is_common = job->filter == NULL && tl_ray_t_is_common(along, across, least);
    return is_common ? tl_soup_lowest_triangle(job->soup, id) : TL_NO_TRIANGLE;
}

// The same for the lowest triangle alone where that is enough, and the filter is known to let the lane count.
static TL_ALWAYS_INLINE bool measure_met(tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t n, uint32_t bit)
{
    const uint32_t id = ((const uint32_t *)(const void *)(leaf + 1))[lane_of_bit(bit, n)];
    tl_ray_place place;
    if (!tl_ray_find_place(job, leaf, n, bit, id, &place)) {
        return false;
    }
    if (place.behind) {
        return true;
    }
    if (job->is_segment && !(place.t < 1.0f)) {
        return place.t > SURELY_BEYOND_END;
    }
    uint32_t triangle = id & TL_ID_INDEX;
    if (triangle >= job->soup->source_triangle_count) {
        triangle = lowest_of_lane(job, leaf, id, place.along, place.across);
        if (triangle == TL_NO_TRIANGLE) {
            return measure_each(job, leaf, n, bit);
        }
    }
    keep_better(job, &place, triangle);
    return true;
}
