// SPDX-License-Identifier: MIT
//
// Small navmeshes for tests: a grid of cells, open or not, on one or two floors, cut into tiles, its vertices shaken so
// that nothing lines up. Quads where they stay convex, triangles elsewhere.

#ifndef TALUS_NAV_FIXTURE_H
#define TALUS_NAV_FIXTURE_H

#include "talus_test.h"

#include <math.h>
#include <string.h>
#include <talus/nav_query.h>

enum { FIXTURE_STEP = 16, FIXTURE_FLOOR_HEIGHT = 20, FIXTURE_MAX_CELLS = 64 };

/// One character a cell, rows along z: '#' closed, '.' both floors open, '0' and '1' one floor, 'r' a ramp that
/// climbs from floor 0 on its x- side to floor 1 on its x+ side.
typedef struct fixture_level {
    uint32_t width, height; ///< cells
    char cells[FIXTURE_MAX_CELLS][FIXTURE_MAX_CELLS];
    uint32_t tile_cells; ///< 0: one tile
    int32_t shake;       ///< lattice units, at most FIXTURE_STEP / 4
    int32_t slope;       ///< lattice heights a cell along x
    int32_t lean;        ///< lattice units along z a cell along x, >= 0; in one tile only
    uint64_t seed;
    bool triangles; ///< split some quads
    bool detail;    ///< with a bump in the middle of each polygon
    float cell_size, cell_height;
    tl_vec3 origin;
    uint32_t area_count; ///< areas 1 to this, by cell; 0: all TL_NAV_MAX_AREA
} fixture_level;

static inline fixture_level fixture_make(const char *const *rows, uint32_t row_count)
{
    fixture_level level;
    memset(&level, 0, sizeof level);
    level.height = row_count;
    level.width = (uint32_t)strlen(rows[0]);
    for (uint32_t z = 0; z < row_count; z++) {
        memcpy(level.cells[z], rows[z], level.width);
    }
    level.cell_size = 0.25f;
    level.cell_height = 0.125f;
    level.seed = 1;
    return level;
}

/// `kind` 0: all open; 1: random holes; 2: comb; 3: spiral; 4: rooms with doors; 5: two floors with ramps.
static inline fixture_level fixture_random(test_random *random, uint32_t kind, uint32_t size)
{
    fixture_level level;
    memset(&level, 0, sizeof level);
    level.width = size;
    level.height = size;
    for (uint32_t z = 0; z < size; z++) {
        for (uint32_t x = 0; x < size; x++) {
            char c = '0';
            if (kind == 1) {
                c = test_random_below(random, 100) < 28 ? '#' : '0';
            } else if (kind == 2) {
                c = z == 0 || x % 2 == 0 ? '0' : '#';
            } else if (kind == 3) {
                uint32_t ring = x < z ? x : z;
                ring = size - 1 - x < ring ? size - 1 - x : ring;
                ring = size - 1 - z < ring ? size - 1 - z : ring;
                c = ring % 2 == 0 || (x == ring && z == ring + 1 && ring > 0) ? '0' : '#';
            } else if (kind == 4) {
                c = (x % 5 == 4 || z % 5 == 4) && test_random_below(random, 100) < 80 ? '#' : '0';
            } else if (kind == 5) {
                uint32_t roll = test_random_below(random, 100);
                c = roll < 12 ? '#' : roll < 30 ? '0' : roll < 45 ? '1' : roll < 52 ? 'r' : '.';
            }
            level.cells[z][x] = c;
        }
    }
    level.shake = (int32_t)test_random_below(random, FIXTURE_STEP / 4 + 1);
    level.slope = (int32_t)test_random_below(random, 5) - 2;
    level.triangles = test_random_below(random, 2) == 0;
    level.detail = test_random_below(random, 2) == 0;
    level.seed = test_random_u64(random);
    level.cell_size = 0.25f;
    level.cell_height = 0.125f;
    level.origin = tl_vec3_make(-7.3f, 1.7f, 11.1f);
    return level;
}

typedef struct fixture_builder {
    const fixture_level *level;
    int32_t tile_x, tile_z;
    uint32_t cells; // a side of the tile
    int32_t *vertices;
    uint32_t *first, *indices, *neighbours, *regions, *areas, *contours;
    uint32_t polygon_count, index_count;
} fixture_builder;

