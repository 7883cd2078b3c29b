// SPDX-License-Identifier: MIT
//
// Contour simplification: which vertices of the traced outlines are kept.
//
// Kept from the start: where the region or area across changes, else the outline's lower left and upper right corner.
// Between these, along walls and area borders, the farthest vertex is kept until all are within max_error of the
// simplified edge, and long edges along walls are halved; an edge between two regions of one area is made straight.
// Source: Ramer 1972, Douglas and Peucker 1973; Mononen, Recast (where to start, which edges).
//
// Two regions that share an edge see it from both sides and must simplify it alike, or gaps open. Therefore each
// stretch is measured from its lexicographically smaller end; and whatever vertex is kept at the start is kept in all
// outlines that pass it. (Recast trusts that both sides find it by themselves, which fails where a region meets itself
// in a corner.) Stretches are independent, so a stack replaces Recast's insertion into one growing list.

#include "nav_bake/contours/contours.h"

#include "base/assert.h"

#include <string.h>

// Keeps a vertex, and what the loops across its edges have at the same place. Those are found by turning round the
// place from edge to twin. A kept vertex has been turned round already, so each step keeps a new one.
void tl_contours_keep(tl_contour_work *work, uint32_t vertex)
{
    if (work->keep[vertex]) {
        return;
    }
    work->keep[vertex] = 1;
    for (uint32_t v = vertex;;) {
        uint32_t twin = work->twin[v];
        v = twin != TL_NO_TWIN ? tl_contour_next(work, twin) : vertex;
        if (work->keep[v]) {
            break;
        }
        work->keep[v] = 1;
    }
    for (uint32_t v = vertex;;) {
        uint32_t twin = work->twin[tl_contour_previous(work, v)];
        v = twin != TL_NO_TWIN ? twin : vertex;
        if (work->keep[v]) {
            break;
        }
        work->keep[v] = 1;
    }
}

static bool is_left_below(const tl_contour_vertex *a, const tl_contour_vertex *b)
{
    return a->x < b->x || (a->x == b->x && a->z < b->z);
}

static void keep_changes(tl_contour_work *work, const tl_contour_loop *loop)
{
    uint32_t previous = loop->first + loop->count - 1;
    for (uint32_t k = loop->first; k < loop->first + loop->count; previous = k++) {
        uint32_t differs = (work->vertices[k].flags ^ work->vertices[previous].flags) & TL_CONTOUR_AREA_BORDER;
        // Two regions may meet crosswise in a corner: then the other side's outline does not pass straight through.
        uint32_t twin = work->twin[k];
        bool crosswise = twin != TL_NO_TWIN && tl_contour_next(work, twin) != work->twin[previous];
        if (work->across[k] != work->across[previous] || differs != 0 || crosswise) {
            tl_contours_keep(work, k);
        }
    }
}

static void keep_extremes(tl_contour_work *work, const tl_contour_loop *loop)
{
    uint32_t low = loop->first, high = loop->first, kept = 0;
    for (uint32_t k = loop->first; k < loop->first + loop->count; k++) {
        low = is_left_below(&work->vertices[k], &work->vertices[low]) ? k : low;
        high = is_left_below(&work->vertices[high], &work->vertices[k]) ? k : high;
        kept += work->keep[k];
    }
    if (kept < 2) {
        tl_contours_keep(work, low);
        tl_contours_keep(work, high);
    }
}

// Squared distance of p from the segment a b. All differences and products are below 2^53 and so exact, the quotient is
// rounded; both sides of an edge ask with the same a and b and so get the same bits.
static double distance_to_chord_sq(const tl_contour_vertex *p, const tl_contour_vertex *a, const tl_contour_vertex *b)
{
    int64_t abx = (int64_t)b->x - a->x, abz = (int64_t)b->z - a->z, apx = (int64_t)p->x - a->x,
            apz = (int64_t)p->z - a->z;
    int64_t along = abx * apx + abz * apz, length_sq = abx * abx + abz * abz;
    if (along <= 0) {
        return (double)(apx * apx + apz * apz);
    }
    if (along >= length_sq) {
        int64_t bpx = (int64_t)p->x - b->x, bpz = (int64_t)p->z - b->z;
        return (double)(bpx * bpx + bpz * bpz);
    }
    double cross = (double)(abx * apz - abz * apx);
    return cross * cross / (double)length_sq;
}

uint32_t tl_contours_farthest(const tl_contour_work *work, uint32_t begin, uint32_t end, double *distance_sq_out)
{
    const tl_contour_loop *loop = &work->loops[work->loop_of[begin]];
    const uint32_t first = loop->first, last = loop->first + loop->count - 1;
    const bool forward = is_left_below(&work->vertices[begin], &work->vertices[end]);
    const uint32_t from = forward ? begin : end, to = forward ? end : begin;
    const tl_contour_vertex a = work->vertices[from], b = work->vertices[to];
    uint32_t farthest = from;
    double largest = 0;
    for (uint32_t k = from;;) {
        if (forward) {
            k = k == last ? first : k + 1;
        } else {
            k = k == first ? last : k - 1;
        }
        if (k == to) {
            break;
        }
        double d = distance_to_chord_sq(&work->vertices[k], &a, &b);
        if (d > largest && !work->keep[k]) {
            largest = d;
            farthest = k;
        }
    }
    *distance_sq_out = largest;
    return farthest;
}

// Steps from begin forward to end, in vertices; the whole loop when they are the same.
static uint32_t steps_between(const tl_contour_loop *loop, uint32_t begin, uint32_t end)
{
    return end > begin ? end - begin : end + loop->count - begin;
}

