/* memory: the process ends where memory ends.
 *
 * Many libraries stand under a verb, and few of them live through an allocation that fails: one takes it for the end of
 * the file, one for a wrong file, one crashes. So that none is ever told, the program's own malloc and its kin, which
 * all of them call, hand on to those of the C library (or of who is loaded before it) and end the process where these
 * give nothing. More than the machine has is no lack of memory but a wrong size, which its asker is told as ever. */
#include "app/cli/command.h"
#include <dlfcn.h>
#include <errno.h>
#include <malloc.h>
#include <stdint.h>
#include <stdlib.h>
#include <unistd.h>

static size_t machine_bytes(void)
{
    long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    return pages > 0 && page > 0 ? (size_t)pages * (size_t)page : SIZE_MAX / 2;
}

static void *given(void *p, size_t size)
{
    if (!p && size && size <= machine_bytes()) command_out_of_memory(size);
    return p;
}

/* The next of that name after ours; looked up once, which allocates nothing where it succeeds. */
#define NEXT(name)                                                                                                     \
    static typeof(name) *next;                                                                                         \
    if (!next) *(void **)&next = dlsym(RTLD_NEXT, #name)

void *malloc(size_t size)
{
    NEXT(malloc);
    return given(next(size), size);
}

void *calloc(size_t count, size_t size)
{
    NEXT(calloc);
    size_t all;
    if (__builtin_mul_overflow(count, size, &all)) all = SIZE_MAX;
    return given(next(count, size), all);
}

void *realloc(void *p, size_t size)
{
    NEXT(realloc);
    return given(next(p, size), size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    NEXT(aligned_alloc);
    return given(next(alignment, size), size);
}

void *memalign(size_t alignment, size_t size)
{
    NEXT(memalign);
    return given(next(alignment, size), size);
}

int posix_memalign(void **p, size_t alignment, size_t size)
{
    NEXT(posix_memalign);
    int number = next(p, alignment, size);
    if (number == ENOMEM) given(NULL, size);
    return number;
}
