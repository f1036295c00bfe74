#include "app/planner/patient/prepared_report.h"

json_t *repair_report_json(const repair_report *r)
{
    return json_pack("{si si si si sf si sf si si sb sf si}", "welded_vertices", r->welded_vertices,
                     "degenerate_triangles", r->degenerate_triangles, "components_found", r->components_found,
                     "components_dropped", r->components_dropped, "dropped_area_mm2", r->dropped_area_mm2,
                     "holes_filled", r->holes_filled, "widest_hole_mm", r->widest_hole_mm, "self_intersections_found",
                     r->self_intersections_found, "self_intersections_left", r->self_intersections_left, "wrapped",
                     r->wrapped, "max_deviation_mm", r->max_deviation_mm, "vertices_moved", r->vertices_moved);
}

json_t *cuts_report(const cut_report *r)
{
    json_t *balance = json_array(), *clearance = json_array(), *volume = json_object(), *warning = json_array(),
           *fragment = json_array();
    for (int i = 0; i < r->balance_count; i++) {
        const cut_balance *b = &r->balance[i];
        json_array_append_new(balance, json_pack("{ss sf sf sf sf sf}", "cut", b->name, "before_mm3", b->before_mm3,
                                                 "piece_mm3", b->piece_mm3, "rest_mm3", b->rest_mm3, "kerf_mm3",
                                                 b->kerf_mm3, "error_share", b->error_share));
    }
    for (int i = 0; i < r->clearance_count; i++) {
        const cut_clearance *k = &r->clearance[i];
        json_array_append_new(clearance, json_pack("{ss sf sf sb sb}", "what", k->name, "value_mm", k->value_mm,
                                                   "limit_mm", k->limit_mm, "ok", k->ok, "estimated", k->estimated));
    }
    for (int i = 0; i < r->fragment_count; i++) {
        const cut_fragment *f = &r->fragment[i];
        json_array_append_new(fragment,
                              json_pack("{ss ss sf sf}", "from", segment_name(f->from), "to", segment_name(f->to),
                                        "volume_mm3", f->volume_mm3, "gap_mm", f->gap_mm));
    }
    for (int s = 0; s < SEGMENT_COUNT; s++)
        if (r->volume_mm3[s] > 0) json_object_set_new(volume, segment_name((segment_id)s), json_real(r->volume_mm3[s]));
    for (int i = 0; i < r->warning_count; i++) json_array_append_new(warning, json_string(r->warning[i]));
    return json_pack("{so sf so so so so}", "segment_mm3", volume, "kerf_mm3", r->kerf_mm3, "balance", balance,
                     "clearance", clearance, "fragments", fragment, "warnings", warning);
}

json_t *prepared_report(const anatomy *a, const tissue_report *r, double bones_s, double tissue_s)
{
    const tetmesh_quality *q = &r->quality;
    json_t *mesh =
        json_pack("{si si sf sf sf sf sf sf sf sf}", "nodes", r->nodes, "tets", r->tets, "volume_mm3", q->volume_mm3,
                  "min_volume_mm3", q->min_volume_mm3, "min_dihedral_deg", q->min_dihedral_deg, "max_dihedral_deg",
                  q->max_dihedral_deg, "min_radius_ratio", q->min_radius_ratio, "mean_radius_ratio",
                  q->mean_radius_ratio, "min_edge_mm", q->min_edge_mm, "mean_edge_mm", q->mean_edge_mm);
    json_t *attach = json_pack("{si si si si si si si si sf}", "tied", r->tied_nodes, "sliding", r->sliding_nodes,
                               "loose_near_cuts", r->loose_nodes, "fixed_at_far_faces", r->fixed_nodes, "over_holes",
                               r->hole_nodes, "skin", r->skin_nodes, "lip_pairs", r->lip_pairs, "not_moved_onto_bone",
                               r->not_snapped, "max_bone_gap_mm", r->max_bone_gap_mm);
    json_t *out =
        json_pack("{s{so so so} so so so sf sf ss s{sf sf}}", "repair", "skin", repair_report_json(&a->skin_repair),
                  "skull", repair_report_json(&a->skull_repair), "mandible", repair_report_json(&a->mandible_repair),
                  "cuts", cuts_report(&a->cuts), "mesh", mesh, "attachment", attach, "skin_gap_mean_mm",
                  r->skin_gap_mean_mm, "skin_gap_max_mm", r->skin_gap_max_mm, "left_out", r->left_out, "seconds",
                  "bones", bones_s, "tissue", tissue_s);
    return out;
}
