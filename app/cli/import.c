/* gnathos import: a case folder from surfaces, or from a label map and a CT. */
#include "app/cli/verb.h"
#if GNATHOS_WITH_SIM
#include "app/planner/identity/head_landmarks.h"
#endif
#include "app/planner/patient/import_record.h"
#include "geometry/write_whole.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    KEY_SKIN = KEY_OWN,
    KEY_UPPER,
    KEY_LOWER,
    KEY_LANDMARKS,
    KEY_FRAME,
    KEY_NAME,
    KEY_UNIT,
    KEY_LABELS,
    KEY_PRESET,
    KEY_CT,
    KEY_DICOM,
    KEY_HU,
    KEY_SEAL,
    KEY_EDGE,
    KEY_SKULL,
    KEY_FORM,
    KEY_MANDIBLE
};

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0,
     "What the case is made of (given twice: of both): mesh files (.ply .stl .obj .off .gltf .glb .vtk .vtp, "
     "FILE.glb#NODE), or labels of --labels",
     1},
    {"skin", KEY_SKIN, "FROM", 0, "Skin of the head; may be open at neck, mouth, eyes and nostrils", 1},
    {"skull", KEY_SKULL, "FROM", 0, "Skull with the maxilla", 1},
    {"mandible", KEY_MANDIBLE, "FROM", 0, "Mandible", 1},
    {"upper-teeth", KEY_UPPER, "FROM", 0, "Upper teeth, where they are apart from the skull", 1},
    {"lower-teeth", KEY_LOWER, "FROM", 0, "Lower teeth, where they are apart from the mandible", 1},
    {"landmarks", KEY_LANDMARKS, "FILE", 0,
     "Points of 3D Slicer (.mrk.json, .fcsv); auto: gnathos places them, look at them before they are used", 1},
    {NULL, 0, NULL, 0, "How mesh files are meant:", 2},
    {"frame", KEY_FRAME, "AXES", 0, "lps (where absent) or ras: axes of meshes without a SPACE tag", 2},
    {"unit", KEY_UNIT, "UNIT", 0, "mm, cm or m: length unit of the mesh files", 2},
    {NULL, 0, NULL, 0, "From images:", 3},
    {"labels", KEY_LABELS, "FILE", 0,
     "Label map (.nrrd .seg.nrrd .nii .nii.gz .mha .mhd); labels are chosen by name, or by number where the file names "
     "none; "
     "several are separated by commas. Given several times: files of one grid, each of them one "
     "structure that bears its file's name",
     3},
    {"preset", KEY_PRESET, "NAME", 0,
     "dental-segmentator, totalsegmentator-craniofacial or toothfairy: the labels of that tool", 3},
    {"ct", KEY_CT, "FILE", 0, "Take the skin from this CT", 3},
    {"dicom", KEY_DICOM, "DIR", 0,
     "The same from the DICOM slices in this folder, read by dcm2niix, which must be installed; a tilted gantry and "
     "uneven slices are refused",
     3},
    {"nifti-form", KEY_FORM, "FORM", 0, "sform or qform: which holds where a NIfTI file places itself twice", 3},
    {"skin-hu", KEY_HU, "HU", 0, "Grey value of the skin's surface in the CT (-300)", 3},
    {"seal", KEY_SEAL, "MM", 0,
     "Seal openings of that skin narrower than this, and the airways behind them (8; 0: none)", 3},
    {"edge", KEY_EDGE, "MM", 0, "Edge length of surfaces made from images (1.6)", 3},
    {NULL, 0, NULL, 0, "Result:", 4},
    {"output", 'o', "CASE", 0, "The new case folder", 4},
    {"name", KEY_NAME, "TEXT", 0, "Name of the case (the folder's)", 4},
    {0}};

static double number(const char *arg, double low, double high, const char *what, struct argp_state *state)
{
    char *end;
    double value = strtod(arg, &end);
    if (end == arg || *end || !(value >= low && value <= high))
        command_usage(state, "--%s=%s: must be a number from %g to %g", what, arg, low, high);
    return value;
}

/* --landmarks auto */
static bool place(const surface part[CASE_SURFACE_COUNT], const task *watch, landmarks *out, err *e)
{
#if GNATHOS_WITH_SIM
    head_scan scan = {0};
    head_landmarks found = {0};
    memcpy(scan.part, part, sizeof scan.part); /* borrowed */
    if (!head_landmarks_place(&scan, watch, &found, e)) return false;
    *out = head_landmarks_points(&found);
    head_landmarks_free(&found);
    return true;
#else
    (void)part, (void)watch, (void)out;
    return err_set(e, ERR_USAGE, "--landmarks auto: this build fits no template (GNATHOS_SIM=OFF)");
#endif
}

static void add(import_words *w, const char *arg, struct argp_state *state)
{
    if (w->count == IMPORT_TIMES_MOST)
        command_usage(state, "\"%s\": an option may be given %d times", arg, IMPORT_TIMES_MOST);
    w->word[w->count++] = arg;
}

