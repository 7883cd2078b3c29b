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
    size_t buffers = (file->data->buffers_count + 1) * sizeof *file->buffers;
    size_t views = (file->data->buffer_views_count + 1) * sizeof *file->views;
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
    free_bytes(file, file->buffers, file->data->buffers_count);
    free_bytes(file, file->views, file->data->buffer_views_count);
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

// A name as it stands in JSON, to what it means.
static tl_result load_named_file(tl_gltf_file *file, size_t index, tl_gltf_bytes *loaded)
{
    char *name = file->data->buffers[index].uri;
    cgltf_decode_string(name);
    // Most writers escape a blank as %20, some do not: a file of the very name goes first.
    tl_result result = tl_sibling_open(file->source->path, name, file->source->name, &loaded->map, file->error);
    if (result == TL_ERR_IO && strchr(name, '%') != NULL) {
        cgltf_decode_uri(name);
        result = tl_sibling_open(file->source->path, name, file->source->name, &loaded->map, file->error);
    }
    loaded->bytes = loaded->map.bytes;
    loaded->size = loaded->map.size;
    if (result == TL_OK && loaded->size < file->data->buffers[index].size) {
        return fail_damaged(file, "buffer", index, "is shorter than it says");
    }
    return result;
}

static tl_result load_buffer(tl_gltf_file *file, const cgltf_buffer *buffer, tl_gltf_bytes **loaded_out)
{
    size_t index = (size_t)(buffer - file->data->buffers);
    tl_gltf_bytes *loaded = &file->buffers[index];
    *loaded_out = loaded;
    if (loaded->bytes != NULL) {
        return TL_OK;
    }
    if (buffer->uri == NULL) {
        if (index != 0 || file->data->bin == NULL || file->data->bin_size < buffer->size) {
            return fail_damaged(file, "buffer", index, "has no bytes");
        }
        loaded->bytes = file->data->bin;
        loaded->size = file->data->bin_size;
        return TL_OK;
    }
    if (strncmp(buffer->uri, "data:", 5) == 0) {
        return load_data_uri(file, index, buffer->uri, loaded);
    }
    return load_named_file(file, index, loaded);
}

// --- views ----------------------------------------------------------------------------------------------------------

#ifdef TALUS_HAVE_MESHOPTIMIZER
static int decode_meshopt(const cgltf_meshopt_compression *packed, const unsigned char *bytes, void *out)
{
    switch (packed->mode) {
    case cgltf_meshopt_compression_mode_attributes:
        return meshopt_decodeVertexBuffer(out, packed->count, packed->stride, bytes, packed->size);
    case cgltf_meshopt_compression_mode_triangles:
        return meshopt_decodeIndexBuffer(out, packed->count, packed->stride, bytes, packed->size);
    case cgltf_meshopt_compression_mode_indices:
        return meshopt_decodeIndexSequence(out, packed->count, packed->stride, bytes, packed->size);
    default:
        return -1;
    }
}

// What the decoder takes as its caller's duty.
static bool is_sound_meshopt(const cgltf_meshopt_compression *packed, size_t there)
{
    bool attributes = packed->mode == cgltf_meshopt_compression_mode_attributes;
    bool triangles = packed->mode == cgltf_meshopt_compression_mode_triangles;
    if (packed->offset > there || packed->size > there - packed->offset || packed->count == 0 ||
        packed->count > TL_MAX_MESH_TRIANGLES || packed->count / 512 > packed->size) {
        return false;
    }
    return attributes ? packed->stride > 0 && packed->stride % 4 == 0 && packed->stride <= 256
                      : (packed->stride == 2 || packed->stride == 4) && (!triangles || packed->count % 3 == 0);
}

