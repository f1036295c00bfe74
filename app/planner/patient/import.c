#include "app/planner/patient/import.h"
#include "app/planner/patient/check_parts.h"
#include "geometry/mem.h"
#include "geometry/repair.h"
#include "geometry/vec.h"
#include "geometry/write_whole.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* A head's skin, from crown to neck, measures 250 to 450 mm corner to corner; a cropped face less. */
static const double head_least_mm = 150, head_most_mm = 600;

import_params import_params_default(void)
{
    return (import_params){.skin_hu = -300, .seal_mm = 8, .mesh = label_surface_params_default()};
}

void import_result_free(import_result *r)
{
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) surface_free(&r->part[i].mesh);
    landmarks_free(&r->points);
    *r = (import_result){0};
}

/* Length of the name of a file: FILE.glb of FILE.glb#NODE. */
static size_t without_node(const char *path)
{
    const char *mark = strrchr(path, '#');
    if (mark && ((mark - path > 4 && !strncasecmp(mark - 4, ".glb", 4)) ||
                 (mark - path > 5 && !strncasecmp(mark - 5, ".gltf", 5))))
        return (size_t)(mark - path);
    return strlen(path);
}

bool import_is_mesh_name(const char *text)
{
    static const char *const endings[] = {".ply", ".off", ".stl", ".obj", ".gltf", ".glb"};
    size_t n = without_node(text);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        size_t k = strlen(endings[i]);
        if (n > k && !strncasecmp(text + n - k, endings[i], k)) return true;
    }
    return false;
}

static bool measure(import_part *part, err *e)
{
    surface *s = &part->mesh;
    double low[3], high[3];
    int32_t *component;
    if (!surface_check(s, e)) return err_prefix(e, "%s", part->source);
    surface_bounds(s, low, high);
    part->diagonal_mm = vec_distance(low, high);
    part->area_mm2 = surface_area(s);
    surface_edge_census(s, &part->open_edges, &part->crowded_edges);
    part->holes = part->open_edges ? surface_hole_count(s) : 0;
    part->volume_mm3 = part->open_edges ? 0 : surface_volume(s);
    part->components = surface_components(s, &component);
    free(component);
    return repair_count_self_intersections(s, IMPORT_INTERSECTIONS_MOST, &part->self_intersections, e) ||
           err_prefix(e, "%s", part->source);
}

static bool is_gltf(const char *path)
{
    size_t n = without_node(path);
    return (n > 5 && !strncasecmp(path + n - 5, ".gltf", 5)) || (n > 4 && !strncasecmp(path + n - 4, ".glb", 4));
}

static bool read_mesh(const import_params *p, const char *path, import_part *part, issue_list *notes, err *e)
{
    surface raw;
    if (!mesh_read_surface(path, p->space, &raw, &part->read, e)) return false;
    if (part->read.joined_vertices)
        issue_add(notes, ISSUE_WARNING, ERR_NONE, path, 0, NULL,
                  "holds loose triangles; %d corners were joined with others within %g of the file's unit",
                  part->read.joined_vertices, part->read.joined_mm);
    mesh_weld(&raw, &part->read);
    if (!raw.triangle_count) {
        surface_free(&raw);
        return err_at(e, ERR_INPUT, path, 0, NULL, "has no triangle left after welding");
    }
    uint8_t *keep = NEW_ARRAY(uint8_t, raw.triangle_count);
    memset(keep, 1, (size_t)raw.triangle_count);
    part->mesh = surface_select(&raw, keep); /* drops unused vertices */
    free(keep);
    surface_free(&raw);
    snprintf(part->source, sizeof part->source, "%s", path);
    double scale = p->unit_mm > 0 ? p->unit_mm / (is_gltf(path) ? 1000 : 1) : 1; /* glTF was read as metres */
    for (int64_t i = 0; i < 3 * (int64_t)part->mesh.vertex_count; i++) part->mesh.xyz[i] *= scale;
    if (part->read.tagged && p->space != MESH_SPACE_FROM_FILE && part->read.ras != (p->space == MESH_SPACE_RAS))
        issue_add(notes, ISSUE_WARNING, ERR_NONE, path, 0, NULL, "the file says SPACE=%s, which wins over --frame",
                  part->read.ras ? "RAS" : "LPS");
    return true;
}

