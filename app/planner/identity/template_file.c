#include "app/planner/identity/template_file.h"
#include "app/planner/patient/pack_arrays.h"
#include "app/planner/patient/prepared_sound.h"
#include "geometry/mem.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char head_template_numbering[HASH_TEXT_SIZE] = "da2db3cab573d8d210121a94a7019f73ec634035bbdae972c82dd15a97883c7d";

static void hash_ints(content_hash *h, const int32_t *n, int64_t count)
{
    content_hash_number(h, "count", (double)count);
    content_hash_bytes(h, n, (size_t)count * sizeof *n);
}

static void hash_numbering(content_hash *h, const head_template *t)
{
    const tissue *flesh = &t->tissue;
    const attach_map *a = &flesh->attach;
    content_hash_number(h, "version", t->version);
    for (int s = 0; s < CASE_SURFACE_COUNT; s++) {
        content_hash_number(h, case_surface_name((case_surface)s), t->part[s].vertex_count);
        hash_ints(h, t->part[s].tri, 3 * (int64_t)t->part[s].triangle_count);
        if (t->tooth[s]) hash_ints(h, t->tooth[s], t->part[s].vertex_count);
    }
    hash_ints(h, flesh->mesh.tet, 4 * (int64_t)flesh->mesh.tet_count);
    hash_ints(h, flesh->mesh.region, flesh->mesh.tet_count);
    content_hash_bytes(h, flesh->side, (size_t)flesh->mesh.vertex_count);
    content_hash_bytes(h, a->kind, (size_t)a->node_count);
    hash_ints(h, a->segment, a->node_count);
    hash_ints(h, a->pair, 2 * (int64_t)a->pair_count);
    hash_ints(h, t->skin_on_tissue.tet, t->skin_on_tissue.point_count);
    for (int32_t i = 0; i < t->point_count; i++) {
        content_hash_text(h, "point", t->point[i].label);
        hash_ints(h, &t->point[i].part, 1);
        hash_ints(h, &t->point[i].triangle, 1);
    }
}

static void hash_doubles(content_hash *h, const double *x, int64_t count)
{
    content_hash_bytes(h, x, (size_t)count * sizeof *x);
}

void head_template_seal(head_template *t)
{
    t->version = HEAD_TEMPLATE_VERSION;
    content_hash *h = content_hash_start();
    hash_numbering(h, t);
    content_hash_end(h, t->numbering);
    h = content_hash_start();
    content_hash_text(h, "numbering", t->numbering);
    int64_t nodes = t->tissue.mesh.vertex_count;
    for (int s = 0; s < CASE_SURFACE_COUNT; s++) hash_doubles(h, t->part[s].xyz, 3 * (int64_t)t->part[s].vertex_count);
    hash_doubles(h, t->tissue.mesh.xyz, 3 * nodes);
    hash_doubles(h, t->rest, 3 * nodes);
    hash_doubles(h, t->tissue.attach.normal, 3 * nodes);
    hash_doubles(h, t->tissue.attach.pair_normal, 3 * (int64_t)t->tissue.attach.pair_count);
    hash_doubles(h, t->skin_on_tissue.weight, 4 * (int64_t)t->skin_on_tissue.point_count);
    for (int32_t i = 0; i < t->point_count; i++) {
        hash_doubles(h, t->point[i].weight, 3);
        hash_doubles(h, t->point[i].at, 3);
    }
    content_hash_end(h, t->hash);
}

static void tooth_key(int part, char key[PACK_NAME_SIZE])
{
    snprintf(key, PACK_NAME_SIZE, "%s.tooth", case_surface_name((case_surface)part));
}

