// SPDX-License-Identifier: MIT

#include "io/text/area_marks.h"

#include "io/files/file_map.h"
#include "io/files/growable.h"
#include "io/text/line_words.h"

#include <math.h>
#include <string.h>

typedef struct marks_parser {
    tl_area_marks *marks;
    tl_allocator allocator;
    tl_text_reader reader;
    const tl_pack_frame *frame;
    tl_io_error *error;
} marks_parser;

static tl_result fail_mark(const marks_parser *p, tl_result result, const char *message)
{
    return tl_io_fail(p->error, result, p->reader.path, p->reader.line, "'talus bake --help' shows the lines", "%s",
                      message);
}

static tl_result fail_mark_memory(const marks_parser *p)
{
    return tl_io_fail(p->error, TL_ERR_MEMORY, p->reader.path, p->reader.line, NULL, "out of memory");
}

// ---- Room ----------------------------------------------------------------------------------------------------

static tl_nav_volume *push_volume(const tl_allocator *allocator, tl_area_marks *marks)
{
    void *volumes = marks->volumes;
    bool fits = tl_io_grow(allocator, &volumes, &marks->volume_capacity, marks->volume_count,
                           (uint64_t)marks->volume_count + 1, sizeof *marks->volumes);
    marks->volumes = volumes;
    if (!fits) {
        return NULL;
    }
    tl_nav_volume *volume = &marks->volumes[marks->volume_count++];
    memset(volume, 0, sizeof *volume);
    return volume;
}

static bool push_point(const tl_allocator *allocator, tl_area_marks *marks, tl_vec3 point)
{
    void *points = marks->points;
    bool fits = tl_io_grow(allocator, &points, &marks->point_capacity, marks->point_count, marks->point_count + 1,
                           sizeof *marks->points);
    marks->points = points;
    if (fits) {
        marks->points[marks->point_count++] = point;
    }
    return fits;
}

// The points moved while they grew in number; volumes hold theirs one after another.
static void point_volumes(tl_area_marks *marks)
{
    uint64_t first = 0;
    for (uint32_t i = 0; i < marks->volume_count; i++) {
        tl_nav_volume *volume = &marks->volumes[i];
        volume->points = volume->point_count > 0 ? marks->points + first : NULL;
        first += volume->point_count;
    }
}

