#include "norm_head.h"
#include "bite.h"
#include "fields.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "fit.h"
#include "sdf.h"
#include "skin_colour.h"
#include "teeth.h"
#include "thickness.h"
#include <stdlib.h>
#include <string.h>

norm_head_params norm_head_params_default(void)
{
    return (norm_head_params){.sex = NORM_FEMALE, .skeletal_class = 1, .coarseness = 1};
}

bool norm_head_params_check(const norm_head_params *p, err *e)
{
    if (p->skeletal_class < 1 || p->skeletal_class > 3)
        return err_set(e, ERR_USAGE, "class %d: there are 1, 2 and 3", p->skeletal_class);
    if (!(p->coarseness >= 1 && p->coarseness <= 3))
        return err_set(e, ERR_USAGE, "coarseness %g: 1 to 3 can be built", p->coarseness);
    if (!(p->open_bite_mm >= 0 && p->open_bite_mm <= 8))
        return err_set(e, ERR_USAGE, "open bite %g mm: 0 to 8 can be built", p->open_bite_mm);
    if (!(fabs(p->asymmetry_mm) <= 12))
        return err_set(e, ERR_USAGE, "asymmetry %g mm: -12 to 12 can be built", p->asymmetry_mm);
    for (int i = 0; i < MEASURE_COUNT; i++)
        if (p->is_set[i] && !(p->set[i] >= measures[i].low && p->set[i] <= measures[i].high))
            return err_set(e, ERR_USAGE, "%s = %g: %g to %g can be built", measures[i].name, p->set[i], measures[i].low,
                           measures[i].high);
    return true;
}

/* The thinnest soft tissue of the tables is that over the bridge of the nose: 3 mm, with a spread. */
static const double skin_least_mm = 2.5;

static void warp_by(const warp *w, surface *s, surface *teeth, const place *list, int count, place_on bone,
                    place_on crowns, landmarks *points)
{
    warp_surface(w, s);
    if (teeth) warp_surface(w, teeth);
    for (int i = 0; i < count; i++) {
        if (list[i].on != bone && list[i].on != crowns) continue;
        double p[3];
        warp_apply(w, list[i].xyz, p);
        landmarks_set(points, list[i].label, p);
    }
}

static surface join_teeth(const tooth *t)
{
    surface all = {0};
    for (int right = 0; right < 2; right++)
        for (int i = 0; i < TEETH_PER_SIDE; i++) {
            surface one = tooth_surface(&t[i], i, right), sum = surface_joined(&all, &one);
            surface_free(&one);
            surface_free(&all);
            all = sum;
        }
    return all;
}

/* How far the lower side teeth must be lowered so that they meet the upper ones: the arches of a class II or
 * III slide along each other and cusps come onto cusps. */
static bool find_bite(const norm_head_params *p, const place *list, int count, const thickness_site *sites,
                      const norm_head *h, double *lowered_mm, err *e)
{
    double lowered = 0;
    for (int round = 0; round < 6; round++) {
        fields f = fields_make(p, list, count, sites, h->asked, lowered);
        surface upper = surface_copy(&h->upper_teeth), lower = surface_copy(&h->lower_teeth);
        warp_surface(&f.up, &upper);
        warp_surface(&f.down, &lower);
        double canine[3], depth = 0;
        warp_apply(&f.up, list[place_number(list, count, "U3_L")].xyz, canine);
        bool ok = fit_overlap(&upper, &lower, canine[1] + 4, &depth, e);
        fields_free(&f);
        surface_free(&upper);
        surface_free(&lower);
        if (!ok) return false;
        if (depth < 0.1) break;
        lowered += depth;
    }
    *lowered_mm = lowered;
    return true;
}

struct norm_mean {
    bodies b;
    norm_head head; /* unwarped; no skin and skull if for the mandible alone */
    place *list;
    int count;
    thickness_site sites[THICKNESS_SITES];
    bool *fold; /* [head.skin.vertex_count] */
};

static bool shape_skin(const norm_mean *m, const fields *f, norm_head *h, err *e)
{
    warp skin = warp_through(&f->skin);
    warp_by(&skin, &h->skin, NULL, m->list, m->count, ON_SKIN, ON_SKIN, &h->points);
    warp_free(&skin);
    const surface *bones[] = {&h->skull, &h->mandible, &h->upper_teeth, &h->lower_teeth};
    return fit_clear(&h->skin, m->fold, bones, 4, skin_least_mm, &h->thinnest_mm, e) &&
           thickness_measure(m->sites, &f->up, &f->down, &h->skull, &h->mandible, &h->skin, h->asked, h->obtained, e);
}

static bool shape(const norm_mean *m, const norm_head_params *p, norm_head *h, err *e)
{
    double lowered = 0;
    if (!find_bite(p, m->list, m->count, m->sites, h, &lowered, e)) return false;
    fields f = fields_make(p, m->list, m->count, m->sites, h->asked, lowered);
    warp_by(&f.up, &h->skull, &h->upper_teeth, m->list, m->count, ON_SKULL, ON_UPPER_TEETH, &h->points);
    warp_by(&f.down, &h->mandible, &h->lower_teeth, m->list, m->count, ON_MANDIBLE, ON_LOWER_TEETH, &h->points);
    bool ok = bite_settle(&h->upper_teeth, &h->lower_teeth, m->list, m->count, &h->points, e) &&
              (!h->skin.triangle_count || shape_skin(m, &f, h, e));
    fields_free(&f);
    return ok;
}

