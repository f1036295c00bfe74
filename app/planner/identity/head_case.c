#include "app/planner/identity/head_case.h"
#include "app/planner/patient/case_guess.h"
#include "app/planner/patient/check.h"
#include "geometry/json_file.h"
#include <stdio.h>

bool head_case_write(const head_template *t, const head_shape *s, const case_guess *guessed, const char *folder,
                     const char *name, err *e)
{
    char path[FIELD_PATH_SIZE];
    bool ok = true;
    json_t *surfaces = json_object();
    for (int i = 0; ok && i < CASE_SURFACE_COUNT; i++) {
        char file[64];
        snprintf(file, sizeof file, "%s.ply", case_surface_name((case_surface)i));
        snprintf(path, sizeof path, "%s/%s", folder, file);
        surface part = head_part(t, s, (case_surface)i);
        ok = mesh_write_surface(&part, path, e);
        json_object_set_new(surfaces, case_surface_name((case_surface)i), json_string(file));
        surface_free(&part);
    }
    landmarks points = head_points(t, s);
    snprintf(path, sizeof path, "%s/landmarks.mrk.json", folder);
    ok = ok && landmarks_write(&points, path, e);
    landmarks_free(&points);
    json_t *root = json_pack("{s:i, s:s, s:s, s:s, s:o, s:s, s:[s,s,s]}", "gnathos", 1, "name", name, "units", "mm",
                             "frame", "LPS", "surfaces", surfaces, "landmarks", "landmarks.mrk.json", "osteotomies",
                             "le_fort_1", "bsso", "genioplasty");
    if (guessed) json_object_set_new(root, "guessed", case_guess_json(guessed));
    snprintf(path, sizeof path, "%s/case.json", folder);
    ok = ok && json_file_write(root, path, e);
    json_decref(root);
    return ok;
}

bool head_case_passes(const char *folder, const task *watch, issue_list *warnings, err *e)
{
    case_file c;
    return case_file_load(folder, &c, e) && check_case_passes(&c, watch, warnings, e);
}
