// SPDX-License-Identifier: MIT
//
// Hulls compared with Qhull's: volume, area and, in general position, the very vertices.

#include "talus_test.h"

#include "hull_shapes.h"

#include <libqhull_r/qhull_ra.h>

#include <talus/hull.h>

typedef struct qhull_result {
    bool ok;
    double volume, area;
    uint32_t vertex_count;
    bool *is_vertex;
} qhull_result;

static qhull_result run_qhull(const tl_vec3 *points, uint32_t count)
{
    qhull_result result = { false, 0.0, 0.0, 0, calloc(count, sizeof(bool)) };
    coordT *coordinates = malloc(3 * (size_t)count * sizeof *coordinates);
    for (uint32_t i = 0; i < count; i++) {
        coordinates[3 * i] = (double)points[i].x;
        coordinates[3 * i + 1] = (double)points[i].y;
        coordinates[3 * i + 2] = (double)points[i].z;
    }
    qhT qh;
    QHULL_LIB_CHECK
    qh_zero(&qh, NULL);
    char options[] = "qhull Pp";
    FILE *null = fopen("/dev/null", "w");
    if (qh_new_qhull(&qh, 3, (int)count, coordinates, False, options, NULL, null) == 0) {
        result.ok = true;
        qh_getarea(&qh, qh.facet_list);
        result.volume = qh.totvol;
        result.area = qh.totarea;
        for (vertexT *vertex = qh.vertex_list; vertex != NULL && vertex->next != NULL; vertex = vertex->next) {
            result.is_vertex[qh_pointid(&qh, vertex->point)] = true;
            result.vertex_count++;
        }
    }
    fclose(null);
    qh_freeqhull(&qh, !qh_ALL);
    int long_blocks, long_bytes;
    qh_memfreeshort(&qh, &long_blocks, &long_bytes);
    free(coordinates);
    return result;
}

typedef struct tally {
    uint32_t compared, same_vertices, refused_by_qhull;
    double worst_volume, worst_area;
} tally;

// Within what of Qhull's figures: it merges facets within its own roundoff of some 1e-15 of the largest coordinate, and
// of thin clouds that is a larger share.
static void compare(const tl_vec3 *points, uint32_t count, bool general, tally *seen)
{
    tl_hull_def def = tl_default_hull_def();
    tl_hull *hull;
    if (tl_hull_bake(points, count, &def, &hull, NULL) != TL_OK) {
        return;
    }
    qhull_result peer = run_qhull(points, count);
    if (!peer.ok) {
        seen->refused_by_qhull++;
    } else {
        seen->compared++;
        tl_vec3 size = tl_aabb_size(hull->bounds);
        double box = (double)size.x * (double)size.y * (double)size.z;
        double volume = fabs(hull->mass.volume - peer.volume) / box;
        double area = fabs(hull->mass.area - peer.area) / peer.area;
        seen->worst_volume = fmax(seen->worst_volume, volume);
        seen->worst_area = fmax(seen->worst_area, area);
        TEST_CHECK(volume <= 1e-9 && area <= 1e-6);
        bool same = peer.vertex_count == hull->vertex_count;
        for (uint32_t v = 0; v < hull->vertex_count && same; v++) {
            same = peer.is_vertex[tl_hull_source(hull, v)];
        }
        TEST_CHECK(same || !general);
        seen->same_vertices += same;
    }
    free(peer.is_vertex);
    tl_blob_free(hull);
}

static void test_generated_clouds(void **state)
{
    (void)state;
    tally seen = { 0, 0, 0, 0.0, 0.0 };
    tl_vec3 *points = malloc(2000 * sizeof *points);
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        for (uint32_t i = 0; i < 6; i++) {
            static const uint32_t counts[] = { 6, 20, 50, 150, 500, 2000 };
            test_random random = { (uint64_t)kind * 10 + i };
            shape_make((shape_kind)kind, &random, points, counts[i]);
            bool general =
                kind == SHAPE_SPHERE || kind == SHAPE_BALL || kind == SHAPE_CUBE_VOLUME || kind == SHAPE_LENS;
            compare(points, counts[i], general, &seen);
        }
    }
    free(points);
    print_message("%u compared, %u with the same vertices, %u refused by Qhull; worst volume %.2g, area %.2g\n",
                  seen.compared, seen.same_vertices, seen.refused_by_qhull, seen.worst_volume, seen.worst_area);
    TEST_CHECK(seen.compared > 60 && seen.same_vertices > 40);
}

static void visit(tl_vec3 *points, uint32_t count, void *user)
{
    compare(points, count, false, user);
}

static void test_real_clouds(void **state)
{
    (void)state;
    tally seen = { 0, 0, 0, 0.0, 0.0 };
    if (shape_each_cloud(TALUS_DATA_DIR "/hulls/hulls_dev.txt", visit, &seen) == 0) {
        skip();
    }
    print_message("%u compared, %u with the same vertices, %u refused by Qhull; worst volume %.2g, area %.2g\n",
                  seen.compared, seen.same_vertices, seen.refused_by_qhull, seen.worst_volume, seen.worst_area);
    TEST_CHECK(seen.compared > 3000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_generated_clouds),
        cmocka_unit_test(test_real_clouds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
