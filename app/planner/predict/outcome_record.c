#include "app/planner/predict/outcome_record.h"
#include "app/planner/judge/judgement_record.h"
#include "app/planner/patient/prepared_report.h"
#include "app/planner/plan/movements.h"
#include "app/planner/predict/ceph_report.h"
#include "app/planner/predict/outcome_scene.h"
#include "app/planner/predict/solve_report.h"
#include "app/planner/store/stage_record.h"
#include "geometry/vec.h"
#include <math.h>
#include <sys/resource.h>

/* An outcome with what is derived from it. */
typedef struct outcome_view {
    const outcome *of;
    const char *case_name, *case_hash, *plan_name, *override, *error_note, *trust, *bone;
    scene_words scene;
    const equilibrium *solve;
    const json_t *prepared;
    double young_kpa, poisson, prepare_s, solve_s, ordering_s, assembly_s, factor_s, back_s, cpu_user_s, cpu_system_s,
        peak_mb, error_mm;
    outcome_stages stages;
    judgement_record limits;
    movement move[SEGMENT_COUNT];
    soft_ratio ratio[SOFT_RATIOS_MAX];
    int moves, ratios;
    ceph_report ceph;
    const bone_depth *depth;
} outcome_view;

typedef struct moved_segment {
    double matrix[16];
} moved_segment;

static const record_row segment_row[] = {
    ROW(moved_segment, matrix, "matrix", NULL, "where it goes from rest: row-major, LPS mm")};
static const record_table segment_table = {.title = "A segment that moves", RECORD_ROWS(segment_row)};

static const void *next_segment(const void *of, int *i, const char **key, void *space)
{
    const plan_moves *m = ((const outcome_view *)of)->of->moves;
    while (*i < SEGMENT_COUNT && rigid_is_identity(&m->move[*i])) ++*i;
    if (*i == SEGMENT_COUNT) return NULL;
    *key = segment_name((segment_id)*i);
    rigid_to_matrix(&m->move[*i], ((moved_segment *)space)->matrix);
    return space;
}

static const void *next_measure(const void *of, int *i, const char **key, void *space)
{
    (void)space;
    if (*i == LIMIT_MOVE_COUNT) return NULL;
    *key = limit_default[*i].name;
    return &((const outcome_view *)of)->of->moves->measure[*i];
}

typedef struct carried_point {
    const char *label, *carrier;
    double doubt_mm, before[3], after[3], moved[3];
} carried_point;

static const record_row point_row[] = {
    ROW(carried_point, label, "label", NULL, "its label"),
    {RECORD_AT(carried_point, carrier), .name = "carried_by", .words = SEGMENT_WORDS "|skin|nothing",
     .help = "what it moves with"},
    ROW(carried_point, before, "before_lps_mm", "LPS mm", "where it is"),
    ROW(carried_point, after, "after_lps_mm", "LPS mm", "where it goes"),
    ROW_OPTIONAL(carried_point, doubt_mm, "automatic_doubt_mm", "mm", "gnathos placed it, and may be about so far off"),
    ROW(carried_point, moved, "forward_up_left_mm", "mm", "how far, along the head's own axes"),
};
static const record_table point_table = {.title = "A landmark", RECORD_ROWS(point_row)};

static const void *next_point(const void *of, int *i, const char **key, void *space)
{
    const outcome *o = ((const outcome_view *)of)->of;
    const head_frame *f = &o->prepared->frame;
    double d[3];
    (void)key;
    if (*i >= o->prepared->points.count) return NULL;
    const landmark *from = &o->prepared->points.point[*i], *to = &o->points->after.point[*i];
    int carrier = o->points->carrier[*i];
    carried_point *p = space;
    vec_sub(to->xyz, from->xyz, d);
    *p = (carried_point){.label = from->label,
                         .doubt_mm = from->doubt_mm > 0 ? from->doubt_mm : (double)NAN,
                         .carrier = carrier >= 0                 ? segment_name((segment_id)carrier)
                                    : carrier == CARRIED_BY_SKIN ? "skin"
                                                                 : "nothing",
                         .moved = {-vec_dot(d, f->posterior), vec_dot(d, f->up), vec_dot(d, f->left)}};
    vec_copy(from->xyz, p->before);
    vec_copy(to->xyz, p->after);
    return p;
}

