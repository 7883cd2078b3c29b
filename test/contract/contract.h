// SPDX-License-Identifier: MIT
//
// One contract over all public functions, held by one table: see test_contract.c.
//
// A file contract_<header>.c has an entry for each function of its header. An entry names the cases that apply to the
// function, and a `call` that makes the call in one of them. test_contract.c goes through all entries and cases, says
// what each case must give, and proves that no function of any header is missing.

#ifndef TALUS_TEST_CONTRACT_H
#define TALUS_TEST_CONTRACT_H

#include "talus_test.h"

#include <talus/talus.h>

/// What is done to a call, and what it must answer.
typedef enum contract_case {
    CONTRACT_GOOD,          ///< all is in order: TL_OK
    CONTRACT_NULL_REPORT,   ///< no report is wanted: TL_OK, and the same answer
    CONTRACT_NULL_DEF,      ///< the def, or filter, is NULL: TL_OK, and the answer of the default one
    CONTRACT_ZEROED_DEF,    ///< the def is all zero and has a cookie: TL_ERR_ARGUMENT, field "cookie"
    CONTRACT_ZEROED_FILTER, ///< the def is all zero and has no cookie: TL_OK, and the answer of the default one
    CONTRACT_BAD_FIELD,     ///< the def's field `fields[variant]` is out of range: an error, and the report names it
    CONTRACT_NULL_INPUT,    ///< input number `variant` is NULL: TL_ERR_ARGUMENT
    CONTRACT_NULL_OUTPUT,   ///< output number `variant`, one that is needed, is NULL: TL_ERR_ARGUMENT
    CONTRACT_NO_BUFFER,     ///< the buffer is NULL with capacity 0: TL_INCOMPLETE, and the count of CONTRACT_GOOD
    CONTRACT_SHORT_BUFFER,  ///< the buffer is short by one: TL_INCOMPLETE, and the count of CONTRACT_GOOD
    CONTRACT_NOT_FOUND,     ///< there is nothing: TL_NOT_FOUND
    CONTRACT_STALE,         ///< a reference to what is no longer there: TL_ERR_STALE
    CONTRACT_NO_NODES,      ///< the query has too few nodes: TL_ERR_NODES
    CONTRACT_BAD_BYTES,     ///< the bytes are none of ours: an error, and the report names an element or a field
    CONTRACT_NO_MEMORY,     ///< each allocation of `host` fails in turn: TL_ERR_MEMORY, and nothing is leaked
    CONTRACT_CANCELLED,     ///< the progress hook of `host` says stop: TL_ERR_CANCELLED, and nothing is leaked
    CONTRACT_ZERO_ROTATION, ///< a quaternion is all zero: TL_OK, and the answer of the identity
    CONTRACT_NULL_FREE,     ///< a free or destroy is given NULL, then a zeroed struct: nothing happens, TL_OK
    CONTRACT_CASE_COUNT
} contract_case;

#define CONTRACT_BIT(name) (1u << CONTRACT_##name)

/// One call of one case. `call` reads the first part and fills the second.
typedef struct contract_run {
    contract_case what;
    uint32_t variant;    ///< CONTRACT_BAD_FIELD, CONTRACT_NULL_INPUT, CONTRACT_NULL_OUTPUT: which
    const tl_host *host; ///< to be used wherever the function takes a host, a def with one or an allocator
    tl_report *report;   ///< to be given where the function takes a tl_report; NULL in CONTRACT_NULL_REPORT
    bool wants_report;   ///< for functions with a report of their own kind: copy its `base` to `own_report`
    tl_report own_report;

    uint64_t answer; ///< anything that tells answers apart: a hash, a count, an index (contract_hash)
    uint32_t count;  ///< with CONTRACT_NO_BUFFER and CONTRACT_SHORT_BUFFER: the count that was returned
    bool is_clear;   ///< after an error: all outputs are NULL or zeroed (set it to true where there are none)
} contract_run;

typedef struct contract_entry {
    const char *function;      ///< "tl_soup_bake"
    uint32_t cases;            ///< CONTRACT_BIT(GOOD) | ...; 0: no case applies, `remark` says why
    uint32_t null_inputs;      ///< number of variants of CONTRACT_NULL_INPUT
    uint32_t null_outputs;     ///< of CONTRACT_NULL_OUTPUT
    const char *const *fields; ///< names for CONTRACT_BAD_FIELD as the report has them, ended by NULL; or NULL
    /// Makes the call, frees all that it made, and gives the call's result. Functions that return no result give TL_OK.
    tl_result (*call)(contract_run *run);
    const char *remark; ///< of an entry without cases: why, such as "returns a constant text"
} contract_entry;

