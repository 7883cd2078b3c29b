// SPDX-License-Identifier: MIT
//
// A buffer is the GLB's own, a data URI, or a file of the glTF's folder. EXT_meshopt_compression is decoded by
// meshoptimizer where talus was built with it.

#include "io/mesh/gltf_buffers.h"

#include "io/files/growable.h"
#include "io/files/sibling_file.h"

#include <string.h>

#ifdef TALUS_HAVE_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

static const char damaged_advice[] = "it is damaged; export it again";

tl_result tl_gltf_file_init(tl_gltf_file *file)
{
    size_t buffers = ((size_t)file->data->buffer_count + 1) * sizeof *file->buffers;
    size_t views = ((size_t)file->data->view_count + 1) * sizeof *file->views;
    file->buffers = tl_io_allocate(&file->allocator, buffers);
    file->views = tl_io_allocate(&file->allocator, views);
    if (file->buffers == NULL || file->views == NULL) {
        tl_io_release(&file->allocator, file->buffers, buffers);
        tl_io_release(&file->allocator, file->views, views);
        file->buffers = file->views = NULL;
        return tl_io_fail(file->error, TL_ERR_MEMORY, file->source->name, 0, NULL, "out of memory");
    }
    memset(file->buffers, 0, buffers);
    memset(file->views, 0, views);
    return TL_OK;
}

static void free_bytes(tl_gltf_file *file, tl_gltf_bytes *bytes, size_t count)
{
    for (size_t i = 0; bytes != NULL && i < count; i++) {
        tl_io_release(&file->allocator, bytes[i].owned, bytes[i].size);
        tl_file_map_close(&bytes[i].map);
    }
    tl_io_release(&file->allocator, bytes, (count + 1) * sizeof *bytes);
}

void tl_gltf_file_free(tl_gltf_file *file)
{
    free_bytes(file, file->buffers, file->data->buffer_count);
    free_bytes(file, file->views, file->data->view_count);
    file->buffers = file->views = NULL;
}

static tl_result fail_damaged(tl_gltf_file *file, const char *what, size_t index, const char *why)
{
    return tl_io_fail(file->error, TL_ERR_FORMAT, file->source->name, 0, damaged_advice, "%s %zu %s", what, index, why);
}

// --- buffers --------------------------------------------------------------------------------------------------------

static int base64_digit(char c)
{
    if (c >= 'A' && c <= 'Z') {
        return c - 'A';
    }
    if (c >= 'a' && c <= 'z') {
        return c - 'a' + 26;
    }
    if (c >= '0' && c <= '9') {
        return c - '0' + 52;
    }
    return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

// Decodes up to `size` bytes; returns how many there were.
static size_t decode_base64(const char *text, unsigned char *out, size_t size)
{
    unsigned bits = 0;
    unsigned kept = 0;
    size_t count = 0;
    for (; count < size && base64_digit(*text) >= 0; text++) {
        kept = (kept << 6 | (unsigned)base64_digit(*text)) & 0xffffu;
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            out[count++] = (unsigned char)(kept >> bits);
        }
    }
    return count;
}

static tl_result load_data_uri(tl_gltf_file *file, size_t index, const char *uri, tl_gltf_bytes *loaded)
{
    const char *comma = strchr(uri, ',');
    size_t size = file->data->buffers[index].size;
    if (comma == NULL || comma - uri < 7 || strncmp(comma - 7, ";base64", 7) != 0) {
        return fail_damaged(file, "buffer", index, "is no base64 text");
    }
    if (size == 0 || size > strlen(comma) / 4 * 3 + 3) {
        return fail_damaged(file, "buffer", index, "is shorter than it says");
    }
    unsigned char *bytes = tl_io_allocate(&file->allocator, size);
    if (bytes == NULL) {
        return tl_io_fail(file->error, TL_ERR_MEMORY, file->source->name, 0, NULL, "out of memory");
    }
    if (decode_base64(comma + 1, bytes, size) != size) {
        tl_io_release(&file->allocator, bytes, size);
        return fail_damaged(file, "buffer", index, "is shorter than it says");
    }
    loaded->bytes = loaded->owned = bytes;
    loaded->size = size;
    return TL_OK;
}

