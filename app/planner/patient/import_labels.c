/* Parts of a case from a label map, and the skin from a CT. */
#include "app/planner/patient/import.h"
#include "app/planner/patient/label_choice.h"
#include "app/planner/patient/label_files.h"
#include "geometry/dicom_file.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double voxel_mm3(const volume *v)
{
    const double *a = v->step[0], *b = v->step[1], *c = v->step[2], zero[3] = {0};
    return fabs(vec_six_volume(zero, a, b, c));
}

static bool mesh_part(const import_params *p, const volume *grid, const label_fields *f, int number, mask *m,
                      import_part *part, err *e)
{
    part->from_labels = true;
    part->label_mm3 = (double)mask_count(m) * voxel_mm3(grid);
    return label_surface_make(f, number, &p->mesh, &part->mesh, &part->made, e) || err_prefix(e, "%s", part->source);
}

/* The head as one solid: its largest piece, openings sealed, cavities filled. */
static bool mesh_skin(const import_params *p, const task *watch, const volume *grid, mask *m, import_part *part, err *e)
{
    task_progress(watch, "skin", -1);
    part->islands_dropped = mask_keep_largest(m);
    int64_t before = mask_count(m);
    if (p->seal_mm > 0) mask_seal(m, grid, p->seal_mm / 2);
    part->sealed_voxels = mask_count(m) - before;
    part->cavity_voxels = mask_fill_cavities(m);
    mask_keep_largest(m);
    label_fields *f = label_fields_create(grid, m, 1, p->mesh.sigma_voxels);
    bool good = mesh_part(p, grid, f, 0, m, part, e);
    label_fields_destroy(&f);
    return good;
}

static bool choose_labels(const import_params *p, const volume *v, const char *where, import_result *out,
                          label_choice *c, err *e)
{
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) {
        import_part *part = &out->part[i];
        if (part->mesh.vertex_count) continue; /* came from a mesh file */
        size_t n = (size_t)snprintf(part->source, sizeof part->source, "%s, label", where);
        for (int k = 0; k < p->from[i].count; k++) {
            if (!label_choose_words(v, where, (case_surface)i, p->from[i].word[k], c, e)) return false;
            if (n < sizeof part->source)
                n += (size_t)snprintf(part->source + n, sizeof part->source - n, "%s%s", k ? "," : " ",
                                      p->from[i].word[k]);
        }
        if (p->from[i].count) continue;
        part->source[0] = 0;
        if (p->preset && !(i == CASE_SKIN && p->ct)) {
            if (!label_choose_preset(v, where, p->preset, (case_surface)i, c, e)) return false;
            snprintf(part->source, sizeof part->source, "%s, %s", where, p->preset);
        }
    }
    return true;
}

/* Nothing that is in the file vanishes without a word. */
static void note_unused(const import_params *p, const volume *v, const char *where, const label_choice *c,
                        issue_list *notes)
{
    char text[400];
    int count = label_choice_unused(c, v, text, sizeof text);
    if (count)
        issue_add(notes, p->preset ? ISSUE_WARNING : ISSUE_INFO, ERR_NONE, where, 0, NULL,
                  "%d label%s make%s no part of the case: %s", count, count > 1 ? "s" : "", count > 1 ? "" : "s", text);
}

static void note_thick(const volume *v, const char *where, issue_list *notes)
{
    const double most_mm = 2.5;
    double side[3];
    for (int k = 0; k < 3; k++) side[k] = vec_norm(v->step[k]);
    if (fmax(side[0], fmax(side[1], side[2])) > most_mm)
        issue_add(
            notes, ISSUE_WARNING, ERR_NONE, where, 0, NULL,
            "has voxels of %.2g x %.2g x %.2g mm: surfaces from slices this thick are known to no better than half of "
            "that; up to %g mm would be right",
            side[0], side[1], side[2], most_mm);
}

