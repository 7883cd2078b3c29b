// SPDX-License-Identifier: MIT
//
// How JavaScript and the library talk: plain exports with numbers as arguments, and one block of memory, the slot, for
// all that is more than an argument. JavaScript writes what it asks for into the slot as doubles, calls, and reads the
// answer from the same place. A float, a 32-bit integer and a size below 2^53 are exact doubles; references are written
// as the 64 bits that they are.
//
// No two calls run at once: JavaScript calls from one thread, and others only run the library's tasks (js_threads.h).
// So the slot, the filters and the report are static.

#ifndef TALUS_WASM_JS_SLOT_H
#define TALUS_WASM_JS_SLOT_H

#include <talus/talus.h>

/// An export. `name` is what JavaScript calls.
#define TL_JS_EXPORT(name) __attribute__((export_name(#name), used)) name

/// An export that only the full modules have. From the module of queries the linker drops it, and what only it calls.
#ifdef TALUS_JS_QUERIES
#define TL_JS_FULL_EXPORT(name) name
#else
#define TL_JS_FULL_EXPORT(name) TL_JS_EXPORT(name)
#endif

enum { TL_JS_SLOT_SIZE = 1024 };

/// Numbers in and out, JavaScript's view of it is a Float64Array.
extern double tl_js_slot[TL_JS_SLOT_SIZE];
/// What the last bake or check said of itself.
extern tl_report tl_js_report;
/// The filter that JavaScript set last, for polygons.
extern tl_nav_filter tl_js_nav_filter;

/// In the flags of a call: it is under that filter.
enum { TL_JS_FILTERED = 4 };

/// What a call is under; NULL: nothing.
static inline const tl_nav_filter *tl_js_filter_of(uint32_t flags)
{
    return (flags & TL_JS_FILTERED) != 0 ? &tl_js_nav_filter : NULL;
}

/// A host whose progress goes to JavaScript, and whose tasks run on the module's threads.
const tl_host *tl_js_host(void);

/// Slot entries as what they stand for.
float tl_js_f32(uint32_t at);
uint32_t tl_js_u32(uint32_t at);
uint64_t tl_js_u64(uint32_t at);
tl_vec3 tl_js_vec3(uint32_t at);
/// Min, then max.
tl_aabb tl_js_aabb(uint32_t at);
/// Rotation x, y, z, w, then position.
tl_transform tl_js_pose(uint32_t at);
/// The reference, then the point.
tl_nav_location tl_js_place(uint32_t at);

// The other way round; each gives the entry behind what it wrote.
uint32_t tl_js_put(uint32_t at, double value);
uint32_t tl_js_put_u64(uint32_t at, uint64_t value);
uint32_t tl_js_put_vec3(uint32_t at, tl_vec3 value);
uint32_t tl_js_put_aabb(uint32_t at, tl_aabb value);
uint32_t tl_js_put_place(uint32_t at, const tl_nav_location *place);
uint32_t tl_js_put_pointer(uint32_t at, const void *pointer);

/// Bytes that grow: one for all exports, valid until the next call that uses it.
typedef struct tl_js_buffer {
    char *bytes;
    size_t used, capacity;
    bool failed; ///< out of memory: further bytes are dropped, and the call must say so
} tl_js_buffer;

/// The buffer, empty.
tl_js_buffer *tl_js_buffer_begin(void);
void tl_js_buffer_add(tl_js_buffer *buffer, const void *bytes, size_t size);
/// The buffer with room for `size` bytes, all of which count as used. NULL: out of memory.
void *tl_js_buffer_room(size_t size);

#endif
