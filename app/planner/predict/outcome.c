#include "app/planner/predict/outcome.h"
#include "app/planner/predict/ceph_report.h"
#include "app/planner/plan/movements.h"
#include "app/planner/predict/outcome_scene.h"
#include "app/planner/judge/plan_audit.h"
#include "geometry/mem.h"
#include "geometry/mesh_file.h"
#include "geometry/transform_file.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

outcome outcome_of(const case_file *c, const prepared *p, const plan_file *plan, const plan_moves *moves,
                   contact_kind contact, const prediction *made)
{
    bool solved = made->solve.outcome == SOLVED;
    return (outcome){.patient = c,
                     .plan = plan,
                     .moves = moves,
                     .prepared = p,
                     .tissue = &made->flesh,
                     .solve = &made->solve,
                     .scene = &made->scene,
                     .u = made->u,
                     .skin = solved ? &made->skin : NULL,
                     .points = solved ? &made->points : NULL,
                     .depth = solved ? &made->depth : NULL,
                     .contact = contact,
                     .limits = &made->limits,
                     .solve_s = made->ready_s + made->solve_s};
}

static json_t *vector(const double v[3]) { return json_pack("[fff]", v[0], v[1], v[2]); }

static json_t *plan_json(const outcome *o)
{
    json_t *segment = json_object(), *measure = json_object();
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        double m[16];
        if (rigid_is_identity(&o->moves->move[s])) continue;
        rigid_to_matrix(&o->moves->move[s], m);
        json_t *matrix = json_array();
        for (int i = 0; i < 16; i++) json_array_append_new(matrix, json_real(m[i]));
        json_object_set_new(segment, segment_name((segment_id)s), json_pack("{so}", "matrix", matrix));
    }
    for (int l = 0; l < LIMIT_MOVE_COUNT; l++)
        json_object_set_new(measure, limit_default[l].name, json_real(o->moves->measure[l]));
    return json_pack("{ss ss so so}", "name", o->plan->name, "override", o->plan->override, "segments", segment,
                     "measures", measure);
}

static json_t *convergence_json(const equilibrium *q)
{
    json_t *record = json_array();
    static const char *const kind[] = {"true", "reused", "blended", "projected", "shifted"};
    for (int i = 0; i < q->record_count; i++) {
        const solve_record *r = &q->record[i];
        json_array_append_new(record, json_pack("{sf si sf sf sf sf ss sb sf sf si}", "load", r->load, "iteration",
                                                r->iteration, "residual_mN", r->residual_mn, "tolerance_mN",
                                                r->tolerance_mn, "energy_uJ", r->energy_uj, "step", r->step, "hessian",
                                                kind[r->hessian], "contact", r->contact, "factor_s", r->factor_s,
                                                "min_J", r->min_j, "inverted", r->inverted_count));
    }
    return record;
}

static json_t *contact_json(const contact_report *c)
{
    if (!c->on) return json_pack("{sb}", "on", false);
    return json_pack("{sb sb si si si si si si si sf sf sf sf sf sf si si si sf si si}", "on", true, "held", c->held,
                     "nodes", c->nodes, "touching_nodes", c->active_nodes, "left_out", c->left_out, "lost", c->lost,
                     "pinched", c->pinched, "passed", c->passed, "guards", c->guards, "slide_off_mm", c->slide_off_mm,
                     "depth_mm", c->depth_mm, "bone_area_mm2", c->bone_area_mm2, "lip_area_mm2", c->lip_area_mm2,
                     "pressure_kPa", c->pressure_kpa, "energy_uJ", c->energy_uj, "free_iterations", c->free_iterations,
                     "contact_iterations", c->contact_iterations, "refreshes", c->refreshes, "last_refresh_mm",
                     c->refresh_change_mm, "stiffenings", c->stiffenings, "uncoupled", c->uncoupled);
}

/* Tissue inside bone. */
static json_t *depth_json(const bone_depth *d)
{
    return json_pack("{si sf sf sf sf so ss sf}", "nodes", d->nodes, "limit_mm", d->limit_mm, "area_mm2", d->area_mm2,
                     "deeper_than_1mm_mm2", d->area_deep_mm2, "depth_mm", d->depth_mm, "at_lps_mm",
                     d->nodes ? vector(d->at) : json_null(), "bone",
                     d->nodes ? segment_name((segment_id)d->segment) : "", "from_skin_mm", d->from_skin_mm);
}

double outcome_relative_residual(const equilibrium *q)
{
    return q->iterations && q->reference_mn > 0 ? q->residual_mn / q->reference_mn : 0;
}

