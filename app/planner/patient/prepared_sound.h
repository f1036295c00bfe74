/* prepared_sound: whether what was read from a file can be a prepared case at all. A file may be damaged, edited or of
 * another program, with a right checksum; nothing in it is used as an index before it was looked at. */
#pragma once
#include "app/planner/patient/prepared.h"

/* Every index in range, every number finite, every label ended, counts that belong together equal. Arrays are as long
 * as their counts say. */
bool prepared_is_sound(const prepared *p);
