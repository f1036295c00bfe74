/* gnathos export OUT --format F -o DIR: the shapes of an outcome, before and as planned, for other programs. */
#include "app/cli/made_record.h"
#include "app/cli/verb.h"
#include "app/planner/predict/outcome_read.h"
#include "geometry/glb_file.h"
#include "geometry/mem.h"
#include "geometry/mesh_file.h"
#include "geometry/write_whole.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct export_options {
    const char *format;
} export_options;

static const char *const formats[] = {"glb", "obj", "ply", "stl", "vtp"};
enum { FORMAT_COUNT = sizeof formats / sizeof *formats };

static const struct argp_option options[] = {
    {"format", 'f', "FORMAT", 0,
     "glb (one file, moves as the morph target \"planned\"), obj, ply, stl, or vtp "
     "(with the array displacement)",
     0},
    {"output", 'o', "DIR", 0, "Folder for the files, which must not exist yet", 0},
    {0}};

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    export_options *o = r->own;
    switch (key) {
    case 'f':
        for (int i = 0; i < FORMAT_COUNT; i++)
            if (!strcmp(arg, formats[i])) o->format = formats[i];
        if (!o->format) command_usage(state, "--format %s: must be glb, obj, ply, stl or vtp", arg);
        return 0;
    case ARGP_KEY_END:
        if (!o->format) command_usage(state, "name a format with --format");
        if (!r->out_path) command_usage(state, "name the folder of results with -o");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

typedef struct shape { /* one of the surfaces of an outcome */
    char name[40];
    const surface *rest;
    double *planned; /* [3*vertex_count], or NULL: it stays */
    double rgb[3];
} shape;

enum { SHAPES_MAX = 1 + SEGMENT_COUNT };

static int make_shapes(const outcome_shapes *o, shape out[SHAPES_MAX])
{
    static const double skin[3] = {0.80, 0.64, 0.55};
    int count = 0;
    out[count++] = (shape){.name = "skin",
                           .rest = &o->skin_before,
                           .planned = COPY_ARRAY(double, o->skin_after.xyz, 3 * (size_t)o->skin_after.vertex_count),
                           .rgb = {skin[0], skin[1], skin[2]}};
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        const surface *bone = &o->at_rest.part[s];
        if (!bone->triangle_count) continue;
        shape *to = &out[count++];
        *to = (shape){.rest = bone};
        snprintf(to->name, sizeof to->name, "segment_%s", segment_name((segment_id)s));
        segment_color((segment_id)s, to->rgb);
        if (rigid_is_identity(&o->move[s])) continue;
        surface moved = surface_copy(bone);
        surface_transform(&moved, &o->move[s]);
        to->planned = moved.xyz;
        moved.xyz = NULL;
        surface_free(&moved);
    }
    return count;
}

typedef struct place {           /* where the files go */
    const char *folder, *target; /* until all are there, and then */
    json_t *files;               /* their paths then */
} place;

enum { PATH_SIZE = 4096 };

static void take_name(const place *to, const char *name, char path[PATH_SIZE])
{
    snprintf(path, PATH_SIZE, "%s/%s", to->target, name);
    json_array_append_new(to->files, json_string(path));
    snprintf(path, PATH_SIZE, "%s/%s", to->folder, name);
}

static bool write_glb(const shape *shapes, int count, const place *to, err *e)
{
    glb_shape all[SHAPES_MAX];
    for (int i = 0; i < count; i++) {
        const shape *s = &shapes[i];
        all[i] = (glb_shape){s->name, s->rest, s->planned, {s->rgb[0], s->rgb[1], s->rgb[2]}};
    }
    char path[PATH_SIZE];
    take_name(to, "head.glb", path);
    return glb_write(all, count, path, e);
}

/* NAME.vtp at rest, with where each of its points goes. */
static bool write_arrays(const shape *s, const place *to, err *e)
{
    size_t n = 3 * (size_t)s->rest->vertex_count;
    double *u = NEW_ARRAY(double, n);
    for (size_t i = 0; s->planned && i < n; i++) u[i] = s->planned[i] - s->rest->xyz[i];
    point_array array = {"displacement", 3, u};
    char path[PATH_SIZE], name[64];
    snprintf(name, sizeof name, "%.39s.vtp", s->name);
    take_name(to, name, path);
    bool ok = mesh_write_surface_arrays(s->rest, &array, 1, path, e);
    free(u);
    return ok;
}

/* NAME_before and NAME_after; what stays is written once, as NAME. */
static bool write_meshes(const shape *s, const char *format, const place *to, err *e)
{
    char path[PATH_SIZE], name[64];
    snprintf(name, sizeof name, "%.39s%s.%s", s->name, s->planned ? "_before" : "", format);
    take_name(to, name, path);
    if (!mesh_write_surface_float(s->rest, path, e)) return false;
    if (!s->planned) return true;
    surface after = *s->rest;
    after.xyz = s->planned;
    snprintf(name, sizeof name, "%.39s_after.%s", s->name, format);
    take_name(to, name, path);
    return mesh_write_surface_float(&after, path, e);
}

static bool write_all(const outcome_shapes *o, const char *format, const place *to, err *e)
{
    shape shapes[SHAPES_MAX];
    int count = make_shapes(o, shapes);
    bool ok = true, glb = !strcmp(format, "glb"), arrays = !strcmp(format, "vtp");
    if (glb) ok = write_glb(shapes, count, to, e);
    for (int i = 0; ok && !glb && i < count; i++)
        ok = arrays ? write_arrays(&shapes[i], to, e) : write_meshes(&shapes[i], format, to, e);
    for (int i = 0; i < count; i++) free(shapes[i].planned);
    return ok;
}

static bool run(run_context *r, err *e)
{
    const export_options *o = r->own;
    outcome_shapes shapes = {0};
    whole_folder folder = {0};
    bool ok = outcome_shapes_read(r->argument[0], &shapes, e) && whole_folder_open(r->out_path, &folder, e);
    json_t *files = json_array();
    const place to = {folder.temporary, r->out_path, files};
    ok = ok && write_all(&shapes, o->format, &to, e) && whole_folder_close(&folder, e);
    whole_folder_abandon(&folder);
    outcome_shapes_free(&shapes);
    const made_record made = {.verb = "export", .files = files};
    if (ok && r->common.json)
        command_print_record(record_json(&made_record_table, &made));
    else if (ok && !r->common.quiet)
        printf("Results in %s\n", command_shown(r->out_path));
    json_decref(files);
    return ok;
}

const verb verb_export = {.arguments = "OUT",
                          .about =
                              "Write the skin and the segments of an outcome, before and as planned, for other "
                              "programs. Axes are LPS, lengths mm, and the files say so (SPACE=LPS); in .glb the root "
                              "node takes them to the metres and axes of glTF.",
                          .options = options,
                          .argument_count = 1,
                          .missing_argument = "name the folder of an outcome",
                          .own_size = sizeof(export_options),
                          .parse = parse,
                          .run = run};
