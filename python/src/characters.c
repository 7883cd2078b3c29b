// SPDX-License-Identifier: MIT
//
// Characters: rows of tl_character, which numpy holds, moved over a soup. A thread has a mover of its own.

#include "binding.h"

#include <stdlib.h>
#include <string.h>

#define MOVERS_NAME "talus.movers"

enum { CHARACTERS_A_TASK = 16 };

typedef struct binding_movers {
    unsigned count;
    tl_character_mover *movers[]; // one a thread
} binding_movers;

// characters.py has them as _HIT and _MOVE; and tl_character as CHARACTER.
typedef struct hit_row {
    tl_vec3 point, normal;
    int32_t triangle; // -1: none
    uint32_t surface;
    uint32_t material;
} hit_row;

typedef struct move_row {
    uint32_t landed, left_ground, blocked, hit_ceiling, stuck;
    float stepped_up, pushed;
    uint32_t hit_count;
    hit_row hits[TL_MAX_CHARACTER_HITS];
} move_row;

_Static_assert(sizeof(tl_character) == 88 && sizeof(hit_row) == 36 && sizeof(move_row) == 32 + 8 * 36,
               "characters.py has the same rows");

static void destroy_movers(binding_movers *held)
{
    for (unsigned i = 0; i < held->count; i++) {
        tl_character_mover_destroy(held->movers[i]);
    }
    free(held);
}

static void free_movers(PyObject *capsule)
{
    destroy_movers(PyCapsule_GetPointer(capsule, MOVERS_NAME));
}

// movers_create((radius, height, step height, max slope, gap, max triangles), threads) -> movers
static PyObject *movers_create(PyObject *self, PyObject *args)
{
    (void)self;
    tl_character_def def = tl_default_character_def();
    unsigned threads = 1;
    if (!PyArg_ParseTuple(args, "(fffffI)I", &def.radius, &def.height, &def.step_height, &def.max_slope, &def.gap,
                          &def.max_triangles, &threads)) {
        return NULL;
    }
    binding_movers *held = calloc(1, sizeof(*held) + threads * sizeof(tl_character_mover *));
    if (held == NULL) {
        return PyErr_NoMemory();
    }
    for (; held->count < threads; held->count++) {
        tl_report report;
        tl_result result = tl_character_mover_create(&def, &held->movers[held->count], &report);
        if (result != TL_OK) {
            destroy_movers(held);
            return binding_raise(result, &report);
        }
    }
    PyObject *capsule = PyCapsule_New(held, MOVERS_NAME, free_movers);
    if (capsule == NULL) {
        destroy_movers(held);
    }
    return capsule;
}

typedef struct move_batch {
    const binding_movers *movers;
    tl_character_level level;
    tl_character *characters;
    const tl_vec3 *velocities;
    const uint8_t *leaves; // ground
    float seconds;
    uint32_t count;
    move_row *moves;
    // One a task: its first failure.
    tl_result *results;
    tl_report *reports;
    uint32_t *failed;
} move_batch;

static void fill_move(move_row *row, const tl_character_report *report)
{
    memset(row, 0, sizeof(*row));
    row->landed = report->landed;
    row->left_ground = report->left_ground;
    row->blocked = report->blocked;
    row->hit_ceiling = report->hit_ceiling;
    row->stuck = report->stuck;
    row->stepped_up = report->stepped_up;
    row->pushed = report->pushed;
    row->hit_count = report->hit_count;
    for (uint32_t i = 0; i < TL_MAX_CHARACTER_HITS; i++) {
        bool is_hit = i < report->hit_count;
        const tl_character_hit *hit = &report->hits[i];
        row->hits[i].triangle = is_hit ? (int32_t)hit->triangle : -1;
        if (is_hit) {
            row->hits[i].point = hit->point;
            row->hits[i].normal = hit->normal;
            row->hits[i].surface = (uint32_t)hit->surface;
            row->hits[i].material = hit->material;
        }
    }
}

