/* Bone moves from nothing to far more than any plan asks. */
#include "app/stress/stress.h"

#define SLAB .body = specimen_slab, .cells = {12, 12, 3}, .size = {60, 60, 15}
#define MOVE(label, x, y, z)                                                                                           \
    {                                                                                                                  \
        .name = "move/" label, .what = "a patch under the slab moves", SLAB, .move = { x, y, z }                       \
    }
#define TURN(label, x, y, z, degrees)                                                                                  \
    {                                                                                                                  \
        .name = "turn/" label, .what = "a patch under the slab turns", SLAB, .turn_deg = degrees, .axis = { x, y, z }  \
    }
#define BLOCK .body = specimen_block, .cells = {6, 6, 6}, .size = {30, 30, 24}
#define CRUSH(label, text, mm)                                                                                         \
    {                                                                                                                  \
        .name = "crush/" label, .what = text, BLOCK, .move = { 0, 0, mm }                                              \
    }
#define SHEAR(label, text, mm, thick)                                                                                  \
    {                                                                                                                  \
        .name = "one_layer/" label, .what = text, .body = specimen_block, .cells = {10, 10, 1},                        \
        .size = {30, 30, thick}, .move = {mm, 0, 0}, .oppose = true                                                    \
    }

static const stress_case cases[] = {
    {.name = "move/0", .what = "a plan that moves nothing", SLAB, .check = CHECK_STILL | CHECK_UPRIGHT},
    {.name = "move/0_twice", .what = "the same in four loads", SLAB, .load_steps = 4, .check = CHECK_STILL},
    MOVE("1e-9", 0, 0, 1e-9),
    MOVE("1e-3", 0, 0, 1e-3),
    MOVE("10", 0, 8, 6),
    MOVE("30", 0, 24, 18),
    MOVE("80", 0, 64, 48),
    MOVE("30_in", 0, 0, 30),
    MOVE("30_out", 0, 0, -30),
    TURN("90_in_plane", 0, 0, 1, 90),
    TURN("90_tilt", 1, 0, 0, 90),
    TURN("180", 0, 0, 1, 180),
    {.name = "rigid/90",
     .what = "all bones turn by 90 degrees",
     SLAB,
     .turn_deg = 90,
     .axis = {1, 1, 0},
     .together = true,
     .check = CHECK_RIGID | CHECK_UPRIGHT},
    {.name = "rigid/1000_mm",
     .what = "all bones move by 1 m",
     SLAB,
     .move = {600, 0, 800},
     .together = true,
     .check = CHECK_RIGID},
    CRUSH("to_50_percent", "two segments come together", -12),
    CRUSH("to_20_percent", "the same", -19.2),
    CRUSH("to_5_percent", "the same", -22.8),
    {.name = "crush/to_nothing",
     .what = "the segments meet: no room is left",
     BLOCK,
     .move = {0, 0, -24},
     .want = MAY_GIVE_UP},
    {.name = "crush/through",
     .what = "the segments pass through each other",
     BLOCK,
     .move = {0, 0, -36},
     .want = MAY_GIVE_UP},
    {.name = "crush/nhln_to_nothing",
     .what = "no room left, in a model that forbids it",
     BLOCK,
     .model = MATERIAL_NH_LN,
     .move = {0, 0, -24},
     .want = MUST_GIVE_UP,
     .heavy = true},
    {.name = "crush/0.4999", .what = "to half, nearly incompressible", BLOCK, .poisson = 0.4999, .move = {0, 0, -12}},
    {.name = "pull/2x", .what = "to twice its length", BLOCK, .move = {0, 0, 24}, .check = CHECK_UPRIGHT},
    {.name = "pull/5x", .what = "to five times its length", BLOCK, .move = {0, 0, 96}, .check = CHECK_UPRIGHT},
    {.name = "pull/5x_fcr",
     .what = "the same, Fixed Corotated",
     BLOCK,
     .move = {0, 0, 96},
     .model = MATERIAL_FIXED_COROTATED,
     .heavy = true},
    {.name = "pull/20x", .what = "to twenty times", BLOCK, .move = {0, 0, 456}, .heavy = true},
    {.name = "twist/180",
     .what = "one end turns by 180 degrees in four loads",
     .body = specimen_block,
     .cells = {4, 4, 8},
     .size = {15, 15, 40},
     .turn_deg = 179.9,
     .axis = {0, 0, 1},
     .load_steps = 4},
    SHEAR("shear_2", "two segments slide 2 mm across 2 mm of tissue", 1, 2),
    SHEAR("shear_20", "the same, 20 mm across 2 mm", 10, 2),
    SHEAR("shear_20_thin", "20 mm across 0.1 mm", 10, 0.1),
    {.name = "one_layer/free",
     .what = "the middle of one layer is free, its sides pulled apart",
     .body = specimen_block,
     .cells = {10, 10, 2},
     .size = {30, 30, 2},
     .move = {10, 0, 0},
     .oppose = true},
};
const stress_family stress_moves = {cases, sizeof cases / sizeof *cases};
