/* ceph_print: the measures of the profile as a table on stdout. */
#pragma once
#include "geometry/cephalometry.h"

/* after may be NULL; sex 'f' or 'm' chooses the norm, 0 shows both. */
void ceph_print(const landmarks *before, const landmarks *after, const head_frame *frame, char sex);
