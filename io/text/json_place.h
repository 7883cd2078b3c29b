// SPDX-License-Identifier: MIT
//
// JSON values by name, each with the place where it stands, so that an error says "accessors[3].sparse.count".
//
// The first error sticks: after it every getter gives its default, and its caller looks once, at the end.

#ifndef TALUS_IO_JSON_PLACE_H
#define TALUS_IO_JSON_PLACE_H

#include "io/files/io_error.h"

#include <jansson.h>

#include <stddef.h>

#define TL_JSON_NO_ITEM SIZE_MAX

typedef struct tl_json_reader {
    tl_result result; ///< of all getters so far
    const char *name; ///< of the file
    tl_io_error *error;
    const char *advice; ///< what to do about a damaged file; NULL: to export it again
} tl_json_reader;

/// An object or array of the file, in the one above it (NULL: the file's outermost).
typedef struct tl_json_place {
    const struct tl_json_place *above;
    const char *name;
    size_t item; ///< in the array `name`, or TL_JSON_NO_ITEM
    json_t *value;
} tl_json_place;

/// Reads the text; a key that stands twice in an object is an error. The document, an object, becomes `root_out`, which
/// json_decref(root_out->value) gives back; NULL on failure. TL_ERR_FORMAT with the line, TL_ERR_LIMIT (nested too
/// deep), TL_ERR_MEMORY.
tl_result tl_json_load(tl_json_reader *json, const void *text, size_t length, tl_json_place *root_out);

/// "nodes[3].extensions: " and what is wrong with `key` there (NULL: with the place itself).
tl_result tl_json_fail(tl_json_reader *json, tl_result result, const tl_json_place *at, const char *key,
                       const char *what);

/// Whether each key of the object is one of `known`, a list that ends with NULL; the first that is not is an error.
bool tl_json_keys_are_known(tl_json_reader *json, const tl_json_place *at, const char *const *known);

/// Whether the object `key` is there; anything else of this name is an error.
bool tl_json_object(tl_json_reader *json, const tl_json_place *at, const char *key, tl_json_place *out);

/// The length of the array `key`, 0 when it is not there.
size_t tl_json_list(tl_json_reader *json, const tl_json_place *at, const char *key, tl_json_place *out);

/// The object `item` of a list.
bool tl_json_item(tl_json_reader *json, const tl_json_place *list, size_t item, tl_json_place *out);

/// A whole number >= 0; beyond 2^53 it is 2^53, which no file reaches.
size_t tl_json_size(tl_json_reader *json, const tl_json_place *at, const char *key, size_t absent);

/// An index below `count`, the number of the file's `what`, or `absent`: UINT32_MAX. TL_ERR_INDEX.
uint32_t tl_json_index(tl_json_reader *json, const tl_json_place *at, const char *key, size_t count, const char *what);

/// The same of the item of a list of indices, which must be there.
uint32_t tl_json_index_item(tl_json_reader *json, const tl_json_place *list, size_t item, size_t count,
                            const char *what);

bool tl_json_bool(tl_json_reader *json, const tl_json_place *at, const char *key);

/// NULL when it is not there.
const char *tl_json_string(tl_json_reader *json, const tl_json_place *at, const char *key);

/// `count` numbers into `out`, which stays as it is when they are not there. Whether they are.
bool tl_json_numbers(tl_json_reader *json, const tl_json_place *at, const char *key, double *out, size_t count);

#endif
