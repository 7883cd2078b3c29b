// SPDX-License-Identifier: MIT
//
// What every part of talus shares: version, results, allocator, task and progress hooks.
//
// The library keeps no global state, starts no thread, reads no clock and touches no file. What a bake
// needs of its environment it gets through a tl_host: an allocator, a way to run tasks, a progress hook.

#ifndef TALUS_BASE_H
#define TALUS_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// The library's version: major, minor, patch. CMake reads it from here; there is no second copy.
#define TL_VERSION_MAJOR 0
#define TL_VERSION_MINOR 1
#define TL_VERSION_PATCH 0

/// What a function of the public API is declared with.
#if defined(_WIN32) && defined(TALUS_SHARED)
#if defined(TALUS_BUILDING)
#define TL_API __declspec(dllexport)
#else
#define TL_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define TL_API __attribute__((visibility("default")))
#else
#define TL_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// The result of a call. Every failure has a name of its own; `tl_result_text` has a sentence for each.
///
/// Zero is success. Three ordinary outcomes have names as well, since a caller usually does something about them; they
/// are not failures (tl_is_error). All other results are.
typedef enum tl_result {
    TL_OK = 0,
    TL_NOT_FOUND,  ///< nothing is there: no hit, no polygon that near, no entry of that name
    TL_INCOMPLETE, ///< the caller's buffer holds a part: what fitted was written, and the true count was returned
    TL_NOT_LOADED, ///< the answer depends on a part of the world that is not in memory (nav_world.h)

    // From the host or the operating system.
    TL_ERR_MEMORY,    ///< the allocator returned NULL; nothing leaked, the input is untouched
    TL_ERR_CANCELLED, ///< the progress hook returned false
    TL_ERR_IO,        ///< the operating system refused a read or write (io and tools only)

    // What was wrong with a def or an argument that comes from data.
    TL_ERR_ARGUMENT,    ///< a NULL, a def without its cookie, or a field outside its documented range
    TL_ERR_UNSUPPORTED, ///< well-formed, but of a kind this build cannot handle
    TL_ERR_LIMIT,       ///< a documented limit would be exceeded; nothing was cut silently
    TL_ERR_STALE,       ///< a reference to something that is no longer there, or never was

    // What was wrong with geometry.
    TL_ERR_EMPTY,             ///< no vertices, triangles, points or contours
    TL_ERR_NOT_FINITE,        ///< a coordinate is NaN or infinite
    TL_ERR_RANGE,             ///< a coordinate is too large to be computed with
    TL_ERR_INDEX,             ///< an index points outside its array
    TL_ERR_DEGENERATE,        ///< no area, no volume or no length where some is needed
    TL_ERR_COINCIDENT,        ///< all points coincide
    TL_ERR_COLLINEAR,         ///< all points lie on one line
    TL_ERR_COPLANAR,          ///< all points lie in one plane
    TL_ERR_NON_MANIFOLD,      ///< an edge would get more than two faces, or a vertex two fans
    TL_ERR_WINDING,           ///< a face runs against its neighbour
    TL_ERR_NOT_CLOSED,        ///< a surface that must enclose a space has a hole or a rim
    TL_ERR_SELF_INTERSECTION, ///< an outline crosses itself

    // What was wrong with bytes.
    TL_ERR_FORMAT,    ///< a text or binary format is not what it claims to be
    TL_ERR_MAGIC,     ///< the leading bytes name another kind of data
    TL_ERR_VERSION,   ///< written by an incompatible version
    TL_ERR_TRUNCATED, ///< shorter than its own header says
    TL_ERR_HASH,      ///< the content does not match its stored hash
    TL_ERR_CORRUPT,   ///< an offset, count or invariant inside is wrong

    // What a search could not finish. "Gave up" is never reported as "no".
    TL_ERR_ITERATIONS, ///< the iteration limit was reached before the answer was proven
    TL_ERR_NODES,      ///< the query's node pool was too small; the answer is the best that was seen

    TL_RESULT_COUNT
} tl_result;

/// Whether a result is a failure: neither TL_OK nor one of the ordinary outcomes TL_NOT_FOUND, TL_INCOMPLETE and
/// TL_NOT_LOADED.
static inline bool tl_is_error(tl_result result)
{
    return result > TL_NOT_LOADED;
}

/// The enum's own word for a result, such as "TL_ERR_NOT_FINITE". Never NULL.
TL_API const char *tl_result_name(tl_result result);

