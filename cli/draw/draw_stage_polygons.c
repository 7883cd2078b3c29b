// SPDX-License-Identifier: MIT
//
// Polygon stages: convex polygons with their edges, the detail mesh, the navmesh of a baked file, a route over it.

#include "cli/draw/draw_stage.h"

#include <math.h>
#include <stdio.h>

static const draw_colour WALL_COLOUR = 0x23303f;
static const draw_colour INNER_COLOUR = 0xffffff;

static tl_vec3 lifted_detail(tl_vec3 p, float height)
{
    return tl_vec3_make(p.x, p.y + height, p.z);
}

void draw_stage_polygons(draw_scene *scene, const tl_polygon_mesh *mesh, const char *what)
{
    uint32_t links = 0;
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        uint32_t first = mesh->first[p];
        uint32_t count = mesh->first[p + 1] - first;
        draw_colour colour = draw_colour_of_id(mesh->regions[p] != TL_SEVERAL_REGIONS ? mesh->regions[p] : p + 1);
        // Neighbours of one region differ a little, so that the partition shows under thin edges too.
        colour = draw_colour_mix(colour, 0xffffff, 0.12f * (float)(p % 3));
        tl_vec3 anchor = lifted_detail(tl_polygon_mesh_vertex(mesh, mesh->indices[first]), mesh->cell_height);
        for (uint32_t k = 2; k < count; k++) {
            tl_vec3 b = lifted_detail(tl_polygon_mesh_vertex(mesh, mesh->indices[first + k - 1]), mesh->cell_height);
            tl_vec3 c = lifted_detail(tl_polygon_mesh_vertex(mesh, mesh->indices[first + k]), mesh->cell_height);
            draw_add_triangle(scene, anchor, b, c, colour);
        }
        for (uint32_t k = 0; k < count; k++) {
            tl_vec3 a = lifted_detail(tl_polygon_mesh_vertex(mesh, mesh->indices[first + k]), mesh->cell_height);
            tl_vec3 b =
                lifted_detail(tl_polygon_mesh_vertex(mesh, mesh->indices[first + (k + 1) % count]), mesh->cell_height);
            bool wall = mesh->neighbours[first + k] == TL_NO_POLYGON;
            links += !wall;
            draw_add_line(scene, a, b, wall ? WALL_COLOUR : INNER_COLOUR, wall ? 1.8f : 1.0f, wall ? 0.9f : 0.85f);
        }
    }
    snprintf(scene->subtitle, sizeof scene->subtitle, "%u %s, %u vertices, %u links", mesh->polygon_count, what,
             mesh->vertex_count, links / 2);
    draw_add_legend(scene, draw_colour_of_id(1), "polygon, coloured by region");
    draw_add_legend(scene, WALL_COLOUR, "wall or ledge");
    draw_add_legend(scene, 0xc8c8c8, "edge between neighbours");
}

void draw_stage_detail(draw_scene *scene, const tl_nav_detail *detail)
{
    for (uint32_t p = 0; p < detail->patch_count; p++) {
        const tl_nav_detail_patch *patch = &detail->patches[p];
        const tl_vec3 *vertices = detail->vertices + patch->first_vertex;
        for (uint32_t i = 0; i < patch->triangle_count; i++) {
            const tl_nav_detail_triangle *triangle = &detail->triangles[patch->first_triangle + i];
            const uint16_t *corner = triangle->corner;
            draw_add_triangle(scene, vertices[corner[0]], vertices[corner[1]], vertices[corner[2]],
                              draw_colour_mix(draw_colour_of_id(p + 1), 0xffffff, 0.25f));
            for (uint32_t k = 0; k < 3; k++) {
                bool outline = (triangle->edge_flags >> k & 1u) != 0;
                draw_add_line(scene, vertices[corner[k]], vertices[corner[(k + 1) % 3]],
                              outline ? WALL_COLOUR : INNER_COLOUR, outline ? 1.2f : 0.7f, 0.8f);
            }
        }
    }
    snprintf(scene->subtitle, sizeof scene->subtitle, "%u triangles over %u polygons, %u vertices",
             detail->triangle_count, detail->patch_count, detail->vertex_count);
    draw_add_legend(scene, draw_colour_mix(draw_colour_of_id(1), 0xffffff, 0.25f), "patch of a polygon");
    draw_add_legend(scene, WALL_COLOUR, "its outline");
}

// A polygon's surface as agents walk on it: on hills the flat polygon lies deep in the ground.
static void add_surface(draw_scene *scene, const tl_nav_tile *tile, uint32_t polygon, float lift, draw_colour colour)
{
    const tl_nav_surface surface = tl_nav_tile_surface(tile, polygon);
    for (uint32_t i = 0; i < surface.triangle_count; i++) {
        const tl_nav_detail_triangle triangle = tl_nav_surface_triangle(&surface, i);
        const uint16_t *corner = triangle.corner;
        draw_add_triangle(scene, lifted_detail(surface.vertices[corner[0]], lift),
                          lifted_detail(surface.vertices[corner[1]], lift),
                          lifted_detail(surface.vertices[corner[2]], lift), colour);
    }
}

