#include "geometry/input_file.h"
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A file descriptor, or -1. Opening a pipe must not wait for who writes into it. */
static int open_regular(const char *path, int64_t most_bytes, int64_t *size, err *e)
{
    struct stat info;
    int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    bool ok = file >= 0 && !fstat(file, &info);
    if (!ok)
        err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read: %s", strerror(errno));
    else if (S_ISDIR(info.st_mode))
        ok = err_at(e, ERR_INPUT, path, 0, NULL, "is a folder, not a file");
    else if (!S_ISREG(info.st_mode))
        ok = err_at(e, ERR_INPUT, path, 0, NULL, "is not a regular file");
    else if (!info.st_size)
        ok = err_at(e, ERR_INPUT, path, 0, NULL, "the file is empty");
    else if (info.st_size > most_bytes)
        ok = err_at(e, ERR_INPUT, path, 0, NULL, "has %lld bytes; at most %lld are read", (long long)info.st_size,
                    (long long)most_bytes);
    if (ok) {
        *size = (int64_t)info.st_size;
        return file;
    }
    if (file >= 0) close(file);
    return -1;
}

FILE *input_file_open(const char *path, int64_t most_bytes, int64_t *size, err *e)
{
    int64_t bytes = 0;
    int file = open_regular(path, most_bytes, &bytes, e);
    if (file < 0) return NULL;
    FILE *in = fdopen(file, "rb");
    if (!in) {
        err_at(e, ERR_RESOURCE, path, 0, NULL, "cannot be opened: %s", strerror(errno));
        close(file);
    } else if (size) {
        *size = bytes;
    }
    return in;
}

FILE *input_file_open_text(const char *path, err *e)
{
    static const unsigned char utf8[3] = {0xEF, 0xBB, 0xBF};
    unsigned char start[3] = {0};
    FILE *in = input_file_open(path, INPUT_TEXT_BYTES, NULL, e);
    if (!in) return NULL;
    size_t n = fread(start, 1, sizeof start, in);
    if (n >= 2 && ((start[0] == 0xFF && start[1] == 0xFE) || (start[0] == 0xFE && start[1] == 0xFF))) {
        err_at(e, ERR_INPUT, path, 0, NULL, "is UTF-16 text, as its byte order mark says; save it as UTF-8");
        fclose(in);
        return NULL;
    }
    if (n < sizeof utf8 || memcmp(start, utf8, sizeof utf8)) rewind(in);
    return in;
}

bool input_file_check(const char *path, int64_t most_bytes, err *e)
{
    int64_t bytes;
    int file = open_regular(path, most_bytes, &bytes, e);
    if (file < 0) return false;
    close(file);
    return true;
}
