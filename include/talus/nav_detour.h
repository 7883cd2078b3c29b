// SPDX-License-Identifier: MIT
//
// Navmesh tiles to and from the format of Detour (Recast Navigation), so that a game can move in either direction, step
// by step.
//
// A tile is the data of dtNavMesh::addTile (version 7); a set is the file that RecastDemo saves ("MSET", version 1):
// the parameters of dtNavMesh::init and all tiles. Both with references of 32 bits or of 64 (DT_POLYREF64), which is
// how Detour was compiled. Bytes are written little-endian on every machine; both byte orders are read.

#ifndef TALUS_NAV_DETOUR_H
#define TALUS_NAV_DETOUR_H

#include <talus/nav_tile.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TL_DETOUR_MAX_CORNERS  6      ///< of a polygon
#define TL_DETOUR_MAX_POLYGONS 0x7ffe ///< of a tile
#define TL_DETOUR_MAX_VERTICES 0xfffe ///< of a tile
#define TL_DETOUR_MAX_AREA     63     ///< six bits; also Recast's walkable area

typedef enum tl_detour_refs {
    TL_DETOUR_REFS_32, ///< Detour as it comes
    TL_DETOUR_REFS_64, ///< compiled with DT_POLYREF64
} tl_detour_refs;

/// What a conversion found. `base` names the element of a failure.
typedef struct tl_detour_report {
    tl_report base;
    uint32_t tile_count;
    uint32_t polygon_count;
    uint32_t plain_patches;    ///< writing: polygons whose height detail is beyond Detour's 255 vertices or triangles a
                               ///< polygon; written with the surface of their corners. Reading: with unusable detail
    uint32_t dropped_polygons; ///< reading: without area or not convex once on the lattice; left out, their links walls
    uint32_t one_way_links;    ///< reading: links to a polygon that does not link back; made walls
    uint32_t off_mesh_links;   ///< reading: off-mesh connections, which tiles do not keep: tl_detour_read_off_mesh.
                               ///< Writing: those that were written
    uint32_t off_mesh_outside; ///< writing: links left out, since they start in no tile
    uint32_t off_mesh_far;     ///< writing: links that lead farther than into the next tile, or out of all tiles; they
                               ///< are written, but Detour does not connect them
    uint32_t area_zeros;       ///< reading: polygons of area 0, which became Recast's walkable area
} tl_detour_report;

/// Bytes of a tile, or of a set of tiles, in Detour's format; 0 when it cannot be written (writing says why).
TL_API uint64_t tl_detour_tile_size(const tl_nav_tile *tile, tl_detour_refs refs);
TL_API uint64_t tl_detour_set_size(const tl_nav_tile *const *tiles, uint32_t tile_count, tl_detour_refs refs);

/// Writes one tile into `bytes` of at least tl_detour_tile_size: what dtNavMesh::addTile takes, and init when the tile
/// is the whole navmesh. Polygon i of the tile is polygon i there. Nothing is allocated.
///
/// TL_INCOMPLETE: `capacity` is less than tl_detour_tile_size. TL_ERR_LIMIT names the polygon: more than 6 corners,
/// flags above the lowest 16, an area above 63; or the tile: more polygons, vertices or cells than 16 bits count.
TL_API tl_result tl_detour_tile_write(const tl_nav_tile *tile, tl_detour_refs refs, void *bytes, uint64_t capacity,
                                      tl_detour_report *report_out);

/// Writes the tiles of one navmesh as a set, no two of one place. All have the same origin, cells and tile size
/// (TL_ERR_ARGUMENT). With 32 bits, tiles and polygons a tile must fit 22 bits together, as Detour asks (TL_ERR_LIMIT).
TL_API tl_result tl_detour_set_write(const tl_nav_tile *const *tiles, uint32_t tile_count, tl_detour_refs refs,
                                     void *bytes, uint64_t capacity, tl_detour_report *report_out);

