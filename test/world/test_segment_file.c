// SPDX-License-Identifier: MIT
//
// Segments: all triangles come back, whatever memory there was; every prefix and every altered byte is refused.
#include "talus_test.h"

#include "base/random.h"
#include "world/bytes/folder.h"
#include "world/bytes/little_endian.h"
#include "world/store/segment_builder.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char folder[32];

static int make_test_folder(void **state)
{
    (void)state;
    for (int i = 0; i < 1000; i++) {
        snprintf(folder, sizeof folder, "segments_%d", i);
        if (!tl_file_look(folder, NULL)) {
            return tl_folder_make(folder, NULL) == TL_OK ? 0 : -1;
        }
    }
    return -1;
}

static int remove_test_folder(void **state)
{
    (void)state;
    char line[64];
    snprintf(line, sizeof line, "rm -rf %s", folder);
    return system(line) == 0 ? 0 : -1;
}

static tl_world_triangle random_triangle(uint64_t *random)
{
    tl_world_triangle triangle = { { { 0 } }, (uint8_t)tl_random_below(random, 64) };
    const double x = 2000.0 * tl_random_unit(random) - 500.0, z = 1500.0 * tl_random_unit(random) - 1000.0;
    const double size = tl_random_below(random, 50) == 0 ? 400.0 : 3.0;
    for (int k = 0; k < 3; k++) {
        triangle.corner[k][0] = x + size * tl_random_unit(random);
        triangle.corner[k][1] = 60.0 * tl_random_unit(random);
        triangle.corner[k][2] = z + size * tl_random_unit(random);
    }
    return triangle;
}

// Writes `count` triangles in segments of at most `memory` bytes; gives their number.
static uint32_t write_segments(const char *stem, uint32_t count, uint64_t memory)
{
    uint64_t random = 7;
    tl_io_error error;
    tl_world_builder *builder = tl_world_builder_create(stem, 32.0, memory, 0, 0);
    assert_non_null(builder);
    for (uint32_t i = 0; i < count; i++) {
        const tl_world_triangle triangle = random_triangle(&random);
        assert_int_equal(tl_world_builder_add(builder, &triangle, &error), TL_OK);
    }
    assert_int_equal(tl_world_builder_finish(builder, 3 * (uint64_t)count, &error), TL_OK);
    tl_world_builder_free(builder);
    uint32_t segments = 0;
    for (bool last = false; !last; segments++) {
        tl_world_segment segment;
        char *path = tl_world_segment_path(stem, segments);
        assert_int_equal(tl_world_segment_open(path, false, &segment, &error), TL_OK);
        last = segment.head.last;
        tl_world_segment_close(&segment);
        free(path);
    }
    return segments;
}

// The sum of the hashes of all records in their cells, and their number.
static tl_content_hash sum_segments(const char *stem, uint32_t segments, uint64_t *count_out)
{
    tl_content_hash sum = { 0, 0 };
    *count_out = 0;
    for (uint32_t s = 0; s < segments; s++) {
        tl_world_segment segment;
        tl_io_error error;
        char *path = tl_world_segment_path(stem, s);
        assert_int_equal(tl_world_segment_open(path, true, &segment, &error), TL_OK);
        for (uint64_t c = 0; c < segment.head.cells; c++) {
            const tl_world_segment_cell *cell = &segment.cells[c];
            unsigned char *records = malloc((size_t)cell->count * TL_WORLD_RECORD_BYTES);
            assert_int_equal(tl_world_segment_read(&segment, c, records, &error), TL_OK);
            TEST_CHECK(c == 0 || tl_world_cell_compare(&segment.cells[c - 1].cell, &cell->cell) < 0);
            for (uint32_t i = 0; i < cell->count; i++) {
                unsigned char bytes[16 + TL_WORLD_RECORD_BYTES];
                const unsigned char *record = records + (size_t)i * TL_WORLD_RECORD_BYTES;
                memcpy(bytes, &cell->cell, 16);
                memcpy(bytes + 16, record, TL_WORLD_RECORD_BYTES);
                sum = tl_content_hash_add(sum, tl_content_hash_of(bytes, sizeof bytes));
                for (int k = 0; k < 3; k++) {
                    const float x = tl_get_float(record + 12 * k), z = tl_get_float(record + 12 * k + 8);
                    TEST_CHECK(x >= cell->bounds.min.x && x <= cell->bounds.max.x && z >= cell->bounds.min.z &&
                               z <= cell->bounds.max.z);
                }
            }
            *count_out += cell->count;
            free(records);
        }
        tl_world_segment_close(&segment);
        free(path);
    }
    return sum;
}

