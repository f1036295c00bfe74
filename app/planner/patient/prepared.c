#include "app/planner/patient/case_guess.h"
#include "app/planner/patient/prepared.h"
#include "app/planner/patient/pack_arrays.h"
#include "app/planner/patient/prepared_report.h"
#include "app/planner/patient/prepared_sound.h"
#include "geometry/mem.h"
#include "geometry/write_whole.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Raise it whenever the way from case to tissue changes, or what is checked: old files are then made anew. */
static const double format = 7;

static const double skin_reach_mm = 2; /* of a skin vertex from the tets that may carry it */

bool prepared_hash(const case_file *c, char text[HASH_TEXT_SIZE], err *e)
{
    content_hash *h = content_hash_start();
    content_hash_number(h, "format", format);
    content_hash_text(h, "version", GNATHOS_VERSION);
    bool ok = true;
    for (int s = 0; s < CASE_SURFACE_COUNT; s++)
        ok = ok && content_hash_file(h, case_surface_name((case_surface)s), c->surface[s], e);
    ok = ok && content_hash_file(h, "landmarks", c->landmarks, e) && content_hash_file(h, "planes", c->planes, e);
    content_hash_number(h, "frame", c->frame);
    content_hash_bytes(h, &c->tissue, sizeof c->tissue);
    content_hash_bytes(h, &c->cuts, sizeof c->cuts);
    for (int i = 0; i < c->osteotomy_count; i++) {
        const case_osteotomy *o = &c->osteotomy[i];
        content_hash_number(h, "cut", o->cut);
        content_hash_text(h, "plane", o->plane);
        content_hash_number(h, "segment", o->segment);
    }
    if (case_guess_is_any(&c->guessed)) { /* what is told of it is kept too */
        json_t *guessed = case_guess_json(&c->guessed);
        char *said = json_dumps(guessed, JSON_COMPACT | JSON_REAL_PRECISION(17));
        content_hash_text(h, "guessed", said);
        free(said);
        json_decref(guessed);
    }
    content_hash_end(h, text);
    return ok;
}

static void part_key(const char *what, int segment, char key[PACK_NAME_SIZE])
{
    snprintf(key, PACK_NAME_SIZE, "%s.%s", what, segment_name((segment_id)segment));
}

static void fill_pack(const prepared *p, const char hash[HASH_TEXT_SIZE], pack_file *f)
{
    char key[PACK_NAME_SIZE], *report = json_dumps(p->report, JSON_COMPACT | JSON_REAL_PRECISION(17));
    pack_put(f, "hash", hash, strlen(hash) + 1);
    pack_put(f, "landmarks", p->points.point, (size_t)p->points.count * sizeof *p->points.point);
    pack_put(f, "frame", &p->frame, sizeof p->frame);
    pack_put_surface(f, "skin", &p->skin);
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        part_key("part", s, key);
        pack_put_surface(f, key, &p->segments.part[s]);
        part_key("field", s, key);
        pack_put_samples(f, key, &p->fields.part[s]);
    }
    pack_put_surface(f, "kerf", &p->segments.kerf);
    pack_put_tissue(f, &p->tissue);
    pack_put_skin(f, &p->skin_on_tissue);
    pack_put(f, "report", report, strlen(report) + 1);
    free(report);
}

static bool take_pack(const pack_file *f, const char hash[HASH_TEXT_SIZE], prepared *p)
{
    int32_t one = 0;
    char key[PACK_NAME_SIZE], *whose = pack_text(f, "hash"), *report = pack_text(f, "report");
    bool ok = whose && !strcmp(whose, hash);
    p->points.point = pack_take_array(f, "landmarks", sizeof *p->points.point, &p->points.count);
    head_frame *frame = pack_take_array(f, "frame", sizeof *frame, &one);
    ok = ok && frame && one == 1;
    if (ok) p->frame = *frame;
    ok = ok && p->points.point && pack_take_surface(f, "skin", &p->skin) &&
         pack_take_surface(f, "kerf", &p->segments.kerf) && pack_take_tissue(f, &p->tissue);
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        part_key("part", s, key);
        ok = ok && pack_take_surface(f, key, &p->segments.part[s]);
        part_key("field", s, key);
        ok = ok && pack_take_samples(f, key, &p->fields.part[s]);
    }
    if (report) p->report = json_loads(report, 0, NULL);
    free(report);
    free(frame);
    free(whose);
    return ok && pack_take_skin(f, &p->skin_on_tissue) && p->report && prepared_is_sound(p);
}

