// SPDX-License-Identifier: MIT
//
// The working form of the hull build: triangles over the input points, each with the points that lie outside of it.
//
// Invariant after each step: the live triangles bound a convex body, weakly (neighbours may be coplanar), and every
// point that is not on its surface or inside is filed under a triangle that it lies strictly in front of.

#ifndef TALUS_SRC_HULL_QUICKHULL_H
#define TALUS_SRC_HULL_QUICKHULL_H

#include "hull/bake/hull_polygons.h"
#include "hull/bake/side_plane.h"
#include "math/vec3d.h"

// Half-edge k of triangle f is 4 * f + k and runs from vertex k to vertex (k + 1) % 3. What a step reads of a face is
// one cache line; what it keeps for it lies beside, in tl_quickhull_conflicts.
typedef struct tl_quickhull_face {
    tl_side_plane plane;
    uint32_t vertex[3];
    uint32_t across[3]; // the twin of each half-edge
} tl_quickhull_face;

typedef struct tl_quickhull_conflicts {
    double farthest_value; // height of the farthest point times the normal's length
    uint32_t first;        // head of a list linked by tl_quickhull_point.next
    uint32_t farthest;     // its point with the largest value; lowest index on ties
    uint32_t seen;         // twice the step that last tested whether the face is visible, plus 1 when it is
    uint32_t newer, older; // neighbours among the faces that wait
    bool live;
} tl_quickhull_conflicts;

// An input point, moved by tl_quickhull.origin.
typedef struct tl_quickhull_point {
    tl_vec3 position;
    uint32_t next; // in its face's list
} tl_quickhull_point;

// Of a face that waits, when farthest_first.
typedef struct tl_quickhull_entry {
    double distance;
    uint32_t face;
    uint32_t point;
} tl_quickhull_entry;

typedef struct tl_quickhull tl_quickhull;
typedef struct tl_filing tl_filing; // file_points.h

// Files each point of the list that begins with `first` under the first face of a step that it is strictly in front of,
// exactly, or when each_farthest under that from whose plane it lies farthest. One that is in front of none waits no
// longer. TL_ERR_CANCELLED.
typedef tl_result tl_file_points_fn(tl_quickhull *hull, const tl_filing *filing, uint32_t first);

struct tl_quickhull {
    tl_arena *arena;
    tl_stage *stage; // its unit: points that are a corner, inside or on the surface
    uint32_t work;   // points and faces that were looked at since progress was called
    const tl_vec3 *points;
    const tl_hull *named; // a hull whose corners the points are: vertices get its sources; NULL: their own indices
    uint32_t point_count;
    uint32_t passive_count; // behind them: points that become no corner, and end filed under a face that they see
    uint32_t waiting;       // points that are filed under a face
    tl_aabb box;
    tl_vec3 origin;            // of the local points
    tl_quickhull_point *local; // [point_count + passive_count] the points near the origin, exactly moved
    double reach[3];           // the largest absolute local coordinates; 0 where heights are exact
    bool exact;                // heights are: see tl_quickhull_on_lattice

    tl_quickhull_face *faces;
    tl_quickhull_conflicts *conflicts; // [face_capacity]
    uint32_t face_count;               // used entries, dead ones included
    uint32_t face_capacity;
    uint32_t live_faces;
    uint32_t free_face; // list of dead faces linked by vertex[0]

    uint32_t *cone_face; // [point_count] the new face whose horizon edge starts at this vertex

    // One step's scratch, grown with the faces.
    uint32_t *visible; // faces that see the new point
    uint32_t visible_count;
    uint32_t *horizon; // half-edges of visible faces whose twins are not visible
    uint32_t horizon_count;
    uint32_t *created;
    uint32_t created_count;
    uint32_t step;

    // Faces that wait: the newest first, or a heap when farthest_first.
    uint32_t newest;
    bool farthest_first;
    bool each_farthest; // each point is filed under the face that it lies farthest from
    tl_quickhull_entry *heap;
    uint32_t heap_count, heap_capacity;

    tl_file_points_fn *file_points; // NULL: face by face (conflict_list.c)
};

static inline uint32_t tl_half_edge_face(uint32_t half_edge)
{
    return half_edge >> 2;
}

static inline uint32_t tl_half_edge_corner(uint32_t half_edge)
{
    return half_edge & 3u;
}

static inline uint32_t tl_half_edge_next(uint32_t half_edge)
{
    return tl_half_edge_corner(half_edge) == 2 ? half_edge - 2 : half_edge + 1;
}

// Calls progress once each TL_QUICKHULL_STEP points or faces: some 10 to 100 ns each, and up to some us where
// predicates must be exact.
#define TL_QUICKHULL_STEP 0x4000u
static inline tl_result tl_quickhull_count_work(tl_quickhull *hull, uint32_t amount)
{
    hull->work += amount;
    if (hull->work < TL_QUICKHULL_STEP) {
        return TL_OK;
    }
    hull->work = 0;
    return tl_stage_add(hull->stage, hull->point_count - hull->waiting - hull->stage->done);
}

