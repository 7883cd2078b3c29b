// SPDX-License-Identifier: MIT
//
// The chunk of marks: the volumes with which a navmesh was built, so that whoever holds it against its triangles later
// knows where floors were cut away or given an area.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "pack/format.h"

#include <math.h>
#include <string.h>

_Static_assert(sizeof(tl_pack_volumes) == 64 && sizeof(tl_pack_mark) == 64, "no hidden padding");

static bool is_finite(tl_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static tl_vec3 *points_of(const tl_pack_volumes *marks)
{
    union {
        const tl_pack_mark *read;
        tl_vec3 *write;
    } points = { (const tl_pack_mark *)(marks + 1) + marks->count };
    return points.write;
}

// What the volume's kind does not use stays zero.
static tl_pack_mark mark_of(const tl_nav_volume *volume, uint32_t first_point)
{
    tl_pack_mark mark;
    memset(&mark, 0, sizeof mark);
    mark.kind = (uint32_t)volume->kind;
    mark.area = volume->area;
    mark.first_point = first_point;
    if (volume->kind == TL_NAV_VOLUME_CYLINDER) {
        mark.base = volume->base;
        mark.radius = volume->radius;
        mark.height = volume->height;
    } else {
        mark.box = volume->box;
        mark.point_count = volume->kind == TL_NAV_VOLUME_POLYGON ? volume->point_count : 0;
    }
    return mark;
}

static bool is_sane(const tl_pack_mark *mark)
{
    return mark->kind <= TL_NAV_VOLUME_CYLINDER && mark->area <= TL_NAV_MAX_AREA && is_finite(mark->box.min) &&
           is_finite(mark->box.max) && is_finite(mark->base) && isfinite(mark->radius) && isfinite(mark->height) &&
           mark->reserved == 0 && (mark->kind == TL_NAV_VOLUME_POLYGON || mark->point_count == 0);
}

// A polygon's points count in the plan; its heights are the box's.
static tl_vec3 in_plan(tl_vec3 point)
{
    return tl_vec3_make(point.x, 0.0f, point.z);
}

tl_result tl_pack_volumes_encode(const tl_nav_volume *volumes, uint32_t count, const tl_allocator *allocator,
                                 tl_pack_volumes **marks_out)
{
    *marks_out = NULL;
    uint64_t point_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        const tl_pack_mark mark = mark_of(&volumes[i], 0);
        if (!is_sane(&mark)) {
            return TL_ERR_NOT_FINITE;
        }
        for (uint32_t k = 0; k < mark.point_count; k++) {
            if (!is_finite(in_plan(volumes[i].points[k]))) {
                return TL_ERR_NOT_FINITE;
            }
        }
        point_count += mark.point_count;
    }
    if (point_count > UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    tl_pack_volumes *marks =
        tl_blob_allocate(allocator, TL_PACK_MARKS_MAGIC, TL_PACK_MARKS_VERSION,
                         sizeof *marks + count * (uint64_t)sizeof(tl_pack_mark) + point_count * sizeof(tl_vec3));
    if (marks == NULL) {
        return TL_ERR_MEMORY;
    }
    marks->count = count;
    marks->point_count = (uint32_t)point_count;
    tl_pack_mark *out = (tl_pack_mark *)(marks + 1);
    tl_vec3 *points = points_of(marks);
    uint32_t first = 0;
    for (uint32_t i = 0; i < count; i++) {
        out[i] = mark_of(&volumes[i], first);
        for (uint32_t k = 0; k < out[i].point_count; k++) {
            points[first++] = in_plan(volumes[i].points[k]);
        }
    }
    *marks_out = marks;
    return TL_OK;
}

static bool is_padded(const tl_pack_volumes *marks, uint64_t used, uint64_t size)
{
    uint32_t any = 0;
    for (size_t i = 0; i < TL_COUNT_OF(marks->reserved); i++) {
        any |= marks->reserved[i];
    }
    for (uint64_t i = used; i < size; i++) {
        any |= ((const uint8_t *)marks)[i];
    }
    return any == 0;
}

tl_result tl_pack_volumes_check(const void *bytes, uint64_t size, tl_report *report_out)
{
    const tl_blob expected = { TL_PACK_MARKS_MAGIC, TL_PACK_MARKS_VERSION, sizeof(tl_pack_volumes) };
    const char *again = "bake the file again";
    TL_TRY(tl_pack_check_head(bytes, size, expected, report_out));
    const tl_pack_volumes *marks = bytes;
    const uint64_t used =
        sizeof *marks + marks->count * (uint64_t)sizeof(tl_pack_mark) + marks->point_count * (uint64_t)sizeof(tl_vec3);
    if (size < used || !is_padded(marks, used, size)) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, "head", TL_NO_ELEMENT, again);
    }
    // Points follow one another, each mark's behind those of the one before.
    const tl_pack_mark *list = (const tl_pack_mark *)(marks + 1);
    uint64_t first = 0;
    for (uint32_t i = 0; i < marks->count; i++) {
        if (!is_sane(&list[i]) || list[i].first_point != first) {
            return tl_report_fail(report_out, TL_ERR_CORRUPT, "volume", i, again);
        }
        first += list[i].point_count;
    }
    const tl_vec3 *points = points_of(marks);
    bool sound = first == marks->point_count;
    for (uint32_t i = 0; i < marks->point_count && sound; i++) {
        sound = is_finite(points[i]) && points[i].y == 0.0f;
    }
    return sound ? TL_OK : tl_report_fail(report_out, TL_ERR_CORRUPT, "points", TL_NO_ELEMENT, again);
}

tl_nav_volume tl_pack_volumes_at(const tl_pack_volumes *marks, uint32_t index)
{
    const tl_pack_mark *mark = (const tl_pack_mark *)(marks + 1) + index;
    tl_nav_volume volume;
    memset(&volume, 0, sizeof volume);
    volume.kind = (tl_nav_volume_kind)mark->kind;
    volume.area = (uint8_t)mark->area;
    volume.box = mark->box;
    volume.points = mark->point_count > 0 ? points_of(marks) + mark->first_point : NULL;
    volume.point_count = mark->point_count;
    volume.base = mark->base;
    volume.radius = mark->radius;
    volume.height = mark->height;
    return volume;
}
