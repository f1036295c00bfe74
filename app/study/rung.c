/* One rung, solved in a child and kept. */
#include "app/study/measures.h"
#include "app/planner/store/child.h"
#include "app/planner/store/pack_file.h"
#include "app/planner/predict/prediction.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include "geometry/parallel.h"
#include "geometry/tissue_refine.h"
#include "geometry/vec.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef struct reply {
    bool ok;
    err e;
} reply;

typedef struct job {
    const study_task *task;
    const study_rung *rung;
    const char *path;
} job;

bool study_task_key(study_task *t, err *e)
{
    char inputs[HASH_TEXT_SIZE];
    content_hash *h = content_hash_start();
    bool ok = prepared_hash(t->patient, inputs, e) && content_hash_file(h, "program", "/proc/self/exe", e);
    content_hash_text(h, "case", ok ? inputs : "");
    content_hash_number(h, "young", t->patient->material.young_kpa);
    content_hash_number(h, "poisson", t->patient->material.poisson);
    content_hash_number(h, "element", t->patient->material.element);
    content_hash_number(h, "loads", t->load_steps);
    content_hash_bytes(h, t->motion, sizeof t->motion);
    content_hash_end(h, t->key);
    return ok;
}

static void rung_path(const study_task *t, const study_rung *r, char *out, size_t size)
{
    static const char *const element[] = {"", "_linear", "_averaged"};
    snprintf(out, size, "%s/runs/%s_x%g_r%d%s_t%g_m%d_n%g_j%d%s_l%d_s%g.pack", t->folder, t->name, r->coarsening,
             r->refined, element[r->element], r->rel_tol, r->model, r->poisson, r->threads,
             r->contact == CONTACT_BONES  ? "_bones"
             : r->contact == CONTACT_LIPS ? "_lips"
                                          : "",
             r->load_steps, r->scene_mm);
}

static bool take_prepared(const study_task *t, const study_rung *r, prepared *p, double *meshing_s, err *e)
{
    case_file c = *t->patient;
    char own[FIELD_PATH_SIZE];
    snprintf(own, sizeof own, "%s/prepared", t->folder);
    c.tissue.element_mm *= r->coarsening;
    c.tissue.coarse_mm *= r->coarsening;
    double begin = clock_s();
    if (!prepared_get(&c, r->coarsening == 1 ? t->cache : own, NULL, p, e)) return false;
    *meshing_s = p->reused ? 0 : clock_s() - begin;
    for (int k = 0; k < r->refined; k++) {
        tissue fine;
        embedding skin;
        tissue_refine(&p->tissue, &fine);
        embedding_refine(&p->skin_on_tissue, &p->tissue.mesh, &fine.mesh, &skin);
        tissue_free(&p->tissue);
        embedding_free(&p->skin_on_tissue);
        p->tissue = fine;
        p->skin_on_tissue = skin;
    }
    return true;
}

/* The prediction of a rung, all in it but what a study does not ask: nobody watches, and depth is not measured. */
static bool solve(const study_task *t, const study_rung *r, const prepared *p, prediction *made, err *e)
{
    case_file c = *t->patient;
    plan_moves moves = {0};
    prediction_options options = prediction_options_default();
    memcpy(moves.move, t->motion, sizeof moves.move);
    if (r->poisson > 0) c.material.poisson = r->poisson;
    if (r->element) c.material.element = r->element;
    if (r->rel_tol > 0) options.rel_tol = r->rel_tol;
    if (r->scene_mm > 0) options.scene_mm = r->scene_mm;
    if (r->threads > 0) parallel_set_threads(r->threads);
    options.full = r->scene_mm <= 0;
    options.load_steps = r->load_steps > 0 ? r->load_steps : t->load_steps;
    options.model = (material_model)r->model;
    options.contact = r->contact;
    options.depth = false;
    return prediction_make(&c, p, NULL, &moves, &options, NULL, made, e);
}

static void describe(const prepared *p, const prediction *made, study_result *r)
{
    const equilibrium *q = &made->solve;
    tetmesh_quality quality = tetmesh_measure(&p->tissue.mesh);
    r->solved = q->outcome == SOLVED;
    snprintf(r->text, sizeof r->text, "%s", solve_outcome_text(q->outcome));
    r->nodes = p->tissue.mesh.vertex_count;
    r->tets = p->tissue.mesh.tet_count;
    r->wall_s = made->solve_span.wall_s;
    r->cpu_s = made->solve_span.cpu_s;
    r->unknowns = q->unknown_count;
    r->size_mm = cbrt(quality.volume_mm3 / r->tets);
    r->iterations = q->iterations;
    r->free_iterations = q->contact.free_iterations;
    r->contact_iterations = q->contact.contact_iterations;
    r->factorisations = q->factorisations;
    r->loads = q->loads;
    r->prepare_s = q->prepare_s;
    r->assemble_s = q->assemble_s;
    r->factor_s = q->factor_s;
    r->solve_s = q->solve_s;
    r->residual_mn = q->residual_mn;
    r->initial_mn = q->reference_mn;
    r->min_j = q->extremes.min_j;
    r->inverted = q->extremes.inverted_count;
}

