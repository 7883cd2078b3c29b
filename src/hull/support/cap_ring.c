// SPDX-License-Identifier: MIT
//
// Finds caps, and fills their rings: see cap_ring.h.
//
// A cap is all faces whose normals lie in a disc of a few cells of the table, when they have many more corners than the
// mean disc, and next to no area lies in a ring of the same width around the disc: a dome that goes on is as evenly
// spread over the table's cells as a ball. (By area, for the slivers along the rim of a rounded face lean anywhere.)
// Discs are looked for where a cell holds several normals, the fullest first. A disc's faces hang together, for the
// directions of a vertex are a convex region.

#include "hull/support/cap_ring.h"

#include "base/assert.h"
#include "base/min_max.h"
#include "hull/support/direction_table.h"

#include <math.h>

// Of a cap: fewer are a step or two apart anyway. And so many times as many as the mean disc has.
enum { MIN_CAP_VERTICES = 24, MIN_CROWD = 16 };

// Normals in a cell that is looked at: a disc's may be shared by four cells, and the faces of a cap that rounding made
// are as many as its corners, less two. And so many times as many again as the mean cell of a large hull has.
enum { MIN_CELL_FACES = 6, MIN_CELL_CROWD = 4, MAX_CELL_FACES = 255 };

// The radius of the smallest disc in sides of a cell; so many larger ones are tried, each twice as wide; how often a
// disc moves to the mean of its normals; and how much more area twice the radius may hold.
#define DISC_SIDES 2.0
#define ISOLATION  1.5
enum { DISC_SIZES = 2, DISC_MOVES = 6 };

// Where levels are sampled, in radii of the disc: the outermost stands for all directions from there on.
#define OUTERMOST     4.0
#define LEVEL_FALL    0.25
#define LEVEL_BETWEEN 1.4142135623730951 // a level's middle over its inner end, of two binades

// Of an axis in a hull that is checked: no product with a direction overflows. The scale is at least 1e-6, and a disc
// at least 2 / 512 wide, so those that are baked are below 2^30.
#define MAX_AXIS 1099511627776.0f // 2^40

// What the search works with.
typedef struct cap_search {
    const tl_hull *hull;
    tl_hull_caps *caps;
    uint32_t side;           // of the table
    uint8_t *cell_faces;     // [2 side^2] normals in each cell, up to MAX_CELL_FACES
    uint32_t *cells;         // [F] each face's
    tl_vec3d *normals;       // [F] scaled, of unit length
    uint32_t *face_round;    // [F] the last disc that a face was found for, TL_NO_VERTEX once it is in a cap
    uint32_t *vertex_round;  // [V] the last disc that a vertex was counted for
    bool *is_of_large_face;  // [V]
    uint32_t *queue, queued; // [F] of the disc
    uint32_t round;
} cap_search;

static tl_vec3d face_normal_of(const tl_hull *hull, uint32_t face)
{
    const tl_hull_plane plane = tl_hull_face_plane(hull, face);
    return tl_vec3d_make(plane.normal[0], plane.normal[1], plane.normal[2]);
}

static tl_vec3d scaled_unit(const tl_hull *hull, tl_vec3d normal)
{
    const tl_vec3d scaled = tl_vec3d_mul(normal, tl_vec3d_from(tl_hull_climb_head(hull)->table_scale));
    return tl_vec3d_scale(scaled, 1.0 / tl_vec3d_length(scaled));
}

// Of a table without finer cells for rings, so that a disc does not depend on what is found.
static uint32_t plain_side(const tl_hull *hull)
{
    return tl_hull_table_side(hull->vertex_count, false);
}

// Twice a face's area along its normal.
static tl_vec3d area_vector_of(const tl_hull *hull, uint32_t face)
{
    const tl_hull_face f = tl_hull_face_at(hull, face);
    const tl_vec3d origin = tl_vec3d_from(tl_hull_corner(hull, f.first));
    tl_vec3d sum = tl_vec3d_make(0.0, 0.0, 0.0);
    tl_vec3d last = tl_vec3d_sub(tl_vec3d_from(tl_hull_corner(hull, f.first + 1)), origin);
    for (uint32_t k = 2; k < f.count; k++) {
        const tl_vec3d next = tl_vec3d_sub(tl_vec3d_from(tl_hull_corner(hull, f.first + k)), origin);
        sum = tl_vec3d_add(sum, tl_vec3d_cross(last, next));
        last = next;
    }
    return sum;
}

