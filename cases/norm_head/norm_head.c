#include "norm_head.h"
#include "bite.h"
#include "geometry/mem.h"
#include "geometry/nearest.h"
#include "fit.h"
#include "geometry/vec.h"
#include "sdf.h"
#include "skin_colour.h"
#include "targets.h"
#include "teeth.h"
#include "thickness.h"
#include "warp.h"
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

/* Points of a body that only take the size of the sex: what is far from the jaws stays in proportion. */
static void add_anchors(warp_pairs *w, const double (*point)[3], int count, const double scale[3])
{
    for (int i = 0; i < count; i++)
        for (int side = 1; side >= (point[i][0] == 0 ? 1 : -1); side -= 2) {
            double from[3] = {side * point[i][0], point[i][1], point[i][2]}, to[3];
            for (int c = 0; c < 3; c++) to[c] = from[c] * scale[c];
            warp_add(w, from, to);
        }
}

static const double skull_anchors[][3] = {{0, -88, 66},  {0, -55, 103}, {0, 10, 113}, {0, 82, 50},
                                          {0, 40, -20},  {60, 0, 60},   {55, 40, 10}, {38, -76, 60},
                                          {50, -63, 28}, {54, 10, -26}, {48, -11, 4}, {46, -64, -8}};
static const double mandible_anchors[][3] = {{44.3, -39.6, -8}};
static const double skin_anchors[][3] = {{0, -94, 68},  {0, -62, 107}, {0, 8, 119},    {0, 88, 55},
                                         {0, 70, -20},  {70, 0, 60},   {66, 45, 20},   {44, -78, 60},
                                         {52, -72, 30}, {66, -28, 30}, {31, -88, 14},  {45, -80, -3},
                                         {75, 20, 30},  {76, 10, -22}, {0, -30, -150}, {0, 60, -150}};

/* Where men differ beyond size and measures: the neck. */
typedef struct dimorphic {
    double at[3], male_shift[3];
} dimorphic;
static const dimorphic skin_dimorphic[] = {{{46, 10, -150}, {6, 0, 0}}, {{46, 13, -95}, {5, 0, 0}}};

static void add_dimorphic(warp_pairs *w, const dimorphic *list, int count, norm_sex sex, const double scale[3])
{
    for (int i = 0; i < count; i++)
        for (int side = 1; side >= -1; side -= 2) {
            double from[3], to[3];
            vec_copy(list[i].at, from);
            for (int c = 0; c < 3; c++) to[c] = from[c] * scale[c] + (sex == NORM_MALE ? list[i].male_shift[c] : 0);
            from[0] *= side;
            to[0] *= side;
            warp_add(w, from, to);
        }
}

static int place_number(const place *list, int count, const char *label)
{
    for (int i = 0; i < count; i++)
        if (!strcmp(list[i].label, label)) return i;
    return -1;
}

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

/* The skin over the jaws follows the bone under it: these points take a share of what their landmarks do. */
typedef struct follower {
    double at[3];
    struct {
        const char *label;
        double share;
    } of[3];
} follower;

static const follower followers[] = {{{40, -78, -32}, {{"A", 0.3}, {"L1", 0.25}, {NULL, 0}}},
                                     {{36, -80, -50}, {{"U1", 0.2}, {"L1", 0.3}, {"B", 0.2}}},
                                     {{24, -86, -72}, {{"B", 0.5}, {"Pog", 0.5}, {NULL, 0}}},
                                     {{26, -77, -86}, {{"Me", 0.9}, {"Go_L", 0.1}, {NULL, 0}}}};