/* A wrong unit is a question to the user, never a guess. */
static bool check_size(const import_params *p, const import_result *r, err *e)
{
    static const struct {
        double mm;
        const char *word, *option;
    } unit[] = {{1000, "metres", "m"}, {10, "centimetres", "cm"}};
    const import_part *skin = &r->part[CASE_SKIN];
    double d = skin->diagonal_mm;
    if (!skin->mesh.vertex_count || (d >= head_least_mm && d <= head_most_mm)) return true;
    for (int i = 0; i < 2 && !(p->unit_mm > 0); i++)
        if (d * unit[i].mm >= head_least_mm && d * unit[i].mm <= head_most_mm)
            return err_at(e, ERR_INPUT, skin->source, 0, NULL,
                          "the skin measures %.3g corner to corner: is it in %s? If so, say --unit %s", d, unit[i].word,
                          unit[i].option);
    return err_at(e, ERR_INPUT, skin->source, 0, NULL,
                  "the skin measures %.4g mm corner to corner; a head measures %g to %g mm%s", d, head_least_mm,
                  head_most_mm,
                  d * 25.4 >= head_least_mm && d * 25.4 <= head_most_mm ? ": is it in inches? Save it in mm" : "");
}

/* Bones far outside the skin's box: of another patient, frame or unit. */
static bool check_together(const import_result *r, err *e)
{
    const double margin_mm = 30;
    double low[3], high[3], a[3], b[3];
    if (!r->part[CASE_SKIN].mesh.vertex_count) return true;
    surface_bounds(&r->part[CASE_SKIN].mesh, low, high);
    for (int i = CASE_SKULL; i < CASE_SURFACE_COUNT; i++) {
        const import_part *part = &r->part[i];
        if (!part->mesh.vertex_count) continue;
        surface_bounds(&part->mesh, a, b);
        for (int c = 0; c < 3; c++)
            if (a[c] < low[c] - margin_mm || b[c] > high[c] + margin_mm)
                return err_at(e, ERR_GEOMETRY, part->source, 0, NULL,
                              "the %s reaches %.0f mm beyond the skin's box along %c: are both of one patient, in one "
                              "frame and unit?",
                              case_surface_name((case_surface)i), fmax(low[c] - a[c], b[c] - high[c]), 'x' + c);
    }
    return true;
}

/* What labels and names say is not believed: a wrong part is told here, not after a prediction. */
static bool check_against_each_other(const import_result *r, issue_list *notes, err *e)
{
    const char *name[CASE_SURFACE_COUNT];
    surface mesh[CASE_SURFACE_COUNT]; /* borrowed */
    nearest *tree[CASE_SURFACE_COUNT];
    issue_list found = {0};
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) {
        name[i] = r->part[i].source;
        mesh[i] = r->part[i].mesh;
    }
    check_trees(mesh, name, tree, &found);
    check_parts(mesh, name, tree, &found);
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) nearest_destroy(&tree[i]);
    for (int i = 0; i < found.count; i++)
        if (found.item[i].level != ISSUE_ERROR)
            issue_add(notes, found.item[i].level, ERR_NONE, found.item[i].file, 0, NULL, "%s", found.item[i].text);
    bool good = issue_none_is_error(&found, e);
    issue_list_free(&found);
    return good;
}

static bool check_complete(const import_result *r, err *e)
{
    for (int i = CASE_SKIN; i <= CASE_MANDIBLE; i++)
        if (!r->part[i].mesh.vertex_count)
            return err_set(e, ERR_USAGE, "a case needs a %s: name it with --%s%s", case_surface_name((case_surface)i),
                           case_surface_name((case_surface)i), i == CASE_SKIN ? ", or a CT with --ct" : "");
    return true;
}

/* All mesh files of a part, put together. */
static bool read_meshes(const import_params *p, const import_words *from, import_part *part, issue_list *notes, err *e)
{
    for (int k = 0; k < from->count; k++) {
        import_part one = {0};
        for (int j = 0; j < k; j++)
            if (!strcmp(from->word[j], from->word[k]))
                return err_at(e, ERR_USAGE, from->word[k], 0, NULL, "is named twice for one part");
        if (!read_mesh(p, from->word[k], &one, notes, e)) return false;
        if (k == 0) {
            *part = one;
            continue;
        }
        surface both = surface_joined(&part->mesh, &one.mesh);
        surface_free(&part->mesh);
        surface_free(&one.mesh);
        part->mesh = both;
        size_t n = strlen(part->source);
        snprintf(part->source + n, sizeof part->source - n, ", %s", from->word[k]);
        part->read.tagged &= one.read.tagged;
        part->read.ras |= one.read.ras;
        part->read.welded_vertices += one.read.welded_vertices;
        part->read.dropped_triangles += one.read.dropped_triangles;
        part->read.split_polygons += one.read.split_polygons;
    }
    return true;
}