static inline uint64_t fixture_hash(uint64_t a, uint64_t b)
{
    test_random random = { a * 0x9e3779b97f4a7c15u + b };
    return test_random_u64(&random);
}

static inline uint32_t fixture_vertex(const fixture_builder *b, uint32_t floor, uint32_t x, uint32_t z)
{
    uint32_t side = b->cells + 1;
    return (floor * side + z) * side + x;
}

// Border vertices move along their border only, each tile's in its own way.
static inline void fixture_place_vertices(fixture_builder *b)
{
    const fixture_level *level = b->level;
    uint32_t side = b->cells + 1;
    for (uint32_t floor = 0; floor < 2; floor++) {
        for (uint32_t z = 0; z < side; z++) {
            for (uint32_t x = 0; x < side; x++) {
                int32_t gx = b->tile_x * (int32_t)b->cells + (int32_t)x;
                uint64_t place = ((uint64_t)floor << 60) ^ ((uint64_t)(uint32_t)b->tile_x << 40) ^
                                 ((uint64_t)(uint32_t)b->tile_z << 20) ^ (z * side + x);
                uint64_t hash = fixture_hash(level->seed, place);
                int32_t range = 2 * level->shake + 1;
                int32_t dx = (int32_t)(hash % (uint32_t)range) - level->shake;
                int32_t dz = (int32_t)((hash >> 32) % (uint32_t)range) - level->shake;
                bool border_x = x == 0 || x == b->cells;
                bool border_z = z == 0 || z == b->cells;
                int32_t *v = b->vertices + 3 * fixture_vertex(b, floor, x, z);
                v[0] = (int32_t)x * FIXTURE_STEP + (border_x ? 0 : dx);
                v[1] = (int32_t)floor * FIXTURE_FLOOR_HEIGHT + level->slope * gx;
                v[2] = (int32_t)z * FIXTURE_STEP + (border_z ? 0 : dz) + level->lean * (int32_t)x;
            }
        }
    }
}

static inline void fixture_add_polygon(fixture_builder *b, const uint32_t *corners, uint32_t count, uint32_t area)
{
    b->first[b->polygon_count] = b->index_count;
    memcpy(b->indices + b->index_count, corners, count * sizeof *corners);
    b->index_count += count;
    b->areas[b->polygon_count] = area;
    b->polygon_count++;
    b->first[b->polygon_count] = b->index_count;
}

static inline int64_t fixture_area2(const fixture_builder *b, uint32_t i, uint32_t j, uint32_t k)
{
    const int32_t *a = b->vertices + 3 * i, *c = b->vertices + 3 * j, *d = b->vertices + 3 * k;
    return (int64_t)(c[0] - a[0]) * (d[2] - a[2]) - (int64_t)(d[0] - a[0]) * (c[2] - a[2]);
}

// Corners run (x, z), (x, z + 1), (x + 1, z + 1), (x + 1, z): the contours' winding.
static inline void fixture_add_cell(fixture_builder *b, uint32_t x, uint32_t z, uint32_t low_floor, uint32_t high_floor)
{
    const fixture_level *level = b->level;
    uint32_t q[4] = { fixture_vertex(b, low_floor, x, z), fixture_vertex(b, low_floor, x, z + 1),
                      fixture_vertex(b, high_floor, x + 1, z + 1), fixture_vertex(b, high_floor, x + 1, z) };
    uint64_t hash = fixture_hash(level->seed + 77, q[0] * 4096u + q[2]);
    uint32_t area = level->area_count == 0 ? TL_NAV_MAX_AREA : 1 + (uint32_t)(hash >> 40) % level->area_count;
    bool convex = true;
    for (uint32_t i = 0; i < 4; i++) {
        convex = convex && fixture_area2(b, q[i], q[(i + 1) % 4], q[(i + 2) % 4]) < 0;
    }
    if (convex && !(level->triangles && (hash & 3u) == 0)) {
        fixture_add_polygon(b, q, 4, area);
        return;
    }
    // The diagonal whose two triangles both have area.
    uint32_t start = (hash & 4u) != 0 ? 1 : 0;
    if (fixture_area2(b, q[start], q[start + 1], q[start + 2]) >= 0 ||
        fixture_area2(b, q[start], q[start + 2], q[(start + 3) % 4]) >= 0) {
        start = 1 - start;
    }
    uint32_t t1[3] = { q[start], q[start + 1], q[start + 2] };
    uint32_t t2[3] = { q[start], q[start + 2], q[(start + 3) % 4] };
    fixture_add_polygon(b, t1, 3, area);
    fixture_add_polygon(b, t2, 3, area);
}

