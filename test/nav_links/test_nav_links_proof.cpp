// SPDX-License-Identifier: MIT
//
// Links of real levels, each proven again in another way: the agent's own capsule, a centimetre farther at every step
// of its way, against every triangle near it by GJK, where the search swept a thicker one in straight pieces. No step
// may touch a triangle. And each of them is worth its place: a path uses it.
//
//   test_nav_links_proof [LEVEL ...]   OBJ files; without any, built-in levels and those of the data folder

#include "level_list.hpp"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <talus/nav_bake.h>
#include <talus/nav_links.h>

namespace
{

std::vector<std::string> files;

struct step {
    tl_convex capsule;
    tl_transform pose;
    bool touches;
};

bool test_triangle(const tl_soup_triangle *triangle, void *user)
{
    auto *s = static_cast<step *>(user);
    tl_convex shape = tl_convex_triangle(triangle->corners[0], triangle->corners[1], triangle->corners[2], 0.0f);
    s->touches = tl_convex_overlap(&shape, tl_transform_identity(), &s->capsule, s->pose, nullptr);
    return !s->touches;
}

double way_length(const tl_nav_jump_link &link)
{
    double length = 0.0;
    tl_vec3 from = link.start;
    for (int i = 1; i <= 64; i++) {
        tl_vec3 to = tl_nav_jump_link_point(&link, (float)i / 64.0f);
        length += (double)tl_distance(from, to);
        from = to;
    }
    return length;
}

// Steps that touched a triangle.
uint64_t walk(const tl_soup *soup, const tl_nav_links *links, const tl_nav_jump_link &link, uint64_t *steps)
{
    const double STEP = 0.01;
    float lift = fminf(links->agent_max_climb, links->agent_height - 2.0f * links->agent_radius);
    float low = fmaxf(lift, 0.0f) + links->agent_radius;
    float high = fmaxf(links->agent_height - links->agent_radius, low);
    step s = { tl_convex_capsule(tl_vec3_make(0, low, 0), tl_vec3_make(0, high, 0), links->agent_radius),
               tl_transform_identity(), false };
    uint32_t count = (uint32_t)(way_length(link) / STEP) + 2;
    uint64_t touched = 0;
    for (uint32_t i = 0; i <= count; i++) {
        s.pose.position = tl_nav_jump_link_point(&link, (float)i / (float)count);
        s.touches = false;
        tl_soup_triangles_in_box(soup, tl_convex_bounds(&s.capsule, s.pose), test_triangle, &s);
        touched += s.touches;
    }
    *steps += count + 1;
    return touched;
}

bool is_on_navmesh(const tl_navmesh *navmesh, tl_vec3 point)
{
    tl_nav_location found;
    return tl_navmesh_find_nearest(navmesh, nullptr, point, tl_vec3_make(0.01f, 0.01f, 0.01f), &found) == TL_OK;
}

// Whether the shortest path between its ends, now that all links are in, is no longer than the link.
bool is_used(const tl_navmesh *navmesh, tl_nav_query *query, const tl_nav_jump_link &link)
{
    tl_nav_location ends[2];
    tl_vec3 near_by = tl_vec3_make(0.01f, 0.01f, 0.01f);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, nullptr, link.start, near_by, &ends[0]), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, nullptr, link.end, near_by, &ends[1]), TL_OK);
    const tl_nav_path_request request = { nullptr, ends[0], ends[1] };
    tl_nav_shortest_path path;
    TEST_RESULT(tl_nav_query_find_shortest_path(query, navmesh, &request, nullptr, &path), TL_OK);
    double cost = (double)tl_distance(link.start, link.end);
    return path.status == TL_NAV_PATH_COMPLETE && path.length <= cost * (1.0 + 1e-6) + 1e-6;
}

