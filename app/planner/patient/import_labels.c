/* Parts of a case from a label map, and the skin from a CT. */
#include "app/planner/patient/import.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Label numbers and the names that the same labels bear in Slicer's segmentations. */
typedef struct preset_row {
    case_surface part;
    int32_t label;
    const char *names[3];
    bool required;
} preset_row;

static const preset_row dental_segmentator[] = {
    {CASE_SKULL, 1, {"Upper Skull", "Maxilla & Upper Skull", "Maxilla"}, true},
    {CASE_MANDIBLE, 2, {"Mandible"}, true},
    {CASE_UPPER_TEETH, 3, {"Upper Teeth"}, false},
    {CASE_LOWER_TEETH, 4, {"Lower Teeth"}, false},
};
enum { PRESET_ROWS = sizeof dental_segmentator / sizeof *dental_segmentator };

/* The labels of the file in words, for messages. */
static void list_labels(const volume *v, char *text, size_t size)
{
    size_t n = 0;
    text[0] = 0;
    for (int32_t i = 0; i < v->segment_count && n + 70 < size; i++)
        n += (size_t)snprintf(text + n, size - n, "%s\"%s\"", i ? ", " : "", v->segment[i].name);
    if (v->segment_count) return;
    uint8_t *seen = NEW_ARRAY(uint8_t, 65536);
    int64_t voxels = (int64_t)v->layers * v->size[0] * v->size[1] * v->size[2];
    for (int64_t i = 0; i < voxels; i++) seen[v->value[i] + 32768] = 1;
    for (int k = 0; k < 65536 && n + 16 < size; k++)
        if (seen[k] && k != 32768) n += (size_t)snprintf(text + n, size - n, "%s%d", n ? ", " : "", k - 32768);
    free(seen);
}

static const volume_segment *find_segment(const volume *v, const char *name)
{
    for (int32_t i = 0; i < v->segment_count; i++)
        if (!strcasecmp(v->segment[i].name, name)) return v->segment + i;
    return NULL;
}

/* Adds one label, a name or, where the file names none, a number. */
static bool add_label(const volume *v, const char *path, const char *word, mask *m, err *e)
{
    char known[700], *end;
    const volume_segment *s = find_segment(v, word);
    long number = strtol(word, &end, 10);
    bool is_number = *word && !*end && number > INT16_MIN && number <= INT16_MAX;
    if (s)
        mask_add_label(m, v, s->label, s->layer);
    else if (is_number && number && !v->segment_count)
        mask_add_label(m, v, (int32_t)number, 0);
    else {
        list_labels(v, known, sizeof known);
        return err_at(e, ERR_INPUT, path, 0, NULL, "has no label \"%s\"; choose by %s: %s", word,
                      v->segment_count ? "name" : "number", known);
    }
    if (mask_count(m)) return true;
    list_labels(v, known, sizeof known);
    return err_at(e, ERR_INPUT, path, 0, NULL, "the label \"%s\" has no voxels; labels are %s", word, known);
}

static bool add_words(const volume *v, const char *path, const char *words, mask *m, err *e)
{
    char *copy = mem_text(words), *rest = copy;
    bool good = true;
    while (good && rest) {
        char *word = strsep(&rest, ",");
        word += strspn(word, " ");
        for (size_t n = strlen(word); n && word[n - 1] == ' '; n--) word[n - 1] = 0;
        mask one = mask_new(m->size);
        good = add_label(v, path, word, &one, e);
        for (int64_t i = 0; good && i < mask_voxels(m); i++) m->on[i] |= one.on[i];
        mask_free(&one);
    }
    free(copy);
    return good;
}

/* Fills *m by the preset; leaves it empty where the file lacks an optional label. */
static bool add_preset(const volume *v, const char *path, case_surface part, mask *m, err *e)
{
    for (int i = 0; i < PRESET_ROWS; i++) {
        const preset_row *row = &dental_segmentator[i];
        if (row->part != part) continue;
        const volume_segment *s = NULL;
        for (int k = 0; k < 3 && !s && row->names[k]; k++) s = find_segment(v, row->names[k]);
        if (s)
            mask_add_label(m, v, s->label, s->layer);
        else if (!v->segment_count)
            mask_add_label(m, v, row->label, 0);
        if (mask_count(m) || !row->required) return true;
        char known[700];
        list_labels(v, known, sizeof known);
        return err_at(e, ERR_INPUT, path, 0, NULL,
                      "lacks the label of the %s that dental-segmentator makes (%d, \"%s\"); "
                      "it has %s",
                      case_surface_name(part), row->label, row->names[0], known);
    }
    return true;
}

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

static bool read_masks(const import_params *p, const volume *v, mask *m, import_result *out, err *e)
{
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) {
        import_part *part = &out->part[i];
        if (part->mesh.vertex_count) continue; /* came from a mesh file */
        if (p->from[i]) {
            if (!add_words(v, p->labels, p->from[i], &m[i], e)) return false;
            snprintf(part->source, sizeof part->source, "%s, label %s", p->labels, p->from[i]);
        } else if (p->preset) {
            if (!add_preset(v, p->labels, (case_surface)i, &m[i], e)) return false;
            snprintf(part->source, sizeof part->source, "%s, %s", p->labels, p->preset);
        }
    }
    return true;
}

/* Drops islands, fills what is enclosed and belongs to no other part. */
static void clean_bones(const import_params *p, const volume *v, mask *m, import_result *out, issue_list *notes)
{
    int64_t least = (int64_t)ceil(p->mesh.least_mm3 / voxel_mm3(v)), voxels = mask_voxels(&m[0]);
    for (int i = CASE_SKULL; i < CASE_SURFACE_COUNT; i++) {
        import_part *part = &out->part[i];
        if (!mask_count(&m[i])) continue;
        part->islands_dropped = mask_drop_islands(&m[i], least, &part->island_voxels);
        if (!mask_count(&m[i]))
            issue_add(notes, ISSUE_WARNING, ERR_NONE, p->labels, 0, NULL,
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
    if (p->preset && strcmp(p->preset, "dental-segmentator"))
        return err_set(e, ERR_USAGE, "unknown preset \"%s\"; known is dental-segmentator", p->preset);
    task_progress(watch, "labels", -1);
    if (!volume_read(p->labels, &v, e)) return false;
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) m[i] = mask_new(v.size);
    bool good = read_masks(p, &v, m, out, e);
    if (good) {
        clean_bones(p, &v, m, out, notes);
        out->contacts = jaw_contacts(m);
        if (out->contacts)
            issue_add(notes, ISSUE_WARNING, ERR_NONE, p->labels, 0, NULL,
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
    volume_free(&v);
    return good;
}

static bool skin_of_ct(const import_params *p, const task *watch, import_result *out, issue_list *notes, err *e)
{
    volume v;
    import_part *part = &out->part[CASE_SKIN];
    if (part->mesh.vertex_count) return err_set(e, ERR_USAGE, "--skin and --ct both give the skin; leave one out");
    task_progress(watch, "ct", -1);
    if (!volume_read(p->ct, &v, e)) return false;
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
    if (p->labels && !parts_of_labels(p, watch, out, notes, e)) return false;
    return !p->ct || skin_of_ct(p, watch, out, notes, e);
}