static inline void fixture_add_cells(fixture_builder *b)
{
    const fixture_level *level = b->level;
    for (uint32_t z = 0; z < b->cells; z++) {
        for (uint32_t x = 0; x < b->cells; x++) {
            uint32_t gx = (uint32_t)b->tile_x * b->cells + x;
            uint32_t gz = (uint32_t)b->tile_z * b->cells + z;
            char c = gx < level->width && gz < level->height ? level->cells[gz][gx] : '#';
            if (c == '0' || c == '.') {
                fixture_add_cell(b, x, z, 0, 0);
            }
            if (c == '1' || c == '.') {
                fixture_add_cell(b, x, z, 1, 1);
            }
            if (c == 'r') {
                fixture_add_cell(b, x, z, 0, 1);
            }
        }
    }
}

static inline uint32_t fixture_next(const fixture_builder *b, uint32_t p, uint32_t k)
{
    return k + 1 < b->first[p + 1] ? k + 1 : b->first[p];
}

// Every edge against every other one: slow and plain.
static inline void fixture_link(fixture_builder *b)
{
    bool tiled = b->level->tile_cells != 0;
    int32_t size = (int32_t)b->cells * FIXTURE_STEP;
    for (uint32_t p = 0; p < b->polygon_count; p++) {
        for (uint32_t k = b->first[p]; k < b->first[p + 1]; k++) {
            uint32_t from = b->indices[k], to = b->indices[fixture_next(b, p, k)];
            const int32_t *a = b->vertices + 3 * from, *c = b->vertices + 3 * to;
            b->neighbours[k] = TL_NO_POLYGON;
            for (uint32_t q = 0; q < b->polygon_count; q++) {
                for (uint32_t j = b->first[q]; j < b->first[q + 1]; j++) {
                    if (b->indices[j] == to && b->indices[fixture_next(b, q, j)] == from) {
                        b->neighbours[k] = q;
                    }
                }
            }
            if (tiled && b->neighbours[k] == TL_NO_POLYGON) {
                if (a[0] == 0 && c[0] == 0) {
                    b->neighbours[k] = TL_PORTAL | 0;
                } else if (a[2] == size && c[2] == size) {
                    b->neighbours[k] = TL_PORTAL | 1;
                } else if (a[0] == size && c[0] == size) {
                    b->neighbours[k] = TL_PORTAL | 2;
                } else if (a[2] == 0 && c[2] == 0) {
                    b->neighbours[k] = TL_PORTAL | 3;
                }
            }
        }
    }
}

/// A polygon mesh that owns its arrays by plain malloc.
typedef struct fixture_mesh {
    tl_polygon_mesh mesh;
    tl_nav_detail detail;
    tl_nav_tile_source source;
} fixture_mesh;

// A fan around a raised middle vertex.
static inline void fixture_make_detail(fixture_mesh *out)
{
    const tl_polygon_mesh *mesh = &out->mesh;
    const tl_nav_tile_source *source = &out->source;
    tl_nav_detail *detail = &out->detail;
    detail->patch_count = mesh->polygon_count;
    detail->patches = calloc(mesh->polygon_count + 1u, sizeof *detail->patches);
    detail->vertices = calloc(mesh->index_count + mesh->polygon_count + 1u, sizeof *detail->vertices);
    detail->triangles = calloc(mesh->index_count + 1u, sizeof *detail->triangles);
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        uint32_t count = mesh->first[p + 1] - mesh->first[p];
        tl_nav_detail_patch patch = { detail->vertex_count, count + 1, detail->triangle_count, count };
        tl_vec3 middle = { 0.0f, 0.0f, 0.0f };
        for (uint32_t i = 0; i < count; i++) {
            const int32_t *v = mesh->vertices + 3 * mesh->indices[mesh->first[p] + i];
            tl_vec3 corner = {
                tl_nav_tile_position(source->origin.x, source->tile_x, source->tile_size, v[0], mesh->cell_size),
                tl_nav_tile_position(source->origin.y, 0, 0, v[1], mesh->cell_height),
                tl_nav_tile_position(source->origin.z, source->tile_z, source->tile_size, v[2], mesh->cell_size)
            };
            detail->vertices[detail->vertex_count++] = corner;
            middle = tl_add(middle, tl_scale(corner, 1.0f / (float)count));
            tl_nav_detail_triangle triangle = { { (uint16_t)i, (uint16_t)((i + 1) % count), (uint16_t)count }, 1 };
            detail->triangles[detail->triangle_count++] = triangle;
        }
        middle.y += 0.1f;
        detail->vertices[detail->vertex_count++] = middle;
        detail->patches[p] = patch;
    }
}