static int hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

// "%20" becomes a blank; what is no escape stays, and so does "%00", which would cut the name.
static void decode_escapes(const char *uri, char *name)
{
    for (; *uri != '\0'; uri++) {
        int high = uri[0] == '%' ? hex_digit(uri[1]) : -1;
        int low = high >= 0 ? hex_digit(uri[2]) : -1;
        if (low >= 0 && high * 16 + low > 0) {
            *name++ = (char)(high * 16 + low);
            uri += 2;
        } else {
            *name++ = *uri;
        }
    }
    *name = '\0';
}

static tl_result load_named_file(tl_gltf_file *file, size_t index, tl_gltf_bytes *loaded)
{
    const char *uri = file->data->buffers[index].uri;
    // Most writers escape a blank as %20, some do not: a file of the very name goes first.
    tl_result result = tl_sibling_open(file->source->path, uri, file->source->name, &loaded->map, file->error);
    if (result == TL_ERR_IO && strchr(uri, '%') != NULL) {
        size_t room = strlen(uri) + 1;
        char *name = tl_io_allocate(&file->allocator, room);
        if (name == NULL) {
            return tl_io_fail(file->error, TL_ERR_MEMORY, file->source->name, 0, NULL, "out of memory");
        }
        decode_escapes(uri, name);
        result = tl_sibling_open(file->source->path, name, file->source->name, &loaded->map, file->error);
        tl_io_release(&file->allocator, name, room);
    }
    loaded->bytes = loaded->map.bytes;
    loaded->size = loaded->map.size;
    if (result == TL_OK && loaded->size < file->data->buffers[index].size) {
        return fail_damaged(file, "buffer", index, "is shorter than it says");
    }
    return result;
}

static tl_result load_buffer(tl_gltf_file *file, uint32_t index, tl_gltf_bytes **loaded_out)
{
    const tl_gltf_buffer *buffer = &file->data->buffers[index];
    tl_gltf_bytes *loaded = &file->buffers[index];
    *loaded_out = loaded;
    if (loaded->bytes != NULL) {
        return TL_OK;
    }
    if (buffer->uri == NULL) {
        if (index != 0 || file->data->binary == NULL || file->data->binary_size < buffer->size) {
            return fail_damaged(file, "buffer", index, "has no bytes");
        }
        loaded->bytes = file->data->binary;
        loaded->size = file->data->binary_size;
        return TL_OK;
    }
    if (strncmp(buffer->uri, "data:", 5) == 0) {
        return load_data_uri(file, index, buffer->uri, loaded);
    }
    return load_named_file(file, index, loaded);
}

// --- views ----------------------------------------------------------------------------------------------------------

#ifdef TALUS_HAVE_MESHOPTIMIZER
static int decode_meshopt(const tl_gltf_view *view, const unsigned char *bytes, void *out)
{
    switch (view->packing) {
    case TL_GLTF_ATTRIBUTES:
        return meshopt_decodeVertexBuffer(out, view->packed_count, view->packed_stride, bytes, view->packed_size);
    case TL_GLTF_TRIANGLE_LIST:
        return meshopt_decodeIndexBuffer(out, view->packed_count, view->packed_stride, bytes, view->packed_size);
    case TL_GLTF_INDEX_LIST:
        return meshopt_decodeIndexSequence(out, view->packed_count, view->packed_stride, bytes, view->packed_size);
    default:
        return -1;
    }
}