static float distance_to_edge_sq(tl_vec3 p, tl_vec3 a, tl_vec3 b)
{
    const float ux = b.x - a.x, uz = b.z - a.z, length_sq = ux * ux + uz * uz;
    const float along = length_sq > 0.0f ? ((p.x - a.x) * ux + (p.z - a.z) * uz) / length_sq : 0.0f;
    const float t = along < 0.0f ? 0.0f : along > 1.0f ? 1.0f : along;
    const float dx = p.x - a.x - t * ux, dz = p.z - a.z - t * uz;
    return dx * dx + dz * dz;
}

// The polygon's edge on which a point of its outline lies.
static uint32_t edge_under(const tl_vec3 *corners, uint32_t count, tl_vec3 point)
{
    uint32_t nearest = 0;
    float least = INFINITY;
    for (uint32_t k = 0; k < count; k++) {
        const float distance = distance_to_edge_sq(point, corners[k], corners[(k + 1) % count]);
        nearest = distance < least ? k : nearest;
        least = distance < least ? distance : least;
    }
    return nearest;
}

static void add_tile_polygon(draw_scene *scene, const tl_nav_tile *tile, uint32_t polygon, draw_colour colour)
{
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
    const tl_nav_surface surface = tl_nav_tile_surface(tile, polygon);
    add_surface(scene, tile, polygon, 0.0f, colour);
    for (uint32_t i = 0; i < 3 * surface.triangle_count; i++) {
        const tl_nav_detail_triangle triangle = tl_nav_surface_triangle(&surface, i / 3);
        if ((triangle.edge_flags >> i % 3 & 1u) == 0) {
            continue;
        }
        const tl_vec3 a = surface.vertices[triangle.corner[i % 3]];
        const tl_vec3 b = surface.vertices[triangle.corner[(i + 1) % 3]];
        const uint32_t edge = edge_under(corners, count, tl_lerp(a, b, 0.5f));
        const bool wall = tl_nav_tile_edge_link(tile, polygon, edge) == TL_NAV_LINK_WALL;
        draw_add_line(scene, a, b, wall ? WALL_COLOUR : INNER_COLOUR, wall ? 1.6f : 0.9f, 0.85f);
    }
}

void draw_stage_navmesh(draw_scene *scene, const tl_navmesh *navmesh)
{
    uint32_t polygons = 0;
    double area = 0.0;
    bool used[TL_NAV_MAX_AREA + 1] = { false };
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        if (tile == NULL) {
            continue;
        }
        for (uint32_t p = 0; p < tile->polygon_count; p++) {
            add_tile_polygon(scene, tile, p, draw_colour_of_area(tl_nav_tile_area(tile, p), p % 2));
            used[tl_nav_tile_area(tile, p)] = true;
        }
        polygons += tile->polygon_count;
        area += tile->area;
    }
    snprintf(scene->subtitle, sizeof scene->subtitle, "%u polygons in %u tiles, %.1f square metres", polygons,
             tl_navmesh_tile_count(navmesh), area);
    draw_add_legend(scene, WALL_COLOUR, "wall or ledge");
    draw_add_area_legends(scene, used);
}

void draw_stage_route(draw_scene *scene, const tl_navmesh *navmesh, const tl_nav_route *route,
                      const tl_nav_path_buffers *buffers)
{
    const draw_colour corridor = 0xf2c14e;
    const draw_colour line = 0xc0392b;
    draw_add_legend(scene, corridor, "polygons of the path");
    draw_add_legend(scene, line, "shortest line through them");
    draw_add_legend(scene, 0x1e8449, "start");
    draw_stage_navmesh(scene, navmesh);
    uint32_t shown =
        route->path.polygon_count < buffers->polygon_capacity ? route->path.polygon_count : buffers->polygon_capacity;
    for (uint32_t i = 0; i < shown; i++) {
        const tl_nav_tile *tile;
        uint32_t polygon;
        if (tl_navmesh_resolve(navmesh, buffers->polygons[i], &tile, &polygon) == TL_OK) {
            add_surface(scene, tile, polygon, 0.02f, corridor);
        }
    }
    uint32_t corners = route->corner_count < buffers->corner_capacity ? route->corner_count : buffers->corner_capacity;
    for (uint32_t i = 0; i + 1 < corners; i++) {
        draw_add_line(scene, lifted_detail(buffers->corners[i].point, 0.2f),
                      lifted_detail(buffers->corners[i + 1].point, 0.2f), line, 3.2f, 1.0f);
    }
    for (uint32_t i = 0; i < corners; i++) {
        bool end = i == 0 || i + 1 == corners;
        draw_add_dot(scene, lifted_detail(buffers->corners[i].point, 0.2f), i == 0 ? 0x1e8449 : line,
                     end ? 6.0f : 3.2f);
    }
    snprintf(scene->subtitle, sizeof scene->subtitle, "path %s: %.2f m, %u corners, %u polygons",
             tl_nav_path_status_name(route->path.status), (double)route->length, route->corner_count,
             route->path.polygon_count);
}
