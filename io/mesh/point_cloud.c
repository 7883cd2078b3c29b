// SPDX-License-Identifier: MIT
//
// Points from text, line by line, or from any mesh file's vertices.
//
// The first line that holds numbers says which text it is: three numbers are a point, one is a cloud's count.

#include "io/mesh/point_cloud.h"

#include "io/files/file_map.h"
#include "io/files/growable.h"
#include "io/text/text_scan.h"

#include <string.h>

enum { MAX_NUMBERS = 3, MAX_QUOTED_WORD_BYTES = 32 };

typedef enum text_kind { TEXT_UNKNOWN, TEXT_POINTS, TEXT_CLOUDS } text_kind;

typedef struct cloud_reader {
    tl_point_clouds *clouds;
    const char *path;
    tl_io_error *error;
    uint64_t line;
    text_kind kind;
    uint64_t announced; // of the cloud that is read
    uint64_t missing;   // how many of those are still to come
} cloud_reader;

// A line taken apart.
typedef struct number_line {
    float numbers[MAX_NUMBERS];
    uint32_t count;
    const char *first; // the first number's text
    const char *first_end;
    const char *line_end;
} number_line;

static tl_result fail_cloud_memory(cloud_reader *reader)
{
    return tl_io_fail(reader->error, TL_ERR_MEMORY, reader->path, 0, NULL, "out of memory");
}

static bool is_gap(char c)
{
    return tl_is_blank(c) || c == ',';
}

static tl_result add_cloud_point(cloud_reader *reader, tl_vec3 point)
{
    tl_point_clouds *clouds = reader->clouds;
    uint64_t capacity = clouds->point_capacity;
    if (clouds->point_count == TL_MAX_MESH_VERTICES) {
        return tl_io_fail(reader->error, TL_ERR_LIMIT, reader->path, reader->line, "cut the file into parts",
                          "more points than one file may have");
    }
    if (!tl_io_grow(&clouds->allocator, (void **)&clouds->points, &capacity, clouds->point_count,
                    (uint64_t)clouds->point_count + 1, sizeof *clouds->points)) {
        return fail_cloud_memory(reader);
    }
    clouds->point_capacity = (uint32_t)capacity;
    clouds->points[clouds->point_count++] = point;
    return TL_OK;
}

// Begins a cloud at the next point; first_points always has one entry more than there are clouds.
static tl_result add_cloud(cloud_reader *reader)
{
    tl_point_clouds *clouds = reader->clouds;
    uint64_t capacity = clouds->cloud_capacity;
    uint64_t used = clouds->cloud_count > 0 ? (uint64_t)clouds->cloud_count + 1 : 0;
    if (clouds->cloud_count == TL_MAX_MESH_VERTICES) {
        return tl_io_fail(reader->error, TL_ERR_LIMIT, reader->path, reader->line, "cut the file into parts",
                          "more clouds than one file may have");
    }
    if (!tl_io_grow(&clouds->allocator, (void **)&clouds->first_points, &capacity, used,
                    (uint64_t)clouds->cloud_count + 2, sizeof *clouds->first_points)) {
        return fail_cloud_memory(reader);
    }
    clouds->cloud_capacity = (uint32_t)capacity;
    clouds->first_points[clouds->cloud_count++] = clouds->point_count;
    clouds->first_points[clouds->cloud_count] = clouds->point_count;
    return TL_OK;
}

static tl_result fail_word(cloud_reader *reader, tl_result result, const char *at, const char *problem,
                           const char *advice)
{
    char text[MAX_QUOTED_WORD_BYTES + 1];
    size_t size = 0;
    while (size < MAX_QUOTED_WORD_BYTES && !is_gap(at[size]) && !tl_is_line_end(at[size]) && at[size] != '\0') {
        text[size] = at[size];
        size++;
    }
    text[size] = '\0';
    tl_io_fail(reader->error, result, reader->path, reader->line, advice, "'%s' %s", text, problem);
    return tl_io_blame(reader->error, result, "point", reader->clouds->point_count);
}