static inline fixture_mesh fixture_build_mesh(const fixture_level *level, int32_t tile_x, int32_t tile_z)
{
    fixture_mesh out;
    memset(&out, 0, sizeof out);
    uint32_t larger = level->width > level->height ? level->width : level->height;
    uint32_t cells = level->tile_cells != 0 ? level->tile_cells : larger;
    uint32_t polygons = 4 * cells * cells;
    fixture_builder b = { level, tile_x, tile_z, cells, NULL, NULL, NULL, NULL, NULL, NULL, NULL, 0, 0 };
    uint32_t vertex_count = 2 * (cells + 1) * (cells + 1);
    b.vertices = calloc(3 * vertex_count, sizeof *b.vertices);
    b.first = calloc(polygons + 1u, sizeof *b.first);
    b.indices = calloc(4 * polygons, sizeof *b.indices);
    b.neighbours = calloc(4 * polygons, sizeof *b.neighbours);
    b.regions = calloc(polygons, sizeof *b.regions);
    b.areas = calloc(polygons, sizeof *b.areas);
    b.contours = calloc(polygons, sizeof *b.contours);
    fixture_place_vertices(&b);
    fixture_add_cells(&b);
    fixture_link(&b);
    out.mesh.vertex_count = vertex_count;
    out.mesh.polygon_count = b.polygon_count;
    out.mesh.index_count = b.index_count;
    out.mesh.vertices = b.vertices;
    out.mesh.first = b.first;
    out.mesh.indices = b.indices;
    out.mesh.neighbours = b.neighbours;
    out.mesh.regions = b.regions;
    out.mesh.areas = b.areas;
    out.mesh.contours = b.contours;
    out.mesh.cell_size = level->cell_size;
    out.mesh.cell_height = level->cell_height;
    out.mesh.max_verts_per_poly = 4;
    uint32_t tile_size = level->tile_cells * FIXTURE_STEP;
    out.mesh.bounds.min = level->origin;
    out.mesh.bounds.min.x = tl_nav_tile_position(level->origin.x, tile_x, tile_size, 0, level->cell_size);
    out.mesh.bounds.min.z = tl_nav_tile_position(level->origin.z, tile_z, tile_size, 0, level->cell_size);
    out.mesh.bounds.max = out.mesh.bounds.min;
    out.source.tile_x = tile_x;
    out.source.tile_z = tile_z;
    out.source.tile_size = tile_size;
    out.source.origin = level->origin;
    out.source.agent_height = 2.0f;
    out.source.agent_radius = 0.5f;
    out.source.agent_max_climb = 0.5f;
    if (level->detail) {
        fixture_make_detail(&out);
    }
    return out;
}

/// The mesh's source, with pointers into it.
static inline tl_nav_tile_source fixture_source(const fixture_mesh *mesh)
{
    tl_nav_tile_source source = mesh->source;
    source.polygons = &mesh->mesh;
    source.detail = mesh->detail.patches != NULL ? &mesh->detail : NULL;
    return source;
}

static inline void fixture_free_mesh(fixture_mesh *mesh)
{
    free(mesh->mesh.vertices);
    free(mesh->mesh.first);
    free(mesh->mesh.indices);
    free(mesh->mesh.neighbours);
    free(mesh->mesh.regions);
    free(mesh->mesh.areas);
    free(mesh->mesh.contours);
    free(mesh->detail.patches);
    free(mesh->detail.vertices);
    free(mesh->detail.triangles);
}