static tl_result decode_view(tl_gltf_file *file, const cgltf_buffer_view *view, tl_gltf_bytes *decoded)
{
    const cgltf_meshopt_compression *packed = &view->meshopt_compression;
    size_t index = (size_t)(view - file->data->buffer_views);
    tl_gltf_bytes *buffer;
    if (packed->buffer == NULL) {
        return fail_damaged(file, "buffer view", index, "has no bytes");
    }
    tl_result result = load_buffer(file, packed->buffer, &buffer);
    if (result != TL_OK) {
        return result;
    }
    if (!is_sound_meshopt(packed, buffer->size)) {
        return fail_damaged(file, "buffer view", index, "is not packed as EXT_meshopt_compression says");
    }
    decoded->size = packed->count * packed->stride;
    decoded->owned = tl_io_allocate(&file->allocator, decoded->size);
    if (decoded->owned == NULL) {
        return tl_io_fail(file->error, TL_ERR_MEMORY, file->source->name, 0, NULL, "out of memory");
    }
    if (decode_meshopt(packed, buffer->bytes + packed->offset, decoded->owned) != 0) {
        return fail_damaged(file, "buffer view", index, "does not unpack");
    }
    // The other filters are those of normals and turns; instances have turns.
    if (packed->filter == cgltf_meshopt_compression_filter_exponential) {
        meshopt_decodeFilterExp(decoded->owned, packed->count, packed->stride);
    } else if (packed->filter == cgltf_meshopt_compression_filter_quaternion && packed->stride == 8) {
        meshopt_decodeFilterQuat(decoded->owned, packed->count, packed->stride);
    } else if (packed->filter != cgltf_meshopt_compression_filter_none) {
        return fail_damaged(file, "buffer view", index, "has a filter that does not fit");
    }
    decoded->bytes = decoded->owned;
    return TL_OK;
}
#else
static tl_result decode_view(tl_gltf_file *file, const cgltf_buffer_view *view, tl_gltf_bytes *decoded)
{
    (void)view;
    (void)decoded;
    return tl_io_fail(file->error, TL_ERR_UNSUPPORTED, file->source->name, 0,
                      "export it without compression, or build talus with meshoptimizer",
                      "its meshes are packed by EXT_meshopt_compression");
}
#endif

// The bytes of a view from `offset` on: `count` elements of `size` bytes, `stride` apart.
static tl_result find_bytes(tl_gltf_file *file, const cgltf_buffer_view *view, size_t offset, size_t count, size_t size,
                            size_t stride, const unsigned char **bytes_out)
{
    size_t index = (size_t)(view - file->data->buffer_views);
    tl_gltf_bytes *decoded = &file->views[index];
    tl_gltf_bytes *from = decoded;
    size_t begin = 0;
    tl_result result = TL_OK;
    if (!view->has_meshopt_compression) {
        if (view->buffer == NULL) {
            return fail_damaged(file, "buffer view", index, "has no buffer");
        }
        result = load_buffer(file, view->buffer, &from);
        begin = view->offset;
    } else if (decoded->bytes == NULL) {
        result = decode_view(file, view, decoded);
    }
    if (result != TL_OK) {
        return result;
    }
    size_t there = from->size;
    bool inside = begin <= there && view->size <= there - begin && offset <= view->size && size <= view->size - offset;
    if (!inside || (count > 1 && stride > 0 && (view->size - offset - size) / stride < count - 1)) {
        return fail_damaged(file, "buffer view", index, "is too short for what is read from it");
    }
    *bytes_out = from->bytes + begin + offset;
    return TL_OK;
}

// --- accessors ------------------------------------------------------------------------------------------------------

tl_result tl_gltf_check_accessor(tl_gltf_file *file, const cgltf_accessor *accessor)
{
    size_t index = (size_t)(accessor - file->data->accessors);
    const unsigned char *bytes;
    size_t size = cgltf_calc_size(accessor->type, accessor->component_type);
    if (accessor->count == 0 || size == 0) {
        return fail_damaged(file, "accessor", index, "is empty or of no known type");
    }
    if (accessor->buffer_view == NULL) {
        return fail_damaged(file, "accessor", index, "has no data");
    }
    if (accessor->count > TL_MAX_MESH_TRIANGLES) {
        return tl_io_fail(file->error, TL_ERR_LIMIT, file->source->name, 0, "cut the level into parts",
                          "accessor %zu has more elements than one mesh may have", index);
    }
    size_t stride = accessor->stride > 0 ? accessor->stride : size;
    return find_bytes(file, accessor->buffer_view, accessor->offset, accessor->count, size, stride, &bytes);
}

static float read_component(const unsigned char *at, cgltf_component_type type, bool normalized)
{
    int16_t s16;
    uint16_t u16;
    uint32_t u32;
    float f32;
    switch (type) {
    case cgltf_component_type_r_8: {
        float value = (float)(at[0] < 128 ? (int)at[0] : (int)at[0] - 256);
        return !normalized ? value : value < -127.0f ? -1.0f : value / 127.0f;
    }
    case cgltf_component_type_r_8u:
        return normalized ? (float)at[0] / 255.0f : (float)at[0];
    case cgltf_component_type_r_16:
        memcpy(&s16, at, sizeof s16);
        return !normalized ? (float)s16 : s16 < -32767 ? -1.0f : (float)s16 / 32767.0f;
    case cgltf_component_type_r_16u:
        memcpy(&u16, at, sizeof u16);
        return normalized ? (float)u16 / 65535.0f : (float)u16;
    case cgltf_component_type_r_32u:
        memcpy(&u32, at, sizeof u32);
        return (float)u32;
    default:
        memcpy(&f32, at, sizeof f32);
        return f32;
    }
}

