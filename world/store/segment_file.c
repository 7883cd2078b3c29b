// SPDX-License-Identifier: MIT

#include "world/store/segment_file.h"

#include "world/bytes/folder.h"
#include "world/bytes/little_endian.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char take_away[] = "take the file away and run 'talus world plan' again";

void tl_world_segment_head_encode(const tl_world_segment_head *head, unsigned char bytes_out[TL_WORLD_SEGMENT_HEADER])
{
    memset(bytes_out, 0, TL_WORLD_SEGMENT_HEADER);
    memcpy(bytes_out, TL_WORLD_SEGMENT_MAGIC, 8);
    tl_put_u32(bytes_out + 8, TL_WORLD_STORE_VERSION);
    tl_put_u32(bytes_out + 12, head->last ? 1 : 0);
    tl_put_double(bytes_out + 16, head->cell_size);
    tl_put_u64(bytes_out + 24, head->triangles);
    tl_put_u64(bytes_out + 32, head->cells);
    tl_put_u64(bytes_out + 40, head->degenerate);
    tl_put_u64(bytes_out + 48, head->first);
    tl_put_u64(bytes_out + 56, head->count);
    for (int i = 0; i < 6; i++) {
        tl_put_double(bytes_out + 64 + 8 * i, head->bounds[i]);
    }
    tl_put_u64(bytes_out + 112, head->vertices);
    tl_put_u64(bytes_out + 184, tl_content_checksum(bytes_out, 184));
}

static void decode_head(const unsigned char *bytes, tl_world_segment_head *head)
{
    head->last = tl_get_u32(bytes + 12) == 1;
    head->cell_size = tl_get_double(bytes + 16);
    head->triangles = tl_get_u64(bytes + 24);
    head->cells = tl_get_u64(bytes + 32);
    head->degenerate = tl_get_u64(bytes + 40);
    head->first = tl_get_u64(bytes + 48);
    head->count = tl_get_u64(bytes + 56);
    for (int i = 0; i < 6; i++) {
        head->bounds[i] = tl_get_double(bytes + 64 + 8 * i);
    }
    head->vertices = tl_get_u64(bytes + 112);
}

void tl_world_segment_cell_encode(const tl_world_segment_cell *cell, unsigned char bytes_out[TL_WORLD_SEGMENT_CELL])
{
    memset(bytes_out, 0, TL_WORLD_SEGMENT_CELL);
    tl_put_u32(bytes_out, (uint32_t)cell->cell.level);
    tl_put_u32(bytes_out + 4, (uint32_t)cell->cell.x);
    tl_put_u32(bytes_out + 8, (uint32_t)cell->cell.y);
    tl_put_u32(bytes_out + 12, (uint32_t)cell->cell.z);
    tl_put_u64(bytes_out + 16, cell->first);
    tl_put_u32(bytes_out + 24, cell->count);
    const tl_vec3 corners[2] = { cell->bounds.min, cell->bounds.max };
    for (int i = 0; i < 2; i++) {
        tl_put_float(bytes_out + 32 + 12 * i, corners[i].x);
        tl_put_float(bytes_out + 36 + 12 * i, corners[i].y);
        tl_put_float(bytes_out + 40 + 12 * i, corners[i].z);
    }
    tl_put_u64(bytes_out + 56, cell->checksum);
}

static tl_world_segment_cell decode_cell(const unsigned char *bytes)
{
    tl_world_segment_cell cell;
    cell.cell.level = (int32_t)tl_get_u32(bytes);
    cell.cell.x = (int32_t)tl_get_u32(bytes + 4);
    cell.cell.y = (int32_t)tl_get_u32(bytes + 8);
    cell.cell.z = (int32_t)tl_get_u32(bytes + 12);
    cell.first = tl_get_u64(bytes + 16);
    cell.count = tl_get_u32(bytes + 24);
    cell.bounds.min = tl_vec3_make(tl_get_float(bytes + 32), tl_get_float(bytes + 36), tl_get_float(bytes + 40));
    cell.bounds.max = tl_vec3_make(tl_get_float(bytes + 44), tl_get_float(bytes + 48), tl_get_float(bytes + 52));
    cell.checksum = tl_get_u64(bytes + 56);
    return cell;
}