static json_t *solve_json(const equilibrium *q)
{
    json_t *force = json_object();
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (vec_norm(q->segment_force_mn[s]) > 0)
            json_object_set_new(force, segment_name((segment_id)s), vector(q->segment_force_mn[s]));
    return json_pack(
        "{ss sb si si si si si si sf sf sf sf sf so sf si sf si sI sI sf sf so so}", "outcome",
        solve_outcome_text(q->outcome), "solved", q->outcome == SOLVED, "iterations", q->iterations, "factorisations",
        q->factorisations, "cg_iterations", q->cg_iterations, "preconditioners", q->preconditioners, "loads", q->loads,
        "halvings", q->halvings, "residual_mN", q->residual_mn, "initial_residual_mN", q->reference_mn,
        "relative_residual", outcome_relative_residual(q), "tolerance_mN", q->tolerance_mn, "energy_uJ", q->energy_uj,
        "segment_force_mN", force, "force_imbalance", q->imbalance, "inverted_tets", q->extremes.inverted_count,
        "min_J", q->extremes.min_j, "min_J_tet", q->extremes.min_j_tet, "unknowns", (json_int_t)q->unknown_count,
        "factor_entries", (json_int_t)q->factor_entries, "largest_stretch", q->extremes.max_stretch, "memory_peak_MB",
        q->memory_peak_mb, "contact", contact_json(&q->contact), "record", convergence_json(q));
}

static json_t *landmarks_json(const outcome *o)
{
    json_t *list = json_array();
    const landmarks *before = &o->prepared->points;
    for (int32_t i = 0; i < before->count; i++) {
        double d[3], mm[3];
        int carrier = o->points->carrier[i];
        vec_sub(o->points->after.point[i].xyz, before->point[i].xyz, d);
        mm[0] = -vec_dot(d, o->prepared->frame.posterior);
        mm[1] = vec_dot(d, o->prepared->frame.up);
        mm[2] = vec_dot(d, o->prepared->frame.left);
        json_array_append_new(list, json_pack("{ss ss so so so}", "label", before->point[i].label, "carried_by",
                                              carrier >= 0                 ? segment_name((segment_id)carrier)
                                              : carrier == CARRIED_BY_SKIN ? "skin"
                                                                           : "nothing",
                                              "before_lps_mm", vector(before->point[i].xyz), "after_lps_mm",
                                              vector(o->points->after.point[i].xyz), "forward_up_left_mm", vector(mm)));
    }
    return list;
}

static json_t *ratios_json(const outcome *o)
{
    soft_ratio r[SOFT_RATIOS_MAX];
    int count = soft_ratios(o->prepared, o->points, r);
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(list, json_pack("{ss ss so so so}", "soft", r[i].soft, "hard", r[i].hard, "soft_mm",
                                              vector(r[i].soft_mm), "hard_mm", vector(r[i].hard_mm), "forward_ratio",
                                              isfinite(r[i].ratio) ? json_real(r[i].ratio) : json_null()));
    return list;
}

const char *outcome_trust(contact_kind contact)
{
#define TRUST(lips)                                                                                                    \
    "The equilibrium is solved to the residual given; the mesh error is not estimated yet, and published predictions " \
    "of this kind are 0.6 to 1.5 mm off on average, most at the lips, which here can " lips                            \
    ". Not for planning on patients."
    return contact == CONTACT_LIPS ? TRUST("part and meet") : TRUST("slide but neither part nor meet");
#undef TRUST
}

