/* Transforms: the direction trap of ITK files, every accepted kind, refusals. */
#include "tests/check.h"
#include "geometry/transform_file.h"
#include "geometry/vec.h"
#include "geometry/write_whole.h"
#include <string.h>

static void write_text(const char *path, const char *text)
{
    err e = {0};
    assert_ok(write_whole(path, text, strlen(text), &e));
}

/* Slicer: a node moves a point p(RAS) to A p and is stored as inverse(F A F), F = diag(-1,-1,1). Here A is a
 * turn of 90 degrees about +S (R -> A -> L) followed by a shift, so that A and its inverse differ for every
 * point. */
static void a_slicer_node_moves_bone_forwards(void **state)
{
    (void)state;
    err e = {0};
    const double shift[3] = {5, 7, -11}; /* RAS: A p = (-p1, p0, p2) + shift */
    /* F A F = turn by 90 about S with shift (-5,-7,-11); its inverse: M = (y, -x, z), t = -M (-5,-7,-11) */
    write_text("node.tfm", "#Insight Transform File V1.0\n#Transform 0\nTransform: AffineTransform_double_3_3\n"
                           "Parameters: 0 1 0 -1 0 0 0 0 1 7 -5 11\nFixedParameters: 0 0 0\n");
    rigid motion;
    assert_ok(transform_read("node.tfm", &motion, &e));
    const double ras[3][3] = {{1, 0, 0}, {0, 20, 3}, {-4, 9, 100}};
    for (int i = 0; i < 3; i++) {
        const double *p = ras[i], want_ras[3] = {-p[1] + shift[0], p[0] + shift[1], p[2] + shift[2]};
        double lps[3] = {-p[0], -p[1], p[2]}, moved[3];
        rigid_apply(&motion, lps, moved);
        assert_near(moved[0], -want_ras[0], 1e-12);
        assert_near(moved[1], -want_ras[1], 1e-12);
        assert_near(moved[2], want_ras[2], 1e-12);
    }
    /* and what we write has the same numbers */
    assert_ok(transform_write(&motion, "again.tfm", &e));
    FILE *f = fopen("again.tfm", "rb");
    char text[1024] = "";
    assert_true(fread(text, 1, sizeof text - 1, f) > 0);
    fclose(f);
    double n[12];
    const char *at = strstr(text, "Parameters:") + 11;
    const double want[12] = {0, 1, 0, -1, 0, 0, 0, 0, 1, 7, -5, 11};
    for (int i = 0; i < 12; i++) {
        n[i] = strtod(at, (char **)&at);
        assert_near(n[i], want[i], 1e-12);
    }
}

static void a_written_motion_reads_back(void **state)
{
    (void)state;
    err e = {0};
    rigid turn = rigid_rotation((const double[3]){10, -60, 5}, (const double[3]){1, 2, 3}, 0.7);
    rigid shift = rigid_translation((const double[3]){1, -8, 0.3}), a = rigid_compose(&shift, &turn), b;
    assert_ok(transform_write(&a, "motion.tfm", &e));
    assert_ok(transform_read("motion.tfm", &b, &e));
    for (int i = 0; i < 9; i++) assert_near(b.r[i], a.r[i], 1e-14);
    for (int i = 0; i < 3; i++) assert_near(b.t[i], a.t[i], 1e-12);
}

/* Every kind, written by hand for one resampling transform: 30 degrees about z around centre c, then t. */
static void all_accepted_kinds_mean_the_same(void **state)
{
    (void)state;
    err e = {0};
    static const char *const body[] = {
        "Transform: MatrixOffsetTransformBase_double_3_3\nParameters: 0.86602540378443865 -0.5 0 0.5 "
        "0.86602540378443865 0 0 0 1 1 2 3\nFixedParameters: 10 20 30\n",
        "Transform: AffineTransform_float_3_3\r\nFixedParameters: 10 20 30\r\n\r\n# a remark\r\nParameters: "
        "0.8660254 -0.5 0 0.5 0.8660254 0 0 0 1 1 2 3\r\n",
        "Transform: Euler3DTransform_double_3_3\nParameters: 0 0 0.52359877559829887 1 2 3\nFixedParameters: "
        "10 20 30\n",
        "Transform: Euler3DTransform_double_3_3\nParameters: 0 0 0.52359877559829887 1 2 3\nFixedParameters: "
        "10 20 30 1\n",
        "Transform: VersorRigid3DTransform_double_3_3\nParameters: 0 0 0.25881904510252076 1 2 "
        "3\nFixedParameters: 10 20 "
        "30\n"};
    for (size_t i = 0; i < sizeof body / sizeof *body; i++) {
        char text[512];
        snprintf(text, sizeof text, "#Insight Transform File V1.0\n%s", body[i]);
        write_text("kind.tfm", text);
        rigid a;
        assert_ok(transform_read("kind.tfm", &a, &e));
        /* inverse: x = M^T (x' - c - t) + c; the image of c + t is c */
        double moved[3], x[3] = {11, 22, 33};
        rigid_apply(&a, x, moved);
        assert_near(moved[0], 10, 1e-6);
        assert_near(moved[1], 20, 1e-6);
        assert_near(moved[2], 30, 1e-6);
        x[0] += 1;
        rigid_apply(&a, x, moved);
        assert_near(moved[0], 10 + cos(0.52359877559829887), 1e-6);
        assert_near(moved[1], 20 - sin(0.52359877559829887), 1e-6);
    }
}

