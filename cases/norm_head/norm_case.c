#include "norm_case.h"
#include "geometry/json_file.h"
#include "geometry/mem.h"
#include "geometry/mesh_file.h"
#include "geometry/write_whole.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool read_number(const json_file *f, const json_t *value, const char *pointer, double *out, err *e)
{
    if (!json_is_number(value)) return json_file_refuse(f, pointer, e, "must be a number");
    *out = json_number_value(value);
    return true;
}

static bool read_whole(const json_file *f, const json_t *value, const char *pointer, int64_t *out, err *e)
{
    if (!json_is_integer(value) || json_integer_value(value) < 0)
        return json_file_refuse(f, pointer, e, "must be a whole number, 0 or more");
    *out = json_integer_value(value);
    return true;
}

static bool read_set(const json_file *f, json_t *set, norm_head_params *p, err *e)
{
    if (!json_is_object(set)) return json_file_refuse(f, "/set", e, "must be an object of measures");
    const char *key;
    json_t *value;
    json_object_foreach(set, key, value)
    {
        char pointer[128];
        snprintf(pointer, sizeof pointer, "/set/%s", key);
        int id = measure_find(key);
        if (id < 0) return json_file_refuse(f, pointer, e, "no such measure");
        if (!read_number(f, value, pointer, &p->set[id], e)) return false;
        p->is_set[id] = true;
    }
    return true;
}

static bool read_member(const json_file *f, const char *key, json_t *value, norm_head_params *p, err *e)
{
    char pointer[128];
    snprintf(pointer, sizeof pointer, "/%s", key);
    int64_t whole = 0;
    if (!strcmp(key, "gnathos"))
        return json_integer_value(value) == 1 ||
               json_file_refuse(f, pointer, e, "must be 1, the version of the format");
    if (!strcmp(key, "sex")) {
        const char *word = json_string_value(value);
        if (!word || (strcmp(word, "f") && strcmp(word, "m")))
            return json_file_refuse(f, pointer, e, "must be \"f\" or \"m\"");
        p->sex = word[0] == 'm' ? NORM_MALE : NORM_FEMALE;
        return true;
    }
    if (!strcmp(key, "class")) {
        if (!read_whole(f, value, pointer, &whole, e)) return false;
        if (whole < 1 || whole > 3) return json_file_refuse(f, pointer, e, "must be 1, 2 or 3");
        p->skeletal_class = (int)whole;
        return true;
    }
    if (!strcmp(key, "seed")) {
        if (!read_whole(f, value, pointer, &whole, e)) return false;
        p->seed = (uint64_t)whole;
        return true;
    }
    if (!strcmp(key, "open_bite_mm")) return read_number(f, value, pointer, &p->open_bite_mm, e);
    if (!strcmp(key, "asymmetry_mm")) return read_number(f, value, pointer, &p->asymmetry_mm, e);
    if (!strcmp(key, "coarseness")) return read_number(f, value, pointer, &p->coarseness, e);
    if (!strcmp(key, "set")) return read_set(f, value, p, e);
    return json_file_refuse(f, pointer, e, "no such field in a recipe");
}

bool norm_case_read_recipe(const char *path, norm_head_params *out, err *e)
{
    json_file f;
    if (!json_file_read(path, &f, e)) return false;
    norm_head_params p = norm_head_params_default();
    bool ok = json_is_object(f.root) || json_file_refuse(&f, "", e, "must be an object");
    if (ok && !json_object_get(f.root, "gnathos"))
        ok = json_file_refuse(&f, "", e, "lacks \"gnathos\": 1, the version of the format");
    const char *key;
    json_t *value;
    if (ok) {
        json_object_foreach(f.root, key, value)
        {
            ok = read_member(&f, key, value, &p, e);
            if (!ok) break;
        }
    }
    json_file_free(&f);
    if (!ok) return false;
    if (!norm_head_params_check(&p, e)) {
        e->code = ERR_INPUT;
        return err_prefix(e, "%s", path);
    }
    *out = p;
    return true;
}

static json_t *recipe(const norm_head_params *p)
{
    json_t *o = json_pack("{s:i, s:s, s:i, s:I, s:f, s:f, s:f}", "gnathos", 1, "sex", p->sex == NORM_MALE ? "m" : "f",
                          "class", p->skeletal_class, "seed", (json_int_t)p->seed, "open_bite_mm", p->open_bite_mm,
                          "asymmetry_mm", p->asymmetry_mm, "coarseness", p->coarseness);
    json_t *set = json_object();
    for (int i = 0; i < MEASURE_COUNT; i++)
        if (p->is_set[i]) json_object_set_new(set, measures[i].name, json_real(p->set[i]));
    json_object_set_new(o, "set", set);
    return o;
}

static json_t *description(const char *name)
{
    return json_pack("{s:i, s:s, s:s, s:s, s:{s:s, s:s, s:s, s:s, s:s}, s:s, s:[s,s,s]}", "gnathos", 1, "name", name,
                     "units", "mm", "frame", "LPS", "surfaces", "skin", "skin.ply", "skull", "skull.ply", "mandible",
                     "mandible.ply", "upper_teeth", "upper_teeth.ply", "lower_teeth", "lower_teeth.ply", "landmarks",
                     "landmarks.mrk.json", "osteotomies", "le_fort_1", "bsso", "genioplasty");
}

static char *in_folder(const char *folder, const char *file)
{
    size_t size = strlen(folder) + strlen(file) + 2;
    char *path = NEW_ARRAY(char, size);
    snprintf(path, size, "%s/%s", folder, file);
    return path;
}

static bool write_json(json_t *o, const char *folder, const char *file, err *e)
{
    char *path = in_folder(folder, file);
    bool ok = json_file_write(o, path, e);
    free(path);
    json_decref(o);
    return ok;
}

static bool write_measures(const norm_head *h, const char *folder, err *e)
{
    char *path = in_folder(folder, "measures.csv");
    whole_file w;
    bool ok = whole_file_open(path, &w, e);
    free(path);
    if (!ok) return false;
    fprintf(w.stream, "measure,asked,obtained,source,meaning\n");
    for (int i = 0; i < MEASURE_COUNT; i++)
        fprintf(w.stream, "%s,%.3f,%.3f,%s,\"%s\"\n", measures[i].name, h->asked[i], h->obtained[i], measures[i].source,
                measures[i].help);
    return whole_file_close(&w, e);
}

bool norm_case_write(const norm_head *h, const norm_head_params *p, const char *folder, const char *name, err *e)
{
    static const char *const files[] = {"skin.ply", "skull.ply", "mandible.ply", "upper_teeth.ply", "lower_teeth.ply"};
    const surface *const parts[] = {&h->skin, &h->skull, &h->mandible, &h->upper_teeth, &h->lower_teeth};
    for (int i = 0; i < 5; i++) {
        char *path = in_folder(folder, files[i]);
        bool ok = mesh_write_surface(parts[i], path, e);
        free(path);
        if (!ok) return false;
    }
    char *path = in_folder(folder, "landmarks.mrk.json");
    bool ok = landmarks_write(&h->points, path, e);
    free(path);
    return ok && write_json(description(name), folder, "case.json", e) && write_measures(h, folder, e) &&
           (!p || write_json(recipe(p), folder, "recipe.json", e));
}