// A disc on the sphere of scaled normals.
typedef struct cap_disc {
    tl_vec3d normal, middle; // as they are, and scaled
    double radius;
    uint32_t face; // one in it
    double area;   // of its faces, twice
} cap_disc;

static double normal_distance_sq(const cap_search *s, uint32_t face, tl_vec3d middle)
{
    const tl_vec3d off = tl_vec3d_sub(s->normals[face], middle);
    return tl_vec3d_dot(off, off);
}

static void visit_face(cap_search *s, uint32_t face, const cap_disc *disc)
{
    if (s->face_round[face] != s->round && s->face_round[face] != TL_NO_VERTEX &&
        normal_distance_sq(s, face, disc->middle) <= disc->radius * disc->radius) {
        s->face_round[face] = s->round;
        s->queue[s->queued++] = face;
    }
}

// Queues the faces of a disc; the sum of their areas along their normals.
static tl_vec3d fill_disc(cap_search *s, cap_disc *disc)
{
    tl_vec3d sum = tl_vec3d_make(0.0, 0.0, 0.0);
    disc->area = 0.0;
    s->round++;
    s->queued = 0;
    visit_face(s, disc->face, disc);
    for (uint32_t i = 0; i < s->queued; i++) {
        const tl_hull_face f = tl_hull_face_at(s->hull, s->queue[i]);
        const tl_vec3d area = area_vector_of(s->hull, s->queue[i]);
        sum = tl_vec3d_add(sum, area);
        disc->area += tl_vec3d_length(area);
        for (uint32_t k = 0; k < f.count; k++) {
            visit_face(s, tl_hull_edge_face(s->hull, tl_hull_edge_twin(s->hull, f.first + k)), disc);
        }
    }
    return sum;
}

static cap_disc disc_around(const cap_search *s, tl_vec3d normal, double radius, uint32_t face)
{
    const cap_disc disc = { normal, scaled_unit(s->hull, normal), radius, face, 0.0 };
    return disc;
}

// Moves a disc to the mean of its normals, by area, while that changes it.
static void settle_disc(cap_search *s, cap_disc *disc)
{
    tl_vec3d sum = fill_disc(s, disc);
    for (uint32_t i = 0, last = 0; i < DISC_MOVES && s->queued != last && tl_vec3d_length(sum) > 0.0; i++) {
        last = s->queued;
        *disc = disc_around(s, tl_vec3d_scale(sum, 1.0 / tl_vec3d_length(sum)), disc->radius, disc->face);
        for (uint32_t k = 0; k < s->queued; k++) {
            const bool nearer =
                normal_distance_sq(s, s->queue[k], disc->middle) < normal_distance_sq(s, disc->face, disc->middle);
            disc->face = nearer ? s->queue[k] : disc->face;
        }
        sum = fill_disc(s, disc);
    }
}

// Vertices of the disc, of all and of those that have no ring by a large face or another cap.
static uint32_t count_disc_vertices(cap_search *s, uint32_t *without_ring)
{
    uint32_t count = 0;
    *without_ring = 0;
    for (uint32_t i = 0; i < s->queued; i++) {
        const tl_hull_face f = tl_hull_face_at(s->hull, s->queue[i]);
        for (uint32_t k = 0; k < f.count; k++) {
            const uint32_t v = tl_hull_edge_origin(s->hull, f.first + k);
            if (s->vertex_round[v] != s->round) {
                s->vertex_round[v] = s->round;
                count++;
                *without_ring += !s->is_of_large_face[v] && s->caps->of_vertices[v] == TL_NO_FACE_RING;
            }
        }
    }
    return count;
}