static uint32_t read_index(const unsigned char *at, cgltf_component_type type)
{
    uint16_t u16;
    uint32_t u32;
    if (type == cgltf_component_type_r_8u) {
        return at[0];
    }
    if (type == cgltf_component_type_r_16u) {
        memcpy(&u16, at, sizeof u16);
        return u16;
    }
    memcpy(&u32, at, sizeof u32);
    return u32;
}

static bool is_index_type(cgltf_component_type type)
{
    return type == cgltf_component_type_r_8u || type == cgltf_component_type_r_16u ||
           type == cgltf_component_type_r_32u;
}

// Elements that replace others.
static tl_result read_sparse(tl_gltf_file *file, const cgltf_accessor *accessor, size_t width, float *out)
{
    const cgltf_accessor_sparse *sparse = &accessor->sparse;
    size_t index = (size_t)(accessor - file->data->accessors);
    size_t index_size = cgltf_component_size(sparse->indices_component_type);
    size_t component = cgltf_component_size(accessor->component_type);
    const unsigned char *indices;
    const unsigned char *values;
    if (!is_index_type(sparse->indices_component_type) || sparse->indices_buffer_view == NULL ||
        sparse->values_buffer_view == NULL || sparse->count > accessor->count) {
        return fail_damaged(file, "accessor", index, "has sparse elements that are not there");
    }
    if (sparse->count == 0) {
        return TL_OK;
    }
    tl_result result = find_bytes(file, sparse->indices_buffer_view, sparse->indices_byte_offset, sparse->count,
                                  index_size, index_size, &indices);
    if (result == TL_OK) {
        result = find_bytes(file, sparse->values_buffer_view, sparse->values_byte_offset, sparse->count,
                            component * width, component * width, &values);
    }
    for (size_t i = 0; i < sparse->count && result == TL_OK; i++) {
        uint32_t at = read_index(indices + i * index_size, sparse->indices_component_type);
        if (at >= accessor->count) {
            return fail_damaged(file, "accessor", index, "has sparse elements beyond its end");
        }
        for (size_t k = 0; k < width; k++) {
            out[at * width + k] = read_component(values + (i * width + k) * component, accessor->component_type,
                                                 accessor->normalized != 0);
        }
    }
    return result;
}

tl_result tl_gltf_read_floats(tl_gltf_file *file, const cgltf_accessor *accessor, size_t width, float *out)
{
    size_t index = (size_t)(accessor - file->data->accessors);
    size_t component = cgltf_component_size(accessor->component_type);
    size_t stride = accessor->stride > 0 ? accessor->stride : component * width;
    const unsigned char *bytes = NULL;
    if (cgltf_num_components(accessor->type) != width || component == 0) {
        return fail_damaged(file, "accessor", index, "is of a type that does not fit");
    }
    tl_result result =
        find_bytes(file, accessor->buffer_view, accessor->offset, accessor->count, component * width, stride, &bytes);
    for (size_t i = 0; i < accessor->count && result == TL_OK; i++) {
        for (size_t k = 0; k < width; k++) {
            out[i * width + k] =
                read_component(bytes + i * stride + k * component, accessor->component_type, accessor->normalized != 0);
        }
    }
    return result == TL_OK && accessor->is_sparse ? read_sparse(file, accessor, width, out) : result;
}

tl_result tl_gltf_read_indices(tl_gltf_file *file, const cgltf_accessor *accessor, uint32_t *out)
{
    size_t index = (size_t)(accessor - file->data->accessors);
    size_t size = cgltf_component_size(accessor->component_type);
    size_t stride = accessor->stride > 0 ? accessor->stride : size;
    const unsigned char *bytes = NULL;
    if (accessor->type != cgltf_type_scalar || !is_index_type(accessor->component_type) || accessor->is_sparse) {
        return fail_damaged(file, "accessor", index, "is no list of indices");
    }
    tl_result result = find_bytes(file, accessor->buffer_view, accessor->offset, accessor->count, size, stride, &bytes);
    for (size_t i = 0; i < accessor->count && result == TL_OK; i++) {
        out[i] = read_index(bytes + i * stride, accessor->component_type);
    }
    return result;
}
