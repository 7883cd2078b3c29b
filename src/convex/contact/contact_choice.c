// SPDX-License-Identifier: MIT
//
// Which four corners of a patch are kept: the ones of the last manifold, else those that span the largest area.
//
// The area of the best four changes little when bodies tremble, which corners these are may change at any time: a
// polygon of 16 equal sides has four best choices. A solver that starts with the last impulses needs the same corners,
// so the last four stay while they span half of what the patch does (any convex region has four corners of at least
// 0.63 of its area; Blaschke 1917), and a corner known already counts for more in a new choice. Starting from the
// deepest corner, as is common, chooses anew with each tremor.
//
// Of choices that are equally large, the one whose corners are spread more evenly resists tilting in all directions:
// four corners of a hexagon are a rectangle, twice as long as wide, or a kite of the same area.

#include "convex/contact/face_patch.h"

#include "base/lowest_bit.h"

// The last four stay while they span at least this part of the patch.
#define KEPT_AREA 0.5

// Each corner of the last manifold makes a choice so much larger.
#define KNOWN_BONUS 0.1

// A corner is the last one when it is within this part of the patch's extent of it.
#define SAME_CORNER 0.02

// Areas that differ by less than this part are as good as equal.
#define SAME_AREA 0.01

enum { DIRECTIONS = 8, MAX_CANDIDATES = DIRECTIONS + TL_MAX_CONTACTS + 1 };

typedef struct choice {
    tl_patch_point *points[MAX_CANDIDATES];
    uint32_t count;
} choice;

static void add_candidate(choice *c, tl_patch_point *point)
{
    for (uint32_t i = 0; i < c->count; i++) {
        if (c->points[i] == point) {
            return;
        }
    }
    c->points[c->count++] = point;
}

// The corners farthest along eight directions, which are far from the axes and the diagonals that many faces have. A
// corner where a polygon turns by an eighth or more is among them.
static void add_extremes(tl_patch *patch, choice *c)
{
    static const double turn[DIRECTIONS / 2][2] = { { 0.9238795325112867, 0.3826834323650898 },
                                                    { 0.3826834323650898, 0.9238795325112867 },
                                                    { -0.3826834323650898, 0.9238795325112867 },
                                                    { -0.9238795325112867, 0.3826834323650898 } };
    for (int k = 0; k < DIRECTIONS / 2; k++) {
        uint32_t low = 0, high = 0;
        double least = (double)INFINITY, most = -(double)INFINITY;
        for (uint32_t i = 0; i < patch->count; i++) {
            double along = turn[k][0] * patch->points[i].x + turn[k][1] * patch->points[i].y;
            low = along < least ? i : low;
            least = along < least ? along : least;
            high = along > most ? i : high;
            most = along > most ? along : most;
        }
        add_candidate(c, &patch->points[low]);
        add_candidate(c, &patch->points[high]);
    }
}

static void add_known(tl_patch *patch, choice *c)
{
    for (uint32_t i = 0; i < patch->count; i++) {
        if (patch->points[i].previous != TL_NO_CONTACT && c->count < MAX_CANDIDATES) {
            add_candidate(c, &patch->points[i]);
        }
    }
}

uint32_t tl_patch_lowest(const tl_patch *patch)
{
    uint32_t lowest = 0;
    double least = tl_patch_separation(&patch->points[0]);
    for (uint32_t i = 1; i < patch->count; i++) {
        double separation = tl_patch_separation(&patch->points[i]);
        lowest = separation < least ? i : lowest;
        least = separation < least ? separation : least;
    }
    return lowest;
}

static double half_turn(double x, double y)
{
    double size = fabs(x) + fabs(y); // rises with the angle, 0 .. 4
    return size > 0.0 ? (y >= 0.0 ? 1.0 - x / size : 3.0 + x / size) : 0.0;
}

// Around their middle, counter-clockwise.
static void sort_around(choice *c)
{
    double x = 0.0, y = 0.0, keys[MAX_CANDIDATES];
    for (uint32_t i = 0; i < c->count; i++) {
        x += c->points[i]->x / (double)c->count;
        y += c->points[i]->y / (double)c->count;
    }
    for (uint32_t i = 0; i < c->count; i++) {
        tl_patch_point *point = c->points[i];
        double key = half_turn(point->x - x, point->y - y);
        uint32_t k = i;
        for (; k > 0 && keys[k - 1] > key; k--) {
            keys[k] = keys[k - 1];
            c->points[k] = c->points[k - 1];
        }
        keys[k] = key;
        c->points[k] = point;
    }
}

