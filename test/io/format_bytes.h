// SPDX-License-Identifier: MIT
//
// Files of a floor, 1 m by 2 m, in binary formats, byte by byte: STL, PLY, 3DS, GLB, and FBX out of its text form.

#ifndef TALUS_TEST_FORMAT_BYTES_H
#define TALUS_TEST_FORMAT_BYTES_H

#include "talus_test.h"

#include <stdlib.h>
#include <string.h>

#define PLY_HEAD(form, vertices, faces)                                                                                \
    "ply\nformat " form " 1.0\nelement vertex " vertices "\nproperty float x\nproperty float y\nproperty float z\n"    \
    "element face " faces "\nproperty list uchar int vertex_indices\nend_header\n"

typedef struct byte_buffer {
    unsigned char bytes[4096];
    size_t size;
} byte_buffer;

static void put(byte_buffer *to, const void *bytes, size_t size)
{
    TEST_CHECK(to->size + size <= sizeof to->bytes);
    memcpy(to->bytes + to->size, bytes, size);
    to->size += size;
}

// Little-endian; what is longer than eight bytes ends with zeros.
static void put_number(byte_buffer *to, uint64_t value, size_t bytes)
{
    for (size_t i = 0; i < bytes; i++) {
        const unsigned char byte = i < 8 ? (unsigned char)(value >> (8 * i)) : 0;
        put(to, &byte, 1);
    }
}

static void set_number(byte_buffer *in, size_t at, uint64_t value)
{
    for (size_t i = 0; i < 4; i++) {
        in->bytes[at + i] = (unsigned char)(value >> (8 * i));
    }
}

// A chunk of 3DS: its kind, its size with all that is in it, its content.
static size_t begin_3ds(byte_buffer *to, unsigned kind)
{
    put_number(to, kind, 2);
    put_number(to, 0, 4);
    return to->size - 6;
}

static void end_3ds(byte_buffer *to, size_t at)
{
    set_number(to, at + 2, to->size - at);
}

// 3DS is z-up, and says nothing of its unit.
static void make_3ds(byte_buffer *to)
{
    static const char material[] = "stück";
    static const float corners[12] = { 0, 0, 0, 0, -2, 0, 1, -2, 0, 1, 0, 0 };
    static const unsigned faces[8] = { 0, 1, 2, 7, 0, 2, 3, 7 }; // three corners and the edges to be seen
    const size_t whole = begin_3ds(to, 0x4d4d), editor = begin_3ds(to, 0x3d3d);
    const size_t look = begin_3ds(to, 0xafff), name = begin_3ds(to, 0xa000);
    put(to, material, strlen(material) + 1);
    end_3ds(to, name);
    end_3ds(to, look);
    const size_t object = begin_3ds(to, 0x4000);
    put(to, "floor", 6);
    const size_t mesh = begin_3ds(to, 0x4100), points = begin_3ds(to, 0x4110);
    put_number(to, 4, 2);
    put(to, corners, sizeof corners);
    end_3ds(to, points);
    const size_t list = begin_3ds(to, 0x4120);
    put_number(to, 2, 2);
    for (int i = 0; i < 8; i++) {
        put_number(to, faces[i], 2);
    }
    const size_t group = begin_3ds(to, 0x4130);
    put(to, material, strlen(material) + 1);
    put_number(to, 2, 2);
    put_number(to, 0, 2);
    put_number(to, 1, 2);
    end_3ds(to, group);
    end_3ds(to, list);
    end_3ds(to, mesh);
    end_3ds(to, object);
    end_3ds(to, editor);
    end_3ds(to, whole);
}

// The text of an FBX file as binary records: end of the record, count and bytes of its properties, name, properties,
// records inside, and 13 zeros behind those.
static const char *skip_fbx_blanks(const char *at)
{
    return at + strspn(at, " \n");
}

static size_t put_fbx_array(byte_buffer *to, const char *numbers, bool whole)
{
    byte_buffer list = { .size = 0 };
    size_t count = 0;
    for (const char *at = numbers; *at != '\n' && *at != '}'; count++) {
        char *end;
        const double value = strtod(at, &end);
        if (whole) {
            put_number(&list, (uint64_t)(int64_t)value, 4);
        } else {
            put(&list, &value, sizeof value);
        }
        at = end + (*end == ',');
    }
    put(to, whole ? "i" : "d", 1);
    put_number(to, count, 4);
    put_number(to, 0, 4); // not packed
    put_number(to, list.size, 4);
    put(to, list.bytes, list.size);
    return 1;
}

