#include "app/planner/patient/cut_record.h"

static const record_row repair_row[] = {
    ROW(repair_report, welded_vertices, "welded_vertices", NULL, "vertices made one with another"),
    ROW(repair_report, degenerate_triangles, "degenerate_triangles", NULL, "triangles without area that were dropped"),
    ROW(repair_report, components_found, "components_found", NULL, "pieces of the surface as read"),
    ROW(repair_report, components_dropped, "components_dropped", NULL, "of them, too small to be kept"),
    ROW(repair_report, dropped_area_mm2, "dropped_area_mm2", "mm2", "area of those"),
    ROW(repair_report, holes_filled, "holes_filled", NULL, "holes that were filled"),
    ROW(repair_report, widest_hole_mm, "widest_hole_mm", "mm", "size of the widest hole"),
    ROW(repair_report, self_intersections_found, "self_intersections_found", NULL, "pairs of triangles that crossed"),
    ROW(repair_report, self_intersections_left, "self_intersections_left", NULL, "of them, still there"),
    ROW(repair_report, wrapped, "wrapped", NULL, "the surface was replaced by a tight wrap around it, the last resort"),
    ROW(repair_report, max_deviation_mm, "max_deviation_mm", "mm", "farthest that the repair moved a vertex it kept"),
    ROW(repair_report, vertices_moved, "vertices_moved", NULL, "vertices it moved by more than 0.1 mm"),
};
const record_table repair_table = {.title = "Repair of a surface", RECORD_ROWS(repair_row)};

static const record_row balance_row[] = {
    ROW(cut_balance, name, "cut", NULL, "name of the cut"),
    ROW(cut_balance, before_mm3, "before_mm3", "mm3", "volume of the bone before"),
    ROW(cut_balance, piece_mm3, "piece_mm3", "mm3", "volume of the piece cut off"),
    ROW(cut_balance, rest_mm3, "rest_mm3", "mm3", "volume of what stays"),
    ROW(cut_balance, kerf_mm3, "kerf_mm3", "mm3", "volume that the saw took"),
    ROW(cut_balance, error_share, "error_share", NULL, "share of the volume before by which these do not add up"),
};
static const record_table balance_table = {.title = "Volumes of a cut", RECORD_ROWS(balance_row)};

static const record_row clearance_row[] = {
    ROW(cut_clearance, name, "what", NULL, "what keeps off what"),
    ROW(cut_clearance, value_mm, "value_mm", "mm", "how far"),
    ROW(cut_clearance, limit_mm, "limit_mm", "mm", "how far it should at least"),
    ROW(cut_clearance, ok, "ok", NULL, "it does"),
    ROW(cut_clearance, estimated, "estimated", NULL, "it rests on mean lengths of teeth, an assumed canal or a rule"),
};
static const record_table clearance_table = {.title = "Clearance of a cut", RECORD_ROWS(clearance_row)};

static const record_row fragment_row[] = {
    ROW_WORD(cut_fragment, from, "from", SEGMENT_WORDS, "the segment from which it was cut"),
    ROW_WORD(cut_fragment, to, "to", SEGMENT_WORDS, "the segment to which it was given"),
    ROW(cut_fragment, volume_mm3, "volume_mm3", "mm3", "its volume"),
    ROW(cut_fragment, gap_mm, "gap_mm", "mm", "its distance from that segment"),
};
static const record_table fragment_table = {.title = "An island that a cut left", RECORD_ROWS(fragment_row)};

static const void *next_volume(const void *of, int *i, const char **key, void *space)
{
    const cut_report *r = of;
    (void)space;
    while (*i < SEGMENT_COUNT && !(r->volume_mm3[*i] > 0)) ++*i;
    if (*i == SEGMENT_COUNT) return NULL;
    *key = segment_name((segment_id)*i);
    return &r->volume_mm3[*i];
}

static const void *next_handles(const void *of, int *i, const char **key, void *space)
{
    const cut_report *r = of;
    (void)space;
    while (*i < SEGMENT_COUNT && !(r->volume_mm3[*i] > 0)) ++*i;
    if (*i == SEGMENT_COUNT) return NULL;
    *key = segment_name((segment_id)*i);
    return &r->handles[*i];
}

static const void *next_warning(const void *of, int *i, const char **key, void *space)
{
    const cut_report *r = of;
    (void)key, (void)space;
    return *i < r->warning_count ? r->warning[*i] : NULL;
}

static const void *next_note(const void *of, int *i, const char **key, void *space)
{
    const cut_report *r = of;
    (void)key, (void)space;
    return *i < r->note_count ? r->note[*i] : NULL;
}

static const record_row cuts_row[] = {
    ROW_MAP(next_volume, "segment", NUMBER, NULL, "segment_mm3", "mm3", "volume of each segment"),
    ROW_MAP(next_handles, "segment", COUNT, NULL, "segment_handles", NULL,
            "genus of each segment: how often it is pierced through"),
    ROW(cut_report, kerf_mm3, "kerf_mm3", "mm3", "volume of the bone that the saw removes"),
    ROW_ARRAY(cut_report, balance, balance_count, &balance_table, "balance", "volumes of each cut"),
    ROW_ARRAY(cut_report, clearance, clearance_count, &clearance_table, "clearance", "how far cuts keep off what"),
    ROW_ARRAY(cut_report, fragment, fragment_count, &fragment_table, "fragments", "islands that the cuts left"),
    ROW_TEXTS(next_warning, "warnings", "what is not as it should be"),
    ROW_TEXTS(next_note, "notes", "what the cuts did to keep off roots and teeth"),
};
const record_table cuts_table = {.title = "Cuts of the bones", RECORD_ROWS(cuts_row)};

static const record_row plane_row[] = {
    ROW(cut_plane, label, "name", NULL, "name of the plane"),
    ROW(cut_plane, point, "point", "LPS mm", "a point of it"),
    ROW(cut_plane, normal, "normal", "LPS", "its unit normal"),
};
static const record_table plane_table = {.title = "A plane", RECORD_ROWS(plane_row)};

typedef struct cut_record {
    const char *name;
    double saw_mm;
    const repair_report *skull, *mandible;
    const cut_report *cuts;
    const cut_plane *plane;
    int planes;
} cut_record;

static const record_row cut_record_row[] = {
    ROW(cut_record, name, "case", NULL, "name of the case"),
    ROW(cut_record, saw_mm, "saw_mm", "mm", "width of the saw"),
    ROW_BEHIND(cut_record, skull, &repair_table, "repair.skull", "what was repaired in the skull"),
    ROW_BEHIND(cut_record, mandible, &repair_table, "repair.mandible", "what was repaired in the mandible"),
    ROW_BEHIND(cut_record, cuts, &cuts_table, "cuts", "what the cuts made"),
    ROW_ARRAY(cut_record, plane, planes, &plane_table, "planes", "the planes that were used"),
};
const record_table cut_record_table = {
    .kind = "cut", .title = "Record of gnathos cut, cut_report.json", RECORD_ROWS(cut_record_row)};

json_t *cut_record_json(const case_file *c, const anatomy *a)
{
    const cut_record r = {.name = c->name,
                          .saw_mm = c->cuts.kerf_mm,
                          .skull = &a->skull_repair,
                          .mandible = &a->mandible_repair,
                          .cuts = &a->cuts,
                          .plane = a->cuts.plane,
                          .planes = a->cuts.plane_count};
    return record_json(&cut_record_table, &r);
}