/* Rz Rx Ry against Rz Ry Rx: a point of the y axis tells them apart. */
static void euler_orders_differ_as_in_itk(void **state)
{
    (void)state;
    err e = {0};
    rigid a, inverse;
    double y[3] = {0, 1, 0}, out[3];
    write_text("zxy.tfm", "#Insight Transform File V1.0\nTransform: Euler3DTransform_double_3_3\nParameters: "
                          "1.5707963267948966 1.5707963267948966 0 0 0 0\nFixedParameters: 0 0 0\n");
    assert_ok(transform_read("zxy.tfm", &a, &e));
    inverse = rigid_inverse(&a);
    rigid_apply(&inverse, y, out); /* Ry keeps y, Rx takes it to z */
    assert_near(out[2], 1, 1e-12);
    write_text("zyx.tfm", "#Insight Transform File V1.0\nTransform: Euler3DTransform_double_3_3\nParameters: "
                          "1.5707963267948966 1.5707963267948966 0 0 0 0\nFixedParameters: 0 0 0 1\n");
    assert_ok(transform_read("zyx.tfm", &a, &e));
    inverse = rigid_inverse(&a);
    rigid_apply(&inverse, y, out); /* Rx takes y to z, Ry takes z to x */
    assert_near(out[0], 1, 1e-12);
}

static void wrong_transforms_are_refused_with_file_and_line(void **state)
{
    (void)state;
#define HEAD "#Insight Transform File V1.0\n#Transform 0\n"
#define AFFINE "Transform: AffineTransform_double_3_3\n"
    static const struct {
        const char *path, *text, *says;
    } bad[] = {
        {"a.h5", "x", "a.h5: is not an HDF5 file"},
        {"a.mat", "x", "a.mat: is not a transform of ITK: a matrix is not whole"},
        {"empty.tfm", "", "empty.tfm: the file is empty"},
        {"none.tfm", HEAD, "none.tfm: holds no transform"},
        {"head.tfm", "hello\n", "head.tfm:1: "},
        {"composite.tfm", HEAD "Transform: CompositeTransform_double_3_3\n", "composite.tfm:3: Transform: Composite"},
        {"plane.tfm", HEAD "Transform: AffineTransform_double_2_2\n", "plane.tfm:3: "},
        {"scale.tfm", HEAD AFFINE "Parameters: 1.1 0 0 0 1 0 0 0 1 0 0 0\nFixedParameters: 0 0 0\n",
         "scale.tfm:4: Parameters: the matrix is not rigid"},
        {"mirror.tfm", HEAD AFFINE "Parameters: -1 0 0 0 1 0 0 0 1 0 0 0\nFixedParameters: 0 0 0\n", "mirror.tfm:4: "},
        {"few.tfm", HEAD AFFINE "Parameters: 1 0 0\nFixedParameters: 0 0 0\n", "few.tfm:4: "},
        {"cut.tfm", HEAD AFFINE "Parameters: 1 0 0 0 1 0 0 0 1 0 0 0\n", "cut.tfm: FixedParameters: missing"},
        {"word.tfm", HEAD AFFINE "Parameters: 1 0 zero\n", "word.tfm:4: "},
        {"nan.tfm", HEAD AFFINE "Parameters: 1 0 nan\n", "nan.tfm:4: "},
        {"two.tfm", HEAD AFFINE "Parameters: 1 0 0 0 1 0 0 0 1 0 0 0\nFixedParameters: 0 0 0\n#Transform 1\n" AFFINE,
         "two.tfm:7: "},
        {"entry.tfm", HEAD AFFINE "Colour: red\n", "entry.tfm:4: "},
        {"versor.tfm",
         HEAD "Transform: VersorRigid3DTransform_double_3_3\nParameters: 1 1 0 0 0 0\nFixedParameters: 0 0 0\n",
         "versor.tfm:4: "},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        err e = {0};
        rigid a;
        write_text(bad[i].path, bad[i].text);
        bool read = transform_read(bad[i].path, &a, &e);
        if (read || e.code != ERR_INPUT || strncmp(e.text, bad[i].says, strlen(bad[i].says)))
            fail_msg("%s: read %d, said \"%s\"", bad[i].path, read, e.text);
    }
    err e = {0};
    rigid a = rigid_identity();
    assert_refused(transform_read("absent.tfm", &a, &e), ERR_INPUT);
    assert_refused(transform_write(&a, "a.h5", &e), ERR_USAGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slicer_node_moves_bone_forwards),
        cmocka_unit_test(a_written_motion_reads_back),
        cmocka_unit_test(all_accepted_kinds_mean_the_same),
        cmocka_unit_test(euler_orders_differ_as_in_itk),
        cmocka_unit_test(wrong_transforms_are_refused_with_file_and_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
