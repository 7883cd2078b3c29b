// SPDX-License-Identifier: MIT
//
// Hulls of arbitrary floats. The property: a bake either names what is wrong, or gives a hull that passes its own
// check and is proven convex, with all points inside and exact support; and so is its image under any map that keeps
// it solid. The same bytes are also read as a baked hull: what the check accepts must be safe to use.

#include "fuzz/fuzz_input.h"
#include "math/predicates.h"

#include <talus/hull.h>

#include <math.h>
#include <string.h>

enum { MAX_POINTS = 64 };

static void use(const tl_hull *hull, tl_vec3 direction)
{
    uint32_t answer = tl_hull_support(hull, direction, TL_NO_VERTEX);
    require(answer < hull->vertex_count);
    for (uint32_t hint = 0; hint < hull->vertex_count; hint += 3) {
        require(tl_hull_support(hull, direction, hint) < hull->vertex_count);
    }
    tl_hull_cast_ray(hull, direction, tl_neg(direction), 2.0f, NULL);
    tl_hull_contains(hull, direction);
}

static void require_farthest(const tl_hull *hull, tl_vec3 direction, uint32_t hint)
{
    uint32_t best = tl_hull_support(hull, direction, hint);
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        int order = tl_compare_along(direction, tl_hull_vertices(hull)[v], tl_hull_vertices(hull)[best]);
        require(order < 0 || (order == 0 && v >= best));
    }
}

// Merged and welded: nothing farther outside than allowed, and the bytes are what the check derives.
static void merge(const tl_vec3 *points, uint32_t count, float distance, float weld)
{
    tl_hull_def def = tl_default_hull_def();
    def.flatness = 0.0f;
    def.merge_distance = distance;
    def.weld_distance = weld;
    tl_hull *hull;
    tl_hull_report report;
    if (tl_hull_bake(points, count, &def, &hull, &report) != TL_OK) {
        return;
    }
    require(report.max_outside <= ((double)distance + (double)weld) * 1.000001);
    require(tl_hull_check(hull, hull->blob.size, NULL) == TL_OK);
    tl_result proof = tl_hull_validate(hull, points, count, NULL);
    require(proof == TL_OK || (report.corners_left_out > 0 && proof == TL_ERR_RANGE));
    for (uint32_t i = 0; i < count; i++) {
        use(hull, points[i]);
        require_farthest(hull, points[i], i);
    }
    tl_blob_free(hull);
}

static void transform(const tl_hull *hull, tl_vec3 scale, tl_vec3 turn, tl_vec3 shift)
{
    tl_transform pose = { { turn.x, turn.y, turn.z, 1.0f }, shift };
    tl_hull *image;
    if (tl_hull_transform(hull, scale, pose, NULL, &image, NULL) == TL_OK) {
        require(tl_hull_check(image, image->blob.size, NULL) == TL_OK);
        require(tl_hull_validate(image, NULL, 0, NULL) == TL_OK);
        tl_blob_free(image);
    }
}

static void build(const tl_vec3 *points, uint32_t count, uint32_t limit, float tolerance)
{
    tl_hull_def def = tl_default_hull_def();
    def.flatness = 0.0f;
    def.max_vertices = limit;
    def.tolerance = tolerance;
    tl_hull *hull;
    tl_hull_report report;
    if (tl_hull_bake(points, count, &def, &hull, &report) != TL_OK) {
        return;
    }
    require(limit != 0 || report.max_outside <= (double)tolerance * 1.000001);
    require(tl_hull_check(hull, hull->blob.size, NULL) == TL_OK);
    tl_result proof = tl_hull_validate(hull, points, count, NULL);
    require(proof == TL_OK || ((limit != 0 || tolerance > 0.0f) && proof == TL_ERR_RANGE));
    for (uint32_t i = 0; i < count; i++) {
        use(hull, points[i]);
        require_farthest(hull, points[i], i);
    }
    transform(hull, points[0], points[1], points[2]);
    tl_blob_free(hull);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2) {
        return 0;
    }
    tl_vec3 points[MAX_POINTS];
    uint32_t count = 0;
    size_t at = 2;
    if (data[0] % 3 == 0) {
        // Raw floats: every exponent, NaN and infinity.
        for (; count < MAX_POINTS && at + sizeof(tl_vec3) <= size; at += sizeof(tl_vec3)) {
            memcpy(&points[count++], data + at, sizeof(tl_vec3));
        }
    } else {
        // A small lattice, near or far: many points coincide, are collinear or coplanar.
        float offset = data[0] % 3 == 1 ? 0.0f : 8388608.0f;
        for (; count < MAX_POINTS && at + 3 <= size; at += 3) {
            points[count++] = tl_vec3_make((float)(data[at] % 8) + offset, (float)(data[at + 1] % 8) - offset,
                                           (float)(data[at + 2] % 8));
        }
    }
    // A tolerance from far below one rounding to far above the size.
    const float tolerance = data[1] % 4 == 2 ? ldexpf(1.0f, (int)(data[1] / 4u) - 32) : 0.0f;
    build(points, count, data[1] % 4 == 0 ? 4u + data[1] / 4u : 0, tolerance);
    if (data[1] % 4 == 1) {
        merge(points, count, 0.001f * (float)(data[1] / 4u) * (float)(data[1] / 4u), data[0] % 2 != 0 ? 0.3f : 0.0f);
    }

    void *copy = aligned_alloc(64, (size + 63) / 64 * 64);
    memcpy(copy, data, size);
    if (tl_hull_check(copy, size, NULL) == TL_OK) {
        use(copy, tl_vec3_make(1.0f, -2.0f, 0.5f));
    }
    free(copy);
    return 0;
}
