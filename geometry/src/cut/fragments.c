#include "geometry/src/cut/fragments.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "geometry/vec.h"
#include <stdlib.h>

typedef struct shells {
    int32_t count, *of; /* [triangle_count] */
    surface *shell;     /* [count] */
    double *volume;     /* [count] negative: a cavity */
    int32_t *owner;     /* [count] of a cavity: the shell around it; of a shell: itself */
    uint8_t *leaves;    /* [count] */
    int32_t main;       /* largest */
} shells;

static void shells_free(shells *s)
{
    for (int32_t i = 0; i < s->count; i++) surface_free(s->shell + i);
    free(s->of);
    free(s->shell);
    free(s->volume);
    free(s->owner);
    free(s->leaves);
    *s = (shells){0};
}

static bool split(const surface *s, shells *out, err *e)
{
    shells h = {0};
    h.count = surface_components(s, &h.of);
    h.shell = NEW_ARRAY(surface, h.count);
    h.volume = NEW_ARRAY(double, h.count);
    h.owner = NEW_ARRAY(int32_t, h.count);
    h.leaves = NEW_ARRAY(uint8_t, h.count);
    uint8_t *keep = NEW_ARRAY(uint8_t, s->triangle_count);
    for (int32_t i = 0; i < h.count; i++) {
        for (int32_t t = 0; t < s->triangle_count; t++) keep[t] = h.of[t] == i;
        h.shell[i] = surface_select(s, keep);
        h.volume[i] = surface_volume(h.shell + i);
        h.owner[i] = i;
        if (h.volume[i] > h.volume[h.main]) h.main = i;
    }
    free(keep);
    /* A cavity belongs to the smallest shell around it. */
    for (int32_t i = 0; i < h.count; i++) {
        if (h.volume[i] <= 0 || i == h.main) continue;
        nearest *tree = NULL;
        bool any = false;
        for (int32_t k = 0; k < h.count && !any; k++) any = h.volume[k] < 0;
        if (!any) break;
        if (!nearest_create(h.shell + i, &tree, e)) {
            shells_free(&h);
            return false;
        }
        for (int32_t k = 0; k < h.count; k++)
            if (h.volume[k] < 0 && nearest_inside(tree, h.shell[k].xyz) &&
                (h.owner[k] == k || h.volume[i] < h.volume[h.owner[k]]))
                h.owner[k] = i;
        nearest_destroy(&tree);
    }
    for (int32_t k = 0; k < h.count; k++)
        if (h.volume[k] <= 0 && h.owner[k] == k) h.owner[k] = h.main;
    *out = h;
    return true;
}

static double gap(const surface *s, const nearest *tree)
{
    double least = HUGE_VAL;
    for (int32_t v = 0; v < s->vertex_count; v++)
        least = fmin(least, nearest_point(tree, s->xyz + 3 * (size_t)v, NULL, NULL));
    return least;
}

static void judge(shells *mine, segment_id id, const nearest *my_main, segment_id other_id, const nearest *other_main,
                  const nearest *kerf, bool cut_only, double limit_mm3, cut_report *r)
{
    static const double touching_mm = 1e-3; /* islands made by the cut share points with the kerf */
    for (int32_t i = 0; i < mine->count; i++) {
        if (i == mine->main || mine->volume[i] <= 0) continue;
        if (cut_only && gap(mine->shell + i, kerf) > touching_mm) continue;
        double here = gap(mine->shell + i, my_main), there = gap(mine->shell + i, other_main), low[3], high[3];
        mine->leaves[i] = there < here && mine->volume[i] < limit_mm3;
        r->fragment = GROW_ARRAY(cut_fragment, r->fragment, r->fragment_count + 1);
        cut_fragment *f = r->fragment + r->fragment_count++;
        surface_bounds(mine->shell + i, low, high);
        *f = (cut_fragment){.from = id,
                            .to = mine->leaves[i] ? other_id : id,
                            .volume_mm3 = mine->volume[i],
                            .gap_mm = mine->leaves[i] ? there : here};
        for (int c = 0; c < 3; c++) f->centre[c] = (low[c] + high[c]) / 2;
    }
    for (int32_t i = 0; i < mine->count; i++)
        if (mine->owner[i] != i) mine->leaves[i] = mine->leaves[mine->owner[i]];
}

static surface chosen(const surface *s, const shells *h, bool leaving)
{
    uint8_t *keep = NEW_ARRAY(uint8_t, s->triangle_count);
    for (int32_t t = 0; t < s->triangle_count; t++) keep[t] = (h->leaves[h->of[t]] != 0) == leaving;
    surface out = surface_select(s, keep);
    free(keep);
    return out;
}

bool fragments_settle(surface *piece, segment_id piece_id, surface *rest, segment_id rest_id, const surface *kerf,
                      double limit_mm3, cut_report *r, err *e)
{
    shells a = {0}, b = {0};
    nearest *piece_main = NULL, *rest_main = NULL, *saw = NULL;
    bool ok = split(piece, &a, e) && split(rest, &b, e) && nearest_create(a.shell + a.main, &piece_main, e) &&
              nearest_create(b.shell + b.main, &rest_main, e) && nearest_create(kerf, &saw, e);
    if (ok) {
        judge(&a, piece_id, piece_main, rest_id, rest_main, saw, false, limit_mm3, r);
        judge(&b, rest_id, rest_main, piece_id, piece_main, saw, true, limit_mm3, r);
        surface stay_a = chosen(piece, &a, false), go_a = chosen(piece, &a, true), stay_b = chosen(rest, &b, false),
                go_b = chosen(rest, &b, true);
        surface_free(piece);
        surface_free(rest);
        *piece = surface_joined(&stay_a, &go_b);
        *rest = surface_joined(&stay_b, &go_a);
        surface_free(&stay_a);
        surface_free(&go_a);
        surface_free(&stay_b);
        surface_free(&go_b);
    }
    nearest_destroy(&piece_main);
    nearest_destroy(&rest_main);
    nearest_destroy(&saw);
    shells_free(&a);
    shells_free(&b);
    return ok;
}
