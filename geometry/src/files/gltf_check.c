#include "geometry/src/files/gltf_check.h"
#include "geometry/src/files/gltf_sizes.h"
#include "geometry/input_file.h"
#include "geometry/json_file.h"
#include "geometry/mem.h"
#include "geometry/src/files/file_name.h"
#include <stdlib.h>

enum { DEPTH_MOST = 256, FLOAT = 5126 };

typedef struct walk {
    const char *path, *node;
    const json_t *nodes, *meshes, *accessors;
    uint8_t *keep;
    int count, kept;
    char names[512]; /* of the nodes with a mesh, for messages */
} walk;

const char *gltf_split(const char *path, char *file, size_t size)
{
    const char *mark = strrchr(path, '#');
    snprintf(file, size, "%.*s", mark ? (int)(mark - path) : (int)strlen(path), path);
    if (mark && (file_name_ends(file, ".glb") || file_name_ends(file, ".gltf"))) return mark + 1;
    snprintf(file, size, "%s", path);
    return NULL;
}

/* The JSON chunk of the binary form. */
static bool read_chunk(const char *path, json_file *out, err *e)
{
    uint32_t head[5];
    int64_t size;
    FILE *in = input_file_open(path, INT64_MAX, &size, e);
    if (!in) return false;
    bool good = fread(head, sizeof head, 1, in) == 1 && head[0] == 0x46546C67 /* glTF */;
    if (!good)
        (void)err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read as a mesh: does not begin as a .glb file does");
    else if (head[1] != 2)
        good = err_at(e, ERR_INPUT, path, 0, NULL, "is glTF of version %u; read is version 2", head[1]);
    else if (head[4] != 0x4E4F534A /* JSON */ || head[3] > size - (int64_t)sizeof head || head[3] > INPUT_TEXT_BYTES)
        good = err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read as a mesh: its JSON chunk of %u bytes is not whole",
                      head[3]);
    if (good) {
        char *text = NEW_ARRAY(char, head[3] + 1);
        good = fread(text, 1, head[3], in) == head[3] || err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read whole");
        good = good && json_file_parse(text, head[3], path, out, e);
        free(text);
    }
    fclose(in);
    return good;
}

