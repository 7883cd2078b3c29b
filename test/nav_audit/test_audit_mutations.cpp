// SPDX-License-Identifier: MIT
//
// How much an audit finds: polygons are taken out of a sound navmesh, and solid boxes are put into its level where
// polygons lie, at random; a table says how many are found, by area. Many are changed at once, far enough from one
// another that each finding belongs to one of them. Sound navmeshes must have no finding, nor may there be one beside
// what was changed.
//
// test_audit_mutations [CELL_SIZE FILE...] takes levels from files, and then makes 1000 changes of each kind a level.

#include "level_list.hpp"

extern "C" {
#include "nav_bake.h"
}

#include <talus/nav_around.h>
#include <talus/nav_audit.h>
#include <talus/soup.h>

#include <cmath>
#include <cstdio>
#include <cstring>

namespace
{

uint32_t changes_per_level = 10;

enum { BUCKETS = 7 };

// Square metres: where the buckets begin.
const double BUCKET_AREA[BUCKETS] = { 0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0 };

struct tally {
    uint32_t tried[BUCKETS], found[BUCKETS];
    uint32_t promised, promised_found, strays;
};

struct mutated_level {
    tl_mesh mesh;
    tl_nav_def def;
    tl_nav_tiles tiles;
    std::vector<tl_aabb> changed; // of one round
    std::vector<double> areas;
    std::vector<bool> promises;
};

void count_change(tally *t, double area, bool promised, bool found)
{
    int bucket = 0;
    while (bucket + 1 < BUCKETS && area >= BUCKET_AREA[bucket + 1]) {
        bucket++;
    }
    t->tried[bucket]++;
    t->found[bucket] += found;
    t->promised += promised;
    t->promised_found += promised && found;
}

void print_tally(const char *what, const tally &t)
{
    std::printf("%s, by square metres: found of tried\n", what);
    for (int i = 0; i < BUCKETS; i++) {
        std::printf("  from %-5g %5u of %5u  %5.1f%%\n", BUCKET_AREA[i], t.found[i], t.tried[i],
                    t.tried[i] > 0 ? 100.0 * t.found[i] / t.tried[i] : 0.0);
    }
    std::printf("  within the promise %u of %u; findings elsewhere %u\n", t.promised_found, t.promised, t.strays);
}

tl_aabb grown(tl_aabb box, float by)
{
    box.min = tl_sub(box.min, tl_vec3_make(by, by, by));
    box.max = tl_add(box.max, tl_vec3_make(by, by, by));
    return box;
}

bool is_apart(const mutated_level &l, tl_aabb box, float by)
{
    for (const tl_aabb &other : l.changed) {
        if (tl_aabb_overlaps(grown(box, by), other)) {
            return false;
        }
    }
    return true;
}

tl_navmesh *assemble(const std::vector<tl_nav_tile *> &tiles)
{
    tl_navmesh *navmesh;
    TEST_RESULT(tl_navmesh_create(nullptr, &navmesh), TL_OK);
    for (tl_nav_tile *tile : tiles) {
        if (tile != nullptr) {
            TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_BORROWED), TL_OK);
        }
    }
    return navmesh;
}

// Audits, and counts which changes a finding of the wanted kinds belongs to.
void judge(const mutated_level &l, const tl_navmesh *navmesh, const tl_soup *soup, bool missing, tally *t)
{
    tl_nav_audit_def def = tl_default_nav_audit_def();
    tl_nav_audit audit;
    def.nav = l.def;
    def.path_count = missing ? 0 : 200;
    TEST_RESULT(tl_nav_audit_run(&def, navmesh, soup, &audit, nullptr), TL_OK);
    std::vector<bool> found(l.changed.size(), false);
    for (uint32_t i = 0; i < audit.finding_count; i++) {
        const tl_nav_finding &finding = audit.findings[i];
        bool owned = false;
        for (size_t k = 0; k < l.changed.size(); k++) {
            const bool here = tl_aabb_overlaps(grown(finding.bounds, 2.0f * l.def.cell_size), l.changed[k]);
            owned = owned || here;
            if (here && (finding.kind == TL_NAV_FINDING_MISSING) == missing) {
                found[k] = true;
            }
        }
        if (!owned) {
            std::printf("%s at %g,%g,%g beside all changes\n", tl_nav_finding_name(finding.kind),
                        (double)finding.point.x, (double)finding.point.y, (double)finding.point.z);
            t->strays++;
        }
    }
    for (size_t k = 0; k < l.changed.size(); k++) {
        count_change(t, l.areas[k], l.promises[k], found[k]);
        if (l.promises[k] && !found[k]) {
            const tl_vec3 at = tl_aabb_center(l.changed[k]);
            std::printf("promised, and not found: %g m2 at %g,%g,%g\n", l.areas[k], (double)at.x, (double)at.y,
                        (double)at.z);
        }
    }
    tl_nav_audit_free(&audit);
}

