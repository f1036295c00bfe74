/* glTF files that hold more, or something else, than one plain mesh. */
#include "tests/check.h"
#include "geometry/mesh_file.h"
#include "geometry/write_whole.h"
#include <string.h>

/* One triangle (0,0,0) (0.1,0,0) (0,0.2,0.3) m. */
#define REST                                                                                                           \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],"           \
    "\"max\":[0.1,0.2,0.3]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,"      \
    "\"uri\":\"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAzczMPQAAAAAAAAAAAAAAAM3MTD6amZk+\"}]}"
#define ASSET "{\"asset\":{\"version\":\"2.0\"},"
#define PART "{\"attributes\":{\"POSITION\":0}}"
#define MESH "{\"primitives\":[" PART "]}"
#define ONE "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"name\":\"skin\"}],\"meshes\":[" MESH "],"

static void put(const char *text)
{
    err e = {0};
    assert_ok(write_whole("a.gltf", text, strlen(text), &e));
}

/* Triangles of the file, and where the first corner of the first lies; -1: refused, for a reason that says `words`. */
static int triangles(const char *path, double at[3], const char *words)
{
    err e = {0};
    surface s;
    if (mesh_read_surface(path, MESH_SPACE_FROM_FILE, &s, NULL, &e)) {
        int count = s.triangle_count;
        for (int c = 0; at && c < 3; c++) at[c] = s.xyz[3 * (size_t)s.tri[0] + c];
        surface_free(&s);
        return count;
    }
    assert_int_equal(e.code, ERR_INPUT);
    assert_non_null(words);
    if (!strstr(e.text, words)) print_message("%s\n", e.text);
    assert_non_null(strstr(e.text, words));
    return -1;
}

static void a_node_is_chosen_by_name(void **state)
{
    (void)state;
    double at[3];
    put(ASSET "\"scenes\":[{\"nodes\":[0,3]}],\"nodes\":[{\"name\":\"bones\",\"children\":[1,2]},"
              "{\"mesh\":0,\"name\":\"skull\",\"translation\":[0,1,0]},{\"mesh\":1,\"translation\":[0,0,2]},"
              "{\"mesh\":0,\"name\":\"skin\",\"translation\":[3,0,0]}],"
              "\"meshes\":[" MESH ",{\"name\":\"jaw\",\"primitives\":[" PART "]}]," REST);
    assert_int_equal(triangles("a.gltf", NULL, "holds 3 meshes: \"skull\", \"jaw\", \"skin\"; choose one with"), -1);
    assert_int_equal(triangles("a.gltf#skull", at, NULL), 1);
    assert_near(at[2], 1000, 1e-3);
    assert_int_equal(triangles("a.gltf#jaw", at, NULL), 1); /* the mesh's name, where the node has none */
    assert_near(at[1], -2000, 1e-3);
    assert_int_equal(triangles("a.gltf#skin", at, NULL), 1);
    assert_near(at[0], 3000, 1e-3);
    assert_int_equal(triangles("a.gltf#bones", at, NULL), 2); /* a group, whole */
    assert_int_equal(triangles("a.gltf#nose", NULL, "has no node \"nose\" with a mesh; there are \"skull\""), -1);
    assert_int_equal(triangles("a.gltf#", NULL, "has no node \"\""), -1);
}

static void one_mesh_of_several_primitives_is_one_surface(void **state)
{
    (void)state;
    put(ASSET "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
              "\"meshes\":[{\"primitives\":[" PART "," PART "]}]," REST);
    assert_int_equal(triangles("a.gltf", NULL, NULL), 2);
    assert_int_equal(triangles("a.gltf#node 0", NULL, NULL), 2);
    put(ASSET "\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},{\"mesh\":0}],\"meshes\":[" MESH "]," REST);
    assert_int_equal(triangles("a.gltf", NULL, "holds 2 meshes: \"node 0\", \"node 1\""), -1);
    assert_int_equal(triangles("a.gltf#node 1", NULL, NULL), 1);
}

