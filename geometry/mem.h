/* mem: allocation that ends the process when memory is gone (a command line has nothing to save then). */
#pragma once
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

void *mem_alloc(size_t count, size_t size);             /* zeroed; count 0 gives a valid pointer */
void *mem_grow(void *p, size_t new_count, size_t size); /* realloc; new bytes are not zeroed */
void *mem_copy(const void *p, size_t count, size_t size);
char *mem_text(const char *text); /* strdup */

#define NEW_ARRAY(type, count) ((type *)mem_alloc((size_t)(count), sizeof(type)))
#define COPY_ARRAY(type, p, count) ((type *)mem_copy((p), (size_t)(count), sizeof(type)))
#define GROW_ARRAY(type, p, count) ((type *)mem_grow((p), (size_t)(count), sizeof(type)))

#ifdef __cplusplus
}
#endif
