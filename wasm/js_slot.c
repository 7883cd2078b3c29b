// SPDX-License-Identifier: MIT
//
// The slot, memory, the last report, and progress.

#include "js_slot.h"

#include "js_threads.h"

#include <stdlib.h>
#include <string.h>

double tl_js_slot[TL_JS_SLOT_SIZE];
tl_report tl_js_report;
tl_nav_filter tl_js_nav_filter;

static tl_js_buffer scratch;

// JavaScript's function: false cancels. It throws nothing: what a listener throws is kept and thrown when the call has
// ended.
__attribute__((import_module("env"), import_name("progress"))) extern int tl_js_progress(const char *stage, double done,
                                                                                         double total);

static bool update_progress(const char *stage, uint64_t done, uint64_t total, void *user)
{
    (void)user;
    return tl_js_progress(stage, (double)done, (double)total) != 0;
}

const tl_host *tl_js_host(void)
{
    static const tl_progress progress = { update_progress, NULL };
    static tl_host host;
    host.allocator = tl_js_allocator();
    host.tasks = tl_js_tasks();
    host.progress = &progress;
    return &host;
}

// ---------------------------------------------------------------------------------------------------------
// Numbers.

float tl_js_f32(uint32_t at)
{
    return (float)tl_js_slot[at];
}

uint32_t tl_js_u32(uint32_t at)
{
    return (uint32_t)tl_js_slot[at];
}

uint64_t tl_js_u64(uint32_t at)
{
    uint64_t value;
    memcpy(&value, &tl_js_slot[at], sizeof value);
    return value;
}

tl_vec3 tl_js_vec3(uint32_t at)
{
    return tl_vec3_make(tl_js_f32(at), tl_js_f32(at + 1), tl_js_f32(at + 2));
}

tl_aabb tl_js_aabb(uint32_t at)
{
    tl_aabb box = { tl_js_vec3(at), tl_js_vec3(at + 3) };
    return box;
}

tl_transform tl_js_pose(uint32_t at)
{
    tl_transform pose = { { tl_js_f32(at), tl_js_f32(at + 1), tl_js_f32(at + 2), tl_js_f32(at + 3) },
                          tl_js_vec3(at + 4) };
    return pose;
}

tl_nav_location tl_js_place(uint32_t at)
{
    const tl_nav_location place = { tl_js_u64(at), tl_js_vec3(at + 1) };
    return place;
}

uint32_t tl_js_put(uint32_t at, double value)
{
    tl_js_slot[at] = value;
    return at + 1;
}

uint32_t tl_js_put_u64(uint32_t at, uint64_t value)
{
    memcpy(&tl_js_slot[at], &value, sizeof value);
    return at + 1;
}

uint32_t tl_js_put_vec3(uint32_t at, tl_vec3 value)
{
    tl_js_slot[at] = (double)value.x;
    tl_js_slot[at + 1] = (double)value.y;
    tl_js_slot[at + 2] = (double)value.z;
    return at + 3;
}

uint32_t tl_js_put_aabb(uint32_t at, tl_aabb value)
{
    return tl_js_put_vec3(tl_js_put_vec3(at, value.min), value.max);
}

uint32_t tl_js_put_place(uint32_t at, const tl_nav_location *place)
{
    return tl_js_put_vec3(tl_js_put_u64(at, place->polygon), place->point);
}

uint32_t tl_js_put_pointer(uint32_t at, const void *pointer)
{
    return tl_js_put(at, (double)(uintptr_t)pointer);
}

// ---------------------------------------------------------------------------------------------------------
// Memory.

tl_js_buffer *tl_js_buffer_begin(void)
{
    scratch.used = 0;
    scratch.failed = false;
    return &scratch;
}

static bool reserve_scratch(size_t size)
{
    if (size <= scratch.capacity) {
        return true;
    }
    const size_t capacity = size + size / 2 + 256;
    char *bytes = realloc(scratch.bytes, capacity);
    if (bytes == NULL) {
        scratch.failed = true;
        return false;
    }
    scratch.bytes = bytes;
    scratch.capacity = capacity;
    return true;
}