/* Drops islands, fills what is enclosed and belongs to no other part. */
static void clean_bones(const import_params *p, const volume *v, const char *where, mask *m, import_result *out,
                        issue_list *notes)
{
    int64_t least = (int64_t)ceil(p->mesh.least_mm3 / voxel_mm3(v)), voxels = mask_voxels(&m[0]);
    for (int i = CASE_SKULL; i < CASE_SURFACE_COUNT; i++) {
        import_part *part = &out->part[i];
        if (!mask_count(&m[i])) continue;
        part->islands_dropped = mask_drop_islands(&m[i], least, &part->island_voxels);
        if (!mask_count(&m[i]))
            issue_add(notes, ISSUE_WARNING, ERR_NONE, where, 0, NULL,
                      "the label of the %s has only pieces of less than %g mm^3: left out",
                      case_surface_name((case_surface)i), p->mesh.least_mm3);
        part->cavity_voxels = mask_fill_cavities(&m[i]);
        for (int k = CASE_SKULL; k < CASE_SURFACE_COUNT; k++)
            for (int64_t at = 0; k != i && at < voxels; at++)
                if (m[k].on[at] && m[i].on[at] && v->layers == 1) m[i].on[at] = 0;
    }
}

static int64_t jaw_contacts(mask *m)
{
    static const case_surface upper[2] = {CASE_SKULL, CASE_UPPER_TEETH}, lower[2] = {CASE_MANDIBLE, CASE_LOWER_TEETH};
    int64_t sum = 0;
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++) sum += mask_contacts(&m[upper[a]], &m[lower[b]]);
    return sum;
}

static bool mesh_bones(const import_params *p, const task *watch, const volume *v, mask *m, import_result *out, err *e)
{
    label_fields *f = label_fields_create(v, m + CASE_SKULL, CASE_SURFACE_COUNT - CASE_SKULL, p->mesh.sigma_voxels);
    bool good = true;
    for (int i = CASE_SKULL; good && i < CASE_SURFACE_COUNT; i++) {
        if (!mask_count(&m[i])) continue;
        task_progress(watch, case_surface_name((case_surface)i), -1);
        good = mesh_part(p, v, f, i - CASE_SKULL, &m[i], &out->part[i], e);
        if (good && task_interrupted(watch)) good = err_set(e, ERR_INTERRUPTED, "interrupted");
    }
    label_fields_destroy(&f);
    return good;
}

static bool parts_of_labels(const import_params *p, const task *watch, import_result *out, issue_list *notes, err *e)
{
    volume v;
    mask m[CASE_SURFACE_COUNT];
    label_choice choice = {0};
    char where[1100];
    if (p->preset && !label_preset_check(p->preset, e)) return false;
    task_progress(watch, "labels", -1);
    if (!label_files_read(p->labels.word, p->labels.count, p->form, &v, e)) return false;
    if (p->labels.count == 1)
        snprintf(where, sizeof where, "%s", p->labels.word[0]);
    else
        snprintf(where, sizeof where, "%.1000s and %d more", p->labels.word[0], p->labels.count - 1);
    note_thick(&v, where, notes);
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) m[i] = mask_new(v.size);
    bool good = choose_labels(p, &v, where, out, &choice, e);
    if (good) {
        for (int i = 0; i < CASE_SURFACE_COUNT; i++) label_choice_mask(&choice, &v, (case_surface)i, &m[i]);
        note_unused(p, &v, where, &choice, notes);
        clean_bones(p, &v, where, m, out, notes);
        out->contacts = jaw_contacts(m);
        if (out->contacts)
            issue_add(notes, ISSUE_WARNING, ERR_NONE, where, 0, NULL,
                      "upper and lower jaw touch at %lld pairs of voxels (joints or teeth): the surfaces "
                      "meet there",
                      (long long)out->contacts);
        good = mesh_bones(p, watch, &v, m, out, e);
    }
    if (good && mask_count(&m[CASE_SKIN])) {
        /* a label of soft tissue has the bones as holes */
        for (int i = CASE_SKULL; i < CASE_SURFACE_COUNT; i++)
            for (int64_t at = 0; at < mask_voxels(&m[i]); at++) m[CASE_SKIN].on[at] |= m[i].on[at];
        good = mesh_skin(p, watch, &v, &m[CASE_SKIN], &out->part[CASE_SKIN], e);
    }
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) mask_free(&m[i]);
    label_choice_free(&choice);
    volume_free(&v);
    return good;
}

