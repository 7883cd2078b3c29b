// SPDX-License-Identifier: MIT
//
// Which stage of a bake removes a point.

#ifndef TALUS_SRC_NAV_AUDIT_WHY_STAGES_H
#define TALUS_SRC_NAV_AUDIT_WHY_STAGES_H

#include <talus/nav_audit.h>

/// What is asked, and the host's means.
typedef struct tl_why_question {
    const tl_nav_input *input;
    tl_aabb mesh_bounds;
    tl_vec3 point;
    const tl_host *host;
    bool window_only; ///< look no farther than erosion: NONE says nothing about regions and outlines then
} tl_why_question;

/// What the stages left at the point.
typedef struct tl_why_finding {
    tl_nav_cause cause;
    tl_nav_config config; ///< of the point's tile
    tl_vec3 floor;        ///< the floor that was meant
    bool has_floor;
    uint32_t triangle;     ///< the least steep one that makes this floor, or TL_NO_TRIANGLE
    float normal_y;        ///< its
    float wall;            ///< WALL: metres to it in the plane
    float drop;            ///< NO_FLOOR: metres down to the next floor, or INFINITY
    float outside;         ///< metres by which the bounds end too early for the point to be walkable; 0: they do not
    uint32_t clearance;    ///< CEILING: voxels of free height
    uint32_t needed_climb; ///< LEDGE: voxels, 0: no climb helps
    uint32_t kept_radius;  ///< RADIUS: the largest number of columns with which the floor stays
    uint32_t island;       ///< ISLAND: its columns
} tl_why_finding;

/// Runs the stages on the columns around the point, then bakes its tile. Errors: those of tl_nav_tile_bake.
tl_result tl_why_find(const tl_why_question *question, const tl_nav_def *def, tl_why_finding *finding_out,
                      tl_report *report);

/// Whether a navmesh has a polygon at the floor, in the plane, and within reach of it upwards and downwards.
bool tl_why_on_navmesh(const tl_navmesh *navmesh, const tl_nav_config *config, tl_vec3 floor,
                       tl_nav_location *location_out);

#endif
