// SPDX-License-Identifier: MIT
//
// The part of io that asks the operating system, on whatever system this runs: tools/cross builds it with io for other
// machines and for Windows, without Assimp and Jansson. Its argument is an empty folder that it may fill.

#include "io/files/atomic_write.h"
#include "io/files/file_pack.h"
#include "io/files/sibling_file.h"
#include "io/mesh/mesh_import.h"
#include "io/mesh/obj_write.h"
#include "world/bytes/append_file.h"
#include "world/bytes/folder.h"
#include "world/bytes/random_read.h"
#include "world/bytes/thread_clock.h"

#include <talus/pack.h>
#include <talus/soup.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int faults;

#define EXPECT(condition)                                                                                              \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            printf("%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);                                             \
            faults++;                                                                                                  \
        }                                                                                                              \
    } while (0)

static const char *folder;

/// FOLDER/NAME, valid until the eighth call from here.
static const char *in_folder(const char *name)
{
    static char paths[8][2048];
    static int next;
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

static bool holds(const char *path, const char *text)
{
    tl_file_map map;
    if (tl_file_map_open(path, 0, &map, NULL) != TL_OK) {
        return false;
    }
    const bool same = map.size == strlen(text) && memcmp(map.bytes, text, map.size) == 0;
    const bool aligned = (uintptr_t)map.bytes % TL_BLOB_ALIGNMENT == 0;
    tl_file_map_close(&map);
    return same && aligned && map.bytes == NULL;
}

// Names that are no ASCII: Windows must not read them in the code page of the user.
static void whole_files(void)
{
    const char *path = in_folder("gr\xc3\xbc\xc3\x9f-\xe7\x8e\xa9\xe5\xae\xb6.txt");
    EXPECT(tl_atomic_write(path, "first", 5, NULL) == TL_OK);
    EXPECT(holds(path, "first"));
    EXPECT(tl_atomic_write(path, "the second", 10, NULL) == TL_OK);
    EXPECT(holds(path, "the second"));
    tl_atomic_file *file;
    EXPECT(tl_atomic_file_open(path, &file, NULL) == TL_OK);
    EXPECT(tl_atomic_file_write(file, "half", 4, NULL) == TL_OK && tl_atomic_file_size(file) == 4);
    EXPECT(holds(path, "the second"));
    tl_atomic_file_abort(file);
    EXPECT(holds(path, "the second"));
    EXPECT(tl_atomic_write(in_folder("empty"), "", 0, NULL) == TL_OK && holds(in_folder("empty"), ""));

    // Larger than every buffer.
    const size_t size = 300000;
    char *large = malloc(size + 1);
    for (size_t i = 0; i < size; i++) {
        large[i] = (char)('a' + i % 23);
    }
    large[size] = '\0';
    EXPECT(tl_atomic_write(in_folder("large"), large, size, NULL) == TL_OK && holds(in_folder("large"), large));
    tl_file_map map;
    tl_io_error error;
    EXPECT(tl_file_map_open(in_folder("large"), 1000, &map, &error) == TL_ERR_LIMIT && map.bytes == NULL);
    EXPECT(tl_file_read(in_folder("large"), 1000, &map, &error) == TL_ERR_LIMIT && map.bytes == NULL);
    // A copy stays what it is when the file is written anew.
    EXPECT(tl_file_read(in_folder("large"), 0, &map, &error) == TL_OK && map.size == size && !map.mapped);
    EXPECT(tl_atomic_write(in_folder("large"), "small", 5, NULL) == TL_OK && memcmp(map.bytes, large, size) == 0);
    tl_file_map_close(&map);
    free(large);
}

static void refusals(void)
{
    tl_io_error error;
    tl_file_map map;
    EXPECT(tl_file_map_open(in_folder("nothing"), 0, &map, &error) == TL_ERR_IO && strlen(error.message) > 12);
    EXPECT(strstr(error.advice, "path") != NULL);
    EXPECT(tl_file_map_open(folder, 0, &map, &error) == TL_ERR_IO && map.bytes == NULL);
    EXPECT(tl_atomic_write(folder, "x", 1, &error) == TL_ERR_IO);
    EXPECT(tl_atomic_write("", "x", 1, &error) == TL_ERR_IO);
    EXPECT(tl_atomic_write(in_folder("missing/file"), "x", 1, &error) == TL_ERR_IO);
#ifdef _WIN32
    EXPECT(tl_atomic_write("NUL", "x", 1, &error) == TL_OK);
    EXPECT(tl_file_map_open(in_folder("\xff\xfe"), 0, &map, &error) == TL_ERR_IO); // no UTF-8
#else
    EXPECT(tl_atomic_write("/dev/null", "x", 1, &error) == TL_OK);
#endif
}

static void siblings(void)
{
    static const char *const OUTSIDE[] = { "../large", "/etc/passwd",    "\\\\server\\share", "c:\\windows\\win.ini",
                                           "c:file",   "http://x/y.bin", "sub/../../large",   "." };
    const char *level = in_folder("level.gltf");
    tl_file_map map;
    tl_io_error error;
    EXPECT(tl_atomic_write(level, "{}", 2, NULL) == TL_OK);
    EXPECT(tl_atomic_write(in_folder("level.bin"), "bytes", 5, NULL) == TL_OK);
    EXPECT(tl_sibling_open(level, "level.bin", level, &map, &error) == TL_OK);
    EXPECT(map.size == 5 && memcmp(map.bytes, "bytes", 5) == 0);
    tl_file_map_close(&map);
    for (size_t i = 0; i < sizeof OUTSIDE / sizeof OUTSIDE[0]; i++) {
        const tl_result result = tl_sibling_open(level, OUTSIDE[i], level, &map, &error);
        EXPECT((result == TL_ERR_UNSUPPORTED || result == TL_ERR_IO) && map.bytes == NULL);
    }
    EXPECT(tl_sibling_open(level, "not-there.bin", level, &map, &error) == TL_ERR_IO);
}

static void meshes(void)
{
    static const char OBJ[] = "v 0 0 0\r\nv 1 0 0\nv 1 0 1.5\nv 0 0 1\nf 1 2 3 4\n";
    tl_imported_mesh mesh;
    tl_io_error error;
    EXPECT(tl_atomic_write(in_folder("quad.obj"), OBJ, sizeof OBJ - 1, NULL) == TL_OK);
    EXPECT(tl_import_mesh(in_folder("quad.obj"), NULL, &mesh, &error) == TL_OK);
    EXPECT(mesh.vertex_count == 4 && mesh.triangle_count == 2 && mesh.vertices[2].z == 1.5f);
    tl_imported_mesh_free(&mesh);
    // What this build lacks is known, and told.
    EXPECT(tl_import_mesh(in_folder("level.gltf"), NULL, &mesh, &error) == TL_ERR_UNSUPPORTED);
    EXPECT(strstr(error.message, "Jansson") != NULL && strstr(error.advice, "OBJ") != NULL);
    EXPECT(tl_atomic_write(in_folder("level.FBX"), "Kaydara FBX Binary  ", 20, NULL) == TL_OK);
    EXPECT(tl_import_mesh(in_folder("level.FBX"), NULL, &mesh, &error) == TL_ERR_UNSUPPORTED);
    EXPECT(strstr(error.message, "Assimp") != NULL);
}

static tl_result write_piece(const void *bytes, size_t size, void *user)
{
    return tl_atomic_file_write(user, bytes, size, NULL);
}

// What the command does with a baked file: the bytes are little-endian, and queries run on what was read.
static void baked_files(void)
{
    static const tl_vec3 CORNERS[4] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 1 }, { 0, 0, 1 } };
    static const uint32_t INDICES[6] = { 0, 2, 1, 0, 3, 2 };
    const tl_mesh_view quad = { CORNERS, 4, INDICES, 2, NULL };
    const char *path = in_folder("quad.talus");
    tl_soup *soup;
    tl_atomic_file *file;
    EXPECT(tl_soup_bake(&quad, NULL, &soup, NULL) == TL_OK);
    const tl_pack_item item = { TL_PACK_SOUP, 0, soup, tl_soup_size(soup) };
    EXPECT(tl_atomic_file_open(path, &file, NULL) == TL_OK);
    EXPECT(tl_pack_write(&item, 1, NULL, write_piece, file, NULL) == TL_OK);
    EXPECT(tl_atomic_file_commit(file, NULL) == TL_OK);
    tl_blob_free(soup);
    tl_file_map map;
    tl_pack pack;
    tl_pack_chunk chunk;
    tl_ray_hit hit;
    const tl_ray ray = { { 0.25f, 2.0f, 0.5f }, { 0.0f, -1.0f, 0.0f }, 10.0f };
    EXPECT(tl_file_read(path, 0, &map, NULL) == TL_OK);
    const unsigned char *bytes = map.bytes;
    EXPECT(bytes[8] == TL_PACK_VERSION && bytes[11] == 0); // little-endian, whatever the machine
    for (int time = 0; time < 2; time++) {                 // bytes that were turned round stay so
        EXPECT(tl_file_open_pack(&map, &pack, NULL) == TL_OK);
        EXPECT(tl_pack_find(&pack, TL_PACK_SOUP, 0, &chunk) == TL_OK);
        EXPECT(tl_soup_check(chunk.bytes, chunk.size, NULL) == TL_OK);
        EXPECT(tl_soup_cast_ray(chunk.bytes, &ray, NULL, &hit) && hit.t == 2.0f);
    }
    ((unsigned char *)(uintptr_t)map.bytes)[map.size - 1] ^= 1;
    EXPECT(tl_file_open_pack(&map, &pack, NULL) != TL_OK && pack.bytes == NULL);
    tl_file_map_close(&map);
}

