/* A CT as DICOM slices, made here element by element: places, what is refused, and the volume that dcm2niix makes. */
#include "tests/check.h"
#include "geometry/dicom_file.h"
#include "geometry/write_whole.h"
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { SIDE = 4, SLICES = 5 };

typedef struct file {
    char bytes[2048];
    size_t size;
} file;

static void put(file *f, unsigned group, unsigned number, const char *type, const void *value, size_t size)
{
    const uint16_t tag[2] = {(uint16_t)group, (uint16_t)number}, size_16 = (uint16_t)size;
    const uint32_t size_32 = (uint32_t)size;
    memcpy(f->bytes + f->size, tag, 4);
    memcpy(f->bytes + f->size + 4, type, 2);
    bool wide = !strcmp(type, "OW");
    if (wide)
        memcpy(f->bytes + f->size + 8, &size_32, 4);
    else
        memcpy(f->bytes + f->size + 6, &size_16, 2);
    f->size += wide ? 12 : 8;
    memcpy(f->bytes + f->size, value, size);
    f->size += size;
}

static void put_text(file *f, unsigned group, unsigned number, const char *type, const char *text)
{
    char even[80] = "";
    size_t n = strlen(text);
    memcpy(even, text, n);
    if (n % 2) even[n++] = strcmp(type, "UI") ? ' ' : 0;
    put(f, group, number, type, even, n);
}

static void put_short(file *f, unsigned group, unsigned number, int value)
{
    const uint16_t v = (uint16_t)value;
    put(f, group, number, "US", &v, 2);
}

typedef struct odd { /* what is unlike a sound series */
    const char *tilt, *syntax, *series;
    double shear_mm, gap_mm; /* per slice; before the last */
    bool no_place, one_place;
    int stored; /* bits of a voxel; 0: 16, all there are */
} odd;