bool prepared_make(const case_file *c, const task *watch, prepared *out, err *e)
{
    prepared p = {0};
    anatomy a = {0};
    tissue_report r = {0};
    if (!anatomy_make(c, true, watch, &a, e)) return false;
    task_progress(watch, "meshing the soft tissue", 0.4);
    surface bones = surface_joined(&a.skull, &a.mandible);
    tissue_input in = {&a.closed_skin, &bones, &a.segments, &a.points, &a.frame};
    bool ok = tissue_make(&in, &c->tissue, &p.tissue, &r, e);
    surface_free(&bones);
    if (ok && task_interrupted(watch)) ok = err_set(e, ERR_INTERRUPTED, "interrupted");
    clock_span begin = clock_now();
    ok = ok && bone_fields_make(&a.segments, &p.tissue, &p.fields, e);
    p.stages = (prepared_stages){a.check_span, a.repair_span, a.cut_span,       r.distances,
                                 r.mesh,       r.attachment,  clock_lap(&begin)};
    if (!ok) tissue_free(&p.tissue);
    if (ok) {
        p.skin_on_tissue = tissue_carry(&p.tissue, a.skin.xyz, a.skin.vertex_count, skin_reach_mm);
        r.skin_gap_mean_mm = p.skin_on_tissue.mean_gap_mm;
        r.skin_gap_max_mm = p.skin_on_tissue.max_gap_mm;
        p.report = prepared_report(c, &a, &r);
        p.frame = a.frame;
        p.points = a.points;
        p.skin = a.skin;
        p.segments = a.segments;
        a.points = (landmarks){0};
        a.skin = (surface){0};
        a.segments = (segments){0};
        *out = p;
    }
    anatomy_free(&a);
    return ok;
}

static bool read_kept(const char *path, const char hash[HASH_TEXT_SIZE], prepared *p)
{
    pack_file f = {0};
    err unreadable = {0};
    if (!pack_read(path, &f, &unreadable)) return false;
    p->reused = take_pack(&f, hash, p);
    pack_free(&f);
    if (!p->reused) prepared_free(p);
    return p->reused;
}

/* The file is opened before the work: what would hinder writing it is told at once. */
static bool make_and_keep(const case_file *c, const char *folder, const char *path, const char hash[HASH_TEXT_SIZE],
                          const task *watch, prepared *p, err *e)
{
    whole_file file;
    pack_file f = {0};
    bool made = !mkdir(folder, 0777);
    if (!made && errno != EEXIST)
        return err_at(e, ERR_RESOURCE, folder, 0, NULL,
                      "cannot be made (%s); --cache names another folder for what is prepared once", strerror(errno));
    bool ok = whole_file_open(path, &file, e);
    if (ok && !prepared_make(c, watch, p, e)) {
        whole_file_abandon(&file);
        ok = false;
    } else if (ok) {
        fill_pack(p, hash, &f);
        ok = pack_write_into(&f, &file, e);
        pack_free(&f);
        if (!ok) prepared_free(p);
    }
    if (!ok && made) rmdir(folder);
    return ok;
}

bool prepared_get(const case_file *c, const char *cache, const task *watch, prepared *out, err *e)
{
    char hash[HASH_TEXT_SIZE], folder[FIELD_PATH_SIZE + 16], path[FIELD_PATH_SIZE + 64];
    if (!prepared_hash(c, hash, e)) return false;
    snprintf(folder, sizeof folder, "%s%s", cache ? cache : c->folder, cache ? "" : "/prepared");
    snprintf(path, sizeof path, "%s/%.16s.pack", folder, hash);
    prepared p = {0};
    if (!read_kept(path, hash, &p) && !make_and_keep(c, folder, path, hash, watch, &p, e)) return false;
    memcpy(p.hash, hash, sizeof hash);
    *out = p;
    return true;
}

void prepared_free(prepared *p)
{
    landmarks_free(&p->points);
    surface_free(&p->skin);
    segments_free(&p->segments);
    tissue_free(&p->tissue);
    embedding_free(&p->skin_on_tissue);
    bone_fields_free(&p->fields);
    if (p->report) json_decref(p->report);
    *p = (prepared){0};
}
