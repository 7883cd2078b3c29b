// SPDX-License-Identifier: MIT
//
// A child process reads, the parent receives: the result and error as they are, then the arrays, then the names.
//
// Both are one program, so structs go through the pipe as they lie in memory, and static texts have the same addresses.

#define _GNU_SOURCE

#include "io/mesh/assimp_process.h"

#include "io/files/growable.h"
#include "io/mesh/assimp_reader.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PROGRESS_MILLISECONDS = 250, BASE_SECONDS = 10, BYTES_A_SECOND = 1000000 };

// What the child says first. The mesh's pointers are the child's own.
typedef struct message {
    tl_result result;
    tl_io_error error;
    tl_imported_mesh mesh;
} message;

typedef struct receiver {
    int pipe;
    pid_t child;
    const char *path;
    const tl_host *host;
    tl_io_error *error;
    size_t source_bytes;
} receiver;

static rlim_t time_limit(size_t size)
{
    return BASE_SECONDS + size / BYTES_A_SECOND;
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

static void limit_child(size_t size)
{
    struct rlimit time = { time_limit(size), time_limit(size) };
    struct rlimit no_core = { 0, 0 };
    setrlimit(RLIMIT_CPU, &time);
    setrlimit(RLIMIT_CORE, &no_core);
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
static void run_child(int pipe, const tl_assimp_source *source)
{
    limit_child(source->size);
    message sent;
    memset(&sent, 0, sizeof sent);
    sent.result = tl_assimp_read(source, NULL, &sent.mesh, &sent.error);
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

// TL_ERR_TRUNCATED when the child ended before all was there.
static tl_result receive_bytes(receiver *from, void *bytes, size_t size)
{
    char *at = bytes;
    while (size > 0) {
        struct pollfd waiting = { from->pipe, POLLIN, 0 };
        int ready = poll(&waiting, 1, PROGRESS_MILLISECONDS);
        if (ready <= 0) {
            if (tl_io_progress(from->host, "read mesh", 0, from->source_bytes) != TL_OK) {
                return tl_io_fail(from->error, TL_ERR_CANCELLED, from->path, 0, NULL, "cancelled");
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
    char *text = tl_io_allocate(&mesh->allocator, text_size + 1);
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
    return result;
}

static tl_result receive_mesh(receiver *from, const tl_imported_mesh *sent, tl_imported_mesh *mesh)
{
    size_t triangles = sent->triangle_count;
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
    mesh->format = sent->format;
    mesh->source_bytes = sent->source_bytes;
    mesh->face_count = sent->face_count;
    mesh->polygon_count = sent->polygon_count;
    mesh->clipped_count = sent->clipped_count;
    mesh->crooked_count = sent->crooked_count;
    mesh->ignored_points = sent->ignored_points;
    mesh->ignored_lines = sent->ignored_lines;
    mesh->mirrored_nodes = sent->mirrored_nodes;
    return TL_OK;
}

static tl_result receive_all(receiver *from, tl_imported_mesh *mesh)
{
    message received;
    tl_result result = receive_bytes(from, &received, sizeof received);
    if (result == TL_OK && received.result != TL_OK) {
        if (from->error != NULL) {
            *from->error = received.error;
        }
        return received.result;
    }
    if (result == TL_OK) {
        result = receive_mesh(from, &received.mesh, mesh);
    }
    return result == TL_ERR_MEMORY ? tl_io_fail(from->error, result, from->path, 0, NULL, "out of memory") : result;
}

// Why the child ended early.
static tl_result explain_death(const receiver *from, int status)
{
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) {
        return tl_io_fail(from->error, TL_ERR_LIMIT, from->path, 0, "open it in a modelling tool and export it as OBJ",
                          "Assimp was ended: more than %llu s of processor time, or too little memory",
                          (unsigned long long)time_limit(from->source_bytes));
    }
    return tl_io_fail(from->error, TL_ERR_FORMAT, from->path, 0, "it is damaged; export it again",
                      "Assimp failed on it (%s)", WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "it ended early");
}

tl_result tl_assimp_read_isolated(const tl_assimp_source *source, const tl_host *host, tl_imported_mesh *mesh_out,
                                  tl_io_error *error_out)
{
    const char *path = source->path;
    memset(mesh_out, 0, sizeof *mesh_out);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) {
        return tl_io_fail_system(error_out, path, "start a process to read it", errno);
    }
    pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        run_child(ends[1], source);
    }
    int refused = errno;
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        return tl_io_fail_system(error_out, path, "start a process to read it", refused);
    }
    tl_imported_mesh_init(mesh_out, host != NULL ? host->allocator : NULL);
    receiver from = { ends[0], child, path, host, error_out, source->size };
    tl_result result = receive_all(&from, mesh_out);
    close(ends[0]);
    if (result != TL_OK && result != TL_ERR_TRUNCATED) {
        kill(child, SIGKILL);
    }
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
