// SPDX-License-Identifier: MIT
//
// POSIX: a fork works, and its parent listens.

#define _GNU_SOURCE

#include "io/process/guarded_child.h"

#include "io/process/child_sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__)
#define HAS_SHADOW_MEMORY 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer)
#define HAS_SHADOW_MEMORY 1
#endif
#endif

enum { WAIT_MILLISECONDS = 250 };

struct tl_child_pipe {
    int end;
};

struct tl_child {
    int pipe;
    pid_t process;
    uint64_t wall_seconds;
    struct timespec start;
};

bool tl_child_is_possible(void)
{
    return true;
}

void tl_child_main(void)
{
}

// --- the child ------------------------------------------------------------------------------------------------------

bool tl_child_send(tl_child_pipe *answer, const void *bytes, size_t size)
{
    const char *at = bytes;
    while (size > 0) {
        ssize_t put = write(answer->end, at, size);
        if (put < 0 && errno != EINTR) {
            return false;
        }
        if (put > 0) {
            at += put;
            size -= (size_t)put;
        }
    }
    return true;
}

#ifndef HAS_SHADOW_MEMORY
// Bytes of data that the process has now, which a child inherits; 0 where the system does not say.
static uint64_t current_data(void)
{
    unsigned long long pages = 0;
    FILE *file = fopen("/proc/self/statm", "re");
    if (file != NULL) {
        if (fscanf(file, "%*u %*u %*u %*u %*u %llu", &pages) != 1) {
            pages = 0;
        }
        fclose(file);
    }
    return (uint64_t)pages * (uint64_t)sysconf(_SC_PAGESIZE);
}
#endif

static void limit_memory(uint64_t bytes)
{
#ifdef HAS_SHADOW_MEMORY
    (void)bytes; // the shadow is data too
#else
    uint64_t total = current_data() + bytes;
    // Where a limit is a word of 32 bits, larger ones are more than there are addresses.
    const rlim_t words = total < (uint64_t)RLIM_INFINITY ? (rlim_t)total : RLIM_INFINITY;
    struct rlimit memory = { words, words };
    setrlimit(RLIMIT_DATA, &memory);
#endif
}

static void limit_child(const tl_child_limits *limits)
{
    struct rlimit time = { (rlim_t)limits->processor_seconds, (rlim_t)limits->processor_seconds };
    struct rlimit none = { 0, 0 };
    setrlimit(RLIMIT_CPU, &time);
    setrlimit(RLIMIT_CORE, &none);
    setrlimit(RLIMIT_FSIZE, &none); // it has nothing to write to a file
    limit_memory(limits->memory_bytes);
    // Whatever the program does on these is none of the child's business, and its last words are not for the user.
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    signal(SIGABRT, SIG_DFL);
    signal(SIGXCPU, SIG_DFL);
    int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0) {
        dup2(nowhere, STDERR_FILENO);
        dup2(nowhere, STDOUT_FILENO);
    }
}

// Does not return. _exit: nothing of the parent's (buffers, exit handlers) is to run twice.
static void run_child(int pipe, const tl_child_task *task, const tl_child_limits *limits)
{
    limit_child(limits);
    bool in_sandbox = false;
#ifndef HAS_SHADOW_MEMORY // sanitizers ask for more when they report
    in_sandbox = tl_enter_child_sandbox(pipe);
#endif
    tl_child_pipe answer = { pipe };
    task->work(task, in_sandbox, &answer);
    _exit(0);
}

// --- the parent -----------------------------------------------------------------------------------------------------

// Closed in programs that other threads start meanwhile.
static int open_pipe(int ends[2])
{
#ifdef __linux__
    return pipe2(ends, O_CLOEXEC);
#else
    return pipe(ends) == 0 && fcntl(ends[0], F_SETFD, FD_CLOEXEC) != -1 ? fcntl(ends[1], F_SETFD, FD_CLOEXEC) : -1;
#endif
}

int tl_child_start(const tl_child_task *task, const tl_child_limits *limits, tl_child **child_out)
{
    tl_child *child = malloc(sizeof *child);
    int ends[2];
    if (child == NULL || open_pipe(ends) != 0) {
        const int refused = child == NULL ? ENOMEM : errno;
        free(child);
        return refused;
    }
    child->wall_seconds = limits->wall_seconds;
    clock_gettime(CLOCK_MONOTONIC, &child->start);
    child->process = fork();
    if (child->process == 0) {
        close(ends[0]);
        run_child(ends[1], task, limits);
    }
    const int refused = child->process < 0 ? errno : 0;
    close(ends[1]);
    child->pipe = ends[0];
    if (refused != 0) {
        close(ends[0]);
        free(child);
        return refused;
    }
    *child_out = child;
    return 0;
}

static bool is_out_of_time(const tl_child *child)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec - child->start.tv_sec >= (time_t)child->wall_seconds;
}

ptrdiff_t tl_child_receive(tl_child *child, void *bytes, size_t size)
{
    struct pollfd waiting = { child->pipe, POLLIN, 0 };
    const int ready = poll(&waiting, 1, WAIT_MILLISECONDS);
    if (is_out_of_time(child)) {
        return TL_CHILD_OUT_OF_TIME;
    }
    const ssize_t got = ready > 0 ? read(child->pipe, bytes, size) : -1;
    if (ready <= 0 || (got < 0 && errno == EINTR)) {
        return TL_CHILD_NOTHING_YET;
    }
    return got > 0 ? (ptrdiff_t)got : TL_CHILD_ENDED;
}

void tl_child_close(tl_child *child, tl_child_end *end_out)
{
    close(child->pipe);
    kill(child->process, SIGKILL); // it has nothing more to say; how it ended, if it has, stands already
    int status = 0;
    while (waitpid(child->process, &status, 0) < 0 && errno == EINTR) {
    }
    const int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    end_out->by_limit = number == SIGXCPU || number == SIGKILL;
    snprintf(end_out->how, sizeof end_out->how, "%s", number != 0 ? strsignal(number) : "it ended early");
    free(child);
}
