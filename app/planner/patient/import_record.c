#include "app/planner/patient/import_record.h"
#include "app/planner/patient/check_record.h"

static bool is_closed(const void *of) { return !((const import_part *)of)->open_edges; }
static bool has_labels(const void *of) { return ((const import_part *)of)->from_labels; }

static const record_row part_row[] = {
    ROW(import_part, source, "source", NULL, "the file, and of a label map the labels, that it was made from"),
    ROW(import_part, from_labels, "from_labels", NULL, "it was made from voxels"),
    ROW(import_part, thresholded, "thresholded", NULL, "it was cut out of a CT by its grey value, not by hand"),
    ROW(import_part, read.tagged, "tagged", NULL, "the file names its axes"),
    ROW(import_part, read.ras, "turned_from_ras", NULL, "they were RAS and were turned to LPS"),
    ROW(import_part, mesh.vertex_count, "vertices", NULL, "its vertices"),
    ROW(import_part, mesh.triangle_count, "triangles", NULL, "its triangles"),
    ROW(import_part, components, "pieces", NULL, "connected pieces"),
    ROW(import_part, holes, "holes", NULL, "holes in it"),
    ROW(import_part, open_edges, "open_edges", NULL, "edges with one triangle"),
    ROW(import_part, crowded_edges, "crowded_edges", NULL, "edges with more than two triangles"),
    ROW(import_part, self_intersections, "self_intersections", NULL, "pairs of triangles that cross, counted to 10000"),
    ROW(import_part, read.welded_vertices, "welded_vertices", NULL, "vertices made one with another"),
    ROW(import_part, read.dropped_triangles, "dropped_triangles", NULL, "triangles that named a vertex twice"),
    ROW(import_part, read.split_polygons, "split_polygons", NULL, "polygons that became triangles"),
    ROW(import_part, diagonal_mm, "diagonal_mm", "mm", "of its box, corner to corner"),
    ROW(import_part, area_mm2, "area_mm2", "mm2", "its area"),
    ROW_WHEN(is_closed, import_part, volume_mm3, "volume_mm3", "mm3", "its volume, where it is closed"),
    ROW_WHEN(has_labels, import_part, islands_dropped, "islands_dropped", NULL, "islands of voxels left out"),
    ROW_WHEN(has_labels, import_part, made.pieces_dropped, "pieces_dropped", NULL, "pieces of the surface left out"),
    ROW_WHEN(has_labels, import_part, made.crowded_edges, "crowded_edges_parted", NULL,
             "places where it almost touched itself and was parted"),
    ROW_WHEN(has_labels, import_part, cavity_voxels, "cavity_voxels", NULL, "voxels of cavities that were filled"),
    ROW_WHEN(has_labels, import_part, sealed_voxels, "sealed_voxels", NULL, "voxels behind openings that were sealed"),
    ROW_WHEN(has_labels, import_part, label_mm3, "label_mm3", "mm3", "volume of the voxels"),
};
static const record_table part_table = {.title = "A surface of a new case", RECORD_ROWS(part_row)};

typedef struct import_record {
    const char *folder;
    const import_result *result;
    int32_t landmarks, skipped;
    int issues;
    const issue *issue;
    int64_t contacts;
} import_record;

static const void *next_part(const void *of, int *i, const char **key, void *space)
{
    const import_result *r = ((const import_record *)of)->result;
    (void)space;
    while (*i < CASE_SURFACE_COUNT && !r->part[*i].mesh.vertex_count) ++*i;
    if (*i == CASE_SURFACE_COUNT) return NULL;
    *key = case_surface_name((case_surface)*i);
    return &r->part[*i];
}

static bool has_contacts(const void *of) { return ((const import_record *)of)->contacts >= 0; }

static const record_row import_row[] = {
    ROW(import_record, folder, "case", NULL, "folder of the new case"),
    ROW_MAP(next_part, "surface", OBJECT, &part_table, "surfaces", NULL, "what it is made of"),
    ROW(import_record, landmarks, "landmarks", NULL, "how many landmarks it has"),
    ROW(import_record, skipped, "landmarks_skipped", NULL, "how many of the file were left out"),
    ROW_ARRAY(import_record, issue, issues, &issue_table, "issues", "what is worth a word"),
    ROW_WHEN(has_contacts, import_record, contacts, "jaw_contact_voxels", NULL,
             "pairs of voxels where upper and lower jaw touch"),
};
const record_table import_record_table = {
    .kind = "import", .title = "Record of gnathos import", RECORD_ROWS(import_row)};

json_t *import_record_json(const import_result *r, const char *folder, const issue_list *notes)
{
    const import_record all = {.folder = folder,
                               .result = r,
                               .landmarks = r->points.count,
                               .skipped = r->points_skipped,
                               .issues = notes->count,
                               .issue = notes->item,
                               .contacts = r->contacts};
    return record_json(&import_record_table, &all);
}
