/* stored_transform: a transform of ITK as its files hold it: a type, parameters, fixed parameters. Private. */
#pragma once
#include "geometry/rigid.h"

enum { STORED_NUMBERS_MOST = 16 };

typedef struct stored_transform {
    int type;                         /* -1: not seen */
    int parameter_line;               /* of a text; 0 */
    int parameter_count, fixed_count; /* -1: not seen */
    double parameter[STORED_NUMBERS_MOST], fixed[STORED_NUMBERS_MOST];
} stored_transform;

stored_transform stored_transform_new(void);
/* "AffineTransform_double_3_3". Refuses a type that is not read, and a second one. */
bool stored_transform_type(stored_transform *s, const char *name, const char *path, int line, err *e) MUST_CHECK;
/* The motion of the bone, which is the inverse of what is stored (the resampling direction). Refuses what is not
 * complete or not rigid. */
bool stored_transform_motion(const stored_transform *s, const char *path, rigid *out, err *e) MUST_CHECK;

/* One function per format; each refuses more than one transform. */
bool read_transform_text(const char *path, stored_transform *out, err *e) MUST_CHECK;
bool read_transform_mat(const char *path, stored_transform *out, err *e) MUST_CHECK; /* MATLAB 4, as ITK writes it */
bool read_transform_h5(const char *path, stored_transform *out, err *e) MUST_CHECK;  /* HDF5 */
