#include "app/cli/template_record.h"
#include "app/planner/identity/lip_overlap.h"

static const head_template *head_of(const void *of) { return ((const template_record *)of)->head; }
static const template_source *source_of(const void *of) { return ((const template_record *)of)->source; }

static const char *path(const void *of, char *space) { return (void)space, source_of(of)->path; }
static const char *place(const void *of, char *space)
{
    static const char *const words[] = {"named", "installed", "cached"};
    (void)space;
    return words[source_of(of)->place];
}
static const char *numbering(const void *of, char *space) { return (void)space, head_of(of)->numbering; }
static const char *hash(const void *of, char *space) { return (void)space, head_of(of)->hash; }
static double version(const void *of) { return head_of(of)->version; }
static double made(const void *of) { return source_of(of)->made ? source_of(of)->made_s : (double)NAN; }
static double opened(const void *of) { return source_of(of)->open_s; }
static double nodes(const void *of) { return head_of(of)->tissue.mesh.vertex_count; }
static double tets(const void *of) { return head_of(of)->tissue.mesh.tet_count; }
static double pairs(const void *of) { return head_of(of)->tissue.attach.pair_count; }
static double overlap(const void *of) { return (void)of, lip_overlap_mm; }
static double points(const void *of) { return head_of(of)->point_count; }

typedef struct part_size {
    int vertices, triangles, teeth;
} part_size;
static bool has_teeth(const void *of) { return ((const part_size *)of)->teeth > 0; }
static const record_row part_row[] = {
    ROW(part_size, vertices, "vertices", NULL, "of the surface"),
    ROW(part_size, triangles, "triangles", NULL, "of the surface"),
    ROW_WHEN(has_teeth, part_size, teeth, "teeth", NULL, "numbered from 0"),
};
static const record_table part_table = {.title = "A part of a head", RECORD_ROWS(part_row)};

static const void *next_part(const void *of, int *i, const char **key, void *space)
{
    if (*i == CASE_SURFACE_COUNT) return NULL;
    const head_template *t = head_of(of);
    const surface *s = &t->part[*i];
    part_size *size = space;
    *key = case_surface_name((case_surface)*i);
    *size = (part_size){.vertices = s->vertex_count, .triangles = s->triangle_count};
    for (int32_t v = 0; t->tooth[*i] && v < s->vertex_count; v++)
        if (t->tooth[*i][v] >= size->teeth) size->teeth = t->tooth[*i][v] + 1;
    return size;
}

static const void *next_label(const void *of, int *i, const char **key, void *space)
{
    (void)key, (void)space;
    return *i < head_of(of)->point_count ? head_of(of)->point[*i].label : NULL;
}

static const record_row rows[] = {
    ROW_TEXT(path, "path", "the file of the template"),
    {.name = "place",
     .kind = RECORD_TEXT,
     .text = place,
     .words = "named|installed|cached",
     .help = "how it was found: by GNATHOS_TEMPLATE, with the program, or kept by an earlier run"},
    ROW_FOUND(NUMBER, version, "template_version", NULL, "of the numbering"),
    ROW_TEXT(numbering, "numbering", "hash of what hangs together with what; the same for all files of a version"),
    ROW_TEXT(hash, "hash", "of the whole template"),
    ROW_FOUND(NUMBER, nodes, "tissue.nodes", NULL, "of the soft tissue"),
    ROW_FOUND(NUMBER, tets, "tissue.tets", NULL, "of the soft tissue"),
    ROW_FOUND(NUMBER, pairs, "tissue.lip_pairs", NULL, "facing nodes of the two lips"),
    ROW_FOUND(NUMBER, overlap, "tissue.rest_overlap_mm", "mm", "how deep the lips lie one in the other at rest"),
    ROW_MAP(next_part, "part", OBJECT, &part_table, "parts", NULL, "skin, bones and teeth"),
    ROW_FOUND(NUMBER, points, "landmarks.count", NULL, "that hang on the parts"),
    ROW_TEXTS(next_label, "landmarks.labels", "their labels"),
    ROW_FOUND(NUMBER, opened, "seconds.open", "s", "wall time of reading it"),
    ROW_FOUND(NUMBER, made, "seconds.make", "s", "wall time of making it; null where it was there"),
};
const record_table template_record_table = {
    .kind = "template", .title = "Record of gnathos template", RECORD_ROWS(rows)};