void check_links(const tl_navmesh *navmesh, const tl_soup *soup, const tl_nav_links *links, uint64_t *steps)
{
    const tl_nav_jump_link *at = tl_nav_links_array(links);
    for (uint32_t i = 0; i < links->link_count; i++) {
        TEST_CHECK(is_on_navmesh(navmesh, at[i].start) && is_on_navmesh(navmesh, at[i].end));
        uint64_t touched = walk(soup, links, at[i], steps);
        if (touched > 0) {
            fail_msg("link %u, a %s from %g %g %g to %g %g %g, touches triangles in %llu steps", i,
                     tl_nav_link_kind_name((tl_nav_link_kind)at[i].kind), (double)at[i].start.x, (double)at[i].start.y,
                     (double)at[i].start.z, (double)at[i].end.x, (double)at[i].end.y, (double)at[i].end.z,
                     (unsigned long long)touched);
        }
    }
}

void prove_level(const level &l, uint64_t kinds_out[TL_NAV_LINK_KINDS])
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = l.cell_size;
    tl_mesh_view view = l.view();
    tl_nav_input input = { view, nullptr, nullptr, 0 };
    tl_nav_tiles tiles;
    TEST_RESULT(tl_nav_bake(&def, &input, &tiles, nullptr), TL_OK);
    tl_navmesh *navmesh;
    TEST_RESULT(tl_navmesh_create(nullptr, &navmesh), TL_OK);
    for (uint32_t i = 0; i < tiles.tile_count; i++) {
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tiles.tiles[i], TL_NAV_TILE_BORROWED), TL_OK);
    }
    tl_soup *soup;
    TEST_RESULT(tl_soup_bake(&view, nullptr, &soup, nullptr), TL_OK);
    tl_nav_links_def links_def = tl_default_nav_links_def();
    tl_nav_links *links;
    tl_nav_links_report report;
    TEST_RESULT(tl_nav_links_find(&links_def, navmesh, soup, &links, &report), TL_OK);
    TEST_RESULT(tl_nav_links_check(links, links->blob.size, NULL), TL_OK);
    TEST_RESULT(tl_nav_links_add(links, nullptr, navmesh), TL_OK);
    uint64_t steps = 0;
    uint32_t used = 0;
    check_links(navmesh, soup, links, &steps);
    tl_nav_query_def query_def = tl_default_nav_query_def();
    tl_nav_query *query;
    TEST_RESULT(tl_nav_query_create(&query_def, &query, NULL), TL_OK);
    for (uint32_t i = 0; i < links->link_count; i++) {
        used += is_used(navmesh, query, tl_nav_links_array(links)[i]);
    }
    TEST_CHECK(used == links->link_count);
    std::printf("%-18s %5u places: %u links (%u drops, %u jumps, %u climbs), 0 of %llu steps touch a triangle\n",
                l.name.c_str(), report.sample_count, links->link_count, links->kind_counts[0], links->kind_counts[1],
                links->kind_counts[2], (unsigned long long)steps);
    for (int kind = 0; kind < TL_NAV_LINK_KINDS; kind++) {
        kinds_out[kind] += links->kind_counts[kind];
    }
    tl_nav_query_destroy(query);
    tl_blob_free(links);
    tl_blob_free(soup);
    tl_navmesh_destroy(navmesh);
    tl_nav_tiles_free(&tiles);
}

void test_levels(void **)
{
    std::vector<level> levels;
    for (const std::string &file : files) {
        tl_imported_mesh mesh;
        TEST_RESULT(tl_import_mesh(file.c_str(), nullptr, &mesh, nullptr), TL_OK);
        levels.push_back(copy_level(file, 0.3f, tl_imported_mesh_as_view(&mesh)));
        tl_imported_mesh_free(&mesh);
    }
    if (files.empty()) {
        levels = all_levels(16000, { "nav_test", "dungeon", "undulating" });
    }
    uint64_t kinds[TL_NAV_LINK_KINDS] = {};
    for (const level &l : levels) {
        prove_level(l, kinds);
    }
    TEST_CHECK(!files.empty() ||
               (kinds[TL_NAV_LINK_DROP] > 30 && kinds[TL_NAV_LINK_JUMP] > 20 && kinds[TL_NAV_LINK_CLIMB] > 0));
}

} // namespace

int main(int argc, char **argv)
{
    files.assign(argv + 1, argv + argc);
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_levels) };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
