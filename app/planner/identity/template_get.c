#include "app/planner/identity/template_get.h"
#include "app/planner/identity/template_make.h"
#include "app/planner/store/user_cache.h"
#include "cases/norm_head/norm_case.h"
#include "geometry/clock.h"
#include "geometry/write_whole.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Parts of 2,000 to 11,000 vertices and a tissue of about 7,000 nodes: what networks over many identities can carry. */
const double head_template_coarseness = 2;
static const double element_mm = 4, coarse_mm = 12;

/* Every measure in the middle between the means of women and of men, class I. */
static norm_head_params mean_of_all(void)
{
    norm_head_params p = norm_head_params_default();
    p.coarseness = head_template_coarseness;
    for (int i = 0; i < MEASURE_COUNT; i++) {
        p.is_set[i] = true;
        p.set[i] = 0.5 * (measures[i].mean[NORM_FEMALE] + measures[i].mean[NORM_MALE]);
    }
    return p;
}

/* folder: for the mean head's files. */
static bool make_from(const char *folder, const task *watch, head_template *out, err *e)
{
    norm_head_params p = mean_of_all();
    norm_head h = {0};
    case_file c;
    task_progress(watch, "the mean head", 0.05);
    bool ok = norm_head_params_check(&p, e) && norm_head_build(&p, &h, e);
    if (ok && task_interrupted(watch)) ok = err_set(e, ERR_INTERRUPTED, "interrupted");
    ok = ok && norm_case_write(&h, NULL, folder, "template", e) && case_file_load(folder, &c, e);
    norm_head_free(&h);
    if (!ok) return false;
    c.tissue.element_mm = element_mm;
    c.tissue.coarse_mm = coarse_mm;
    return head_template_make(&c, watch, out, e);
}

static const char what[] = "the template of heads", variable[] = "GNATHOS_TEMPLATE";

static bool make_and_keep(const char *path, const task *watch, head_template *out, err *e)
{
    char beside[FIELD_PATH_SIZE + 32];
    whole_folder folder;
    head_template t = {0};
    snprintf(beside, sizeof beside, "%s.%ld", path, (long)getpid());
    if (!user_cache_folders(path, "the template", variable, e) || !whole_folder_open(beside, &folder, e)) return false;
    bool ok = make_from(folder.temporary, watch, &t, e);
    whole_folder_abandon(&folder);
    if (!ok) return err_prefix(e, "making the template of heads");
    head_template_seal(&t);
    if (strcmp(t.numbering, head_template_numbering) != 0)
        ok = err_set(e, ERR_GEOMETRY,
                     "the template of heads comes out with another numbering here, %s, than version %d has; "
                     "copy the file from another machine and name it with GNATHOS_TEMPLATE",
                     t.numbering, HEAD_TEMPLATE_VERSION);
    ok = ok && head_template_write(&t, path, e);
    if (ok)
        *out = t;
    else
        head_template_free(&t);
    return ok;
}

static bool is_there(const char *path) { return !access(path, F_OK); }

static bool find(template_source *s, err *e)
{
    const char *named = getenv(variable);
    int size = sizeof s->path, length;
    s->place = TEMPLATE_NAMED;
    if (named && *named) {
        length = snprintf(s->path, sizeof s->path, "%s", named);
        return length < size || err_set(e, ERR_INPUT, "the path of %s is longer than %d bytes", what, size - 1);
    }
    char file[64];
    s->place = TEMPLATE_INSTALLED;
    snprintf(file, sizeof file, "template-%d.pack", HEAD_TEMPLATE_VERSION);
    snprintf(s->path, sizeof s->path, "%s/%s", GNATHOS_DATA_DIR, file);
    if (is_there(s->path)) return true;
    s->place = TEMPLATE_CACHED;
    return user_cache_path(file, what, variable, s->path, sizeof s->path, e);
}

bool head_template_get(const task *watch, head_template *out, template_source *source, err *e)
{
    template_source s = {0};
    err unreadable = {0};
    if (!find(&s, e)) return false;
    double start = clock_s();
    bool ok = is_there(s.path) && head_template_read(s.path, out, &unreadable);
    s.open_s = clock_s() - start;
    if (!ok && unreadable.code && s.place != TEMPLATE_CACHED) return err_set(e, unreadable.code, "%s", unreadable.text);
    if (!ok) {
        task_note(watch, "%s: %s; it is made, once, in about a minute", s.path,
                  unreadable.code ? "is damaged or of another version" : "the template of heads is not there yet");
        start = clock_s();
        ok = make_and_keep(s.path, watch, out, e);
        s.made = true;
        s.made_s = clock_s() - start;
        if (ok) { /* as it will be found from now on */
            head_template_free(out);
            start = clock_s();
            ok = head_template_read(s.path, out, e);
            s.open_s = clock_s() - start;
        }
    }
    if (ok && source) *source = s;
    return ok;
}
