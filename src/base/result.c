// SPDX-License-Identifier: MIT
//
// A name and a sentence for each result.

#include "base/exact_floats.h"

#include <talus/base.h>

#define TEXT_OF_(x) #x
#define TEXT_OF(x)  TEXT_OF_(x)

typedef struct result_words {
    const char *name;
    const char *text;
} result_words;

#define WORDS(result, text) [result] = { #result, text }

static const result_words RESULTS[TL_RESULT_COUNT] = {
    WORDS(TL_OK, "success"),
    WORDS(TL_NOT_FOUND, "nothing was found"),
    WORDS(TL_INCOMPLETE, "the buffer holds only a part of the answer"),
    WORDS(TL_NOT_LOADED, "the answer depends on what is not loaded"),
    WORDS(TL_ERR_MEMORY, "out of memory"),
    WORDS(TL_ERR_CANCELLED, "cancelled"),
    WORDS(TL_ERR_IO, "the operating system refused to read or write"),
    WORDS(TL_ERR_ARGUMENT, "a setting is outside its range"),
    WORDS(TL_ERR_UNSUPPORTED, "well-formed, but of a kind that is not supported"),
    WORDS(TL_ERR_LIMIT, "a documented limit would be exceeded"),
    WORDS(TL_ERR_STALE, "a reference to something that is no longer there"),
    WORDS(TL_ERR_EMPTY, "there is no geometry in it"),
    WORDS(TL_ERR_NOT_FINITE, "a coordinate is NaN or infinite"),
    WORDS(TL_ERR_RANGE, "a coordinate is too large"),
    WORDS(TL_ERR_INDEX, "an index points outside its array"),
    WORDS(TL_ERR_DEGENERATE, "it has no extent where some is needed"),
    WORDS(TL_ERR_COINCIDENT, "all points coincide"),
    WORDS(TL_ERR_COLLINEAR, "all points lie on one line"),
    WORDS(TL_ERR_COPLANAR, "all points lie in one plane"),
    WORDS(TL_ERR_NON_MANIFOLD, "it would not be a manifold surface"),
    WORDS(TL_ERR_WINDING, "a face is wound against its neighbour"),
    WORDS(TL_ERR_NOT_CLOSED, "the surface is not closed"),
    WORDS(TL_ERR_SELF_INTERSECTION, "an outline crosses itself"),
    WORDS(TL_ERR_FORMAT, "it is not in the format that it claims"),
    WORDS(TL_ERR_MAGIC, "it is another kind of data"),
    WORDS(TL_ERR_VERSION, "it was written by an incompatible version"),
    WORDS(TL_ERR_TRUNCATED, "it ends too early"),
    WORDS(TL_ERR_HASH, "its content was altered: the stored hash does not match"),
    WORDS(TL_ERR_CORRUPT, "it contradicts itself"),
    WORDS(TL_ERR_ITERATIONS, "the iteration limit was reached before an answer was proven"),
    WORDS(TL_ERR_NODES, "the node pool of the query is too small"),
};

static bool is_result(tl_result result)
{
    return (unsigned)result < TL_RESULT_COUNT;
}

const char *tl_result_name(tl_result result)
{
    return is_result(result) ? RESULTS[result].name : "TL_UNKNOWN";
}

const char *tl_result_text(tl_result result)
{
    return is_result(result) ? RESULTS[result].text : "unknown result";
}

const char *tl_version(void)
{
    return TEXT_OF(TL_VERSION_MAJOR) "." TEXT_OF(TL_VERSION_MINOR) "." TEXT_OF(TL_VERSION_PATCH);
}
