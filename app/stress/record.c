#include "app/stress/record.h"

typedef struct case_view {
    const char *name, *what, *expected, *outcome, *known;
    stress_result r;
} case_view;

static const record_row case_row[] = {
    ROW(case_view, name, "case", NULL, "its name"),
    ROW(case_view, what, "what", NULL, "what it is"),
    {RECORD_AT(case_view, expected), .name = "expected", .words = "solved|refused|solved or gives up|gives up",
     .help = "what is right for it"},
    {RECORD_AT(case_view, outcome), .name = "outcome", .words = "solved|refused|gave up|CRASHED|TIMED OUT",
     .help = "what came out"},
    ROW(case_view, r.text, "text", NULL, "what the solver says of it"),
    ROW(case_view, r.wrong, "wrong", NULL, "why that is not right, empty where it is"),
    ROW(case_view, known, "known_limit", NULL, "why that is known, empty where it is not"),
    ROW(case_view, r.nodes, "nodes", NULL, "nodes of the mesh"),
    ROW(case_view, r.tets, "tets", NULL, "its tetrahedra"),
    ROW(case_view, r.unknowns, "unknowns", NULL, "numbers solved for"),
    ROW(case_view, r.iterations, "iterations", NULL, "steps of Newton's method"),
    ROW(case_view, r.factorisations, "factorisations", NULL, "matrices that were factorised"),
    ROW(case_view, r.loads, "loads", NULL, "loads that were solved"),
    ROW(case_view, r.residual_mn, "residual_mN", "mN", "norm of the forces that are left, as the solver says"),
    ROW(case_view, r.tolerance_mn, "tolerance_mN", "mN", "at which it is solved"),
    ROW(case_view, r.checked_mn, "checked_residual_mN", "mN", "the same norm from the positions alone"),
    ROW(case_view, r.correction_mm, "newton_step_mm", "mm", "longest move of one more step there"),
    ROW(case_view, r.energy_uj, "energy_uJ", "uJ", "energy"),
    ROW(case_view, r.min_j, "min_J", NULL, "smallest volume ratio of a tetrahedron"),
    ROW(case_view, r.max_stretch, "max_stretch", NULL, "largest principal stretch"),
    ROW(case_view, r.inverted, "inverted_tets", NULL, "tetrahedra turned inside out"),
    ROW(case_view, r.moved_mm, "moved_mm", "mm", "farthest that a node moved"),
    ROW(case_view, r.depth_mm, "contact_depth_mm", "mm", "deepest penetration"),
    ROW(case_view, r.seconds, "seconds", "s", "wall time"),
    ROW(case_view, r.cpu_s, "cpu_seconds", "s", "processor time"),
    ROW(case_view, r.memory_mb, "memory_MB", "MB", "most memory that the process held"),
};
static const record_table case_table = {.title = "A case of the solver", RECORD_ROWS(case_row)};

typedef struct stress_view {
    int count, wrong, known;
    const stress_case *const *which;
    const stress_result *result;
} stress_view;

static const void *next_case(const void *of, int *i, const char **key, void *space)
{
    const stress_view *v = of;
    (void)key;
    if (*i == v->count) return NULL;
    const stress_case *c = v->which[*i];
    case_view *out = space;
    _Static_assert(sizeof *out <= RECORD_SPACE, "a case fits");
    *out = (case_view){.name = c->name,
                       .what = c->what,
                       .expected = stress_want_name(c->want),
                       .outcome = stress_kind_name(v->result[*i].kind),
                       .known = c->known ? c->known : "",
                       .r = v->result[*i]};
    return out;
}

static const record_row stress_row[] = {
    ROW(stress_view, count, "count", NULL, "cases in all"),
    ROW(stress_view, wrong, "wrong", NULL, "of them, not as expected"),
    ROW(stress_view, known, "known_limits", NULL, "and known limits"),
    ROW_LIST(next_case, &case_table, "cases", "every case"),
};
const record_table stress_table = {
    .kind = "stress", .title = "Record of gnathos stress, stress.json", RECORD_ROWS(stress_row)};

json_t *stress_json(const stress_case *const *c, const stress_result *r, int count)
{
    stress_view v = {.count = count, .which = c, .result = r};
    for (int i = 0; i < count; i++) {
        v.wrong += r[i].wrong[0] && !c[i]->known;
        v.known += r[i].wrong[0] && c[i]->known;
    }
    return record_json(&stress_table, &v);
}
