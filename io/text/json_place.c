// SPDX-License-Identifier: MIT
//
// Numbers are read as doubles, for in JSON "5.0" and "5e0" are the whole number 5 too.

#include "io/text/json_place.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PLACE_BYTES = 160 };

static const double largest_whole = 9007199254740992.0; // 2^53: beyond it doubles leave numbers out

static const char export_advice[] = "it is damaged; export it again";

static size_t append_place(const tl_json_place *at, char *text, size_t length)
{
    if (at == NULL || at->name == NULL) {
        return length;
    }
    length = append_place(at->above, text, length);
    const char *point = length > 0 ? "." : "";
    int more = at->item == TL_JSON_NO_ITEM
                   ? snprintf(text + length, PLACE_BYTES - length, "%s%s", point, at->name)
                   : snprintf(text + length, PLACE_BYTES - length, "%s%s[%zu]", point, at->name, at->item);
    length += more > 0 ? (size_t)more : 0;
    return length < PLACE_BYTES ? length : PLACE_BYTES - 1;
}

static const char *advice_of(const tl_json_reader *json)
{
    return json->advice != NULL ? json->advice : export_advice;
}

tl_result tl_json_fail(tl_json_reader *json, tl_result result, const tl_json_place *at, const char *key,
                       const char *what)
{
    if (json->result != TL_OK) {
        return json->result;
    }
    char place[PLACE_BYTES] = "";
    size_t length = append_place(at, place, 0);
    const char *point = length > 0 && key != NULL ? "." : "";
    json->result = result;
    return tl_io_fail(json->error, result, json->name, 0, advice_of(json), "%s%s%s %s",
                      length == 0 && key == NULL ? "the JSON" : place, point, key != NULL ? key : "", what);
}

tl_result tl_json_load(tl_json_reader *json, const void *text, size_t length, tl_json_place *root_out)
{
    json_error_t why;
    json_t *root = json_loadb(text, length, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, &why);
    *root_out = (tl_json_place){ NULL, NULL, TL_JSON_NO_ITEM, root };
    if (json_is_object(root)) {
        return TL_OK;
    }
    if (root != NULL) {
        tl_json_fail(json, TL_ERR_FORMAT, root_out, NULL, "is no object");
        json_decref(root);
        root_out->value = NULL;
        return json->result;
    }
    uint64_t line = why.line > 0 ? (uint64_t)why.line : 0;
    switch (json_error_code(&why)) {
    case json_error_out_of_memory:
        json->result = TL_ERR_MEMORY;
        return tl_io_fail(json->error, TL_ERR_MEMORY, json->name, 0, NULL, "out of memory");
    case json_error_premature_end_of_input:
        json->result = TL_ERR_FORMAT;
        return tl_io_fail(json->error, TL_ERR_FORMAT, json->name, line, advice_of(json), "the file is cut short");
    case json_error_stack_overflow:
        json->result = TL_ERR_LIMIT;
        return tl_io_fail(json->error, TL_ERR_LIMIT, json->name, line, advice_of(json),
                          "the JSON nests deeper than 2048 levels");
    default:
        json->result = TL_ERR_FORMAT;
        return tl_io_fail(json->error, TL_ERR_FORMAT, json->name, line, advice_of(json), "the JSON is damaged: %s",
                          why.text);
    }
}

bool tl_json_keys_are_known(tl_json_reader *json, const tl_json_place *at, const char *const *known)
{
    const char *key;
    json_t *value;
    json_object_foreach(at->value, key, value)
    {
        const char *const *word = known;
        while (*word != NULL && strcmp(*word, key) != 0) {
            word++;
        }
        if (*word == NULL) {
            tl_json_fail(json, TL_ERR_FORMAT, at, key, "is no key that is known");
            return false;
        }
    }
    return true;
}

// The value of a key, or NULL; also after an error.
static json_t *find_value(const tl_json_reader *json, const tl_json_place *at, const char *key)
{
    return json->result == TL_OK ? json_object_get(at->value, key) : NULL;
}

bool tl_json_object(tl_json_reader *json, const tl_json_place *at, const char *key, tl_json_place *out)
{
    json_t *value = find_value(json, at, key);
    *out = (tl_json_place){ at, key, TL_JSON_NO_ITEM, value };
    if (value != NULL && !json_is_object(value)) {
        tl_json_fail(json, TL_ERR_FORMAT, at, key, "is no object");
        return false;
    }
    return value != NULL;
}

