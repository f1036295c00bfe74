#include "app/planner/patient/prepared.h"
#include "app/planner/patient/prepared_report.h"
#include "app/planner/patient/prepared_sound.h"
#include "app/planner/store/pack_file.h"
#include "geometry/clock.h"
#include "geometry/mem.h"
#include "geometry/write_whole.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Raise it whenever the way from case to tissue changes, or what is checked: old files are then made anew. */
static const double format = 5;

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
    content_hash_end(h, text);
    return ok;
}

/* ---- to and from the file: every array under its name ---- */

/* As many elements as a count may say; NULL for more. */
static void *take(const pack_file *f, const char *name, size_t element, int32_t *count)
{
    size_t n = 0;
    void *array = pack_take(f, name, element, &n);
    if (array && n > INT32_MAX / 4) {
        free(array);
        return NULL;
    }
    *count = (int32_t)n;
    return array;
}

/* The text of an entry, NULL where it does not end. */
static char *take_text(const pack_file *f, const char *name)
{
    size_t n = 0;
    char *text = pack_take(f, name, 1, &n);
    if (text && (!n || text[n - 1])) {
        free(text);
        return NULL;
    }
    return text;
}

static void put_surface(pack_file *f, const char *name, const surface *s)
{
    char key[PACK_NAME_SIZE];
    snprintf(key, sizeof key, "%.24s.xyz", name);
    pack_put(f, key, s->xyz, 3 * (size_t)s->vertex_count * sizeof *s->xyz);
    snprintf(key, sizeof key, "%.24s.tri", name);
    pack_put(f, key, s->tri, 3 * (size_t)s->triangle_count * sizeof *s->tri);
    snprintf(key, sizeof key, "%.24s.rgb", name);
    if (s->rgb) pack_put(f, key, s->rgb, 3 * (size_t)s->vertex_count);
}

static bool take_surface(const pack_file *f, const char *name, surface *s)
{
    char key[PACK_NAME_SIZE];
    int32_t colours = 0;
    snprintf(key, sizeof key, "%.24s.xyz", name);
    s->xyz = take(f, key, 3 * sizeof *s->xyz, &s->vertex_count);
    snprintf(key, sizeof key, "%.24s.tri", name);
    s->tri = take(f, key, 3 * sizeof *s->tri, &s->triangle_count);
    snprintf(key, sizeof key, "%.24s.rgb", name);
    s->rgb = take(f, key, 3, &colours);
    return s->xyz && s->tri && (!s->rgb || colours == s->vertex_count);
}

static void part_key(int segment, char key[PACK_NAME_SIZE])
{
    snprintf(key, PACK_NAME_SIZE, "part.%s", segment_name((segment_id)segment));
}

static void fill_pack(const prepared *p, const char hash[HASH_TEXT_SIZE], pack_file *f)
{
    const tissue *t = &p->tissue;
    size_t nodes = (size_t)t->mesh.vertex_count, tets = (size_t)t->mesh.tet_count, pairs = (size_t)t->attach.pair_count,
           points = (size_t)p->skin_on_tissue.point_count;
    char key[PACK_NAME_SIZE], *report = json_dumps(p->report, JSON_COMPACT | JSON_REAL_PRECISION(17));
    pack_put(f, "hash", hash, strlen(hash) + 1);
    pack_put(f, "landmarks", p->points.point, (size_t)p->points.count * sizeof *p->points.point);
    pack_put(f, "frame", &p->frame, sizeof p->frame);
    put_surface(f, "skin", &p->skin);
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        part_key(s, key);
        put_surface(f, key, &p->segments.part[s]);
    }
    put_surface(f, "kerf", &p->segments.kerf);
    pack_put(f, "node.xyz", t->mesh.xyz, 3 * nodes * sizeof(double));
    pack_put(f, "tet.node", t->mesh.tet, 4 * tets * sizeof(int32_t));
    pack_put(f, "tet.region", t->mesh.region, tets * sizeof(int32_t));
    pack_put(f, "node.side", t->side, nodes);
    pack_put(f, "node.kind", t->attach.kind, nodes);
    pack_put(f, "node.segment", t->attach.segment, nodes * sizeof(int32_t));
    pack_put(f, "node.normal", t->attach.normal, 3 * nodes * sizeof(double));
    pack_put(f, "pair.node", t->attach.pair, 2 * pairs * sizeof(int32_t));
    pack_put(f, "pair.normal", t->attach.pair_normal, 3 * pairs * sizeof(double));
    pack_put(f, "lips", &t->lips, sizeof t->lips);
    pack_put(f, "skin.tet", p->skin_on_tissue.tet, points * sizeof(int32_t));
    pack_put(f, "skin.weight", p->skin_on_tissue.weight, 4 * points * sizeof(double));
    pack_put(f, "report", report, strlen(report) + 1);
    free(report);
}

