/* temporary: the hidden name beside its target that a result has until it is whole, "folder/.name.<process>.part". The
 * process that makes it holds a lock on it (flock), which ends with the process, however that ends. */
#pragma once
#include <stdbool.h>

char *temporary_name(const char *path); /* of this process; the caller frees it */
/* The path that a path in or of a hidden name will have once it is whole; the caller frees it. */
char *temporary_target(const char *path);
/* The lock of a file or folder just made; where the file system has no locks the number of the process alone counts.
 * The descriptor is kept open until the name is given up. */
void temporary_lock(int descriptor);
/* Removes what ended processes left of `path`, and returns the number of a process that still makes it, or 0. `own` is
 * not looked at (NULL: all are). */
long temporary_sweep(const char *path, const char *own);
void temporary_remove(const char *name); /* a file, or a folder with all in it */
/* Names that whole_folder_abandon_all removes, by a descriptor of theirs. Any thread may call. */
void temporary_remember(int descriptor, const char *name);
void temporary_forget(int descriptor);
