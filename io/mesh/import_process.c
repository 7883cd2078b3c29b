// SPDX-License-Identifier: MIT
//
// A child process reads, the parent receives: the result and error as they are, then the arrays, then the names.
//
// Both are one program, so structs go through the pipe as they lie in memory. A file may have made the child into
// anything, so none of what it says is believed unseen.

#define _GNU_SOURCE

#include "io/mesh/import_process.h"

#include "io/files/growable.h"
#include "io/mesh/import_sandbox.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
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

enum { PROGRESS_MILLISECONDS = 250, BASE_SECONDS = 10, BYTES_A_SECOND = 1000000, WALL_FACTOR = 4, MEMORY_FACTOR = 64 };

static const uint64_t base_memory = (uint64_t)4 << 30;

// What the child says first. The mesh's pointers are the child's own.
typedef struct message {
    tl_result result;
    bool in_sandbox;
    tl_io_error error;
    tl_imported_mesh mesh;
} message;

// The limits in use.
typedef struct child_limits {
    uint64_t processor_seconds;
    uint64_t wall_seconds;
    uint64_t memory_bytes;
} child_limits;

typedef struct receiver {
    int pipe;
    const tl_mesh_source *source;
    const tl_host *host;
    tl_io_error *error;
    child_limits limits;
    struct timespec start;
} receiver;

static child_limits choose_limits(const tl_import_limits *limits, size_t size)
{
    child_limits result;
    result.processor_seconds = BASE_SECONDS + size / BYTES_A_SECOND;
    result.wall_seconds = result.processor_seconds * WALL_FACTOR;
    result.memory_bytes = base_memory + (uint64_t)size * MEMORY_FACTOR;
    if (limits != NULL && limits->seconds > 0) {
        result.processor_seconds = result.wall_seconds = limits->seconds;
    }
    if (limits != NULL && limits->memory_bytes > 0) {
        result.memory_bytes = limits->memory_bytes;
    }
    return result;
}

// --- the child ------------------------------------------------------------------------------------------------------

static bool send_bytes(int pipe, const void *bytes, size_t size)
{
    const char *at = bytes;
    while (size > 0) {
        ssize_t put = write(pipe, at, size);
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

static void limit_child(const child_limits *limits)
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
static void run_child(int pipe, tl_mesh_reader *read_mesh, const tl_mesh_source *source, const child_limits *limits)
{
    limit_child(limits);
    message sent;
    memset(&sent, 0, sizeof sent);
#ifndef HAS_SHADOW_MEMORY // sanitizers ask for more when they report
    sent.in_sandbox = tl_enter_import_sandbox(pipe);
#endif
    sent.result = read_mesh(source, NULL, &sent.mesh, &sent.error);
    const tl_imported_mesh *mesh = &sent.mesh;
    size_t triangles = mesh->triangle_count;
    bool all = send_bytes(pipe, &sent, sizeof sent);
    if (sent.result == TL_OK) {
        all = all && send_bytes(pipe, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices) &&
              send_bytes(pipe, mesh->indices, triangles * 3 * sizeof *mesh->indices) &&
              send_bytes(pipe, mesh->materials, triangles * sizeof *mesh->materials) &&
              send_bytes(pipe, mesh->names.text, mesh->names.text_size);
    }
    _exit(all ? 0 : 1);
}

// --- the parent -----------------------------------------------------------------------------------------------------

static bool is_out_of_time(const receiver *from)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec - from->start.tv_sec >= (time_t)from->limits.wall_seconds;
}

static tl_result fail_time(const receiver *from)
{
    return tl_io_fail(from->error, TL_ERR_LIMIT, from->source->name, 0,
                      "open it in a modelling tool and export it as OBJ", "its reader was ended after %llu s",
                      (unsigned long long)from->limits.wall_seconds);
}

// TL_ERR_TRUNCATED when the child ended before all was there.
static tl_result receive_bytes(receiver *from, void *bytes, size_t size)
{
    char *at = bytes;
    while (size > 0) {
        struct pollfd waiting = { from->pipe, POLLIN, 0 };
        int ready = poll(&waiting, 1, PROGRESS_MILLISECONDS);
        if (is_out_of_time(from)) {
            return fail_time(from);
        }
        if (ready <= 0) {
            if (tl_io_progress(from->host, "read mesh", 0, from->source->size) != TL_OK) {
                return tl_io_fail(from->error, TL_ERR_CANCELLED, from->source->name, 0, NULL, "cancelled");
            }
            continue;
        }
        ssize_t got = read(from->pipe, at, size);
        if (got == 0 || (got < 0 && errno != EINTR)) {
            return TL_ERR_TRUNCATED;
        }
        if (got > 0) {
            at += got;
            size -= (size_t)got;
        }
    }
    return TL_OK;
}

static tl_result receive_names(receiver *from, size_t text_size, tl_imported_mesh *mesh)
{
    char *text = text_size < SIZE_MAX ? tl_io_allocate(&mesh->allocator, text_size + 1) : NULL;
    if (text == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_result result = receive_bytes(from, text, text_size);
    for (size_t at = 0; result == TL_OK && at < text_size;) {
        uint32_t id;
        size_t length = strnlen(text + at, text_size - at);
        result = tl_name_table_add(&mesh->names, &mesh->allocator, text + at, length, TL_MAX_IMPORTED_MATERIALS, &id);
        at += length + 1;
    }
    tl_io_release(&mesh->allocator, text, text_size + 1);
    return result == TL_ERR_LIMIT && mesh->names.count == TL_MAX_IMPORTED_MATERIALS ? TL_ERR_CORRUPT : result;
}

// What every reader promises of a mesh (imported_mesh.h).
static bool is_sound_mesh(const tl_imported_mesh *mesh)
{
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        if (!tl_is_finite(mesh->vertices[i])) {
            return false;
        }
    }
    for (size_t i = 0; i < (size_t)mesh->triangle_count * 3; i++) {
        if (mesh->indices[i] >= mesh->vertex_count) {
            return false;
        }
    }
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        if (mesh->materials[i] >= mesh->names.count) {
            return false;
        }
    }
    return true;
}