/// NULL when the tile is empty.
static inline tl_nav_tile *fixture_build_tile(const fixture_level *level, int32_t tile_x, int32_t tile_z,
                                              const tl_allocator *allocator)
{
    fixture_mesh mesh = fixture_build_mesh(level, tile_x, tile_z);
    tl_nav_tile *tile = NULL;
    if (mesh.mesh.polygon_count > 0) {
        tl_nav_tile_source source = fixture_source(&mesh);
        tl_report report;
        TEST_RESULT(tl_nav_tile_encode(&source, allocator, &tile, &report), TL_OK);
        TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, &report), TL_OK);
    }
    fixture_free_mesh(&mesh);
    return tile;
}

static inline uint32_t fixture_tiles(uint32_t cells, uint32_t tile_cells)
{
    return tile_cells == 0 ? 1 : (cells + tile_cells - 1) / tile_cells;
}

/// All tiles, owned by the navmesh.
static inline tl_navmesh *fixture_build(const fixture_level *level, const tl_allocator *allocator)
{
    tl_navmesh *navmesh = NULL;
    TEST_RESULT(tl_navmesh_create(allocator, &navmesh), TL_OK);
    for (uint32_t z = 0; z < fixture_tiles(level->height, level->tile_cells); z++) {
        for (uint32_t x = 0; x < fixture_tiles(level->width, level->tile_cells); x++) {
            tl_nav_tile *tile = fixture_build_tile(level, (int32_t)x, (int32_t)z, allocator);
            if (tile != NULL) {
                TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
            }
        }
    }
    return navmesh;
}

/// All polygons of a navmesh, in slot order.
typedef struct fixture_refs {
    tl_nav_ref *refs;
    uint32_t count;
} fixture_refs;

static inline fixture_refs fixture_all_refs(const tl_navmesh *navmesh)
{
    fixture_refs all = { NULL, 0 };
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        all.count += tile != NULL ? tile->polygon_count : 0;
    }
    all.refs = malloc((all.count + 1u) * sizeof *all.refs);
    uint32_t at = 0;
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        for (uint32_t p = 0; tile != NULL && p < tile->polygon_count; p++) {
            all.refs[at++] = tl_navmesh_polygon_ref(navmesh, slot, p);
        }
    }
    return all;
}

static inline uint32_t fixture_index_of(const fixture_refs *all, tl_nav_ref ref)
{
    for (uint32_t i = 0; i < all->count; i++) {
        if (all->refs[i] == ref) {
            return i;
        }
    }
    fail_msg("a reference is not in the navmesh");
    return 0;
}

/// Where a corner is, metres, by its index in the tile's corner arrays.
static inline tl_vec3 fixture_corner(const tl_nav_tile *tile, uint32_t corner)
{
    uint32_t polygon = 0, count = 0;
    while (tl_nav_tile_first_corner(tile, polygon + 1) <= corner) {
        polygon++;
    }
    return tl_nav_tile_corners(tile, polygon, &count)[corner - tl_nav_tile_first_corner(tile, polygon)];
}

static inline bool fixture_same_triangles(const tl_nav_surface *a, const tl_nav_surface *b)
{
    bool same = a->triangle_count == b->triangle_count;
    for (uint32_t i = 0; same && i < a->triangle_count; i++) {
        const tl_nav_detail_triangle s = tl_nav_surface_triangle(a, i), t = tl_nav_surface_triangle(b, i);
        same = memcmp(&s, &t, sizeof s) == 0;
    }
    return same;
}

/// A random point on a random polygon: a random mix of its corners.
static inline tl_nav_location fixture_random_location(const tl_navmesh *navmesh, const fixture_refs *all,
                                                      test_random *random)
{
    tl_nav_location location = { all->refs[test_random_below(random, all->count)], { 0.0f, 0.0f, 0.0f } };
    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0, count = 0;
    TEST_RESULT(tl_navmesh_resolve(navmesh, location.polygon, &tile, &polygon), TL_OK);
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
    float weights[TL_NAV_MAX_CORNERS], sum = 0.0f;
    for (uint32_t i = 0; i < count; i++) {
        weights[i] = 0.01f + test_random_unit(random);
        sum += weights[i];
    }
    for (uint32_t i = 0; i < count; i++) {
        location.point = tl_mul_add(location.point, corners[i], weights[i] / sum);
    }
    tl_vec3 on_surface;
    TEST_RESULT(tl_navmesh_closest_point(navmesh, location.polygon, location.point, &on_surface, NULL), TL_OK);
    location.point = on_surface;
    return location;
}

