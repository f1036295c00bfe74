#include "places.h"
#include "geometry/mem.h"
#include "sdf.h"
#include "teeth.h"
#include <stdio.h>
#include <string.h>

/* Where a landmark is looked for: from `guess`, on the surface, as far as possible along `direction` within
 * `reach` (0: the nearest point). x == 0 keeps it in the midline, else it is there on both sides. */
typedef struct search {
    const char *label;
    body_id body;
    double guess[3], direction[3], reach;
} search;

static const search searches[] = {{"N", BODY_SKULL, {0, -87, 26}, {0, 1, 0}, 4},
                                  {"Or", BODY_SKULL, {30, -81, 0}, {0, 0, 0}, 0},
                                  {"Po", BODY_SKULL, {58, -1, 0}, {0, 0, 0}, 0},
                                  {"Ba", BODY_SKULL, {0, -2.5, -20}, {0, 0, -1}, 3},
                                  {"ANS", BODY_SKULL, {0, -90, -24}, {0, -1, 0}, 3},
                                  {"PNS", BODY_SKULL, {0, -38, -25}, {0, 1, 0}, 3},
                                  {"A", BODY_SKULL, {0, -87, -31}, {0, 1, 0}, 4},
                                  {"PR", BODY_SKULL, {12.3, -82.5, -19}, {0, 0, 0}, 0},
                                  {"ZB", BODY_SKULL, {38, -67, -21.5}, {0, 0, 0}, 0},
                                  {"PM", BODY_SKULL, {24, -37, -22.5}, {0, 0, 0}, 0},
                                  {"IOF", BODY_SKULL, {26, -80, -8.3}, {0, 0, 0}, 0},
                                  {"Zy", BODY_SKULL, {62, -34, -1}, {1, 0, 0}, 12},
                                  {"Co", BODY_MANDIBLE, {49.5, -10.8, 0.4}, {0, 0, 1}, 5},
                                  {"Cor", BODY_MANDIBLE, {44.3, -39.6, -8}, {0, 0, 1}, 5},
                                  {"SN", BODY_MANDIBLE, {46, -25, -18}, {0, 0, -1}, 2},
                                  {"Go", BODY_MANDIBLE, {44.5, -12, -58}, {0, 0.85, -0.53}, 9},
                                  {"RP", BODY_MANDIBLE, {44, -8.5, -39}, {0, 1, 0}, 2},
                                  {"RA", BODY_MANDIBLE, {42, -42, -42}, {0, -1, 0}, 2},
                                  {"Li", BODY_MANDIBLE, {39.6, -24, -33.5}, {0, 0, 0}, 0},
                                  {"B", BODY_MANDIBLE, {0, -83, -66}, {0, 1, 0}, 5},
                                  {"Pog", BODY_MANDIBLE, {0, -83, -78}, {0, -1, 0}, 5},
                                  {"Gn", BODY_MANDIBLE, {0, -80, -84}, {0, -0.707, -0.707}, 6},
                                  {"Me", BODY_MANDIBLE, {0, -76, -86.5}, {0, 0, -1}, 6},
                                  {"MF", BODY_MANDIBLE, {25.8, -68.5, -67.8}, {0, 0, 0}, 0},
                                  {"G'", BODY_SKIN, {0, -96, 38}, {0, 0, 0}, 0},
                                  {"N'", BODY_SKIN, {0, -93, 25}, {0, 1, 0}, 3},
                                  {"Pn", BODY_SKIN, {0, -114.5, -17}, {0, -1, 0}, 6},
                                  {"Sn", BODY_SKIN, {0, -99, -30}, {0, 0, 0}, 0},
                                  {"Al", BODY_SKIN, {16.4, -98, -21.5}, {1, 0, 0}, 5},
                                  {"A'", BODY_SKIN, {0, -97.5, -36}, {0, 1, 0}, 3},
                                  {"Ls", BODY_SKIN, {0, -101, -44}, {0, -1, 0}, 4},
                                  {"Stm", BODY_SKIN, {0, -96, -50.2}, {0, 1, 0}, 2},
                                  {"Li_soft", BODY_SKIN, {0, -99, -55}, {0, -1, 0}, 4},
                                  {"B'", BODY_SKIN, {0, -93, -67}, {0, 1, 0}, 4},
                                  {"Pg'", BODY_SKIN, {0, -95, -78}, {0, -1, 0}, 5},
                                  {"Gn'", BODY_SKIN, {0, -89, -91}, {0, -0.707, -0.707}, 6},
                                  {"Me'", BODY_SKIN, {0, -77, -94.5}, {0, 0, -1}, 6},
                                  {"C", BODY_SKIN, {0, -36, -88}, {0, 0.707, 0.707}, 8},
                                  {"Ch", BODY_SKIN, {25, -87, -50.8}, {0, 0, 0}, 0},
                                  {"En", BODY_SKIN, {16, -82, 14}, {0, 0, 0}, 0},
                                  {"Ex", BODY_SKIN, {44, -79, 14}, {0, 0, 0}, 0},
                                  {"Zy'", BODY_SKIN, {67, -31, 0}, {0, 0, 0}, 0},
                                  {"Go'", BODY_SKIN, {54, -12, -62}, {0, 0, 0}, 0},
                                  {"T", BODY_SKIN, {69, -4, 4}, {0, 0, 0}, 0}};

