/* Tets of the worst shapes, and starts from which the solver has to find home. p: how flat. */
#include "app/stress/stress.h"

#define BLOCK .cells = {5, 5, 5}, .size = {25, 25, 20}, .move = {3, 2, 4}
#define FLAT(kind, number)                                                                                             \
    {                                                                                                                  \
        .name = #kind "/" #number, .what = "a block with many of them, pulled and sheared", .body = specimen_##kind,   \
        BLOCK, .p = number                                                                                             \
    }
#define START(label, text, which)                                                                                      \
    {                                                                                                                  \
        .name = "start/" label, .what = text, .body = specimen_block, BLOCK, .start = which                            \
    }

static const stress_case cases[] = {
    FLAT(caps, 1e-2),
    FLAT(caps, 1e-4),
    FLAT(caps, 1e-6),
    FLAT(wedges, 1e-2),
    FLAT(wedges, 1e-4),
    FLAT(wedges, 1e-6),
    FLAT(needles, 1e-2),
    FLAT(needles, 1e-4),
    FLAT(needles, 1e-6),
    FLAT(slivers, 1e-2),
    FLAT(slivers, 1e-4),
    FLAT(slivers, 1e-6),
    {.name = "graded/1e4",
     .what = "cells grow 10000-fold from one side to the other",
     .body = specimen_graded,
     .cells = {16, 4, 4},
     .size = {40, 20, 20},
     .move = {2, 0, 3},
     .p = 1e4},
    {.name = "aspect/rods",
     .what = "all tets are needles 1 : 1000",
     .body = specimen_block,
     .cells = {5, 5, 5},
     .size = {25, 0.025, 0.025},
     .move = {0.003, 0.002, 0.004}},
    {.name = "aspect/plates",
     .what = "all tets are plates 1 : 1000",
     .body = specimen_block,
     .cells = {5, 5, 5},
     .size = {25, 25, 0.025},
     .move = {0.003, 0.002, 0.004}},
    START("jitter", "every node anywhere within 4 mm, half of the tets inverted", START_JITTER),
    START("mirror", "all tets inverted", START_MIRROR),
    START("point", "all nodes in one point", START_POINT),
    START("far", "the guess lies 1 m away", START_FAR),
    {.name = "start/jitter_nhln",
     .what = "inverted start in a model that forbids it",
     .body = specimen_block,
     BLOCK,
     .model = MATERIAL_NH_LN,
     .start = START_JITTER},
    {.name = "start/jitter_fcr",
     .what = "inverted start, Fixed Corotated",
     .body = specimen_block,
     BLOCK,
     .model = MATERIAL_FIXED_COROTATED,
     .start = START_JITTER},
    {.name = "start/nan",
     .what = "a guess that is not a number",
     .body = specimen_block,
     BLOCK,
     .start = START_NAN,
     .want = WANT_REFUSED,
     .code = ERR_INPUT,
     .words = "not finite"},
};
const stress_family stress_shapes = {cases, sizeof cases / sizeof *cases};
