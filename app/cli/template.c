/* gnathos template: the head in whose numbering all heads are described, found or made once. */
#include "app/cli/template_record.h"
#include "app/cli/verb.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>

static const struct argp_option options[] = {
    OPTION_OUTPUT("Write it for other programs into DIR, which must not exist yet"), OPTION_FORCE, {0}};

static bool write_tissue(const head_template *t, const char *path, err *e)
{
    const tissue *flesh = &t->tissue;
    size_t nodes = (size_t)flesh->mesh.vertex_count;
    double *kind = NEW_ARRAY(double, nodes), *segment = NEW_ARRAY(double, nodes), *side = NEW_ARRAY(double, nodes),
           *facing = NEW_ARRAY(double, nodes), *rest = NEW_ARRAY(double, 3 * nodes);
    for (size_t v = 0; v < nodes; v++) {
        kind[v] = flesh->attach.kind[v];
        segment[v] = flesh->attach.segment[v];
        side[v] = flesh->side[v];
        facing[v] = -1;
        for (size_t c = 3 * v; c < 3 * v + 3; c++) rest[c] = t->rest[c] - flesh->mesh.xyz[c];
    }
    for (size_t i = 0; i < 2 * (size_t)flesh->attach.pair_count; i++)
        facing[flesh->attach.pair[i]] = flesh->attach.pair[i ^ 1];
    const point_array arrays[] = {{"attachment", 1, kind},
                                  {"segment", 1, segment},
                                  {"side", 1, side},
                                  {"facing", 1, facing},
                                  {"to_rest", 3, rest}};
    bool ok = mesh_write_tets(&flesh->mesh, arrays, 5, path, e);
    free(kind);
    free(segment);
    free(side);
    free(facing);
    free(rest);
    return ok;
}

static bool write_all(const head_template *t, json_t *record, output_dir *d, err *e)
{
    bool ok = true;
    char file[64], *path;
    for (int s = 0; ok && s < CASE_SURFACE_COUNT; s++) {
        snprintf(file, sizeof file, "%s.ply", case_surface_name((case_surface)s));
        path = output_dir_file(d, file);
        ok = mesh_write_surface(&t->part[s], path, e);
        free(path);
    }
    path = output_dir_file(d, "tissue.vtu");
    ok = ok && write_tissue(t, path, e);
    free(path);
    head_shape own = head_shape_of(t);
    landmarks points = head_points(t, &own);
    path = output_dir_file(d, "landmarks.mrk.json");
    ok = ok && landmarks_write(&points, path, e);
    free(path);
    landmarks_free(&points);
    head_shape_free(&own);
    path = output_dir_file(d, "template.json");
    ok = ok && json_file_write(record, path, e);
    free(path);
    return ok && output_dir_close(d, e);
}

static void print_plain(const head_template *t, const template_source *s)
{
    static const char *const how[] = {"named by GNATHOS_TEMPLATE", "installed", "kept by gnathos"};
    const attach_map *a = &t->tissue.attach;
    int32_t tied = 0, sliding = 0;
    for (int32_t v = 0; v < a->node_count; v++) {
        tied += a->kind[v] == NODE_TIED;
        sliding += a->kind[v] == NODE_SLIDING;
    }
    printf("%s: %s, version %d, numbering %.16s\n", command_shown(s->path), how[s->place], t->version, t->numbering);
    printf("%-14s %9s %9s\n", "part", "vertices", "triangles");
    for (int p = 0; p < CASE_SURFACE_COUNT; p++)
        printf("%-14s %9d %9d\n", case_surface_name((case_surface)p), t->part[p].vertex_count,
               t->part[p].triangle_count);
    printf("tissue: %d nodes, %d tets; %d nodes tied, %d sliding, %d lip pairs\n", t->tissue.mesh.vertex_count,
           t->tissue.mesh.tet_count, tied, sliding, a->pair_count);
    printf("landmarks: %d\n", t->point_count);
    printf("opened in %.3f s", s->open_s);
    if (s->made) printf(", made in %.1f s", s->made_s);
    printf("\n");
}

static bool run(run_context *r, err *e)
{
    head_template t = {0};
    template_source s;
    if (!head_template_get(&r->watch, &t, &s, e)) return false;
    const template_record of = {&t, &s};
    json_t *record = record_json(&template_record_table, &of);
    bool ok = !r->out_path || write_all(&t, record, &r->dir, e);
    if (ok && r->common.json)
        command_print_record(json_incref(record));
    else if (ok)
        print_plain(&t, &s);
    json_decref(record);
    head_template_free(&t);
    return ok;
}

const verb verb_template = {.arguments = "",
                            .about = "The head in whose numbering gnathos describes every head: skin, skull, mandible, "
                                     "teeth, soft tissue and landmarks of the mean of all norms. Finds it where "
                                     "GNATHOS_TEMPLATE says, with the program or in the user's cache; makes it once "
                                     "where it is not there.",
                            .options = options,
                            .need = NEED_OUTPUT,
                            .run = run};