/* Landmarks lie on the shapes, the meshes within a tenth of a millimetre of them: put each onto its mesh. */
static bool onto_mesh(const surface *s, place_on on, const place *list, int count, landmarks *points, err *e)
{
    nearest *tree = NULL;
    if (!nearest_create(s, &tree, e)) return false;
    for (int i = 0; i < count; i++) {
        if (list[i].on != on || !list[i].on_surface) continue;
        double p[3];
        nearest_point(tree, landmarks_find(points, list[i].label)->xyz, p, NULL);
        landmarks_set(points, list[i].label, p);
    }
    nearest_destroy(&tree);
    return true;
}

/* The nostrils of the mean head: their walls are thin by nature. */
static bool *skin_folds(const surface *skin)
{
    bool *fold = NEW_ARRAY(bool, skin->vertex_count);
    for (int i = 0; i < skin->vertex_count; i++) fold[i] = body_skin_fold(skin->xyz + 3 * i);
    return fold;
}

bool norm_mean_build(double coarseness, bool mandible_alone, norm_mean **out, err *e)
{
    norm_mean *m = NEW_ARRAY(norm_mean, 1);
    norm_head *h = &m->head;
    m->b = bodies_build();
    bool ok = (mandible_alone || (body_surface(&m->b, BODY_SKIN, coarseness, &h->skin, e) &&
                                  body_surface(&m->b, BODY_SKULL, coarseness, &h->skull, e))) &&
              body_surface(&m->b, BODY_MANDIBLE, coarseness, &h->mandible, e);
    if (!ok) {
        norm_mean_free(m);
        return false;
    }
    h->upper_teeth = join_teeth(upper_teeth);
    h->lower_teeth = join_teeth(lower_teeth);
    h->skin.rgb = skin_colours(&h->skin);
    m->fold = skin_folds(&h->skin);
    m->count = places_find(&m->b, &m->list);
    thickness_sites(&m->b, m->sites);
    *out = m;
    return true;
}

void norm_mean_free(norm_mean *m)
{
    if (!m) return;
    bodies_free(&m->b);
    norm_head_free(&m->head);
    free(m->list);
    free(m->fold);
    free(m);
}

static void ask(const norm_head_params *p, double asked[MEASURE_COUNT])
{
    norms_draw(p->sex, p->skeletal_class, p->seed, asked);
    if (p->open_bite_mm > 0) {
        asked[OVERBITE_MM] = -p->open_bite_mm;
        asked[FMA_DEG] += 0.8 * p->open_bite_mm;
        asked[LOWER_FACE_MM] += 0.8 * p->open_bite_mm;
    }
    for (int i = 0; i < MEASURE_COUNT; i++)
        if (p->is_set[i]) asked[i] = p->set[i];
}

bool norm_head_shape(const norm_mean *m, const norm_head_params *p, norm_head *out, err *e)
{
    if (!norm_head_params_check(p, e)) return false;
    const norm_head *mean = &m->head;
    norm_head h = {.skin = surface_copy(&mean->skin),
                   .skull = surface_copy(&mean->skull),
                   .mandible = surface_copy(&mean->mandible),
                   .upper_teeth = surface_copy(&mean->upper_teeth),
                   .lower_teeth = surface_copy(&mean->lower_teeth)};
    const struct {
        const surface *on;
        place_on what;
    } carrier[] = {{&h.skin, ON_SKIN},
                   {&h.skull, ON_SKULL},
                   {&h.mandible, ON_MANDIBLE},
                   {&h.upper_teeth, ON_UPPER_TEETH},
                   {&h.lower_teeth, ON_LOWER_TEETH}};
    ask(p, h.asked);
    bool ok = shape(m, p, &h, e), skin = h.skin.triangle_count > 0;
    for (int i = 0; ok && i < 5; i++)
        ok = !carrier[i].on->triangle_count ||
             onto_mesh(carrier[i].on, carrier[i].what, m->list, m->count, &h.points, e);
    for (int i = 0; ok && i < (skin ? GLABELLA_SOFT_MM : NASION_SOFT_MM); i++)
        h.obtained[i] = measure_of((measure_id)i, &h.points);
    if (ok)
        *out = h;
    else
        norm_head_free(&h);
    return ok;
}

bool norm_head_build(const norm_head_params *p, norm_head *out, err *e)
{
    norm_mean *m = NULL;
    if (!norm_head_params_check(p, e) || !norm_mean_build(p->coarseness, false, &m, e)) return false;
    bool ok = norm_head_shape(m, p, out, e);
    norm_mean_free(m);
    return ok;
}

void norm_head_free(norm_head *h)
{
    surface_free(&h->skin);
    surface_free(&h->skull);
    surface_free(&h->mandible);
    surface_free(&h->upper_teeth);
    surface_free(&h->lower_teeth);
    landmarks_free(&h->points);
    *h = (norm_head){0};
}
