// SPDX-License-Identifier: MIT
//
// Fields against a flood without heap, hash table and order; paths out of them; zones; random reachable points.

#include "nav_fixture.h"

#include <math.h>
#include <talus/nav_around.h>

enum { CAPACITY = 2048 };

typedef struct twin_entry {
    tl_vec3 point;
    float cost;
    bool open, closed;
} twin_entry;

static tl_nav_field_def field_of(const tl_nav_filter *filter, const tl_nav_zone *zone, float max_cost)
{
    tl_nav_field_def def = tl_default_nav_field_def();
    def.filter = filter;
    def.zone = zone;
    def.max_cost = max_cost;
    def.by_reference = true;
    return def;
}

static float metre_of(const tl_navmesh *navmesh, const tl_nav_filter *filter, tl_nav_ref ref)
{
    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0;
    TEST_RESULT(tl_navmesh_resolve(navmesh, ref, &tile, &polygon), TL_OK);
    return filter == NULL ? 1.0f : filter->area_cost[tl_nav_tile_area(tile, polygon)];
}

// With the operations of the flood itself, for equal bits.
static tl_vec3 nearest_on(tl_vec3 a, tl_vec3 b, tl_vec3 p)
{
    double dx = (double)b.x - (double)a.x, dz = (double)b.z - (double)a.z;
    double along = dx * ((double)p.x - (double)a.x) + dz * ((double)p.z - (double)a.z), length_sq = dx * dx + dz * dz;
    double t = along > 0.0 && length_sq > 0.0 ? along < length_sq ? along / length_sq : 1.0 : 0.0;
    if (t <= 0.0 || t >= 1.0) {
        return t <= 0.0 ? a : b;
    }
    return tl_vec3_make((float)((double)a.x + t * dx), (float)((double)a.y + t * ((double)b.y - (double)a.y)),
                        (float)((double)a.z + t * dz));
}

static double distance_to_circle(const tl_nav_zone *zone, tl_vec3 a, tl_vec3 b)
{
    tl_vec3 p = nearest_on(a, b, zone->center);
    return hypot((double)p.x - (double)zone->center.x, (double)p.z - (double)zone->center.z) - (double)zone->radius;
}

// All entries by scanning for the cheapest open one each time. `*close_call` is set where a zone's answer hangs on
// rounding.
static twin_entry *twin_flood(const tl_navmesh *navmesh, const fixture_refs *all, const tl_nav_filter *filter,
                              const tl_nav_location *start, float max_cost, const tl_nav_zone *zone, bool *close_call)
{
    twin_entry *entries = calloc(all->count, sizeof *entries);
    uint32_t first = fixture_index_of(all, start->polygon);
    entries[first].open = true;
    entries[first].point = start->point;
    for (;;) {
        uint32_t at = UINT32_MAX;
        for (uint32_t i = 0; i < all->count; i++) {
            bool better = at == UINT32_MAX || entries[i].cost < entries[at].cost;
            at = entries[i].open && !entries[i].closed && better ? i : at;
        }
        if (at == UINT32_MAX) {
            return entries;
        }
        entries[at].closed = true;
        tl_nav_link links[64];
        uint32_t count = 0;
        TEST_RESULT(tl_navmesh_links(navmesh, all->refs[at], links, 64, &count), TL_OK);
        for (uint32_t k = 0; k < count; k++) {
            if (zone != NULL) {
                double beyond = distance_to_circle(zone, links[k].right, links[k].left);
                *close_call = *close_call || fabs(beyond) < 1e-5;
                if (beyond > 0.0) {
                    continue;
                }
            }
            uint32_t to = fixture_index_of(all, links[k].to);
            tl_vec3 point = nearest_on(links[k].right, links[k].left, entries[at].point);
            float cost =
                entries[at].cost + metre_of(navmesh, filter, all->refs[at]) * tl_distance(entries[at].point, point);
            if (!entries[to].closed && cost <= max_cost && (!entries[to].open || cost < entries[to].cost)) {
                entries[to].open = true;
                entries[to].cost = cost;
                entries[to].point = point;
            }
        }
    }
}

