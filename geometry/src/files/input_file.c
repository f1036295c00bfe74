#include "geometry/input_file.h"
#include "geometry/mem.h"
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
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

/* One of the first two signs is below 256, as in a text that begins in any European script. */
static bool is_utf16(const char *text, size_t size)
{
    bool little = size >= 4 && !memcmp(text, "\xFF\xFE", 2), big = size >= 4 && !memcmp(text, "\xFE\xFF", 2);
    return (little && !text[3]) || (big && !text[2]);
}

bool input_text_mark(const char *text, size_t size, const char *path, bool *utf8, err *e)
{
    *utf8 = size >= 3 && !memcmp(text, "\xEF\xBB\xBF", 3);
    return !is_utf16(text, size) ||
           err_at(e, ERR_INPUT, path, 0, NULL, "is UTF-16 text, as its byte order mark says; save it as UTF-8");
}

bool input_text_unmarked(const char *text, size_t size, const char *path, err *e)
{
    bool utf8;
    return input_text_mark(text, size, path, &utf8, e) &&
           (!utf8 || err_at(e, ERR_INPUT, path, 0, NULL,
                            "begins with a byte order mark, which is no part of such files; save it without"));
}

FILE *input_file_open_text(const char *path, err *e)
{
    char start[4] = {0};
    bool utf8;
    FILE *in = input_file_open(path, INPUT_TEXT_BYTES, NULL, e);
    if (!in) return NULL;
    size_t n = fread(start, 1, sizeof start, in);
    bool ok = input_text_mark(start, n, path, &utf8, e) &&
              (!fseek(in, utf8 ? 3 : 0, SEEK_SET) || err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read"));
    if (ok) return in;
    fclose(in);
    return NULL;
}

bool input_file_load(const char *path, int64_t most_bytes, char **bytes, size_t *size, err *e)
{
    int64_t want = 0;
    FILE *in = input_file_open(path, most_bytes, &want, e);
    if (!in) return false;
    char *got = NEW_ARRAY(char, want + 1);
    bool whole = fread(got, 1, (size_t)want, in) == (size_t)want;
    fclose(in);
    if (!whole) {
        free(got);
        return err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read to its end");
    }
    *bytes = got;
    *size = (size_t)want;
    return true;
}

bool input_file_check(const char *path, int64_t most_bytes, err *e)
{
    char start[4] = {0};
    FILE *in = input_file_open(path, most_bytes, NULL, e);
    if (!in) return false;
    size_t n = fread(start, 1, sizeof start, in);
    fclose(in);
    return input_text_unmarked(start, n, path, e);
}
