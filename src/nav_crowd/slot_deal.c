// SPDX-License-Identifier: MIT
//
// Slots are dealt so that the squares of the straight ways to them have the smallest sum. Squares and not lengths: then
// no two ways cross at one time, so that those who set out together and keep their spacing do not meet (Turpin,
// Michael, Kumar, CAPT: Concurrent Assignment and Planning of Trajectories, 2014), and nobody goes far for the others.
//
// Up to 64 followers by the Hungarian method: shortest augmenting paths with potentials (Kuhn 1955; Jonker, Volgenant
// 1987), whose memory is a few rows. Above, where n^3 is too much for a frame, by sorting both sides alike: along the
// slots' longer principal axis into strips, and along the shorter one within each. It keeps left to the left and front
// to the front, for a line exactly; for 64 places at random the sum is 2.5 times the smallest (test_slot_deal), which
// later exchanges mend (crowd_lead.c).

#include "nav_crowd/slot_deal.h"

#include <math.h>
#include <stdbool.h>

static double squared_deal_way(const tl_slot_deal *deal, uint32_t follower, uint32_t slot)
{
    const double x = (double)deal->to[2 * slot] - (double)deal->from[2 * follower];
    const double z = (double)deal->to[2 * slot + 1] - (double)deal->from[2 * follower + 1];
    return x * x + z * z;
}

// Rows are slots, columns followers, both from 1 on; column 0 stands for the row that is being added.
typedef struct hungarian {
    double row[TL_SLOT_DEAL_EXACT + 1], column[TL_SLOT_DEAL_EXACT + 1]; // potentials
    double slack[TL_SLOT_DEAL_EXACT + 1];
    uint32_t row_of[TL_SLOT_DEAL_EXACT + 1]; // of a column; 0: it is free
    uint32_t before[TL_SLOT_DEAL_EXACT + 1]; // the column from which the tree came to this one
    bool is_in_tree[TL_SLOT_DEAL_EXACT + 1];
} hungarian;

// Grows the tree by its cheapest edge. Returns the column that it came to.
static uint32_t grow(const tl_slot_deal *deal, hungarian *h, uint32_t from)
{
    const uint32_t row = h->row_of[from];
    uint32_t next = 0;
    double least = (double)INFINITY;
    h->is_in_tree[from] = true;
    for (uint32_t c = 1; c <= deal->count; c++) {
        if (h->is_in_tree[c]) {
            continue;
        }
        const double slack = squared_deal_way(deal, c - 1, row - 1) - h->row[row] - h->column[c];
        if (slack < h->slack[c]) {
            h->slack[c] = slack;
            h->before[c] = from;
        }
        if (h->slack[c] < least) {
            least = h->slack[c];
            next = c;
        }
    }
    for (uint32_t c = 0; c <= deal->count; c++) {
        if (h->is_in_tree[c]) {
            h->row[h->row_of[c]] += least;
            h->column[c] -= least;
        } else {
            h->slack[c] -= least;
        }
    }
    return next;
}

static void deal_exactly(const tl_slot_deal *deal)
{
    hungarian h;
    for (uint32_t c = 0; c <= deal->count; c++) {
        h.row[c] = h.column[c] = 0.0;
        h.row_of[c] = h.before[c] = 0;
    }
    for (uint32_t row = 1; row <= deal->count; row++) {
        for (uint32_t c = 0; c <= deal->count; c++) {
            h.slack[c] = (double)INFINITY;
            h.is_in_tree[c] = false;
        }
        h.row_of[0] = row;
        uint32_t at = 0;
        do {
            at = grow(deal, &h, at);
        } while (h.row_of[at] != 0);
        while (at != 0) {
            h.row_of[at] = h.row_of[h.before[at]];
            at = h.before[at];
        }
    }
    for (uint32_t c = 1; c <= deal->count; c++) {
        deal->taker[h.row_of[c] - 1] = c - 1;
    }
}

