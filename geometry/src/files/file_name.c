#include "geometry/src/files/file_name.h"
#include "geometry/mem.h"
#include "geometry/suggest.h"
#include <stdio.h>
#include <stdlib.h>

enum { KINDS_MOST = 16 };

bool file_name_refuse(const char *path, const char *what, const char *kinds, const char *hint, err *e)
{
    const char *name[KINDS_MOST], *base = file_name_base(path), *dot = strrchr(base, '.');
    char *words = mem_text(kinds), *rest = words, mean[64] = "";
    int count = 0;
    for (char *word; (word = strtok_r(rest, " ", &rest)) && count < KINDS_MOST;) name[count++] = word;
    int near = dot ? suggest_nearest(dot, name, count) : -1;
    if (near >= 0) snprintf(mean, sizeof mean, "; did you mean %s?", name[near]);
    (void)err_at(e, ERR_INPUT, path, 0, NULL, "unknown kind of %s file; read are %s%s%s", what, kinds, hint, mean);
    free(words);
    return false;
}