// One property; `decimals` for numbers that are no whole ones by their kind.
static const char *put_fbx_property(byte_buffer *to, const char *at, bool decimals, bool is_id)
{
    if (*at != '\'') {
        char *end;
        const double value = strtod(at, &end);
        put(to, decimals ? "D" : is_id ? "L" : "I", 1);
        if (decimals) {
            put(to, &value, sizeof value);
        } else {
            put_number(to, (uint64_t)(int64_t)value, is_id ? 8 : 4);
        }
        return end;
    }
    const char *end = strchr(at + 1, '\'');
    const char *colons = strstr(at, "::");
    put(to, "S", 1);
    if (colons != NULL && colons < end) { // "Kind::name" is name, 0, 1, kind there
        put_number(to, (uint64_t)(end - at - 1), 4);
        put(to, colons + 2, (size_t)(end - colons - 2));
        put(to, "\0\1", 2);
        put(to, at + 1, (size_t)(colons - at - 1));
    } else {
        put_number(to, (uint64_t)(end - at - 1), 4);
        put(to, at + 1, (size_t)(end - at - 1));
    }
    return end + 1;
}

static const char *put_fbx_records(byte_buffer *to, const char *at)
{
    for (at = skip_fbx_blanks(at); *at != '\0' && *at != '}'; at = skip_fbx_blanks(at)) {
        if (*at == ';') {
            at = strchr(at, '\n');
            continue;
        }
        const char *colon = strchr(at, ':');
        const size_t name = (size_t)(colon - at), head = to->size;
        const bool decimals = strncmp(colon, ": 'Unit", 7) == 0 || strncmp(colon, ": 'Lcl", 6) == 0;
        const bool is_id = strncmp(at, "C:", 2) == 0 || strncmp(at, "Geometry:", 9) == 0 ||
                           strncmp(at, "Model:", 6) == 0 || strncmp(at, "Material:", 9) == 0;
        const bool corners = strncmp(at, "PolygonVertexIndex", 18) == 0 || strncmp(at, "Materials:", 10) == 0;
        put_number(to, 0, 12);
        put_number(to, name, 1);
        put(to, at, name);
        const size_t first = to->size;
        size_t count = 0;
        bool nested = false;
        at = colon + 1;
        while (at += strspn(at, " ,"), *at != '\n' && *at != '}') {
            if (*at == '{') {
                nested = true;
                at++;
                break;
            }
            if (*at == '*') { // "*1 {\na: numbers\n}"
                at = strstr(at, "a: ") + 3;
                count += put_fbx_array(to, at, corners);
                at = strchr(at, '}') + 1;
                break;
            }
            at = put_fbx_property(to, at, decimals, is_id);
            count++;
        }
        set_number(to, head + 4, count);
        set_number(to, head + 8, to->size - first);
        if (nested) {
            at = put_fbx_records(to, at) + 1;
            put_number(to, 0, 8);
            put_number(to, 0, 5);
        }
        set_number(to, head, to->size);
    }
    return at;
}

static void make_binary_fbx(byte_buffer *to, const char *text)
{
    put(to, "Kaydara FBX Binary  \0\x1a\0", 23);
    put_number(to, 7300, 4);
    put_fbx_records(to, text);
    put_number(to, 0, 8);
    put_number(to, 0, 5);
}

static void make_binary_stl(byte_buffer *to)
{
    static const float corners[12] = { 0, 0, 0, 0, 0, 2, 1, 0, 2, 1, 0, 0 }, up[3] = { 0, 1, 0 };
    static const unsigned char triangles[6] = { 0, 1, 2, 0, 2, 3 };
    for (int i = 0; i < 10; i++) {
        put_number(to, 0, 8); // a head of 80 bytes that says nothing
    }
    put_number(to, 2, 4);
    for (int i = 0; i < 2; i++) {
        put(to, up, sizeof up);
        for (int k = 0; k < 3; k++) {
            put(to, corners + triangles[i * 3 + k] * 3, 3 * sizeof *corners);
        }
        put_number(to, 0, 2);
    }
}

static void make_binary_ply(byte_buffer *to, bool dent)
{
    static const char heads[2][256] = { PLY_HEAD("binary_little_endian", "4", "1"),
                                        PLY_HEAD("binary_little_endian", "5", "1") };
    static const float corners[15] = { 0, 0, 0, 0, 0, 2, 1, 0, 2, 1, 0, 0, 0.9f, 0, 1 };
    static const unsigned order[5] = { 0, 1, 2, 4, 3 };
    const unsigned count = dent ? 5 : 4;
    put(to, heads[dent], strlen(heads[dent]));
    put(to, corners, count * 3 * sizeof *corners);
    put_number(to, count, 1);
    for (unsigned i = 0; i < count; i++) {
        put_number(to, dent ? order[i] : i, 4);
    }
}

static void make_glb(byte_buffer *to, const char *text)
{
    const size_t length = strlen(text), padding = (4 - length % 4) % 4;
    put(to, "glTF", 4);
    put_number(to, 2, 4);
    put_number(to, 20 + length + padding, 4);
    put_number(to, length + padding, 4);
    put(to, "JSON", 4);
    for (size_t i = 0; i < length; i++) {
        put(to, text[i] == '\'' ? "\"" : &text[i], 1);
    }
    put(to, "   ", padding);
}

#endif