// ---- Polygons that are taken out -------------------------------------------------------------------------------

tl_aabb polygon_box(const tl_nav_tile *tile, uint32_t polygon)
{
    tl_aabb box = tl_aabb_empty();
    const tl_nav_surface surface = tl_nav_tile_surface(tile, polygon);
    for (uint32_t i = 0; i < surface.vertex_count; i++) {
        box = tl_aabb_add_point(box, surface.vertices[i]);
    }
    return box;
}

// The radius of the largest circle around one of some points of a polygon: half its width, nearly.
float inner_radius(const tl_nav_tile *tile, uint32_t polygon)
{
    uint32_t count;
    const tl_vec3 *c = tl_nav_tile_corners(tile, polygon, &count);
    const tl_aabb box = polygon_box(tile, polygon);
    float best = 0.0f;
    for (int i = 0; i < 24 * 24; i++) {
        const float x = box.min.x + (box.max.x - box.min.x) * ((float)(i % 24) + 0.5f) / 24.0f;
        const float z = box.min.z + (box.max.z - box.min.z) * ((float)(i / 24) + 0.5f) / 24.0f;
        float inside = INFINITY;
        for (uint32_t k = 0; k < count; k++) {
            const tl_vec3 a = c[k], b = c[(k + 1) % count];
            const float dx = b.x - a.x, dz = b.z - a.z;
            // Counter-clockwise seen from above.
            inside = std::fmin(inside, ((x - a.x) * dz - (z - a.z) * dx) / std::hypot(dx, dz));
        }
        best = std::fmax(best, inside);
    }
    return best;
}

void remove_some(mutated_level *l, test_random *random, uint32_t wanted, std::vector<tl_nav_tile *> *tiles)
{
    std::vector<std::vector<uint8_t>> keep(l->tiles.tile_count);
    l->changed.clear();
    l->areas.clear();
    l->promises.clear();
    for (uint32_t trial = 0; trial < 8 * wanted && l->changed.size() < wanted; trial++) {
        const uint32_t t = test_random_below(random, l->tiles.tile_count);
        const tl_nav_tile *tile = l->tiles.tiles[t];
        const uint32_t p = test_random_below(random, tile->polygon_count);
        const tl_aabb box = polygon_box(tile, p);
        if (!is_apart(*l, box, 3.0f)) {
            continue;
        }
        keep[t].resize(tile->polygon_count, 1);
        keep[t][p] = 0;
        l->changed.push_back(box);
        l->areas.push_back(tl_nav_tile_polygon_area(tile, p));
        l->promises.push_back(inner_radius(tile, p) >= 1.0f);
    }
    for (uint32_t t = 0; t < l->tiles.tile_count; t++) {
        tl_nav_tile *tile = nullptr;
        if (!keep[t].empty()) {
            const tl_result result = tl_nav_tile_subset(l->tiles.tiles[t], keep[t].data(), nullptr, &tile, nullptr);
            TEST_CHECK(result == TL_OK || result == TL_ERR_EMPTY);
        }
        tiles->push_back(keep[t].empty() ? l->tiles.tiles[t] : tile);
    }
}

void try_removals(mutated_level *l, const tl_soup *soup, test_random *random, tally *t)
{
    uint32_t polygons = 0, done = 0;
    for (uint32_t i = 0; i < l->tiles.tile_count; i++) {
        polygons += l->tiles.tiles[i]->polygon_count;
    }
    // Each round is an audit of the whole level.
    const uint32_t at_once = polygons / 6 + 1, rounds = changes_per_level / 10;
    for (uint32_t round = 0; done < changes_per_level && round < rounds; round++) {
        std::vector<tl_nav_tile *> tiles;
        remove_some(l, random, at_once, &tiles);
        tl_navmesh *navmesh = assemble(tiles);
        judge(*l, navmesh, soup, true, t);
        done += (uint32_t)l->changed.size();
        tl_navmesh_destroy(navmesh);
        for (uint32_t i = 0; i < l->tiles.tile_count; i++) {
            if (tiles[i] != l->tiles.tiles[i]) {
                tl_blob_free(tiles[i]);
            }
        }
    }
}

