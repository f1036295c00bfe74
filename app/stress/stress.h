/* stress: stiff and extreme cases of the solver, each with the kind of outcome that is right for it.
 *
 * A case is a row of a table: a body, what is done to it, and what must come out. scene.c turns the row into
 * a solve, run.c runs it in a child process with a time limit, verify.c checks a claim of "solved" from the
 * returned positions alone. */
#pragma once
#include "app/planner/store/task.h"
#include "app/stress/shapes.h"
#include "geometry/json_file.h"
#include "sim/equilibrium.h"
#include <stdio.h>

typedef struct stress_case stress_case;

/* Everything one solve needs, owned. */
typedef struct stress_scene {
    tetmesh mesh;
    attach_map attach;
    region_material material[2]; /* region 0 and region 1 */
    int32_t material_count;
    rigid motion[SEGMENT_COUNT];
    double *start_xyz; /* or NULL */
    bool touches;
    known_bone bone; /* of the distal segment, over the middle of the body's bottom; and its shape */
    bone_shape shape;
    int32_t *upper, *lower, *extra;
    contact_setup contact; /* points into this: a scene is not to be copied */
    solve_params params;
} stress_scene;

typedef enum stress_kind {
    STRESS_SOLVED,
    STRESS_REFUSED,
    STRESS_GAVE_UP,
    STRESS_CRASHED,
    STRESS_TIMED_OUT
} stress_kind;

/* Right outcomes of a case. MAY_GIVE_UP: a clear "not solved" is right too, but nothing else is. */
typedef enum stress_want { WANT_SOLVED, WANT_REFUSED, MAY_GIVE_UP, MUST_GIVE_UP } stress_want;

/* More that must hold where a case is solved. */
enum {
    CHECK_STILL = 1,   /* no node moves at all */
    CHECK_RIGID = 2,   /* every node follows the motion of the bones to 1e-9 of the body's size */
    CHECK_UPRIGHT = 4, /* no tet turned inside out */
    CHECK_SCALED = 8,  /* displacements are those of the same case at scale and stiffness 1, times the scale */
    CHECK_ABOVE =
        16 /* no tissue node that may touch is deeper in the bone, where that rests, than depth_limit_mm + slack */
};

typedef enum stress_start {
    START_NONE,
    START_JITTER, /* every free node anywhere within 4 mm: about half of the tets inverted */
    START_MIRROR, /* mirrored: all tets inverted */
    START_POINT,  /* all in one point */
    START_FAR,    /* 1 m away */
    START_SUNK,   /* 6 mm lower */
    START_NAN
} stress_start;

struct stress_case {
    const char *name, *what;                             /* "family/case"; one line for people */
    void (*body)(const stress_case *c, stress_scene *s); /* fills mesh, attach, bones */
    int cells[3];
    double size[3];                    /* mm */
    double p;                          /* what the body makes of it: quality, gap, height; see the body */
    int flaw;                          /* of specimen_broken: mesh_flaw */
    int model;                         /* material_model */
    double young, poisson, contrast;   /* 0: 15 kPa, 0.45, 1; contrast: stiffness of region 1 over region 0 */
    double move[3], turn_deg, axis[3]; /* of the maxilla; about the middle of its nodes */
    bool oppose;                       /* the distal segment moves by the opposite */
    bool together;                     /* all bones move with the maxilla */
    double scale;                      /* 0: 1. All lengths times this */
    double shift_mm;                   /* the whole scene lies so far from the origin */
    int start;                         /* stress_start */
    double rel_tol;                    /* 0: the solver's default */
    int load_steps;                    /* 0: the solver's default */
    bool average;
    int want, check;   /* stress_want; CHECK_ flags */
    err_code code;     /* of a refusal */
    const char *words; /* in the refusal; NULL: any */
    double slack_mm;   /* of CHECK_ABOVE */
    double limit_s;    /* processor time; 0: 60 */
    bool heavy;        /* left out by --quick */
    const char *known; /* why this expectation is not met yet; NULL: it is. Told apart, and no failure */
};

typedef struct stress_family {
    const stress_case *item;
    int count;
} stress_family;
extern const stress_family stress_materials, stress_shapes, stress_moves, stress_touching, stress_meshes,
    stress_numbers;

enum { STRESS_TEXT = 240 };
/* Plain data: it comes through a pipe. NaN: not known. */
typedef struct stress_result {
    int kind;                /* stress_kind */
    char text[STRESS_TEXT];  /* the solver's outcome or the refusal */
    char wrong[STRESS_TEXT]; /* why the expectation failed, or "" */
    err_code code;
    int32_t nodes, tets;
    int64_t unknowns;
    int iterations, factorisations, loads;
    int32_t inverted;
    double residual_mn, tolerance_mn; /* as the solver says */
    double checked_mn;                /* the same from the returned positions */
    double correction_mm;             /* the longest move of one more Newton step there */
    double energy_uj, min_j, max_stretch, moved_mm, depth_mm;
    double seconds, cpu_s, memory_mb; /* wall and processor time of the solve; peak of the process */
} stress_result;

/* The scene of a case, with another scale than its own where scale > 0. */
void stress_scene_make(const stress_case *c, double scale, stress_scene *s);
void stress_scene_free(stress_scene *s);
equilibrium_problem stress_problem(const stress_scene *s);

