// SPDX-License-Identifier: MIT
//
// The classic method on contour sets of real levels, where there are any below TALUS_DATA_DIR/contours: polygon for
// polygon what the plain method makes of each contour, and what Recast made of each set (NAME.recast.txt beside it).
// Prints a table, in which each difference has its reason.
//
//   test_polygon_levels [VERTICES]    the plain method takes O(n^3): by default contours of up to 1,000 vertices, 0:
//   all

#include "io/files/file_map.h"
#include "io/text/contour_text.h"
#include "polygon_shapes.h"
#include "polygon_text.h"

#include <dirent.h>
#include <stdio.h>

enum { MAX_FILES = 512 };

static uint32_t max_plain_vertices = 1000;

typedef struct row {
    uint32_t contours, vertices, polygons, repaired;
    uint32_t plain, plain_equal; // contours that the plain method divided, and as many of them as came out equal
    uint32_t recast, recast_equal;
    bool has_recast;
    const char *recast_fault;
} row;

// A polygon by its corners in order, beginning with the least: equal polygons have equal names, and others hardly ever.
static uint64_t polygon_name(const tl_polygon_mesh *mesh, uint32_t p)
{
    uint32_t first = mesh->first[p], count = mesh->first[p + 1] - first, least = 0;
    const int32_t *corner[64];
    TEST_CHECK(count <= 64);
    for (uint32_t k = 0; k < count; k++) {
        corner[k] = mesh->vertices + 3 * (size_t)mesh->indices[first + k];
        bool is_less =
            corner[k][0] != corner[least][0] ? corner[k][0] < corner[least][0] : corner[k][2] < corner[least][2];
        least = is_less ? k : least;
    }
    uint64_t name = count;
    for (uint32_t k = 0; k < count; k++) {
        const int32_t *c = corner[(least + k) % count];
        test_random mixed = { name * 31 + ((uint64_t)(uint32_t)c[0] << 32 | (uint32_t)c[2]) };
        name = test_random_u64(&mixed);
    }
    return name;
}

static int by_number(const void *a, const void *b)
{
    uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static uint64_t *sorted_names(const tl_polygon_mesh *mesh)
{
    uint64_t *names = malloc((mesh->polygon_count + 1) * sizeof *names);
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        names[p] = polygon_name(mesh, p);
    }
    qsort(names, mesh->polygon_count, sizeof *names, by_number);
    return names;
}

static uint32_t count_equal(const tl_polygon_mesh *a, const tl_polygon_mesh *b)
{
    uint64_t *x = sorted_names(a), *y = sorted_names(b);
    uint32_t equal = 0;
    for (uint32_t i = 0, j = 0; i < a->polygon_count && j < b->polygon_count;) {
        equal += x[i] == y[j];
        bool step_i = x[i] <= y[j], step_j = y[j] <= x[i];
        i += step_i;
        j += step_j;
    }
    free(x);
    free(y);
    return equal;
}

