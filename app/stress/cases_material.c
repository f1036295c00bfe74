/* Near incompressibility, every model, and stiffness contrasts. */
#include "app/stress/stress.h"

#define SLAB .body = specimen_slab, .cells = {12, 12, 3}, .size = {60, 60, 15}, .move = {3, 0, 4}
#define NU(number, ...)                                                                                                \
    {                                                                                                                  \
        .name = "poisson/" #number, .what = "slab over a patch of bone that moves 5 mm", SLAB, .poisson = number,      \
        __VA_ARGS__                                                                                                    \
    }
#define MODEL(label, which, number)                                                                                    \
    {                                                                                                                  \
        .name = "model/" label, .what = "the same slab", SLAB, .model = which, .poisson = number                       \
    }
#define MEAN(number)                                                                                                   \
    {                                                                                                                  \
        .name = "averaged/" #number, .what = "the same with averaged volume changes", SLAB, .poisson = number,         \
        .average = true                                                                                                \
    }
#define BLOCK .cells = {6, 6, 6}, .size = {30, 30, 24}, .move = {2, 4, -3}, .turn_deg = 8, .axis = {1, 0.5, 0}
#define LAYERS(number, ...)                                                                                            \
    {                                                                                                                  \
        .name = "layers/" #number, .what = "soft, stiff, soft: bent and sheared", .body = specimen_layers, BLOCK,      \
        .contrast = number, __VA_ARGS__                                                                                \
    }
#define MEAN_LAYERS(number)                                                                                            \
    {                                                                                                                  \
        .name = "averaged/layers_" #number, .what = "soft, stiff, soft, all with averaged volume changes",             \
        .body = specimen_layers, BLOCK, .contrast = number, .poisson = 0.49, .average = true                           \
    }
#define SOFT_LAYER(number)                                                                                             \
    {                                                                                                                  \
        .name = "soft_layer/" #number, .what = "stiff, soft, stiff", .body = specimen_layers, BLOCK,                   \
        .contrast = number                                                                                             \
    }
#define GRAINS(number, ...)                                                                                            \
    {                                                                                                                  \
        .name = "grains/" #number, .what = "single tets stiffer or softer than all around", .body = specimen_grains,   \
        BLOCK, .p = 11, .contrast = number, __VA_ARGS__                                                                \
    }
#define SKIN(number)                                                                                                   \
    {                                                                                                                  \
        .name = "skin/" #number, .what = "a stiff outer layer on the slab", .body = specimen_skin,                     \
        .cells = {12, 12, 3}, .size = {60, 60, 15}, .move = {3, 0, 4}, .contrast = number                              \
    }

static const stress_case cases[] = {
    NU(0.45),
    NU(0.47),
    NU(0.49),
    NU(0.495),
    NU(0.499),
    NU(0.4999),
    NU(0.49999, .heavy = true),
    MODEL("snh_0.499", MATERIAL_SNH, 0.499),
    MODEL("fcr_0.499", MATERIAL_FIXED_COROTATED, 0.499),
    MODEL("arap", MATERIAL_ARAP, 0),
    MODEL("nhln_0.49", MATERIAL_NH_LN, 0.49),
    MODEL("nhiso_0.4999", MATERIAL_NH_ISO, 0.4999),
    MODEL("snhlog_-0.9", MATERIAL_SNH_LOG, -0.9),
    MEAN(0.49),
    MEAN(0.499),
    MEAN(0.4999),
    MEAN_LAYERS(1e2),
    MEAN_LAYERS(1e4),
    LAYERS(1e2),
    LAYERS(1e4),
    LAYERS(1e6),
    LAYERS(1e8, .heavy = true),
    SOFT_LAYER(1e-4),
    SOFT_LAYER(1e-8),
    GRAINS(1e2),
    GRAINS(1e4, .heavy = true),
    GRAINS(1e6, .heavy = true),
    GRAINS(1e8, .heavy = true, .want = MAY_GIVE_UP),
    GRAINS(1e-8),
    SKIN(30),
    SKIN(1e3),
};
const stress_family stress_materials = {cases, sizeof cases / sizeof *cases};