static void add_cap(cap_search *s, const cap_disc *disc, uint32_t without_ring)
{
    tl_hull_caps *caps = s->caps;
    tl_hull_cap *cap = &caps->caps[caps->count];
    cap->normal = disc->normal;
    cap->middle = disc->middle;
    cap->radius = disc->radius;
    cap->vertex = tl_hull_edge_origin(s->hull, tl_hull_face_at(s->hull, disc->face).first);
    cap->cell_count = 2u << tl_highest_bit(2 * without_ring - 1);
    for (uint32_t i = 0; i < s->queued; i++) {
        const tl_hull_face f = tl_hull_face_at(s->hull, s->queue[i]);
        s->face_round[s->queue[i]] = TL_NO_VERTEX;
        for (uint32_t k = 0; k < f.count; k++) {
            uint32_t *of = &caps->of_vertices[tl_hull_edge_origin(s->hull, f.first + k)];
            *of = *of == TL_NO_FACE_RING ? caps->count : *of;
        }
    }
    caps->count++;
}

static bool is_isolated(cap_search *s, const cap_disc *disc)
{
    cap_disc wide = disc_around(s, disc->normal, 2.0 * disc->radius, disc->face);
    fill_disc(s, &wide);
    return wide.area <= ISOLATION * disc->area;
}

// No face whose normal shares a cell with one of the disc is tried again.
static void give_up(cap_search *s)
{
    for (uint32_t i = 0; i < s->queued; i++) {
        s->cell_faces[s->cells[s->queue[i]]] = 0;
    }
}

// Looks for a cap around a face.
static void try_face(cap_search *s, uint32_t face)
{
    cap_disc disc = disc_around(s, face_normal_of(s->hull, face), DISC_SIDES / (double)s->side, face);
    for (uint32_t size = 0; size < DISC_SIZES; size++) {
        settle_disc(s, &disc);
        if (s->queued >= MIN_CELL_FACES && is_isolated(s, &disc)) {
            fill_disc(s, &disc);
            uint32_t without_ring;
            const uint32_t count = count_disc_vertices(s, &without_ring);
            const uint64_t side_sq = (uint64_t)s->side * s->side;
            const uint64_t mean_disc = (uint64_t)s->hull->vertex_count * MIN_CROWD / side_sq << 2 * size;
            if (without_ring >= MIN_CAP_VERTICES && without_ring >= mean_disc && without_ring > count / 2) {
                add_cap(s, &disc, without_ring);
            }
            return;
        }
        give_up(s);
        disc.radius *= 2.0;
    }
}

// Counts the normals in each cell; the most in one.
static uint32_t count_cell_faces(cap_search *s)
{
    const tl_vec3 scale = tl_hull_climb_head(s->hull)->table_scale;
    uint32_t most = 0;
    for (uint32_t face = 0; face < s->hull->face_count; face++) {
        const tl_vec3 normal = tl_vec3d_to_float(face_normal_of(s->hull, face));
        s->cells[face] = tl_table_cell(tl_mul(normal, scale), s->side);
        uint8_t *count = &s->cell_faces[s->cells[face]];
        *count = (uint8_t)tl_min_u32(*count + 1u, MAX_CELL_FACES);
        most = tl_max_u32(most, *count);
    }
    return most;
}

static void scale_normals(cap_search *s)
{
    for (uint32_t face = 0; face < s->hull->face_count; face++) {
        s->normals[face] = scaled_unit(s->hull, face_normal_of(s->hull, face));
    }
}

static void mark_large_faces(cap_search *s)
{
    for (uint32_t face = 0; face < s->hull->face_count; face++) {
        const tl_hull_face f = tl_hull_face_at(s->hull, face);
        for (uint32_t k = 0; k < f.count && tl_face_has_ring(f.count); k++) {
            s->is_of_large_face[tl_hull_edge_origin(s->hull, f.first + k)] = true;
        }
    }
}

static uint32_t least_cell_faces(const cap_search *s)
{
    return MIN_CELL_FACES + MIN_CELL_CROWD * (s->hull->face_count / (2 * s->side * s->side));
}

static tl_result search_caps(cap_search *s, uint32_t most, tl_stage *stage)
{
    const uint32_t end = tl_min_u32(least_cell_faces(s), MAX_CELL_FACES);
    for (uint32_t least = most, last = 0; last != end; least = tl_max_u32(least / 2, end)) {
        last = least;
        for (uint32_t face = 0; face < s->hull->face_count; face++) {
            uint8_t *count = &s->cell_faces[s->cells[face]];
            if (s->face_round[face] != TL_NO_VERTEX && *count >= least) {
                *count = 0;
                try_face(s, face);
            }
        }
        TL_TRY(tl_stage_add(stage, 0));
    }
    return TL_OK;
}

