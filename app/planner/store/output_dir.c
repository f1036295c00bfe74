#include "app/planner/store/output_dir.h"
#include "geometry/mem.h"
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
    static const char *const records[] = {"outcome.json", "audit.json",    "comparison.json", "cut_report.json",
                                          "stress.json",  "manifest.json", "identities.json", "identity.json",
                                          "fit.json",     "template.json"};
    for (size_t i = 0; i < sizeof records / sizeof *records; i++)
        if (has(folder, records[i])) return true;
    return false;
}

bool output_dir_open(const char *target, bool force, output_dir *out, err *e)
{
    struct stat info;
    bool earlier = !stat(target, &info) && S_ISDIR(info.st_mode) && is_ours(target);
    if (earlier && !force) return err_at(e, ERR_INPUT, target, 0, NULL, "holds earlier results; --force replaces them");
    return earlier ? whole_folder_open_over(target, &out->part, e) : whole_folder_open(target, &out->part, e);
}

bool output_dir_close(output_dir *d, err *e) { return whole_folder_close(&d->part, e); }

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