size_t tl_json_list(tl_json_reader *json, const tl_json_place *at, const char *key, tl_json_place *out)
{
    json_t *value = find_value(json, at, key);
    *out = (tl_json_place){ at, key, TL_JSON_NO_ITEM, value };
    if (value != NULL && !json_is_array(value)) {
        tl_json_fail(json, TL_ERR_FORMAT, at, key, "is no array");
        return 0;
    }
    size_t count = value != NULL ? json_array_size(value) : 0;
    if (count >= UINT32_MAX) {
        tl_json_fail(json, TL_ERR_LIMIT, at, key, "has more than 4294967294 items");
        return 0;
    }
    return count;
}

bool tl_json_item(tl_json_reader *json, const tl_json_place *list, size_t item, tl_json_place *out)
{
    *out = (tl_json_place){ list->above, list->name, item,
                            json->result == TL_OK ? json_array_get(list->value, item) : NULL };
    if (json->result == TL_OK && !json_is_object(out->value)) {
        tl_json_fail(json, TL_ERR_FORMAT, out, NULL, "is no object");
    }
    return json->result == TL_OK;
}

// A whole number from 0 on, or false.
static bool read_whole(const json_t *value, size_t *out)
{
    double number = json_number_value(value);
    if (!json_is_number(value) || !(number >= 0.0) || number != floor(number)) {
        return false;
    }
    number = number < largest_whole ? number : largest_whole;
    *out = number < (double)SIZE_MAX ? (size_t)number : SIZE_MAX;
    return true;
}

size_t tl_json_size(tl_json_reader *json, const tl_json_place *at, const char *key, size_t absent)
{
    json_t *value = find_value(json, at, key);
    size_t size = absent;
    if (value != NULL && !read_whole(value, &size)) {
        tl_json_fail(json, TL_ERR_FORMAT, at, key, "is no whole number from 0 on");
    }
    return size;
}

static uint32_t check_index(tl_json_reader *json, const json_t *value, const tl_json_place *at, const char *key,
                            size_t count, const char *what)
{
    size_t index = 0;
    char words[96];
    if (!read_whole(value, &index)) {
        tl_json_fail(json, TL_ERR_FORMAT, at, key, "is no index");
        return UINT32_MAX;
    }
    if (index >= count) {
        snprintf(words, sizeof words, "is %zu, but the file has %zu %s", index, count, what);
        tl_json_fail(json, TL_ERR_INDEX, at, key, words);
        return UINT32_MAX;
    }
    return (uint32_t)index;
}

uint32_t tl_json_index(tl_json_reader *json, const tl_json_place *at, const char *key, size_t count, const char *what)
{
    json_t *value = find_value(json, at, key);
    return value != NULL ? check_index(json, value, at, key, count, what) : UINT32_MAX;
}

uint32_t tl_json_index_item(tl_json_reader *json, const tl_json_place *list, size_t item, size_t count,
                            const char *what)
{
    if (json->result != TL_OK) {
        return UINT32_MAX;
    }
    tl_json_place at = { list->above, list->name, item, json_array_get(list->value, item) };
    return check_index(json, at.value, &at, NULL, count, what);
}

bool tl_json_bool(tl_json_reader *json, const tl_json_place *at, const char *key)
{
    json_t *value = find_value(json, at, key);
    if (value != NULL && !json_is_boolean(value)) {
        tl_json_fail(json, TL_ERR_FORMAT, at, key, "is neither true nor false");
    }
    return json_is_true(value);
}

const char *tl_json_string(tl_json_reader *json, const tl_json_place *at, const char *key)
{
    json_t *value = find_value(json, at, key);
    if (value != NULL && !json_is_string(value)) {
        tl_json_fail(json, TL_ERR_FORMAT, at, key, "is no text");
    }
    return json_string_value(value);
}

bool tl_json_numbers(tl_json_reader *json, const tl_json_place *at, const char *key, double *out, size_t count)
{
    tl_json_place list;
    size_t there = tl_json_list(json, at, key, &list);
    if (json->result != TL_OK || list.value == NULL) {
        return false;
    }
    char words[48];
    if (there != count) {
        snprintf(words, sizeof words, "has %zu numbers instead of %zu", there, count);
        tl_json_fail(json, TL_ERR_FORMAT, at, key, words);
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        json_t *value = json_array_get(list.value, i);
        tl_json_place item = { at, key, i, value };
        if (!json_is_number(value)) {
            tl_json_fail(json, TL_ERR_FORMAT, &item, NULL, "is no number");
            return false;
        }
        out[i] = json_number_value(value);
    }
    return true;
}
