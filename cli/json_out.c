// SPDX-License-Identifier: MIT
//
// A float's shortest decimal form (found with 6 to 9 digits) becomes a double, which then prints the same digits again
// because 15 digits survive a double unchanged.

#include "json_out.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define JSON_STYLE (JSON_REAL_PRECISION(15) | JSON_PRESERVE_ORDER)

json_t *tl_json_float(float value)
{
    if (!isfinite(value)) {
        return json_null();
    }
    char text[40];
    for (int digits = 6; digits <= 9; ++digits) {
        snprintf(text, sizeof(text), "%.*g", digits, (double)value);
        if (strtof(text, NULL) == value) {
            break;
        }
    }
    return json_real(strtod(text, NULL));
}

json_t *tl_json_double(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *tl_json_point(tl_vec3 point)
{
    return json_pack("[ooo]", tl_json_float(point.x), tl_json_float(point.y), tl_json_float(point.z));
}

json_t *tl_json_bounds(tl_aabb bounds)
{
    return json_pack("{so so}", "min", tl_json_point(bounds.min), "max", tl_json_point(bounds.max));
}

static int print(json_t *object, size_t flags)
{
    int failed = object == NULL || json_dumpf(object, stdout, flags) != 0;
    json_decref(object);
    if (!failed) {
        putchar('\n');
    }
    return !failed;
}

int tl_json_print(json_t *object)
{
    return print(object, JSON_STYLE | JSON_INDENT(2));
}

int tl_json_print_line(json_t *object)
{
    return print(object, JSON_STYLE | JSON_COMPACT);
}
