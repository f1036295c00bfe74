#include "app/planner/identity/template_get.h"
#include "app/planner/identity/template_make.h"
#include "cases/norm_head/norm_case.h"
#include "geometry/clock.h"
#include "geometry/write_whole.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Parts of 2,000 to 11,000 vertices and a tissue of about 7,000 nodes: what networks over many identities can carry. */
static const double coarseness = 2, element_mm = 4, coarse_mm = 12;

/* Every measure in the middle between the means of women and of men, class I. */
static norm_head_params mean_of_all(void)
{
    norm_head_params p = norm_head_params_default();
    p.coarseness = coarseness;
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

/* Makes every folder of the path that is not there, but not its last part. */
static bool make_folders(const char *path, err *e)
{
    char part[FIELD_PATH_SIZE];
    for (const char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        snprintf(part, sizeof part, "%.*s", (int)(slash - path), path);
        struct stat there;
        if (mkdir(part, 0777) && (errno != EEXIST || stat(part, &there) || !S_ISDIR(there.st_mode)))
            return err_at(e, ERR_RESOURCE, part, 0, NULL,
                          "cannot be made as a folder (%s); GNATHOS_TEMPLATE names another file for the template",
                          strerror(errno));
    }
    return true;
}

static bool make_and_keep(const char *path, const task *watch, head_template *out, err *e)
{
    char beside[FIELD_PATH_SIZE + 32];
    whole_folder folder;
    head_template t = {0};
    snprintf(beside, sizeof beside, "%s.%ld", path, (long)getpid());
    if (!make_folders(path, e) || !whole_folder_open(beside, &folder, e)) return false;
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
    const char *named = getenv("GNATHOS_TEMPLATE"), *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int size = sizeof s->path, length;
    s->place = TEMPLATE_NAMED;
    if (named && *named) {
        length = snprintf(s->path, sizeof s->path, "%s", named);
    } else {
        s->place = TEMPLATE_INSTALLED;
        length = snprintf(s->path, sizeof s->path, "%s/template-%d.pack", GNATHOS_DATA_DIR, HEAD_TEMPLATE_VERSION);
        if (is_there(s->path)) return true;
        s->place = TEMPLATE_CACHED;
        bool xdg = cache && cache[0] == '/'; /* a relative one is to be ignored, says the specification of XDG */
        if (!xdg && !(home && *home))
            return err_set(e, ERR_RESOURCE,
                           "no place to keep the template of heads: neither GNATHOS_TEMPLATE, "
                           "XDG_CACHE_HOME nor HOME is set");
        length = snprintf(s->path, sizeof s->path, "%s%s/gnathos/template-%d.pack", xdg ? cache : home,
                          xdg ? "" : "/.cache", HEAD_TEMPLATE_VERSION);
    }
    return length < size ||
           err_set(e, ERR_INPUT, "the path of the template of heads is longer than %d bytes", size - 1);
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