/* Extensions that say how a surface looks, not where it is. */
static bool is_harmless(const char *name)
{
    static const char *const start[] = {"KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "KHR_xmp"};
    for (size_t i = 0; i < sizeof start / sizeof *start; i++)
        if (!strncmp(name, start[i], strlen(start[i]))) return true;
    return false;
}

static bool check_extensions(const char *path, const json_t *root, err *e)
{
    const json_t *required = json_object_get(root, "extensionsRequired");
    for (size_t i = 0; i < json_array_size(required); i++) {
        const char *name = json_string_value(json_array_get(required, i));
        if (name && !is_harmless(name))
            return err_at(e, ERR_INPUT, path, 0, NULL,
                          "needs the extension %.64s, which is not read: save it without (no compression, no "
                          "quantization)",
                          name);
    }
    return true;
}

/* Rest shapes are read: a morph target that is switched on would show another. */
static bool check_weights(const walk *w, const json_t *of, const char *name, err *e)
{
    const json_t *weights = json_object_get(of, "weights");
    for (size_t i = 0; i < json_array_size(weights); i++) {
        double weight = json_number_value(json_array_get(weights, i));
        if (weight != 0)
            return err_at(e, ERR_INPUT, w->path, 0, NULL,
                          "morph target %zu of \"%.64s\" is switched on (weight %g), so that the file shows another "
                          "shape than its vertices: set the weights to 0, or save the shape that is meant",
                          i, name, weight);
    }
    return true;
}

static bool check_mesh(const walk *w, const json_t *node, const json_t *mesh, const char *name, err *e)
{
    const json_t *parts = json_object_get(mesh, "primitives"), *own = json_object_get(node, "weights");
    for (size_t i = 0; i < json_array_size(parts); i++) {
        const json_t *at = json_object_get(json_object_get(json_array_get(parts, i), "attributes"), "POSITION");
        const json_t *points = json_array_get(w->accessors, (size_t)json_integer_value(at));
        json_int_t type = json_integer_value(json_object_get(points, "componentType"));
        if (at && type != FLOAT)
            return err_at(e, ERR_INPUT, w->path, 0, NULL,
                          "positions of \"%.64s\" are of component type %lld; read are floats (%d)", name,
                          (long long)type, FLOAT);
    }
    return check_weights(w, own ? node : mesh, name, e); /* a node's weights win over those of its mesh */
}

static bool add_node(walk *w, json_int_t number, bool inside, int depth, err *e)
{
    const json_t *node = number >= 0 ? json_array_get(w->nodes, (size_t)number) : NULL;
    if (!node || depth > DEPTH_MOST)
        return err_at(e, ERR_INPUT, w->path, 0, NULL, "node %lld %s", (long long)number,
                      node ? "lies too deep: the nodes are no tree" : "is named but is not there");
    const json_t *mesh_number = json_object_get(node, "mesh"), *children = json_object_get(node, "children");
    const json_t *mesh = mesh_number ? json_array_get(w->meshes, (size_t)json_integer_value(mesh_number)) : NULL;
    const char *said = json_string_value(json_object_get(node, "name"));
    char name[128];
    if (!said && mesh) said = json_string_value(json_object_get(mesh, "name"));
    if (said && *said)
        snprintf(name, sizeof name, "%s", said);
    else
        snprintf(name, sizeof name, "node %lld", (long long)number);
    inside = inside || !w->node || !strcmp(name, w->node);
    if (mesh_number) {
        size_t n = strlen(w->names);
        if (w->count == INT32_MAX - 1) return err_at(e, ERR_INPUT, w->path, 0, NULL, "too many nodes");
        if (n + 140 < sizeof w->names) snprintf(w->names + n, sizeof w->names - n, "%s\"%s\"", n ? ", " : "", name);
        w->keep = GROW_ARRAY(uint8_t, w->keep, (size_t)w->count + 1);
        w->keep[w->count++] = inside;
        w->kept += inside;
        if (inside && !check_mesh(w, node, mesh, name, e)) return false;
    }
    for (size_t i = 0; i < json_array_size(children); i++)
        if (!add_node(w, json_integer_value(json_array_get(children, i)), inside, depth + 1, e)) return false;
    return true;
}

/* A tree has each node once: a file of shared or circling nodes would be walked for ever. */
static bool check_tree(const walk *w, const json_t *roots, err *e)
{
    size_t count = json_array_size(w->nodes);
    uint8_t *named = NEW_ARRAY(uint8_t, count + 1);
    bool good = true;
    for (size_t i = 0; good && i <= count; i++) {
        const json_t *list = i < count ? json_object_get(json_array_get(w->nodes, i), "children") : roots;
        for (size_t k = 0; good && k < json_array_size(list); k++) {
            json_int_t child = json_integer_value(json_array_get(list, k));
            if (child < 0 || child >= (json_int_t)count || named[child]++)
                good = err_at(e, ERR_INPUT, w->path, 0, NULL,
                              "the nodes are no tree: node %lld is not there or has two "
                              "parents",
                              (long long)child);
        }
    }
    free(named);
    return good;
}

static bool check_scene(walk *w, const json_t *root, err *e)
{
    const json_t *version = json_object_get(json_object_get(root, "asset"), "version");
    const json_t *scenes = json_object_get(root, "scenes");
    const json_t *scene = json_array_get(scenes, (size_t)json_integer_value(json_object_get(root, "scene")));
    const json_t *roots = json_object_get(scene, "nodes");
    if (!json_is_string(version) || *json_string_value(version) != '2')
        return err_at(e, ERR_INPUT, w->path, 0, NULL, "is not glTF of version 2");
    if (!check_extensions(w->path, root, e) || !check_tree(w, roots, e)) return false;
    for (size_t i = 0; i < json_array_size(roots); i++)
        if (!add_node(w, json_integer_value(json_array_get(roots, i)), false, 0, e)) return false;
    if (!w->node && w->count > 1)
        return err_at(e, ERR_INPUT, w->path, 0, NULL, "holds %d meshes: %s; choose one with FILE#NODE", w->count,
                      w->names);
    if (w->node && !w->kept)
        return err_at(e, ERR_INPUT, w->path, 0, NULL, "has no node \"%.64s\" with a mesh; there %s %s", w->node,
                      w->count == 1 ? "is" : "are", w->count ? w->names : "none");
    return true;
}

bool gltf_check(const char *path, const char *node, uint8_t **keep, int *count, err *e)
{
    json_file f = {0};
    if (!(file_name_ends(path, ".glb") ? read_chunk(path, &f, e) : json_file_read(path, &f, e))) return false;
    walk w = {.path = path,
              .node = node,
              .nodes = json_object_get(f.root, "nodes"),
              .meshes = json_object_get(f.root, "meshes"),
              .accessors = json_object_get(f.root, "accessors"),
              .keep = NEW_ARRAY(uint8_t, 1)};
    int64_t size = 0;
    FILE *in = input_file_open(path, INT64_MAX, &size, e);
    bool good = in && check_scene(&w, f.root, e) && gltf_sizes_check(path, f.root, size, e);
    if (in) fclose(in);
    json_file_free(&f);
    if (!good) {
        free(w.keep);
        return false;
    }
    *keep = w.keep;
    *count = w.count;
    return true;
}