// Twice the area.
static double whole_area(const choice *c)
{
    double sum = 0.0;
    for (uint32_t i = 2; i < c->count; i++) {
        const tl_patch_point *p = c->points[0], *q = c->points[i - 1], *r = c->points[i];
        sum += (q->x - p->x) * (r->y - p->y) - (q->y - p->y) * (r->x - p->x);
    }
    return sum;
}

static double distance_sq(const tl_patch_point *p, const tl_patch_point *q)
{
    return (p->x - q->x) * (p->x - q->x) + (p->y - q->y) * (p->y - q->y);
}

// Of a patch that is a line: the two farthest from one another.
static uint32_t keep_two(const choice *c, const tl_patch_point *kept[4])
{
    uint32_t first = 0, second = 0;
    for (uint32_t i = 0; i < c->count; i++) {
        for (uint32_t k = 0; k < i; k++) {
            if (distance_sq(c->points[i], c->points[k]) > distance_sq(c->points[first], c->points[second])) {
                first = i;
                second = k;
            }
        }
    }
    kept[0] = c->points[first];
    kept[1] = c->points[second];
    return first != second ? 2 : 1;
}

// How evenly four corners resist tilting: the determinant of their second moments about their middle.
static double second_moment(const tl_patch_point *const points[4])
{
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    for (int i = 0; i < 4; i++) {
        x += 0.25 * points[i]->x;
        y += 0.25 * points[i]->y;
    }
    for (int i = 0; i < 4; i++) {
        const double along_x = points[i]->x - x, along_y = points[i]->y - y;
        xx += along_x * along_x;
        xy += along_x * along_y;
        yy += along_y * along_y;
    }
    return xx * yy - xy * xy;
}

static uint32_t keep_largest(const choice *c, double least_area, const tl_patch_point *kept[4])
{
    double bonus[MAX_CANDIDATES], most = least_area, best_moment = 0.0;
    uint32_t best[4] = { 0 };
    for (uint32_t i = 0; i < c->count; i++) {
        bonus[i] = c->points[i]->previous != TL_NO_CONTACT ? KNOWN_BONUS : 0.0;
    }
    for (uint32_t i = 0; i + 3 < c->count; i++) {
        for (uint32_t k = i + 2; k + 1 < c->count; k++) {
            const tl_patch_point *p = c->points[i], *r = c->points[k];
            double x = r->x - p->x, y = r->y - p->y, known = 1.0 + bonus[i] + bonus[k];
            for (uint32_t j = i + 1; j < k; j++) {
                for (uint32_t l = k + 1; l < c->count; l++) {
                    const tl_patch_point *q = c->points[j], *s = c->points[l];
                    double value = (x * (s->y - q->y) - y * (s->x - q->x)) * (known + bonus[j] + bonus[l]);
                    if (!(value > most * (1.0 - SAME_AREA))) {
                        continue;
                    }
                    const tl_patch_point *const four[4] = { p, q, r, s };
                    const double moment = second_moment(four);
                    if (value > most * (1.0 + SAME_AREA) || moment > best_moment) {
                        most = value > most ? value : most;
                        best_moment = moment;
                        best[0] = i, best[1] = j, best[2] = k, best[3] = l;
                    }
                }
            }
        }
    }
    if (best[3] == 0) {
        return keep_two(c, kept);
    }
    for (int i = 0; i < 4; i++) {
        kept[i] = c->points[best[i]];
    }
    return 4;
}

static double box_area(const tl_patch *patch)
{
    double low_x = patch->points[0].x, high_x = low_x, low_y = patch->points[0].y, high_y = low_y;
    for (uint32_t i = 1; i < patch->count; i++) {
        double x = patch->points[i].x, y = patch->points[i].y;
        low_x = x < low_x ? x : low_x;
        high_x = x > high_x ? x : high_x;
        low_y = y < low_y ? y : low_y;
        high_y = y > high_y ? y : high_y;
    }
    return (high_x - low_x) * (high_y - low_y);
}