// The checksum says that the bytes are those that were written; these, that they are what this version writes.
static const char *head_fault(const tl_world_segment_head *head)
{
    int exponent;
    if (!(head->cell_size >= 0x1p-20 && head->cell_size <= 0x1p20) || frexp(head->cell_size, &exponent) != 0.5) {
        return "the cell size is no power of two";
    }
    // More would not fit a file; so the sums below do not overflow.
    if (head->triangles > UINT64_C(1) << 48 || head->cells > head->triangles) {
        return "counts do not fit one another";
    }
    for (int i = 0; i < 6 && head->triangles > 0; i++) {
        if (!(fabs(head->bounds[i]) <= TL_WORLD_MAX_COORDINATE) || head->bounds[i % 3] > head->bounds[i % 3 + 3]) {
            return "the bounds are none";
        }
    }
    return NULL;
}

static bool is_cell_number(int32_t value)
{
    const int32_t most = 1 << 30;
    return value >= -most && value <= most;
}

static bool cell_is_sound(const tl_world_segment_cell *cell, uint64_t first)
{
    const tl_vec3 low = cell->bounds.min, high = cell->bounds.max;
    return cell->cell.level >= 0 && cell->cell.level <= TL_WORLD_MAX_LEVEL && cell->first == first && cell->count > 0 &&
           is_cell_number(cell->cell.x) && is_cell_number(cell->cell.y) && is_cell_number(cell->cell.z) &&
           tl_is_finite(low) && tl_is_finite(high) && low.x <= high.x && low.y <= high.y && low.z <= high.z;
}

static tl_result take_cells(tl_world_segment *segment, const unsigned char *index, tl_io_error *error_out)
{
    uint64_t first = 0;
    for (uint64_t i = 0; i < segment->head.cells; i++) {
        const tl_world_segment_cell cell = decode_cell(index + i * TL_WORLD_SEGMENT_CELL);
        if (!cell_is_sound(&cell, first)) {
            return tl_io_fail(error_out, TL_ERR_CORRUPT, segment->path, 0, take_away, "cell %llu makes no sense",
                              (unsigned long long)i);
        }
        first += cell.count;
        segment->cells[i] = cell;
    }
    return first == segment->head.triangles ? TL_OK
                                            : tl_io_fail(error_out, TL_ERR_CORRUPT, segment->path, 0, take_away,
                                                         "the cells hold another number of triangles");
}

static tl_result read_cell_index(tl_world_segment *segment, tl_io_error *error_out)
{
    const size_t size = (size_t)segment->head.cells * TL_WORLD_SEGMENT_CELL;
    unsigned char *bytes = malloc(size + 8);
    segment->cells = malloc((size_t)segment->head.cells * sizeof *segment->cells + 1);
    tl_result result = TL_OK;
    if (bytes == NULL || segment->cells == NULL) {
        result = tl_io_fail(error_out, TL_ERR_MEMORY, segment->path, 0, "", "out of memory");
    }
    if (result == TL_OK) {
        const uint64_t offset = TL_WORLD_SEGMENT_HEADER + segment->head.triangles * TL_WORLD_RECORD_BYTES;
        result = tl_random_file_read(&segment->file, segment->path, offset, bytes, size + 8, error_out);
    }
    if (result == TL_OK && tl_get_u64(bytes + size) != tl_content_checksum(bytes, size)) {
        result = tl_io_fail(error_out, TL_ERR_HASH, segment->path, 0, take_away, "the index was altered");
    }
    if (result == TL_OK) {
        result = take_cells(segment, bytes, error_out);
    }
    free(bytes);
    return result;
}

