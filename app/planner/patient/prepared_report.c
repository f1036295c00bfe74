#include "app/planner/patient/prepared_report.h"
#include "app/planner/patient/case_warnings.h"
#include "app/planner/patient/cut_record.h"
#include "app/planner/store/stage_record.h"

static const record_row mesh_row[] = {
    ROW(tissue_report, nodes, "nodes", NULL, "nodes of the tissue"),
    ROW(tissue_report, tets, "tets", NULL, "its tetrahedra"),
    ROW(tissue_report, quality.volume_mm3, "volume_mm3", "mm3", "its volume"),
    ROW(tissue_report, quality.min_volume_mm3, "min_volume_mm3", "mm3", "volume of the smallest tetrahedron"),
    ROW(tissue_report, quality.min_dihedral_deg, "min_dihedral_deg", "degrees", "smallest angle between two faces"),
    ROW(tissue_report, quality.max_dihedral_deg, "max_dihedral_deg", "degrees", "largest angle between two faces"),
    ROW(tissue_report, quality.min_radius_ratio, "min_radius_ratio", NULL,
        "three times the inner over the outer radius, of the flattest tetrahedron: 1 is regular, 0 flat"),
    ROW(tissue_report, quality.mean_radius_ratio, "mean_radius_ratio", NULL, "mean of that"),
    ROW(tissue_report, quality.min_edge_mm, "min_edge_mm", "mm", "shortest edge"),
    ROW(tissue_report, quality.mean_edge_mm, "mean_edge_mm", "mm", "mean edge"),
};
static const record_table mesh_table = {.title = "Mesh of the tissue", RECORD_ROWS(mesh_row)};

static const record_row attach_row[] = {
    ROW(tissue_report, tied_nodes, "tied", NULL, "nodes that move with a bone"),
    ROW(tissue_report, sliding_nodes, "sliding", NULL, "nodes that slide on bone or teeth"),
    ROW(tissue_report, loose_nodes, "loose_near_cuts", NULL, "nodes on bone that hang on nothing, along cuts"),
    ROW(tissue_report, fixed_nodes, "fixed_at_far_faces", NULL, "nodes held where the tissue ends"),
    ROW(tissue_report, hole_nodes, "over_holes", NULL, "nodes where the wrap spans a hole of the bone"),
    ROW(tissue_report, skin_nodes, "skin", NULL, "nodes of the skin"),
    ROW(tissue_report, lip_pairs, "lip_pairs", NULL, "pairs of nodes of upper and lower lip"),
    ROW(tissue_report, not_snapped, "not_moved_onto_bone", NULL, "nodes near bone that could not be moved onto it"),
    ROW(tissue_report, max_bone_gap_mm, "max_bone_gap_mm", "mm", "farthest that a tied node is from its bone"),
};
static const record_table attach_table = {.title = "What holds the tissue", RECORD_ROWS(attach_row)};

typedef struct prepared_numbers {
    const tissue_report *tissue;
    const repair_report *skin, *skull, *mandible;
    const cut_report *cuts;
    double gap_mean_mm, gap_max_mm;
    const char *left_out;
    int warnings;
    const case_warning *warning;
} prepared_numbers;

static const record_row report_row[] = {
    ROW_BEHIND(prepared_numbers, skin, &repair_table, "repair.skin", "what was repaired in the skin"),
    ROW_BEHIND(prepared_numbers, skull, &repair_table, "repair.skull", "what was repaired in the skull"),
    ROW_BEHIND(prepared_numbers, mandible, &repair_table, "repair.mandible", "what was repaired in the mandible"),
    ROW_BEHIND(prepared_numbers, cuts, &cuts_table, "cuts", "what the cuts made"),
    ROW_BEHIND(prepared_numbers, tissue, &mesh_table, "mesh", "the mesh of the tissue"),
    ROW_BEHIND(prepared_numbers, tissue, &attach_table, "attachment", "what its nodes hang on"),
    ROW(prepared_numbers, gap_mean_mm, "skin_gap_mean_mm", "mm", "mean distance of the skin from its tetrahedra"),
    ROW(prepared_numbers, gap_max_mm, "skin_gap_max_mm", "mm", "largest distance of the skin from them"),
    ROW(prepared_numbers, left_out, "left_out", NULL, "what is not meshed"),
    ROW_ARRAY(prepared_numbers, warning, warnings, &case_warning_table, "warnings", "what is doubtful about the case"),
};
const record_table prepared_report_table = {.title = "Preparation of a case", RECORD_ROWS(report_row)};

json_t *prepared_report(const case_file *c, const anatomy *a, const tissue_report *r)
{
    case_warnings doubts;
    case_warnings_make(c, &a->warnings, &doubts);
    const prepared_numbers n = {.tissue = r,
                                .skin = &a->skin_repair,
                                .skull = &a->skull_repair,
                                .mandible = &a->mandible_repair,
                                .cuts = &a->cuts,
                                .gap_mean_mm = r->skin_gap_mean_mm,
                                .gap_max_mm = r->skin_gap_max_mm,
                                .left_out = r->left_out,
                                .warnings = doubts.count,
                                .warning = doubts.item};
    json_t *report = record_part(&prepared_report_table, &n);
    case_warnings_free(&doubts);
    return report;
}

issue_list prepared_warnings(const prepared *p, const case_file *c)
{
    case_warnings doubts;
    issue_list out = {0};
    case_warnings_read(json_object_get(p->report, "warnings"), &doubts);
    case_warnings_issues(&doubts, c, &out);
    case_warnings_free(&doubts);
    return out;
}

static const record_row record_rows[] = {
    ROW(prepared, hash, "hash", NULL, "of everything that it was made from"),
    ROW(prepared, reused, "reused", NULL, "it was made earlier and taken from disk"),
    {RECORD_AT(prepared, report), .name = "prepared", .table = &prepared_report_table,
     .help = "repair, cuts and mesh in numbers"},
    ROW_STAGE(prepared, stages.check, "check",
              "to look for what is wrong; no stage takes time that was taken from disk"),
    ROW_STAGE(prepared, stages.repair, "repair", "to read and mend the surfaces and unite bones and teeth"),
    ROW_STAGE(prepared, stages.cuts, "cuts", "to cut the bones"),
    ROW_STAGE(prepared, stages.distances, "distances", "to find where the tissue is, between skin and bones"),
    ROW_STAGE(prepared, stages.mesh, "mesh", "to fill it with tetrahedra"),
    ROW_STAGE(prepared, stages.attachment, "attachment", "to lay them onto the bones and find what they hang on"),
    ROW_STAGE(prepared, stages.fields, "fields", "to find distances of the bones where tissue may touch them"),
};
const record_table prepared_record_table = {
    .kind = "prepared", .title = "Record of gnathos prepare", RECORD_ROWS(record_rows)};

json_t *prepared_record_json(const prepared *p) { return record_json(&prepared_record_table, p); }
