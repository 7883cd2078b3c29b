// SPDX-License-Identifier: MIT
//
// Decomposition of a triangle mesh into convex parts: few hulls that stand for a solid or a surface in collisions.
//
// Every part is the convex hull of the piece of the mesh that planes cut out. Two bounds are proven and reported:
// how far the hulls reach beyond the mesh (the concavity, held below a tolerance), and how far the mesh reaches beyond
// the hulls (the rounding of the cuts, unless vertices are limited).
//
// The mesh may be open, intersect itself, repeat triangles or be loose triangles. What it encloses is solid; what can
// be reached from outside is not, and stays open where it is wider than twice the tolerance: a mug's handle, a doorway.
//
// Sources: Lien, Amato, Approximate Convex Decomposition of Polyhedra, 2007 (cut until a tolerance holds); Mamou,
// V-HACD, 2016 (voxels that guide planes, then merging); Wei, Liu, Ling, Su, Approximate Convex Decomposition for 3D
// Meshes with Collision-Aware Concavity and Tree Search, 2022 (what concavity must measure).

#ifndef TALUS_DECOMPOSE_H
#define TALUS_DECOMPOSE_H

#include <talus/base.h>
#include <talus/hull.h>
#include <talus/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/// More parts than this before merging are TL_ERR_LIMIT: the tolerance is too small for the mesh.
#define TL_MAX_DECOMPOSED_PARTS 0x10000u

/// What of space belongs to the body.
typedef enum tl_solid_rule {
    TL_SOLID_ENCLOSED, ///< the surface, and all that cannot be reached from outside, whatever the winding
    TL_SOLID_SURFACE   ///< the surface alone: rooms of a level stay open, though their walls enclose them
} tl_solid_rule;

/// How a mesh is decomposed. Begin with tl_default_decompose_def().
typedef struct tl_decompose_def {
    /// Metres, >= 0: the concavity that a part may have. At least 64 half ulps of the largest coordinate. 0: as
    /// `relative_tolerance` says.
    float tolerance;
    float relative_tolerance; ///< (0, 1]: of the longest side of the mesh's box. Read where `tolerance` is 0
    uint32_t max_parts;       ///< 0: no limit; else parts are merged beyond the tolerance until there are no more
    uint32_t max_vertices;    ///< of a part's hull: 0: no limit; else >= 4. The mesh may then reach out of the hulls
    /// Metres, >= 0 and at most the tolerance, of the hull of a flat part. 0: a sixteenth of the tolerance.
    float thickness;
    tl_solid_rule solid;
    /// 4,096 to 67,108,864: cells of the grid that guides the cuts, 8 bytes each. Fewer than the tolerance asks for
    /// (half of it is a cell's side) cost more parts, and more time for the proof, but no truth.
    uint32_t max_cells;
    tl_host host;
    uint32_t cookie; ///< private: set by tl_default_decompose_def
} tl_decompose_def;

/// One convex part.
typedef struct tl_convex_part {
    tl_hull *hull;
    /// Metres: no point of the hull is farther from the body. A proven bound, no more than the tolerance but where
    /// `max_parts` asked for it; some tenths of the tolerance may be the proof's own.
    double concavity;
    /// Metres: no point of the mesh that this part covers is farther outside of its hull.
    double max_outside;
} tl_convex_part;

/// Convex parts of a mesh. They may overlap. Free with tl_decomposition_free.
typedef struct tl_decomposition {
    tl_convex_part *parts;  ///< [part_count], those of largest volume first
    uint32_t part_count;    ///< >= 1
    double concavity;       ///< metres, the largest of the parts: no point of the union is farther from the body
    double max_outside;     ///< metres, the largest of the parts: no point of the mesh is farther from the union
    double hull_volume;     ///< cubic metres, the sum of the parts
    tl_allocator allocator; ///< private: what frees the array
} tl_decomposition;

/// What tl_decomposition_bake did.
typedef struct tl_decompose_report {
    tl_report base;
    float tolerance;               ///< metres, that was asked for
    float cell;                    ///< metres, side of the grid's cells
    uint32_t degenerate_triangles; ///< without area: left out
    uint32_t cut_count;            ///< planes that cut a part
    uint32_t parts_before_merging;
    uint32_t parts_over_tolerance; ///< because of max_parts, or because they could not be cut any finer
} tl_decompose_report;

/// A relative tolerance of 0.025, no limit of parts, 256 vertices, what is enclosed is solid, 2^20 cells, malloc.
TL_API tl_decompose_def tl_default_decompose_def(void);

/// Decomposes a mesh into convex parts.
///
/// The result depends on the view and the def only, not on the tasks. Runs on the host's tasks. Time grows with the
/// number of cells, and with triangles times parts. `def` NULL: defaults; `report_out` may be NULL.
/// Errors: those of tl_soup_bake; TL_ERR_ARGUMENT (a field), TL_ERR_RANGE (the tolerance is below the coordinates'
/// rounding, or a coordinate beyond 1e9 m), TL_ERR_LIMIT (TL_MAX_DECOMPOSED_PARTS), TL_ERR_MEMORY, TL_ERR_CANCELLED. On
/// failure `*decomposition_out` is zeroed. Free with tl_decomposition_free.
TL_API tl_result tl_decomposition_bake(const tl_mesh_view *view, const tl_decompose_def *def,
                                       tl_decomposition *decomposition_out, tl_decompose_report *report_out);

/// Frees the hulls and the array, and zeroes the struct. NULL or zeroed: nothing happens.
TL_API void tl_decomposition_free(tl_decomposition *decomposition);

#ifdef __cplusplus
}
#endif

#endif