tl_result tl_hull_find_caps(const tl_hull *hull, tl_arena *arena, tl_stage *stage, tl_hull_caps *caps_out)
{
    memset(caps_out, 0, sizeof *caps_out);
    const uint32_t vertex_count = hull->vertex_count, side = plain_side(hull);
    cap_search s = { .hull = hull, .caps = caps_out, .side = side };
    s.cell_faces = TL_PUSH_ZERO(arena, uint8_t, 2 * (size_t)side * side);
    s.cells = TL_PUSH(arena, uint32_t, hull->face_count);
    if (s.cell_faces == NULL || s.cells == NULL) {
        return TL_ERR_MEMORY;
    }
    const uint32_t most = count_cell_faces(&s);
    if (most < least_cell_faces(&s)) {
        return TL_OK;
    }
    s.normals = TL_PUSH(arena, tl_vec3d, hull->face_count);
    s.face_round = TL_PUSH_ZERO(arena, uint32_t, hull->face_count);
    s.queue = TL_PUSH(arena, uint32_t, hull->face_count);
    s.vertex_round = TL_PUSH_ZERO(arena, uint32_t, vertex_count);
    s.is_of_large_face = TL_PUSH_ZERO(arena, bool, vertex_count);
    caps_out->of_vertices = TL_PUSH(arena, uint32_t, vertex_count);
    caps_out->caps = TL_PUSH(arena, tl_hull_cap, vertex_count / MIN_CAP_VERTICES + 1);
    if (s.normals == NULL || s.face_round == NULL || s.queue == NULL || s.vertex_round == NULL ||
        s.is_of_large_face == NULL || caps_out->of_vertices == NULL || caps_out->caps == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t v = 0; v < vertex_count; v++) {
        caps_out->of_vertices[v] = TL_NO_FACE_RING;
    }
    scale_normals(&s);
    mark_large_faces(&s);
    return search_caps(&s, most, stage);
}

void tl_hull_count_caps(const tl_hull_caps *caps, tl_hull_climb *climb)
{
    for (uint32_t i = 0; i < caps->count; i++) {
        climb->ring_cells += tl_cap_cells(caps->caps[i].cell_count);
    }
    climb->ring_count += caps->count;
    climb->cap_count = caps->count;
}

// A cap's ring while it is filled.
typedef struct cap_frame {
    tl_vec3d normal, u, v; // of unit length, right-handed, scaled as the table is
} cap_frame;

static cap_frame cap_frame_of(const tl_hull_cap *cap)
{
    cap_frame frame;
    frame.normal = cap->middle;
    frame.v = tl_vec3d_perpendicular(frame.normal);
    frame.u = tl_vec3d_cross(frame.v, frame.normal);
    return frame;
}

static tl_face_ring ring_of(const tl_hull *hull, const tl_hull_cap *cap, const cap_frame *frame, uint32_t first)
{
    // So that |u . d| + |v . d| over |d.x| + |d.y| + |d.z| is 1 on the outermost circle.
    const tl_vec3d scale = tl_vec3d_from(tl_hull_climb_head(hull)->table_scale), n = cap->normal;
    const double size = fabs(n.x) + fabs(n.y) + fabs(n.z);
    const double stretch = size / (cap->radius * tl_vec3d_length(tl_vec3d_mul(n, scale)));
    const tl_vec3 u = tl_vec3d_to_float(tl_vec3d_scale(tl_vec3d_mul(frame->u, scale), stretch));
    const tl_vec3 v = tl_vec3d_to_float(tl_vec3d_scale(tl_vec3d_mul(frame->v, scale), stretch));
    const tl_face_ring ring = { { u.x, u.y, u.z }, { v.x, v.y, v.z }, first, cap->cell_count | TL_RING_OF_CAP };
    return ring;
}

