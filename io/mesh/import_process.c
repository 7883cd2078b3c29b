// SPDX-License-Identifier: MIT
//
// A child process reads, the parent receives: the result and error as they are, then the arrays, then the names. None
// of what the child says is believed unseen.

#include "io/mesh/import_process.h"

#include "io/files/growable.h"
#include "io/process/guarded_child.h"

#include <math.h>
#include <string.h>

enum { BASE_SECONDS = 10, BYTES_A_SECOND = 1000000, WALL_FACTOR = 4, MEMORY_FACTOR = 64 };

static const uint64_t base_memory = (uint64_t)4 << 30;

// What the child says first. The mesh's pointers are the child's own.
typedef struct message {
    tl_result result;
    bool in_sandbox;
    tl_io_error error;
    tl_imported_mesh mesh;
} message;

// What the task's parts are.
enum { PART_SETTINGS, PART_FILE, PART_NAME, PART_PATH, PART_KIND };

typedef struct source_settings {
    bool allow_no_triangles;
    double origin[3];
} source_settings;

static tl_child_limits choose_limits(const tl_import_limits *limits, size_t size)
{
    tl_child_limits result;
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

static void send_mesh(tl_child_pipe *answer, const message *sent)
{
    const tl_imported_mesh *mesh = &sent->mesh;
    const size_t triangles = mesh->triangle_count;
    if (tl_child_send(answer, sent, sizeof *sent) && sent->result == TL_OK &&
        tl_child_send(answer, mesh->vertices, mesh->vertex_count * sizeof *mesh->vertices) &&
        tl_child_send(answer, mesh->indices, triangles * 3 * sizeof *mesh->indices) &&
        tl_child_send(answer, mesh->materials, triangles * sizeof *mesh->materials)) {
        tl_child_send(answer, mesh->names.text, mesh->names.text_size);
    }
}

static void read_and_send(const tl_child_task *task, bool in_sandbox, tl_child_pipe *answer)
{
    const source_settings *settings = task->parts[PART_SETTINGS];
    const double *o = settings->origin;
    const tl_mesh_source source = { task->parts[PART_NAME],      task->parts[PART_PATH], task->parts[PART_FILE],
                                    task->part_sizes[PART_FILE], task->parts[PART_KIND], settings->allow_no_triangles,
                                    { o[0], o[1], o[2] } };
    tl_mesh_reader *read_mesh = (tl_mesh_reader *)task->function;
    message sent;
    memset(&sent, 0, sizeof sent);
    sent.in_sandbox = in_sandbox;
    sent.result = read_mesh(&source, NULL, &sent.mesh, &sent.error);
    send_mesh(answer, &sent);
}

// --- the parent -----------------------------------------------------------------------------------------------------

typedef struct receiver {
    tl_child *child;
    const tl_mesh_source *source;
    const tl_host *host;
    tl_io_error *error;
    tl_child_limits limits;
} receiver;

// TL_ERR_TRUNCATED when the child ended before all was there.
static tl_result receive_bytes(const receiver *from, void *bytes, size_t size)
{
    char *at = bytes;
    while (size > 0) {
        const ptrdiff_t got = tl_child_receive(from->child, at, size);
        if (got == TL_CHILD_ENDED) {
            return TL_ERR_TRUNCATED;
        }
        if (got == TL_CHILD_OUT_OF_TIME) {
            return tl_io_fail(from->error, TL_ERR_LIMIT, from->source->name, 0,
                              "open it in a modelling tool and export it as OBJ", "its reader was ended after %llu s",
                              (unsigned long long)from->limits.wall_seconds);
        }
        if (got == TL_CHILD_NOTHING_YET && tl_io_progress(from->host, "read mesh", 0, from->source->size) != TL_OK) {
            return tl_io_fail(from->error, TL_ERR_CANCELLED, from->source->name, 0, NULL, "cancelled");
        }
        at += got;
        size -= (size_t)got;
    }
    return TL_OK;
}

static tl_result receive_names(const receiver *from, size_t text_size, tl_imported_mesh *mesh)
{
    char *text = text_size < SIZE_MAX ? tl_io_allocate(&mesh->allocator, text_size + 1) : NULL;
    if (text == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_result result = receive_bytes(from, text, text_size);
    text[text_size] = '\0'; // whatever the child's last name ends with
    for (size_t at = 0; result == TL_OK && at < text_size;) {
        uint32_t id;
        size_t length = strlen(text + at);
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

static tl_result receive_arrays(const receiver *from, const tl_imported_mesh *sent, tl_imported_mesh *mesh)
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

static tl_result receive_mesh(const receiver *from, tl_imported_mesh *mesh)
{
    message received;
    tl_result result = receive_bytes(from, &received, sizeof received);
    if (result == TL_OK && received.result != TL_OK) {
        return receive_error(from, &received);
    }
    if (result == TL_OK) {
        result = receive_arrays(from, &received.mesh, mesh);
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

// Why the child ended before all was there.
static tl_result explain_end(const receiver *from, const tl_child_end *end)
{
    const char *name = from->source->name;
    if (end->by_limit) {
        return tl_io_fail(from->error, TL_ERR_LIMIT, name, 0, "open it in a modelling tool and export it as OBJ",
                          "its reader was ended: more than %llu s of processor time, or too little memory",
                          (unsigned long long)from->limits.processor_seconds);
    }
    return tl_io_fail(from->error, TL_ERR_FORMAT, name, 0, "it is damaged; export it again",
                      "its reader failed on it (%s)", end->how);
}

static void give_text(tl_child_task *task, int part, const char *text)
{
    task->parts[part] = text;
    task->part_sizes[part] = text != NULL ? strlen(text) + 1 : 0;
}

static tl_result read_in_child(tl_mesh_reader *read_mesh, receiver *from, tl_imported_mesh *mesh)
{
    const tl_mesh_source *source = from->source;
    const double *o = source->origin;
    const source_settings settings = { source->allow_no_triangles, { o[0], o[1], o[2] } };
    tl_child_task task;
    memset(&task, 0, sizeof task);
    task.work = read_and_send;
    task.function = (tl_child_function *)read_mesh;
    task.parts[PART_SETTINGS] = &settings;
    task.part_sizes[PART_SETTINGS] = sizeof settings;
    task.parts[PART_FILE] = source->bytes;
    task.part_sizes[PART_FILE] = source->size;
    give_text(&task, PART_NAME, source->name);
    give_text(&task, PART_PATH, source->path);
    give_text(&task, PART_KIND, source->kind);
    const int refused = tl_child_start(&task, &from->limits, &from->child);
    if (refused != 0) {
        return tl_io_fail_system(from->error, source->name, "start a process to read it", refused);
    }
    const tl_result result = receive_mesh(from, mesh);
    tl_child_end end;
    tl_child_close(from->child, &end);
    return result == TL_ERR_TRUNCATED ? explain_end(from, &end) : result;
}

tl_result tl_read_isolated(tl_mesh_reader *read_mesh, const tl_mesh_source *source, const tl_import_limits *limits,
                           const tl_host *host, tl_imported_mesh *mesh_out, tl_io_error *error_out)
{
    const tl_allocator *allocator = host != NULL ? host->allocator : NULL;
    memset(mesh_out, 0, sizeof *mesh_out);
    if (!tl_child_is_possible()) {
        if (limits != NULL && (limits->seconds > 0 || limits->memory_bytes > 0)) {
            return tl_io_fail(error_out, TL_ERR_UNSUPPORTED, source->name, 0, "call tl_import_child_main first in main",
                              "limits need a process that reads");
        }
        return read_mesh(source, allocator, mesh_out, error_out);
    }
    receiver from = { NULL, source, host, error_out, choose_limits(limits, source->size) };
    tl_imported_mesh_init(mesh_out, allocator);
    const tl_result result = read_in_child(read_mesh, &from, mesh_out);
    if (result != TL_OK) {
        tl_imported_mesh_free(mesh_out);
    }
    return result;
}

void tl_import_child_main(void)
{
    tl_child_main();
}
