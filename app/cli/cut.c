/* gnathos cut CASE -o DIR: the bones of a case cut along its osteotomies, as files. */
#include "app/cli/verb.h"
#include "app/planner/patient/cut_record.h"
#include "geometry/mesh_file.h"
#include "geometry/plane_file.h"
#if GNATHOS_WITH_RENDER
#include "render/anatomy.h"
#endif
#include <stdio.h>
#include <stdlib.h>

static const struct argp_option options[] = {
    {"output", 'o', "DIR", 0, "The folder of results, which must not exist yet", 0},
    {"force", 'f', NULL, 0, "Replace earlier results in DIR", 0},
    {0}};

static bool write_bone(const surface *s, const char *name, const output_dir *d, err *e)
{
    static const char *const kinds[] = {"ply", "stl"};
    for (int k = 0; k < 2 && s->triangle_count; k++) {
        char file[64];
        snprintf(file, sizeof file, "%s.%s", name, kinds[k]);
        char *path = output_dir_file(d, file);
        bool ok = mesh_write_surface(s, path, e);
        free(path);
        if (!ok) return false;
    }
    return true;
}

static bool write_picture(const anatomy *a, const char *title, const output_dir *d, err *e)
{
#if GNATHOS_WITH_RENDER
    anatomy_piece piece[SEGMENT_COUNT];
    int count = 0;
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        if (!a->segments.part[s].triangle_count) continue;
        anatomy_piece *p = &piece[count++];
        *p = (anatomy_piece){.part = {.bone = &a->segments.part[s],
                                      .before = rigid_identity(),
                                      .after = rigid_identity(),
                                      .kind = MATERIAL_BONE,
                                      .name = segment_title((segment_id)s)}};
        segment_color((segment_id)s, p->part.rgb);
        anatomy_apart((segment_id)s, &a->frame, 18, p->apart_mm);
    }
    gallery_style style = gallery_style_default();
    char *path = output_dir_file(d, "exploded.png");
    bool ok = anatomy_exploded_write(piece, count, NULL, 0, &a->frame, title, &style, 1920, 1080, path, e);
    free(path);
    return ok;
#else
    (void)a;
    (void)title;
    (void)d;
    (void)e;
    return true;
#endif
}

static void print_plain(const anatomy *a, const char *target)
{
    const cut_report *r = &a->cuts;
    printf("%-22s %12s %12s %12s %12s %10s\n", "cut (mm3)", "before", "piece", "rest", "saw", "error");
    for (int i = 0; i < r->balance_count; i++) {
        const cut_balance *b = &r->balance[i];
        printf("%-22s %12.1f %12.1f %12.1f %12.1f %10.1e\n", b->name, b->before_mm3, b->piece_mm3, b->rest_mm3,
               b->kerf_mm3, b->error_share);
    }
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (r->volume_mm3[s] > 0)
            printf("segment %-22s %10.2f cm3, %d triangles\n", segment_name((segment_id)s), r->volume_mm3[s] / 1000,
                   a->segments.part[s].triangle_count);
    for (int i = 0; i < r->clearance_count; i++) {
        const cut_clearance *k = &r->clearance[i];
        printf("  %-44s %6.1f mm, at least %4.1f: %s%s\n", k->name, k->value_mm, k->limit_mm,
               k->ok ? "ok" : "TOO CLOSE", k->estimated ? " (estimated)" : "");
    }
    for (int i = 0; i < r->fragment_count; i++) {
        const cut_fragment *f = &r->fragment[i];
        printf("  island of %.1f mm3 from the %s: %s the %s, %.2f mm away\n", f->volume_mm3, segment_name(f->from),
               f->from == f->to ? "stays with" : "goes to", segment_name(f->to), f->gap_mm);
    }
    printf("%s\n", command_shown(target));
}

static bool write_all(const case_file *c, const anatomy *a, const json_t *report, output_dir *d, err *e)
{
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (!write_bone(&a->segments.part[s], segment_name((segment_id)s), d, e)) return false;
    if (!write_bone(&a->segments.kerf, "kerf", d, e)) return false;
    char *to = output_dir_file(d, "cut_report.json");
    bool ok = json_file_write(report, to, e);
    free(to);
    if (ok && a->cuts.plane_count) {
        char *path = output_dir_file(d, "cut_planes.mrk.json");
        ok = planes_write(a->cuts.plane, a->cuts.plane_count, path, e);
        free(path);
    }
    return ok && write_picture(a, c->name, d, e);
}

static bool run(run_context *r, err *e)
{
    anatomy a = {0};
    bool ok = anatomy_make(&r->patient, false, &r->watch, &a, e);
    command_print_issues(&r->common, &a.warnings);
    json_t *report = ok ? cut_record_json(&r->patient, &a) : NULL;
    if (ok && command_interrupted()) ok = err_set(e, ERR_INTERRUPTED, "interrupted");
    ok = ok && write_all(&r->patient, &a, report, &r->dir, e) && output_dir_close(&r->dir, e);
    if (ok && !GNATHOS_WITH_RENDER)
        command_note(&r->common, "no picture: this build has no renderer (GNATHOS_RENDER=OFF)");
    if (ok && r->common.json)
        command_print_record(json_incref(report));
    else if (ok)
        print_plain(&a, r->out_path);
    json_decref(report);
    anatomy_free(&a);
    return ok;
}

const verb verb_cut = {.arguments = "CASE -o DIR",
                       .about =
                           "Cuts the bones of a case along its osteotomies and writes every segment, the bone that "
                           "the saw removes, the planes, a report and a picture.",
                       .options = options,
                       .argument_count = 1,
                       .missing_argument = "name a case",
                       .missing_output = "name the folder of results with -o",
                       .need = NEED_CASE | NEED_OUTPUT,
                       .run = run};