static void check_path(tl_nav_query *query, const tl_navmesh *navmesh, const tl_nav_field_entry *entries,
                       uint32_t count, uint32_t entry, const tl_nav_location *start, double *ratio_sum)
{
    tl_nav_ref polygons[CAPACITY];
    tl_nav_corner corners[CAPACITY];
    uint32_t length = 0, corner_count = 0;
    float metres = 0.0f;
    TEST_RESULT(tl_nav_field_path(entries, count, entry, polygons, CAPACITY, &length), TL_OK);
    TEST_CHECK(polygons[0] == start->polygon && polygons[length - 1] == entries[entry].polygon);
    TEST_RESULT(tl_navmesh_straight_path(navmesh,
                                         &(tl_nav_polygon_path){ polygons, length, start->point, entries[entry].point },
                                         corners, CAPACITY, &corner_count, &metres),
                TL_OK);
    tl_nav_location goal = { entries[entry].polygon, entries[entry].point };
    tl_nav_shortest_path shortest;
    TEST_RESULT(
        tl_nav_query_find_shortest_path(query, navmesh, &(tl_nav_path_request){ NULL, *start, goal }, NULL, &shortest),
        TL_OK);
    TEST_CHECK(shortest.status == TL_NAV_PATH_COMPLETE);
    *ratio_sum += shortest.length > 1.0 ? (double)metres / shortest.surface_length : 1.0;
    // Too little room: the first ones, and the true count.
    tl_nav_ref few[2] = { 0, 0 };
    uint32_t same = 0;
    tl_result expected = length <= 1 ? TL_OK : TL_INCOMPLETE;
    TEST_RESULT(tl_nav_field_path(entries, count, entry, few, 1, &same), expected);
    TEST_CHECK(same == length && few[0] == start->polygon && few[1] == 0);
}

static void test_fields(void **state)
{
    (void)state;
    test_random random = { 81 };
    tl_nav_query_def def = { 4096, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    uint32_t inside = 0, outside = 0, paths = 0, in_zones = 0;
    double ratios = 0.0;
    for (uint32_t round = 0; round < 36; round++) {
        fixture_level level = fixture_random(&random, round % 6, 8);
        level.tile_cells = round % 4 == 0 ? 0 : 3;
        level.area_count = 4;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        for (uint32_t i = 0; i < 6; i++) {
            tl_nav_location start = fixture_random_location(navmesh, &all, &random);
            tl_nav_filter filter = tl_default_nav_filter();
            for (int area = 0; area <= TL_NAV_MAX_AREA; area++) {
                filter.area_cost[area] = 1.0f + (float)(area % 4);
            }
            const tl_nav_filter *used = i % 2 == 0 ? NULL : &filter;
            tl_nav_zone zone = tl_nav_zone_circle(start.point, test_random_range(&random, 1.0f, 12.0f));
            tl_nav_field_def field =
                field_of(used, i >= 4 ? &zone : NULL, i < 2 ? INFINITY : test_random_range(&random, 2.0f, 40.0f));
            bool close_call = false;
            twin_entry *twin = twin_flood(navmesh, &all, used, &start, field.max_cost, field.zone, &close_call);
            tl_nav_field_entry entries[CAPACITY];
            uint32_t count = 0, expected = 0;
            TEST_RESULT(tl_nav_query_flood(query, navmesh, &start, &field, entries, CAPACITY, &count), TL_OK);
            for (uint32_t k = 1; k < count; k++) {
                TEST_CHECK(entries[k - 1].polygon < entries[k].polygon);
            }
            for (uint32_t k = 0; k < all.count && !close_call; k++) {
                uint32_t at = tl_nav_field_find(entries, count, all.refs[k]);
                TEST_CHECK((at != UINT32_MAX) == twin[k].closed);
                expected += twin[k].closed;
                if (at != UINT32_MAX) {
                    TEST_CHECK(entries[at].cost == twin[k].cost);
                    inside++;
                    in_zones += field.zone != NULL;
                } else {
                    outside++;
                }
            }
            TEST_CHECK(close_call || expected == count);
            // As they were found: the same ones, the start's first.
            tl_nav_field_entry found[CAPACITY];
            uint32_t found_count = 0;
            field.by_reference = false;
            TEST_RESULT(tl_nav_query_flood(query, navmesh, &start, &field, found, CAPACITY, &found_count), TL_OK);
            TEST_CHECK(found_count == count && found[0].polygon == start.polygon && found[0].parent == UINT32_MAX);
            for (uint32_t k = 0; k < count; k++) {
                uint32_t at = tl_nav_field_find(entries, count, found[k].polygon);
                TEST_CHECK(at != UINT32_MAX && entries[at].cost == found[k].cost);
                TEST_CHECK(k == 0 || found[found[k].parent].polygon == entries[entries[at].parent].polygon);
            }
            for (uint32_t k = 0; k < 10; k++) {
                check_path(query, navmesh, entries, count, test_random_below(&random, count), &start, &ratios);
                paths++;
            }
            free(twin);
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(inside > 5000 && outside > 3000 && in_zones > 300);
    // Straight paths out of fields are a few percent longer than the shortest ones on average.
    TEST_CHECK(ratios / paths >= 0.9999 && ratios / paths < 1.05);
}

// The area of a polygon's part within 32 sides, cut off one after the other.
static double area_in_circle(const tl_navmesh *navmesh, tl_nav_ref ref, tl_vec3 center, double radius)
{
    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0, corner_count = 0, count = 0;
    double p[128][2], cut[128][2];
    TEST_RESULT(tl_navmesh_resolve(navmesh, ref, &tile, &polygon), TL_OK);
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &corner_count);
    for (; count < corner_count; count++) {
        p[count][0] = (double)corners[count].x - (double)center.x;
        p[count][1] = (double)corners[count].z - (double)center.z;
    }
    for (int side = 0; side < 32; side++) {
        double angle = (side + 0.5) * acos(-1.0) / 16.0, reach = radius * cos(acos(-1.0) / 32.0);
        uint32_t kept = 0;
        for (uint32_t i = 0; i < count; i++) {
            const double *a = p[i], *b = p[(i + 1) % count];
            double da = reach - a[0] * cos(angle) - a[1] * sin(angle);
            double db = reach - b[0] * cos(angle) - b[1] * sin(angle);
            if (da >= 0.0) {
                memcpy(cut[kept++], a, sizeof cut[0]);
            }
            if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
                cut[kept][0] = a[0] + da / (da - db) * (b[0] - a[0]);
                cut[kept++][1] = a[1] + da / (da - db) * (b[1] - a[1]);
            }
        }
        memcpy(p, cut, sizeof p);
        count = kept;
    }
    double area = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        area += 0.5 * (p[(i + 1) % count][0] * p[i][1] - p[i][0] * p[(i + 1) % count][1]);
    }
    return area;
}

