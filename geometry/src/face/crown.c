#include "geometry/src/face/crown.h"
#include "geometry/frame.h"
#include "geometry/vec.h"

bool crown_over(const landmarks *l, const double crest[3], bool upper, double length_mm, double out[3])
{
    head_frame f;
    err none = {0};
    if (!head_frame_from_landmarks(l, &f, &none)) return false;
    vec_copy(crest, out);
    vec_axpy(out, upper ? -length_mm : length_mm, f.up, out);
    return true;
}
