#include "geometry/write_whole.h"
#include "geometry/mem.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* "folder/.name.<process>.part": hidden, in the same folder, so that the rename stays on one file system. */
static char *temporary_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    int folder = slash ? (int)(slash - path) + 1 : 0;
    size_t size = strlen(path) + 40;
    char *name = NEW_ARRAY(char, size);
    snprintf(name, size, "%.*s.%s.%ld.part", folder, path, path + folder, (long)getpid());
    return name;
}

static bool cannot_write(const char *path, int number, err *e)
{
    return err_at(e, ERR_RESOURCE, path, 0, NULL, "cannot be written: %s", strerror(number));
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
    unlink(temporary); /* of a process that died and had our number */
    int fd = open(temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    FILE *stream = fd >= 0 ? fdopen(fd, "wb") : NULL;
    if (!stream) {
        cannot_write(path, errno, e);
        free(temporary);
        return false;
    }
    *out = (whole_file){.stream = stream, .path = mem_text(path), .temporary = temporary};
    return true;
}

void whole_file_abandon(whole_file *w)
{
    if (w->stream) fclose(w->stream);
    if (w->temporary) unlink(w->temporary);
    free(w->path);
    free(w->temporary);
    *w = (whole_file){0};
}

bool whole_file_close(whole_file *w, err *e)
{
    bool good = !fflush(w->stream) && !ferror(w->stream) && !fsync(fileno(w->stream));
    int number = good ? 0 : errno ? errno : EIO;
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

static int remove_entry(const char *path, const struct stat *info, int kind, struct FTW *walk)
{
    (void)info, (void)kind, (void)walk;
    return remove(path);
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

bool whole_folder_open(const char *path, whole_folder *out, err *e)
{
    char *clean = mem_text(path);
    for (size_t n = strlen(clean); n > 1 && clean[n - 1] == '/'; n--) clean[n - 1] = 0;
    char *temporary = NULL;
    if (!*clean) {
        err_set(e, ERR_USAGE, "the name of the new folder is empty");
    } else if (occupied(clean) == 2) {
        err_at(e, ERR_INPUT, clean, 0, NULL, "exists and is not an empty folder; choose a new name or remove it");
    } else {
        temporary = temporary_name(clean);
        nftw(temporary, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
        if (!mkdir(temporary, 0777)) {
            *out = (whole_folder){.path = clean, .temporary = temporary};
            return true;
        }
        cannot_write(clean, errno, e);
    }
    free(temporary);
    free(clean);
    return false;
}

void whole_folder_abandon(whole_folder *w)
{
    if (w->temporary) nftw(w->temporary, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
    free(w->path);
    free(w->temporary);
    *w = (whole_folder){0};
}

bool whole_folder_close(whole_folder *w, err *e)
{
    bool good = !rename(w->temporary, w->path); /* an empty target folder is replaced */
    if (good) {
        sync_folder_of(w->path);
        free(w->temporary);
        w->temporary = NULL;
    } else {
        cannot_write(w->path, errno, e);
    }
    whole_folder_abandon(w);
    return good;
}