// What the decoder takes as its caller's duty.
static bool is_sound_meshopt(const tl_gltf_view *view, size_t there)
{
    if (view->packed_offset > there || view->packed_size > there - view->packed_offset || view->packed_count == 0 ||
        view->packed_count > TL_MAX_MESH_TRIANGLES || view->packed_count / 512 > view->packed_size) {
        return false;
    }
    return view->packing == TL_GLTF_ATTRIBUTES
               ? view->packed_stride > 0 && view->packed_stride % 4 == 0 && view->packed_stride <= 256
               : (view->packed_stride == 2 || view->packed_stride == 4) &&
                     (view->packing != TL_GLTF_TRIANGLE_LIST || view->packed_count % 3 == 0);
}

static tl_result decode_view(tl_gltf_file *file, uint32_t index, tl_gltf_bytes *decoded)
{
    const tl_gltf_view *view = &file->data->views[index];
    tl_gltf_bytes *buffer;
    if (view->packed_buffer == TL_GLTF_NONE) {
        return fail_damaged(file, "buffer view", index, "has no bytes");
    }
    tl_result result = load_buffer(file, view->packed_buffer, &buffer);
    if (result != TL_OK) {
        return result;
    }
    if (!is_sound_meshopt(view, buffer->size)) {
        return fail_damaged(file, "buffer view", index, "is not packed as EXT_meshopt_compression says");
    }
    decoded->size = view->packed_count * view->packed_stride;
    decoded->owned = tl_io_allocate(&file->allocator, decoded->size);
    if (decoded->owned == NULL) {
        return tl_io_fail(file->error, TL_ERR_MEMORY, file->source->name, 0, NULL, "out of memory");
    }
    if (decode_meshopt(view, buffer->bytes + view->packed_offset, decoded->owned) != 0) {
        return fail_damaged(file, "buffer view", index, "does not unpack");
    }
    // The filter left out is that of normals; instances have turns.
    if (view->filter == TL_GLTF_EXPONENTIAL) {
        meshopt_decodeFilterExp(decoded->owned, view->packed_count, view->packed_stride);
    } else if (view->filter == TL_GLTF_QUATERNION && view->packed_stride == 8) {
        meshopt_decodeFilterQuat(decoded->owned, view->packed_count, view->packed_stride);
    } else if (view->filter != TL_GLTF_NO_FILTER) {
        return fail_damaged(file, "buffer view", index, "has a filter that does not fit");
    }
    decoded->bytes = decoded->owned;
    return TL_OK;
}
#else
static tl_result decode_view(tl_gltf_file *file, uint32_t index, tl_gltf_bytes *decoded)
{
    (void)index;
    (void)decoded;
    return tl_io_fail(file->error, TL_ERR_UNSUPPORTED, file->source->name, 0,
                      "export it without compression, or build talus with meshoptimizer",
                      "its meshes are packed by EXT_meshopt_compression");
}
#endif

// `count` elements of `size` bytes, `stride` apart, from `offset` of a view on.
typedef struct gltf_span {
    uint32_t view;
    size_t offset, count, size, stride;
} gltf_span;

static tl_result find_bytes(tl_gltf_file *file, const gltf_span *span, const unsigned char **bytes_out)
{
    const tl_gltf_view *view = &file->data->views[span->view];
    tl_gltf_bytes *decoded = &file->views[span->view];
    tl_gltf_bytes *from = decoded;
    size_t begin = 0;
    tl_result result = TL_OK;
    if (!view->is_packed) {
        if (view->buffer == TL_GLTF_NONE) {
            return fail_damaged(file, "buffer view", span->view, "has no buffer");
        }
        result = load_buffer(file, view->buffer, &from);
        begin = view->offset;
    } else if (decoded->bytes == NULL) {
        result = decode_view(file, span->view, decoded);
    }
    if (result != TL_OK) {
        return result;
    }
    size_t there = from->size;
    bool inside = begin <= there && view->size <= there - begin && span->offset <= view->size &&
                  span->size <= view->size - span->offset;
    if (!inside || (span->count > 1 && span->stride > 0 &&
                    (view->size - span->offset - span->size) / span->stride < span->count - 1)) {
        return fail_damaged(file, "buffer view", span->view, "is too short for what is read from it");
    }
    *bytes_out = from->bytes + begin + span->offset;
    return TL_OK;
}

