// SPDX-License-Identifier: MIT
//
// TL_ASSERT: a caller's bug, checked unless NDEBUG. TL_VALIDATE: a costly invariant, checked where TALUS_VALIDATE is
// set. TL_TRY: hands a failure on to the caller.

#ifndef TALUS_SRC_BASE_ASSERT_H
#define TALUS_SRC_BASE_ASSERT_H

#include "base/exact_floats.h"

#include <assert.h>
#include <talus/base.h>

#define TL_ASSERT(condition) assert(condition)

#ifdef TALUS_VALIDATE
#define TL_VALIDATE(condition) assert(condition)
#else
#define TL_VALIDATE(condition) ((void)0)
#endif

#define TL_TRY(expression)                                                                                             \
    do {                                                                                                               \
        tl_result tl_try_result_ = (expression);                                                                       \
        if (tl_try_result_ != TL_OK) {                                                                                 \
            return tl_try_result_;                                                                                     \
        }                                                                                                              \
    } while (0)

#define TL_COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))

#endif