// Folders of names so long that Windows' old calls give up, if the program may make them there.
static void long_names(void)
{
    char name[220];
    memset(name, 'n', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    const char *path = in_folder(name);
    EXPECT(tl_atomic_write(path, "long", 4, NULL) == TL_OK && holds(path, "long"));
}

typedef struct seen_names {
    int count, expected;
} seen_names;

static tl_result see_name(const char *name, void *user)
{
    seen_names *seen = user;
    seen->count++;
    seen->expected += strcmp(name, "here \xc3\xbc.txt") == 0 || strcmp(name, "below") == 0;
    return TL_OK;
}

// Folders, what the system says of files, and reading anywhere in them.
static void folders(void)
{
    tl_file_facts facts;
    tl_random_file file;
    tl_io_error error;
    char bytes[4] = "";
    seen_names seen = { 0, 0 };
    EXPECT(tl_folder_make(in_folder("store"), NULL) == TL_OK && tl_folder_make(in_folder("store"), NULL) == TL_OK);
    EXPECT(tl_folder_make(in_folder("store/below"), NULL) == TL_OK);
    const char *path = in_folder("store/here \xc3\xbc.txt");
    EXPECT(tl_atomic_write(path, "0123456789", 10, NULL) == TL_OK);
    EXPECT(tl_folder_make(path, &error) == TL_ERR_IO);
    EXPECT(tl_folder_list(in_folder("store"), see_name, &seen, NULL) == TL_OK && seen.count == 2 && seen.expected == 2);
    EXPECT(tl_folder_list(in_folder("none"), see_name, &seen, &error) == TL_ERR_IO);
    EXPECT(tl_file_look(path, &facts) && facts.size == 10 && !facts.is_folder &&
           facts.changed > 1500000000u * UINT64_C(1000000000));
    EXPECT(tl_file_look(in_folder("store"), &facts) && facts.is_folder && !tl_file_look(in_folder("none"), NULL));
    EXPECT(tl_random_file_open(in_folder("none"), &file, &error) == TL_ERR_IO && error.message[0] != '\0');
    EXPECT(tl_random_file_open(path, &file, NULL) == TL_OK);
    EXPECT(tl_random_file_read(&file, path, 6, bytes, 4, NULL) == TL_OK && memcmp(bytes, "6789", 4) == 0);
    EXPECT(tl_random_file_read(&file, path, 1, bytes, 3, NULL) == TL_OK && memcmp(bytes, "123", 3) == 0);
    EXPECT(tl_random_file_read(&file, path, 7, bytes, 4, &error) == TL_ERR_TRUNCATED);
    tl_random_file_close(&file);
    char *full = tl_full_path(path);
    EXPECT(full != NULL && tl_file_look(full, &facts) && facts.size == 10);
    free(full);
    tl_file_remove(path);
    EXPECT(!tl_file_look(path, NULL));
}

static void appending(void)
{
    const char *path = in_folder("gr\xc3\xbc\xc3\x9f.times");
    tl_io_error error;
    EXPECT(tl_file_append(path, "12", 2, NULL) == TL_OK && holds(path, "12"));
    EXPECT(tl_file_append(path, "345", 3, NULL) == TL_OK && holds(path, "12345"));
    EXPECT(tl_file_append(in_folder("none/below"), "1", 1, &error) == TL_ERR_IO && error.message[0] != '\0');
    tl_file_remove(path);
}

// Counts in steps of up to 15 ms.
static void thread_time(void)
{
    const uint64_t began = tl_thread_nanoseconds();
    uint64_t steps = 0;
    while (tl_thread_nanoseconds() == began && steps < UINT64_C(100000000)) {
        steps++;
    }
    EXPECT(tl_thread_nanoseconds() > began);
}

int main(int count, char **words)
{
    if (count != 2) {
        fprintf(stderr, "files FOLDER\n");
        return 2;
    }
    folder = words[1];
    whole_files();
    refusals();
    siblings();
    appending();
    thread_time();
    meshes();
    baked_files();
    long_names();
    folders();
    printf(faults == 0 ? "files: all as it should be\n" : "files: %d faults\n", faults);
    return faults != 0;
}
