#include "app/planner/store/output_dir.h"
#include "geometry/mem.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool has(const char *folder, const char *name)
{
    size_t size = strlen(folder) + strlen(name) + 2;
    char *path = NEW_ARRAY(char, size);
    snprintf(path, size, "%s/%s", folder, name);
    bool there = !access(path, F_OK);
    free(path);
    return there;
}

/* An earlier output of gnathos stands there: one of its records does. */
static bool is_ours(const char *folder)
{
    static const char *const records[] = {"outcome.json",    "audit.json",  "comparison.json",
                                          "cut_report.json", "stress.json", "manifest.json"};
    for (size_t i = 0; i < sizeof records / sizeof *records; i++)
        if (has(folder, records[i])) return true;
    return false;
}

bool output_dir_open(const char *target, bool force, output_dir *out, err *e)
{
    struct stat info;
    bool folder = !stat(target, &info) && S_ISDIR(info.st_mode);
    bool earlier = folder && is_ours(target);
    output_dir d = {.replaces = earlier && force};
    if (earlier && !force) return err_at(e, ERR_INPUT, target, 0, NULL, "holds earlier results; --force replaces them");
    if (!d.replaces) {
        if (!whole_folder_open(target, &d.part, e)) return false;
        *out = d;
        return true;
    }
    char *clean = mem_text(target);
    for (size_t n = strlen(clean); n > 1 && clean[n - 1] == '/'; n--) clean[n - 1] = 0;
    size_t size = strlen(clean) + 32;
    char *beside = NEW_ARRAY(char, size);
    snprintf(beside, size, "%s.%ld", clean, (long)getpid());
    bool ok = whole_folder_open(beside, &d.part, e);
    free(beside);
    if (ok) {
        free(d.part.path);
        d.part.path = clean;
        *out = d;
    } else {
        free(clean);
    }
    return ok;
}

bool output_dir_close(output_dir *d, err *e)
{
    if (!d->replaces) return whole_folder_close(&d->part, e);
    size_t size = strlen(d->part.path) + 32;
    char *aside = NEW_ARRAY(char, size), *target = mem_text(d->part.path);
    snprintf(aside, size, "%s.old.%ld", target, (long)getpid());
    bool ok =
        !rename(target, aside) || err_at(e, ERR_RESOURCE, target, 0, NULL, "cannot be replaced: %s", strerror(errno));
    if (!ok) {
        whole_folder_abandon(&d->part);
    } else if (whole_folder_close(&d->part, e)) {
        whole_folder old = {.path = mem_text(target), .temporary = mem_text(aside)};
        whole_folder_abandon(&old);
    } else {
        ok = false;
        if (rename(aside, target)) err_prefix(e, "the earlier results are in %s", aside);
    }
    free(aside);
    free(target);
    *d = (output_dir){0};
    return ok;
}

void output_dir_abandon(output_dir *d)
{
    whole_folder_abandon(&d->part);
    *d = (output_dir){0};
}

char *output_dir_file(const output_dir *d, const char *name)
{
    size_t size = strlen(d->part.temporary) + strlen(name) + 2;
    char *path = NEW_ARRAY(char, size);
    snprintf(path, size, "%s/%s", d->part.temporary, name);
    return path;
}