// Of the middle of a cell, with a size within the range of hull_support.h.
static tl_vec3 cap_direction(const tl_hull *hull, const cap_frame *frame, double reach, uint32_t cell,
                             uint32_t cell_count)
{
    double at[2];
    tl_ring_cell_middle(cell, cell_count, at);
    const tl_vec3d scale = tl_vec3d_from(tl_hull_climb_head(hull)->table_scale);
    const tl_vec3d off = tl_vec3d_mul_add(tl_vec3d_scale(frame->u, reach * at[0]), frame->v, reach * at[1]);
    const tl_vec3d scaled = tl_vec3d_add(frame->normal, off);
    const tl_vec3d d = tl_vec3d_make(scaled.x / scale.x, scaled.y / scale.y, scaled.z / scale.z);
    return tl_vec3d_to_float(tl_vec3d_scale(d, 1.0 / tl_vec3d_length(d)));
}

static void fill_cap(const tl_hull *hull, const tl_hull_cap *cap, const cap_frame *frame, uint32_t *cells)
{
    const tl_support_kernel kernel = tl_support_kernel_best();
    uint32_t first = cap->vertex;
    double reach = OUTERMOST * cap->radius;
    for (uint32_t level = 0; level < TL_CAP_LEVELS; level++) {
        const uint32_t cell_count = tl_cap_level_cells(cap->cell_count, level);
        uint32_t vertex = first;
        for (uint32_t cell = 0; cell < cell_count; cell++) {
            const tl_vec3 d = cap_direction(hull, frame, reach, cell, cell_count);
            vertex = kernel.climb(hull, d.x, d.y, d.z, vertex);
            cells[cell] = vertex;
        }
        first = cells[0];
        cells += cell_count;
        reach = level + 2 == TL_CAP_LEVELS ? 0.0 : (level == 0 ? LEVEL_BETWEEN * cap->radius : reach) * LEVEL_FALL;
    }
}

tl_result tl_hull_fill_caps(tl_hull *hull, const tl_hull_caps *caps, uint32_t *table, uint32_t *rings_of_vertices,
                            tl_stage *stage)
{
    const tl_hull_climb *climb = tl_hull_climb_head(hull);
    const uint32_t face_rings = climb->ring_count - caps->count;
    tl_face_ring *rings = (tl_face_ring *)(uintptr_t)tl_hull_rings(hull) + face_rings;
    uint64_t first = tl_hull_cell_count(climb);
    for (uint32_t i = 0; i < caps->count; i++) {
        first -= tl_cap_cells(caps->caps[i].cell_count);
    }
    for (uint32_t i = 0; i < caps->count; i++) {
        const cap_frame frame = cap_frame_of(&caps->caps[i]);
        rings[i] = ring_of(hull, &caps->caps[i], &frame, (uint32_t)first);
        fill_cap(hull, &caps->caps[i], &frame, table + first);
        const uint64_t end = first + tl_cap_cells(caps->caps[i].cell_count);
        for (; first < end; first++) {
            uint32_t *of = &caps->of_vertices[table[first]]; // corners of slivers that lean out of the disc
            *of = *of == TL_NO_FACE_RING && rings_of_vertices[table[first]] == TL_NO_FACE_RING ? i : *of;
        }
        TL_TRY(tl_stage_add(stage, 0));
    }
    for (uint32_t v = 0; v < hull->vertex_count && caps->count > 0; v++) {
        if (caps->of_vertices[v] != TL_NO_FACE_RING) {
            rings_of_vertices[v] = face_rings + caps->of_vertices[v];
        }
    }
    return TL_OK;
}

bool tl_is_in_cap(const tl_hull *hull, const tl_hull_cap *cap, tl_vec3 direction)
{
    const tl_vec3d off = tl_vec3d_sub(scaled_unit(hull, tl_vec3d_from(direction)), cap->middle);
    return tl_vec3d_dot(off, off) <= cap->radius * cap->radius;
}

bool tl_is_cap_ring(const tl_face_ring *ring, uint32_t first, uint64_t end)
{
    const uint64_t cells = ring->cell_count & ~TL_RING_OF_CAP;
    bool is_small = true; // so that no product with a direction overflows
    for (int i = 0; i < 3; i++) {
        is_small = is_small && fabsf(ring->u[i]) <= MAX_AXIS && fabsf(ring->v[i]) <= MAX_AXIS;
    }
    return is_small && ring->first == first && (ring->cell_count & TL_RING_OF_CAP) != 0 && (cells & (cells - 1)) == 0 &&
           cells >= TL_CAP_LEAST_CELLS && cells <= end / 2 && first + tl_cap_cells((uint32_t)cells) <= end;
}