/* Solves and checks in this process. */
stress_result stress_solve(const stress_case *c);
/* The same in a child with the time limit of the case times `patience` (ten times as much by the wall). */
stress_result stress_run(const stress_case *c, double patience, const task *watch);
/* Fills wrong, checked_mn and correction_mm from the positions in q and nothing else the solver says. */
void stress_verify(const stress_case *c, const stress_scene *s, const equilibrium *q, stress_result *r);

/* F of a tet at x[3*nodes], gradients of its shape functions and volume at rest. */
void stress_deformation(const tetmesh *m, const double *x, int32_t t, double F[9], double gradient[12], double *volume);
/* force[3*nodes]: derivative of the elastic energy, mN; returns the energy, uJ. */
double stress_forces(const stress_scene *s, const double *x, double *force);

/* Bodies. Block: between distal (bottom) and maxilla (top). */
void specimen_block(const stress_case *c, stress_scene *s);
void specimen_slab(const stress_case *c, stress_scene *s);    /* on the cranium but for a patch of the maxilla */
void specimen_layers(const stress_case *c, stress_scene *s);  /* block; the middle third is region 1 */
void specimen_skin(const stress_case *c, stress_scene *s);    /* slab; the outer layer is region 1 */
void specimen_grains(const stress_case *c, stress_scene *s);  /* block; one tet in p is region 1 */
void specimen_caps(const stress_case *c, stress_scene *s);    /* block; every 7th tet split by a node p off a face, */
void specimen_wedges(const stress_case *c, stress_scene *s);  /* off an edge, */
void specimen_needles(const stress_case *c, stress_scene *s); /* off a node (p of the tet's size) */
void specimen_slivers(const stress_case *c,
                      stress_scene *s); /* block; a layer of slivers of thickness p in the middle */
void specimen_graded(const stress_case *c, stress_scene *s); /* block; cells grow p-fold from one side to the other */
void specimen_single(const stress_case *c, stress_scene *s); /* one tet; p nodes of it tied */
void specimen_broken(const stress_case *c, stress_scene *s); /* block with a flaw */
/* Block tied at its top. Its bottom slides on the distal bone and may lift off: a plane p lower, pyramids p high, a
 * ball of radius p, or a rim: half of it has no bone. */
void specimen_on_plane(const stress_case *c, stress_scene *s);
void specimen_on_teeth(const stress_case *c, stress_scene *s);
void specimen_on_ball(const stress_case *c, stress_scene *s);
void specimen_on_rim(const stress_case *c, stress_scene *s);
/* The same; its bottom keeps out of, or slides on, a ball of radius p or cusps p high. */
void specimen_kept_off_ball(const stress_case *c, stress_scene *s);
void specimen_kept_off_cusps(const stress_case *c, stress_scene *s);
void specimen_kept_on_ball(const stress_case *c, stress_scene *s);
void specimen_kept_on_cusps(const stress_case *c, stress_scene *s);
void specimen_lips(const stress_case *c, stress_scene *s); /* two blocks, p apart */

typedef enum mesh_flaw {
    FLAW_CRACK,  /* nodes of the middle layer doubled: two blocks that touch, both held */
    FLAW_ISLAND, /* the same, the upper block held by nothing */
    FLAW_ISLAND_ONE,
    FLAW_ISLAND_TWO, /* held by one, by two nodes */
    FLAW_DOUBLE,     /* one node doubled, both copies used */
    FLAW_FLAT,       /* a tet of zero volume */
    FLAW_TURNED,     /* a tet of negative volume */
    FLAW_NAN,
    FLAW_INFINITE,
    FLAW_INDEX,
    FLAW_LOOSE, /* coordinate; node number; a node in no tet */
    FLAW_HINGE,
    FLAW_POINT,  /* the upper block hangs on the lower by one edge, by one node */
    FLAW_TWICE,  /* one tet listed twice */
    FLAW_SLIDES, /* nothing but sliding nodes on one plane */
    FLAW_NORMAL,
    FLAW_SEGMENT,
    FLAW_COUNT,
    FLAW_REGION,
    FLAW_PAIR /* contradictions in what belongs to it */
} mesh_flaw;

/* A grid of chequered cells of five tets, its corner at the origin; `shifted` from layer `from` on: the other
 * chequer. Node (i, j, k) is number (k (ny+1) + j)(nx+1) + i. */
tetmesh stress_grid(const int cells[3], const double size[3], int from);
static inline int32_t stress_node(const int n[3], int i, int j, int k) { return (k * (n[1] + 1) + j) * (n[0] + 1) + i; }
void stress_tie(attach_map *a, int32_t v, segment_id segment);
void stress_tie_ends(const stress_case *c, stress_scene *s); /* bottom layer to distal, top layer to maxilla */
/* How deep x lies in the bone for CHECK_ABOVE, mm, from other formulas than the shape; below cusps along z. */
double stress_depth(const known_bone *b, const double x[3]);

/* The table as Markdown. */
void stress_print(const stress_case *const *c, const stress_result *r, int count, FILE *out);
const char *stress_kind_name(int kind);
const char *stress_want_name(int want);
/* stress.md, stress.csv and stress.json (the record). */
bool stress_write(const stress_case *const *c, const stress_result *r, int count, const json_t *record,
                  const char *folder, err *e) MUST_CHECK;