void place_project(const bodies *b, body_id id, bool midline, double p[3])
{
    for (int i = 0; i < 20; i++) {
        double n[3], d = body_distance(b, id, p);
        if (fabs(d) < 1e-6) return;
        body_normal(b, id, p, n);
        if (midline) n[0] = 0;
        vec_normalize(n);
        vec_axpy(p, -0.9 * d, n, p);
    }
}

static void look(const bodies *b, const search *s, double p[3])
{
    bool midline = s->guess[0] == 0;
    vec_copy(s->guess, p);
    place_project(b, s->body, midline, p);
    double start[3];
    vec_copy(p, start);
    for (double step = 0.8; s->reach > 0 && step > 0.02; step *= 0.7) {
        for (int i = 0; i < 60; i++) {
            double n[3], q[3], t[3];
            body_normal(b, s->body, p, n);
            vec_axpy(s->direction, -vec_dot(s->direction, n), n, t);
            if (midline) t[0] = 0;
            if (vec_normalize(t) < 1e-3) break;
            vec_axpy(p, step, t, q);
            place_project(b, s->body, midline, q);
            if (vec_dot(q, s->direction) <= vec_dot(p, s->direction) + 1e-4 || vec_distance(q, start) > s->reach) break;
            vec_copy(q, p);
        }
    }
}

static void add(place **list, int *count, const char *label, int side, place_on on, bool visible, const double p[3])
{
    *list = GROW_ARRAY(place, *list, *count + 1);
    place *q = &(*list)[(*count)++];
    *q = (place){.on = on, .on_surface = visible};
    /* the prime of a soft-tissue point comes before the side: Zy'_L */
    snprintf(q->label, sizeof q->label, "%s%s", label, side == 0 ? "" : side > 0 ? "_L" : "_R");
    vec_copy(p, q->xyz);
    if (side < 0) q->xyz[0] = -q->xyz[0];
}

static void add_both(place **list, int *count, const char *label, place_on on, bool visible, const double p[3])
{
    add(list, count, label, 1, on, visible, p);
    add(list, count, label, -1, on, visible, p);
}

static void add_tooth(place **list, int *count, const char *label, place_on on, const tooth *t, double along,
                      double outer, double mesial)
{
    double p[3];
    tooth_point(t, along, outer, mesial, false, p);
    add_both(list, count, label, on, true, p);
}

static void add_incisors(place **list, int *count, const char *edge, const char *apex, place_on on, const tooth *t)
{
    double p[3];
    tooth_point(t, 0, 0, 0, false, p);
    p[0] = 0;
    add(list, count, edge, 0, on, false, p);
    tooth_point(t, t->crown_mm + t->root_mm, 0, 0, false, p);
    p[0] = 0;
    add(list, count, apex, 0, on, false, p);
}

int places_find(const bodies *b, place **out)
{
    place *list = NULL;
    int count = 0;
    static const place_on carrier[BODY_COUNT] = {ON_SKIN, ON_SKULL, ON_MANDIBLE};
    for (size_t i = 0; i < sizeof searches / sizeof searches[0]; i++) {
        double p[3];
        look(b, &searches[i], p);
        place_on on = carrier[searches[i].body];
        if (searches[i].guess[0] == 0)
            add(&list, &count, searches[i].label, 0, on, true, p);
        else
            add_both(&list, &count, searches[i].label, on, true, p);
    }
    static const double sella[3] = {0, -21.3, 18};
    add(&list, &count, "S", 0, ON_SKULL, false, sella);
    add_incisors(&list, &count, "U1", "U1_apex", ON_UPPER_TEETH, &upper_teeth[0]);
    add_incisors(&list, &count, "L1", "L1_apex", ON_LOWER_TEETH, &lower_teeth[0]);
    const tooth *u = upper_teeth, *l = lower_teeth;
    add_tooth(&list, &count, "U3", ON_UPPER_TEETH, &u[2], 0, 0, 0);
    add_tooth(&list, &count, "U6", ON_UPPER_TEETH, &u[5], 0, 0.27 * u[5].depth_mm, 0.23 * u[5].width_mm);
    add_tooth(&list, &count, "L3", ON_LOWER_TEETH, &l[2], 0, 0, 0);
    add_tooth(&list, &count, "L6", ON_LOWER_TEETH, &l[5], 0, 0.27 * l[5].depth_mm, 0.23 * l[5].width_mm);
    add_tooth(&list, &count, "L7", ON_LOWER_TEETH, &l[6], 1.5, 0.36 * l[6].depth_mm, -0.40 * l[6].width_mm);
    *out = list;
    return count;
}