// Each polygon is met as often as its part in the circle is large; and the same points one by one.
static void test_reachable_areas(void **state)
{
    (void)state;
    enum { POINTS = 8000 };
    test_random random = { 83 };
    tl_nav_query_def def = { 4096, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    static uint64_t bits[2 * POINTS];
    static tl_nav_location points[POINTS];
    static tl_nav_field_entry entries[CAPACITY];
    uint32_t partial = 0, whole = 0;
    for (uint32_t round = 0; round < 60; round++) {
        fixture_level level = fixture_random(&random, round % 6, 7);
        level.tile_cells = round % 2 == 0 ? 0 : 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        tl_nav_location center = fixture_random_location(navmesh, &all, &random);
        float radius = test_random_range(&random, 0.2f, 9.0f);
        tl_nav_zone zone = tl_nav_zone_circle(center.point, radius);
        tl_nav_field_def field = field_of(NULL, &zone, radius);
        uint32_t count = 0;
        TEST_RESULT(tl_nav_query_flood(query, navmesh, &center, &field, entries, CAPACITY, &count), TL_OK);
        for (uint32_t i = 0; i < POINTS; i++) {
            bits[2 * i] = test_random_u64(&random);
            bits[2 * i + 1] = test_random_u64(&random);
        }
        TEST_RESULT(tl_nav_query_random_reachable_points(
                        query, navmesh, &(tl_nav_around_request){ NULL, center, radius }, bits, POINTS, points),
                    TL_OK);
        double sum = 0.0;
        for (uint32_t k = 0; k < count; k++) {
            sum += area_in_circle(navmesh, entries[k].polygon, center.point, (double)radius);
        }
        for (uint32_t k = 0; k < count; k++) {
            double area = area_in_circle(navmesh, entries[k].polygon, center.point, (double)radius);
            uint32_t met = 0;
            for (uint32_t i = 0; i < POINTS; i++) {
                met += points[i].polygon == entries[k].polygon;
            }
            // Five deviations of a count, of which there are some hundreds, and one for those that are rare.
            TEST_CHECK(fabs((double)met - POINTS * area / sum) <= 5.0 * sqrt(POINTS * area / sum) + 1.01);
            TEST_CHECK(area > 0.0 || met == 0);
            partial += area > 0.0 && area < area_in_circle(navmesh, entries[k].polygon, center.point, 1000.0) * 0.999;
            whole += area > 0.0;
        }
        for (uint32_t i = 0; i < POINTS; i += 97) {
            tl_nav_location one;
            TEST_RESULT(tl_nav_query_random_reachable(query, navmesh, &(tl_nav_around_request){ NULL, center, radius },
                                                      bits + 2 * i, &one),
                        TL_OK);
            TEST_CHECK(memcmp(&one.point, &points[i].point, sizeof one.point) == 0 && one.polygon == points[i].polygon);
        }
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(partial > 100 && whole > partial);
}

// A sliver's point, of which a circle around it holds next to nothing of what surrounds it: most draws are refused, and
// points are picked from the part itself. As many lie in each ring around the point as the ring is large.
static void test_reachable_sliver(void **state)
{
    (void)state;
    enum { POINTS = 4000, RINGS = 5 };
    const int32_t vertices[] = { 0, 0, 0, 400, 0, 9, 400, 0, 8 };
    const uint32_t first[] = { 0, 3 }, indices[] = { 0, 1, 2 }, areas[] = { 1 };
    const uint32_t neighbours[] = { TL_NO_POLYGON, TL_NO_POLYGON, TL_NO_POLYGON };
    tl_polygon_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    mesh.vertex_count = mesh.index_count = 3;
    mesh.polygon_count = 1;
    mesh.vertices = (int32_t *)(uintptr_t)vertices;
    mesh.first = (uint32_t *)(uintptr_t)first;
    mesh.indices = (uint32_t *)(uintptr_t)indices;
    mesh.neighbours = (uint32_t *)(uintptr_t)neighbours;
    mesh.areas = (uint32_t *)(uintptr_t)areas;
    mesh.cell_size = mesh.cell_height = 0.25f;
    tl_nav_tile_source source;
    memset(&source, 0, sizeof source);
    source.polygons = &mesh;
    source.agent_height = 2.0f;
    tl_nav_tile *tile = NULL;
    TEST_RESULT(tl_nav_tile_encode(&source, NULL, &tile, NULL), TL_OK);
    tl_navmesh *navmesh = NULL;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
    tl_nav_query *query = fixture_query(16);
    test_random random = { 91 };
    const tl_nav_location tip = { tl_navmesh_polygon_ref(navmesh, 0, 0), { 0, 0, 0 } };
    const float radius = 1.0f;
    uint32_t met[RINGS] = { 0 };
    for (uint32_t i = 0; i < POINTS; i++) {
        const uint64_t bits[2] = { test_random_u64(&random), test_random_u64(&random) };
        tl_nav_location at;
        TEST_RESULT(
            tl_nav_query_random_reachable(query, navmesh, &(tl_nav_around_request){ NULL, tip, radius }, bits, &at),
            TL_OK);
        const double share = sqrt((double)at.point.x * (double)at.point.x + (double)at.point.z * (double)at.point.z);
        TEST_CHECK(share <= 1.00001 && at.polygon == tip.polygon);
        met[share < 1.0 ? (uint32_t)(share * RINGS) : RINGS - 1]++;
    }
    for (uint32_t k = 0; k < RINGS; k++) {
        const double expected = POINTS * (2.0 * k + 1.0) / (RINGS * RINGS);
        // The outermost 0.5% of the circle may be missing.
        TEST_CHECK(fabs((double)met[k] - expected) <= 5.0 * sqrt(expected) + 0.01 * POINTS);
    }
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

// Weighs what a draw must look like by drawing all over the level and keeping what lies within.
static void test_reachable(void **state)
{
    (void)state;
    test_random random = { 82 };
    tl_nav_query_def def = { 4096, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    enum { DRAWS = 4000, SECTORS = 8 };
    uint32_t cut = 0, compared = 0;
    for (uint32_t round = 0; round < 12; round++) {
        fixture_level level = fixture_random(&random, round % 6, 7);
        level.tile_cells = round % 2 == 0 ? 0 : 3;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        fixture_refs all = fixture_all_refs(navmesh);
        tl_nav_location center = fixture_random_location(navmesh, &all, &random);
        float radius = test_random_range(&random, 1.5f, 9.0f);
        tl_nav_zone zone = tl_nav_zone_circle(center.point, radius);
        tl_nav_field_def field = field_of(NULL, &zone, radius);
        tl_nav_field_entry entries[CAPACITY];
        uint32_t count = 0, kept = 0, expected[SECTORS] = { 0 }, met[SECTORS] = { 0 };
        TEST_RESULT(tl_nav_query_flood(query, navmesh, &center, &field, entries, CAPACITY, &count), TL_OK);
        for (uint32_t i = 0; i < 40 * DRAWS && kept < DRAWS; i++) {
            const uint64_t bits[2] = { test_random_u64(&random), test_random_u64(&random) };
            tl_nav_location at;
            TEST_RESULT(tl_navmesh_random_point(navmesh, NULL, bits, &at), TL_OK);
            float x = at.point.x - center.point.x, z = at.point.z - center.point.z;
            if (x * x + z * z <= radius * radius && tl_nav_field_find(entries, count, at.polygon) != UINT32_MAX) {
                expected[(x < 0.0f ? 1 : 0) + (z < 0.0f ? 2 : 0) + (fabsf(x) < fabsf(z) ? 4 : 0)]++;
                kept++;
            }
        }
        for (uint32_t i = 0; i < kept; i++) {
            const uint64_t bits[2] = { test_random_u64(&random), test_random_u64(&random) };
            tl_nav_location at;
            TEST_RESULT(tl_nav_query_random_reachable(query, navmesh, &(tl_nav_around_request){ NULL, center, radius },
                                                      bits, &at),
                        TL_OK);
            float x = at.point.x - center.point.x, z = at.point.z - center.point.z;
            TEST_CHECK(x * x + z * z <= radius * radius * 1.00001f);
            TEST_CHECK(tl_nav_field_find(entries, count, at.polygon) != UINT32_MAX);
            met[(x < 0.0f ? 1 : 0) + (z < 0.0f ? 2 : 0) + (fabsf(x) < fabsf(z) ? 4 : 0)]++;
        }
        for (uint32_t k = 0; k < SECTORS && kept == DRAWS; k++) {
            // Five deviations of two counts, and what the 32 sides leave out.
            double slack = 5.0 * sqrt(2.0 * (double)expected[k] + 4.0) + 0.01 * DRAWS;
            TEST_CHECK(fabs((double)met[k] - (double)expected[k]) < slack);
            compared++;
        }
        cut += count < all.count;
        free(all.refs);
        tl_navmesh_destroy(navmesh);
    }
    tl_nav_query_destroy(query);
    TEST_CHECK(cut > 5 && compared > 40);
}

// Over a gap by an off-mesh link, one way.
static void test_links(void **state)
{
    (void)state;
    tl_nav_ref link = TL_NAV_NO_REF;
    tl_navmesh *navmesh = fixture_gap(&link);
    tl_nav_query_def def = { 64, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    tl_vec3 extents = { 1, 1, 1 };
    tl_nav_location start, goal;
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(2, 0, 2), extents, &start), TL_OK);
    TEST_RESULT(tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(22, 0, 2), extents, &goal), TL_OK);
    tl_nav_field_def everywhere = field_of(NULL, NULL, INFINITY);
    tl_nav_field_entry entries[8];
    tl_nav_ref polygons[8], expected[8];
    uint32_t count = 0, length = 0;
    TEST_RESULT(tl_nav_query_flood(query, navmesh, &start, &everywhere, entries, 8, &count), TL_OK);
    TEST_CHECK(count == 4);
    uint32_t at = tl_nav_field_find(entries, count, goal.polygon);
    // 5.5 m to the link, 9 m and 3 for it, 3.5 m to the last edge.
    TEST_CHECK(at != UINT32_MAX && fabsf(entries[at].cost - 21.0f) < 1e-4f);
    TEST_RESULT(tl_nav_field_path(entries, count, at, polygons, 8, &length), TL_OK);
    tl_nav_path path;
    TEST_RESULT(tl_nav_query_find_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, expected, 8, &path),
                TL_OK);
    TEST_CHECK(length == 5 && path.polygon_count == 5 && memcmp(polygons, expected, 5 * sizeof expected[0]) == 0);
    TEST_CHECK(polygons[2] == link);
    // Not backward, and not where its landing lies outside the zone.
    TEST_RESULT(tl_nav_query_flood(query, navmesh, &goal, &everywhere, entries, 8, &count), TL_OK);
    TEST_CHECK(count == 2);
    tl_nav_zone zone = tl_nav_zone_circle(start.point, 10.0f);
    tl_nav_field_def near_start = field_of(NULL, &zone, INFINITY);
    TEST_RESULT(tl_nav_query_flood(query, navmesh, &start, &near_start, entries, 8, &count), TL_OK);
    TEST_CHECK(count == 2);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

static void test_arguments(void **state)
{
    (void)state;
    const char *const rows[] = { "000", "0#0", "000" };
    fixture_level level = fixture_make(rows, 3);
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    tl_nav_query_def def = { 3, NULL, TL_DEF_COOKIE };
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    tl_nav_location start = { tl_navmesh_polygon_ref(navmesh, 0, 0), { 2, 0, 2 } }, at;
    tl_nav_location stale = { 77, { 0, 0, 0 } }, nan = { start.polygon, { NAN, 0, 0 } };
    tl_nav_field_def field = field_of(NULL, NULL, INFINITY), below = field_of(NULL, NULL, -1.0f);
    tl_nav_field_entry entries[8];
    uint32_t count = 0;
    const uint64_t bits[2] = { 1, 2 };
    TEST_RESULT(tl_nav_query_flood(query, navmesh, &stale, &field, entries, 8, &count), TL_ERR_STALE);
    TEST_RESULT(tl_nav_query_flood(query, navmesh, &nan, &field, entries, 8, &count), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_nav_query_flood(query, navmesh, &start, &below, entries, 8, &count), TL_ERR_ARGUMENT);
    TEST_RESULT(tl_nav_query_flood(query, navmesh, &start, &field, entries, 8, &count), TL_ERR_NODES);
    TEST_CHECK(count == 3);
    TEST_RESULT(
        tl_nav_query_random_reachable(query, navmesh, &(tl_nav_around_request){ NULL, start, 20.0f }, bits, &at),
        TL_ERR_NODES);
    TEST_RESULT(
        tl_nav_query_random_reachable(query, navmesh, &(tl_nav_around_request){ NULL, start, -1.0f }, bits, &at),
        TL_ERR_ARGUMENT);
    TEST_RESULT(tl_nav_query_random_reachable(query, navmesh, &(tl_nav_around_request){ NULL, start, 0.0f }, bits, &at),
                TL_OK);
    TEST_CHECK(at.polygon == start.polygon && at.point.x == 2.0f && at.point.z == 2.0f);
    TEST_RESULT(tl_nav_query_random_reachable(query, navmesh, &(tl_nav_around_request){ NULL, stale, 1.0f }, bits, &at),
                TL_ERR_STALE);
    TEST_RESULT(tl_nav_query_random_reachable(query, navmesh, &(tl_nav_around_request){ NULL, nan, 1.0f }, bits, &at),
                TL_ERR_NOT_FINITE);
    tl_nav_query_destroy(query);
    def.max_nodes = 64;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    TEST_RESULT(tl_nav_query_flood(query, navmesh, &start, &field, entries, 2, &count), TL_INCOMPLETE);
    TEST_CHECK(count == 8 && entries[0].polygon == start.polygon);
    uint32_t length = 0;
    TEST_RESULT(tl_nav_field_path(entries, 2, 7, NULL, 0, &length), TL_NOT_FOUND);
    TEST_CHECK(tl_nav_field_find(entries, 2, 1) == UINT32_MAX);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_fields),          cmocka_unit_test(test_reachable),
                                        cmocka_unit_test(test_reachable_areas), cmocka_unit_test(test_reachable_sliver),
                                        cmocka_unit_test(test_links),           cmocka_unit_test(test_arguments) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
