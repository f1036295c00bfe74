/* The rungs. Meshes of other edge lengths show what meshing anew does (another surface, other attachments);
 * halved tets show the discretisation alone. */
#include "app/study/study.h"

#define ONE_LOAD .load_steps = 1

const study_rung study_rungs[] = {
    {.name = "edges x 3", .group = GROUP_MESH, ONE_LOAD, .coarsening = 3},
    {.name = "edges x 2", .group = GROUP_MESH, ONE_LOAD, .coarsening = 2},
    {.name = "edges x 1.5", .group = GROUP_MESH, ONE_LOAD, .coarsening = 1.5},
    {.name = "the case's own", .group = GROUP_MESH, ONE_LOAD, .coarsening = 1},
    {.name = "edges x 0.75", .group = GROUP_MESH, ONE_LOAD, .coarsening = 0.75},
    {.name = "edges x 3, halved", .group = GROUP_MESH, ONE_LOAD, .coarsening = 3, .refined = 1},
    {.name = "edges x 2, halved", .group = GROUP_MESH, ONE_LOAD, .coarsening = 2, .refined = 1},
    {.name = "edges x 1, halved", .group = GROUP_MESH, ONE_LOAD, .coarsening = 1, .refined = 1},
    {.name = "edges x 3, halved twice", .group = GROUP_MESH, ONE_LOAD, .coarsening = 3, .refined = 2},
    {.name = "edges x 3, averaged", .group = GROUP_ELEMENT, ONE_LOAD, .coarsening = 3, .average = true},
    {.name = "edges x 2, averaged", .group = GROUP_ELEMENT, ONE_LOAD, .coarsening = 2, .average = true},
    {.name = "edges x 1, averaged", .group = GROUP_ELEMENT, ONE_LOAD, .coarsening = 1, .average = true},
    {.name = "edges x 3, halved, averaged",
     .group = GROUP_ELEMENT,
     ONE_LOAD,
     .coarsening = 3,
     .refined = 1,
     .average = true},
    {.name = "tolerance 1e-2", .group = GROUP_TOLERANCE, ONE_LOAD, .coarsening = 1, .rel_tol = 1e-2},
    {.name = "tolerance 1e-3", .group = GROUP_TOLERANCE, ONE_LOAD, .coarsening = 1, .rel_tol = 1e-3},
    {.name = "tolerance 1e-4", .group = GROUP_TOLERANCE, ONE_LOAD, .coarsening = 1, .rel_tol = 1e-4},
    {.name = "tolerance 1e-6", .group = GROUP_TOLERANCE, ONE_LOAD, .coarsening = 1, .rel_tol = 1e-6},
    {.name = "tolerance 1e-10", .group = GROUP_TOLERANCE, ONE_LOAD, .coarsening = 1, .rel_tol = 1e-10},
    {.name = "snh", .group = GROUP_MATERIAL, ONE_LOAD, .coarsening = 1, .model = MATERIAL_SNH},
    {.name = "nhiso", .group = GROUP_MATERIAL, ONE_LOAD, .coarsening = 1, .model = MATERIAL_NH_ISO},
    {.name = "Fixed Corotated", .group = GROUP_MATERIAL, ONE_LOAD, .coarsening = 1, .model = MATERIAL_FIXED_COROTATED},
    {.name = "Poisson 0.40", .group = GROUP_MATERIAL, ONE_LOAD, .coarsening = 1, .poisson = 0.40},
    {.name = "Poisson 0.47", .group = GROUP_MATERIAL, ONE_LOAD, .coarsening = 1, .poisson = 0.47},
    {.name = "Poisson 0.49", .group = GROUP_MATERIAL, ONE_LOAD, .coarsening = 1, .poisson = 0.49},
    {.name = "Poisson 0.49, averaged",
     .group = GROUP_MATERIAL,
     .coarsening = 1,
     .poisson = 0.49,
     .average = true},
    {.name = "1 thread", .group = GROUP_THREADS, ONE_LOAD, .coarsening = 1, .threads = 1},
    {.name = "2 threads", .group = GROUP_THREADS, ONE_LOAD, .coarsening = 1, .threads = 2},
    {.name = "4 threads", .group = GROUP_THREADS, ONE_LOAD, .coarsening = 1, .threads = 4},
    {.name = "four loads", .group = GROUP_SCENE, .coarsening = 1, .load_steps = 4},
    {.name = "eight loads", .group = GROUP_SCENE, .coarsening = 1, .load_steps = 8},
    {.name = "contact on", .group = GROUP_SCENE, .coarsening = 1, ONE_LOAD, .contact = true},
};
const int study_rung_count = sizeof study_rungs / sizeof *study_rungs;
const int study_default = 3, study_reference = 7, study_family[3] = {0, 5, 8};