static const record_row ratio_row[] = {
    ROW(soft_ratio, soft, "soft", NULL, "landmark on the skin"),
    ROW(soft_ratio, hard, "hard", NULL, "landmark on bone or tooth with which it is compared"),
    ROW(soft_ratio, soft_mm, "soft_mm", "mm", "how far the first goes forwards, up, left"),
    ROW(soft_ratio, hard_mm, "hard_mm", "mm", "how far the second does"),
    ROW(soft_ratio, ratio, "forward_ratio", NULL, "of the way forwards; null where the bone moves less than 1 mm"),
};
static const record_table ratio_table = {.title = "Soft against hard", RECORD_ROWS(ratio_row)};

static const void *next_ratio(const void *of, int *i, const char **key, void *space)
{
    const outcome_view *v = of;
    (void)key, (void)space;
    return *i < v->ratios ? &v->ratio[*i] : NULL;
}

static const void *next_move(const void *of, int *i, const char **key, void *space)
{
    const outcome_view *v = of;
    (void)key, (void)space;
    return *i < v->moves ? &v->move[*i] : NULL;
}

static bool is_solved(const void *of) { return ((const outcome_view *)of)->of->points != NULL; }

static const record_row outcome_row[] = {
    ROW(outcome_view, case_name, "case", NULL, "name of the case"),
    ROW(outcome_view, case_hash, "case_hash", NULL, "of everything of the case that the prediction rests on"),
    ROW(outcome_view, plan_name, "plan.name", NULL, "name of the plan"),
    ROW(outcome_view, override, "plan.override", NULL, "why it may go beyond limits, empty where it may not"),
    ROW_MAP(next_segment, "segment", OBJECT, &segment_table, "plan.segments", NULL, "the bones that move"),
    ROW_MAP(next_measure, "measure", NUMBER, NULL, "plan.measures", NULL, "the moves as the limits measure them"),
    ROW_OBJECT(outcome_view, scene, &scene_words_table, "scene", "what is modelled and what is left out"),
    ROW(outcome_view, young_kpa, "material.young_kpa", "kPa", "stiffness of the tissue, Young's modulus"),
    ROW(outcome_view, poisson, "material.poisson", NULL, "its Poisson's ratio"),
    ROW_BEHIND(outcome_view, solve, &solve_table, "solve", "how the equilibrium was found"),
    {.kind = RECORD_JSON,
     .offset = offsetof(outcome_view, prepared),
     .table = &prepared_report_table,
     .name = "prepared",
     .help = "repair, cuts and mesh in numbers"},
    ROW(outcome_view, prepare_s, "seconds.prepare_wall", "s", "to prepare the case, or to read what was prepared"),
    ROW(outcome_view, solve_s, "seconds.solve_wall", "s", "to predict"),
    ROW(outcome_view, ordering_s, "seconds.ordering", "s", "of that, to find an order of the unknowns"),
    ROW(outcome_view, assembly_s, "seconds.assembly", "s", "of that, forces and matrices"),
    ROW(outcome_view, factor_s, "seconds.factorisation", "s", "of that, factors"),
    ROW(outcome_view, back_s, "seconds.back_substitution", "s", "of that, linear systems"),
    ROW_STAGE(outcome_view, stages.prepare, "prepare", "to prepare the case, or to read what was prepared"),
    ROW_STAGE(outcome_view, stages.judge, "judge", "to judge the plan by the limits of bones and teeth"),
    ROW_STAGE(outcome_view, stages.ready, "ready", "to make tissue, contact and bones ready for the plan"),
    ROW_STAGE(outcome_view, stages.solve, "solve", "to find the equilibrium"),
    ROW_STAGE(outcome_view, stages.carry, "carry", "to carry skin and landmarks and look for tissue in bone"),
    ROW_STAGE(outcome_view, stages.write, "write", "to write the meshes"),
    ROW_STAGE(outcome_view, stages.pictures, "pictures", "to draw the pictures"),
    ROW(outcome_view, cpu_user_s, "seconds.cpu_user", "s", "processor time of the whole process"),
    ROW(outcome_view, cpu_system_s, "seconds.cpu_system", "s", "the same in the system"),
    ROW(outcome_view, peak_mb, "peak_memory_MB", "MB", "most memory that the process held"),
    ROW(outcome_view, error_mm, "discretisation_error_mm", "mm", "how far the mesh puts the skin off"),
    ROW(outcome_view, error_note, "discretisation_error_note", NULL, "what to know of that"),
    ROW_OBJECT(outcome_view, limits, &judgement_table, "limits", "the plan and the face judged by every limit"),
    ROW_LIST(next_move, &movement_table, "movements", "every segment's move as planners read it"),
    ROW(outcome_view, trust, "trust", NULL, "how far to trust the result"),
    {.kind = RECORD_LIST,
     .next = next_point,
     .item = RECORD_OBJECT,
     .table = &point_table,
     .name = "landmarks",
     .when = is_solved,
     .help = "where the landmarks go"},
    {.kind = RECORD_LIST,
     .next = next_ratio,
     .item = RECORD_OBJECT,
     .table = &ratio_table,
     .name = "soft_to_hard",
     .when = is_solved,
     .help = "how far the skin follows bone and teeth"},
    {.kind = RECORD_OBJECT,
     .offset = offsetof(outcome_view, depth),
     .pointer = true,
     .table = &bone_depth_table,
     .name = "tissue_in_bone",
     .when = is_solved,
     .help = "tissue that ends up deeper in bone than at rest"},
    {.kind = RECORD_LIST,
     .offset = offsetof(outcome_view, ceph),
     .next = ceph_report_next,
     .item = RECORD_OBJECT,
     .table = &ceph_measure_table,
     .name = "cephalometry",
     .when = is_solved,
     .help = "angles and distances of the profile"},
};
const record_table outcome_table = {
    .kind = "outcome", .title = "Record of gnathos predict, outcome.json", RECORD_ROWS(outcome_row)};

