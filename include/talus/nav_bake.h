// SPDX-License-Identifier: MIT
//
// Baking a navigation mesh: the stages of Recast's voxel pipeline, each callable alone, all data in between readable.
//
//     tl_nav_def def = tl_default_nav_def();
//     tl_nav_input input = { .mesh = view };
//     tl_nav_tiles tiles;
//     tl_result result = tl_nav_bake(&def, &input, &tiles, NULL);
//
// runs all of them, for all tiles of a level. They are, in order, with Recast's functions beside them:
//
//   config       tl_nav_config_from_def    metres become voxels, here and nowhere else     rcConfig
//   rasterize    tl_nav_rasterize          triangles -> heightfield: solid spans           rcRasterizeTriangles
//   filter       tl_nav_filter_...         spans that an agent cannot stand on             rcFilter...
//   compact      tl_nav_bake_compact       -> compact heightfield: floors, linked          rcBuildCompactHeightfield
//   erode        tl_nav_erode              by the agent's radius                           rcErodeWalkableArea
//   areas        tl_nav_mark_..._area      volumes give floors an area                     rcMark...Area
//   distance     tl_nav_distance_field     of each floor to the nearest border             rcBuildDistanceField
//   regions      tl_nav_bake_regions       watershed, monotone or layers                   rcBuildRegions...
//   contours     tl_nav_bake_contours      traced, then simplified (Douglas-Peucker)       rcBuildContours
//   polygons     tl_polygon_mesh_bake      convex polygons (polygon.h)                     rcBuildPolyMesh
//   detail mesh  tl_nav_bake_detail        heights inside the polygons                     rcBuildPolyMeshDetail
//   tile         tl_nav_tile_encode        the blob that queries read (nav_tile.h)         dtCreateNavMeshData
//
// Sources: Mikko Mononen, Recast; Stephen Pratt, Critterai. Settings have Recast's names and defaults.
//
// Where talus differs: results do not depend on the order of triangles or on the number of workers; all tiles of a
// level share one lattice; simplified contours neither cross nor collapse; linked polygons have the same detail
// vertices on their common edge.
//
// Lattice: x is a column's index along x, z its index along z (row), y a height in units of cell_height above
// bounds.min.y. A floor is the top of a walkable span: a span of the compact heightfield.

#ifndef TALUS_NAV_BAKE_H
#define TALUS_NAV_BAKE_H

#include <talus/mesh.h>
#include <talus/nav_tile.h>
#include <talus/polygon.h>