// The contour's polygons in the mesh, from *p on, against the plain method's, in order.
static bool equals_plain(const tl_contour_set *set, uint32_t contour, const tl_polygon_mesh *mesh, uint32_t p)
{
    const tl_contour_vertex *v = set->vertices + set->contours[contour].first_vertex;
    const uint32_t n = set->contours[contour].vertex_count;
    oracle_point *points = malloc(n * sizeof *points);
    uint32_t *triangles = malloc(3 * (size_t)n * sizeof *triangles);
    for (uint32_t i = 0; i < n; i++) {
        points[i].x = v[i].x;
        points[i].z = v[i].z;
    }
    bool equal = oracle_triangulate(points, n, triangles);
    // Vertices at one place are one: so polygons meet across bridges.
    for (uint32_t k = 0; k < 3 * (n - 2) && equal; k++) {
        for (uint32_t i = triangles[k]; i-- > 0;) {
            bool same_floor = v[i].y - v[triangles[k]].y <= 2 && v[triangles[k]].y - v[i].y <= 2;
            triangles[k] = oracle_same(points[i], points[triangles[k]]) && same_floor ? i : triangles[k];
        }
    }
    if (equal) {
        oracle_polygons expected = oracle_merge(points, triangles, n - 2, mesh->max_verts_per_poly);
        for (uint32_t q = 0; q < expected.count && equal; q++, p++) {
            uint32_t count = expected.sizes[q], corners[64];
            equal =
                p < mesh->polygon_count && mesh->contours[p] == contour && mesh->first[p + 1] - mesh->first[p] == count;
            for (uint32_t k = 0; k < count && equal; k++) {
                // By the place in the contour.
                const int32_t *at = mesh->vertices + 3 * (size_t)mesh->indices[mesh->first[p] + k];
                corners[k] = 0;
                while (corners[k] < n && !(points[corners[k]].x == at[0] && points[corners[k]].z == at[2])) {
                    corners[k]++;
                }
                for (uint32_t i = expected.corners[q][k]; i-- > 0;) {
                    bool same = oracle_same(points[i], points[expected.corners[q][k]]);
                    expected.corners[q][k] = same ? i : expected.corners[q][k];
                }
            }
            equal = equal && oracle_same_polygon(corners, expected.corners[q], count);
        }
        equal = equal && (p == mesh->polygon_count || mesh->contours[p] != contour);
        oracle_polygons_free(&expected, n - 2);
    }
    free(points);
    free(triangles);
    return equal;
}

// Contours without a note, as they are before border vertices go.
static void compare_with_plain(const tl_contour_set *set, tl_polygon_def def, row *r)
{
    tl_polygon_mesh mesh;
    def.keep_border_vertices = true;
    TEST_RESULT(tl_polygon_mesh_bake(set, &def, &mesh, NULL), TL_OK);
    uint32_t p = 0, note = 0;
    for (uint32_t i = 0; i < set->contour_count; i++) {
        while (p < mesh.polygon_count && mesh.contours[p] < i) {
            p++;
        }
        while (note < mesh.note_count && mesh.notes[note].contour < i) {
            note++;
        }
        bool is_noted = note < mesh.note_count && mesh.notes[note].contour == i;
        bool is_small = max_plain_vertices == 0 || set->contours[i].vertex_count <= max_plain_vertices;
        if (!is_noted && is_small) {
            r->plain++;
            r->plain_equal += equals_plain(set, i, &mesh, p);
        }
    }
    tl_polygon_mesh_free(&mesh);
}

static void compare_set(const tl_contour_text *text, tl_text_reader *recast_reader, row *r)
{
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = text->max_verts_per_poly;
    tl_polygon_mesh mesh;
    tl_polygon_report report;
    tl_polygon_check_report check;
    TEST_RESULT(tl_polygon_mesh_bake(&text->set, &def, &mesh, &report), TL_OK);
    TEST_RESULT(tl_polygon_mesh_check(&mesh, &text->set, NULL, &check), TL_OK);
    r->contours += text->set.contour_count;
    r->vertices += text->set.vertex_count;
    r->polygons += mesh.polygon_count;
    r->repaired += report.repaired_contours;
    compare_with_plain(&text->set, def, r);
    if (r->has_recast) {
        polygon_text recast;
        TEST_RESULT(polygon_text_read(recast_reader, &recast, NULL), TL_OK);
        uint32_t equal = count_equal(&mesh, &recast.mesh);
        r->recast += recast.mesh.polygon_count;
        r->recast_equal += equal;
        bool differs = equal < mesh.polygon_count || equal < recast.mesh.polygon_count;
        if (differs && (!recast.ok || recast.bad_triangulations > 0)) {
            r->recast_fault = "Recast failed to triangulate";
        } else if (differs && tl_polygon_mesh_check(&recast.mesh, NULL, NULL, &check) != TL_OK) {
            r->recast_fault = tl_polygon_fault_text(check.first_fault);
        }
        polygon_text_free(&recast);
    }
    tl_polygon_mesh_free(&mesh);
}

