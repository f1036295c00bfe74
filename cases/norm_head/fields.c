#include "fields.h"
#include "geometry/mem.h"
#include "geometry/vec.h"
#include "targets.h"
#include <stdlib.h>
#include <string.h>

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

int place_number(const place *list, int count, const char *label)
{
    for (int i = 0; i < count; i++)
        if (!strcmp(list[i].label, label)) return i;
    return -1;
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

fields fields_make(const norm_head_params *p, const place *list, int count, const thickness_site *sites,
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

void fields_free(fields *f)
{
    warp_pairs_free(&f->skin);
    warp_pairs_free(&f->upper);
    warp_pairs_free(&f->lower);
    warp_free(&f->up);
    warp_free(&f->down);
}