static tl_result receive_mesh(receiver *from, const tl_imported_mesh *sent, tl_imported_mesh *mesh)
{
    size_t triangles = sent->triangle_count;
    if (sent->vertex_count > TL_MAX_MESH_VERTICES || triangles > TL_MAX_MESH_TRIANGLES) {
        return TL_ERR_CORRUPT;
    }
    tl_result result = tl_imported_mesh_reserve_vertices(mesh, sent->vertex_count);
    result = result != TL_OK ? result : tl_imported_mesh_reserve_triangles(mesh, triangles);
    result =
        result != TL_OK ? result : receive_bytes(from, mesh->vertices, sent->vertex_count * sizeof *mesh->vertices);
    result = result != TL_OK ? result : receive_bytes(from, mesh->indices, triangles * 3 * sizeof *mesh->indices);
    result = result != TL_OK ? result : receive_bytes(from, mesh->materials, triangles * sizeof *mesh->materials);
    result = result != TL_OK ? result : receive_names(from, sent->names.text_size, mesh);
    if (result != TL_OK) {
        return result;
    }
    if (triangles > 0) {
        memset(mesh->source_lines, 0, triangles * sizeof *mesh->source_lines);
    }
    mesh->vertex_count = sent->vertex_count;
    mesh->triangle_count = sent->triangle_count;
    mesh->source_bytes = from->source->size;
    mesh->face_count = sent->face_count;
    mesh->polygon_count = sent->polygon_count;
    mesh->clipped_count = sent->clipped_count;
    mesh->crooked_count = sent->crooked_count;
    mesh->ignored_points = sent->ignored_points;
    mesh->ignored_lines = sent->ignored_lines;
    mesh->mirrored_nodes = sent->mirrored_nodes;
    mesh->file_unit = isfinite(sent->file_unit) && sent->file_unit > 0.0f ? sent->file_unit : 0.0f;
    mesh->file_up = sent->file_up >= -3 && sent->file_up <= 3 ? sent->file_up : 0;
    return is_sound_mesh(mesh) ? TL_OK : TL_ERR_CORRUPT;
}

