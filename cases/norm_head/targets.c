#include "targets.h"
#include "geometry/vec.h"
#include <assert.h>
#include <stdio.h>
#include <string.h>

typedef struct plan_points { /* what the steps below share */
    const place *places;
    int count;
    double *to;
    bool *held;
    double scale[3];
} plan_points;

static int find(const plan_points *t, const char *label)
{
    for (int i = 0; i < t->count; i++)
        if (!strcmp(t->places[i].label, label)) return i;
    assert(!"a landmark of the mean head");
    return -1;
}

/* Where it is before its measures speak: the mean head at the size of the sex. */
static double base(const plan_points *t, const char *label, int axis)
{
    return t->places[find(t, label)].xyz[axis] * t->scale[axis];
}
static double *point(const plan_points *t, const char *label) { return t->to + 3 * find(t, label); }
static double moved(const plan_points *t, const char *label, int axis)
{
    return point(t, label)[axis] - base(t, label, axis);
}

/* Sagittal position of a midline point, or of a pair. */
static void hold(plan_points *t, const char *label, double y, double z)
{
    int i = find(t, label);
    t->to[3 * i + 1] = y;
    t->to[3 * i + 2] = z;
    t->held[i] = true;
}
static void hold_pair(plan_points *t, const char *label, double half_width, double y, double z)
{
    for (int side = 1; side >= -1; side -= 2) {
        char name[LANDMARK_LABEL_SIZE];
        snprintf(name, sizeof name, "%s_%c", label, side > 0 ? 'L' : 'R');
        point(t, name)[0] = side * half_width;
        hold(t, name, y, z);
    }
}
static void shift(plan_points *t, const char *label, double y, double z)
{
    hold(t, label, base(t, label, 1) + y, base(t, label, 2) + z);
}
static void shift_pair(plan_points *t, const char *label, double out, double y, double z)
{
    char name[LANDMARK_LABEL_SIZE];
    snprintf(name, sizeof name, "%s_L", label);
    hold_pair(t, label, base(t, name, 0) + out, base(t, name, 1) + y, base(t, name, 2) + z);
}

static double radians(double deg) { return deg * M_PI / 180; }

static void upper_jaw(plan_points *t, const double *v)
{
    const double *s = point(t, "S");
    double sn = radians(v[SN_FH_DEG]), n[2] = {s[1] - v[SN_MM] * cos(sn), s[2] + v[SN_MM] * sin(sn)};
    hold(t, "S", s[1], s[2]);
    hold(t, "N", n[0], n[1]);
    /* A lies on the ray that leaves N at SNA below the line to S, as far below ANS as in the mean head */
    double ans_z = n[1] - v[N_ANS_MM], a_z = ans_z + base(t, "A", 2) - base(t, "ANS", 2);
    double ray = radians(v[SNA_DEG] + v[SN_FH_DEG]); /* from straight back, turning down */
    double a_y = n[0] + (n[1] - a_z) * cos(ray) / sin(ray);
    hold(t, "A", a_y, a_z);
    double ans_y = a_y + base(t, "ANS", 1) - base(t, "A", 1), palate = radians(v[PALATE_SN_DEG] - v[SN_FH_DEG]);
    hold(t, "ANS", ans_y, ans_z);
    hold(t, "PNS", ans_y + v[ANS_PNS_MM] * cos(palate), ans_z + v[ANS_PNS_MM] * sin(palate));
    /* incisor: with the jaw, the edge forwards as it leans */
    double lean = radians(v[U1_FH_DEG] - 90),
           lean0 = atan2(base(t, "U1_apex", 1) - base(t, "U1", 1), base(t, "U1_apex", 2) - base(t, "U1", 2));
    double length = hypot(base(t, "U1_apex", 1) - base(t, "U1", 1), base(t, "U1_apex", 2) - base(t, "U1", 2));
    double u_y = a_y + base(t, "U1", 1) - base(t, "A", 1) - 0.45 * length * (sin(lean) - sin(lean0));
    double u_z = ans_z - (v[U1_PALATE_MM] - (u_y - ans_y) * sin(palate)) / cos(palate);
    hold(t, "U1", u_y, u_z);
    hold(t, "U1_apex", u_y + length * sin(lean), u_z + length * cos(lean));
    double jaw_y = moved(t, "A", 1);
    double c_y = base(t, "U3_L", 1) + 0.5 * (moved(t, "U1", 1) + jaw_y), c_z = base(t, "U3_L", 2) + moved(t, "U1", 2);
    hold_pair(t, "U3", v[INTERCANINE_MM] / 2, c_y, c_z);
    double m_y = base(t, "U6_L", 1) + jaw_y;
    hold_pair(t, "U6", v[INTERMOLAR_MM] / 2, m_y,
              ans_z - (v[U6_PALATE_MM] - (m_y - ans_y) * sin(palate)) / cos(palate));
    double wide = v[PIRIFORM_MM] / 2;
    hold_pair(t, "PR", wide, base(t, "PR_L", 1) + moved(t, "ANS", 1), base(t, "PR_L", 2) + moved(t, "ANS", 2));
    shift_pair(t, "ZB", 0, 0.6 * jaw_y, 0.7 * moved(t, "ANS", 2));
    shift_pair(t, "PM", 0, moved(t, "PNS", 1), moved(t, "PNS", 2));
    shift_pair(t, "Or", 0, 0.5 * moved(t, "N", 1), 0);
    shift_pair(t, "Po", 0, 0, 0);
    shift(t, "Ba", 0, 0);
    hold_pair(t, "Zy", v[BIZYGOMATIC_MM] / 2, base(t, "Zy_L", 1), base(t, "Zy_L", 2));
}