static tl_result read_numbers(cloud_reader *reader, const char *at, const char *end, number_line *line)
{
    memset(line, 0, sizeof *line);
    for (;;) {
        while (is_gap(*at)) {
            at++;
        }
        if (tl_is_line_end(*at) || *at == '#') {
            break;
        }
        float value;
        const char *next = tl_parse_float_padded(at, end, &value);
        if (next == NULL || !(is_gap(*next) || tl_is_line_end(*next) || *next == '#')) {
            const char *word = at + (*at == '-' || *at == '+');
            bool not_finite = memcmp(word, "nan", 3) == 0 || memcmp(word, "inf", 3) == 0 ||
                              memcmp(word, "NaN", 3) == 0 || memcmp(word, "Inf", 3) == 0;
            return fail_word(reader, not_finite ? TL_ERR_NOT_FINITE : TL_ERR_FORMAT, at,
                             not_finite ? "is not finite" : "stands where a number must be", "a point is x y z");
        }
        if (!isfinite(value)) {
            return fail_word(reader, TL_ERR_RANGE, at, "is beyond the largest float", "check the file's unit");
        }
        if (line->count == MAX_NUMBERS) {
            return fail_word(reader, TL_ERR_FORMAT, at, "is a number too many",
                             "a point is x y z, a cloud begins with N");
        }
        if (line->count == 0) {
            line->first = at;
            line->first_end = next;
        }
        line->numbers[line->count++] = value;
        at = next;
    }
    line->line_end = tl_find_line_end(at);
    return TL_OK;
}

// A cloud's count: digits only.
static tl_result begin_cloud(cloud_reader *reader, const number_line *line)
{
    uint64_t count = 0;
    for (const char *at = line->first; at < line->first_end; at++) {
        if (*at < '0' || *at > '9') {
            return fail_word(reader, TL_ERR_FORMAT, line->first, "is no count of points", "a cloud begins with N");
        }
        count = count * 10 + (unsigned)(*at - '0');
        if (count > TL_MAX_MESH_VERTICES) {
            return fail_word(reader, TL_ERR_LIMIT, line->first, "points are more than one file may have",
                             "cut the file into parts");
        }
    }
    reader->announced = count;
    reader->missing = count;
    return add_cloud(reader);
}

static tl_result take_cloud_line(cloud_reader *reader, const number_line *line)
{
    if (line->count == 0) {
        return TL_OK;
    }
    if (reader->kind == TEXT_UNKNOWN) {
        reader->kind = line->count == 1 ? TEXT_CLOUDS : TEXT_POINTS;
        tl_result begun = reader->kind == TEXT_POINTS ? add_cloud(reader) : TL_OK;
        if (begun != TL_OK) {
            return begun;
        }
    }
    bool count_line = reader->kind == TEXT_CLOUDS && reader->missing == 0;
    if (line->count != (count_line ? 1u : 3u)) {
        tl_io_fail(reader->error, TL_ERR_FORMAT, reader->path, reader->line, "a point is x y z, a cloud begins with N",
                   "%u number%s where %s", (unsigned)line->count, line->count == 1 ? "" : "s",
                   count_line ? "a cloud's count must be" : "a point's three must be");
        return tl_io_blame(reader->error, TL_ERR_FORMAT, "point", reader->clouds->point_count);
    }
    if (count_line) {
        return begin_cloud(reader, line);
    }
    reader->missing -= reader->kind == TEXT_CLOUDS;
    tl_result result = add_cloud_point(reader, tl_vec3_make(line->numbers[0], line->numbers[1], line->numbers[2]));
    reader->clouds->first_points[reader->clouds->cloud_count] = reader->clouds->point_count;
    return result;
}

static tl_result read_cloud_section(cloud_reader *reader, const char *text, const char *end)
{
    for (const char *at = text; at < end;) {
        number_line line;
        tl_result result = read_numbers(reader, at, end, &line);
        if (result == TL_OK) {
            result = take_cloud_line(reader, &line);
        }
        if (result != TL_OK) {
            return result;
        }
        at = line.line_end + 1 + (line.line_end[0] == '\r' && line.line_end[1] == '\n');
        reader->line++;
    }
    return TL_OK;
}

static tl_result read_cloud_text(cloud_reader *reader, const char *text, size_t size)
{
    const tl_allocator *allocator = &reader->clouds->allocator;
    size_t in_place = tl_text_first_section(text, size);
    tl_result result = read_cloud_section(reader, text, text + in_place);
    if (result != TL_OK) {
        return result;
    }
    size_t block = tl_text_last_section_block(size - in_place);
    char *copy = tl_io_allocate(allocator, block);
    if (copy == NULL) {
        return fail_cloud_memory(reader);
    }
    size_t last = tl_text_copy_last_section(text + in_place, size - in_place, copy);
    result = read_cloud_section(reader, copy, copy + last);
    tl_io_release(allocator, copy, block);
    if (result != TL_OK) {
        return result;
    }
    if (reader->missing > 0) {
        tl_io_fail(reader->error, TL_ERR_TRUNCATED, reader->path, 0, "the file is cut short",
                   "cloud %u announces %llu points and has %llu", (unsigned)reader->clouds->cloud_count - 1u,
                   (unsigned long long)reader->announced, (unsigned long long)(reader->announced - reader->missing));
        return tl_io_blame(reader->error, TL_ERR_TRUNCATED, "cloud", reader->clouds->cloud_count - 1u);
    }
    if (reader->clouds->cloud_count == 0) {
        return tl_io_fail(reader->error, TL_ERR_EMPTY, reader->path, 0, "write one point a line: x y z", "no points");
    }
    return TL_OK;
}