json_t *outcome_json(const outcome *o)
{
    struct rusage use;
    getrusage(RUSAGE_SELF, &use);
    const equilibrium *q = o->solve;
    json_t *seconds =
        json_pack("{sf sf sf sf sf sf sf sf}", "prepare_wall", o->prepare_s, "solve_wall", o->solve_s, "ordering",
                  q->prepare_s, "assembly", q->assemble_s, "factorisation", q->factor_s, "back_substitution",
                  q->solve_s, "cpu_user", (double)use.ru_utime.tv_sec + 1e-6 * (double)use.ru_utime.tv_usec,
                  "cpu_system", (double)use.ru_stime.tv_sec + 1e-6 * (double)use.ru_stime.tv_usec);
    json_t *out = json_pack(
        "{si ss ss ss so so s{sf sf} so so so sf so ss}", "gnathos", 1, "version", GNATHOS_VERSION, "case",
        o->patient->name, "case_hash", o->prepared->hash, "plan", plan_json(o), "scene", outcome_scene_json(o),
        "material", "young_kpa", o->patient->material.young_kpa, "poisson", o->patient->material.poisson, "solve",
        solve_json(q), "prepared", json_deep_copy(o->prepared->report), "seconds", seconds, "peak_memory_MB",
        (double)use.ru_maxrss / 1024, "discretisation_error_mm", json_null(), "discretisation_error_note",
        "not estimated: one mesh was solved; compare runs with other values of tissue.element_mm");
    json_object_set_new(out, "limits", judgement_json(o->limits, o->patient, o->plan->override));
    json_object_set_new(out, "movements", movements_json(o->moves->move, &o->prepared->points, &o->prepared->frame));
    json_object_set_new(out, "trust", json_string(outcome_trust(o->contact)));
    if (o->points) {
        json_object_set_new(out, "landmarks", landmarks_json(o));
        json_object_set_new(out, "soft_to_hard", ratios_json(o));
        json_object_set_new(out, "tissue_in_bone", depth_json(o->depth));
        json_object_set_new(out, "cephalometry",
                            ceph_report_json(&o->prepared->points, &o->points->after, &o->prepared->frame));
    }
    return out;
}

static bool write_surface(const surface *s, const output_dir *dir, const char *name, const char *extension, err *e)
{
    char file[64];
    snprintf(file, sizeof file, "%s%s", name, extension);
    char *path = output_dir_file(dir, file);
    bool ok = mesh_write_surface(s, path, e);
    free(path);
    return ok;
}

static bool write_segments(const outcome *o, const output_dir *dir, err *e)
{
    bool ok = true;
    for (int s = 0; ok && s < SEGMENT_COUNT; s++) {
        if (!o->prepared->segments.part[s].triangle_count) continue;
        char name[48], file[64];
        const rigid *move = &o->moves->move[s];
        surface moved = surface_copy(&o->prepared->segments.part[s]);
        surface_transform(&moved, move);
        snprintf(name, sizeof name, "segment_%s", segment_name((segment_id)s));
        ok = write_surface(&moved, dir, name, ".ply", e) && write_surface(&moved, dir, name, ".stl", e);
        surface_free(&moved);
        if (!ok || rigid_is_identity(move)) continue;
        snprintf(file, sizeof file, "%s.tfm", segment_name((segment_id)s));
        char *path = output_dir_file(dir, file);
        ok = transform_write(move, path, e);
        free(path);
    }
    return ok;
}

static bool write_tissue(const outcome *o, const output_dir *dir, err *e)
{
    const plan_tissue *t = o->tissue;
    double *kind = NEW_ARRAY(double, t->mesh.vertex_count), *segment = NEW_ARRAY(double, t->mesh.vertex_count);
    for (int32_t v = 0; v < t->mesh.vertex_count; v++) {
        kind[v] = t->attach.kind[v];
        segment[v] = t->attach.segment[v];
    }
    point_array arrays[] = {{"displacement", 3, o->u}, {"attachment", 1, kind}, {"segment", 1, segment}};
    char *path = output_dir_file(dir, "tissue.vtu");
    bool ok = mesh_write_tets(&t->mesh, arrays, 3, path, e);
    free(path);
    free(kind);
    free(segment);
    return ok;
}

bool outcome_write_meshes(const outcome *o, const output_dir *dir, err *e)
{
    if (!write_surface(&o->prepared->skin, dir, "skin_before", ".ply", e) ||
        !write_surface(o->skin, dir, "skin_after", ".ply", e) ||
        !write_surface(o->skin, dir, "skin_after", ".stl", e) || !write_segments(o, dir, e) || !write_tissue(o, dir, e))
        return false;
    char *path = output_dir_file(dir, "landmarks_planned.mrk.json");
    bool ok = landmarks_write(&o->points->after, path, e);
    free(path);
    return ok;
}

double outcome_worst_tet(const outcome *o, double middle[3])
{
    const tetmesh *m = &o->prepared->tissue.mesh;
    const int32_t *node = m->tet + 4 * (size_t)o->solve->extremes.min_j_tet;
    double away = HUGE_VAL;
    for (int c = 0; c < 3; c++) {
        middle[c] = 0;
        for (int k = 0; k < 4; k++) middle[c] += 0.25 * m->xyz[3 * (size_t)node[k] + c];
    }
    for (int32_t v = 0; v < o->prepared->skin.vertex_count; v++)
        away = fmin(away, vec_distance(middle, o->prepared->skin.xyz + 3 * (size_t)v));
    return away;
}
