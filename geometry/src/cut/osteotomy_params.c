/* Apart from osteotomy.c, so that a build without CGAL still knows the fields of a case. */
#include "geometry/osteotomy.h"
#include <stddef.h>

osteotomy_params osteotomy_params_default(void)
{
    return (osteotomy_params){.kerf_mm = 0.5,
                              .apex_clearance_mm = 5,
                              .foramen_clearance_mm = 5,
                              .palate_clearance_mm = 3,
                              .le_fort_raise_mm = 3,
                              .above_lingula_mm = 3,
                              .behind_lingula_mm = 5,
                              .buccal_depth_mm = 4,
                              .ramus_depth_share = 0.5,
                              .canal_clearance_mm = 2,
                              .lingula_width_share = 0.53,
                              .lingula_height_share = 0.65,
                              .below_mental_foramen_mm = 6,
                              .chin_height_mm = 10,
                              .fragment_mm3 = 200};
}

bool osteotomy_params_check(const osteotomy_params *p, err *e)
{
    const struct {
        const char *name;
        double value, low, high;
    } field[] = {{"kerf_mm", p->kerf_mm, 0.05, 3},
                 {"apex_clearance_mm", p->apex_clearance_mm, 0, 15},
                 {"foramen_clearance_mm", p->foramen_clearance_mm, 0, 15},
                 {"palate_clearance_mm", p->palate_clearance_mm, 0, 15},
                 {"le_fort_raise_mm", p->le_fort_raise_mm, 0, 15},
                 {"above_lingula_mm", p->above_lingula_mm, 0, 10},
                 {"behind_lingula_mm", p->behind_lingula_mm, 0, 15},
                 {"buccal_depth_mm", p->buccal_depth_mm, 1, 10},
                 {"ramus_depth_share", p->ramus_depth_share, 0.2, 0.8},
                 {"canal_clearance_mm", p->canal_clearance_mm, 0, 10},
                 {"lingula_width_share", p->lingula_width_share, 0.2, 0.8},
                 {"lingula_height_share", p->lingula_height_share, 0.2, 0.9},
                 {"below_mental_foramen_mm", p->below_mental_foramen_mm, 0, 15},
                 {"chin_height_mm", p->chin_height_mm, 0, 30},
                 {"fragment_mm3", p->fragment_mm3, 0, 1e5}};
    for (size_t i = 0; i < sizeof field / sizeof *field; i++)
        if (!(field[i].value >= field[i].low && field[i].value <= field[i].high))
            return err_set(e, ERR_INPUT, "osteotomy %s must be within %g and %g, got %g", field[i].name, field[i].low,
                           field[i].high, field[i].value);
    return true;
}
