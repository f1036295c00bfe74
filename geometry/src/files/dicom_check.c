/* The few elements of DICOM that place a slice; all others are stepped over. */
#include "geometry/dicom_file.h"
#include "geometry/input_file.h"
#include "geometry/mem.h"
#include "geometry/src/files/number_type.h"
#include "geometry/vec.h"
#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER_MOST = 1 << 20, PREAMBLE = 132, DEPTH_MOST = 16, UNKNOWN_LENGTH = -1 };
static const double tilt_most_deg = 0.1, uneven_most_mm = 0.02;

typedef struct slice {
    char name[256], series[72];
    double place[3], along[6], tilt_deg, height;
    bool has_place, has_along, is_signed;
    int bits_allocated, bits_stored; /* of a voxel; 0: not said */
} slice;

typedef struct bytes {
    const char *at, *end;
    bool explicit_type;
} bytes;

typedef struct element {
    uint32_t tag;
    int64_t length; /* UNKNOWN_LENGTH: up to a delimiter */
} element;

static bool next_element(bytes *b, element *out)
{
    static const char long_form[][3] = {"OB", "OD", "OF", "OL", "OW", "SQ", "UC", "UN", "UR", "UT", "OV", "SV", "UV"};
    if (b->end - b->at < 8) return false;
    uint32_t group = (uint32_t)number_at(b->at, NUMBER_U16, false);
    out->tag = group << 16 | (uint32_t)number_at(b->at + 2, NUMBER_U16, false);
    double length = number_at(b->at + 4, NUMBER_U32, false);
    int head = 8;
    if (b->explicit_type && group != 0xFFFE) {
        length = number_at(b->at + 6, NUMBER_U16, false);
        for (size_t i = 0; i < sizeof long_form / sizeof *long_form; i++)
            if (!memcmp(b->at + 4, long_form[i], 2)) head = 12;
        if (head == 12 && b->end - b->at < 12) return false;
        if (head == 12) length = number_at(b->at + 8, NUMBER_U32, false);
    }
    out->length = length < 4294967295.0 ? (int64_t)length : UNKNOWN_LENGTH;
    b->at += head;
    return true;
}

/* Behind a sequence or an item of unknown length. */
static bool skip_unknown(bytes *b, int depth)
{
    element e;
    while (depth < DEPTH_MOST && next_element(b, &e)) {
        if (e.tag == 0xFFFEE0DD || e.tag == 0xFFFEE00D) return true;
        if (e.length == UNKNOWN_LENGTH) {
            if (!skip_unknown(b, depth + 1)) return false;
            continue;
        }
        if (e.length > b->end - b->at) return false;
        b->at += e.length;
    }
    return false;
}

static void read_text(const bytes *b, int64_t length, char *out, size_t size)
{
    size_t n = (size_t)length < size - 1 ? (size_t)length : size - 1;
    memcpy(out, b->at, n);
    out[n] = 0;
    for (n = strlen(out); n && out[n - 1] == ' '; n--) out[n - 1] = 0;
}

/* "1\2.5\-3" */
static bool read_numbers(const bytes *b, int64_t length, double *out, int count)
{
    char text[256], *at = text, *end;
    read_text(b, length, text, sizeof text);
    for (int i = 0; i < count; i++, at = end + 1) {
        out[i] = strtod(at, &end);
        if (end == at || !isfinite(out[i]) || (i + 1 < count && *end != '\\')) return false;
    }
    return true;
}

/* NULL, or what is wrong. */
static const char *read_elements(bytes b, slice *s)
{
    char syntax[72] = "";
    element e;
    bool meta = true; /* the first group is always explicit */
    b.explicit_type = true;
    while (b.end - b.at >= 8) {
        if (meta && number_at(b.at, NUMBER_U16, false) > 2) {
            meta = false;
            if (!strcmp(syntax, "1.2.840.10008.1.2.2") || !strcmp(syntax, "1.2.840.10008.1.2.1.99"))
                return "is of an encoding that is not read (big endian or deflated)";
            b.explicit_type = strcmp(syntax, "1.2.840.10008.1.2") != 0;
        }
        if (!next_element(&b, &e) || e.tag > 0x00280103) return NULL;
        if (e.length == UNKNOWN_LENGTH) {
            if (!skip_unknown(&b, 0)) return "has a broken header";
            continue;
        }
        if (e.length > b.end - b.at) return "has a broken header";
        double *tilt = &s->tilt_deg;
        if (e.tag == 0x00020010) read_text(&b, e.length, syntax, sizeof syntax);
        if (e.tag == 0x0020000E) read_text(&b, e.length, s->series, sizeof s->series);
        if (e.tag == 0x00181120 && e.length && !read_numbers(&b, e.length, tilt, 1)) return "has a broken gantry tilt";
        if (e.tag == 0x00200032) s->has_place = read_numbers(&b, e.length, s->place, 3);
        if (e.tag == 0x00200037) s->has_along = read_numbers(&b, e.length, s->along, 6);
        if (e.tag == 0x00280100 && e.length >= 2) s->bits_allocated = (int)number_at(b.at, NUMBER_U16, false);
        if (e.tag == 0x00280101 && e.length >= 2) s->bits_stored = (int)number_at(b.at, NUMBER_U16, false);
        if (e.tag == 0x00280103 && e.length >= 2) s->is_signed = number_at(b.at, NUMBER_U16, false) > 0;
        b.at += e.length;
    }
    return NULL;
}