static void add_followers(warp_pairs *w, const place *list, int count, const double *to, const double scale[3])
{
    for (size_t i = 0; i < sizeof followers / sizeof *followers; i++)
        for (int side = 1; side >= -1; side -= 2) {
            const follower *f = &followers[i];
            double from[3] = {side * f->at[0], f->at[1], f->at[2]}, goal[3];
            for (int c = 0; c < 3; c++) goal[c] = from[c] * scale[c];
            for (int k = 0; k < 3 && f->of[k].label; k++) {
                char label[LANDMARK_LABEL_SIZE];
                strcpy(label, f->of[k].label);
                char *hand = strstr(label, "_L");
                if (hand && side < 0) hand[1] = 'R';
                int n = place_number(list, count, label);
                double move[3];
                for (int c = 0; c < 3; c++) move[c] = to[3 * n + c] - list[n].xyz[c] * scale[c];

                vec_axpy(goal, f->of[k].share, move, goal);
            }
            warp_add(w, from, goal);
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

typedef struct fields { /* the pairs of the three warps */
    warp_pairs skin, upper, lower;
    warp up, down; /* through the last two */
} fields;

static fields make_fields(const norm_head_params *p, const place *list, int count, const thickness_site *sites,
                          const double *asked, double lower_molars_mm)
{
    double *to = NEW_ARRAY(double, 3 * count), scale[3];
    bool *held = NEW_ARRAY(bool, count);
    targets_find(list, count, p, asked, lower_molars_mm, to, held);
    targets_scale(p->sex, scale);
    fields f = {0};
    for (int i = 0; i < count; i++) {
        if (!held[i]) continue;
        place_on on = list[i].on;
        warp_add(on == ON_SKIN                            ? &f.skin
                 : on == ON_SKULL || on == ON_UPPER_TEETH ? &f.upper
                                                          : &f.lower,
                 list[i].xyz, to + 3 * i);
    }
#define ANCHORS(w, a) add_anchors(w, a, (int)(sizeof(a) / sizeof *(a)), scale)
    ANCHORS(&f.upper, skull_anchors);
    ANCHORS(&f.lower, mandible_anchors);
    ANCHORS(&f.skin, skin_anchors);
    add_dimorphic(&f.skin, skin_dimorphic, 2, p->sex, scale);
    add_followers(&f.skin, list, count, to, scale);
    f.up = warp_through(&f.upper);
    f.down = warp_through(&f.lower);
    thickness_targets(sites, &f.up, &f.down, asked, &f.skin);
    free(to);
    free(held);
    return f;
}

static void free_fields(fields *f)
{
    warp_pairs_free(&f->skin);
    warp_pairs_free(&f->upper);
    warp_pairs_free(&f->lower);
    warp_free(&f->up);
    warp_free(&f->down);
}

/* How far the lower side teeth must be lowered so that they meet the upper ones: the arches of a class II or
 * III slide along each other and cusps come onto cusps. */
static bool find_bite(const norm_head_params *p, const place *list, int count, const thickness_site *sites,
                      const norm_head *h, double *lowered_mm, err *e)
{
    double lowered = 0;
    for (int round = 0; round < 6; round++) {
        fields f = make_fields(p, list, count, sites, h->asked, lowered);
        surface upper = surface_copy(&h->upper_teeth), lower = surface_copy(&h->lower_teeth);
        warp_surface(&f.up, &upper);
        warp_surface(&f.down, &lower);
        double canine[3], depth = 0;
        warp_apply(&f.up, list[place_number(list, count, "U3_L")].xyz, canine);
        bool ok = fit_overlap(&upper, &lower, canine[1] + 4, &depth, e);
        free_fields(&f);
        surface_free(&upper);
        surface_free(&lower);
        if (!ok) return false;
        if (depth < 0.1) break;
        lowered += depth;
    }
    *lowered_mm = lowered;
    return true;
}

static bool shape(const norm_head_params *p, const place *list, int count, const thickness_site *sites,
                  const bool *exempt, norm_head *h, err *e)
{
    double lowered = 0;
    if (!find_bite(p, list, count, sites, h, &lowered, e)) return false;
    fields f = make_fields(p, list, count, sites, h->asked, lowered);
    warp_by(&f.up, &h->skull, &h->upper_teeth, list, count, ON_SKULL, ON_UPPER_TEETH, &h->points);
    warp_by(&f.down, &h->mandible, &h->lower_teeth, list, count, ON_MANDIBLE, ON_LOWER_TEETH, &h->points);
    if (!bite_settle(&h->upper_teeth, &h->lower_teeth, list, count, &h->points, e)) {
        free_fields(&f);
        return false;
    }
    warp skin = warp_through(&f.skin);
    warp_by(&skin, &h->skin, NULL, list, count, ON_SKIN, ON_SKIN, &h->points);
    warp_free(&skin);
    const surface *bones[] = {&h->skull, &h->mandible, &h->upper_teeth, &h->lower_teeth};
    bool ok = fit_clear(&h->skin, exempt, bones, 4, skin_least_mm, &h->thinnest_mm, e) &&
              thickness_measure(sites, &f.up, &f.down, &h->skull, &h->mandible, &h->skin, h->asked, h->obtained, e);
    free_fields(&f);
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

bool norm_head_build(const norm_head_params *p, norm_head *out, err *e)
{
    if (!norm_head_params_check(p, e)) return false;
    norm_head h = {0};
    norms_draw(p->sex, p->skeletal_class, p->seed, h.asked);
    if (p->open_bite_mm > 0) {
        h.asked[OVERBITE_MM] = -p->open_bite_mm;
        h.asked[FMA_DEG] += 0.8 * p->open_bite_mm;
        h.asked[LOWER_FACE_MM] += 0.8 * p->open_bite_mm;
    }
    for (int i = 0; i < MEASURE_COUNT; i++)
        if (p->is_set[i]) h.asked[i] = p->set[i];
    bodies b = bodies_build();
    bool ok = body_surface(&b, BODY_SKIN, p->coarseness, &h.skin, e) &&
              body_surface(&b, BODY_SKULL, p->coarseness, &h.skull, e) &&
              body_surface(&b, BODY_MANDIBLE, p->coarseness, &h.mandible, e);
    if (ok) {
        h.upper_teeth = join_teeth(upper_teeth);
        h.lower_teeth = join_teeth(lower_teeth);
        h.skin.rgb = skin_colours(&h.skin);
        place *list = NULL;
        int count = places_find(&b, &list);
        thickness_site sites[THICKNESS_SITES];
        thickness_sites(&b, sites);
        bool *exempt = skin_folds(&h.skin);
        ok = shape(p, list, count, sites, exempt, &h, e) && onto_mesh(&h.skin, ON_SKIN, list, count, &h.points, e) &&
             onto_mesh(&h.skull, ON_SKULL, list, count, &h.points, e) &&
             onto_mesh(&h.mandible, ON_MANDIBLE, list, count, &h.points, e) &&
             onto_mesh(&h.upper_teeth, ON_UPPER_TEETH, list, count, &h.points, e) &&
             onto_mesh(&h.lower_teeth, ON_LOWER_TEETH, list, count, &h.points, e);
        for (int i = 0; ok && i < GLABELLA_SOFT_MM; i++) h.obtained[i] = measure_of((measure_id)i, &h.points);
        free(list);
        free(exempt);
    }
    bodies_free(&b);
    if (ok)
        *out = h;
    else
        norm_head_free(&h);
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