static void lower_jaw(plan_points *t, const double *v, double lower_molars_mm)
{
    const double *n = point(t, "N"), *u1 = point(t, "U1");
    double l_y = u1[1] + v[OVERJET_MM], l_z = u1[2] + v[OVERBITE_MM];
    hold(t, "L1", l_y, l_z);
    double gn_z = point(t, "ANS")[2] - v[LOWER_FACE_MM];
    double me_z = gn_z + base(t, "Me", 2) - base(t, "Gn", 2);
    double share = (base(t, "B", 2) - base(t, "L1", 2)) / (base(t, "Gn", 2) - base(t, "L1", 2));
    double b_z = l_z + share * (gn_z - l_z);
    double ray = radians(v[SNB_DEG] + v[SN_FH_DEG]), b_y = n[1] + (n[2] - b_z) * cos(ray) / sin(ray);
    hold(t, "B", b_y, b_z);
    share = (base(t, "Pog", 2) - base(t, "L1", 2)) / (base(t, "Gn", 2) - base(t, "L1", 2));
    double pog_z = l_z + share * (gn_z - l_z), plane = radians(v[FMA_DEG]);
    double pog_y = b_y - (v[CHIN_MM] - (b_z - pog_z) * sin(plane)) / cos(plane);
    hold(t, "Pog", pog_y, pog_z);
    hold(t, "Gn", pog_y + base(t, "Gn", 1) - base(t, "Pog", 1), gn_z);
    double me_y = pog_y + base(t, "Me", 1) - base(t, "Pog", 1);
    hold(t, "Me", me_y, me_z);
    /* gonion: on the mandibular plane through Me, at the length of the body from Pog */
    double d[2] = {me_y - pog_y, me_z - pog_z}, along = d[0] * cos(plane) + d[1] * sin(plane);
    double root = sqrt(fmax(along * along - (d[0] * d[0] + d[1] * d[1] - v[GO_POG_MM] * v[GO_POG_MM]), 0));
    double reach = root - along;
    hold_pair(t, "Go", v[BIGONIAL_MM] / 2, me_y + reach * cos(plane), me_z + reach * sin(plane));
    shift_pair(t, "Co", 0, 0, 0);
    /* incisor axis against the plane: IMPA is measured behind the tooth */
    double length = hypot(base(t, "L1_apex", 1) - base(t, "L1", 1), base(t, "L1_apex", 2) - base(t, "L1", 2));
    double axis = plane + radians(v[IMPA_DEG] - 90); /* leaning forwards from upright */
    hold(t, "L1_apex", l_y + length * sin(axis), l_z - length * cos(axis));
    double body_y = 0.5 * (moved(t, "L1", 1) + moved(t, "B", 1));
    shift_pair(t, "L3", 0.5 * (point(t, "U3_L")[0] - base(t, "U3_L", 0)), 0.7 * moved(t, "L1", 1) + 0.3 * body_y, 0);
    point(t, "L3_L")[2] = point(t, "L3_R")[2] = base(t, "L3_L", 2) + moved(t, "L1", 2) - 0.5 * lower_molars_mm;
    double molar_out = point(t, "U6_L")[0] - base(t, "U6_L", 0);
    shift_pair(t, "L6", molar_out, body_y, moved(t, "U6_L", 2) - lower_molars_mm);
    shift_pair(t, "L7", molar_out, body_y, moved(t, "U6_L", 2) - lower_molars_mm);
}