static void extensions_that_change_shapes_are_refused_by_name(void **state)
{
    (void)state;
    static const char *const name[] = {"KHR_draco_mesh_compression", "KHR_mesh_quantization", "EXT_meshopt_compression",
                                       "EXT_mesh_gpu_instancing", "ACME_bent_space"};
    char text[2048];
    for (size_t i = 0; i < sizeof name / sizeof *name; i++) {
        snprintf(text, sizeof text, ASSET "\"extensionsRequired\":[\"KHR_materials_unlit\",\"%s\"]," ONE REST, name[i]);
        put(text);
        assert_int_equal(triangles("a.gltf", NULL, name[i]), -1);
    }
    put(ASSET "\"extensionsRequired\":[\"KHR_materials_unlit\",\"KHR_texture_transform\"]," ONE REST);
    assert_int_equal(triangles("a.gltf", NULL, NULL), 1);
    put(ASSET ONE "\"accessors\":[{\"bufferView\":0,\"componentType\":5123,\"count\":3,\"type\":\"VEC3\"}],"
                  "\"bufferViews\":[{\"buffer\":0,\"byteLength\":18}],\"buffers\":[{\"byteLength\":18}]}");
    assert_int_equal(triangles("a.gltf", NULL, "component type 5123"), -1); /* quantized, without saying so */
}

static void morph_targets_that_are_on_are_refused(void **state)
{
    (void)state;
#define TARGETS "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[{\"POSITION\":0}]}]"
#define MORPH(node, mesh)                                                                                              \
    ASSET "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"name\":\"skin\"" node "}],\"meshes\":[{" TARGETS mesh \
          "}]," REST
    put(MORPH("", ""));
    assert_int_equal(triangles("a.gltf", NULL, NULL), 1);
    put(MORPH("", ",\"weights\":[0]"));
    assert_int_equal(triangles("a.gltf", NULL, NULL), 1);
    put(MORPH("", ",\"weights\":[0.5]"));
    assert_int_equal(triangles("a.gltf", NULL, "morph target 0 of \"skin\" is switched on (weight 0.5)"), -1);
    put(MORPH(",\"weights\":[1]", ",\"weights\":[0]"));
    assert_int_equal(triangles("a.gltf", NULL, "(weight 1)"), -1);
    put(MORPH(",\"weights\":[0]", ",\"weights\":[1]")); /* the node's win */
    assert_int_equal(triangles("a.gltf", NULL, NULL), 1);
}

static void nodes_that_are_no_tree_and_torn_headers_are_refused(void **state)
{
    (void)state;
    err e = {0};
    put(ASSET "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"children\":[1]},{\"children\":[0],\"mesh\":0}],"
              "\"meshes\":[" MESH "]," REST);
    assert_int_equal(triangles("a.gltf", NULL, "no tree"), -1);
    put(ASSET "\"scenes\":[{\"nodes\":[7]}],\"nodes\":[{\"mesh\":0}],\"meshes\":[" MESH "]," REST);
    assert_int_equal(triangles("a.gltf", NULL, "node 7 is not there"), -1);
    put("{\"asset\":{\"version\":\"1.0\"}," ONE REST);
    assert_int_equal(triangles("a.gltf", NULL, "is not glTF of version 2"), -1);
    const uint32_t head[] = {0x46546C67, 2, 28, 0xFFFFFF00, 0x4E4F534A, 0x20207D7B, 0}; /* says 4 GiB of JSON */
    assert_ok(write_whole("torn.glb", head, sizeof head, &e));
    assert_int_equal(triangles("torn.glb", NULL, "its JSON chunk of 4294967040 bytes is not whole"), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_node_is_chosen_by_name),
                                       cmocka_unit_test(one_mesh_of_several_primitives_is_one_surface),
                                       cmocka_unit_test(extensions_that_change_shapes_are_refused_by_name),
                                       cmocka_unit_test(morph_targets_that_are_on_are_refused),
                                       cmocka_unit_test(nodes_that_are_no_tree_and_torn_headers_are_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