/// Tiles that were read. Free with tl_detour_tiles_free.
typedef struct tl_detour_tiles {
    tl_nav_tile **tiles;
    uint32_t tile_count;
    tl_allocator allocator; ///< private: what gives the memory back
} tl_detour_tiles;

typedef struct tl_detour_read_def {
    /// Metres a lattice step of height, >= TL_NAV_MIN_CELL. Detour's tiles do not keep their cell height, so the
    /// corners' heights are rounded to this. Default 1/1024, which no agent notices.
    float cell_height;
    const tl_allocator *allocator; ///< NULL: malloc
    uint32_t cookie;               ///< TL_DEF_COOKIE, by tl_default_detour_read_def
} tl_detour_read_def;

TL_API tl_detour_read_def tl_default_detour_read_def(void);

/// Reads a set, or a single tile, which is then the whole navmesh. Safe on any bytes. `def` NULL: defaults.
///
/// The corners must lie on a lattice, whose cell size follows from the tile's quantization factor, as in all tiles that
/// Recast makes (else TL_ERR_RANGE names the vertex). Layers at one place are read; the links between them across edges
/// inside a tile become walls. Errors: TL_ERR_MAGIC, TL_ERR_VERSION, TL_ERR_TRUNCATED, TL_ERR_CORRUPT (a
/// count or an index is wrong), TL_ERR_EMPTY (no polygon left), TL_ERR_NOT_FINITE, TL_ERR_RANGE, TL_ERR_LIMIT (a layer
/// above 65,535), TL_ERR_MEMORY. `tiles_out` is zeroed unless TL_OK.
TL_API tl_result tl_detour_read(const void *bytes, uint64_t size, const tl_detour_read_def *def,
                                tl_detour_tiles *tiles_out, tl_detour_report *report_out);
TL_API void tl_detour_tiles_free(tl_detour_tiles *tiles);

/// An off-mesh connection, with what tl_navmesh_add_offmesh (nav_query.h) takes.
typedef struct tl_detour_off_mesh {
    tl_vec3 start, end;
    float radius;
    uint32_t user_id;
    uint16_t flags;
    uint8_t area;
    bool both_ways;
} tl_detour_off_mesh;

/// Reads the off-mesh connections of a set or a single tile, in order. Safe on any bytes; nothing is
/// allocated, but for bytes of the other byte order a copy (TL_ERR_MEMORY).
///
/// Writes the first `capacity`; `*count_out` is the true count, TL_INCOMPLETE when that is more. TL_ERR_CORRUPT,
/// TL_ERR_NOT_FINITE name the connection; TL_ERR_MAGIC, TL_ERR_VERSION, TL_ERR_TRUNCATED and others as tl_detour_read.
TL_API tl_result tl_detour_read_off_mesh(const void *bytes, uint64_t size, tl_detour_off_mesh *links_out,
                                         uint32_t capacity, uint32_t *count_out, tl_detour_report *report_out);

/// A navmesh to be written with its off-mesh links.
typedef struct tl_detour_set {
    const tl_nav_tile *const *tiles;
    uint32_t tile_count;
    /// `flags` and `area` (0 to 63) become those of the connection's polygon. `radius` > 0 is how far from an end
    /// Detour looks for a polygon.
    const tl_detour_off_mesh *off_mesh; ///< may be NULL when off_mesh_count is 0
    uint32_t off_mesh_count;
    tl_detour_refs refs;
} tl_detour_set;

/// As tl_detour_set_size and tl_detour_set_write, with off-mesh links: each stands in the tile that its start lies in
/// (of layers over one another the one nearest in height), with a polygon behind the tile's own. TL_ERR_ARGUMENT,
/// TL_ERR_NOT_FINITE and TL_ERR_LIMIT name the "off_mesh"; what Detour cannot connect is counted. O(tiles * links).
TL_API uint64_t tl_detour_linked_set_size(const tl_detour_set *set);
TL_API tl_result tl_detour_linked_set_write(const tl_detour_set *set, void *bytes, uint64_t capacity,
                                            tl_detour_report *report_out);

#ifdef __cplusplus
}
#endif

#endif
