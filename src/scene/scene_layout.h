// SPDX-License-Identifier: MIT
//
// The bytes of a scene: a record and a place for each instance, and nodes of sixteen boxes, breadth first, so that
// children lie behind their parents. A node is eight cache lines: planes, children, and the mask of all instances below
// each child, so that a query skips subtrees that it ignores.
//
// A scale lies in a record's matrix, so rays need not know of it; lengths are another matter, and all other queries
// keep to the rigid part of the pose and ask the soup or shape at its scale.

#ifndef TALUS_SRC_SCENE_SCENE_LAYOUT_H
#define TALUS_SRC_SCENE_SCENE_LAYOUT_H

#include "base/assert.h"
#include "math/scale.h"
#include "math/vec3d.h"

#include <talus/scene.h>

enum { TL_SCENE_WIDTH = 16 };

/// In a child word: the rest is the index of an instance. Else it is that of a node; 0 is no child, since the root is
/// nobody's child.
#define TL_CHILD_INSTANCE 0x80000000u

/// Nodes on the longest path: levels whose splits the costs choose, and log16 of the largest number of instances.
enum { TL_SCENE_COST_DEPTH = 24, TL_SCENE_MAX_DEPTH = TL_SCENE_COST_DEPTH + 8 };

/// Each node on the path leaves all but one of its children on the stack.
enum { TL_SCENE_STACK_SIZE = (TL_SCENE_WIDTH - 1) * TL_SCENE_MAX_DEPTH + TL_SCENE_WIDTH };

typedef struct tl_scene_node {
    float plane[6][TL_SCENE_WIDTH]; ///< min x, max x, min y, ...; of a lane without a box INFINITY, -INFINITY
    uint32_t child[TL_SCENE_WIDTH];
    uint32_t mask[TL_SCENE_WIDTH]; ///< of all instances below
} tl_scene_node;

/// An instance's box and the way into the frame of its rotation, for rays: a cache line, which most rays that enter the
/// box in the world do not look beyond. The box is scaled, so lengths are the world's.
typedef struct tl_scene_own_box {
    tl_vec3 axes[3]; ///< the world's axes in the instance's frame
    tl_vec3 offset;  ///< the world's origin there, from the middle of the box
    tl_vec3 half;    ///< extents around the middle
    float size;      ///< of the position, the middle and the extents, summed over all axes
} tl_scene_own_box;

/// What it takes to come into an instance's space: the more, the larger. Numbers keep their bits, a -0 too, where
/// nothing is done to them.
typedef enum tl_scene_way {
    TL_SCENE_IDENTITY,
    TL_SCENE_MOVED,
    TL_SCENE_TURNED, ///< from here on by the matrix
    TL_SCENE_SCALED
} tl_scene_way;

/// An instance as it was when the scene was last baked or refitted.
typedef struct tl_scene_record {
    tl_scene_own_box own;
    tl_vec3d rows[3]; ///< the rotation's matrix, its columns divided by the scale's factors
    tl_transform pose;
    tl_aabb local; ///< the instance's box in its own space, without the scale; empty: nothing is here
    uint32_t way;  ///< tl_scene_way
} tl_scene_record;

/// What no ray needs of an instance.
typedef struct tl_scene_place {
    tl_vec3 scale; ///< no factor is 0
    uint32_t lane; ///< where its box is: TL_SCENE_WIDTH * node + lane
} tl_scene_place;
static_assert(sizeof(tl_scene_own_box) == 64 && sizeof(tl_scene_record) % 64 == 0, "own boxes are cache lines");

struct tl_scene {
    tl_blob blob;
    uint32_t instance_count;
    uint32_t node_count; ///< >= 1
    uint32_t depth;
    uint32_t padding;
    tl_aabb bounds;
    double baked_cost; ///< of tl_scene_stats, when the scene was baked
    double cost;
    uint64_t records; ///< tl_scene_record [instance_count], bytes from the beginning
    uint64_t nodes;   ///< tl_scene_node [node_count]
    uint64_t places;  ///< tl_scene_place [instance_count]
};

/// Whether a query was given a scene and, if it holds any, its instances.
static inline bool tl_scene_has_instances(const tl_scene *scene, const tl_scene_instance *instances)
{
    return scene != NULL && (instances != NULL || scene->instance_count == 0);
}

static inline const tl_scene_record *tl_scene_records(const tl_scene *scene)
{
    return (const tl_scene_record *)(const void *)((const char *)scene + scene->records);
}

static inline const tl_scene_place *tl_scene_places(const tl_scene *scene)
{
    return (const tl_scene_place *)(const void *)((const char *)scene + scene->places);
}

static inline const tl_scene_node *tl_scene_nodes(const tl_scene *scene)
{
    return (const tl_scene_node *)(const void *)((const char *)scene + scene->nodes);
}

static inline bool tl_scene_is_rotated(tl_quat q)
{
    return (q.x != 0.0f) | (q.y != 0.0f) | (q.z != 0.0f);
}

/// The way into the space of an instance that is not scaled.
static inline uint32_t tl_scene_rigid_way(const tl_transform *pose)
{
    const tl_vec3 *p = &pose->position;
    bool moved = (p->x != 0.0f) | (p->y != 0.0f) | (p->z != 0.0f);
    return tl_scene_is_rotated(pose->rotation) ? TL_SCENE_TURNED : moved ? TL_SCENE_MOVED : TL_SCENE_IDENTITY;
}

