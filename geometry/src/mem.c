#include "geometry/mem.h"
#include "geometry/write_whole.h"
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void out_of_memory(size_t count, size_t size)
{
    fprintf(stderr, "gnathos: out of memory (%zu x %zu bytes)\n", count, size);
    whole_folder_abandon_all();
    exit(ERR_RESOURCE);
}

void *mem_alloc(size_t count, size_t size)
{
    void *p = calloc(count ? count : 1, size ? size : 1);
    if (!p) out_of_memory(count, size);
    return p;
}

void *mem_grow(void *p, size_t new_count, size_t size)
{
    if (size && new_count > SIZE_MAX / size) out_of_memory(new_count, size);
    void *q = realloc(p, new_count && size ? new_count * size : 1);
    if (!q) out_of_memory(new_count, size);
    return q;
}

void *mem_copy(const void *p, size_t count, size_t size)
{
    void *q = mem_alloc(count, size);
    if (count && size) memcpy(q, p, count * size);
    return q;
}

char *mem_text(const char *text) { return (char *)mem_copy(text, strlen(text) + 1, 1); }