static void face(plan_points *t, const double *v)
{
    const double *n = point(t, "N"), *a = point(t, "A"), *u1 = point(t, "U1"), *l1 = point(t, "L1");
    const double *b = point(t, "B"), *pog = point(t, "Pog"), *me = point(t, "Me");
    hold(t, "N'", n[1] - v[NASION_SOFT_MM], base(t, "N'", 2) + moved(t, "N", 2));
    double sn_y = a[1] - v[SUBNASALE_SOFT_MM], sn_z = base(t, "Sn", 2) + moved(t, "ANS", 2);
    hold(t, "Sn", sn_y, sn_z);
    double d[2] = {base(t, "Pn", 1) - base(t, "Sn", 1), base(t, "Pn", 2) - base(t, "Sn", 2)},
           size = v[NOSE_MM] / hypot(d[0], d[1]);
    hold(t, "Pn", sn_y + size * d[0], sn_z + size * d[1]);
    hold_pair(t, "Al", v[NASAL_WIDTH_MM] / 2, base(t, "Al_L", 1) + moved(t, "Sn", 1),
              base(t, "Al_L", 2) + moved(t, "Sn", 2));
    double ls_y = u1[1] - v[UPPER_LIP_SOFT_MM], li_y = l1[1] - v[LOWER_LIP_SOFT_MM];
    double stm_z = sn_z - v[UPPER_LIP_MM], stm_move = stm_z - base(t, "Stm", 2);
    double ls_move = ls_y - base(t, "Ls", 1), li_move = li_y - base(t, "Li_soft", 1);
    hold(t, "Ls", ls_y, base(t, "Ls", 2) + 0.3 * moved(t, "Sn", 2) + 0.7 * stm_move);
    hold(t, "Stm", base(t, "Stm", 1) + 0.5 * (ls_move + li_move), stm_z);
    hold(t, "Li_soft", li_y, base(t, "Li_soft", 2) + 0.8 * stm_move + 0.2 * moved(t, "L1", 2));
    hold_pair(t, "Ch", v[MOUTH_MM] / 2, base(t, "Ch_L", 1) + 0.45 * (ls_move + li_move), base(t, "Ch_L", 2) + stm_move);
    hold(t, "B'", b[1] - v[SUPRAMENTAL_SOFT_MM], base(t, "B'", 2) + moved(t, "B", 2));
    hold(t, "Pg'", pog[1] - v[POGONION_SOFT_MM], base(t, "Pg'", 2) + moved(t, "Pog", 2));
    hold(t, "Me'", base(t, "Me'", 1) + moved(t, "Me", 1), me[2] - v[MENTON_SOFT_MM]);
    shift(t, "Gn'", 0.5 * (moved(t, "Pg'", 1) + moved(t, "Me'", 1)), 0.5 * (moved(t, "Pg'", 2) + moved(t, "Me'", 2)));
    shift(t, "C", 0.5 * moved(t, "Me", 1), 0.5 * moved(t, "Me", 2));
    double zy = v[BIZYGOMATIC_MM] / 2 - base(t, "Zy_L", 0);
    shift_pair(t, "T", 0.5 * zy, 0, 0);
    shift_pair(t, "En", 0, 0.5 * moved(t, "N", 1), 0);
    shift_pair(t, "Ex", 0, 0.3 * moved(t, "N", 1), 0);
}

/* The jaw swings: the chin goes `chin_mm` to the left, points nearer to the joints less; the right ramus is
 * longer. */
static void swing(plan_points *t, double chin_mm)
{
    double joint = point(t, "Co_L")[1], me = point(t, "Me")[1];
    static const char *const soft[] = {"B'", "Pg'", "Gn'", "Me'"};
    static const char *const partly[] = {"Li_soft", "Stm", "Ch_L", "Ch_R", "C"};
    for (int i = 0; i < t->count; i++) {
        const place *p = &t->places[i];
        double share = (joint - t->to[3 * i + 1]) / (joint - me), part = 0;
        if (p->on == ON_MANDIBLE || p->on == ON_LOWER_TEETH) part = fmax(share, 0);
        for (size_t k = 0; k < sizeof soft / sizeof *soft; k++)
            if (!strcmp(p->label, soft[k])) part = share;
        for (size_t k = 0; k < sizeof partly / sizeof *partly; k++)
            if (!strcmp(p->label, partly[k])) part = 0.5 * share;
        t->to[3 * i] += part * chin_mm;
    }
    double cant = 0.25 * chin_mm;
    point(t, "Go_R")[2] -= cant;
    point(t, "Go_L")[2] += cant;
}

void targets_scale(norm_sex sex, double scale[3])
{
    /* Howells, male over female: breadth 1.045, length 1.05, height 1.07 */
    static const double male[3] = {1.045, 1.05, 1.07};
    for (int c = 0; c < 3; c++) scale[c] = sex == NORM_MALE ? male[c] : 1;
}

void targets_find(const place *places, int count, const norm_head_params *p, const double value[MEASURE_COUNT],
                  double lower_molars_mm, double *to, bool *held)
{
    plan_points t = {.places = places, .count = count, .to = to, .held = held};
    targets_scale(p->sex, t.scale);
    for (int i = 0; i < count; i++) {
        held[i] = false;
        for (int c = 0; c < 3; c++) to[3 * i + c] = places[i].xyz[c] * t.scale[c];
    }
    upper_jaw(&t, value);
    lower_jaw(&t, value, lower_molars_mm);
    face(&t, value);
    if (p->asymmetry_mm != 0) swing(&t, p->asymmetry_mm);
}