void tl_js_buffer_add(tl_js_buffer *buffer, const void *bytes, size_t size)
{
    if (!buffer->failed && reserve_scratch(buffer->used + size)) {
        memcpy(buffer->bytes + buffer->used, bytes, size);
        buffer->used += size;
    }
}

void *tl_js_buffer_room(size_t size)
{
    tl_js_buffer *buffer = tl_js_buffer_begin();
    if (!reserve_scratch(size > 0 ? size : 1)) {
        return NULL;
    }
    buffer->used = size;
    return buffer->bytes;
}

/// Gives back a buffer that a large answer has left behind.
void TL_JS_EXPORT(js_trim)(void)
{
    if (scratch.capacity > 1u << 20) {
        free(scratch.bytes);
        memset(&scratch, 0, sizeof scratch);
    }
}

/// Aligned to 64 bytes, so that blobs can be read in place. NULL: out of memory.
void *TL_JS_EXPORT(js_alloc)(uint32_t size)
{
    // The size must be a multiple of the alignment; a size near 4 GB would wrap around.
    const uint32_t whole = (size + 63u) & ~63u;
    return whole < size ? NULL : aligned_alloc(64, whole > 0 ? whole : 64);
}

void TL_JS_EXPORT(js_free)(void *block)
{
    free(block);
}

void TL_JS_EXPORT(js_blob_free)(void *blob)
{
    tl_blob_free(blob);
}

// ---------------------------------------------------------------------------------------------------------
// What was said.

double *TL_JS_EXPORT(js_slot_address)(void)
{
    tl_js_nav_filter = tl_default_nav_filter();
    return tl_js_slot;
}

const char *TL_JS_EXPORT(js_version)(void)
{
    return tl_version();
}

const char *TL_JS_EXPORT(js_result_name)(int32_t result)
{
    return tl_result_name((tl_result)result);
}

const char *TL_JS_EXPORT(js_result_text)(int32_t result)
{
    return tl_result_text((tl_result)result);
}

/// Whether the kernels are those with SIMD.
int32_t TL_JS_EXPORT(js_has_simd)(void)
{
#ifdef __wasm_simd128__
    return 1;
#else
    return 0;
#endif
}

/// The last report, and an empty one for the next call: stage, field, element, advice, index (-1: none), peak bytes.
void TL_JS_EXPORT(js_take_report)(void)
{
    const bool none = tl_js_report.element == NULL || tl_js_report.element_index == TL_NO_ELEMENT;
    uint32_t at = tl_js_put_pointer(0, tl_js_report.stage);
    at = tl_js_put_pointer(at, tl_js_report.field);
    at = tl_js_put_pointer(at, tl_js_report.element);
    at = tl_js_put_pointer(at, tl_js_report.advice);
    at = tl_js_put(at, none ? -1.0 : (double)tl_js_report.element_index);
    tl_js_put(at, (double)tl_js_report.peak_bytes);
    memset(&tl_js_report, 0, sizeof tl_js_report);
}

/// Slot: include and exclude as 64 bits, the number of area costs, then area and cost of each, then the slack. The
/// filter stands until it is set again.
void TL_JS_EXPORT(js_set_nav_filter)(void)
{
    tl_js_nav_filter = tl_default_nav_filter();
    tl_js_nav_filter.include_flags = tl_js_u64(0);
    tl_js_nav_filter.exclude_flags = tl_js_u64(1);
    const uint32_t count = tl_js_u32(2);
    for (uint32_t i = 0; i < count; i++) {
        tl_js_nav_filter.area_cost[tl_js_u32(3 + 2 * i) & TL_NAV_MAX_AREA] = tl_js_f32(4 + 2 * i);
    }
    tl_js_nav_filter.slack = tl_js_f32(3 + 2 * count);
}