// ---- Boxes that are put in -----------------------------------------------------------------------------------

void add_box(std::vector<tl_vec3> *vertices, std::vector<uint32_t> *indices, tl_aabb box)
{
    static const uint32_t faces[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
                                          { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
    const uint32_t first = (uint32_t)vertices->size();
    for (uint32_t i = 0; i < 8; i++) {
        vertices->push_back(
            tl_vec3_make(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z));
    }
    for (const uint32_t *face : faces) {
        for (uint32_t k : { 0u, 1u, 2u, 0u, 2u, 3u }) {
            indices->push_back(first + face[k]);
        }
    }
}

void try_additions(mutated_level *l, const level &source, const tl_navmesh *navmesh, test_random *random, tally *t)
{
    uint32_t done = 0;
    for (uint32_t round = 0; done < changes_per_level && round < 40; round++) {
        std::vector<tl_vec3> vertices = source.vertices;
        std::vector<uint32_t> indices = source.indices;
        l->changed.clear();
        l->areas.clear();
        l->promises.clear();
        for (uint32_t trial = 0; trial < 200 && l->changed.size() < 20; trial++) {
            const uint64_t bits[2] = { test_random_u64(random), test_random_u64(random) };
            tl_nav_location at;
            TEST_RESULT(tl_navmesh_random_point(navmesh, nullptr, bits, &at), TL_OK);
            const float side = 0.05f + 2.0f * test_random_unit(random) * test_random_unit(random);
            const tl_vec3 p = at.point;
            const tl_aabb box = { tl_vec3_make(p.x - 0.5f * side, p.y - 1.0f, p.z - 0.5f * side),
                                  tl_vec3_make(p.x + 0.5f * side, p.y + 2.5f, p.z + 0.5f * side) };
            if (!is_apart(*l, box, 4.0f)) {
                continue;
            }
            add_box(&vertices, &indices, box);
            l->changed.push_back(box);
            l->areas.push_back((double)side * (double)side);
            l->promises.push_back(false);
        }
        const tl_mesh_view view = { vertices.data(), (uint32_t)vertices.size(), indices.data(),
                                    (uint32_t)(indices.size() / 3), nullptr };
        tl_soup *soup;
        TEST_RESULT(tl_soup_bake(&view, nullptr, &soup, nullptr), TL_OK);
        judge(*l, navmesh, soup, false, t);
        done += (uint32_t)l->changed.size();
        tl_blob_free(soup);
    }
}

void mutate_level(const level &source, tally *removed, tally *added)
{
    mutated_level l;
    const tl_mesh_view view = source.view();
    TEST_RESULT(tl_mesh_bake(&view, nullptr, &l.mesh, nullptr), TL_OK);
    const tl_nav_input input = { tl_mesh_as_view(&l.mesh), nullptr, nullptr, 0 };
    l.def = tl_default_nav_def();
    l.def.cell_size = source.cell_size;
    l.def.agent_max_slope = source.max_slope;
    TEST_RESULT(tl_nav_bake(&l.def, &input, &l.tiles, nullptr), TL_OK);
    std::vector<tl_nav_tile *> whole(l.tiles.tiles, l.tiles.tiles + l.tiles.tile_count);
    tl_navmesh *navmesh = assemble(whole);
    tl_soup *soup;
    TEST_RESULT(tl_soup_bake(&view, nullptr, &soup, nullptr), TL_OK);
    judge(l, navmesh, soup, true, removed);
    test_random random = { 5 };
    try_removals(&l, soup, &random, removed);
    try_additions(&l, source, navmesh, &random, added);
    tl_blob_free(soup);
    tl_navmesh_destroy(navmesh);
    tl_nav_tiles_free(&l.tiles);
    tl_mesh_free(&l.mesh);
}

void test_mutations(void **)
{
    tally removed = {}, added = {};
    for (const level &l : all_levels(1000, { "office" })) {
        std::printf("%s\n", l.name.c_str());
        mutate_level(l, &removed, &added);
    }
    print_tally("polygons taken out", removed);
    print_tally("boxes put in", added);
    TEST_CHECK(removed.strays == 0 && added.strays == 0);
    TEST_CHECK(removed.promised > 10 && removed.promised_found == removed.promised);
}

} // namespace

int main(int argc, char **argv)
{
    changes_per_level = argc > 2 ? 1000 : changes_per_level;
    take_level_arguments(argc, argv);
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_mutations) };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
