/* file_name: what the end of a file's name says. Private. */
#pragma once
#include "geometry/err.h"
#include <stdbool.h>
#include <string.h>
#include <strings.h>

/* True if the name ends in ".ending" in any letter case and has something before it. */
static inline bool file_name_ends(const char *path, const char *ending)
{
    size_t n = strlen(path), k = strlen(ending);
    return n > k && path[n - k - 1] != '/' && !strcasecmp(path + n - k, ending);
}

/* The name without folders. */
static inline const char *file_name_base(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* Refuses a file whose ending is none of `kinds` (".ply .stl"), with the nearest of them; `hint` ends the message.
 * Always false. */
bool file_name_refuse(const char *path, const char *what, const char *kinds, const char *hint, err *e);
