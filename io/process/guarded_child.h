// SPDX-License-Identifier: MIT
//
// Work that may crash, hang or take all memory, done by a process of its own, whose answer comes through a pipe.
//
// POSIX forks: the child has all that its parent has. Windows starts the calling program anew, which does the work
// where its main calls tl_child_main, as multiprocessing.freeze_support of Python has it; what it is given goes there
// through shared memory. Both sides are one program, so structs may go through the pipe as they lie in memory, but
// pointers mean nothing on the other side. What a child says must be checked like any stranger's words: its input may
// have made it into anything.

#ifndef TALUS_IO_GUARDED_CHILD_H
#define TALUS_IO_GUARDED_CHILD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct tl_child_limits {
    uint64_t processor_seconds;
    uint64_t wall_seconds;
    uint64_t memory_bytes; ///< beyond what the parent has; not limited where a sanitizer keeps a shadow of it
} tl_child_limits;

typedef struct tl_child_pipe tl_child_pipe;
typedef struct tl_child_task tl_child_task;
typedef struct tl_child tl_child;

/// Done in the child. `in_sandbox`: the system refuses it all but memory, reading files, and its pipe
/// (child_sandbox.h).
typedef void tl_child_work(const tl_child_task *task, bool in_sandbox, tl_child_pipe *answer);

/// Any function of the program, whose address the child is told in its own terms.
typedef void tl_child_function(void);

enum { TL_CHILD_MAX_PARTS = 6, TL_CHILD_HOW_BYTES = 64 };

struct tl_child_task {
    tl_child_work *work;
    tl_child_function *function; ///< for `work`
    const void *parts[TL_CHILD_MAX_PARTS];
    size_t part_sizes[TL_CHILD_MAX_PARTS]; ///< 0 and NULL: nothing
};

/// False where it would run the caller's main in the child: on Windows before tl_child_main was called.
bool tl_child_is_possible(void);

/// See tl_import_child_main.
void tl_child_main(void);

/// Starts the work. 0, or an errno that says why not. The task must live until the child's end.
int tl_child_start(const tl_child_task *task, const tl_child_limits *limits, tl_child **child_out);

/// In the child: false when the parent is gone.
bool tl_child_send(tl_child_pipe *answer, const void *bytes, size_t size);

enum {
    TL_CHILD_NOTHING_YET = 0, ///< nothing came for a quarter of a second
    TL_CHILD_ENDED = -1,      ///< it has closed its side
    TL_CHILD_OUT_OF_TIME = -2
};

/// In the parent: how many bytes came, at most `size` (> 0), or one of the above.
ptrdiff_t tl_child_receive(tl_child *child, void *bytes, size_t size);

/// How a child ended that ended by itself.
typedef struct tl_child_end {
    bool by_limit;
    char how[TL_CHILD_HOW_BYTES]; ///< in the system's words
} tl_child_end;

/// Ends the child, if it still runs, and frees it.
void tl_child_close(tl_child *child, tl_child_end *end_out);

#endif