// A failure as the child tells it, its texts ended and made printable.
static tl_result receive_error(const receiver *from, message *received)
{
    tl_io_error *told = &received->error;
    told->message[sizeof told->message - 1] = told->advice[sizeof told->advice - 1] = '\0';
    told->element[sizeof told->element - 1] = '\0';
    if (received->result == TL_ERR_MEMORY) {
        return tl_io_fail(from->error, TL_ERR_LIMIT, from->source->name, 0, "cut the level into parts",
                          "it needs more than %llu MB of memory to be read",
                          (unsigned long long)(from->limits.memory_bytes / 1000000));
    }
    tl_result result = tl_is_error(received->result) ? received->result : TL_ERR_FORMAT;
    tl_io_fail(from->error, result, from->source->name, told->line, told->advice, "%s", told->message);
    return tl_io_blame(from->error, result, told->element, told->element_index);
}

static tl_result receive_all(receiver *from, tl_imported_mesh *mesh)
{
    message received;
    tl_result result = receive_bytes(from, &received, sizeof received);
    if (result == TL_OK && received.result != TL_OK) {
        return receive_error(from, &received);
    }
    if (result == TL_OK) {
        result = receive_mesh(from, &received.mesh, mesh);
        mesh->isolation = received.in_sandbox ? TL_ISOLATION_SANDBOX : TL_ISOLATION_PROCESS;
    }
    if (result == TL_ERR_MEMORY) {
        return tl_io_fail(from->error, result, from->source->name, 0, NULL, "out of memory");
    }
    if (result == TL_ERR_CORRUPT) {
        return tl_io_fail(from->error, TL_ERR_FORMAT, from->source->name, 0, "it is damaged; export it again",
                          "its reader made no sound mesh of it");
    }
    return result;
}

// Why the child ended early.
static tl_result explain_death(const receiver *from, int status)
{
    const char *name = from->source->name;
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) {
        return tl_io_fail(from->error, TL_ERR_LIMIT, name, 0, "open it in a modelling tool and export it as OBJ",
                          "its reader was ended: more than %llu s of processor time, or too little memory",
                          (unsigned long long)from->limits.processor_seconds);
    }
    return tl_io_fail(from->error, TL_ERR_FORMAT, name, 0, "it is damaged; export it again",
                      "its reader failed on it (%s)",
                      WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "it ended early");
}

// Closed in programs that other threads start meanwhile.
static int open_pipe(int ends[2])
{
#ifdef __linux__
    return pipe2(ends, O_CLOEXEC);
#else
    return pipe(ends) == 0 && fcntl(ends[0], F_SETFD, FD_CLOEXEC) != -1 ? fcntl(ends[1], F_SETFD, FD_CLOEXEC) : -1;
#endif
}

tl_result tl_read_isolated(tl_mesh_reader *read_mesh, const tl_mesh_source *source, const tl_import_limits *limits,
                           const tl_host *host, tl_imported_mesh *mesh_out, tl_io_error *error_out)
{
    receiver from = { -1, source, host, error_out, choose_limits(limits, source->size), { 0, 0 } };
    memset(mesh_out, 0, sizeof *mesh_out);
    int ends[2];
    if (open_pipe(ends) != 0) {
        return tl_io_fail_system(error_out, source->name, "start a process to read it", errno);
    }
    clock_gettime(CLOCK_MONOTONIC, &from.start);
    pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        run_child(ends[1], read_mesh, source, &from.limits);
    }
    int refused = errno;
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        return tl_io_fail_system(error_out, source->name, "start a process to read it", refused);
    }
    from.pipe = ends[0];
    tl_imported_mesh_init(mesh_out, host != NULL ? host->allocator : NULL);
    tl_result result = receive_all(&from, mesh_out);
    close(ends[0]);
    kill(child, SIGKILL); // it has nothing more to say; how it ended, if it has, stands already
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (result == TL_ERR_TRUNCATED) {
        result = explain_death(&from, status);
    }
    if (result != TL_OK) {
        tl_imported_mesh_free(mesh_out);
    }
    return result;
}
