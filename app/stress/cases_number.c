/* Tolerances and units. */
#include "app/stress/stress.h"

#define SLAB .body = specimen_slab, .cells = {10, 10, 3}, .size = {60, 60, 15}, .move = {3, 0, 4}
#define TOL(number)                                                                                                    \
    {                                                                                                                  \
        .name = "tolerance/" #number, .what = "slab, patch moved 5 mm", SLAB, .rel_tol = number                        \
    }
#define UNITS(label, text, ...)                                                                                        \
    {                                                                                                                  \
        .name = "units/" label, .what = text, SLAB, .check = CHECK_SCALED, __VA_ARGS__                                 \
    }

static const stress_case cases[] = {
    TOL(1e-3),
    TOL(1e-4),
    TOL(1e-6),
    TOL(1e-8),
    TOL(1e-10),
    TOL(1e-12),
    TOL(1e-15),
    {.name = "tolerance/1",
     .what = "a tolerance that every start meets",
     SLAB,
     .rel_tol = 1,
     .want = WANT_REFUSED,
     .code = ERR_INPUT,
     .words = "rel_tol"},
    UNITS("metres", "lengths a thousandth", .scale = 1e-3),
    UNITS("micrometres", "lengths a thousandfold", .scale = 1e3),
    UNITS("pascal", "stiffness a thousandfold", .young = 15e3),
    UNITS("megapascal", "stiffness a thousandth", .young = 15e-3),
    UNITS("bone_stiff", "stiffness a billionfold", .young = 15e9),
    UNITS("far_from_origin", "the scene lies 10 m off", .shift_mm = 1e4),
    UNITS("very_far", "the scene lies 1 km off", .shift_mm = 1e6),
};
const stress_family stress_numbers = {cases, sizeof cases / sizeof *cases};