/// Takes the tile at a place out, or puts it in where there is floor; `present` follows.
static inline void fixture_toggle_tile(const fixture_level *level, tl_navmesh *navmesh, uint32_t x, uint32_t z,
                                       bool *present)
{
    if (*present) {
        TEST_RESULT(tl_navmesh_remove_tile(navmesh, (int32_t)x, (int32_t)z), TL_OK);
        *present = false;
        return;
    }
    tl_nav_tile *tile = fixture_build_tile(level, (int32_t)x, (int32_t)z, NULL);
    if (tile != NULL) {
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
        *present = true;
    }
}

/// Eight cells around a closed one, and what tests of arguments ask them with.
typedef struct fixture_ring {
    tl_navmesh *navmesh;
    tl_nav_query *few_nodes, *many_nodes; ///< 2, 64
    tl_nav_location start;                ///< in the first cell
    tl_nav_location stale, nan;           ///< that a query refuses
} fixture_ring;

static inline fixture_ring fixture_make_ring(void)
{
    const char *const rows[] = { "000", "0#0", "000" };
    fixture_level level = fixture_make(rows, 3);
    tl_nav_query_def def = { 2, NULL, TL_DEF_COOKIE };
    fixture_ring ring;
    memset(&ring, 0, sizeof ring);
    ring.navmesh = fixture_build(&level, NULL);
    TEST_RESULT(tl_nav_query_create(&def, &ring.few_nodes, NULL), TL_OK);
    def.max_nodes = 64;
    TEST_RESULT(tl_nav_query_create(&def, &ring.many_nodes, NULL), TL_OK);
    ring.start.polygon = tl_navmesh_polygon_ref(ring.navmesh, 0, 0);
    ring.start.point = tl_vec3_make(2, 0, 2);
    ring.stale.polygon = 77;
    ring.nan.polygon = ring.start.polygon;
    ring.nan.point.x = NAN;
    return ring;
}

static inline void fixture_free_ring(fixture_ring *ring)
{
    tl_nav_query_destroy(ring->few_nodes);
    tl_nav_query_destroy(ring->many_nodes);
    tl_navmesh_destroy(ring->navmesh);
}

/// Two floors of two cells with a gap of two between them, and a link over it, one way. Free it with
/// tl_navmesh_destroy.
static inline tl_navmesh *fixture_gap(tl_nav_ref *link_out)
{
    const char *const rows[] = { "00##00" };
    fixture_level level = fixture_make(rows, 1);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_offmesh jump = tl_default_nav_offmesh();
    jump.start = tl_vec3_make(7.5f, 0, 2);
    jump.end = tl_vec3_make(16.5f, 0, 2);
    jump.fixed_cost = 3.0f;
    TEST_RESULT(tl_navmesh_add_offmesh(navmesh, &jump, link_out, NULL), TL_OK);
    return navmesh;
}

/// A navmesh of those of a level's tiles x tiles tiles that are present, added in row order.
static inline tl_navmesh *fixture_build_present(const fixture_level *level, uint32_t tiles, const bool *present)
{
    tl_navmesh *navmesh = NULL;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    for (uint32_t i = 0; i < tiles * tiles; i++) {
        if (present[i]) {
            tl_nav_tile *tile = fixture_build_tile(level, (int32_t)(i % tiles), (int32_t)(i / tiles), NULL);
            TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
        }
    }
    return navmesh;
}

static inline tl_nav_query *fixture_query(uint32_t max_nodes)
{
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query = NULL;
    def.max_nodes = max_nodes;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    return query;
}

/// Opens or closes a random cell of the level, and puts its tile into both.
static inline void fixture_change_cell(fixture_level *level, tl_navmesh *const both[2], test_random *random)
{
    const uint32_t x = test_random_below(random, level->width), z = test_random_below(random, level->height);
    const int32_t tile_x = (int32_t)(x / level->tile_cells), tile_z = (int32_t)(z / level->tile_cells);
    level->cells[z][x] = level->cells[z][x] == '#' ? '0' : '#';
    for (int i = 0; i < 2; i++) {
        tl_nav_tile *tile = fixture_build_tile(level, tile_x, tile_z, NULL);
        TEST_CHECK(!tl_is_error(tl_navmesh_remove_tile(both[i], tile_x, tile_z)));
        if (tile != NULL) {
            TEST_RESULT(tl_navmesh_add_tile(both[i], tile, TL_NAV_TILE_OWNED), TL_OK);
        }
    }
}

#endif
