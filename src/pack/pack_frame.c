// SPDX-License-Identifier: MIT
//
// The FRAM chunk: where a baked file's coordinates stand in the level's own, so that whoever opens it can speak the
// level's coordinates. What is baked is y-up, right-handed, near the origin and in floats; a survey's coordinates are
// z-up and millions of metres out, and an engine's may be left-handed. The sum is done in double and rounded once.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "pack/pack_format.h"

#include <math.h>

_Static_assert(sizeof(tl_pack_frame) == 64, "no hidden padding");

static bool is_sound_frame(uint32_t axes, const double origin[3])
{
    return axes <= TL_PACK_AXES_Z_UP_LEFT && isfinite(origin[0]) && isfinite(origin[1]) && isfinite(origin[2]);
}

tl_result tl_pack_frame_encode(tl_pack_axes axes, const double origin[3], const tl_allocator *allocator,
                               tl_pack_frame **frame_out, tl_report *report_out)
{
    tl_report_begin(report_out, "encode frame");
    if (frame_out != NULL) {
        *frame_out = NULL;
    }
    if (frame_out == NULL || origin == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, frame_out == NULL ? "frame_out" : "origin",
                               "it may not be NULL");
    }
    if (!is_sound_frame((uint32_t)axes, origin)) {
        bool known = (uint32_t)axes <= TL_PACK_AXES_Z_UP_LEFT;
        return tl_report_field(report_out, TL_ERR_ARGUMENT, known ? "origin" : "axes",
                               known ? "make it finite" : "give a tl_pack_axes");
    }
    tl_pack_frame *frame = tl_blob_allocate(allocator, TL_PACK_FRAME_MAGIC, TL_PACK_FRAME_VERSION, sizeof *frame);
    if (frame == NULL) {
        return TL_ERR_MEMORY;
    }
    for (int i = 0; i < 3; i++) {
        frame->origin[i] = origin[i] + 0.0; // no -0
    }
    frame->axes = (uint32_t)axes;
    *frame_out = frame;
    return TL_OK;
}

tl_result tl_pack_frame_check(const void *bytes, uint64_t size, tl_report *report_out)
{
    const tl_blob expected = { TL_PACK_FRAME_MAGIC, TL_PACK_FRAME_VERSION, sizeof(tl_pack_frame) };
    TL_TRY(tl_pack_check_head(bytes, size, expected, report_out));
    const tl_pack_frame *frame = bytes;
    uint32_t any = size > sizeof *frame;
    for (size_t i = 0; i < TL_COUNT_OF(frame->reserved); i++) {
        any |= frame->reserved[i];
    }
    if (any != 0 || !is_sound_frame(frame->axes, frame->origin)) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, any != 0 ? "padding" : "settings", TL_NO_ELEMENT,
                              "bake the file again");
    }
    return TL_OK;
}

tl_vec3 tl_pack_turn_in(tl_pack_axes axes, tl_vec3 v)
{
    switch (axes) {
    case TL_PACK_AXES_Z_UP:
        return tl_vec3_make(v.x, v.z, 0.0f - v.y); // no -0 from a 0
    case TL_PACK_AXES_Y_UP_LEFT:
        return tl_vec3_make(v.x, v.y, 0.0f - v.z);
    case TL_PACK_AXES_Z_UP_LEFT:
        return tl_vec3_make(v.x, v.z, v.y);
    default:
        return v;
    }
}

tl_vec3 tl_pack_turn_out(tl_pack_axes axes, tl_vec3 v)
{
    return axes == TL_PACK_AXES_Z_UP ? tl_vec3_make(v.x, 0.0f - v.z, v.y) : tl_pack_turn_in(axes, v); // else its own
}

tl_vec3 tl_pack_place_in(const tl_pack_frame *frame, const double point[3])
{
    if (frame == NULL) {
        return tl_vec3_make((float)point[0], (float)point[1], (float)point[2]);
    }
    const tl_vec3 near = tl_vec3_make((float)(point[0] - frame->origin[0]), (float)(point[1] - frame->origin[1]),
                                      (float)(point[2] - frame->origin[2]));
    return tl_pack_turn_in((tl_pack_axes)frame->axes, near);
}

void tl_pack_place_out(const tl_pack_frame *frame, tl_vec3 point, double out[3])
{
    const tl_vec3 turned = frame != NULL ? tl_pack_turn_out((tl_pack_axes)frame->axes, point) : point;
    out[0] = (double)turned.x + (frame != NULL ? frame->origin[0] : 0.0);
    out[1] = (double)turned.y + (frame != NULL ? frame->origin[1] : 0.0);
    out[2] = (double)turned.z + (frame != NULL ? frame->origin[2] : 0.0);
}