/* Share of the voxels on the sides of the volume, but for its ends, that are as bright as bone. */
static double bright_share(const volume *v)
{
    static const double bone_hu = 300;
    int64_t bright = 0, all = 0;
    for (int64_t i = 0; i < (int64_t)v->size[0] * v->size[1] * v->size[2]; i++) {
        int64_t x = i % v->size[0], y = i / v->size[0] % v->size[1];
        if (x > 0 && x < v->size[0] - 1 && y > 0 && y < v->size[1] - 1) continue;
        bright += v->value[i] > bone_hu;
        all++;
    }
    return (double)bright / (double)all;
}

/* Around a head there is air, at -1000 HU; scanners that count from 0 or 1024 below say other numbers. */
static bool check_grey_values(const import_params *p, const volume *v, err *e)
{
    static const double air_hu = -700, least_share = 0.001;
    int64_t voxels = (int64_t)v->size[0] * v->size[1] * v->size[2], air = 0, outside = 0;
    int16_t low = INT16_MAX, high = INT16_MIN;
    for (int64_t i = 0; i < voxels; i++) {
        int16_t x = v->value[i];
        air += x <= air_hu;
        outside += x <= p->skin_hu;
        if (x < low) low = x;
        if (x > high) high = x;
    }
    if ((double)outside < least_share * (double)voxels)
        return err_at(e, ERR_INPUT, p->ct, 0, NULL,
                      "all voxels (%d to %d) lie above the %g HU of --skin-hu: the values may not be Hounsfield units; "
                      "name the grey value of the skin's surface with --skin-hu",
                      low, high, p->skin_hu);
    if (!p->skin_hu_given && (double)air < least_share * (double)voxels)
        return err_at(e, ERR_INPUT, p->ct, 0, NULL,
                      "no voxel is near -1000 HU, as air is (values are %d to %d): the values may not be Hounsfield "
                      "units; name the grey value of the skin's surface with --skin-hu",
                      low, high);
    if (!p->skin_hu_given && bright_share(v) > 0.5)
        return err_at(e, ERR_INPUT, p->ct, 0, NULL,
                      "is as bright as bone on most of its sides (values are %d to %d), where air should be: the grey "
                      "values may be turned round, and are no Hounsfield units",
                      low, high);
    return true;
}

static bool skin_of_ct(const import_params *p, const task *watch, import_result *out, issue_list *notes, err *e)
{
    volume v;
    import_part *part = &out->part[CASE_SKIN];
    if (part->mesh.vertex_count) return err_set(e, ERR_USAGE, "--skin and --ct both give the skin; leave one out");
    task_progress(watch, "ct", -1);
    if (!(p->ct_is_dicom ? dicom_read(p->ct, &v, e) : volume_read_by(p->ct, p->form, &v, e))) return false;
    if (!check_grey_values(p, &v, e)) {
        volume_free(&v);
        return false;
    }
    mask head = mask_new(v.size);
    mask_add_above(&head, &v, p->skin_hu);
    snprintf(part->source, sizeof part->source, "%s, above %g HU", p->ct, p->skin_hu);
    part->thresholded = true;
    bool good = mask_count(&head) > 0 ? mesh_skin(p, watch, &v, &head, part, e)
                                      : err_at(e, ERR_INPUT, p->ct, 0, NULL, "has no voxel above %g HU", p->skin_hu);
    if (good)
        issue_add(notes, ISSUE_WARNING, ERR_NONE, p->ct, 0, NULL,
                  "the skin was cut out by its grey value: headrest, tubes and dressings belong to it where "
                  "they touch");
    mask_free(&head);
    volume_free(&v);
    return good;
}

bool import_labels(const import_params *p, const task *watch, import_result *out, issue_list *notes, err *e)
{
    if (p->labels.count && !parts_of_labels(p, watch, out, notes, e)) return false;
    return !p->ct || skin_of_ct(p, watch, out, notes, e);
}