// The vertex at which a long edge is halved, or `begin` when it is short enough.
static uint32_t middle_of_long(const tl_contour_work *work, const tl_contour_loop *loop, uint32_t begin, uint32_t end)
{
    const tl_contour_vertex *a = &work->vertices[begin], *b = &work->vertices[end];
    int64_t dx = (int64_t)b->x - a->x, dz = (int64_t)b->z - a->z, longest = work->config->max_edge_len;
    uint32_t steps = steps_between(loop, begin, end);
    if (longest == 0 || longest > 2 * (int64_t)TL_NAV_MAX_SIDE || dx * dx + dz * dz <= longest * longest || steps < 2) {
        return begin;
    }
    uint32_t middle = begin + (is_left_below(a, b) ? steps / 2 : (steps + 1) / 2);
    return middle < loop->first + loop->count ? middle : middle - loop->count;
}

// The vertex to keep next between two kept ones, or `begin` when the edge between them will do. Halving an edge moves
// it, so the error comes first again on both halves. (Recast looks at errors, then at lengths, and no more.)
static uint32_t choose_split(const tl_contour_work *work, const tl_contour_loop *loop, uint32_t begin, uint32_t end)
{
    double error = (double)work->config->max_simplification_error, largest;
    uint32_t farthest = tl_contours_farthest(work, begin, end, &largest);
    if (largest > error * error) {
        return farthest;
    }
    if (work->across[begin] != 0) {
        return begin;
    }
    const uint32_t gain = tl_contours_farthest_gain(work, begin, end);
    return gain != begin ? gain : middle_of_long(work, loop, begin, end);
}

static void refine(tl_contour_work *work, const tl_contour_loop *loop, uint32_t begin, uint32_t end, uint32_t *stack)
{
    uint32_t depth = 0; // ends that wait, all different: at most the loop's vertices
    for (;;) {
        uint32_t middle = choose_split(work, loop, begin, end);
        if (middle != begin) {
            work->keep[middle] = 1;
            stack[depth++] = end;
            end = middle;
        } else if (depth > 0) {
            begin = end;
            end = stack[--depth];
        } else {
            return;
        }
    }
}

void tl_contours_refine(tl_contour_work *work, uint32_t loop, uint32_t *stack)
{
    const tl_contour_loop *l = &work->loops[loop];
    uint32_t start = l->first;
    while (!work->keep[start]) {
        start++;
    }
    for (uint32_t begin = start;;) {
        uint32_t end = tl_contour_next(work, begin);
        while (!work->keep[end]) {
            end = tl_contour_next(work, end);
        }
        if (work->across[begin] == 0 || (work->vertices[begin].flags & TL_CONTOUR_AREA_BORDER) != 0) {
            refine(work, l, begin, end, stack);
        }
        if (end == start) {
            return;
        }
        begin = end;
    }
}

tl_result tl_contours_simplify(tl_contour_work *work)
{
    uint32_t longest = 0;
    for (uint32_t l = 0; l < work->loop_count; l++) {
        longest = work->loops[l].count > longest ? work->loops[l].count : longest;
    }
    uint32_t *stack = TL_PUSH(work->arena, uint32_t, longest);
    work->keep = TL_PUSH_ZERO(work->arena, uint8_t, work->vertex_count);
    if (stack == NULL || work->keep == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t l = 0; l < work->loop_count; l++) {
        keep_changes(work, &work->loops[l]);
    }
    for (uint32_t l = 0; l < work->loop_count; l++) {
        keep_extremes(work, &work->loops[l]);
    }
    for (uint32_t l = 0; l < work->loop_count; l++) {
        tl_contours_refine(work, l, stack);
    }
    return TL_OK;
}

// Takes a vertex at the path's end back together with the one before it where they make nothing: two in a row at one
// place, of which the later stays because the edge that goes on is its own; or a spike, there and back.
static void append_vertex(const tl_contour_work *work, tl_contour_path *path, uint32_t vertex)
{
    const tl_contour_vertex *v = &work->vertices[vertex];
    const uint32_t *last = path->vertices + path->count;
    if (path->count > 0 && tl_contour_same_xz(v, &work->vertices[last[-1]])) {
        path->count -= 1;
    } else if (path->count > 1 && tl_contour_same_xz(v, &work->vertices[last[-2]])) {
        path->count -= 2;
    }
    path->vertices[path->count++] = vertex;
}

// The same where the path's end meets its beginning.
static void trim_ends(const tl_contour_work *work, tl_contour_path *path)
{
    uint32_t begin = 0, end = path->count;
    while (end - begin > 1) {
        const tl_contour_vertex *first = &work->vertices[path->vertices[begin]];
        const tl_contour_vertex *last = &work->vertices[path->vertices[end - 1]];
        bool more = end - begin > 2;
        if (tl_contour_same_xz(first, last) ||
            (more && tl_contour_same_xz(first, &work->vertices[path->vertices[end - 2]]))) {
            end -= tl_contour_same_xz(first, last) ? 1 : 2;
        } else if (more && tl_contour_same_xz(&work->vertices[path->vertices[begin + 1]], last)) {
            begin += 1; // the spike's tip; its foot is the last vertex and the second
            end -= 1;
        } else {
            break;
        }
    }
    path->count = end - begin;
    memmove(path->vertices, path->vertices + begin, path->count * sizeof *path->vertices);
}

void tl_contours_simplified(const tl_contour_work *work, uint32_t loop, tl_contour_path *path)
{
    const tl_contour_loop *l = &work->loops[loop];
    path->count = 0;
    for (uint32_t k = l->first; k < l->first + l->count; k++) {
        if (work->keep[k]) {
            append_vertex(work, path, k);
        }
    }
    trim_ends(work, path);
}