tl_result tl_area_marks_add_rule(tl_area_marks *marks, const char *name, size_t name_size, uint64_t line, uint8_t area)
{
    const tl_allocator allocator = tl_io_allocator_or_default(NULL);
    if (marks->rule_count == UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    void *rules = marks->rules, *text = marks->text;
    bool fits = tl_io_grow(&allocator, &rules, &marks->rule_capacity, marks->rule_count,
                           (uint64_t)marks->rule_count + 1, sizeof *marks->rules);
    marks->rules = rules;
    fits = fits &&
           tl_io_grow(&allocator, &text, &marks->text_capacity, marks->text_size, marks->text_size + name_size + 1, 1);
    marks->text = text;
    if (!fits) {
        return TL_ERR_MEMORY;
    }
    const tl_area_rule rule = { marks->text_size, name_size, line, area };
    memcpy(marks->text + marks->text_size, name, name_size);
    marks->text[marks->text_size + name_size] = '\0';
    marks->text_size += name_size + 1;
    marks->rules[marks->rule_count++] = rule;
    return TL_OK;
}

void tl_area_marks_free(tl_area_marks *marks)
{
    const tl_allocator allocator = tl_io_allocator_or_default(NULL);
    tl_io_release(&allocator, marks->volumes, marks->volume_capacity * sizeof *marks->volumes);
    tl_io_release(&allocator, marks->rules, marks->rule_capacity * sizeof *marks->rules);
    tl_io_release(&allocator, marks->points, marks->point_capacity * sizeof *marks->points);
    tl_io_release(&allocator, marks->text, marks->text_capacity);
    memset(marks, 0, sizeof *marks);
}

// ---- Lines ---------------------------------------------------------------------------------------------------

// A point as the level has it, in double, since a frame's origin may be far out.
static bool take_place(tl_line *line, double place[3])
{
    return tl_take_double(line, &place[0]) && tl_take_double(line, &place[1]) && tl_take_double(line, &place[2]);
}

// False: floats end before it.
static bool enter_place(const marks_parser *p, const double place[3], tl_vec3 *point_out)
{
    *point_out = tl_pack_place_in(p->frame, place);
    return isfinite(point_out->x) && isfinite(point_out->y) && isfinite(point_out->z);
}

static bool is_z_up(const tl_pack_frame *frame)
{
    return frame != NULL && (frame->axes == TL_PACK_AXES_Z_UP || frame->axes == TL_PACK_AXES_Z_UP_LEFT);
}

static tl_result read_material_mark(marks_parser *p, tl_line *line, uint8_t area)
{
    while (line->at < line->end && (*line->at == ' ' || *line->at == '\t')) {
        line->at++;
    }
    while (line->end > line->at && strchr(" \t\r", line->end[-1]) != NULL) {
        line->end--;
    }
    if (line->at == line->end) {
        return fail_mark(p, TL_ERR_FORMAT, "expected a material's name");
    }
    tl_result result = tl_area_marks_add_rule(p->marks, line->at, (size_t)(line->end - line->at), p->reader.line, area);
    return result != TL_OK ? fail_mark_memory(p) : TL_OK;
}

static tl_result read_box(marks_parser *p, tl_line *line, tl_nav_volume *volume)
{
    double low[3], high[3];
    tl_vec3 a, b;
    volume->kind = TL_NAV_VOLUME_BOX;
    if (!take_place(line, low) || !take_place(line, high) || !tl_line_is_done(line) || !enter_place(p, low, &a) ||
        !enter_place(p, high, &b)) {
        return fail_mark(p, TL_ERR_FORMAT, "expected box AREA x y z x y z");
    }
    volume->box.min = tl_min(a, b); // turned, the lowest corner is another one
    volume->box.max = tl_max(a, b);
    return !(low[0] <= high[0] && low[1] <= high[1] && low[2] <= high[2])
               ? fail_mark(p, TL_ERR_RANGE, "the box is empty: give the lowest corner first")
               : TL_OK;
}

static tl_result read_cylinder(marks_parser *p, tl_line *line, tl_nav_volume *volume)
{
    double base[3];
    volume->kind = TL_NAV_VOLUME_CYLINDER;
    if (!take_place(line, base) || !enter_place(p, base, &volume->base) || !tl_take_float(line, &volume->radius) ||
        !tl_take_float(line, &volume->height) || !tl_line_is_done(line)) {
        return fail_mark(p, TL_ERR_FORMAT, "expected cylinder AREA x y z radius height");
    }
    return !(volume->radius > 0.0f && volume->height >= 0.0f)
               ? fail_mark(p, TL_ERR_RANGE, "a cylinder needs a radius above 0 and a height of 0 or more")
               : TL_OK;
}

// The corners of an outline, in the plan; `place` has its height.
static tl_result read_outline(marks_parser *p, tl_line *line, double place[3], tl_nav_volume *volume)
{
    const int across = is_z_up(p->frame) ? 1 : 2;
    while (!tl_line_is_done(line)) {
        tl_vec3 point;
        if (!tl_take_double(line, &place[0]) || !tl_take_double(line, &place[across]) ||
            !enter_place(p, place, &point) || volume->point_count == UINT32_MAX) {
            return TL_ERR_FORMAT;
        }
        point.y = 0.0f;
        if (!push_point(&p->allocator, p->marks, point)) {
            return TL_ERR_MEMORY;
        }
        volume->point_count++;
    }
    return volume->point_count >= 3 ? TL_OK : TL_ERR_FORMAT;
}

static tl_result read_prism(marks_parser *p, tl_line *line, tl_nav_volume *volume)
{
    double low[3] = { 0.0, 0.0, 0.0 }, high[3] = { 0.0, 0.0, 0.0 };
    const int up = is_z_up(p->frame) ? 2 : 1;
    tl_vec3 a, b;
    volume->kind = TL_NAV_VOLUME_POLYGON;
    const bool has_ends = tl_take_double(line, &low[up]) && tl_take_double(line, &high[up]);
    a = tl_pack_place_in(p->frame, low);
    b = tl_pack_place_in(p->frame, high);
    volume->box.min.y = a.y;
    volume->box.max.y = b.y;
    const tl_result result =
        has_ends && isfinite(a.y) && isfinite(b.y) ? read_outline(p, line, low, volume) : TL_ERR_FORMAT;
    if (result != TL_OK) {
        return result == TL_ERR_MEMORY
                   ? fail_mark_memory(p)
                   : fail_mark(p, TL_ERR_FORMAT,
                               "expected prism AREA low high x z x z x z, and more corners if wanted");
    }
    return low[up] > high[up] ? fail_mark(p, TL_ERR_RANGE, "the prism is empty: give the low end first") : TL_OK;
}

static tl_result read_volume(marks_parser *p, tl_line *line, const char *kind, uint8_t area)
{
    tl_nav_volume *volume = p->marks->volume_count < UINT32_MAX ? push_volume(&p->allocator, p->marks) : NULL;
    if (volume == NULL) {
        return fail_mark_memory(p);
    }
    volume->area = area;
    return kind[0] == 'b'   ? read_box(p, line, volume)
           : kind[0] == 'c' ? read_cylinder(p, line, volume)
                            : read_prism(p, line, volume);
}

static tl_result read_mark_line(marks_parser *p, tl_line line)
{
    static const char *const kinds[] = { "material", "box", "cylinder", "prism" };
    for (int i = 0; i < 4; i++) {
        if (tl_take_word(&line, kinds[i])) {
            int64_t area;
            if (!tl_take_integer(&line, 0, TL_NAV_MAX_AREA, &area)) {
                return fail_mark(p, TL_ERR_FORMAT, "expected an area of 0 to 255 behind the line's first word");
            }
            return i == 0 ? read_material_mark(p, &line, (uint8_t)area)
                          : read_volume(p, &line, kinds[i], (uint8_t)area);
        }
    }
    return fail_mark(p, TL_ERR_FORMAT, "expected material, box, cylinder or prism");
}

tl_result tl_area_marks_parse(tl_area_marks *marks, const char *text, size_t size, const char *path,
                              const tl_pack_frame *frame, tl_io_error *error_out)
{
    marks_parser p;
    memset(&p, 0, sizeof p);
    p.marks = marks;
    p.allocator = tl_io_allocator_or_default(NULL);
    p.reader.bytes = text;
    p.reader.size = size;
    p.reader.path = path;
    p.frame = frame;
    p.error = error_out;
    tl_result result = TL_OK;
    tl_line line;
    while (result == TL_OK && tl_next_line(&p.reader, &line)) {
        result = *line.at != '#' ? read_mark_line(&p, line) : TL_OK;
    }
    point_volumes(marks);
    return result;
}

tl_result tl_area_marks_read(tl_area_marks *marks, const char *path, const tl_pack_frame *frame, tl_io_error *error_out)
{
    tl_file_map map;
    tl_result result = tl_file_read(path, 0, &map, error_out);
    if (result == TL_OK) {
        result = tl_area_marks_parse(marks, map.bytes, map.size, path, frame, error_out);
        tl_file_map_close(&map);
    }
    return result;
}

// ---- Names ---------------------------------------------------------------------------------------------------

bool tl_area_rule_is_exact(const tl_area_marks *marks, const tl_area_rule *rule, const char *material)
{
    return strcmp(marks->text + rule->name, material) == 0;
}

// Goes back to the last * only: a match of what came before it is never worth more. At most pattern times text steps.
bool tl_area_rule_matches(const tl_area_marks *marks, const tl_area_rule *rule, const char *material)
{
    const char *pattern = marks->text + rule->name, *star = NULL, *tried = NULL;
    while (*material != '\0') {
        if (*pattern == '*') {
            star = pattern++;
            tried = material;
        } else if (*pattern == '?' || *pattern == *material) {
            pattern++;
            material++;
        } else if (star != NULL) {
            pattern = star + 1;
            material = ++tried;
        } else {
            return false;
        }
    }
    while (*pattern == '*') {
        pattern++;
    }
    return *pattern == '\0';
}