static tl_result read_head(tl_world_segment *segment, tl_io_error *error_out)
{
    unsigned char bytes[TL_WORLD_SEGMENT_HEADER];
    tl_file_facts facts;
    memset(&facts, 0, sizeof facts);
    const char *path = segment->path;
    tl_result result = tl_random_file_read(&segment->file, path, 0, bytes, sizeof bytes, error_out);
    if (result != TL_OK) {
        return result;
    }
    if (memcmp(bytes, TL_WORLD_SEGMENT_MAGIC, 8) != 0) {
        return tl_io_fail(error_out, TL_ERR_MAGIC, path, 0, take_away, "is no segment of a world's store");
    }
    if (tl_get_u32(bytes + 8) != TL_WORLD_STORE_VERSION) {
        return tl_io_fail(error_out, TL_ERR_VERSION, path, 0, take_away, "was written by another version");
    }
    if (tl_get_u64(bytes + 184) != tl_content_checksum(bytes, 184)) {
        return tl_io_fail(error_out, TL_ERR_HASH, path, 0, take_away, "the header was altered");
    }
    tl_world_segment_head *head = &segment->head;
    decode_head(bytes, head);
    const char *fault = head_fault(head);
    if (fault != NULL) {
        return tl_io_fail(error_out, TL_ERR_CORRUPT, path, 0, take_away, "%s", fault);
    }
    const uint64_t size =
        TL_WORLD_SEGMENT_HEADER + head->triangles * TL_WORLD_RECORD_BYTES + head->cells * TL_WORLD_SEGMENT_CELL + 8;
    if (!tl_file_look(path, &facts) || facts.size != size) {
        return tl_io_fail(error_out, facts.size < size ? TL_ERR_TRUNCATED : TL_ERR_CORRUPT, path, 0, take_away,
                          "has %llu bytes, and should have %llu", (unsigned long long)facts.size,
                          (unsigned long long)size);
    }
    if (head->cells * TL_WORLD_SEGMENT_CELL > SIZE_MAX / 4) {
        return tl_io_fail(error_out, TL_ERR_LIMIT, path, 0, "", "is too large for this machine's addresses");
    }
    return TL_OK;
}

tl_result tl_world_segment_open(const char *path, bool with_index, tl_world_segment *segment_out,
                                tl_io_error *error_out)
{
    memset(segment_out, 0, sizeof *segment_out);
    const size_t length = strlen(path) + 1;
    segment_out->path = malloc(length);
    if (segment_out->path == NULL) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, path, 0, "", "out of memory");
    }
    memcpy(segment_out->path, path, length);
    tl_result result = tl_random_file_open(path, &segment_out->file, error_out);
    if (result == TL_OK) {
        result = read_head(segment_out, error_out);
    }
    if (result == TL_OK && with_index) {
        result = read_cell_index(segment_out, error_out);
    }
    if (result != TL_OK) {
        tl_world_segment_close(segment_out);
    }
    return result;
}

void tl_world_segment_close(tl_world_segment *segment)
{
    tl_random_file_close(&segment->file);
    free(segment->cells);
    free(segment->path);
    memset(segment, 0, sizeof *segment);
}

tl_result tl_world_segment_read(const tl_world_segment *segment, uint64_t cell, unsigned char *records_out,
                                tl_io_error *error_out)
{
    const tl_world_segment_cell *entry = &segment->cells[cell];
    const size_t size = (size_t)entry->count * TL_WORLD_RECORD_BYTES;
    const uint64_t offset = TL_WORLD_SEGMENT_HEADER + entry->first * TL_WORLD_RECORD_BYTES;
    tl_random_file file = segment->file;
    tl_result result = file.is_open ? TL_OK : tl_random_file_open(segment->path, &file, error_out);
    if (result == TL_OK) {
        result = tl_random_file_read(&file, segment->path, offset, records_out, size, error_out);
    }
    if (!segment->file.is_open) {
        tl_random_file_close(&file);
    }
    if (result == TL_OK && tl_content_checksum(records_out, size) != entry->checksum) {
        return tl_io_fail(error_out, TL_ERR_HASH, segment->path, 0, take_away,
                          "the triangles of cell %llu were altered", (unsigned long long)cell);
    }
    return result;
}
