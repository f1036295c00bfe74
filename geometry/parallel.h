/* parallel: the one place that starts threads. A body writes only to slots owned by its index, so results do not
 * depend on the number of threads. */
#pragma once
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef void parallel_body(int64_t begin, int64_t end, void *context);

/* Calls body over [0, count) in blocks of at most `grain` indices. Not to be nested. */
void parallel_for(int64_t count, int64_t grain, parallel_body *body, void *context);
void parallel_set_threads(int threads); /* 0: one per core */
int parallel_threads(void);
/* Around calls into libraries that would start threads of their own, as many as they like. */
int parallel_forbid(void);
void parallel_allow(int levels); /* what parallel_forbid returned */

#ifdef __cplusplus
}
#endif