/* Voxel (i, j) of slice k holds -1000 + i + 10 j + 100 k and lies at (-10 + 0.5 i, -20 + 0.5 j, 30 + 1.25 k). */
static void write_slice(const char *folder, int k, const odd *o)
{
    err e = {0};
    file f = {.size = 132};
    char text[80], path[64];
    memcpy(f.bytes + 128, "DICM", 4);
    put_text(&f, 2, 0x10, "UI", o->syntax ? o->syntax : "1.2.840.10008.1.2.1");
    put_text(&f, 8, 0x16, "UI", "1.2.840.10008.5.1.4.1.1.2");
    snprintf(text, sizeof text, "1.2.3.4.%d", k + 1);
    put_text(&f, 8, 0x18, "UI", text);
    put_text(&f, 8, 0x60, "CS", "CT");
    put_text(&f, 0x18, 0x50, "DS", "1.25");
    put_text(&f, 0x18, 0x1120, "DS", o->tilt ? o->tilt : "0");
    put_text(&f, 0x20, 0x0D, "UI", "1.2.3");
    put_text(&f, 0x20, 0x0E, "UI", o->series && k == 2 ? o->series : "1.2.3.4");
    put_text(&f, 0x20, 0x11, "IS", "2");
    snprintf(text, sizeof text, "%d", k + 1);
    put_text(&f, 0x20, 0x13, "IS", text);
    snprintf(text, sizeof text, "-10\\%g\\%g", -20 + o->shear_mm * k,
             30 + (o->one_place ? 0 : 1.25 * k) + (k == SLICES - 1 ? o->gap_mm : 0));
    if (!o->no_place || k) put_text(&f, 0x20, 0x32, "DS", text);
    put_text(&f, 0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0");
    put_short(&f, 0x28, 2, 1);
    put_text(&f, 0x28, 4, "CS", "MONOCHROME2");
    put_short(&f, 0x28, 0x10, SIDE);
    put_short(&f, 0x28, 0x11, SIDE);
    put_text(&f, 0x28, 0x30, "DS", "0.5\\0.5");
    put_short(&f, 0x28, 0x100, 16);
    put_short(&f, 0x28, 0x101, o->stored ? o->stored : 16);
    put_short(&f, 0x28, 0x102, (o->stored ? o->stored : 16) - 1);
    put_short(&f, 0x28, 0x103, 1);
    put_text(&f, 0x28, 0x1052, "DS", "-1000");
    put_text(&f, 0x28, 0x1053, "DS", "1");
    int16_t voxel[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++) voxel[i] = (int16_t)(i % SIDE + 10 * (i / SIDE) + 100 * k);
    put(&f, 0x7FE0, 0x10, "OW", voxel, sizeof voxel);
    snprintf(path, sizeof path, "%s/s%d.dcm", folder, (k * 3) % SLICES); /* names do not follow the place */
    assert_ok(write_whole(path, f.bytes, f.size, &e));
}

static const char *series(const odd *o)
{
    static int number;
    static char folder[32];
    snprintf(folder, sizeof folder, "series%d", number++);
    mkdir(folder, 0777);
    for (int k = 0; k < SLICES; k++) write_slice(folder, k, o);
    return folder;
}

static void a_sound_series_is_measured(void **state)
{
    (void)state;
    err e = {0};
    dicom_series s;
    assert_ok(dicom_check(series(&(odd){0}), &s, &e));
    assert_int_equal(s.slices, SLICES);
    assert_near(s.spacing_mm, 1.25, 1e-12);
}

static void what_would_be_read_wrong_is_refused(void **state)
{
    (void)state;
    static const struct {
        odd o;
        const char *says;
    } bad[] = {{{.tilt = "-12.5"}, "the gantry was tilted by -12.5 degrees"},
               {{.shear_mm = 0.3}, "the slices are shifted against each other by 13.50 degrees"},
               {{.gap_mm = 1.25}, "some are missing, doubled or uneven"},
               {{.gap_mm = -1.25}, "some are missing, doubled or uneven"},
               {{.one_place = true}, "all 5 slices lie at one place"},
               {{.series = "1.2.3.5"}, "holds more than one series"},
               {{.stored = 12}, "BitsStored: 12 of 16 bits hold signed values"},
               {{.no_place = true}, "does not say where its slice lies"},
               {{.syntax = "1.2.840.10008.1.2.2"}, "is of an encoding that is not read"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        err e = {0};
        dicom_series s;
        bool good = dicom_check(series(&bad[i].o), &s, &e);
        if (good || e.code != ERR_INPUT || !strstr(e.text, bad[i].says)) fail_msg("%d: said \"%s\"", (int)i, e.text);
    }
    err e = {0};
    dicom_series s;
    assert_refused(dicom_check("absent", &s, &e), ERR_INPUT);
    mkdir("none", 0777);
    assert_refused(dicom_check("none", &s, &e), ERR_INPUT);
}

static void dcm2niix_makes_the_volume(void **state)
{
    (void)state;
    err e = {0};
    volume v;
    const char *folder = series(&(odd){0});
    if (!dicom_read(folder, &v, &e) && e.code == ERR_RESOURCE) {
        print_message("%s\n", e.text);
        skip();
    }
    assert_ok(!e.code);
    for (int i = 0; i < SIDE * SIDE * SLICES; i++) { /* by place, whichever way the axes run */
        const int at[3] = {i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE};
        double p[3], want;
        for (int c = 0; c < 3; c++)
            p[c] = v.origin[c] + at[0] * v.step[0][c] + at[1] * v.step[1][c] + at[2] * v.step[2][c];
        want = -1000 + (p[0] + 10) / 0.5 + 10 * (p[1] + 20) / 0.5 + 100 * (p[2] - 30) / 1.25;
        assert_near(v.value[i], want, 0.01);
    }
    volume_free(&v);
}

static void without_dcm2niix_its_absence_is_named(void **state)
{
    (void)state;
    err e = {0};
    volume v;
    char *path = strdup(getenv("PATH"));
    setenv("PATH", "/nowhere", 1);
    bool read = dicom_read(series(&(odd){0}), &v, &e);
    setenv("PATH", path, 1);
    free(path);
    assert_false(read);
    assert_int_equal(e.code, ERR_RESOURCE);
    assert_non_null(strstr(e.text, "dcm2niix is not installed"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sound_series_is_measured),
        cmocka_unit_test(what_would_be_read_wrong_is_refused),
        cmocka_unit_test(dcm2niix_makes_the_volume),
        cmocka_unit_test(without_dcm2niix_its_absence_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
