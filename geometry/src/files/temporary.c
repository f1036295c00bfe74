#include "geometry/src/files/temporary.h"
#include "geometry/mem.h"
#include "geometry/write_whole.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

char *temporary_name(const char *path)
{
    size_t folder = folder_length(path), size = strlen(path) + 40;
    char *name = NEW_ARRAY(char, size);
    snprintf(name, size, "%.*s.%s.%ld.part", (int)folder, path, path + folder, (long)getpid());
    return name;
}

void temporary_lock(int descriptor) { (void)!flock(descriptor, LOCK_EX | LOCK_NB); }

static int remove_entry(const char *path, const struct stat *info, int kind, struct FTW *walk)
{
    (void)info, (void)kind, (void)walk;
    return remove(path);
}

void temporary_remove(const char *name) { nftw(name, remove_entry, 8, FTW_DEPTH | FTW_PHYS); }

/* The process in ".name.<process>.part", 0 for any other name. */
static long process_in(const char *entry, const char *name)
{
    size_t n = strlen(name);
    char *end;
    if (entry[0] != '.' || strncmp(entry + 1, name, n) || entry[1 + n] != '.') return 0;
    const char *digits = entry + n + 2;
    if (*digits < '1' || *digits > '9') return 0;
    long process = strtol(digits, &end, 10);
    return strcmp(end, ".part") ? 0 : process;
}

char *temporary_target(const char *path)
{
    char *target = NEW_ARRAY(char, strlen(path) + 1), *to = target;
    while (*path) {
        size_t n = strcspn(path, "/");
        char *part = (char *)mem_copy(path, n + 1, 1), *end = NULL;
        part[n] = 0;
        if (n > 6 && *part == '.' && !strcmp(part + n - 5, ".part")) {
            part[n - 5] = 0;
            end = strrchr(part + 1, '.');
        }
        if (end && end > part + 1 && end[1] && strspn(end + 1, "0123456789") == strlen(end + 1)) {
            memcpy(to, part + 1, (size_t)(end - part - 1));
            to += end - part - 1;
        } else {
            memcpy(to, path, n);
            to += n;
        }
        free(part);
        path += n;
        while (*path == '/') *to++ = *path++;
    }
    return target;
}

static bool runs(long process) { return !kill((pid_t)process, 0) || errno == EPERM; }

/* True if somebody makes it; else it is removed, unless a process of its number runs (which then has another task). */
static bool is_made_or_gone(const char *path, long process)
{
    int file = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return false;
    bool taken = flock(file, LOCK_EX | LOCK_NB) != 0, ours = process == (long)getpid();
    bool made = taken && (errno == EWOULDBLOCK || (runs(process) && !ours));
    if (!made && (ours || !runs(process))) temporary_remove(path);
    close(file);
    return made;
}

long temporary_sweep(const char *path, const char *own)
{
    size_t length = folder_length(path);
    char *folder = length ? mem_text(path) : mem_text("./");
    if (length) folder[length] = 0;
    DIR *list = opendir(folder);
    long busy = 0;
    for (struct dirent *entry = list ? readdir(list) : NULL; entry; entry = readdir(list)) {
        long process = process_in(entry->d_name, path + length);
        if (process <= 0) continue;
        size_t size = strlen(folder) + strlen(entry->d_name) + 1;
        char *there = NEW_ARRAY(char, size);
        snprintf(there, size, "%s%s", length ? folder : "", entry->d_name);
        if (!(own && !strcmp(own, there)) && is_made_or_gone(there, process)) busy = process;
        free(there);
    }
    if (list) closedir(list);
    free(folder);
    return busy;
}

/* ---- at a sudden end: nothing here may allocate or wait ---- */

enum { REMEMBERED = 16, NAME_SIZE = 4096 };
static struct {
    atomic_flag taken;
    volatile long process; /* 0: not whole yet; a forked child has another number and leaves the name alone */
    int descriptor;
    char name[NAME_SIZE];
} remembered[REMEMBERED];

void temporary_remember(int descriptor, const char *name)
{
    if (strlen(name) >= NAME_SIZE) return;
    for (int i = 0; i < REMEMBERED; i++) {
        if (atomic_flag_test_and_set(&remembered[i].taken)) continue;
        remembered[i].descriptor = descriptor;
        strcpy(remembered[i].name, name);
        remembered[i].process = (long)getpid();
        return;
    }
}

void temporary_forget(int descriptor)
{
    for (int i = 0; i < REMEMBERED; i++) {
        if (!remembered[i].process || remembered[i].descriptor != descriptor) continue;
        remembered[i].process = 0;
        atomic_flag_clear(&remembered[i].taken);
    }
}

struct listed { /* as the kernel gives it */
    uint64_t inode;
    int64_t next;
    unsigned short size;
    unsigned char kind;
    char name[];
};

static void empty_folder(int folder, int depth)
{
    _Alignas(8) char bytes[4096];
    lseek(folder, 0, SEEK_SET);
    for (long n; (n = syscall(SYS_getdents64, folder, bytes, sizeof bytes)) > 0;)
        for (long at = 0; at < n;) {
            const struct listed *entry = (const struct listed *)(bytes + at);
            at += entry->size;
            if (!strcmp(entry->name, ".") || !strcmp(entry->name, "..")) continue;
            if (!unlinkat(folder, entry->name, 0) || !depth) continue;
            int inner = openat(folder, entry->name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
            if (inner < 0) continue;
            empty_folder(inner, depth - 1);
            close(inner);
            unlinkat(folder, entry->name, AT_REMOVEDIR);
        }
}

/* Once folders are exchanged the name is that of the earlier results: what bears the name goes, not what the descriptor
 * was opened on. */
void whole_folder_abandon_all(void)
{
    for (int i = 0; i < REMEMBERED; i++) {
        if (remembered[i].process != (long)getpid() || !unlink(remembered[i].name)) continue;
        int folder = open(remembered[i].name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        if (folder < 0) continue;
        empty_folder(folder, 4);
        close(folder);
        rmdir(remembered[i].name);
    }
}
