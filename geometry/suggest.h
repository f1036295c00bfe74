/* suggest: the known name nearest to a mistyped one. */
#pragma once
#ifdef __cplusplus
extern "C" {
#endif

/* Number of the name with the fewest insertions, deletions, replacements and swaps of neighbours (upper and
 * lower case are alike); -1 if the nearest needs more than a third of the letters. The first of equals. */
int suggest_nearest(const char *word, const char *const *names, int count);

#ifdef __cplusplus
}
#endif