/// A sentence for a result, in lower case and without a full stop, to be put behind "file: ". Never NULL.
TL_API const char *tl_result_text(tl_result result);

/// "MAJOR.MINOR.PATCH" of the compiled library, to be compared with the header's macros.
TL_API const char *tl_version(void);

/// Where a bake takes its memory from.
///
/// `allocate` returns `size` bytes (> 0) aligned to `alignment` (a power of two, at most 64), or NULL.
/// `release` gets back a pointer that `allocate` returned, and the size asked for then.
/// A bake that is given tasks may call both from several threads at once.
typedef struct tl_allocator {
    void *(*allocate)(size_t size, size_t alignment, void *user);
    void (*release)(void *block, size_t size, void *user);
    void *user; ///< handed to both
} tl_allocator;

/// One item of a parallel loop. `worker` is below `tl_tasks.worker_count`; no two items that run at the
/// same time have the same one, so it may index per-worker scratch.
typedef void tl_task_fn(uint32_t index, uint32_t worker, void *task_user);

/// How a bake runs a loop of independent items on the host's own job system.
///
/// `run` calls `task(i, worker, task_user)` once for each i in [0, count), in any order and on any
/// threads, and returns when all are done. It is never called from inside a task. Results never depend
/// on the order or on worker_count.
typedef struct tl_tasks {
    void (*run)(tl_task_fn *task, uint32_t count, void *task_user, void *user);
    uint32_t worker_count; ///< >= 1
    void *user;            ///< handed to run
} tl_tasks;

/// Progress of a bake or check, and its cancellation.
///
/// It is called every 50 ms at least on a core of today, whatever the size of the input; one path search, one contour
/// and one navmesh tile are not interrupted. `update` is called on the thread that called the bake only. `stage` is a
/// static string; `done` runs from 0 (the stage begins) to `total` (it has ended), so a host with a clock can time each
/// stage. Returning false cancels: the bake frees what it holds and returns TL_ERR_CANCELLED.
typedef struct tl_progress {
    bool (*update)(const char *stage, uint64_t done, uint64_t total, void *user);
    void *user; ///< handed to update
} tl_progress;

/// The hooks that a bake calls: memory, tasks, progress. All zero is a valid host: malloc, one thread, silent.
/// The pointed-to structs must outlive the call; blobs remember none of them.
typedef struct tl_host {
    const tl_allocator *allocator; ///< NULL: malloc and free
    const tl_tasks *tasks;         ///< NULL: all runs on the calling thread
    const tl_progress *progress;   ///< NULL: silent and not cancellable
} tl_host;

/// What every def with a tl_default_..._def() ends with, in its field `cookie`: it tells a def that was begun with its
/// defaults from one that was only zeroed, whose zeros nobody chose. The latter is TL_ERR_ARGUMENT, field "cookie".
#define TL_DEF_COOKIE 0x7a1d5defu

/// No element is to blame: tl_report.element_index.
#define TL_NO_ELEMENT UINT64_MAX

/// What a bake says about itself, besides its result. A caller who does not want it passes NULL.
typedef struct tl_report {
    const char *stage;      ///< static; the stage that failed, or the last one
    const char *field;      ///< static; the def's field that was refused ("cell_size", "host.allocator"...), or NULL
    const char *element;    ///< static; kind of the offending element ("vertex", "triangle", "contour"...), or NULL
    uint64_t element_index; ///< its index in the caller's input, or TL_NO_ELEMENT
    const char *advice;     ///< static; what to do about a failure, or NULL
    uint64_t peak_bytes;    ///< largest sum of bytes that the bake held at one time
} tl_report;

/// The head of every blob: one immutable, position-independent block, 64-byte aligned, that can be stored
/// and mapped as it is. Little-endian in files (pack.h). Blobs are freed with `tl_blob_free` or by unmapping their
/// file.
typedef struct tl_blob {
    uint32_t magic;   ///< kind of the blob, four characters
    uint32_t version; ///< version of that kind's layout
    uint64_t size;    ///< bytes in all, this head included; a multiple of 64
} tl_blob;

/// Bytes that a blob's address and size are multiples of.
#define TL_BLOB_ALIGNMENT 64

/// Gives a blob back to the allocator it was baked with, which it remembers beside its bytes. NULL blob: nothing
/// happens. Every blob type begins with a tl_blob, so this serves them all. A blob that was mapped or copied from a
/// file is not freed here but with its file or its copy.
TL_API void tl_blob_free(void *blob);

#ifdef __cplusplus
}
#endif

#endif