// 1 when a point, given by its local position, is in front of a face, 0 in its plane, -1 behind; exact. `height_out`
// gets its approximate height times the normal's length.
static inline int tl_quickhull_side(const tl_quickhull *hull, const tl_quickhull_face *face, tl_vec3 p,
                                    double *height_out)
{
    *height_out = tl_side_plane_height(&face->plane, p);
    int sign = tl_side_plane_sign(&face->plane, *height_out);
    if (sign != 0 || hull->exact) {
        return sign;
    }
    const tl_quickhull_point *local = hull->local;
    return tl_orient3d(local[face->vertex[0]].position, local[face->vertex[1]].position,
                       local[face->vertex[2]].position, p);
}

// quickhull.c
// A hull to be, of points that stay the caller's. `arena` and `stage` serve it.
void tl_quickhull_init(tl_quickhull *hull, const tl_vec3 *points, uint32_t count, tl_arena *arena, tl_stage *stage);
// Builds it: the polygons, how many copies of each point were made (thicken.c), and the report, which may be NULL.
tl_result tl_quickhull_build(tl_quickhull *hull, const tl_hull_def *def, tl_hull_report *report, uint32_t *copies_out,
                             tl_hull_polygons *polygons_out);
// A live face without neighbours; the caller has reserved it by tl_quickhull_reserve.
uint32_t tl_quickhull_new_face(tl_quickhull *hull, uint32_t a, uint32_t b, uint32_t c);
void tl_quickhull_free_face(tl_quickhull *hull, uint32_t face);
// Reserves capacity for `more` new faces, here and in the scratch.
tl_result tl_quickhull_reserve(tl_quickhull *hull, uint32_t more);

// point_lattice.c: whether side tests in double are exact for the local points.
bool tl_quickhull_on_lattice(const tl_quickhull_point *points, uint32_t count, tl_vec3 reach);

// seed.c: the first tetrahedron, and the named result of input without volume.
tl_result tl_quickhull_seed(tl_quickhull *hull, double flatness, uint32_t seed_out[4], uint32_t *rank_out);

// conflict_list.c
tl_result tl_quickhull_file_all(tl_quickhull *hull, const uint32_t seed[4]);
// Files the points of the visible faces under the created ones.
tl_result tl_quickhull_refile(tl_quickhull *hull);
// Lets a new face wait for its turn, if it has points.
tl_result tl_quickhull_enqueue(tl_quickhull *hull, uint32_t face);
// When farthest_first: from now on the newest face is the next.
void tl_quickhull_end_order(tl_quickhull *hull);
// Takes a face that is about to die out of the waiting ones.
void tl_quickhull_unqueue(tl_quickhull *hull, uint32_t face);
// The next face with a point outside, or TL_NONE; when farthest_first also where that lies no farther from the face's
// plane than `enough`.
uint32_t tl_quickhull_dequeue(tl_quickhull *hull, double enough);

// horizon.c
// Fills `visible` with the faces that a point, which is strictly in front of `first`, sees; and `horizon`.
void tl_quickhull_flood_visible(tl_quickhull *hull, uint32_t first, tl_vec3 eye);
// Replaces all that is visible from the face's farthest point by a cone. Leaves `visible` for the refiling.
tl_result tl_quickhull_add_point(tl_quickhull *hull, uint32_t face);

// left_out.c: of the points that are still outside, lists in `beyond` those that lie farther out than `allowed`, and
// measures how far the farthest of the others does. `beyond` holds all of them, and may be NULL where `allowed` is
// infinite. TL_ERR_CANCELLED.
tl_result tl_quickhull_measure_left_out(tl_quickhull *hull, double allowed, uint32_t *beyond, uint32_t *beyond_count,
                                        double *max_outside);

// When farthest_first and no face waits whose points lie far from its plane: lets the faces wait under which a point is
// filed that lies farther out than `allowed`, that point first. `found`: there are some. TL_ERR_CANCELLED.
tl_result tl_quickhull_enqueue_beyond(tl_quickhull *hull, double allowed, bool *found);

// quickhull.c
// As tl_hull_bake; `named` as in tl_quickhull.
tl_result tl_hull_bake_named(const tl_vec3 *points, uint32_t count, const tl_hull *named, const tl_hull_def *def,
                             tl_hull **hull_out, tl_hull_report *report_out);
// The hull of another's vertices, which are all corners, merged by a distance; NULL allocator: malloc. Silent.
tl_result tl_hull_bake_merged(const tl_hull *corners, float distance, const tl_allocator *allocator,
                              tl_hull **hull_out);

// face_merge.c
tl_result tl_quickhull_merge_faces(tl_quickhull *hull, tl_hull_polygons *polygons_out);

// thicken.c: copies of the points moved to both sides along the directions that they lack.
tl_result tl_quickhull_thicken(tl_quickhull *hull, const uint32_t seed[4], uint32_t rank, float thickness,
                               uint32_t *copies_out);

#endif
