/* Written here and not by assimp, whose C interface cannot name morph targets. Khronos glTF 2.0 specification:
 * section 4.4 (binary form), 3.7.2 (meshes and morph targets). */
#include "geometry/glb_file.h"
#include "geometry/json_file.h"
#include "geometry/mem.h"
#include "geometry/src/files/file_name.h"
#include "geometry/vec.h"
#include "geometry/write_whole.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FLOAT = 5126, UINT32 = 5125, VERTEX_BUFFER = 34962, INDEX_BUFFER = 34963 };

typedef struct builder {
    json_t *accessors, *views;
    uint8_t *bytes;
    size_t size;
} builder;

static void *add_block(builder *b, size_t size, int target)
{
    b->bytes = GROW_ARRAY(uint8_t, b->bytes, b->size + size);
    json_array_append_new(b->views, json_pack("{si sI sI si}", "buffer", 0, "byteOffset", (json_int_t)b->size,
                                              "byteLength", (json_int_t)size, "target", target));
    b->size += size; /* all blocks are whole numbers of 4 bytes, so that each starts at one */
    return b->bytes + b->size - size;
}

/* Vectors of three floats from doubles; returns the number of their accessor. */
static int add_vectors(builder *b, const double *x, int32_t count, bool with_bounds)
{
    float *to = add_block(b, 12 * (size_t)count, VERTEX_BUFFER), low[3], high[3];
    for (size_t i = 0; i < 3 * (size_t)count; i++) {
        int c = (int)(i % 3);
        to[i] = (float)x[i];
        low[c] = i < 3 ? to[i] : fminf(low[c], to[i]);
        high[c] = i < 3 ? to[i] : fmaxf(high[c], to[i]);
    }
    json_t *a = json_pack("{si si si ss}", "bufferView", (int)json_array_size(b->views) - 1, "componentType", FLOAT,
                          "count", (int)count, "type", "VEC3");
    if (with_bounds) {
        json_object_set_new(a, "min", json_pack("[fff]", (double)low[0], (double)low[1], (double)low[2]));
        json_object_set_new(a, "max", json_pack("[fff]", (double)high[0], (double)high[1], (double)high[2]));
    }
    json_array_append_new(b->accessors, a);
    return (int)json_array_size(b->accessors) - 1;
}

static int add_triangles(builder *b, const surface *s)
{
    size_t count = 3 * (size_t)s->triangle_count;
    memcpy(add_block(b, 4 * count, INDEX_BUFFER), s->tri, 4 * count);
    json_array_append_new(b->accessors,
                          json_pack("{si si sI ss}", "bufferView", (int)json_array_size(b->views) - 1, "componentType",
                                    UINT32, "count", (json_int_t)count, "type", "SCALAR"));
    return (int)json_array_size(b->accessors) - 1;
}

/* Unit normals; a vertex that no triangle uses gets one too, as glTF wants. */
static double *unit_normals(const surface *s)
{
    double *n = surface_vertex_normals(s);
    for (int32_t v = 0; v < s->vertex_count; v++)
        if (vec_norm(n + 3 * (size_t)v) < 0.5) n[3 * (size_t)v + 2] = 1;
    return n;
}

static double linear(double srgb) /* IEC 61966-2-1 */
{
    return srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4);
}

static int add_colours(builder *b, const surface *s)
{
    double *rgb = NEW_ARRAY(double, 3 * (size_t)s->vertex_count);
    for (size_t i = 0; i < 3 * (size_t)s->vertex_count; i++) rgb[i] = linear(s->rgb[i] / 255.0);
    int accessor = add_vectors(b, rgb, s->vertex_count, false);
    free(rgb);
    return accessor;
}

/* The displacements of positions and normals. */
static json_t *add_target(builder *b, const glb_shape *s, const double *normals)
{
    size_t n = 3 * (size_t)s->rest->vertex_count;
    double *d = NEW_ARRAY(double, n);
    surface planned = *s->rest;
    planned.xyz = COPY_ARRAY(double, s->planned, n);
    double *turned = unit_normals(&planned);
    for (size_t i = 0; i < n; i++) {
        d[i] = s->planned[i] - s->rest->xyz[i];
        turned[i] -= normals[i];
    }
    json_t *target = json_pack("{si si}", "POSITION", add_vectors(b, d, s->rest->vertex_count, true), "NORMAL",
                               add_vectors(b, turned, s->rest->vertex_count, false));
    free(d);
    free(turned);
    free(planned.xyz);
    return target;
}

