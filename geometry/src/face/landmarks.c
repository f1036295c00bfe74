#include "geometry/landmarks.h"
#include "geometry/landmark_names.h"
#include "geometry/mem.h"
#include "geometry/src/files/fcsv.h"
#include "geometry/src/files/file_name.h"
#include "geometry/src/files/markups.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void landmarks_free(landmarks *l)
{
    free(l->point);
    *l = (landmarks){0};
}

landmarks landmarks_copy(const landmarks *l)
{
    return (landmarks){.count = l->count, .point = COPY_ARRAY(landmark, l->point, l->count)};
}

const landmark *landmarks_find(const landmarks *l, const char *label)
{
    for (int32_t i = 0; i < l->count; i++)
        if (!strcmp(l->point[i].label, label)) return l->point + i;
    return NULL;
}

void landmarks_set(landmarks *l, const char *label, const double xyz[3])
{
    assert(*label && strlen(label) < LANDMARK_LABEL_SIZE);
    landmark *p = (landmark *)(uintptr_t)landmarks_find(l, label);
    if (!p) {
        l->point = GROW_ARRAY(landmark, l->point, l->count + 1);
        p = l->point + l->count++;
        *p = (landmark){0};
        memcpy(p->label, label, strlen(label));
    }
    vec_copy(xyz, p->xyz);
}

int32_t landmarks_automatic(const landmarks *l, char *names, size_t size)
{
    int32_t count = 0;
    size_t n = 0;
    if (size) *names = 0;
    for (int32_t i = 0; i < l->count; i++) {
        if (!(l->point[i].doubt_mm > 0)) continue;
        if (n < size) n += (size_t)snprintf(names + n, size - n, "%s%s", count ? " " : "", l->point[i].label);
        count++;
    }
    return count;
}

/* What is wrong with a label that would be appended, or NULL. */
static const char *label_fault(const landmarks *l, const char *label)
{
    if (!*label) return "has an empty label";
    if (strlen(label) >= LANDMARK_LABEL_SIZE) return "has a label of more than 31 bytes";
    return landmarks_find(l, label) ? "is there twice" : NULL;
}

static bool read_markups(const char *path, landmarks *out, int32_t *skipped, err *e)
{
    json_file f;
    const json_t *list;
    if (!markups_open(path, &f, &list, e)) return false;
    landmarks l = {0};
    bool good = true;
    for (size_t i = 0; good && i < json_array_size(list); i++) {
        bool ras = false, defined = false;
        good = markups_check(&f, i, "Fiducial", &ras, e);
        for (size_t k = 0; good && k < markups_point_count(&f, i); k++) {
            const char *label = "";
            double xyz[3];
            good = markups_point(&f, i, k, ras, &defined, &label, xyz, e);
            if (!good) break;
            if (!defined) {
                ++*skipped;
                continue;
            }
            const char *fault = label_fault(&l, label);
            char pointer[96];
            snprintf(pointer, sizeof pointer, "/markups/%zu/controlPoints/%zu/label", i, k);
            if (fault) {
                good = json_file_refuse(&f, pointer, e, "the landmark \"%s\" %s", label, fault);
                break;
            }
            double doubt_mm = 0;
            landmarks_set(&l, label, xyz);
            if (sscanf(markups_point_description(&f, i, k), "placed by gnathos, about %lf mm", &doubt_mm) == 1 &&
                doubt_mm > 0)
                l.point[l.count - 1].doubt_mm = fmin(doubt_mm, 1000);
        }
    }
    json_file_free(&f);
    if (good)
        *out = l;
    else
        landmarks_free(&l);
    return good;
}

static bool read_fcsv(const char *path, landmarks *out, int32_t *skipped, err *e)
{
    fcsv_file f;
    if (!fcsv_read(path, &f, e)) return false;
    landmarks l = {0};
    bool good = true;
    for (int32_t i = 0; good && i < f.count; i++) {
        const fcsv_row *row = f.row + i;
        const char *fault = label_fault(&l, row->label);
        if (!row->defined)
            ++*skipped;
        else if (fault)
            good = err_at(e, ERR_INPUT, path, row->line, NULL, "the landmark \"%s\" %s", row->label, fault);
        else
            landmarks_set(&l, row->label, row->xyz);
    }
    fcsv_free(&f);
    if (good)
        *out = l;
    else
        landmarks_free(&l);
    return good;
}

bool landmarks_read(const char *path, landmarks *out, int32_t *skipped, err *e)
{
    landmarks l = {0};
    int32_t missing = 0;
    if (file_name_ends(path, ".fcsv")) {
        if (!read_fcsv(path, &l, &missing, e)) return false;
    } else if (file_name_ends(path, ".json")) {
        if (!read_markups(path, &l, &missing, e)) return false;
    } else {
        return file_name_refuse(path, "landmark", ".mrk.json .json .fcsv", "", e);
    }
    if (!l.count) {
        landmarks_free(&l);
        return err_at(e, ERR_INPUT, path, 0, NULL, "holds no landmark with a defined position (%d skipped)", missing);
    }
    landmark_names_resolve(&l);
    *out = l;
    if (skipped) *skipped = missing;
    return true;
}

bool landmarks_write(const landmarks *l, const char *path, err *e)
{
    return landmarks_write_sure(l, HUGE_VAL, path, e);
}

bool landmarks_write_sure(const landmarks *l, double most_mm, const char *path, err *e)
{
    if (!file_name_ends(path, ".mrk.json"))
        return err_at(e, ERR_USAGE, path, 0, NULL, "landmarks are written as .mrk.json");
    json_t *list, *points, *document = markups_document(&list);
    json_array_append_new(list, markups_new("Fiducial", &points));
    for (int32_t i = 0; i < l->count; i++) {
        const landmark *p = l->point + i;
        char words[64] = "";
        if (p->doubt_mm > 0) snprintf(words, sizeof words, "placed by gnathos, about %.1f mm", p->doubt_mm);
        markups_add_described(points, p->label, p->xyz, words, p->doubt_mm <= most_mm);
    }
    bool good = json_file_write(document, path, e);
    json_decref(document);
    return good;
}