json_t *outcome_json(const outcome *o)
{
    struct rusage use;
    getrusage(RUSAGE_SELF, &use);
    outcome_view v = {.of = o,
                      .case_name = o->patient->name,
                      .case_hash = o->prepared->hash,
                      .plan_name = o->plan->name,
                      .override = o->plan->override,
                      .error_note = "not estimated: one mesh was solved; compare runs with other values of "
                                    "tissue.element_mm",
                      .trust = outcome_trust(o->contact),
                      .solve = o->solve,
                      .prepared = o->prepared->report,
                      .young_kpa = o->patient->material.young_kpa,
                      .poisson = o->patient->material.poisson,
                      .stages = o->stages,
                      .prepare_s = o->stages.prepare.wall_s,
                      .solve_s = o->stages.ready.wall_s + o->stages.solve.wall_s,
                      .ordering_s = o->solve->prepare_s,
                      .assembly_s = o->solve->assemble_s,
                      .factor_s = o->solve->factor_s,
                      .back_s = o->solve->solve_s,
                      .cpu_user_s = (double)use.ru_utime.tv_sec + 1e-6 * (double)use.ru_utime.tv_usec,
                      .cpu_system_s = (double)use.ru_stime.tv_sec + 1e-6 * (double)use.ru_stime.tv_usec,
                      .peak_mb = (double)use.ru_maxrss / 1024,
                      .error_mm = (double)NAN,
                      .limits = judgement_record_of(o->limits, o->patient, o->plan->override),
                      .depth = o->depth};
    scene_words_make(o, &v.scene);
    v.moves = movements_make(o->moves->move, &o->prepared->points, &o->prepared->frame, v.move);
    if (o->points) {
        v.ratios = soft_ratios(o->prepared, o->points, v.ratio);
        ceph_report_make(&o->prepared->points, &o->points->after, &o->prepared->frame, &v.ceph);
    }
    return record_json(&outcome_table, &v);
}
