/* Shapes as glTF: their places come back in LPS mm, and the planned place is a morph target of that name. */
#include "tests/check.h"
#include "geometry/glb_file.h"
#include "geometry/json_file.h"
#include "geometry/mem.h"
#include "geometry/mesh_file.h"
#include <string.h>

static surface tetrahedron(void)
{
    static const double xyz[] = {10.25, -180.5, 300.125, 40, -180, 300, 10, -150, 300, 10, -180, 330};
    static const int32_t tri[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    surface s = surface_new(5, 4); /* the last vertex is in no triangle */
    memcpy(s.xyz, xyz, sizeof xyz);
    memcpy(s.tri, tri, sizeof tri);
    return s;
}

static void a_shape_comes_back_in_lps_mm(void **state)
{
    (void)state;
    err e = {0};
    surface s = tetrahedron(), back = {0};
    double planned[15] = {0};
    for (int i = 0; i < 12; i++) planned[i] = s.xyz[i] + (i % 3 == 1 ? -5 : 0);
    glb_shape shapes[] = {{"skin", &s, planned, {0.8, 0.6, 0.5}}, {"bone", &s, NULL, {1, 1, 1}}};
    assert_ok(glb_write(shapes, 1, "one.glb", &e));
    assert_ok(mesh_read_surface("one.glb", MESH_SPACE_FROM_FILE, &back, NULL, &e));
    assert_int_equal(back.triangle_count, 4);
    double low[2][3], high[2][3];
    s.vertex_count = 4;
    surface_bounds(&s, low[0], high[0]);
    s.vertex_count = 5;
    back.vertex_count = 4;
    surface_bounds(&back, low[1], high[1]);
    for (int c = 0; c < 3; c++) {
        assert_near(low[1][c], low[0][c], 1e-4);
        assert_near(high[1][c], high[0][c], 1e-4);
    }
    assert_true(surface_volume(&back) > 0); /* not turned inside out */
    surface_free(&back);
    assert_refused(glb_write(shapes, 2, "two.gltf", &e), ERR_USAGE);
    surface_free(&s);
}

/* The JSON of a .glb file. */
static json_file description(const char *path)
{
    err e = {0};
    json_file f = {0};
    FILE *in = fopen(path, "rb");
    uint32_t head[5];
    assert_non_null(in);
    assert_int_equal(fread(head, sizeof head, 1, in), 1);
    assert_int_equal(head[0], 0x46546C67);
    char *text = NEW_ARRAY(char, head[3] + 1);
    assert_int_equal(fread(text, head[3], 1, in), 1);
    fclose(in);
    assert_ok(json_file_parse(text, head[3], path, &f, &e));
    free(text);
    return f;
}

static void the_morph_target_is_called_planned_and_displaces(void **state)
{
    (void)state;
    err e = {0};
    surface s = tetrahedron();
    s.rgb = NEW_ARRAY(uint8_t, 15);
    double planned[15];
    for (int i = 0; i < 15; i++) planned[i] = s.xyz[i] + (i % 3 == 1 ? -5 : 0);
    glb_shape shapes[] = {{"skin", &s, planned, {0.8, 0.6, 0.5}}, {"bone", &s, NULL, {1, 1, 1}}};
    assert_ok(glb_write(shapes, 2, "planned.glb", &e));
    json_file f = description("planned.glb");
    const json_t *mesh = json_array_get(json_object_get(f.root, "meshes"), 0), *name, *low;
    name = json_array_get(json_object_get(json_object_get(mesh, "extras"), "targetNames"), 0);
    assert_string_equal(json_string_value(name), "planned");
    const json_t *part = json_array_get(json_object_get(mesh, "primitives"), 0),
                 *target = json_array_get(json_object_get(part, "targets"), 0);
    json_int_t at = json_integer_value(json_object_get(target, "POSITION"));
    low = json_object_get(json_array_get(json_object_get(f.root, "accessors"), (size_t)at), "min");
    assert_near(json_number_value(json_array_get(low, 0)), 0, 0);
    assert_near(json_number_value(json_array_get(low, 1)), -5, 0);
    assert_null(json_object_get(json_array_get(json_object_get(f.root, "meshes"), 1), "weights"));
    const json_t *extras = json_object_get(json_object_get(f.root, "asset"), "extras");
    assert_string_equal(json_string_value(json_object_get(extras, "SPACE")), "LPS");
    json_file_free(&f);
    surface_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shape_comes_back_in_lps_mm),
        cmocka_unit_test(the_morph_target_is_called_planned_and_displaces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