static void move_some(uint32_t task, uint32_t worker, void *user)
{
    const move_batch *batch = user;
    uint32_t first = task * CHARACTERS_A_TASK;
    uint32_t end = batch->count - first > CHARACTERS_A_TASK ? first + CHARACTERS_A_TASK : batch->count;
    batch->results[task] = TL_OK;
    for (uint32_t i = first; i < end; i++) {
        tl_character_step step = { batch->velocities[i], batch->seconds, batch->leaves[i] != 0 };
        tl_character_report report;
        tl_result result =
            tl_character_move(batch->movers->movers[worker], &batch->level, &step, &batch->characters[i], &report);
        if (result != TL_OK) {
            batch->results[task] = result;
            batch->reports[task] = report.base;
            batch->failed[task] = i;
            return;
        }
        fill_move(&batch->moves[i], &report);
    }
}

// Moves all; false: an exception names the first that failed.
static bool move_batch_run(move_batch *batch)
{
    uint32_t tasks = (batch->count + CHARACTERS_A_TASK - 1) / CHARACTERS_A_TASK;
    size_t size = sizeof(tl_report) + sizeof(tl_result) + sizeof(uint32_t);
    tl_report *reports = tasks > 0 ? malloc(tasks * size) : NULL;
    if (reports == NULL) {
        if (tasks > 0) {
            PyErr_NoMemory();
        }
        return tasks == 0;
    }
    batch->reports = reports;
    batch->results = (tl_result *)(void *)(reports + tasks);
    batch->failed = (uint32_t *)(void *)(batch->results + tasks);
    binding_host host;
    binding_begin(&host, Py_None, batch->movers->count);
    host.tasks.run(move_some, tasks, batch, host.tasks.user);
    binding_end(&host);
    bool good = true;
    for (uint32_t i = 0; good && i < tasks; i++) {
        good = batch->results[i] == TL_OK;
        if (!good) {
            batch->reports[i].element = "character";
            batch->reports[i].element_index = batch->failed[i];
            binding_raise(batch->results[i], &batch->reports[i]);
        }
    }
    free(reports);
    return good;
}

// movers_move(movers, soup, ignored, characters, velocities f32[n][3], leaves u8[n], seconds, moves)
static PyObject *movers_move(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *soup;
    unsigned long long ignored = 0;
    Py_buffer b[4];
    memset(b, 0, sizeof(b));
    move_batch batch;
    memset(&batch, 0, sizeof(batch));
    if (!PyArg_ParseTuple(args, "OOKw*y*y*fw*", &capsule, &soup, &ignored, &b[0], &b[1], &b[2], &batch.seconds,
                          &b[3])) {
        return NULL;
    }
    tl_ray_filter filter;
    memset(&filter, 0, sizeof(filter));
    filter.ignored_materials = ignored;
    batch.movers = PyCapsule_GetPointer(capsule, MOVERS_NAME);
    batch.level.soup = batch.movers != NULL ? binding_blob_of(soup, BINDING_SOUP) : NULL;
    batch.level.soup_filter = ignored != 0 ? &filter : NULL;
    Py_ssize_t count = batch.level.soup != NULL ? binding_count(&b[0], sizeof(tl_character), "characters") : -1;
    bool good = count >= 0 && binding_has(&b[1], sizeof(tl_vec3), count, false, "velocities") &&
                binding_has(&b[2], 1, count, false, "leave_ground") &&
                binding_has(&b[3], sizeof(move_row), count, false, "moves");
    if (good && count > (Py_ssize_t)(UINT32_MAX / 2)) {
        PyErr_SetString(PyExc_ValueError, "more than 2 G characters in one batch");
        good = false;
    }
    if (good) {
        batch.characters = b[0].buf;
        batch.velocities = b[1].buf;
        batch.leaves = b[2].buf;
        batch.moves = b[3].buf;
        batch.count = (uint32_t)count;
        good = move_batch_run(&batch);
    }
    binding_release(b, 4);
    return good ? Py_NewRef(Py_None) : NULL;
}

PyMethodDef binding_character_methods[] = {
    { "movers_create", movers_create, METH_VARARGS, NULL },
    { "movers_move", movers_move, METH_VARARGS, NULL },
    { NULL, NULL, 0, NULL },
};
