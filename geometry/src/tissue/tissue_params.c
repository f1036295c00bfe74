/* Apart from tissue.c, so that a build without CGAL still knows the fields of a case. */
#include "geometry/tissue.h"

tissue_params tissue_params_default(void)
{
    return (tissue_params){.element_mm = 3,
                           .coarse_mm = 9,
                           .growth = 0.12,
                           .hole_mm = 36,
                           .collar_mm = 4,
                           .detail_mm = 5,
                           .touch_mm = 1.5,
                           .cut_band_mm = 4,
                           .vestibule_upper_mm = 18,
                           .vestibule_lower_mm = 15,
                           .coronal_mm = -8,
                           .neck_mm = 45,
                           .brow_mm = 35,
                           .far_mm = 25};
}