/// Whether the way into the instance's space is its matrix. Else its axes are the world's.
static inline bool tl_scene_has_matrix(const tl_scene_record *record)
{
    return record->way >= TL_SCENE_TURNED;
}

static inline bool tl_scene_is_scaled(const tl_scene_record *record)
{
    return record->way == TL_SCENE_SCALED;
}

/// Whether there is no way to go: then queries keep their bits.
static inline bool tl_scene_is_identity(const tl_scene_record *record)
{
    return record->way == TL_SCENE_IDENTITY;
}

/// A direction of the world in the instance's space, in double: R^T v, divided by the scale. Only where there is a
/// matrix: others keep their bits.
static inline tl_vec3d tl_scene_rotate_back(const tl_scene_record *record, tl_vec3d v)
{
    const tl_vec3d *r = record->rows;
    return tl_vec3d_make(r[0].x * v.x + r[1].x * v.y + r[2].x * v.z, r[0].y * v.x + r[1].y * v.y + r[2].y * v.z,
                         r[0].z * v.x + r[1].z * v.y + r[2].z * v.z);
}

/// The instance's directions and points in the world, and back, each coordinate rounded once.
static inline tl_vec3 tl_scene_direction_to_instance(const tl_scene_record *record, tl_vec3 v)
{
    return tl_scene_has_matrix(record) ? tl_vec3d_to_float(tl_scene_rotate_back(record, tl_vec3d_from(v))) : v;
}

static inline tl_vec3 tl_scene_point_to_instance(const tl_scene_record *record, tl_vec3 p)
{
    if (tl_scene_is_identity(record)) {
        return p;
    }
    tl_vec3d v = tl_vec3d_sub(tl_vec3d_from(p), tl_vec3d_from(record->pose.position));
    return tl_vec3d_to_float(tl_scene_has_matrix(record) ? tl_scene_rotate_back(record, v) : v);
}

static inline tl_vec3d tl_scene_rotate(const tl_scene_record *record, tl_vec3d v)
{
    const tl_vec3d *r = record->rows;
    return tl_vec3d_make(tl_vec3d_dot(r[0], v), tl_vec3d_dot(r[1], v), tl_vec3d_dot(r[2], v));
}

/// Of a surface: by the inverse transpose, which the matrix is, and of unit length again.
static inline tl_vec3 tl_scene_normal_to_world(const tl_scene_record *record, tl_vec3 v)
{
    if (tl_scene_is_scaled(record)) {
        return tl_vec3d_unit_or_zero(tl_scene_rotate(record, tl_vec3d_from(v)));
    }
    return tl_scene_has_matrix(record) ? tl_vec3d_to_float(tl_scene_rotate(record, tl_vec3d_from(v))) : v;
}

/// Of an instance that is not scaled.
static inline tl_vec3 tl_scene_point_to_world(const tl_scene_record *record, tl_vec3 p)
{
    TL_ASSERT(!tl_scene_is_scaled(record));
    if (tl_scene_is_identity(record)) {
        return p;
    }
    tl_vec3d v = tl_vec3d_from(p);
    v = tl_scene_has_matrix(record) ? tl_scene_rotate(record, v) : v;
    return tl_vec3d_to_float(tl_vec3d_add(v, tl_vec3d_from(record->pose.position)));
}

/// The record without its scale: as it is, or in the room. Only `rows`, `pose` and `way` count there.
static inline const tl_scene_record *tl_scene_rigid(const tl_scene_record *record, tl_scene_record *room)
{
    if (!tl_scene_is_scaled(record)) {
        return record;
    }
    tl_frame frame = tl_frame_from(record->pose);
    for (int i = 0; i < 3; i++) {
        room->rows[i] = frame.rows[i];
    }
    room->pose = record->pose;
    room->way = tl_scene_rigid_way(&record->pose);
    return room;
}

/// An instance's soup at its scale.
static inline tl_scaled_soup tl_scene_soup(const tl_scene_place *place, const tl_soup *soup)
{
    tl_scaled_soup scaled = { soup, place->scale };
    return scaled;
}

/// An instance's shape at its scale: itself, or in the room. The scale was checked when the scene was baked; where the
/// shape has become one that does not take it, it stays as it is.
static inline const tl_convex *tl_scene_shape(const tl_scene_place *place, const tl_convex *shape,
                                              tl_scaled_convex *room)
{
    return !tl_scale_is_one(place->scale) && tl_scaled_convex_make(shape, place->scale, room, NULL) == TL_OK
               ? &room->shape
               : shape;
}

/// The mask bits that count for a filter, which may be NULL.
static inline uint32_t tl_scene_mask(const tl_scene_filter *filter)
{
    return filter != NULL ? ~filter->ignored_mask : UINT32_MAX;
}

static inline const tl_ray_filter *tl_scene_triangles(const tl_scene_filter *filter)
{
    return filter != NULL ? filter->triangles : NULL;
}

/// Whether an instance counts for a filter, its mask aside.
static inline bool tl_scene_accepts(const tl_scene_filter *filter, uint32_t instance)
{
    return filter == NULL || (instance - filter->first_ignored >= filter->ignored_count &&
                              (filter->accept == NULL || filter->accept(instance, filter->accept_user)));
}

#endif
