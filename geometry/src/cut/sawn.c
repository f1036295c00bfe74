#include "geometry/src/cut/sawn.h"
#include "geometry/boolean.h"
#include "geometry/clock.h"
#include "geometry/handles.h"
#include "geometry/mem.h"
#include "geometry/src/cut/fragments.h"
#include <math.h>
#include <stdio.h>

static const double balance_limit = 1e-3;

void sawn_free(sawn *s)
{
    surface_free(&s->piece);
    surface_free(&s->rest);
    surface_free(&s->kerf);
    cut_report_free(&s->report);
}

/* A sound bone may have handles of its own (teeth that touch, pores of a scan); a cut should add none. */
static bool find_breach(const surface *bone, const cut_bodies *b, sawn *s, err *e)
{
    breach other;
    s->handles = surface_handles(bone);
    s->made = surface_handles(&s->piece) + surface_handles(&s->rest) - s->handles;
    if (s->made <= 0) return true;
    if (!breach_find(&s->piece, &b->inner, &s->where, e) || !breach_find(&s->rest, &b->outer, &other, e)) return false;
    if (other.wide_mm > s->where.wide_mm) s->where = other;
    return true;
}

static bool add_up(const char *name, const cut_balance *volumes, cut_report *r, err *e)
{
    cut_balance c = *volumes;
    snprintf(c.name, sizeof c.name, "%.31s", name);
    c.error_share = fabs(c.piece_mm3 + c.rest_mm3 + c.kerf_mm3 - c.before_mm3) / c.before_mm3;
    r->balance = GROW_ARRAY(cut_balance, r->balance, r->balance_count + 1);
    r->balance[r->balance_count++] = c;
    return c.error_share <= balance_limit ||
           err_set(e, ERR_GEOMETRY, "volumes do not add up: %.1f + %.1f + %.1f of %.1f mm^3", c.piece_mm3, c.rest_mm3,
                   c.kerf_mm3, c.before_mm3);
}

bool sawn_make(const char *name, const cut_bodies *b, segment_id piece_id, segment_id rest_id,
               const osteotomy_params *p, const surface *bone, sawn *s, err *e)
{
    surface shell = {0};
    double start = clock_s();
    bool ok = boolean_apply(&b->outer, &b->hollow, BOOLEAN_DIFFERENCE, &shell, NULL, e) &&
              boolean_apply(bone, &b->inner, BOOLEAN_INTERSECTION, &s->piece, NULL, e) &&
              boolean_apply(bone, &b->outer, BOOLEAN_DIFFERENCE, &s->rest, NULL, e) &&
              boolean_apply(bone, &shell, BOOLEAN_INTERSECTION, &s->kerf, NULL, e);
    surface_free(&shell);
    if (ok && (!s->piece.triangle_count || !s->rest.triangle_count || !s->kerf.triangle_count))
        ok = err_set(e, ERR_GEOMETRY, "the cut misses the bone: nothing is %s",
                     !s->piece.triangle_count  ? "cut off"
                     : !s->rest.triangle_count ? "left"
                                               : "sawn");
    if (ok) {
        const cut_balance volumes = {.before_mm3 = surface_volume(bone),
                                     .piece_mm3 = surface_volume(&s->piece),
                                     .rest_mm3 = surface_volume(&s->rest),
                                     .kerf_mm3 = surface_volume(&s->kerf),
                                     .seconds = clock_s() - start};
        ok = add_up(name, &volumes, &s->report, e);
    }
    s->moved_mm = b->moved_mm;
    ok = ok && fragments_settle(&s->piece, piece_id, &s->rest, rest_id, &s->kerf, p->fragment_mm3, &s->report, e) &&
         (piece_id == SEGMENT_MAXILLA || find_breach(bone, b, s, e));
    return ok || err_prefix(e, "%s", name);
}