static void init_clouds(tl_point_clouds *clouds, const tl_import_options *options)
{
    memset(clouds, 0, sizeof *clouds);
    clouds->allocator = tl_io_allocator_or_default(options->host.allocator);
}

tl_result tl_point_clouds_parse(const void *text, size_t size, const char *path, const tl_import_options *options,
                                tl_point_clouds *clouds_out, tl_io_error *error_out)
{
    tl_import_options used = options != NULL ? *options : tl_default_import_options();
    init_clouds(clouds_out, &used);
    cloud_reader reader = { clouds_out, path, error_out, 1, TEXT_UNKNOWN, 0, 0 };
    size_t mark = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0; // UTF-8 byte order mark
    tl_result result = tl_import_options_check(&used, path, error_out);
    if (result == TL_OK) {
        result = read_cloud_text(&reader, (const char *)text + mark, size - mark);
    }
    if (result == TL_OK) {
        result = tl_import_place_vertices(&used, path, clouds_out->points, clouds_out->point_count, error_out);
    }
    if (result != TL_OK) {
        tl_point_clouds_free(clouds_out);
    }
    return result;
}

static tl_result take_mesh(const tl_file_map *map, const char *path, const tl_import_options *options,
                           tl_point_clouds *clouds, tl_io_error *error)
{
    tl_imported_mesh mesh;
    tl_result result = tl_import_mesh_bytes(map->bytes, map->size, path, options, &mesh, error);
    if (result != TL_OK) {
        return result;
    }
    init_clouds(clouds, options);
    cloud_reader reader = { clouds, path, error, 0, TEXT_POINTS, 0, 0 };
    result = add_cloud(&reader);
    if (result == TL_OK) {
        // The vertices change hands; both sides have the same allocator.
        clouds->points = mesh.vertices;
        clouds->point_count = mesh.vertex_count;
        clouds->point_capacity = mesh.vertex_capacity;
        clouds->first_points[1] = mesh.vertex_count;
        mesh.vertices = NULL;
        mesh.vertex_capacity = 0;
    }
    tl_imported_mesh_free(&mesh);
    return result;
}

// Whether the first line that is not empty or a comment begins with a number.
static bool is_number_text(const char *text, size_t size)
{
    size_t at = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    while (at < size && (is_gap(text[at]) || tl_is_line_end(text[at]) || text[at] == '#')) {
        bool comment = text[at] == '#';
        at++;
        while (comment && at < size && !tl_is_line_end(text[at])) {
            at++;
        }
    }
    return at == size || (text[at] >= '0' && text[at] <= '9') || text[at] == '+' || text[at] == '-' || text[at] == '.';
}

tl_result tl_point_clouds_read(const char *path, const tl_import_options *options, tl_point_clouds *clouds_out,
                               tl_io_error *error_out)
{
    tl_import_options used = options != NULL ? *options : tl_default_import_options();
    used.allow_no_triangles = true;
    memset(clouds_out, 0, sizeof *clouds_out);
    tl_file_map map;
    tl_result result = tl_file_read(path, used.max_file_bytes, &map, error_out);
    if (result != TL_OK) {
        return result;
    }
    bool stream = strcmp(path, "-") == 0;
    if ((stream || !tl_import_is_mesh_name(path)) && is_number_text(map.bytes, map.size)) {
        result =
            tl_point_clouds_parse(map.bytes, map.size, stream ? "standard input" : path, &used, clouds_out, error_out);
    } else {
        result = take_mesh(&map, path, &used, clouds_out, error_out);
    }
    if (result != TL_OK) {
        tl_point_clouds_free(clouds_out);
    }
    tl_file_map_close(&map);
    return result;
}

tl_point_cloud tl_point_clouds_get(const tl_point_clouds *clouds, uint32_t index)
{
    uint32_t first = clouds->first_points[index];
    tl_point_cloud cloud = { clouds->points + first, clouds->first_points[index + 1] - first };
    return cloud;
}

void tl_point_clouds_free(tl_point_clouds *clouds)
{
    if (clouds->allocator.release == NULL) {
        return;
    }
    const tl_allocator *allocator = &clouds->allocator;
    tl_io_release(allocator, clouds->points, clouds->point_capacity * sizeof *clouds->points);
    tl_io_release(allocator, clouds->first_points, clouds->cloud_capacity * sizeof *clouds->first_points);
    memset(clouds, 0, sizeof *clouds);
}