#ifdef __cplusplus
extern "C" {
#endif

/// How floors are divided into regions.
typedef enum tl_nav_partition {
    TL_NAV_WATERSHED, ///< best shapes, slowest; the usual choice for levels that are baked ahead
    TL_NAV_MONOTONE,  ///< fastest, no holes ever; long thin polygons
    TL_NAV_LAYERS     ///< fast, no overlaps; good for tiles of middle size
} tl_nav_partition;

/// What to bake, in metres. Fields have the names and defaults that users of Recast know.
typedef struct tl_nav_def {
    float cell_size;       ///< metres, >= TL_NAV_MIN_CELL: edge of a voxel on x and z. Default 0.3
    float cell_height;     ///< metres, >= TL_NAV_MIN_CELL: height of a voxel. Default 0.2
    float agent_height;    ///< metres, > 0: free height that an agent needs, rounded up to whole voxels. Default 2
    float agent_radius;    ///< metres, >= 0: the walkable area is eroded by it, rounded up to whole cells. Default 0.6
    float agent_max_climb; ///< metres, >= 0: highest step, rounded down to whole voxels. Default 0.9
    float agent_max_slope; ///< degrees, [0, 90): floors less steep than this, and flat ones, are walkable. Default 45
    float region_min_size; ///< cells: islands of fewer columns than its square are removed. Default 8
    float region_merge_size;       ///< cells: regions of fewer columns than its square are merged. Default 20
    float edge_max_len;            ///< metres, >= 0: longest contour edge along a wall, 0: any. Default 12
    float edge_max_error;          ///< cells, >= 0: how far a simplified contour may leave the traced one. Default 1.3
    uint32_t max_verts_per_poly;   ///< [3, 64]. Default 6
    float detail_sample_dist;      ///< cells: spacing of the detail mesh's height samples; < 0.9: no samples. Default 6
    float detail_sample_max_error; ///< voxel heights: how far the detail mesh may leave the floor. Default 1
    tl_nav_partition partition;    ///< Default TL_NAV_WATERSHED
    tl_partition_method polygon_method;    ///< how contours are divided (polygon.h). Default TL_PARTITION_CLASSIC
    bool filter_low_hanging_obstacles;     ///< Default true
    bool filter_ledge_spans;               ///< Default true
    bool filter_walkable_low_height_spans; ///< Default true
    uint32_t tile_size;                    ///< cells, 0: the whole level is one tile. Default 0
    float tile_height; ///< metres, rounded down to voxels: the floors of one place are divided into layers of this
                       ///< height, each a tile of its own. 0: they are one tile. Default 0
    tl_aabb bounds;    ///< metres; what to bake. Empty (the default): the bounds of the mesh
    tl_host host;
    uint32_t cookie; ///< TL_DEF_COOKIE, by tl_default_nav_def
} tl_nav_def;

TL_API tl_nav_def tl_default_nav_def(void);

/// Where a heightfield lies in the level's lattice. All tiles of a level share one lattice, and a tile's first column
/// is an integer: a triangle fills the same voxels, bit for bit, in every tile that it reaches.
typedef struct tl_nav_lattice {
    tl_vec3 origin;           ///< metres; the corner of column (0, 0) of the level, height 0
    int32_t first_x, first_z; ///< the first column in the level's lattice, border included; may be negative
} tl_nav_lattice;

/// World coordinate of a lattice line: the one formula, so that two tiles that share a line agree on it bit for bit.
/// `origin` is the lattice origin's coordinate on the axis, `line` counts from it, `size` is the cell's edge or height.
static inline float tl_nav_lattice_to_world(float origin, int64_t line, float size)
{
    return (float)((double)origin + (double)line * (double)size);
}

/// The def in lattice units, for one tile.
typedef struct tl_nav_config {
    tl_nav_lattice lattice;         ///< where this tile's columns lie in the level's lattice
    tl_aabb bounds;                 ///< metres; of this tile's columns, border included, rounded from the lattice
    float cell_size;                ///< metres
    float cell_height;              ///< metres
    uint32_t width;                 ///< columns along x, border included
    uint32_t height;                ///< columns along z, border included
    uint32_t height_voxels;         ///< voxels from the bottom to the top of the bounds
    uint32_t border_size;           ///< columns on each side that belong to the neighbour tiles
    uint32_t walkable_height;       ///< voxels, >= 1
    uint32_t walkable_climb;        ///< voxels
    uint32_t walkable_radius;       ///< columns
    float walkable_slope_cos;       ///< walkable triangles have a unit normal of larger y
    uint32_t min_region_area;       ///< columns
    uint32_t merge_region_area;     ///< columns
    uint32_t max_edge_len;          ///< columns, 0: any
    float max_simplification_error; ///< columns
    uint32_t max_verts_per_poly;
    float detail_sample_dist;      ///< metres, 0: no samples
    float detail_sample_max_error; ///< metres
    tl_nav_partition partition;
    tl_partition_method polygon_method;
    bool filter_low_hanging_obstacles, filter_ledge_spans, filter_walkable_low_height_spans;
    uint32_t tile_x, tile_z;                           ///< this tile's place in the grid of tiles
    uint32_t layer_height;                             ///< voxels, 0: a place is one tile
    float agent_height, agent_radius, agent_max_climb; ///< metres, as given; kept in the tile for queries
} tl_nav_config;

/// Area 0 is not walkable. Areas 1 to 255 are the user's. Triangles without an area get TL_NAV_WALKABLE_AREA, the value
/// of Recast's RC_WALKABLE_AREA.
#define TL_NAV_NULL_AREA     0
#define TL_NAV_WALKABLE_AREA 63

// Limits, checked before any work is done:
#define TL_NAV_MAX_HEIGHT  0xfffeu    ///< voxels from the bottom to the top of a level's bounds
#define TL_NAV_MAX_COLUMNS (1u << 30) ///< width * height of one tile, border included
#define TL_NAV_MAX_SIDE    (1u << 24) ///< columns along one side of a tile, border included
#define TL_NAV_MAX_LATTICE (1u << 29) ///< columns along one side of the whole level
#define TL_NAV_MAX_VOXELS  0x7fffu    ///< walkable_height, walkable_climb, walkable_radius
/// Places of a grid of tiles: tiles_x * tiles_z. Up to TL_NAV_MAX_TILES of them may hold triangles; memory and time
/// follow those, not the ground between them.
#define TL_NAV_MAX_PLACES (1u << 31)

/// The number of tiles along x and z of a level. Both 1 when def->tile_size is 0. Errors as tl_nav_config_from_def.
TL_API tl_result tl_nav_tile_grid(const tl_nav_def *def, tl_aabb level_bounds, uint32_t *tiles_x_out,
                                  uint32_t *tiles_z_out, tl_report *report_out);

/// Metres to voxels, for the tile (tile_x, tile_z). TL_ERR_ARGUMENT names the def's field in
/// report_out->field and says in ->advice what to use instead; TL_ERR_EMPTY: both bounds are empty; TL_ERR_LIMIT
/// when the lattice would be too large; TL_ERR_RANGE when bounds are beyond TL_MAX_COORDINATE, or so far out that
/// neighbouring floats are no finer than the cells (0.3 m: from 4,194 km on).
TL_API tl_result tl_nav_config_from_def(const tl_nav_def *def, tl_aabb level_bounds, uint32_t tile_x, uint32_t tile_z,
                                        tl_nav_config *config_out, tl_report *report_out);

// ---------------------------------------------------------------------------------------------------------
// Heightfield: the solid space of each column (rcHeightfield).

/// A solid part of one column (rcSpan): it fills [min, max), voxels above the lattice's origin, min < max.
typedef struct tl_nav_span {
    uint16_t min;
    uint16_t max;
    uint16_t area; ///< of its top surface; TL_NAV_NULL_AREA: not walkable
    uint16_t reserved;
} tl_nav_span;

/// Spans column by column, row-major (x fastest), bottom to top within a column; spans of a column neither touch nor
/// overlap.
typedef struct tl_nav_heightfield {
    uint32_t width, height;
    tl_nav_lattice lattice;
    tl_aabb bounds;
    float cell_size, cell_height;
    uint32_t *first_span; ///< [width * height + 1]
    tl_nav_span *spans;   ///< [span_count]
    uint32_t span_count;
    tl_allocator allocator; ///< private: what gives the memory back
} tl_nav_heightfield;

/// Voxelizes triangles conservatively and merges their spans. Triangle i gets areas[i] (NULL: TL_NAV_WALKABLE_AREA)
/// where it is less steep than the agent's limit, else TL_NAV_NULL_AREA. Triangles outside the bounds are clipped. The
/// result does not depend on the order of the triangles. Errors: TL_ERR_LIMIT, TL_ERR_MEMORY, TL_ERR_CANCELLED.
TL_API tl_result tl_nav_rasterize(const tl_nav_config *config, const tl_mesh_view *mesh, const uint8_t *areas,
                                  const tl_host *host, tl_nav_heightfield *heightfield_out, tl_report *report_out);
TL_API void tl_nav_heightfield_free(tl_nav_heightfield *heightfield);

/// A span that is not walkable but at most walkable_climb above a walkable one below it becomes walkable (kerbs,
/// stairs).
TL_API void tl_nav_filter_low_hanging_obstacles(const tl_nav_config *config, tl_nav_heightfield *heightfield);
/// A span beside a drop of more than walkable_climb, or on too steep a staircase of neighbours, is not walkable.
TL_API void tl_nav_filter_ledge_spans(const tl_nav_config *config, tl_nav_heightfield *heightfield);
/// A span with less than walkable_height of free space above is not walkable.
TL_API void tl_nav_filter_walkable_low_height_spans(const tl_nav_config *config, tl_nav_heightfield *heightfield);

// ---------------------------------------------------------------------------------------------------------
// Compact heightfield: the floors above walkable spans, and which lies beside which (rcCompactHeightfield).

#define TL_NAV_NO_SPAN       UINT32_MAX
#define TL_NAV_BORDER_REGION 0x80000000u ///< flag of the regions that fill a tile's border

/// What tl_nav_bake_regions did besides dividing. A walkable floor without a region was on an island that it removed.
typedef struct tl_nav_region_stats {
    uint32_t split;            ///< regions that overlapped themselves in the plane and were divided
    uint32_t merged;           ///< regions that became part of a neighbour
    uint32_t filtered_regions; ///< regions removed with their island of fewer than min_region_area columns
    uint32_t filtered_spans;   ///< floors of these
} tl_nav_region_stats;

/// Neighbours are mutual: the span beside in direction d has this one in direction d ^ 2.
/// Direction d steps (dx, dz): 0 (-1, 0), 1 (0, +1), 2 (+1, 0), 3 (0, -1).
typedef struct tl_nav_compact {
    uint32_t width, height;
    uint32_t border_size;
    uint32_t walkable_height, walkable_climb; ///< voxels, as the neighbours were found with
    tl_nav_lattice lattice;
    tl_aabb bounds;
    float cell_size, cell_height;
    uint32_t span_count;
    uint32_t *first_span; ///< [width * height + 1]: column c holds spans [first_span[c], first_span[c + 1])
    uint16_t *floor;      ///< [span_count] voxels: where an agent stands
    uint16_t *clearance;  ///< [span_count] voxels of free height above the floor, clamped to 0xffff
    uint8_t *area;        ///< [span_count]
    int16_t *step;        ///< [4 * span_count]: from a span to its neighbour in each direction, 0: none. Read it
                          ///< by tl_nav_compact_neighbour
    uint32_t *neighbour;  ///< instead of `step`, where 16 bits do not reach: the neighbour or TL_NAV_NO_SPAN. Else NULL
    uint16_t
        *distance; ///< [span_count] twice the distance to the border in columns; after tl_nav_distance_field, else NULL
    uint16_t max_distance; ///< no distance is larger
    uint32_t *region;      ///< [span_count] 0: none; after tl_nav_bake_regions, else NULL
    uint32_t region_count; ///< largest region id + 1
    tl_nav_region_stats region_stats;
    /// [span_count], the caller's, or NULL (the default): 1 for floors that were made not walkable after the erosion,
    /// with a distance of their own. Simplified outlines near these do not come nearer than the traced ones.
    const uint8_t *taken;
    tl_allocator allocator; ///< private: what gives the memory back
} tl_nav_compact;

/// The neighbour of a span in a direction, or TL_NAV_NO_SPAN.
static inline uint32_t tl_nav_compact_neighbour(const tl_nav_compact *compact, uint32_t span, uint32_t direction)
{
    const size_t link = 4 * (size_t)span + direction;
    if (compact->step == NULL) {
        return compact->neighbour[link];
    }
    const int32_t step = compact->step[link];
    return step != 0 ? span + (uint32_t)step : TL_NAV_NO_SPAN;
}

TL_API tl_result tl_nav_bake_compact(const tl_nav_config *config, const tl_nav_heightfield *heightfield,
                                     const tl_host *host, tl_nav_compact *compact_out, tl_report *report_out);
/// The filters that `config` asks for and tl_nav_bake_compact in one pass, without a change of the heightfield: the
/// same result as one after the other, faster.
TL_API tl_result tl_nav_filter_and_compact(const tl_nav_config *config, const tl_nav_heightfield *heightfield,
                                           const tl_host *host, tl_nav_compact *compact_out, tl_report *report_out);
TL_API void tl_nav_compact_free(tl_nav_compact *compact);

/// Makes floors nearer than walkable_radius columns to a wall or ledge not walkable. Errors: TL_ERR_MEMORY,
/// TL_ERR_CANCELLED.
TL_API tl_result tl_nav_erode(const tl_nav_config *config, const tl_host *host, tl_nav_compact *compact,
                              tl_report *report_out);

/// Gives the walkable floors inside a box an area; TL_NAV_NULL_AREA makes a hole. A floor is inside when the centre of
/// its column is, and its height lies in [min.y, max.y].
TL_API void tl_nav_mark_box_area(tl_nav_compact *compact, tl_aabb box, uint8_t area);
/// The same for a prism over `points`: a simple polygon on xz (y is ignored), either winding, convex or not; count
/// >= 3.
TL_API void tl_nav_mark_polygon_area(tl_nav_compact *compact, const tl_vec3 *points, uint32_t count, float min_y,
                                     float max_y, uint8_t area);
/// The same for an upright cylinder that stands on `base`.
TL_API void tl_nav_mark_cylinder_area(tl_nav_compact *compact, tl_vec3 base, float radius, float height, uint8_t area);

/// The distance field: of each floor to the nearest border of its area, box-blurred for the watershed. Fills
/// compact->distance. Errors: TL_ERR_MEMORY, TL_ERR_CANCELLED.
TL_API tl_result tl_nav_distance_field(const tl_host *host, tl_nav_compact *compact, tl_report *report_out);

/// Divides the floors into regions by config->partition, removes small islands and merges small regions. Fills
/// compact->region. Errors: TL_ERR_ARGUMENT (watershed without a distance field), TL_ERR_CORRUPT (neighbours are not
/// mutual), TL_ERR_LIMIT, TL_ERR_MEMORY, TL_ERR_CANCELLED.
TL_API tl_result tl_nav_bake_regions(const tl_nav_config *config, const tl_host *host, tl_nav_compact *compact,
                                     tl_report *report_out);

// ---------------------------------------------------------------------------------------------------------
// Contours and detail.

/// Contours that own their arrays; `set` is the view that polygon.h takes. `raw` holds each contour before
/// simplification.
typedef struct tl_nav_contours {
    tl_contour_set set;
    /// The traced outlines, for drawing and checks. Its first set.contour_count contours are those of set, in the same
    /// order, before simplification and without their holes. Holes follow, then what has no area.
    tl_contour_set raw;
    uint32_t hole_count;      ///< traced outlines of holes
    uint32_t unbridged_count; ///< holes left out of set, because no bridge to their outline was found
    uint32_t slit_count; ///< traced outlines without area, between floors of one region that are not linked; left out
    uint32_t repaired_count; ///< outlines that got vertices back, since their simplified form collapsed or crossed
    tl_allocator allocator;  ///< private, as all below: one block holds all arrays
    void *block;
    size_t block_size;
} tl_nav_contours;

/// Traces each region's outline, simplifies it within max_simplification_error and max_edge_len, and bridges holes.
///
/// The origin of the set is the tile without its border. An edge between two regions has the same vertices on xz in
/// both. Simplified outlines of a region neither cross themselves nor one another, and none with area is lost. The low
/// 16 bits of a vertex's flags hold 0 for a wall, and for other edges a number in 1 .. 0x7fff made from the region
/// across (for regions up to 0x7fff its id), | 0x8000 on the tile's border; for information only.
/// Needs regions (TL_ERR_ARGUMENT). Errors: TL_ERR_CORRUPT (neighbours are not mutual), TL_ERR_LIMIT, TL_ERR_MEMORY,
/// TL_ERR_CANCELLED. On failure contours_out is zeroed.
TL_API tl_result tl_nav_bake_contours(const tl_nav_config *config, const tl_nav_compact *compact, const tl_host *host,
                                      tl_nav_contours *contours_out, tl_report *report_out);
TL_API void tl_nav_contours_free(tl_nav_contours *contours);

/// The detail mesh: heights inside the polygons, sampled from the floors (tl_nav_detail is in nav_tile.h).
///
/// Each patch is a Delaunay triangulation of its polygon, in the polygon's winding. Its vertices are the polygon's
/// corners in order, then samples on edges, then inner ones; a height is that of a floor of the polygon's region, or of
/// one that links to it. Linked polygons have the same vertices on their common edge. No sample (edges: at most
/// detail_sample_dist apart; inside: at column centres, half of it from the edges) is farther than
/// detail_sample_max_error above or below the surface, but in patches that `limited_patches` counts.
/// `polygons` comes from contours of `compact`. Errors: TL_ERR_ARGUMENT (no regions), TL_ERR_LIMIT (a polygon more than
/// 2^20 columns wide), TL_ERR_MEMORY, TL_ERR_CANCELLED. On failure detail_out is zeroed.
TL_API tl_result tl_nav_bake_detail(const tl_nav_config *config, const tl_nav_compact *compact,
                                    const tl_polygon_mesh *polygons, const tl_host *host, tl_nav_detail *detail_out,
                                    tl_report *report_out);

// ---------------------------------------------------------------------------------------------------------
// The whole pipeline.

/// A volume that gives floors an area before regions are made.
typedef enum tl_nav_volume_kind { TL_NAV_VOLUME_BOX, TL_NAV_VOLUME_POLYGON, TL_NAV_VOLUME_CYLINDER } tl_nav_volume_kind;

typedef struct tl_nav_volume {
    tl_nav_volume_kind kind;
    uint8_t area;
    tl_aabb box;           ///< BOX; for POLYGON its y range
    const tl_vec3 *points; ///< POLYGON
    uint32_t point_count;  ///< POLYGON
    tl_vec3 base;          ///< CYLINDER
    float radius, height;  ///< CYLINDER
} tl_nav_volume;

/// tl_nav_mark_box_area, tl_nav_mark_polygon_area or tl_nav_mark_cylinder_area, by kind.
TL_API void tl_nav_mark_volume_area(tl_nav_compact *compact, const tl_nav_volume *volume);

/// What is baked. Nothing is kept or owned.
typedef struct tl_nav_input {
    tl_mesh_view mesh;
    const uint8_t *areas; ///< one a triangle, or NULL: all TL_NAV_WALKABLE_AREA
    const tl_nav_volume *volumes;
    uint32_t volume_count;
} tl_nav_input;

/// Fills tl_nav_input.areas of a mesh from its materials: areas_out[i] is material_areas[material of triangle i], and
/// TL_NAV_WALKABLE_AREA where that has no entry. `areas_out` has room for mesh->triangle_count.
TL_API void tl_nav_areas_from_materials(const tl_mesh_view *mesh, const uint8_t *material_areas,
                                        uint32_t material_count, uint8_t *areas_out);

/// The intermediate data of one tile, kept for drawing and debugging. Zero before the call; free with
/// tl_nav_stages_free.
typedef struct tl_nav_stages {
    tl_nav_heightfield heightfield; ///< after the filters
    tl_nav_compact compact;         ///< after erosion, areas, distance, regions
    tl_nav_contours contours;
    tl_polygon_mesh polygons;
    tl_nav_detail detail;
} tl_nav_stages;

TL_API void tl_nav_stages_free(tl_nav_stages *stages);

/// Counts of a bake, summed over its tiles.
typedef struct tl_nav_bake_report {
    tl_report base;
    uint64_t span_count;         ///< solid spans after rasterization
    uint64_t compact_span_count; ///< open floors
    uint32_t region_count;
    uint32_t filtered_regions; ///< removed islands' regions (region_min_size)
    uint64_t filtered_spans;   ///< floors of these
    double filtered_area;      ///< square metres of these floors
    uint32_t contour_count;
    uint32_t unbridged_holes; ///< holes that became floor (tl_nav_contours.unbridged_count)
    uint32_t slit_outlines;   ///< outlines without area, left out (tl_nav_contours.slit_count)
    uint32_t
        repaired_contours; ///< outlines that could not be simplified or triangulated as they were, and were repaired
    uint32_t polygon_count;
    uint32_t vertex_count;
    uint32_t detail_triangle_count;
    uint32_t limited_patches; ///< of the detail mesh, with errors above the limit (tl_nav_detail.limited_patches)
    uint32_t tile_count;      ///< tiles with at least one polygon
} tl_nav_bake_report;

/// The layer of each polygon of a place: the one that holds most of its region's area. So a storey stays whole,
/// together with the stairs of its region. A polygon of several regions is assigned by itself. Layer k begins at k *
/// layer_height voxels above the origin; a polygon's height is the mean of its corners. `layers_out` has
/// polygons->polygon_count entries, all 0 when layer_height is 0. Errors: TL_ERR_MEMORY.
TL_API tl_result tl_nav_assign_layers(const tl_nav_config *config, const tl_polygon_mesh *polygons,
                                      const tl_allocator *allocator, uint32_t *layers_out, tl_report *report_out);

/// All stages for one place, as one tile: layer_height is ignored (tl_nav_tile_divide divides the tile). `*tile_out` is
/// NULL with TL_OK when nothing in it is walkable.
/// `stages_out` NULL: intermediate data is freed as soon as its last reader is done.
TL_API tl_result tl_nav_tile_bake(const tl_nav_config *config, const tl_nav_input *input, const tl_host *host,
                                  tl_nav_stages *stages_out, tl_nav_tile **tile_out, tl_nav_bake_report *report_out);

/// The stages from the distance field to the tile, on a compact heightfield whose areas are final: eroded and marked.
/// Its `distance` and `region` are used as scratch and are NULL afterwards; nothing else of it changes. For temporary
/// obstacles, which need no look at the triangles. `*stack_out`: the tile, or its layers; empty where nothing is
/// walkable.
TL_API tl_result tl_nav_tile_bake_from_compact(const tl_nav_config *config, tl_nav_compact *compact,
                                               const tl_host *host, tl_nav_tile_stack *stack_out,
                                               tl_nav_bake_report *report_out);

/// What a tile that is rebaked often keeps between two rebakes: the distance field of the floors without obstacles.
/// With watershed regions 6 bytes a floor, else next to nothing.
typedef struct tl_nav_tile_memo tl_nav_tile_memo;

/// tl_nav_tile_bake_from_compact, the same bytes, but faster where few floors have another area than in `base_area`
/// [span_count]. `*memo` is NULL at first; it is created when a floor differs, from the host's allocator, and stays
/// valid as long as the floors and `base_area` do not change. On failure it is as it was.
TL_API tl_result tl_nav_tile_rebake(const tl_nav_config *config, tl_nav_compact *compact, const uint8_t *base_area,
                                    tl_nav_tile_memo **memo, const tl_host *host, tl_nav_tile_stack *stack_out,
                                    tl_nav_bake_report *report_out);
/// Whether a tile keeps its bytes when the floors' areas change from `area_before` [span_count] to the compact
/// heightfield's: where only its border's outer columns change, and no wall is near. That takes a few microseconds and
/// saves a rebake. false: not known; so with watershed regions, unless no area changes. The links are read too.
/// Programmer errors assert.
TL_API bool tl_nav_tile_keeps_bytes(const tl_nav_config *config, const tl_nav_compact *compact,
                                    const uint8_t *area_before);
TL_API void tl_nav_tile_memo_free(tl_nav_tile_memo *memo);
TL_API uint64_t tl_nav_tile_memo_bytes(const tl_nav_tile_memo *memo);

/// All tiles of a level, in parallel where def->host has tasks; the same bytes for any number of workers.
typedef struct tl_nav_tiles {
    tl_nav_tile **tiles; ///< only those that hold polygons, row-major by (tile_z, tile_x), of a place by rising layer
    uint32_t tile_count;
    uint32_t tiles_x, tiles_z;
    tl_allocator allocator; ///< private: what gives the memory back
} tl_nav_tiles;

TL_API tl_result tl_nav_bake(const tl_nav_def *def, const tl_nav_input *input, tl_nav_tiles *tiles_out,
                             tl_nav_bake_report *report_out);
TL_API void tl_nav_tiles_free(tl_nav_tiles *tiles);

// ---------------------------------------------------------------------------------------------------------
// A part of the tiles: levels that change.

/// The tiles [x, x + count_x) by [z, z + count_z) of the grid.
typedef struct tl_nav_tile_range {
    uint32_t x, z, count_x, count_z;
} tl_nav_tile_range;

/// The tiles that a change inside `box` can touch: those whose columns, border included, meet it. Empty (counts 0)
/// where the box lies outside the level. `level_bounds`: def->bounds where they are given, else those of the mesh.
/// `box` must have min <= max (TL_ERR_ARGUMENT). Errors else as tl_nav_tile_grid.
TL_API tl_result tl_nav_tiles_in_box(const tl_nav_def *def, tl_aabb level_bounds, tl_aabb box,
                                     tl_nav_tile_range *range_out, tl_report *report_out);

/// Receives each tile's intermediate data, on the thread that baked it; tiles without triangles are left out. It owns
/// what it takes out of `stages` and zeroes there; that comes from def->host.allocator.
typedef struct tl_nav_stage_sink {
    void (*take)(const tl_nav_config *config, tl_nav_stages *stages, void *user);
    void *user;
} tl_nav_stage_sink;

/// The tiles of a range.
typedef struct tl_nav_tile_block {
    tl_nav_tile_range range;
    tl_nav_tile_stack *stacks; ///< [range.count_x * range.count_z] by place, row-major; empty where nothing is walkable
    tl_allocator allocator;    ///< private: what gives the memory back
} tl_nav_tile_block;

/// Bakes a range of tiles: the same bytes as in tl_nav_bake of the whole. `sink` may be NULL. A caller whose mesh
/// changes gives def->bounds, so that the lattice stays where it is. TL_ERR_ARGUMENT: a range beyond the grid;
/// TL_ERR_LIMIT: one of more than TL_NAV_MAX_TILES places.
TL_API tl_result tl_nav_bake_range(const tl_nav_def *def, const tl_nav_input *input, tl_nav_tile_range range,
                                   const tl_nav_stage_sink *sink, tl_nav_tile_block *block_out,
                                   tl_nav_bake_report *report_out);

/// Rebakes the tiles that a change inside `changed` can have touched (a box around both the old and the new geometry):
/// the same bytes as a bake of the whole level. def->bounds must be given (TL_ERR_ARGUMENT), and the same as when the
/// other tiles were baked. Hand each stack of the block to tl_navmesh_replace_tiles.
TL_API tl_result tl_nav_rebake(const tl_nav_def *def, const tl_nav_input *input, tl_aabb changed,
                               tl_nav_tile_block *block_out, tl_nav_bake_report *report_out);
TL_API void tl_nav_tile_block_free(tl_nav_tile_block *block);

/// The triangles of a level by place, for levels of so many triangles that a pass over all of them at each rebake takes
/// long: 4 ms a million. It is made once, told of changes, and asked for what a rebake can read:
///
///   tl_nav_triangles_create(&def, &input.mesh, &triangles, NULL);
///   tl_nav_triangles_change(triangles, &input.mesh, moved, moved_count, NULL);
///   tl_nav_triangles_near(triangles, &input, changed, &near, NULL);
///   tl_nav_rebake(&def, &near.input, changed, &block, NULL);   or tl_nav_obstacles_rebake
///
/// Used by one thread at a time.
typedef struct tl_nav_triangles tl_nav_triangles;

/// The same rebake's input with fewer triangles, in the triangles' memory until they are asked or told again.
typedef struct tl_nav_near_triangles {
    tl_nav_input input;      ///< the vertices and volumes that were given
    const uint32_t *sources; ///< [input.mesh.triangle_count] triangles of the whole mesh, ascending
} tl_nav_near_triangles;

/// Sorts the triangles of a mesh into the tiles of a def, whose bounds must be given (TL_ERR_ARGUMENT). One that
/// reaches over more than 64 tiles is near everywhere. Keeps the mesh's indices no longer than the call, and some 5
/// bytes a triangle. TL_ERR_MEMORY, errors of tl_nav_tile_grid; then `*triangles_out` is NULL. `def` NULL: defaults.
TL_API tl_result tl_nav_triangles_create(const tl_nav_def *def, const tl_mesh_view *mesh,
                                         tl_nav_triangles **triangles_out, tl_report *report_out);
TL_API void tl_nav_triangles_destroy(tl_nav_triangles *triangles);

/// To be told of all triangles that have other corners, or other places of their corners, than before, and of new ones,
/// at the end. `mesh`: as it is now; triangles beyond its end are there no more. Those that were told of are looked at
/// one by one from then on, until they are a quarter of all and all are sorted again. TL_ERR_INDEX names a place in
/// `changed` that is no triangle; TL_ERR_MEMORY: nothing is changed.
TL_API tl_result tl_nav_triangles_change(tl_nav_triangles *triangles, const tl_mesh_view *mesh, const uint32_t *changed,
                                         uint32_t changed_count, tl_report *report_out);

/// The part of an input that tl_nav_rebake with the same def can read for a change inside `changed`; a rebake of it has
/// the same bytes, and names triangles by their places in `sources`. The input's mesh is the one of the last change
/// (TL_ERR_ARGUMENT: it has another number of triangles). Time: of the triangles in the tiles around. TL_ERR_MEMORY,
/// errors of tl_nav_tiles_in_box; then `*near_out` is zeroed.
TL_API tl_result tl_nav_triangles_near(tl_nav_triangles *triangles, const tl_nav_input *input, tl_aabb changed,
                                       tl_nav_near_triangles *near_out, tl_report *report_out);
TL_API uint64_t tl_nav_triangles_bytes(const tl_nav_triangles *triangles);

#ifdef __cplusplus
}
#endif

#endif
