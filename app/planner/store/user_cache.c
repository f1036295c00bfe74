#include "app/planner/store/user_cache.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

bool user_cache_path(const char *file, const char *what, const char *variable, char *path, size_t size, err *e)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    bool xdg = cache && cache[0] == '/'; /* a relative one is to be ignored, says the specification of XDG */
    if (!xdg && !(home && *home))
        return err_set(e, ERR_RESOURCE, "no place to keep %s: neither %s, XDG_CACHE_HOME nor HOME is set", what,
                       variable);
    int length = snprintf(path, size, "%s%s/gnathos/%s", xdg ? cache : home, xdg ? "" : "/.cache", file);
    return length < (int)size || err_set(e, ERR_INPUT, "the path of %s is longer than %zu bytes", what, size - 1);
}

bool user_cache_folders(const char *path, const char *what, const char *variable, err *e)
{
    char part[4096];
    for (const char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        snprintf(part, sizeof part, "%.*s", (int)(slash - path), path);
        struct stat there;
        if (mkdir(part, 0777) && (errno != EEXIST || stat(part, &there) || !S_ISDIR(there.st_mode)))
            return err_at(e, ERR_RESOURCE, part, 0, NULL,
                          "cannot be made as a folder (%s); %s names another file for %s", strerror(errno), variable,
                          what);
    }
    return true;
}
