#include "app/planner/store/pack_file.h"
#include "app/planner/store/content_hash.h"
#include "geometry/input_file.h"
#include "geometry/mem.h"
#include "geometry/write_whole.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char magic[16] = "gnathos pack 1\n";

void pack_put(pack_file *p, const char *name, const void *bytes, size_t size)
{
    p->entry = GROW_ARRAY(pack_entry, p->entry, p->count + 1);
    pack_entry *en = &p->entry[p->count++];
    *en = (pack_entry){.size = size, .bytes = mem_copy(bytes, size, 1)};
    snprintf(en->name, sizeof en->name, "%s", name);
}

void *pack_take(const pack_file *p, const char *name, size_t element, size_t *count)
{
    for (int i = 0; i < p->count; i++) {
        if (strcmp(p->entry[i].name, name)) continue;
        if (p->entry[i].size % element) return NULL;
        *count = p->entry[i].size / element;
        return mem_copy(p->entry[i].bytes, p->entry[i].size, 1);
    }
    return NULL;
}

void pack_free(pack_file *p)
{
    for (int i = 0; i < p->count; i++) free(p->entry[i].bytes);
    free(p->entry);
    *p = (pack_file){0};
}

bool pack_write(const pack_file *p, const char *path, err *e)
{
    whole_file f;
    return whole_file_open(path, &f, e) && pack_write_into(p, &f, e);
}

bool pack_write_into(const pack_file *p, whole_file *f, err *e)
{
    content_hash *h = content_hash_start();
    char sum[HASH_TEXT_SIZE];
    fwrite(magic, 1, sizeof magic, f->stream);
    for (int i = 0; i < p->count; i++) {
        const pack_entry *en = &p->entry[i];
        fwrite(en->name, 1, sizeof en->name, f->stream);
        fwrite(&en->size, 1, sizeof en->size, f->stream);
        fwrite(en->bytes, 1, en->size, f->stream);
        content_hash_bytes(h, en->name, sizeof en->name);
        content_hash_bytes(h, en->bytes, en->size);
    }
    content_hash_end(h, sum);
    fwrite(sum, 1, sizeof sum, f->stream);
    return whole_file_close(f, e);
}

bool pack_read(const char *path, pack_file *out, err *e)
{
    err unreadable = {0};
    FILE *f = input_file_open(path, INT64_MAX, NULL, &unreadable);
    char start[sizeof magic], sum[HASH_TEXT_SIZE], stored[HASH_TEXT_SIZE];
    pack_file p = {0};
    content_hash *h = content_hash_start();
    bool ok = f && fread(start, 1, sizeof start, f) == sizeof start && !memcmp(start, magic, sizeof magic);
    long end = 0;
    if (ok) {
        ok = !fseek(f, 0, SEEK_END) && (end = ftell(f)) > 0 && !fseek(f, sizeof magic, SEEK_SET);
        end -= (long)sizeof stored;
    }
    while (ok && ftell(f) < end) {
        pack_entry en = {0};
        ok = fread(en.name, 1, sizeof en.name, f) == sizeof en.name &&
             fread(&en.size, 1, sizeof en.size, f) == sizeof en.size && !en.name[sizeof en.name - 1] &&
             ftell(f) <= end && en.size <= (uint64_t)(end - ftell(f));
        if (!ok) break;
        en.bytes = mem_alloc(en.size, 1);
        ok = fread(en.bytes, 1, en.size, f) == en.size;
        content_hash_bytes(h, en.name, sizeof en.name);
        content_hash_bytes(h, en.bytes, en.size);
        p.entry = GROW_ARRAY(pack_entry, p.entry, p.count + 1);
        p.entry[p.count++] = en;
    }
    content_hash_end(h, sum);
    ok = ok && fread(stored, 1, sizeof stored, f) == sizeof stored && !memcmp(sum, stored, sizeof sum);
    if (f) fclose(f);
    if (!ok) {
        pack_free(&p);
        return err_at(e, ERR_INPUT, path, 0, NULL, "is not a whole prepared case");
    }
    *out = p;
    return true;
}