// For example:
//
//   static tl_result mesh_bake(contract_run *run)
//   {
//       const contract_level *level = contract_level_get();
//       tl_mesh_def def = tl_default_mesh_def();
//       if (run->what == CONTRACT_ZEROED_DEF) {
//           memset(&def, 0, sizeof def);
//       } else if (run->what == CONTRACT_BAD_FIELD) {
//           def.weld_tolerance = -1.0f;
//       }
//       def.host = *run->host;
//       tl_mesh mesh;
//       tl_mesh_report report = { 0 };
//       const tl_result result = tl_mesh_bake(
//           run->what == CONTRACT_NULL_INPUT ? NULL : &level->view, run->what == CONTRACT_NULL_DEF ? NULL : &def,
//           run->what == CONTRACT_NULL_OUTPUT ? NULL : &mesh, run->wants_report ? &report : NULL);
//       run->own_report = report.base;
//       if (run->what == CONTRACT_NULL_OUTPUT) {
//           run->is_clear = true;
//           return result;
//       }
//       run->is_clear = contract_is_zero(&mesh, sizeof mesh);
//       run->answer = result == TL_OK ? contract_hash(mesh.vertices, mesh.vertex_count * sizeof *mesh.vertices, 0) : 0;
//       tl_mesh_free(&mesh);
//       return result;
//   }
//
//   static const char *const MESH_FIELDS[] = { "weld_tolerance", NULL };
//
//   const contract_entry CONTRACT_TABLE_mesh[] = {
//       { "tl_mesh_bake", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_DEF) | ..., 1, 1, MESH_FIELDS, mesh_bake, NULL },
//       ...
//       { 0 },
//   };

/// Defines the call of CONTRACT_NULL_FREE for a function that frees what a struct of `type` holds: `name(run)`.
#define CONTRACT_DEFINE_FREE(name, type, free_it)                                                                      \
    static tl_result name(contract_run *run)                                                                           \
    {                                                                                                                  \
        (void)run;                                                                                                     \
        type zeroed;                                                                                                   \
        memset(&zeroed, 0, sizeof zeroed);                                                                             \
        free_it(NULL);                                                                                                 \
        free_it(&zeroed);                                                                                              \
        return TL_OK;                                                                                                  \
    }

/// An input or an output, or NULL where the case asks for that one.
#define CONTRACT_INPUT(run, number, pointer)                                                                           \
    ((run)->what == CONTRACT_NULL_INPUT && (run)->variant == (number) ? NULL : (pointer))
#define CONTRACT_OUTPUT(run, number, pointer)                                                                          \
    ((run)->what == CONTRACT_NULL_OUTPUT && (run)->variant == (number) ? NULL : (pointer))

/// A pose at a place; without a rotation where the case asks for a zeroed one.
tl_transform contract_pose(const contract_run *run, tl_vec3 position);

/// Three ways to say that nothing is ignored: no filter, one that is zeroed, and one whose callback accepts all.
const tl_ray_filter *contract_ray_filter(const contract_run *run, tl_ray_filter *filter);

/// A hash of bytes, for `answer`.
uint64_t contract_hash(const void *bytes, size_t size, uint64_t seed);

/// Whether a block is all zero, for `is_clear`.
bool contract_is_zero(const void *bytes, size_t size);

/// A small level that calls are made on: a floor of 20 x 20 m with a box of 4 x 2 x 4 m on it, in 2 x 2 tiles.
/// Made once, from malloc; it lives until the program ends.
typedef struct contract_level {
    tl_mesh_view view;
    tl_mesh mesh;
    tl_soup *soup;
    tl_hull *hull; ///< of the box
    tl_nav_def nav_def;
    tl_nav_input nav_input;
    tl_nav_tiles tiles;
    tl_navmesh *navmesh;      ///< of `tiles`, borrowed
    tl_nav_query *query;      ///< with the default number of nodes
    tl_nav_query *tiny_query; ///< with 2 nodes, for CONTRACT_NO_NODES
    tl_vec3 here, there;      ///< two places on the floor with the box between them
    tl_vec3 nowhere;          ///< far from everything
    tl_nav_ref stale;         ///< a reference that names nothing
} contract_level;

const contract_level *contract_level_get(void);

#endif
