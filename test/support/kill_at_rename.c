// SPDX-License-Identifier: MIT
//
// A library for LD_PRELOAD: kills its process at the n-th call of renameat, n from the environment's KILL_AT_RENAME. So
// a test loses a process in the middle of its work each time, however fast the machine is and whatever else it does.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

typedef int rename_function(int old_folder, const char *old_name, int new_folder, const char *new_name);

// Declared here, as <stdio.h> would promise that its arguments are never null.
rename_function renameat;

int renameat(int old_folder, const char *old_name, int new_folder, const char *new_name)
{
    static atomic_int calls;
    const char *at = getenv("KILL_AT_RENAME");
    if (at != NULL && atomic_fetch_add(&calls, 1) + 1 == atoi(at)) {
        raise(SIGKILL);
    }
    void *symbol = dlsym(RTLD_NEXT, "renameat");
    rename_function *next;
    memcpy(&next, &symbol, sizeof next); // C has no cast from a pointer to an object to one to a function
    return next(old_folder, old_name, new_folder, new_name);
}
