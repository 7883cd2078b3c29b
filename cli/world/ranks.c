// SPDX-License-Identifier: MIT

#include "cli/world/ranks.h"

#include "cli/shared/start.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef TALUS_MPI_MODULE // a file's name, where the module is built
#include <dlfcn.h>

enum { MAX_MODULE_PATH = 4096 };

// Beside the program where it was built, else where it is installed.
static void *open_module(void)
{
    static const char *const places[] = { TALUS_MPI_MODULE, TALUS_MPI_MODULE_INSTALLED };
    char path[MAX_MODULE_PATH], module[MAX_MODULE_PATH + 256];
    char *slash = tl_own_path(path, sizeof path) ? strrchr(path, '/') : NULL;
    void *library = NULL;
    for (int i = 0; i < 2 && slash != NULL && library == NULL; i++) {
        *slash = '\0';
        snprintf(module, sizeof module, "%s/%s", path, places[i]);
        FILE *file = fopen(module, "rb");
        if (file != NULL) {
            fclose(file);
            library = dlopen(module, RTLD_NOW | RTLD_GLOBAL); // global: MPI loads modules of its own, which look for it
        }
    }
    return library;
}

static bool is_launched(const char *variable)
{
    const char *text = getenv(variable);
    return text != NULL && text[0] != '\0';
}

static const char *join_processes(tl_ranks *ranks)
{
    if (!is_launched("OMPI_COMM_WORLD_SIZE") && !is_launched("PMI_SIZE")) {
        return NULL;
    }
    (void)dlerror();
    void *library = open_module();
    if (library == NULL) {
        return dlerror(); // NULL when there is no such file
    }
    tl_rank_calls_fn *get;
    *(void **)(void *)&get = dlsym(library, "tl_rank_calls_of_mpi");
    const tl_rank_calls *calls = get != NULL ? get() : NULL;
    if (calls == NULL || calls->version != TL_RANK_CALLS_VERSION) {
        return "the MPI module is of another version";
    }
    if (!is_launched(calls->variable)) {
        return "the MPI module was built for another MPI than the one that runs this";
    }
    if (!calls->begin(&ranks->index, &ranks->count)) {
        return "MPI does not start";
    }
    ranks->calls = calls; // the library stays open: MPI does not survive being closed
    return NULL;
}
#else
static const char *join_processes(tl_ranks *ranks)
{
    (void)ranks;
    return NULL;
}
#endif

const char *tl_ranks_join(tl_ranks *ranks_out)
{
    ranks_out->calls = NULL;
    ranks_out->index = 0;
    ranks_out->count = 1;
    return join_processes(ranks_out);
}

void tl_ranks_gather(const tl_ranks *ranks, const uint64_t mine[TL_RANK_NUMBERS], uint64_t *all_out)
{
    if (ranks->calls != NULL) {
        ranks->calls->gather(mine, all_out);
    } else {
        memcpy(all_out, mine, TL_RANK_NUMBERS * sizeof *mine);
    }
}

void tl_ranks_leave(tl_ranks *ranks)
{
    if (ranks->calls != NULL) {
        ranks->calls->end();
        ranks->calls = NULL;
    }
}
