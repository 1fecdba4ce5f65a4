/* Counts the file operations below one folder, and ends the process, or fails, at the n-th: loaded before the C library.

   fault_arm(folder, nth, mode, error): mode 0 counts, 1 kills before operation nth, 2 writes half of it and kills,
   3 lets every operation from nth on that needs room fail with `error`, 4 only the nth. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

static char folder[PATH_MAX];
static long nth, done;
static int mode = -1, failure;
enum { COUNT, KILL, TORN, FULL, ONCE };
enum { NEEDS_ROOM = 1, A_WRITE = 2 };

void fault_arm(const char *where, long number, int how, int error) {
    snprintf(folder, sizeof folder, "%s", where);
    nth = number, done = 0, failure = error, mode = how;
}
void fault_disarm(void) { mode = -1; }
long fault_count(void) { return done; }

static int below(const char *path) { return strncmp(path, folder, strlen(folder)) == 0; }

static int is_ours(int base, const char *path) {
    char whole[2 * PATH_MAX], link[64];
    if (mode < 0 || !path) return 0;
    if (path[0] == '/') return below(path);
    ssize_t length;
    if (base == AT_FDCWD) length = getcwd(whole, PATH_MAX) ? (ssize_t)strlen(whole) : 0;
    else {
        snprintf(link, sizeof link, "/proc/self/fd/%d", base);
        length = readlink(link, whole, PATH_MAX);
    }
    if (length <= 0) return 0;
    snprintf(whole + length, PATH_MAX, "/%s", path);
    return below(whole);
}

static int is_our_file(int file) {
    char path[PATH_MAX], link[64];
    if (mode < 0) return 0;
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    ssize_t length = readlink(link, path, sizeof path - 1);
    if (length <= 0) return 0;
    path[length] = 0;
    return below(path);
}

static void die(void) {
    syscall(SYS_kill, getpid(), SIGKILL);
    for (;;) pause();
}

/* 0: go on; 1: fail; 2: write half, then die */
static int due(int what) {
    long number = __atomic_add_fetch(&done, 1, __ATOMIC_SEQ_CST);
    if (mode == KILL && number == nth) die();
    if (mode == TORN && number == nth) {
        if (what & A_WRITE) return 2;
        die();
    }
    if ((what & NEEDS_ROOM) && ((mode == FULL && number >= nth) || (mode == ONCE && number == nth))) {
        errno = failure;
        return 1;
    }
    return 0;
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
#define CHECK(ours, what, failed) if ((ours) && due(what) == 1) return failed

static int makes(int flags) { return flags & (O_CREAT | O_WRONLY | O_RDWR | O_TRUNC); }
#define MODE_OF(flags) mode_t bits = 0; if (flags & (O_CREAT | O_TMPFILE)) { va_list rest; va_start(rest, flags); bits = va_arg(rest, int); va_end(rest); }

int open(const char *path, int flags, ...) { MODE_OF(flags)
    CHECK(makes(flags) && is_ours(AT_FDCWD, path), NEEDS_ROOM, -1); return REAL(open)(path, flags, bits); }
int open64(const char *path, int flags, ...) { MODE_OF(flags)
    CHECK(makes(flags) && is_ours(AT_FDCWD, path), NEEDS_ROOM, -1); return REAL(open64)(path, flags, bits); }
int openat(int base, const char *path, int flags, ...) { MODE_OF(flags)
    CHECK(makes(flags) && is_ours(base, path), NEEDS_ROOM, -1); return REAL(openat)(base, path, flags, bits); }
int openat64(int base, const char *path, int flags, ...) { MODE_OF(flags)
    CHECK(makes(flags) && is_ours(base, path), NEEDS_ROOM, -1); return REAL(openat64)(base, path, flags, bits); }
FILE *fopen(const char *path, const char *how) { CHECK(how[0] != 'r' && is_ours(AT_FDCWD, path), NEEDS_ROOM, NULL); return REAL(fopen)(path, how); }
FILE *fopen64(const char *path, const char *how) { CHECK(how[0] != 'r' && is_ours(AT_FDCWD, path), NEEDS_ROOM, NULL); return REAL(fopen64)(path, how); }

#define WRITES(call, half) \
    if (is_our_file(file)) { int verdict = due(NEEDS_ROOM | A_WRITE); if (verdict == 1) return -1; if (verdict == 2) { half; die(); } } \
    return call
ssize_t write(int file, const void *data, size_t size) { WRITES(REAL(write)(file, data, size), REAL(write)(file, data, size / 2)); }
ssize_t pwrite(int file, const void *data, size_t size, off_t at) { WRITES(REAL(pwrite)(file, data, size, at), REAL(pwrite)(file, data, size / 2, at)); }
ssize_t pwrite64(int file, const void *data, size_t size, off64_t at) { WRITES(REAL(pwrite64)(file, data, size, at), REAL(pwrite64)(file, data, size / 2, at)); }
ssize_t writev(int file, const struct iovec *parts, int count) { WRITES(REAL(writev)(file, parts, count), REAL(writev)(file, parts, count / 2)); }

ssize_t sendfile(int file, int from, off_t *at, size_t size) { WRITES(REAL(sendfile)(file, from, at, size), REAL(sendfile)(file, from, at, size / 2)); }
ssize_t sendfile64(int file, int from, off64_t *at, size_t size) { WRITES(REAL(sendfile64)(file, from, at, size), REAL(sendfile64)(file, from, at, size / 2)); }

int fsync(int file) { CHECK(is_our_file(file), NEEDS_ROOM, -1); return REAL(fsync)(file); }
int fdatasync(int file) { CHECK(is_our_file(file), NEEDS_ROOM, -1); return REAL(fdatasync)(file); }
int ftruncate(int file, off_t size) { CHECK(is_our_file(file), 0, -1); return REAL(ftruncate)(file, size); }
int ftruncate64(int file, off64_t size) { CHECK(is_our_file(file), 0, -1); return REAL(ftruncate64)(file, size); }
int mkdir(const char *path, mode_t bits) { CHECK(is_ours(AT_FDCWD, path), NEEDS_ROOM, -1); return REAL(mkdir)(path, bits); }
int mkdirat(int base, const char *path, mode_t bits) { CHECK(is_ours(base, path), NEEDS_ROOM, -1); return REAL(mkdirat)(base, path, bits); }
int rename(const char *a, const char *b) { CHECK(is_ours(AT_FDCWD, a) || is_ours(AT_FDCWD, b), NEEDS_ROOM, -1); return REAL(rename)(a, b); }
int renameat(int i, const char *a, int j, const char *b) { CHECK(is_ours(i, a) || is_ours(j, b), NEEDS_ROOM, -1); return REAL(renameat)(i, a, j, b); }
int renameat2(int i, const char *a, int j, const char *b, unsigned how) {
    CHECK(is_ours(i, a) || is_ours(j, b), NEEDS_ROOM, -1); return syscall(SYS_renameat2, i, a, j, b, how); }
int link(const char *a, const char *b) { CHECK(is_ours(AT_FDCWD, b), NEEDS_ROOM, -1); return REAL(link)(a, b); }
int linkat(int i, const char *a, int j, const char *b, int how) { CHECK(is_ours(j, b), NEEDS_ROOM, -1); return REAL(linkat)(i, a, j, b, how); }
int unlink(const char *path) { CHECK(is_ours(AT_FDCWD, path), 0, -1); return REAL(unlink)(path); }
int unlinkat(int base, const char *path, int how) { CHECK(is_ours(base, path), 0, -1); return REAL(unlinkat)(base, path, how); }
int rmdir(const char *path) { CHECK(is_ours(AT_FDCWD, path), 0, -1); return REAL(rmdir)(path); }
