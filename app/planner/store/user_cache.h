/* user_cache: what is made once and kept for all later runs of a user. */
#pragma once
#include "geometry/err.h"

/* `file` in $XDG_CACHE_HOME/gnathos or ~/.cache/gnathos. Refuses (ERR_RESOURCE), naming `what` would be kept and the
 * variable of the environment that would name it instead, where neither is set, and (ERR_INPUT) a path that is too
 * long. */
bool user_cache_path(const char *file, const char *what, const char *variable, char *path, size_t size,
                     err *e) MUST_CHECK;
/* Makes every folder of the path that is not there, but not its last part. */
bool user_cache_folders(const char *path, const char *what, const char *variable, err *e) MUST_CHECK;
