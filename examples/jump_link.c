// SPDX-License-Identifier: MIT
//
// Jump links in use: two roofs with a gap between them. Links are found and proven, a path uses one, and an agent
// follows it: on foot from corner to corner, through the air along a link.

#include <talus/nav_bake.h>
#include <talus/nav_links.h>

#include <stdio.h>
#include <string.h>

enum { CAPACITY = 64, AIR_STEPS = 4 };

// Two roofs, 2 m apart, the second one half a metre lower.
static const tl_vec3 VERTICES[] = { { 0, 0, 0 },      { 0, 0, 10 },      { 8, 0, 10 },      { 8, 0, 0 },
                                    { 10, -0.5f, 0 }, { 10, -0.5f, 10 }, { 18, -0.5f, 10 }, { 18, -0.5f, 0 } };
static const uint32_t INDICES[] = { 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7 };

typedef struct roofs {
    tl_nav_tiles tiles;
    tl_navmesh *navmesh;
    tl_soup *soup;
    tl_nav_links *links;
    tl_nav_query *query;
} roofs;

static tl_result bake(roofs *r)
{
    tl_mesh_view mesh = { VERTICES, 8, INDICES, 4, NULL };
    tl_nav_input input = { mesh, NULL, NULL, 0 };
    tl_nav_def def = tl_default_nav_def();
    def.agent_radius = 0.4f;
    tl_result result = tl_nav_bake(&def, &input, &r->tiles, NULL);
    result = result == TL_OK ? tl_soup_bake(&mesh, NULL, &r->soup, NULL) : result;
    result = result == TL_OK ? tl_navmesh_create(NULL, &r->navmesh) : result;
    if (result == TL_OK) {
        result = tl_navmesh_add_tiles(r->navmesh, r->tiles.tiles, r->tiles.tile_count, TL_NAV_TILE_BORROWED, NULL);
    }
    tl_nav_query_def query_def = tl_default_nav_query_def();
    return result == TL_OK ? tl_nav_query_create(&query_def, &r->query, NULL) : result;
}

static tl_result find_links(roofs *r)
{
    tl_nav_links_def def = tl_default_nav_links_def();
    def.max_jump = 4.0f;
    tl_result result = tl_nav_links_find(&def, r->navmesh, r->soup, &r->links, NULL);
    if (result == TL_OK) {
        printf("%u links, %u of them jumps\n", r->links->link_count, r->links->kind_counts[TL_NAV_LINK_JUMP]);
        result = tl_nav_links_add(r->links, NULL, r->navmesh);
    }
    return result;
}

static void walk(const roofs *r, const tl_nav_corner *corners, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        printf("  at %5.2f %5.2f %5.2f\n", (double)corners[i].point.x, (double)corners[i].point.y,
               (double)corners[i].point.z);
        if ((corners[i].flags & TL_NAV_CORNER_LINK) == 0) {
            continue;
        }
        // The link's number in the set is what it was added with.
        tl_nav_offmesh_state state;
        if (tl_navmesh_offmesh_state(r->navmesh, corners[i].link, &state) == TL_OK) {
            const tl_nav_jump_link *link = &tl_nav_links_array(r->links)[state.offmesh.user];
            bool backward = (corners[i].link & TL_NAV_OFFMESH_BACKWARD) != 0;
            for (int step = 1; step < AIR_STEPS; step++) {
                float t = (float)step / (float)AIR_STEPS;
                tl_vec3 p = tl_nav_jump_link_point(link, backward ? 1.0f - t : t);
                printf("    %s %5.2f %5.2f %5.2f\n", tl_nav_link_kind_name((tl_nav_link_kind)link->kind), (double)p.x,
                       (double)p.y, (double)p.z);
            }
        }
    }
}

// Links on the path from one roof to the other, or -1 when there is no path.
static int go(const roofs *r)
{
    tl_nav_ref polygons[CAPACITY];
    tl_nav_corner corners[CAPACITY];
    tl_nav_path_buffers buffers = { polygons, CAPACITY, corners, CAPACITY };
    tl_nav_route route;
    const tl_nav_route_request request = { .start = { 2, 0, 2 },
                                           .goal = { 16, -0.5f, 8 },
                                           .half_extents = { 1, 1, 1 } };
    tl_result result = tl_nav_query_find_route(r->query, r->navmesh, &request, &buffers, &route);
    if (result != TL_OK || route.path.status != TL_NAV_PATH_COMPLETE) {
        printf("no way\n");
        return -1;
    }
    printf("%g m:\n", (double)route.length);
    walk(r, corners, route.corner_count);
    int links = 0;
    for (uint32_t i = 0; i < route.corner_count; i++) {
        links += (corners[i].flags & TL_NAV_CORNER_LINK) != 0;
    }
    return links;
}

int main(void)
{
    roofs r;
    memset(&r, 0, sizeof r);
    int before = 0;
    int after = 0;
    tl_result result = bake(&r);
    if (result == TL_OK) {
        before = go(&r);
        result = find_links(&r);
    }
    if (result == TL_OK) {
        after = go(&r);
    }
    tl_nav_query_destroy(r.query);
    tl_blob_free(r.links);
    tl_navmesh_destroy(r.navmesh);
    tl_nav_tiles_free(&r.tiles);
    tl_blob_free(r.soup);
    if (result != TL_OK) {
        fprintf(stderr, "talus: %s\n", tl_result_text(result));
        return 1;
    }
    return before == -1 && after == 1 ? 0 : 1;
}