static void compare_file(const char *name, row *sum)
{
    char path[1024], beside[1200];
    snprintf(path, sizeof path, "%s/contours/%.500s", TALUS_DATA_DIR, name);
    snprintf(beside, sizeof beside, "%.*s.recast.txt", (int)strlen(path) - 4, path);
    row r;
    memset(&r, 0, sizeof r);
    tl_file_map contours_file, recast_file;
    memset(&recast_file, 0, sizeof recast_file);
    TEST_RESULT(tl_file_map_open(path, 0, &contours_file, NULL), TL_OK);
    r.has_recast = tl_file_map_open(beside, 0, &recast_file, NULL) == TL_OK;
    tl_text_reader reader = { contours_file.bytes, contours_file.size, path, NULL, 0, 0 };
    tl_text_reader recast_reader = { recast_file.bytes, recast_file.size, beside, NULL, 0, 0 };
    while (!tl_text_reader_at_end(&reader)) {
        tl_contour_text text;
        TEST_RESULT(tl_contour_text_read(&reader, &text, NULL), TL_OK);
        compare_set(&text, &recast_reader, &r);
        tl_contour_text_free(&text);
    }
    tl_file_map_close(&contours_file);
    if (r.has_recast) {
        tl_file_map_close(&recast_file);
    }
    printf("%-32s %8u %8u %8u  %5u of %5u  %5u of %5u", name, r.contours, r.vertices, r.polygons, r.plain_equal,
           r.plain, r.recast_equal, r.recast);
    if (r.repaired > 0) {
        printf("  %u contours repaired", r.repaired);
    }
    printf("%s%s\n", r.recast_fault != NULL ? "  Recast's: " : "", r.recast_fault != NULL ? r.recast_fault : "");
    TEST_CHECK(r.plain_equal == r.plain);
    // A difference needs a reason.
    bool has_reason = !r.has_recast || r.repaired > 0 || r.recast_fault != NULL;
    TEST_CHECK(has_reason || (r.polygons == r.recast && r.recast_equal == r.recast));
    sum->contours += r.contours;
    sum->vertices += r.vertices;
    sum->polygons += r.polygons;
    sum->plain += r.plain;
    sum->plain_equal += r.plain_equal;
    sum->recast += r.recast;
    sum->recast_equal += r.recast_equal;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static void real_contours_are_divided_as_the_plain_method_does(void **state)
{
    (void)state;
    DIR *folder = opendir(TALUS_DATA_DIR "/contours");
    if (folder == NULL) {
        skip();
    }
    char *names[MAX_FILES];
    size_t count = 0;
    for (struct dirent *entry = readdir(folder); entry != NULL && count < MAX_FILES; entry = readdir(folder)) {
        size_t length = strlen(entry->d_name);
        if (length > 4 && strcmp(entry->d_name + length - 4, ".txt") == 0 && strstr(entry->d_name, ".recast") == NULL &&
            strstr(entry->d_name, "critterai") == NULL) {
            names[count] = malloc(length + 1);
            memcpy(names[count++], entry->d_name, length + 1);
        }
    }
    closedir(folder);
    qsort(names, count, sizeof *names, by_name);
    row sum;
    memset(&sum, 0, sizeof sum);
    printf("%-32s %8s %8s %8s  %14s  %14s\n", "contours", "contours", "vertices", "polygons", "= plain method",
           "= Recast's");
    for (size_t i = 0; i < count; i++) {
        compare_file(names[i], &sum);
        free(names[i]);
    }
    printf("%-32s %8u %8u %8u  %5u of %5u  %5u of %5u\n", "all", sum.contours, sum.vertices, sum.polygons,
           sum.plain_equal, sum.plain, sum.recast_equal, sum.recast);
    TEST_CHECK(count == 0 || sum.plain > 0);
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        max_plain_vertices = (uint32_t)strtoul(argv[1], NULL, 10);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(real_contours_are_divided_as_the_plain_method_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