static json_t *add_mesh(builder *b, const glb_shape *s, int material)
{
    double *normals = unit_normals(s->rest);
    json_t *attribute = json_pack("{si si}", "POSITION", add_vectors(b, s->rest->xyz, s->rest->vertex_count, true),
                                  "NORMAL", add_vectors(b, normals, s->rest->vertex_count, false));
    if (s->rest->rgb) json_object_set_new(attribute, "COLOR_0", json_integer(add_colours(b, s->rest)));
    json_t *part =
        json_pack("{so si si}", "attributes", attribute, "indices", add_triangles(b, s->rest), "material", material);
    json_t *mesh = json_pack("{ss}", "name", s->name);
    if (s->planned) {
        json_object_set_new(part, "targets", json_pack("[o]", add_target(b, s, normals)));
        json_object_set_new(mesh, "weights", json_pack("[f]", 0.0));
        json_object_set_new(mesh, "extras", json_pack("{s[s]}", "targetNames", "planned"));
    }
    json_object_set_new(mesh, "primitives", json_pack("[o]", part));
    free(normals);
    return mesh;
}

static json_t *material_of(const glb_shape *s)
{
    double rgb[3];
    for (int c = 0; c < 3; c++) rgb[c] = s->rest->rgb ? 1 : linear(s->rgb[c]);
    return json_pack("{ss sb s{s[ffff] sf sf}}", "name", s->name, "doubleSided", true, "pbrMetallicRoughness",
                     "baseColorFactor", rgb[0], rgb[1], rgb[2], 1.0, "metallicFactor", 0.0, "roughnessFactor", 0.7);
}

static json_t *describe(builder *b, const glb_shape *shapes, int count)
{
    json_t *meshes = json_array(), *materials = json_array(), *children = json_array();
    json_t *nodes = json_pack("[{ss s[ffffffffffffffff]}]", "name", "from LPS mm", "matrix", 1e-3, 0.0, 0.0, 0.0, 0.0,
                              0.0, -1e-3, 0.0, 0.0, 1e-3, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0); /* by columns */
    for (int i = 0; i < count; i++) {
        json_array_append_new(meshes, add_mesh(b, &shapes[i], i));
        json_array_append_new(materials, material_of(&shapes[i]));
        json_array_append_new(nodes, json_pack("{ss si}", "name", shapes[i].name, "mesh", i));
        json_array_append_new(children, json_integer(i + 1));
    }
    json_object_set_new(json_array_get(nodes, 0), "children", children);
    return json_pack("{s{ss ss s{ss ss ss}} si s[{s[i]}] so so so sO sO s[{sI}]}", "asset", "version", "2.0",
                     "generator", "gnathos " GNATHOS_VERSION, "extras", "SPACE", "LPS", "units", "mm", "note",
                     "vertices are LPS mm; the root node takes them to metres, +y up: (x, y, z) -> 0.001 (x, z, -y)",
                     "scene", 0, "scenes", "nodes", 0, "nodes", nodes, "meshes", meshes, "materials", materials,
                     "accessors", b->accessors, "bufferViews", b->views, "buffers", "byteLength", (json_int_t)b->size);
}

static bool write_chunks(const char *text, const builder *b, const char *path, err *e)
{
    size_t json_size = (strlen(text) + 3) / 4 * 4, whole = 12 + 8 + json_size + 8 + b->size;
    if (whole > UINT32_MAX)
        return err_at(e, ERR_RESOURCE, path, 0, NULL, "would have %zu bytes; a .glb file holds less than 4 GiB", whole);
    whole_file w;
    if (!whole_file_open(path, &w, e)) return false;
    const uint32_t head[] = {0x46546C67 /* glTF */, 2, (uint32_t)whole, (uint32_t)json_size, 0x4E4F534A /* JSON */},
                   binary[] = {(uint32_t)b->size, 0x004E4942 /* BIN */};
    (void)!fwrite(head, sizeof head, 1, w.stream);
    fprintf(w.stream, "%-*s", (int)json_size, text);
    (void)!fwrite(binary, sizeof binary, 1, w.stream);
    (void)!fwrite(b->bytes, 1, b->size, w.stream);
    return whole_file_close(&w, e);
}

bool glb_write(const glb_shape *shapes, int count, const char *path, err *e)
{
    if (!file_name_ends(path, ".glb"))
        return err_at(e, ERR_USAGE, path, 0, NULL, "unknown kind of file for shapes that move; written is .glb");
    builder b = {.accessors = json_array(), .views = json_array()};
    json_t *root = describe(&b, shapes, count);
    char *text = json_dumps(root, JSON_COMPACT | JSON_REAL_PRECISION(9)); /* enough for floats */
    bool ok = write_chunks(text, &b, path, e);
    free(text);
    json_decref(root);
    json_decref(b.accessors);
    json_decref(b.views);
    free(b.bytes);
    return ok;
}
