// SPDX-License-Identifier: MIT
//
// The MARK chunk: the volumes with which a navmesh was baked, so that an audit knows where floors were cut away or
// given an area.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "pack/pack_format.h"

#include <math.h>
#include <string.h>

_Static_assert(sizeof(tl_pack_volumes) == 64 && sizeof(tl_pack_volume) == 64, "no hidden padding");

static tl_vec3 *volume_points(const tl_pack_volumes *volumes)
{
    union {
        const tl_pack_volume *read;
        tl_vec3 *write;
    } points = { (const tl_pack_volume *)(volumes + 1) + volumes->count };
    return points.write;
}

// What the volume's kind does not use stays zero.
static tl_pack_volume encode_volume(const tl_nav_volume *volume, uint32_t first_point)
{
    tl_pack_volume packed;
    memset(&packed, 0, sizeof packed);
    packed.kind = (uint32_t)volume->kind;
    packed.area = volume->area;
    packed.first_point = first_point;
    if (volume->kind == TL_NAV_VOLUME_CYLINDER) {
        packed.base = volume->base;
        packed.radius = volume->radius;
        packed.height = volume->height;
    } else {
        packed.box = volume->box;
        packed.point_count = volume->kind == TL_NAV_VOLUME_POLYGON ? volume->point_count : 0;
    }
    return packed;
}

static bool is_sound_volume(const tl_pack_volume *volume)
{
    return volume->kind <= TL_NAV_VOLUME_CYLINDER && volume->area <= TL_NAV_MAX_AREA && tl_is_finite(volume->box.min) &&
           tl_is_finite(volume->box.max) && tl_is_finite(volume->base) && isfinite(volume->radius) &&
           isfinite(volume->height) && volume->reserved == 0 &&
           (volume->kind == TL_NAV_VOLUME_POLYGON || volume->point_count == 0);
}

// A polygon's points count in the plan; its heights are the box's.
static tl_vec3 on_ground_plane(tl_vec3 point)
{
    return tl_vec3_make(point.x, 0.0f, point.z);
}

static tl_result check_packed_volume(const tl_nav_volume *volume)
{
    const tl_pack_volume packed = encode_volume(volume, 0);
    if ((unsigned)volume->kind > TL_NAV_VOLUME_CYLINDER || (packed.point_count > 0 && volume->points == NULL)) {
        return TL_ERR_ARGUMENT;
    }
    bool finite = is_sound_volume(&packed);
    for (uint32_t i = 0; i < packed.point_count && finite; i++) {
        finite = tl_is_finite(on_ground_plane(volume->points[i]));
    }
    return finite ? TL_OK : TL_ERR_NOT_FINITE;
}

static tl_result count_points(const tl_nav_volume *volumes, uint32_t count, uint64_t *point_count_out,
                              tl_report *report)
{
    *point_count_out = 0;
    for (uint32_t i = 0; i < count; i++) {
        const tl_result result = check_packed_volume(&volumes[i]);
        if (result != TL_OK) {
            return tl_report_fail(report, result, "volume", i, "give a kind, an area and finite coordinates");
        }
        *point_count_out += encode_volume(&volumes[i], 0).point_count;
        if (*point_count_out > UINT32_MAX) {
            return tl_report_fail(report, TL_ERR_LIMIT, "volume", i, "give fewer points");
        }
    }
    return TL_OK;
}

static void write_volumes(const tl_nav_volume *volumes, tl_pack_volumes *blob)
{
    tl_pack_volume *out = (tl_pack_volume *)(blob + 1);
    tl_vec3 *points = volume_points(blob);
    uint32_t first = 0;
    for (uint32_t i = 0; i < blob->count; i++) {
        out[i] = encode_volume(&volumes[i], first);
        for (uint32_t k = 0; k < out[i].point_count; k++) {
            points[first++] = on_ground_plane(volumes[i].points[k]);
        }
    }
}

