#include "app/cli/prepared_print.h"
#include <stdio.h>

static double number(const json_t *o, const char *key) { return json_number_value(json_object_get(o, key)); }

void prepared_print(const prepared *p)
{
    const json_t *report = p->report, *mesh = json_object_get(report, "mesh"),
                 *attach = json_object_get(report, "attachment"), *cuts = json_object_get(report, "cuts");
    const char *name;
    json_t *value;
    printf("segments (cm3):");
    json_object_foreach(json_object_get(cuts, "segment_mm3"), name, value)
        printf("  %s %.2f", name, json_number_value(value) / 1000);
    printf("  kerf %.2f\n", number(cuts, "kerf_mm3") / 1000);
    size_t i;
    json_array_foreach(json_object_get(cuts, "clearance"), i, value)
        printf("  %-38s %6.1f mm, at least %4.1f: %s%s\n", json_string_value(json_object_get(value, "what")),
               number(value, "value_mm"), number(value, "limit_mm"),
               json_is_true(json_object_get(value, "ok")) ? "ok" : "TOO CLOSE",
               json_is_true(json_object_get(value, "estimated")) ? " (estimated)" : "");
    json_array_foreach(json_object_get(cuts, "notes"), i, value) printf("  %s\n", json_string_value(value));
    printf("tissue: %.0f nodes, %.0f tets, %.1f cm3; dihedral angles %.1f to %.1f deg, radius ratio at least "
           "%.3f, mean "
           "%.2f; smallest tet %.2g mm3\n",
           number(mesh, "nodes"), number(mesh, "tets"), number(mesh, "volume_mm3") / 1000,
           number(mesh, "min_dihedral_deg"), number(mesh, "max_dihedral_deg"), number(mesh, "min_radius_ratio"),
           number(mesh, "mean_radius_ratio"), number(mesh, "min_volume_mm3"));
    printf("attachment: %.0f nodes tied, %.0f sliding, %.0f loose along cuts, %.0f over holes, %.0f fixed "
           "far away, %.0f "
           "lip pairs\n",
           number(attach, "tied"), number(attach, "sliding"), number(attach, "loose_near_cuts"),
           number(attach, "over_holes"), number(attach, "fixed_at_far_faces"), number(attach, "lip_pairs"));
    printf("left out: %s\n", json_string_value(json_object_get(report, "left_out")));
    printf("skin to tets: mean %.3f mm, largest %.2f mm\n", number(report, "skin_gap_mean_mm"),
           number(report, "skin_gap_max_mm"));
    const prepared_stages *t = &p->stages;
    if (!p->reused)
        printf("%.1f s to check, %.1f s for the bones, %.1f s for the tissue\n", t->check.wall_s,
               t->repair.wall_s + t->cuts.wall_s,
               t->distances.wall_s + t->mesh.wall_s + t->attachment.wall_s + t->fields.wall_s);
}