/* Whether a part comes from mesh files; false after a refusal of a mixture. */
static bool are_meshes(const import_params *p, case_surface part, bool *meshes, err *e)
{
    const import_words *from = &p->from[part];
    int count = 0;
    for (int k = 0; k < from->count; k++) count += !p->labels.count || import_is_mesh_name(from->word[k]);
    *meshes = count > 0;
    return !count || count == from->count ||
           err_set(e, ERR_USAGE, "--%s names mesh files and labels; a part is made of the one or the other",
                   case_surface_name(part));
}

bool import_read(const import_params *p, const task *watch, import_result *out, issue_list *notes, err *e)
{
    import_result r = {.contacts = -1};
    bool good = true;
    if (p->ct && p->from[CASE_SKIN].count)
        return err_set(e, ERR_USAGE, "--skin and --ct both give the skin; leave one out");
    for (int i = 0; good && i < CASE_SURFACE_COUNT; i++) {
        bool meshes;
        good = are_meshes(p, (case_surface)i, &meshes, e);
        if (!good || !meshes) continue;
        task_progress(watch, case_surface_name((case_surface)i), -1);
        good = read_meshes(p, &p->from[i], &r.part[i], notes, e);
    }
    if (good && (p->labels.count || p->ct)) good = import_labels(p, watch, &r, notes, e);
    if (good) good = check_complete(&r, e);
    for (int i = 0; good && i < CASE_SURFACE_COUNT; i++) {
        if (!r.part[i].mesh.vertex_count) continue;
        task_progress(watch, "measuring", (double)i / CASE_SURFACE_COUNT);
        good = measure(&r.part[i], e);
        if (good && task_interrupted(watch)) good = err_set(e, ERR_INTERRUPTED, "interrupted");
    }
    if (good) good = check_size(p, &r, e) && check_together(&r, e) && check_against_each_other(&r, notes, e);
    if (good) good = import_points(p, watch, &r, notes, e);
    if (!good) {
        import_result_free(&r);
        return false;
    }
    import_note_as_case(p, &r, notes);
    *out = r;
    return true;
}

static bool write_case(const import_params *p, const import_result *r, const char *target, const char *folder, err *e)
{
    char path[4096];
    json_t *surfaces = json_object();
    bool good = true;
    for (int i = 0; good && i < CASE_SURFACE_COUNT; i++) {
        if (!r->part[i].mesh.vertex_count) continue;
        const char *word = case_surface_name((case_surface)i);
        char file[64];
        snprintf(file, sizeof file, "%s.ply", word);
        snprintf(path, sizeof path, "%s/%s", folder, file);
        json_object_set_new(surfaces, word, json_string(file));
        good = mesh_write_surface(&r->part[i].mesh, path, e);
    }
    snprintf(path, sizeof path, "%s/landmarks.mrk.json", folder);
    if (good && r->has_points) good = landmarks_write_sure(&r->points, LANDMARK_DOUBT_MOST_MM, path, e);
    const char *slash = strrchr(target, '/'), *name = p->name ? p->name : slash ? slash + 1 : target;
    json_t *root = json_pack("{s:i, s:s, s:s, s:s, s:o, s:s}", "gnathos", 1, "name", name, "units", "mm", "frame",
                             "LPS", "surfaces", surfaces, "landmarks", "landmarks.mrk.json");
    if (!root) {
        json_decref(surfaces);
        return err_set(e, ERR_USAGE, "the name of the case is not valid UTF-8");
    }
    snprintf(path, sizeof path, "%s/case.json", folder);
    if (good) good = json_file_write(root, path, e);
    json_decref(root);
    return good;
}

bool import_write(const import_params *p, const import_result *r, const char *folder, err *e)
{
    whole_folder w;
    if (!whole_folder_open(folder, &w, e)) return false;
    if (write_case(p, r, w.path, w.temporary, e)) return whole_folder_close(&w, e);
    whole_folder_abandon(&w);
    return false;
}