tl_result tl_pack_volumes_encode(const tl_nav_volume *volumes, uint32_t count, const tl_allocator *allocator,
                                 tl_pack_volumes **volumes_out, tl_report *report_out)
{
    uint64_t point_count;
    tl_report_begin(report_out, "encode volumes");
    if (volumes_out != NULL) {
        *volumes_out = NULL;
    }
    if (volumes_out == NULL || (volumes == NULL && count > 0)) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, volumes_out == NULL ? "volumes_out" : "volumes",
                               "it may not be NULL");
    }
    TL_TRY(count_points(volumes, count, &point_count, report_out));
    const uint64_t size =
        sizeof(tl_pack_volumes) + count * (uint64_t)sizeof(tl_pack_volume) + point_count * sizeof(tl_vec3);
    tl_pack_volumes *blob = tl_blob_allocate(allocator, TL_PACK_VOLUMES_MAGIC, TL_PACK_VOLUMES_VERSION, size);
    if (blob == NULL) {
        return TL_ERR_MEMORY;
    }
    blob->count = count;
    blob->point_count = (uint32_t)point_count;
    write_volumes(volumes, blob);
    *volumes_out = blob;
    return TL_OK;
}

static bool is_padded_volumes(const tl_pack_volumes *volumes, uint64_t used, uint64_t size)
{
    uint32_t any = 0;
    for (size_t i = 0; i < TL_COUNT_OF(volumes->reserved); i++) {
        any |= volumes->reserved[i];
    }
    for (uint64_t i = used; i < size; i++) {
        any |= ((const uint8_t *)volumes)[i];
    }
    return any == 0;
}

tl_result tl_pack_volumes_check(const void *bytes, uint64_t size, tl_report *report_out)
{
    const tl_blob expected = { TL_PACK_VOLUMES_MAGIC, TL_PACK_VOLUMES_VERSION, sizeof(tl_pack_volumes) };
    const char *again = "bake the file again";
    TL_TRY(tl_pack_check_head(bytes, size, expected, report_out));
    const tl_pack_volumes *volumes = bytes;
    const uint64_t used = sizeof *volumes + volumes->count * (uint64_t)sizeof(tl_pack_volume) +
                          volumes->point_count * (uint64_t)sizeof(tl_vec3);
    if (size < used || !is_padded_volumes(volumes, used, size)) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, "head", TL_NO_ELEMENT, again);
    }
    // Points follow one another, each volume's behind those of the one before.
    const tl_pack_volume *list = (const tl_pack_volume *)(volumes + 1);
    uint64_t first = 0;
    for (uint32_t i = 0; i < volumes->count; i++) {
        if (!is_sound_volume(&list[i]) || list[i].first_point != first) {
            return tl_report_fail(report_out, TL_ERR_CORRUPT, "volume", i, again);
        }
        first += list[i].point_count;
    }
    const tl_vec3 *points = volume_points(volumes);
    bool sound = first == volumes->point_count;
    for (uint32_t i = 0; i < volumes->point_count && sound; i++) {
        sound = tl_is_finite(points[i]) && points[i].y == 0.0f;
    }
    return sound ? TL_OK : tl_report_fail(report_out, TL_ERR_CORRUPT, "points", TL_NO_ELEMENT, again);
}

tl_nav_volume tl_pack_volumes_at(const tl_pack_volumes *volumes, uint32_t index)
{
    TL_ASSERT(index < volumes->count);
    const tl_pack_volume *packed = (const tl_pack_volume *)(volumes + 1) + index;
    tl_nav_volume volume;
    memset(&volume, 0, sizeof volume);
    volume.kind = (tl_nav_volume_kind)packed->kind;
    volume.area = (uint8_t)packed->area;
    volume.box = packed->box;
    volume.points = packed->point_count > 0 ? volume_points(volumes) + packed->first_point : NULL;
    volume.point_count = packed->point_count;
    volume.base = packed->base;
    volume.radius = packed->radius;
    volume.height = packed->height;
    return volume;
}