// The last manifold's corners, if there are four and they still span enough: of the box around the patch, or, which
// takes longer, of its corners.
static uint32_t keep_last(tl_patch *patch, const tl_patch_point *kept[4])
{
    choice last = { { NULL }, 0 }, all = { { NULL }, 0 };
    uint32_t known = 0;
    for (uint32_t i = 0; i < patch->count; i++) {
        known |= (patch->points[i].previous < 4 ? 1u : 0u) << i; // the fifth is the deepest, which came and goes
    }
    if (tl_bit_count(known) < 4) {
        return 0;
    }
    for (; last.count < 4; known &= known - 1) {
        last.points[last.count++] = &patch->points[tl_lowest_bit(known)];
    }
    sort_around(&last);
    double area = whole_area(&last);
    if (!(area >= 2.0 * KEPT_AREA * box_area(patch))) {
        add_extremes(patch, &all);
        sort_around(&all);
        if (!(area >= KEPT_AREA * whole_area(&all))) {
            return 0;
        }
    }
    for (int i = 0; i < 4; i++) {
        kept[i] = last.points[i];
    }
    return 4;
}

static double extent_of_patch(const tl_patch *patch)
{
    double most = 0.0;
    for (uint32_t i = 1; i < patch->count; i++) {
        double apart = distance_sq(&patch->points[0], &patch->points[i]);
        most = apart > most ? apart : most;
    }
    return sqrt(most);
}

// Where features changed though places did not.
static void match_places(tl_patch *patch)
{
    uint32_t taken = 0, every = (1u << patch->last->count) - 1u;
    for (uint32_t i = 0; i < patch->count; i++) {
        taken |= 1u << (patch->points[i].previous & 31u); // a new one's bit is none of a contact
    }
    if ((taken & every) == every) {
        return;
    }
    double extent = extent_of_patch(patch);
    for (uint32_t k = 0; k < patch->last->count; k++) {
        if ((taken >> k & 1u) != 0) {
            continue;
        }
        tl_point2 place = tl_patch_project(patch, tl_vec3d_from(patch->last->points[k]));
        tl_patch_point at = { place.x, place.y, 0.0, 0.0, { 0 }, 0 }, *nearest = NULL;
        double within = SAME_CORNER * extent * SAME_CORNER * extent;
        for (uint32_t i = 0; i < patch->count; i++) {
            double apart = distance_sq(&patch->points[i], &at);
            if (patch->points[i].previous == TL_NO_CONTACT && apart <= within) {
                within = apart;
                nearest = &patch->points[i];
            }
        }
        if (nearest != NULL) {
            nearest->previous = k;
        }
    }
}

void tl_patch_choose(tl_patch *patch, uint32_t lowest_at, double slack)
{
    const uint32_t last_count = patch->last != NULL ? patch->last->count : 0;
    const tl_patch_point **kept = patch->chosen;
    if (last_count > 0) {
        match_places(patch);
    }
    patch->chosen_count = patch->count;
    if (patch->count <= 4) {
        for (uint32_t i = 0; i < patch->count; i++) {
            kept[i] = &patch->points[i];
        }
        return;
    }
    uint32_t count = last_count >= 4 ? keep_last(patch, kept) : 0;
    if (count == 0) {
        choice c = { { NULL }, 0 };
        if (patch->count <= DIRECTIONS) {
            for (; c.count < patch->count; c.count++) {
                c.points[c.count] = &patch->points[c.count];
            }
        } else {
            add_extremes(patch, &c);
            add_known(patch, &c);
        }
        sort_around(&c);
        count = keep_largest(&c, patch->gap * extent_of_patch(patch), kept);
    }
    const tl_patch_point *lowest = &patch->points[lowest_at];
    double least = (double)INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        double separation = tl_patch_separation(kept[i]);
        least = separation < least ? separation : least;
    }
    if (least > tl_patch_separation(lowest) + slack) {
        kept[count++] = lowest;
    }
    patch->chosen_count = count;
}

void tl_patch_thin(tl_patch *patch)
{
    choice c = { { NULL }, 0 };
    add_extremes(patch, &c);
    add_candidate(&c, &patch->points[tl_patch_lowest(patch)]);
    add_known(patch, &c);
    tl_patch_point kept[MAX_CANDIDATES];
    for (uint32_t i = 0; i < c.count; i++) {
        kept[i] = *c.points[i];
    }
    for (uint32_t i = 0; i < c.count; i++) {
        patch->points[i] = kept[i];
    }
    patch->count = c.count;
}