static const int often[] = {KEY_SKIN, KEY_SKULL, KEY_MANDIBLE, KEY_UPPER, KEY_LOWER, KEY_LABELS, 0};

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    import_params *p = r->own;
    switch (key) {
    case KEY_SKIN: add(&p->from[CASE_SKIN], arg, state); return 0;
    case KEY_SKULL: add(&p->from[CASE_SKULL], arg, state); return 0;
    case KEY_MANDIBLE: add(&p->from[CASE_MANDIBLE], arg, state); return 0;
    case KEY_UPPER: add(&p->from[CASE_UPPER_TEETH], arg, state); return 0;
    case KEY_LOWER: add(&p->from[CASE_LOWER_TEETH], arg, state); return 0;
    case KEY_LANDMARKS:
        if (strcmp(arg, "auto"))
            p->landmarks = arg;
        else
            p->place = place;
        return 0;
    case KEY_NAME: p->name = arg; return 0;
    case KEY_LABELS: add(&p->labels, arg, state); return 0;
    case KEY_PRESET: p->preset = arg; return 0;
    case KEY_CT:
    case KEY_DICOM:
        if (p->ct) argp_error(state, "--ct and --dicom both name the CT; which is meant?");
        p->ct = arg;
        p->ct_is_dicom = key == KEY_DICOM;
        return 0;
    case KEY_HU:
        p->skin_hu = number(arg, -1000, 30000, "skin-hu", state);
        p->skin_hu_given = true;
        return 0;
    case KEY_SEAL: p->seal_mm = number(arg, 0, 40, "seal", state); return 0;
    case KEY_EDGE: p->mesh.edge_mm = number(arg, 0.3, 10, "edge", state); return 0;
    case KEY_FRAME:
        if (!strcmp(arg, "lps"))
            p->space = MESH_SPACE_LPS;
        else if (!strcmp(arg, "ras"))
            p->space = MESH_SPACE_RAS;
        else
            command_usage(state, "--frame=%s: must be lps or ras", arg);
        return 0;
    case KEY_FORM:
        if (!strcmp(arg, "sform"))
            p->form = VOLUME_FORM_SFORM;
        else if (!strcmp(arg, "qform"))
            p->form = VOLUME_FORM_QFORM;
        else
            command_usage(state, "--nifti-form=%s: must be sform or qform", arg);
        return 0;
    case KEY_UNIT:
        p->unit_mm = !strcmp(arg, "mm") ? 1 : !strcmp(arg, "cm") ? 10 : !strcmp(arg, "m") ? 1000 : 0;
        if (!(p->unit_mm > 0)) command_usage(state, "--unit=%s: must be mm, cm or m", arg);
        return 0;
    case ARGP_KEY_ARG:
        command_usage(state, "\"%s\": every input is named by an option, as in --skin=%s", arg, arg);
        return 0;
    case ARGP_KEY_END:
        if (p->preset && !p->labels.count) command_usage(state, "--preset needs --labels");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static void print_plain(const import_result *r, const char *folder)
{
    printf("case %s\n", command_shown(folder));
    for (int i = 0; i < CASE_SURFACE_COUNT; i++) {
        const import_part *part = &r->part[i];
        if (!part->mesh.vertex_count) continue;
        printf("  %-12s %s%s\n", case_surface_name((case_surface)i), command_shown(part->source),
               part->thresholded ? " (thresholded skin)" : "");
        printf("  %12s %d vertices, %d triangles, %d pieces, %.1f mm corner to corner\n", "", part->mesh.vertex_count,
               part->mesh.triangle_count, part->components, part->diagonal_mm);
        printf("  %12s %d holes (%d open edges), %d crowded edges, %d%s self-intersections\n", "", part->holes,
               part->open_edges, part->crowded_edges, part->self_intersections,
               part->self_intersections >= IMPORT_INTERSECTIONS_MOST ? " or more" : "");
        if (part->read.welded_vertices || part->read.dropped_triangles || part->read.split_polygons)
            printf("  %12s changed: %d vertices welded, %d degenerate triangles dropped, %d polygons split\n", "",
                   part->read.welded_vertices, part->read.dropped_triangles, part->read.split_polygons);
        if (part->read.ras) printf("  %12s changed: turned from RAS to LPS\n", "");
        if (part->from_labels)
            printf("  %12s changed: %d islands and %d small pieces dropped, %lld voxels of cavities filled, "
                   "%lld sealed, %d "
                   "crowded edges parted; %.0f mm^3 of voxels, %.0f in the surface\n",
                   "", part->islands_dropped, part->made.pieces_dropped, (long long)part->cavity_voxels,
                   (long long)part->sealed_voxels, part->made.crowded_edges, part->label_mm3, part->volume_mm3);
    }
    if (r->has_points) printf("  %-12s %d points\n", "landmarks", r->points.count);
}

static void defaults(void *own) { *(import_params *)own = import_params_default(); }

static bool run(run_context *r, err *e)
{
    const import_params *p = r->own;
    import_result result = {0};
    issue_list notes = {0};
    whole_folder target;
    /* A target in use is refused now, not after minutes. */
    bool good = whole_folder_open(r->out_path, &target, e);
    if (good) whole_folder_abandon(&target);
    good = good && import_read(p, &r->watch, &result, &notes, e) && import_write(p, &result, r->out_path, e);
    command_print_issues(&r->common, &notes);
    if (good && r->common.json)
        command_print_record(import_record_json(&result, r->out_path, &notes));
    else if (good && !r->common.quiet)
        print_plain(&result, r->out_path);
    issue_list_free(&notes);
    import_result_free(&result);
    return good;
}

const verb verb_import = {.arguments = "-o CASE",
                          .about =
                              "Makes a case folder from surfaces, or from a label map and a CT. Surfaces are stored as "
                              "they are (equal vertices welded, degenerate triangles dropped) and reported on; "
                              "`gnathos prepare` repairs them. Units are never guessed.",
                          .options = options,
                          .missing_output = "name the new case folder with -o",
                          .own_size = sizeof(import_params),
                          .defaults = defaults,
                          .parse = parse,
                          .often = often,
                          .run = run};