bool head_template_write(const head_template *t, const char *path, err *e)
{
    pack_file f = {0};
    char key[PACK_NAME_SIZE];
    pack_put(&f, "version", &t->version, sizeof t->version);
    pack_put(&f, "numbering", t->numbering, sizeof t->numbering);
    for (int s = 0; s < CASE_SURFACE_COUNT; s++) {
        pack_put_surface(&f, case_surface_name((case_surface)s), &t->part[s]);
        tooth_key(s, key);
        if (t->tooth[s]) pack_put(&f, key, t->tooth[s], (size_t)t->part[s].vertex_count * sizeof *t->tooth[s]);
    }
    pack_put_tissue(&f, &t->tissue);
    pack_put(&f, "node.rest", t->rest, 3 * (size_t)t->tissue.mesh.vertex_count * sizeof *t->rest);
    pack_put_skin(&f, &t->skin_on_tissue);
    pack_put(&f, "points", t->point, (size_t)t->point_count * sizeof *t->point);
    bool ok = pack_write(&f, path, e);
    pack_free(&f);
    return ok;
}

static bool take(const pack_file *f, head_template *t)
{
    int32_t rest = 0;
    char key[PACK_NAME_SIZE];
    for (int s = 0; s < CASE_SURFACE_COUNT; s++) {
        if (!pack_take_surface(f, case_surface_name((case_surface)s), &t->part[s])) return false;
        if (s < CASE_UPPER_TEETH) continue;
        int32_t count = 0;
        tooth_key(s, key);
        t->tooth[s] = pack_take_array(f, key, sizeof *t->tooth[s], &count);
        if (!t->tooth[s] || count != t->part[s].vertex_count) return false;
    }
    if (!pack_take_tissue(f, &t->tissue) || !pack_take_skin(f, &t->skin_on_tissue)) return false;
    t->rest = pack_take_array(f, "node.rest", 3 * sizeof *t->rest, &rest);
    t->point = pack_take_array(f, "points", sizeof *t->point, &t->point_count);
    return t->rest && rest == t->tissue.mesh.vertex_count && t->point;
}

static bool points_are_sound(const head_template *t)
{
    for (int32_t i = 0; i < t->point_count; i++) {
        const head_point *p = &t->point[i];
        if (!*p->label || !memchr(p->label, 0, sizeof p->label) || p->part < 0 || p->part >= CASE_SURFACE_COUNT ||
            p->triangle < -1 || p->triangle >= t->part[p->part].triangle_count || !all_finite(p->weight, 3) ||
            !all_finite(p->at, 3))
            return false;
    }
    return true;
}

static bool is_sound(const head_template *t)
{
    for (int s = 0; s < CASE_SURFACE_COUNT; s++) {
        const surface *part = &t->part[s];
        if (!part->triangle_count || !surface_is_sound(part) ||
            (t->tooth[s] && !all_within(t->tooth[s], part->vertex_count, 0, part->vertex_count)))
            return false;
    }
    return tissue_is_sound(&t->tissue, NULL) && all_finite(t->rest, 3 * (int64_t)t->tissue.mesh.vertex_count) &&
           embedding_is_sound(&t->skin_on_tissue, t->part[CASE_SKIN].vertex_count, t->tissue.mesh.tet_count) &&
           points_are_sound(t);
}

bool head_template_read(const char *path, head_template *out, err *e)
{
    pack_file f = {0};
    err unreadable = {0};
    if (!pack_read(path, &f, &unreadable)) return err_at(e, ERR_INPUT, path, 0, NULL, "is no whole template of heads");
    head_template t = {0};
    int32_t count = 0, *version = pack_take_array(&f, "version", sizeof *version, &count);
    bool ok = false;
    if (!version || count != 1)
        err_at(e, ERR_INPUT, path, 0, NULL, "is no template of heads");
    else if (*version != HEAD_TEMPLATE_VERSION)
        err_at(e, ERR_INPUT, path, 0, NULL, "is version %d of the template; this gnathos has version %d", *version,
               HEAD_TEMPLATE_VERSION);
    else if (!take(&f, &t) || !is_sound(&t))
        err_at(e, ERR_INPUT, path, 0, NULL, "is a damaged template of heads");
    else
        ok = true;
    if (ok) {
        head_template_seal(&t);
        ok = !strcmp(t.numbering, head_template_numbering) ||
             err_at(e, ERR_INPUT, path, 0, NULL, "has not the numbering of version %d of the template",
                    HEAD_TEMPLATE_VERSION);
    }
    free(version);
    pack_free(&f);
    if (ok)
        *out = t;
    else
        head_template_free(&t);
    return ok;
}
