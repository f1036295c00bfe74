#include "geometry/write_whole.h"
#include "geometry/mem.h"
#include "geometry/src/files/temporary.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool cannot_write(const char *path, int number, err *e)
{
    char *target = temporary_target(path);
    (void)err_at(e, ERR_RESOURCE, target, 0, NULL, "cannot be written: %s", strerror(number));
    free(target);
    return false;
}

/* Makes the new name itself survive a power cut. Some file systems cannot do this; the data are safe anyway.
 */
static void sync_folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    char *folder = slash ? mem_text(path) : mem_text(".");
    if (slash) folder[slash == path ? 1 : slash - path] = 0;
    int fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd >= 0) {
        (void)!fsync(fd);
        close(fd);
    }
    free(folder);
}

bool whole_file_open(const char *path, whole_file *out, err *e)
{
    char *temporary = temporary_name(path);
    temporary_sweep(path, NULL);
    int fd = open(temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    FILE *stream = fd >= 0 ? fdopen(fd, "wb") : NULL;
    if (!stream) {
        cannot_write(path, errno, e);
        free(temporary);
        return false;
    }
    temporary_lock(fd);
    temporary_remember(fd, temporary);
    *out = (whole_file){.stream = stream, .path = mem_text(path), .temporary = temporary};
    return true;
}

void whole_file_abandon(whole_file *w)
{
    if (w->stream) {
        temporary_forget(fileno(w->stream));
        fclose(w->stream);
    }
    if (w->temporary) unlink(w->temporary);
    free(w->path);
    free(w->temporary);
    *w = (whole_file){0};
}

bool whole_file_close(whole_file *w, err *e)
{
    bool good = !fflush(w->stream) && !ferror(w->stream) && !fsync(fileno(w->stream));
    int number = good ? 0 : errno ? errno : EIO;
    temporary_forget(fileno(w->stream));
    if (fclose(w->stream) && good) {
        good = false;
        number = errno;
    }
    w->stream = NULL;
    if (good && rename(w->temporary, w->path)) {
        good = false;
        number = errno;
    }
    if (good) {
        sync_folder_of(w->path);
        free(w->temporary); /* the name is no longer ours to remove */
        w->temporary = NULL;
    } else {
        cannot_write(w->path, number, e);
    }
    whole_file_abandon(w);
    return good;
}

bool write_whole(const char *path, const void *bytes, size_t size, err *e)
{
    whole_file w;
    if (!whole_file_open(path, &w, e)) return false;
    if (size) fwrite(bytes, 1, size, w.stream);
    return whole_file_close(&w, e);
}

/* 0 does not exist, 1 an empty folder, 2 anything else */
static int occupied(const char *path)
{
    struct stat info;
    if (lstat(path, &info)) return errno == ENOENT ? 0 : 2;
    DIR *folder = S_ISDIR(info.st_mode) ? opendir(path) : NULL;
    if (!folder) return 2;
    int found = 1;
    for (struct dirent *entry = readdir(folder); entry; entry = readdir(folder))
        if (strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..")) found = 2;
    closedir(folder);
    return found;
}

static bool is_busy(const char *path, const char *own, err *e)
{
    long process = temporary_sweep(path, own);
    return process &&
           !err_at(e, ERR_RESOURCE, path, 0, NULL,
                   "another gnathos (process %ld) is writing it; wait for its end or choose a new name", process);
}

/* Two that start at once may both be refused; never do both go on. */
static bool make_locked(whole_folder *w, err *e)
{
    if (is_busy(w->path, NULL, e)) return false;
    if (mkdir(w->temporary, 0777)) return cannot_write(w->path, errno, e);
    w->lock = open(w->temporary, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    bool ok = w->lock >= 0 || cannot_write(w->path, errno, e);
    if (ok) temporary_lock(w->lock);
    ok = ok && !is_busy(w->path, w->temporary, e);
    if (ok) {
        temporary_remember(w->lock, w->temporary);
        return true;
    }
    if (w->lock >= 0) close(w->lock);
    rmdir(w->temporary);
    return false;
}

static bool open_folder(const char *path, bool replaces, whole_folder *out, err *e)
{
    whole_folder w = {.path = mem_text(path), .replaces = replaces};
    char *clean = w.path;
    for (size_t n = strlen(clean); n > 1 && clean[n - 1] == '/'; n--) clean[n - 1] = 0;
    bool ok = *clean || err_set(e, ERR_USAGE, "the name of the new folder is empty");
    if (ok && !replaces && occupied(clean) == 2)
        ok = err_at(e, ERR_INPUT, clean, 0, NULL, "exists and is not an empty folder; choose a new name or remove it");
    w.temporary = temporary_name(clean);
    ok = ok && make_locked(&w, e);
    if (ok) {
        *out = w;
    } else {
        free(w.path);
        free(w.temporary);
    }
    return ok;
}

bool whole_folder_open(const char *path, whole_folder *out, err *e) { return open_folder(path, false, out, e); }

bool whole_folder_open_over(const char *path, whole_folder *out, err *e) { return open_folder(path, true, out, e); }

void whole_folder_abandon(whole_folder *w)
{
    if (w->temporary) {
        temporary_remove(w->temporary);
        temporary_forget(w->lock);
        close(w->lock);
    }
    free(w->path);
    free(w->temporary);
    *w = (whole_folder){0};
}

/* For file systems that cannot exchange two names: for a moment the target is not there. */
static bool replace_in_two_steps(const whole_folder *w)
{
    size_t size = strlen(w->path) + 32;
    char *aside = NEW_ARRAY(char, size);
    snprintf(aside, size, "%s.old.%ld", w->path, (long)getpid());
    bool moved = !rename(w->path, aside), done = moved && !rename(w->temporary, w->path);
    int number = errno;
    if (done)
        temporary_remove(aside);
    else if (moved)
        (void)!rename(aside, w->path);
    errno = number;
    free(aside);
    return done;
}

bool whole_folder_close(whole_folder *w, err *e)
{
    bool exchanged = w->replaces && !renameat2(AT_FDCWD, w->temporary, AT_FDCWD, w->path, RENAME_EXCHANGE);
    bool good = exchanged;
    if (!good && w->replaces && errno != ENOENT)
        good = (errno == EINVAL || errno == ENOSYS || errno == ENOTSUP) && replace_in_two_steps(w);
    else if (!good)
        good = !rename(w->temporary, w->path); /* an empty target folder is replaced */
    if (good) {
        sync_folder_of(w->path);
        if (!exchanged) { /* else the earlier results have the temporary name now */
            temporary_forget(w->lock);
            close(w->lock);
            free(w->temporary);
            w->temporary = NULL;
        }
    } else {
        cannot_write(w->path, errno, e);
    }
    whole_folder_abandon(w);
    return good;
}