/* dcm2niix takes such voxels below zero for large ones: findings/dcm2niix_signed_stored_bits.sh. */
static bool is_misread(const slice *s) { return s->is_signed && s->bits_stored && s->bits_stored < s->bits_allocated; }

/* *is_slice false: not DICOM, or the folder's directory. */
static bool read_slice(const char *folder, const char *name, slice *s, bool *is_slice, err *e)
{
    char path[4096], *head = NEW_ARRAY(char, HEADER_MOST);
    *s = (slice){0};
    snprintf(path, sizeof path, "%s/%s", folder, name);
    snprintf(s->name, sizeof s->name, "%s", name);
    FILE *in = input_file_open(path, INT64_MAX, NULL, e);
    size_t n = in ? fread(head, 1, HEADER_MOST, in) : 0;
    if (in) fclose(in);
    *is_slice = n > PREAMBLE && !memcmp(head + PREAMBLE - 4, "DICM", 4) && strcmp(name, "DICOMDIR") != 0;
    const char *wrong = *is_slice ? read_elements((bytes){head + PREAMBLE, head + n, true}, s) : NULL;
    free(head);
    if (!in) return false;
    if (*is_slice && !wrong && (!s->has_place || !s->has_along))
        wrong = "does not say where its slice lies (ImagePositionPatient, ImageOrientationPatient)";
    if (!wrong && *is_slice && is_misread(s))
        return err_at(e, ERR_INPUT, path, 0, "BitsStored",
                      "%d of %d bits hold signed values: dcm2niix would turn air into metal; convert the series with "
                      "dicomtonifti and import that",
                      s->bits_stored, s->bits_allocated);
    return !wrong || err_at(e, ERR_INPUT, path, 0, NULL, "%s", wrong);
}

static bool read_folder(const char *folder, slice **list, int *count, err *e)
{
    DIR *dir = opendir(folder);
    if (!dir) return err_at(e, ERR_INPUT, folder, 0, NULL, "cannot be read as a folder: %s", strerror(errno));
    bool good = true;
    for (struct dirent *d; good && (d = readdir(dir));) {
        bool is_slice;
        slice s;
        if (*d->d_name == '.' || d->d_type == DT_DIR) continue;
        good = read_slice(folder, d->d_name, &s, &is_slice, e);
        if (!good || !is_slice) continue;
        *list = GROW_ARRAY(slice, *list, *count + 1);
        (*list)[(*count)++] = s;
    }
    closedir(dir);
    if (good && *count < 2)
        good = err_at(e, ERR_INPUT, folder, 0, NULL, "holds %d DICOM slices; a CT has many", *count);
    return good;
}

static int compare_heights(const void *a, const void *b)
{
    double x = ((const slice *)a)->height, y = ((const slice *)b)->height;
    return (x > y) - (x < y);
}

static bool check_slices(const char *folder, slice *s, int count, dicom_series *out, err *e)
{
    double normal[3], way[3];
    vec_cross(s[0].along, s[0].along + 3, normal);
    vec_normalize(normal);
    for (int i = 0; i < count; i++) {
        if (strcmp(s[i].series, s[0].series))
            return err_at(e, ERR_INPUT, folder, 0, NULL,
                          "holds more than one series (%s and %s differ); put one into a folder of its own", s[0].name,
                          s[i].name);
        for (int k = 0; k < 6; k++)
            if (!(fabs(s[i].along[k] - s[0].along[k]) < 1e-4))
                return err_at(e, ERR_INPUT, folder, 0, NULL, "%s lies in another direction than %s", s[i].name,
                              s[0].name);
        if (fabs(s[i].tilt_deg) > tilt_most_deg)
            return err_at(
                e, ERR_INPUT, folder, 0, NULL,
                "the gantry was tilted by %g degrees (%s): converters differ there; resample the series first",
                s[i].tilt_deg, s[i].name);
        s[i].height = vec_dot(s[i].place, normal);
    }
    qsort(s, (size_t)count, sizeof *s, compare_heights);
    double spacing = (s[count - 1].height - s[0].height) / (count - 1);
    if (!(spacing > uneven_most_mm))
        return err_at(e, ERR_INPUT, folder, 0, NULL,
                      "all %d slices lie at one place (%s to %s): a CT goes on from "
                      "slice to slice",
                      count, s[0].name, s[count - 1].name);
    vec_sub(s[count - 1].place, s[0].place, way);
    double tilt = acos(fmax(-1, fmin(1, vec_dot(way, normal) / vec_norm(way)))) * 180 / M_PI;
    if (!(tilt <= tilt_most_deg))
        return err_at(
            e, ERR_INPUT, folder, 0, NULL,
            "the slices are shifted against each other by %.2f degrees (a tilted gantry): resample the series "
            "first",
            tilt);
    for (int i = 1; i < count; i++) {
        double step = s[i].height - s[i - 1].height;
        if (!(fabs(step - spacing) <= uneven_most_mm))
            return err_at(e, ERR_INPUT, folder, 0, NULL,
                          "slices are %.3f mm apart from %s to %s and %.3f mm on average: some are missing, doubled or "
                          "uneven",
                          step, s[i - 1].name, s[i].name, spacing);
    }
    *out = (dicom_series){count, spacing};
    return true;
}

bool dicom_check(const char *folder, dicom_series *out, err *e)
{
    slice *list = NULL;
    int count = 0;
    bool good = read_folder(folder, &list, &count, e) && check_slices(folder, list, count, out, e);
    free(list);
    return good;
}
