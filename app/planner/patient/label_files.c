#include "app/planner/patient/label_files.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static int64_t voxels_of(const volume *v) { return (int64_t)v->size[0] * v->size[1] * v->size[2]; }

static bool check_same_grid(const volume *a, const char *first, const volume *b, const char *path, err *e)
{
    const double most_mm = 0.01;
    double worst = 0;
    if (memcmp(a->size, b->size, sizeof a->size) != 0)
        return err_at(e, ERR_INPUT, path, 0, NULL,
                      "has %d x %d x %d voxels, and %s has %d x %d x %d: label files must be of one grid", b->size[0],
                      b->size[1], b->size[2], first, a->size[0], a->size[1], a->size[2]);
    for (int corner = 0; corner < 8; corner++) {
        double d[3];
        vec_sub(b->origin, a->origin, d);
        for (int k = 0; k < 3; k++) {
            double n = corner >> k & 1 ? a->size[k] - 1 : 0;
            for (int c = 0; c < 3; c++) d[c] += n * (b->step[k][c] - a->step[k][c]);
        }
        worst = fmax(worst, vec_norm(d));
    }
    return worst <= most_mm ||
           err_at(e, ERR_INPUT, path, 0, NULL,
                  "its voxels lie up to %.3g mm from those of %s: label files must be of one grid", worst, first);
}

/* "mandible" of "seg/mandible.nii.gz". */
static void base_name(const char *path, char *name, size_t size)
{
    static const char *const endings[] = {".nii.gz", ".seg.nrrd", ".nrrd", ".nii", ".mha", ".mhd"};
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path;
    size_t n = strlen(base);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        size_t k = strlen(endings[i]);
        if (n <= k || strcasecmp(base + n - k, endings[i]) != 0) continue;
        n -= k;
        break;
    }
    snprintf(name, size, "%.*s", (int)n, base);
}

/* Adds the voxels of a label as a segment, in the first layer where they are free. */
static void add_segment(volume *to, const volume *from, int32_t layer, int32_t label, const char *name)
{
    int64_t n = voxels_of(from);
    const int16_t *value = from->value + layer * n;
    int32_t number = to->segment_count + 1, at = 0;
    for (; at < to->layers; at++) {
        bool is_free = true;
        for (int64_t i = 0; is_free && i < n; i++) is_free = value[i] != label || !to->value[at * n + i];
        if (is_free) break;
    }
    if (at == to->layers) {
        to->value = GROW_ARRAY(int16_t, to->value, (size_t)(++to->layers * n));
        memset(to->value + at * n, 0, (size_t)n * sizeof *to->value);
    }
    for (int64_t i = 0; i < n; i++)
        if (value[i] == label) to->value[at * n + i] = (int16_t)number;
    to->segment = GROW_ARRAY(volume_segment, to->segment, (size_t)number);
    volume_segment *s = &to->segment[to->segment_count++];
    *s = (volume_segment){.label = number, .layer = at};
    snprintf(s->name, sizeof s->name, "%s", name);
}

static bool add_file(volume *to, const volume *v, const char *path, err *e)
{
    int64_t n = voxels_of(v);
    int16_t label = 0;
    char name[sizeof v->segment->name];
    for (int32_t i = 0; i < v->segment_count; i++)
        add_segment(to, v, v->segment[i].layer, v->segment[i].label, v->segment[i].name);
    if (v->segment_count) return true;
    for (int64_t i = 0; i < n; i++) {
        if (label && v->value[i] && v->value[i] != label)
            return err_at(e, ERR_INPUT, path, 0, NULL,
                          "holds several labels (%d and %d) without names; of several label files each holds one "
                          "structure",
                          label, v->value[i]);
        if (v->value[i]) label = v->value[i];
    }
    base_name(path, name, sizeof name);
    add_segment(to, v, 0, label ? label : INT16_MAX, name); /* one without voxels has its name all the same */
    return true;
}

bool label_files_read(const char *const *path, int count, volume_form form, volume *out, err *e)
{
    volume all = {0}, v;
    bool good = true;
    if (count == 1) return volume_read_by(path[0], form, out, e);
    for (int i = 0; good && i < count; i++) {
        good = volume_read_by(path[i], form, &v, e);
        if (!good) break;
        if (i == 0) {
            all = v;
            all.layers = 1;
            all.segment = NULL;
            all.segment_count = 0;
            all.value = NEW_ARRAY(int16_t, voxels_of(&v));
        }
        good = check_same_grid(&all, path[0], &v, path[i], e) && add_file(&all, &v, path[i], e);
        volume_free(&v);
    }
    if (good)
        *out = all;
    else
        volume_free(&all);
    return good;
}