// --- accessors ------------------------------------------------------------------------------------------------------

// Where the elements of an accessor stand that has a view.
static gltf_span span_of_accessor(const tl_gltf_file *file, const tl_gltf_accessor *accessor)
{
    size_t size = (size_t)accessor->component_size * accessor->width;
    size_t stride = file->data->views[accessor->view].stride;
    return (gltf_span){ accessor->view, accessor->offset, accessor->count, size, stride > 0 ? stride : size };
}

tl_result tl_gltf_check_accessor(tl_gltf_file *file, uint32_t index)
{
    // An accessor without a view is all zeros but for its sparse elements. So few of them say so little that a count
    // above is no level, but a file of a few bytes that asks for gigabytes.
    enum { ZEROS_PER_SPARSE = 1024, FREE_ZEROS = 65536 };
    const tl_gltf_accessor *accessor = &file->data->accessors[index];
    const unsigned char *bytes;
    if (accessor->count == 0 || accessor->width == 0 || accessor->component_size == 0) {
        return fail_damaged(file, "accessor", index, "is empty or of no known type");
    }
    if (accessor->count > TL_MAX_MESH_TRIANGLES) {
        return tl_io_fail(file->error, TL_ERR_LIMIT, file->source->name, 0, "cut the level into parts",
                          "accessor %u has more elements than one mesh may have", index);
    }
    if (accessor->sparse_count > accessor->count) {
        return fail_damaged(file, "accessor", index, "has more sparse elements than elements");
    }
    if (accessor->view != TL_GLTF_NONE) {
        const gltf_span span = span_of_accessor(file, accessor);
        return find_bytes(file, &span, &bytes);
    }
    if (accessor->sparse_count == 0) {
        return fail_damaged(file, "accessor", index, "has no data");
    }
    if (accessor->count > FREE_ZEROS && accessor->count / ZEROS_PER_SPARSE > accessor->sparse_count) {
        return tl_io_fail(file->error, TL_ERR_LIMIT, file->source->name, 0, "give it a buffer view",
                          "accessor %u has %zu elements, of which the file holds %zu", index, accessor->count,
                          accessor->sparse_count);
    }
    return TL_OK;
}

static float read_component(const unsigned char *at, uint32_t type, bool normalized)
{
    int16_t s16;
    uint16_t u16;
    uint32_t u32;
    float f32;
    switch (type) {
    case TL_GLTF_I8: {
        float value = (float)(at[0] < 128 ? (int)at[0] : (int)at[0] - 256);
        return !normalized ? value : value < -127.0f ? -1.0f : value / 127.0f;
    }
    case TL_GLTF_U8:
        return normalized ? (float)at[0] / 255.0f : (float)at[0];
    case TL_GLTF_I16:
        memcpy(&s16, at, sizeof s16);
        return !normalized ? (float)s16 : s16 < -32767 ? -1.0f : (float)s16 / 32767.0f;
    case TL_GLTF_U16:
        memcpy(&u16, at, sizeof u16);
        return normalized ? (float)u16 / 65535.0f : (float)u16;
    case TL_GLTF_U32:
        memcpy(&u32, at, sizeof u32);
        return (float)u32;
    default:
        memcpy(&f32, at, sizeof f32);
        return f32;
    }
}

static uint32_t read_index(const unsigned char *at, uint32_t type)
{
    uint16_t u16;
    uint32_t u32;
    if (type == TL_GLTF_U8) {
        return at[0];
    }
    if (type == TL_GLTF_U16) {
        memcpy(&u16, at, sizeof u16);
        return u16;
    }
    memcpy(&u32, at, sizeof u32);
    return u32;
}

static bool is_index_type(uint32_t type)
{
    return type == TL_GLTF_U8 || type == TL_GLTF_U16 || type == TL_GLTF_U32;
}