static bool keep(const job *j, const prepared *p, const prediction *made, const study_result *r, err *e)
{
    pack_file f = {0};
    pack_put(&f, "key", j->task->key, sizeof j->task->key);
    pack_put(&f, "result", r, sizeof *r);
    if (r->solved) {
        size_t skin = 3 * (size_t)p->skin.vertex_count;
        double *moved = NEW_ARRAY(double, skin), *point = NEW_ARRAY(double, 3 * (size_t)p->points.count);
        for (size_t i = 0; i < skin; i++) moved[i] = made->skin.xyz[i] - p->skin.xyz[i];
        for (int32_t i = 0; i < p->points.count; i++)
            vec_sub(made->points.after.point[i].xyz, p->points.point[i].xyz, point + 3 * (size_t)i);
        pack_put(&f, "skin", moved, skin * sizeof *moved);
        pack_put(&f, "points", point, 3 * (size_t)p->points.count * sizeof *point);
        free(moved);
        free(point);
    }
    bool ok = pack_write(&f, j->path, e);
    pack_free(&f);
    return ok;
}

static void work(void *context, void *result)
{
    const job *j = context;
    reply own = {0};
    study_result r = {0};
    prepared p = {0};
    prediction made = {0};
    own.ok = take_prepared(j->task, j->rung, &p, &r.meshing_s, &own.e);
    if (own.ok) study_add_lips(&p);
    if (own.ok && !solve(j->task, j->rung, &p, &made, &own.e)) { /* a rung that this case has not: say so */
        snprintf(r.text, sizeof r.text, "%.*s", (int)sizeof r.text - 1, own.e.text);
        own.e = (err){0};
    } else if (own.ok) {
        describe(&p, &made, &r);
    }
    if (own.ok && task_interrupted(j->task->watch)) own.ok = err_set(&own.e, ERR_INTERRUPTED, "interrupted");
    own.ok = own.ok && keep(j, &p, &made, &r, &own.e);
    prediction_free(&made);
    prepared_free(&p);
    memcpy(result, &own, sizeof own);
}

static bool read_run(const char *path, const char *key, study_run *out)
{
    pack_file f;
    err e = {0};
    size_t one = 0, n = 0;
    study_run r = *out;
    if (!pack_read(path, &f, &e)) return false;
    char *stored = pack_take(&f, "key", HASH_TEXT_SIZE, &one);
    study_result *result = pack_take(&f, "result", sizeof *result, &one);
    bool ok = stored && result && one == 1 && !memcmp(stored, key, HASH_TEXT_SIZE);
    if (ok) {
        r.result = *result;
        r.skin_mm = pack_take(&f, "skin", 3 * sizeof(double), &n);
        r.skin_count = (int32_t)n;
        r.point_mm = pack_take(&f, "points", 3 * sizeof(double), &n);
        r.point_count = (int32_t)n;
        ok = !r.result.solved || (r.skin_mm && r.point_mm);
    }
    free(stored);
    free(result);
    pack_free(&f);
    if (ok) *out = r;
    return ok;
}

/* Once more, with what only the parent knows. */
static bool add_peak(const char *path, double peak_mb, err *e)
{
    pack_file f;
    if (!pack_read(path, &f, e)) return false;
    for (int i = 0; i < f.count; i++)
        if (!strcmp(f.entry[i].name, "result")) ((study_result *)f.entry[i].bytes)->peak_mb = peak_mb;
    bool ok = pack_write(&f, path, e);
    pack_free(&f);
    return ok;
}

bool study_get(const study_task *t, const study_rung *rung, study_run *out, bool *fresh, err *e)
{
    enum { LIMIT_CPU_S = 1200, LIMIT_CONTACT_S = 300 }; /* contact at times crawls, and only the curious wait */
    int limit_s = rung->contact ? LIMIT_CONTACT_S : LIMIT_CPU_S;
    char path[FIELD_PATH_SIZE + 160];
    rung_path(t, rung, path, sizeof path);
    *out = (study_run){.rung = rung};
    *fresh = false;
    if (read_run(path, t->key, out)) return true;
    job j = {t, rung, path};
    reply r = {0};
    child_use use;
    child_end end = child_run(t->watch, work, &j, &r, sizeof r, limit_s, &use);
    *fresh = true;
    if (end == CHILD_INTERRUPTED || task_interrupted(t->watch))
        return err_set(e, ERR_INTERRUPTED, "interrupted; what is done is kept in %s, and the same command goes on",
                       t->folder);
    if (end != CHILD_DONE) { /* not kept: another time it may come through */
        snprintf(out->result.text, sizeof out->result.text,
                 end == CHILD_LATE ? "no end in %d s of processor time" : "crashed (out of memory?)", limit_s);
        out->result.peak_mb = use.peak_mb;
        return true;
    }
    if (!r.ok) {
        *e = r.e;
        return false;
    }
    if (!add_peak(path, use.peak_mb, e)) return false;
    return read_run(path, t->key, out) || err_set(e, ERR_INTERNAL, "%s: cannot be read back", path);
}