static void same_triangles_with_any_memory(void **state)
{
    (void)state;
    char a[64], b[64];
    snprintf(a, sizeof a, "%s/a", folder);
    snprintf(b, sizeof b, "%s/b", folder);
    const uint32_t count = 100000, one = write_segments(a, count, 64u << 20), many = write_segments(b, count, 1u << 20);
    uint64_t a_count, b_count;
    const tl_content_hash a_sum = sum_segments(a, one, &a_count), b_sum = sum_segments(b, many, &b_count);
    TEST_CHECK(one == 1 && many == 7); // 16,384 at a time
    TEST_CHECK(a_count == count && b_count == count && tl_content_hash_equal(a_sum, b_sum));
}

static bool opens(const char *path, const unsigned char *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    tl_world_segment segment;
    tl_io_error error;
    memset(&error, 0, sizeof error);
    bool sound = tl_world_segment_open(path, true, &segment, &error) == TL_OK;
    TEST_CHECK(sound || (error.result != TL_OK && error.message[0] != '\0'));
    for (uint64_t c = 0; sound && c < segment.head.cells; c++) {
        unsigned char *records = malloc((size_t)segment.cells[c].count * TL_WORLD_RECORD_BYTES);
        sound = tl_world_segment_read(&segment, c, records, &error) == TL_OK;
        free(records);
    }
    tl_world_segment_close(&segment);
    return sound;
}

static void damaged_files_are_refused(void **state)
{
    (void)state;
    char stem[64], path[64];
    snprintf(stem, sizeof stem, "%s/c", folder);
    snprintf(path, sizeof path, "%s/damaged", folder);
    assert_int_equal(write_segments(stem, 20, 1u << 20), 1);
    char *whole = tl_world_segment_path(stem, 0);
    FILE *file = fopen(whole, "rb");
    assert_non_null(file);
    unsigned char bytes[8192];
    const size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    free(whole);
    TEST_CHECK(size > 1000 && size < sizeof bytes && opens(path, bytes, size));
    for (size_t i = 0; i < size; i++) {
        TEST_CHECK(!opens(path, bytes, i));
        bytes[i] ^= 0x10;
        TEST_CHECK(!opens(path, bytes, size));
        bytes[i] ^= 0x10;
    }
    // One that hashes right and makes no sense: a count of cells, an index behind its records.
    tl_put_u64(bytes + 32, UINT64_C(1) << 60);
    tl_put_u64(bytes + 184, tl_content_checksum(bytes, 184));
    TEST_CHECK(!opens(path, bytes, size));
}

static void bad_triangles_are_named(void **state)
{
    (void)state;
    char stem[64];
    snprintf(stem, sizeof stem, "%s/d", folder);
    tl_world_builder *builder = tl_world_builder_create(stem, 32.0, 1u << 20, 0, 40);
    uint64_t random = 1;
    tl_io_error error;
    tl_world_triangle triangle = random_triangle(&random);
    assert_int_equal(tl_world_builder_add(builder, &triangle, &error), TL_OK);
    triangle.corner[2][1] = 1e300;
    assert_int_equal(tl_world_builder_add(builder, &triangle, &error), TL_ERR_RANGE);
    TEST_CHECK(error.element_index == 41 && strcmp(error.element, "triangle") == 0);
    tl_world_builder_free(builder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_triangles_with_any_memory),
        cmocka_unit_test(damaged_files_are_refused),
        cmocka_unit_test(bad_triangles_are_named),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_test_folder);
}