// Where elements go: to floats, or to indices where they are not NULL.
typedef struct element_copy {
    const tl_gltf_accessor *accessor;
    float *floats;
    uint32_t *indices;
} element_copy;

static void copy_element(const element_copy *copy, const unsigned char *at, size_t to)
{
    const tl_gltf_accessor *accessor = copy->accessor;
    if (copy->indices != NULL) {
        copy->indices[to] = read_index(at, accessor->component);
        return;
    }
    for (size_t k = 0; k < accessor->width; k++) {
        copy->floats[to * accessor->width + k] =
            read_component(at + k * accessor->component_size, accessor->component, accessor->is_normalized);
    }
}

// Elements that replace others.
static tl_result copy_sparse(tl_gltf_file *file, uint32_t index, const element_copy *copy)
{
    const tl_gltf_accessor *accessor = copy->accessor;
    uint32_t index_type = accessor->sparse_index_component;
    size_t index_size = index_type == TL_GLTF_U8 ? 1 : index_type == TL_GLTF_U16 ? 2 : 4;
    size_t size = (size_t)accessor->component_size * accessor->width;
    const unsigned char *indices = NULL;
    const unsigned char *values = NULL;
    if (!is_index_type(index_type) || accessor->sparse_index_view == TL_GLTF_NONE ||
        accessor->sparse_value_view == TL_GLTF_NONE) {
        return fail_damaged(file, "accessor", index, "has sparse elements that are not there");
    }
    const gltf_span from_indices = { accessor->sparse_index_view, accessor->sparse_index_offset, accessor->sparse_count,
                                     index_size, index_size };
    const gltf_span from_values = { accessor->sparse_value_view, accessor->sparse_value_offset, accessor->sparse_count,
                                    size, size };
    tl_result result = find_bytes(file, &from_indices, &indices);
    result = result == TL_OK ? find_bytes(file, &from_values, &values) : result;
    for (size_t i = 0; i < accessor->sparse_count && result == TL_OK; i++) {
        uint32_t to = read_index(indices + i * index_size, index_type);
        if (to >= accessor->count) {
            return fail_damaged(file, "accessor", index, "has sparse elements beyond its end");
        }
        copy_element(copy, values + i * size, to);
    }
    return result;
}

static tl_result copy_elements(tl_gltf_file *file, uint32_t index, const element_copy *copy)
{
    const tl_gltf_accessor *accessor = copy->accessor;
    tl_result result = TL_OK;
    if (accessor->view == TL_GLTF_NONE) {
        if (copy->indices != NULL) {
            memset(copy->indices, 0, accessor->count * sizeof *copy->indices);
        } else {
            memset(copy->floats, 0, accessor->count * accessor->width * sizeof *copy->floats);
        }
    } else {
        const gltf_span span = span_of_accessor(file, accessor);
        const unsigned char *bytes = NULL;
        result = find_bytes(file, &span, &bytes);
        for (size_t i = 0; i < accessor->count && result == TL_OK; i++) {
            copy_element(copy, bytes + i * span.stride, i);
        }
    }
    return result == TL_OK && accessor->sparse_count > 0 ? copy_sparse(file, index, copy) : result;
}

tl_result tl_gltf_read_floats(tl_gltf_file *file, uint32_t index, size_t width, float *out)
{
    const element_copy copy = { &file->data->accessors[index], out, NULL };
    if (copy.accessor->width != width || copy.accessor->component_size == 0) {
        return fail_damaged(file, "accessor", index, "is of a type that does not fit");
    }
    return copy_elements(file, index, &copy);
}

tl_result tl_gltf_read_indices(tl_gltf_file *file, uint32_t index, uint32_t *out)
{
    const element_copy copy = { &file->data->accessors[index], NULL, out };
    if (copy.accessor->width != 1 || !is_index_type(copy.accessor->component)) {
        return fail_damaged(file, "accessor", index, "is no list of indices");
    }
    return copy_elements(file, index, &copy);
}
