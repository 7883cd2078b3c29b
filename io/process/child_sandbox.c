// SPDX-License-Identifier: MIT
//
// seccomp with an allow-list, as a program for the kernel's packet filter, by hand: 60 lines do not need a library.
//
// A call that is not on the list fails with EPERM, as it may on any system, instead of killing: a reader that asks for
// a terminal's size is no attack. What the filter does not see is which file is opened for reading: paths are held to
// the level's folder by sibling_file.c, and what a reader that was taken over reads can only go into the mesh.

#define _GNU_SOURCE

#include "io/process/child_sandbox.h"

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__) || (defined(__riscv) && __riscv_xlen == 64))

#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#if defined(__x86_64__)
#define OWN_ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined(__aarch64__)
#define OWN_ARCHITECTURE AUDIT_ARCH_AARCH64
#else
#define OWN_ARCHITECTURE AUDIT_ARCH_RISCV64
#endif

// Calls that need no look at their arguments: memory, time, what a process knows of itself, looking at files, reading.
static const uint16_t harmless[] = {
    SYS_brk,
    SYS_mmap,
    SYS_munmap,
    SYS_mremap,
    SYS_mprotect,
    SYS_madvise,
    SYS_exit,
    SYS_exit_group,
    SYS_rt_sigreturn,
    SYS_futex,
    SYS_rt_sigaction,
    SYS_rt_sigprocmask,
    SYS_sigaltstack,
    SYS_clock_gettime,
    SYS_gettimeofday,
    SYS_getpid,
    SYS_gettid,
    SYS_getcwd,
    SYS_sched_yield,
    SYS_clock_nanosleep,
    SYS_nanosleep,
    SYS_getrandom,
    SYS_sysinfo,
    SYS_uname,
    SYS_read,
    SYS_readv,
    SYS_pread64,
    SYS_lseek,
    SYS_close,
    SYS_fstat,
    SYS_readlinkat,
    SYS_faccessat,
    SYS_sched_getaffinity,
#ifdef SYS_newfstatat
    SYS_newfstatat,
#endif
#ifdef SYS_faccessat2
    SYS_faccessat2,
#endif
#ifdef SYS_statx
    SYS_statx,
#endif
#ifdef SYS_stat
    SYS_stat,
    SYS_lstat,
    SYS_readlink,
    SYS_access,
    SYS_pause,
#endif
#ifdef SYS_ppoll
    SYS_ppoll,
#endif
};

enum { HARMLESS_COUNT = sizeof harmless / sizeof harmless[0], LONGEST = 2 * HARMLESS_COUNT + 40 };

// A call's argument, its lower half: both of this machine's and of the kernel's numbers are little-endian.
#define ARGUMENT(i) (uint32_t)(offsetof(struct seccomp_data, args) + 8 * (i))

typedef struct filter_program {
    struct sock_filter steps[LONGEST];
    uint16_t length;
} filter_program;

static void add_step(filter_program *p, uint16_t code, uint8_t if_true, uint8_t if_false, uint32_t value)
{
    p->steps[p->length++] = (struct sock_filter){ code, if_true, if_false, value };
}

static void add_load(filter_program *p, uint32_t offset)
{
    add_step(p, BPF_LD | BPF_W | BPF_ABS, 0, 0, offset);
}

static void add_answer(filter_program *p, uint32_t answer)
{
    add_step(p, BPF_RET | BPF_K, 0, 0, answer);
}

static const uint32_t refused = SECCOMP_RET_ERRNO | EPERM;

// Call `number` is allowed where its argument equals `value`.
static void allow_if_equal(filter_program *p, uint32_t number, uint32_t argument, uint32_t value)
{
    add_step(p, BPF_JMP | BPF_JEQ | BPF_K, 0, 4, number);
    add_load(p, ARGUMENT(argument));
    add_step(p, BPF_JMP | BPF_JEQ | BPF_K, 0, 1, value);
    add_answer(p, SECCOMP_RET_ALLOW);
    add_answer(p, refused);
}

// Call `number` is allowed where its argument has none of the bits.
static void allow_without_bits(filter_program *p, uint32_t number, uint32_t argument, uint32_t bits)
{
    add_step(p, BPF_JMP | BPF_JEQ | BPF_K, 0, 4, number);
    add_load(p, ARGUMENT(argument));
    add_step(p, BPF_JMP | BPF_JSET | BPF_K, 1, 0, bits);
    add_answer(p, SECCOMP_RET_ALLOW);
    add_answer(p, refused);
}

static void write_filter(filter_program *p, uint32_t pipe)
{
    const uint32_t writing = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND | (O_TMPFILE & ~O_DIRECTORY);
    add_load(p, offsetof(struct seccomp_data, arch));
    add_step(p, BPF_JMP | BPF_JEQ | BPF_K, 1, 0, OWN_ARCHITECTURE);
    add_answer(p, refused);
    add_load(p, offsetof(struct seccomp_data, nr));
    for (uint32_t i = 0; i < HARMLESS_COUNT; i++) {
        add_step(p, BPF_JMP | BPF_JEQ | BPF_K, 0, 1, harmless[i]);
        add_answer(p, SECCOMP_RET_ALLOW);
    }
    allow_if_equal(p, SYS_write, 0, pipe);
    allow_without_bits(p, SYS_openat, 2, writing);
#ifdef SYS_open
    allow_without_bits(p, SYS_open, 1, writing);
#endif
    // A failed assertion of a reader's ends this process, by a signal to itself.
    allow_if_equal(p, SYS_tgkill, 0, (uint32_t)getpid());
    allow_if_equal(p, SYS_fcntl, 1, F_GETFL);
    add_answer(p, refused);
}

bool tl_enter_child_sandbox(int pipe)
{
    filter_program program = { .length = 0 };
    write_filter(&program, (uint32_t)pipe);
    const struct sock_fprog filter = { program.length, program.steps };
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

#else

bool tl_enter_child_sandbox(int pipe)
{
    (void)pipe;
    return false;
}

#endif