typedef struct deal_axes {
    double x, z;   // the longer one, unit; the shorter is (-z, x)
    double aspect; // of both spreads, >= 1; INFINITY: all slots lie on a line
} deal_axes;

// The principal axes of the slots: the eigenvectors of their covariance.
static deal_axes find_axes(const tl_slot_deal *deal)
{
    double middle_x = 0.0, middle_z = 0.0, xx = 0.0, xz = 0.0, zz = 0.0;
    for (uint32_t i = 0; i < deal->count; i++) {
        middle_x += (double)deal->to[2 * i];
        middle_z += (double)deal->to[2 * i + 1];
    }
    middle_x /= (double)deal->count;
    middle_z /= (double)deal->count;
    for (uint32_t i = 0; i < deal->count; i++) {
        const double x = (double)deal->to[2 * i] - middle_x, z = (double)deal->to[2 * i + 1] - middle_z;
        xx += x * x;
        xz += x * z;
        zz += z * z;
    }
    const double half = 0.5 * (xx - zz);
    const double root = sqrt(half * half + xz * xz);
    const double longer = 0.5 * (xx + zz) + root, shorter = 0.5 * (xx + zz) - root;
    // Of the two forms of the eigenvector the one without cancellation.
    deal_axes axes = { half >= 0.0 ? half + root : xz, half >= 0.0 ? xz : root - half, (double)INFINITY };
    const double length = sqrt(axes.x * axes.x + axes.z * axes.z);
    axes.x = length > 0.0 ? axes.x / length : 1.0;
    axes.z = length > 0.0 ? axes.z / length : 0.0;
    axes.aspect = shorter > 0.0 ? sqrt(longer / shorter) : (double)INFINITY;
    return axes;
}

static void sort_along(const float *places, tl_sort_item *items, tl_sort_item *scratch, uint32_t count, double x,
                       double z)
{
    for (uint32_t i = 0; i < count; i++) {
        const float *place = &places[2 * (size_t)items[i].value];
        items[i].key = tl_float_sort_key((float)((double)place[0] * x + (double)place[1] * z));
    }
    tl_radix_sort(items, scratch, count);
}

static void sort_into_strips(const tl_slot_deal *deal, const float *places, tl_sort_item *items, const deal_axes *axes,
                             uint32_t strips)
{
    for (uint32_t i = 0; i < deal->count; i++) {
        items[i].value = i;
        items[i].extra = 0;
    }
    // By the shorter axis first: so places that are level on the longer one are cut alike on both sides.
    sort_along(places, items, deal->scratch, deal->count, -axes->z, axes->x);
    sort_along(places, items, deal->scratch, deal->count, axes->x, axes->z);
    for (uint32_t strip = 0; strip < strips; strip++) {
        const uint32_t begin = (uint32_t)((uint64_t)deal->count * strip / strips);
        const uint32_t end = (uint32_t)((uint64_t)deal->count * (strip + 1) / strips);
        sort_along(places, items + begin, deal->scratch, end - begin, -axes->z, axes->x);
    }
}

void tl_slot_deal_by_strips(const tl_slot_deal *deal)
{
    const deal_axes axes = find_axes(deal);
    // As many strips as make the places within them as far apart as the strips are.
    const double wanted = sqrt((double)deal->count * axes.aspect);
    const uint32_t strips = wanted < (double)deal->count ? (uint32_t)wanted : deal->count;
    sort_into_strips(deal, deal->to, deal->slots, &axes, strips);
    sort_into_strips(deal, deal->from, deal->followers, &axes, strips);
    for (uint32_t i = 0; i < deal->count; i++) {
        deal->taker[deal->slots[i].value] = deal->followers[i].value;
    }
}

void tl_slot_deal_out(const tl_slot_deal *deal)
{
    if (deal->count <= TL_SLOT_DEAL_EXACT) {
        deal_exactly(deal);
    } else {
        tl_slot_deal_by_strips(deal);
    }
}