static bool take_tissue(const pack_file *f, tissue *t)
{
    int32_t n[7] = {0};
    attach_map *a = &t->attach;
    t->mesh.xyz = take(f, "node.xyz", 3 * sizeof(double), &t->mesh.vertex_count);
    t->mesh.tet = take(f, "tet.node", 4 * sizeof(int32_t), &t->mesh.tet_count);
    t->mesh.region = take(f, "tet.region", sizeof(int32_t), &n[0]);
    t->side = take(f, "node.side", 1, &n[1]);
    a->kind = take(f, "node.kind", 1, &n[2]);
    a->segment = take(f, "node.segment", sizeof(int32_t), &n[3]);
    a->normal = take(f, "node.normal", 3 * sizeof(double), &n[4]);
    a->pair = take(f, "pair.node", 2 * sizeof(int32_t), &a->pair_count);
    a->pair_normal = take(f, "pair.normal", 3 * sizeof(double), &n[5]);
    lip_sheet *lips = take(f, "lips", sizeof *lips, &n[6]);
    bool ok = lips && n[6] == 1;
    if (ok) t->lips = *lips;
    free(lips);
    a->node_count = t->mesh.vertex_count;
    for (int i = 1; i < 5; i++) ok = ok && n[i] == a->node_count;
    return ok && t->mesh.xyz && t->mesh.tet && t->mesh.region && t->side && a->kind && a->segment && a->normal &&
           a->pair && a->pair_normal && n[0] == t->mesh.tet_count && n[5] == a->pair_count;
}

static bool take_pack(const pack_file *f, const char hash[HASH_TEXT_SIZE], prepared *p)
{
    int32_t one = 0, weights = 0;
    char key[PACK_NAME_SIZE], *whose = take_text(f, "hash"), *report = take_text(f, "report");
    bool ok = whose && !strcmp(whose, hash);
    p->points.point = take(f, "landmarks", sizeof *p->points.point, &p->points.count);
    head_frame *frame = take(f, "frame", sizeof *frame, &one);
    ok = ok && frame && one == 1;
    if (ok) p->frame = *frame;
    ok = ok && p->points.point && take_surface(f, "skin", &p->skin) && take_surface(f, "kerf", &p->segments.kerf) &&
         take_tissue(f, &p->tissue);
    for (int s = 0; s < SEGMENT_COUNT; s++) {
        part_key(s, key);
        ok = ok && take_surface(f, key, &p->segments.part[s]);
    }
    p->skin_on_tissue.tet = take(f, "skin.tet", sizeof(int32_t), &p->skin_on_tissue.point_count);
    p->skin_on_tissue.weight = take(f, "skin.weight", 4 * sizeof(double), &weights);
    if (report) p->report = json_loads(report, 0, NULL);
    free(report);
    free(frame);
    free(whose);
    return ok && p->skin_on_tissue.tet && p->skin_on_tissue.weight && weights == p->skin_on_tissue.point_count &&
           p->report && prepared_is_sound(p);
}

static bool make(const case_file *c, const task *watch, prepared *out, err *e)
{
    prepared p = {0};
    anatomy a = {0};
    tissue_report r = {0};
    double start = clock_s();
    if (!anatomy_make(c, true, watch, &a, e)) return false;
    double cut = clock_s();
    task_progress(watch, "meshing the soft tissue", 0.4);
    surface bones = surface_joined(&a.skull, &a.mandible);
    tissue_input in = {&a.closed_skin, &bones, &a.segments, &a.points, &a.frame};
    bool ok = tissue_make(&in, &c->tissue, &p.tissue, &r, e);
    surface_free(&bones);
    if (ok && task_interrupted(watch)) {
        tissue_free(&p.tissue);
        ok = err_set(e, ERR_INTERRUPTED, "interrupted");
    }
    if (ok) {
        p.skin_on_tissue = tissue_carry(&p.tissue, a.skin.xyz, a.skin.vertex_count, skin_reach_mm);
        r.skin_gap_mean_mm = p.skin_on_tissue.mean_gap_mm;
        r.skin_gap_max_mm = p.skin_on_tissue.max_gap_mm;
        p.report = prepared_report(c, &a, &r);
        p.bones_s = cut - start;
        p.tissue_s = clock_s() - cut;
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
    p->bones_s = p->tissue_s = (double)NAN;
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
    if (ok && !make(c, watch, p, e)) {
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
    if (p->report) json_decref(p->report);
    *p = (prepared){0};
}
