#include "app/planner/store/journal.h"
#include "geometry/mem.h"
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

enum { SUM_SIZE = 16 };

typedef struct record_head {
    char sum[SUM_SIZE]; /* first hexadecimal digits of SHA-256 over the rest of the record */
    uint32_t kind, size;
} record_head;

static const char magic[16] = "gnathos journal";

static void sum_of(const record_head *h, const void *bytes, char out[SUM_SIZE])
{
    char text[HASH_TEXT_SIZE];
    content_hash *hash = content_hash_start();
    content_hash_bytes(hash, &h->kind, sizeof h->kind);
    content_hash_bytes(hash, &h->size, sizeof h->size);
    content_hash_bytes(hash, bytes, h->size);
    content_hash_end(hash, text);
    memcpy(out, text, SUM_SIZE);
}

static bool read_all(int file, void *bytes, size_t size)
{
    for (char *to = bytes; size;) {
        ssize_t n = read(file, to, size);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        to += n;
        size -= (size_t)n;
    }
    return true;
}

static bool write_all(const journal *j, const void *bytes, size_t size, err *e)
{
    for (const char *from = bytes; size;) {
        ssize_t n = write(j->file, from, size);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return err_at(e, ERR_RESOURCE, j->path, 0, NULL, "cannot be written: %s", strerror(errno));
        from += n;
        size -= (size_t)n;
    }
    return true;
}

/* Reads whole records and drops what comes after the last one. */
static bool read_records(journal *j, journal_reader *reader, void *context, err *e)
{
    off_t whole = sizeof magic + HASH_TEXT_SIZE, end = lseek(j->file, 0, SEEK_END);
    if (lseek(j->file, whole, SEEK_SET) != whole)
        return err_at(e, ERR_INPUT, j->path, 0, NULL, "cannot be read: %s", strerror(errno));
    for (;;) {
        record_head h;
        char sum[SUM_SIZE];
        if (!read_all(j->file, &h, sizeof h) || (off_t)h.size > end - whole) break;
        char *bytes = NEW_ARRAY(char, h.size);
        bool right = read_all(j->file, bytes, h.size);
        if (right) {
            sum_of(&h, bytes, sum);
            right = !memcmp(sum, h.sum, SUM_SIZE);
        }
        bool taken = right && reader(h.kind, bytes, h.size, context, e);
        free(bytes);
        if (!right) break;
        if (!taken) return false;
        whole += (off_t)(sizeof h + h.size);
        j->record_count++;
    }
    if (ftruncate(j->file, whole) || lseek(j->file, whole, SEEK_SET) != whole)
        return err_at(e, ERR_RESOURCE, j->path, 0, NULL, "cannot be written: %s", strerror(errno));
    return true;
}

static bool start(journal *j, const char key[HASH_TEXT_SIZE], err *e)
{
    if (ftruncate(j->file, 0) || lseek(j->file, 0, SEEK_SET))
        return err_at(e, ERR_RESOURCE, j->path, 0, NULL, "cannot be written: %s", strerror(errno));
    char head[sizeof magic + HASH_TEXT_SIZE];
    memcpy(head, magic, sizeof magic);
    memcpy(head + sizeof magic, key, HASH_TEXT_SIZE);
    return write_all(j, head, sizeof head, e);
}

/* 0: nothing in it, not even a whole head; 1: of this key; -1: something else. */
static int whose(const journal *j, const char key[HASH_TEXT_SIZE])
{
    char want[sizeof magic + HASH_TEXT_SIZE], got[sizeof want] = {0};
    memcpy(want, magic, sizeof magic);
    memcpy(want + sizeof magic, key, HASH_TEXT_SIZE);
    off_t size = lseek(j->file, 0, SEEK_END);
    size_t n = size < (off_t)sizeof want ? (size_t)size : sizeof want;
    if (lseek(j->file, 0, SEEK_SET) || !read_all(j->file, got, n) || memcmp(got, want, n)) return -1;
    return n == sizeof want;
}

bool journal_open(const char *path, const char *key, bool force, journal_reader *reader, void *context, journal *out,
                  err *e)
{
    journal j = {.file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666), .path = mem_text(path)};
    bool ok = j.file >= 0 || err_at(e, ERR_RESOURCE, path, 0, NULL, "cannot be written: %s", strerror(errno));
    if (ok && flock(j.file, LOCK_EX | LOCK_NB))
        ok = err_at(e, ERR_RESOURCE, path, 0, NULL, "another gnathos works on it");
    int mine = ok ? whose(&j, key) : 0;
    if (ok && mine < 0 && !force)
        ok = err_at(e, ERR_INPUT, path, 0, NULL,
                    "is not the journal of this work: the case or the settings differ; --force starts anew");
    if (ok && mine > 0)
        ok = read_records(&j, reader, context, e);
    else if (ok && !start(&j, key, e)) {
        journal_remove(&j); /* nothing is in it */
        ok = false;
    }
    if (ok)
        *out = j;
    else
        journal_close(&j);
    return ok;
}

bool journal_add(journal *j, uint32_t kind, const void *bytes, size_t size, err *e)
{
    record_head h = {.kind = kind, .size = (uint32_t)size};
    sum_of(&h, bytes, h.sum);
    char *whole = NEW_ARRAY(char, sizeof h + size);
    memcpy(whole, &h, sizeof h);
    memcpy(whole + sizeof h, bytes, size);
    bool ok = write_all(j, whole, sizeof h + size, e);
    free(whole);
    if (ok) j->record_count++;
    return ok;
}

void journal_close(journal *j)
{
    if (j->path && j->file >= 0) close(j->file);
    free(j->path);
    *j = (journal){.file = -1};
}

void journal_remove(journal *j)
{
    if (j->path) unlink(j->path);
    journal_close(j);
}
