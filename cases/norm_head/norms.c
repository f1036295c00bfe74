#include "norms.h"
#include "geometry/vec.h"
#include <assert.h>
#include <string.h>

/* COGS: Burstone 1978; Arnett 1999; Howells: craniometric series, European; 3DFN: Weinberg 2016; T-Table:
 * Stephan and Simpson 2008. Class shifts: surgical means of ANB 6.5 (II) and -3.5 degrees (III) with the
 * usual dental compensation. */
const measure measures[MEASURE_COUNT] = {
    [SN_MM] = {"sn_mm", "sella to nasion", "cephalometric atlases", {67, 72}, {2.5, 2.8}, {0, 0}, 58, 82},
    [SN_FH_DEG] =
        {"sn_fh_deg", "anterior cranial base to Frankfort", "cephalometric atlases", {7, 7}, {2, 2}, {0, 0}, 2, 13},
    [SNA_DEG] = {"sna_deg", "maxilla to cranial base", "Steiner", {82, 82}, {2, 2}, {0, -1.5}, 72, 90},
    [SNB_DEG] = {"snb_deg", "mandible to cranial base", "Steiner", {80, 80}, {2, 2}, {-4.5, 4}, 70, 90},
    [N_ANS_MM] = {"n_ans_mm", "upper face height", "COGS", {50, 54.7}, {2.4, 3.2}, {0, 0}, 42, 64},
    [LOWER_FACE_MM] =
        {"lower_face_mm", "lower face height, ANS to gnathion", "COGS", {61.3, 68.6}, {3.3, 3.8}, {0, 1.5}, 50, 84},
    [ANS_PNS_MM] = {"ans_pns_mm", "length of the palate", "COGS", {52.6, 57.7}, {2.5, 2.5}, {0, -1}, 44, 66},
    [PALATE_SN_DEG] =
        {"palate_sn_deg", "palate to cranial base", "cephalometric atlases", {8, 8}, {2, 2}, {0, 0}, 2, 15},
    [FMA_DEG] = {"fma_deg", "mandibular plane to Frankfort", "Tweed", {25, 25}, {3, 3}, {2, 1}, 14, 40},
    [GO_POG_MM] = {"go_pog_mm", "mandibular body", "COGS", {74.3, 83.7}, {4, 4.6}, {-3, 4}, 60, 98},
    [CHIN_MM] = {"chin_mm", "B to pogonion along the mandibular plane", "COGS", {7.2, 8.9}, {1.5, 1.7}, {0, 0}, 2, 15},
    [U1_FH_DEG] = {"u1_fh_deg", "upper incisor to Frankfort", "Jarabak", {111, 111}, {4, 4}, {-1, 5}, 95, 128},
    [U1_PALATE_MM] = {"u1_palate_mm", "upper incisor edge to palate", "COGS", {27.5, 30.5}, {1.7, 2.1}, {0, 0}, 21, 37},
    [U6_PALATE_MM] = {"u6_palate_mm", "upper molar cusp to palate", "COGS", {23, 26.2}, {1.3, 2}, {0, 0}, 18, 32},
    [IMPA_DEG] = {"impa_deg", "lower incisor to mandibular plane", "Tweed", {90, 90}, {4, 4}, {4, -7}, 72, 108},
    [OVERJET_MM] = {"overjet_mm",
                    "upper incisor edge in front of the lower",
                    "Arnett",
                    {3.2, 3.2},
                    {0.4, 0.6},
                    {4.3, -6.2},
                    -9,
                    12},
    [OVERBITE_MM] =
        {"overbite_mm", "vertical overlap of the incisors", "Arnett", {3.2, 3.2}, {0.7, 0.7}, {0.6, -1.7}, -8, 7},
    [BIZYGOMATIC_MM] =
        {"bizygomatic_mm", "breadth of the arches", "Howells", {125.4, 134.4}, {4, 4.3}, {0, 0}, 110, 150},
    [BIGONIAL_MM] =
        {"bigonial_mm", "breadth at the angles of the jaw", "forensic series", {92, 99}, {5, 5.5}, {0, 0}, 76, 118},
    [PIRIFORM_MM] =
        {"piriform_mm", "breadth of the nasal aperture", "Howells", {24.6, 25.4}, {1.8, 1.7}, {0, 0}, 18, 31},
    [INTERCANINE_MM] = {"intercanine_mm", "upper canine cusps", "arch series", {33.8, 35}, {1.6, 1.8}, {0, 0}, 28, 41},
    [INTERMOLAR_MM] = {"intermolar_mm", "upper first molar cusps", "arch series", {51, 53}, {2.4, 2.6}, {0, 0}, 43, 61},
    [NASION_SOFT_MM] = {"nasion_soft_mm", "soft tissue at nasion", "T-Table", {6.2, 6.6}, {0.6, 0.6}, {0, 0}, 5, 11},
    [SUBNASALE_SOFT_MM] =
        {"subnasale_soft_mm", "subnasale in front of A", "T-Table", {12.5, 14}, {1.5, 1.7}, {0, 0.5}, 8, 19},
    [UPPER_LIP_SOFT_MM] = {"upper_lip_soft_mm",
                           "labrale superius in front of the upper incisor",
                           "T-Table",
                           {11, 12},
                           {1.2, 1.3},
                           {-1, 1.2},
                           7,
                           17},
    [LOWER_LIP_SOFT_MM] = {"lower_lip_soft_mm",
                           "labrale inferius in front of the lower incisor",
                           "T-Table",
                           {12, 13.5},
                           {1.2, 1.3},
                           {1.8, -1.8},
                           8,
                           19},
    [SUPRAMENTAL_SOFT_MM] =
        {"supramental_soft_mm", "soft tissue at B", "T-Table", {11, 11.5}, {1.1, 1.2}, {0.8, 0}, 7, 17},
    [POGONION_SOFT_MM] =
        {"pogonion_soft_mm", "soft tissue at pogonion", "Arnett", {11.5, 12.5}, {1.4, 1.8}, {0, 0}, 7, 18},
    [MENTON_SOFT_MM] =
        {"menton_soft_mm", "soft tissue below menton", "Arnett", {7.4, 8.8}, {1.2, 1.3}, {0, 0}, 4.5, 13},
    [NOSE_MM] = {"nose_mm", "subnasale to pronasale", "3DFN", {20, 21}, {1.5, 1.7}, {0, 0}, 14, 27},
    [UPPER_LIP_MM] = {"upper_lip_mm", "subnasale to stomion, vertical", "3DFN", {20.3, 22.6}, {1.8, 2}, {0, 0}, 14, 29},
    [MOUTH_MM] = {"mouth_mm", "cheilion to cheilion", "3DFN", {47.9, 50.1}, {2.8, 3}, {0, 0}, 38, 60},
    [NASAL_WIDTH_MM] = {"nasal_width_mm", "alare to alare", "3DFN", {32.7, 35.9}, {2, 2.3}, {0, 0}, 26, 44},
    /* spreads half of the tables': a smooth face has no room for independent quarters of each depth */
    [GLABELLA_SOFT_MM] =
        {"glabella_soft_mm", "soft tissue over glabella", "T-Table", {5.4, 5.5}, {0.5, 0.5}, {0, 0}, 3.5, 8},
    [MID_NASAL_SOFT_MM] = {"mid_nasal_soft_mm",
                           "soft tissue over the middle of the nasal bones",
                           "T-Table",
                           {4, 4.3},
                           {0.3, 0.3},
                           {0, 0},
                           3.2,
                           6},
    [RHINION_SOFT_MM] = {"rhinion_soft_mm",
                         "soft tissue over rhinion, the end of the nasal bones",
                         "T-Table",
                         {3.1, 3.4},
                         {0.2, 0.2},
                         {0, 0},
                         2.8,
                         5},
    [MID_PHILTRUM_SOFT_MM] = {"mid_philtrum_soft_mm",
                              "soft tissue over the middle of the philtrum",
                              "T-Table",
                              {11, 12.2},
                              {0.5, 0.5},
                              {0, 0},
                              8,
                              16},
    [MID_SUPRAORBITAL_SOFT_MM] = {"mid_supraorbital_soft_mm",
                                  "soft tissue over the upper rim of the orbit",
                                  "T-Table",
                                  {6, 6.3},
                                  {0.5, 0.5},
                                  {0, 0},
                                  4,
                                  9},
    [MID_INFRAORBITAL_SOFT_MM] = {"mid_infraorbital_soft_mm",
                                  "soft tissue over the lower rim of the orbit",
                                  "T-Table",
                                  {6.5, 6.8},
                                  {0.6, 0.6},
                                  {0, 0},
                                  4,
                                  10},
    [ALAR_CURVATURE_SOFT_MM] = {"alar_curvature_soft_mm",
                                "soft tissue over the crease beside the wing of the nose",
                                "T-Table",
                                {9.5, 10.2},
                                {0.8, 0.8},
                                {0, 0},
                                6,
                                14},
    [ZYGION_SOFT_MM] =
        {"zygion_soft_mm", "soft tissue over the cheekbone's arch", "T-Table", {5.8, 6.2}, {0.6, 0.6}, {0, 0}, 4, 9},
    [SUPRA_CANINE_SOFT_MM] = {"supra_canine_soft_mm",
                              "soft tissue over the root of the upper canine",
                              "T-Table",
                              {9.5, 10.4},
                              {0.8, 0.8},
                              {0, 0},
                              6.5,
                              14},
    [INFRA_CANINE_SOFT_MM] = {"infra_canine_soft_mm",
                              "soft tissue over the root of the lower canine",
                              "T-Table",
                              {10, 11},
                              {0.8, 0.8},
                              {0, 0},
                              7,
                              14.5},
    [SUPRA_M2_SOFT_MM] = {"supra_m2_soft_mm",
                          "soft tissue over the upper second molar",
                          "T-Table",
                          {25.5, 26.5},
                          {1.5, 1.5},
                          {0, 0},
                          19,
                          33},
    [INFRA_M2_SOFT_MM] = {"infra_m2_soft_mm",
                          "soft tissue over the lower second molar",
                          "T-Table",
                          {17.5, 19.5},
                          {1.5, 1.5},
                          {0, 0},
                          13,
                          26},
    [MID_RAMUS_SOFT_MM] = {"mid_ramus_soft_mm",
                           "soft tissue over the middle of the ramus",
                           "T-Table",
                           {15.5, 17.5},
                           {1.5, 1.5},
                           {0, 0},
                           11,
                           24},
    [GONION_SOFT_MM] = {"gonion_soft_mm", "soft tissue over gonion", "T-Table", {9.5, 11}, {1.2, 1.2}, {0, 0}, 8, 18},
    [MID_BORDER_SOFT_MM] = {"mid_border_soft_mm",
                            "soft tissue over the lower border of the mandible, halfway",
                            "T-Table",
                            {10, 11.5},
                            {1.2, 1.2},
                            {0, 0},
                            8,
                            18},
};

int measure_find(const char *name)
{
    for (int i = 0; i < MEASURE_COUNT; i++)
        if (!strcmp(measures[i].name, name)) return i;
    return -1;
}

static const double *at(const landmarks *l, const char *label)
{
    const landmark *p = landmarks_find(l, label);
    assert(p);
    return p->xyz;
}

/* Angle at b between the rays to a and c in the sagittal plane, degrees. */
static double angle_at(const double a[3], const double b[3], const double c[3])
{
    double u[2] = {a[1] - b[1], a[2] - b[2]}, v[2] = {c[1] - b[1], c[2] - b[2]};
    return fabs(atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])) * 180 / M_PI;
}

/* Slope of the line from a back to b against Frankfort, degrees; positive if it rises going back. */
static double slope(const double a[3], const double b[3]) { return atan2(b[2] - a[2], b[1] - a[1]) * 180 / M_PI; }

static void middle(const landmarks *l, const char *left, const char *right, double out[3])
{
    vec_add(at(l, left), at(l, right), out);
    vec_scale(out, 0.5, out);
}

static double width(const landmarks *l, const char *left, const char *right)
{
    return at(l, left)[0] - at(l, right)[0];
}

/* Distance of p below the palatal line. */
static double below_palate(const landmarks *l, const double p[3])
{
    const double *ans = at(l, "ANS"), *pns = at(l, "PNS");
    double y = pns[1] - ans[1], z = pns[2] - ans[2], n = hypot(y, z);
    return (z * (p[1] - ans[1]) - y * (p[2] - ans[2])) / n;
}

double measure_of(measure_id id, const landmarks *l)
{
    double go[3], u6[3];
    middle(l, "Go_L", "Go_R", go);
    middle(l, "U6_L", "U6_R", u6);
    const double *n = at(l, "N"), *s = at(l, "S"), *ans = at(l, "ANS"), *pns = at(l, "PNS"), *a = at(l, "A");
    const double *b = at(l, "B"), *pog = at(l, "Pog"), *me = at(l, "Me"), *u1 = at(l, "U1"), *l1 = at(l, "L1");
    double plane = slope(me, go) * M_PI / 180;
    switch (id) {
    case SN_MM: return hypot(n[1] - s[1], n[2] - s[2]);
    case SN_FH_DEG: return atan2(n[2] - s[2], s[1] - n[1]) * 180 / M_PI;
    case SNA_DEG: return angle_at(s, n, a);
    case SNB_DEG: return angle_at(s, n, b);
    case N_ANS_MM: return n[2] - ans[2];
    case LOWER_FACE_MM: return ans[2] - at(l, "Gn")[2];
    case ANS_PNS_MM: return hypot(pns[1] - ans[1], pns[2] - ans[2]);
    case PALATE_SN_DEG: return atan2(n[2] - s[2], s[1] - n[1]) * 180 / M_PI + slope(ans, pns);
    case FMA_DEG: return slope(me, go);
    case GO_POG_MM: return hypot(pog[1] - go[1], pog[2] - go[2]);
    case CHIN_MM: return (b[1] - pog[1]) * cos(plane) + (b[2] - pog[2]) * sin(plane);
    case U1_FH_DEG:
        return 180 - slope(u1, at(l, "U1_apex")) > 90 ? 180 - slope(u1, at(l, "U1_apex")) : slope(u1, at(l, "U1_apex"));
    case U1_PALATE_MM: return below_palate(l, u1);
    case U6_PALATE_MM: return below_palate(l, u6);
    case IMPA_DEG:
        return 180 - angle_at((double[3]){0, me[1] - cos(plane), me[2] - sin(plane)}, me,
                              (double[3]){0, me[1] + l1[1] - at(l, "L1_apex")[1], me[2] + l1[2] - at(l, "L1_apex")[2]});
    case OVERJET_MM: return l1[1] - u1[1];
    case OVERBITE_MM: return l1[2] - u1[2];
    case BIZYGOMATIC_MM: return width(l, "Zy_L", "Zy_R");
    case BIGONIAL_MM: return width(l, "Go_L", "Go_R");
    case PIRIFORM_MM: return width(l, "PR_L", "PR_R");
    case INTERCANINE_MM: return width(l, "U3_L", "U3_R");
    case INTERMOLAR_MM: return width(l, "U6_L", "U6_R");
    case NASION_SOFT_MM: return n[1] - at(l, "N'")[1];
    case SUBNASALE_SOFT_MM: return a[1] - at(l, "Sn")[1];
    case UPPER_LIP_SOFT_MM: return u1[1] - at(l, "Ls")[1];
    case LOWER_LIP_SOFT_MM: return l1[1] - at(l, "Li_soft")[1];
    case SUPRAMENTAL_SOFT_MM: return b[1] - at(l, "B'")[1];
    case POGONION_SOFT_MM: return pog[1] - at(l, "Pg'")[1];
    case MENTON_SOFT_MM: return me[2] - at(l, "Me'")[2];
    case NOSE_MM: return hypot(at(l, "Pn")[1] - at(l, "Sn")[1], at(l, "Pn")[2] - at(l, "Sn")[2]);
    case UPPER_LIP_MM: return at(l, "Sn")[2] - at(l, "Stm")[2];
    case MOUTH_MM: return width(l, "Ch_L", "Ch_R");
    case NASAL_WIDTH_MM: return width(l, "Al_L", "Al_R");
    default: break;
    }
    assert(!"a measure of landmarks");
    return 0;
}

/* splitmix64 (Steele, Lea, Flood 2014), then Box and Muller. */
static uint64_t next(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static double normal(uint64_t *state)
{
    for (;;) { /* within two standard deviations */
        double u = ((double)(next(state) >> 11) + 0.5) / 9007199254740992.0;
        double v = ((double)(next(state) >> 11) + 0.5) / 9007199254740992.0;
        double g = sqrt(-2 * log(u)) * cos(2 * M_PI * v);
        if (fabs(g) < 2) return g;
    }
}

/* Depths that go together (Lebanese adults, Forensic Science International 2018). */
static const struct {
    int of, with;
    double r;
} related[] = {{LOWER_LIP_SOFT_MM, UPPER_LIP_SOFT_MM, 0.763}, {MENTON_SOFT_MM, POGONION_SOFT_MM, 0.784}};

void norms_draw(norm_sex sex, int skeletal_class, uint64_t seed, double value[MEASURE_COUNT])
{
    uint64_t state = seed;
    double drawn[MEASURE_COUNT];
    for (int i = 0; i < MEASURE_COUNT; i++) {
        const measure *m = &measures[i];
        double shift = skeletal_class > 1 ? m->class_shift[skeletal_class - 2] : 0;
        drawn[i] = seed ? normal(&state) : 0;
        for (size_t k = 0; k < sizeof related / sizeof *related; k++)
            if (related[k].of == i)
                drawn[i] = related[k].r * drawn[related[k].with] + sqrt(1 - related[k].r * related[k].r) * drawn[i];
        value[i] = m->mean[sex] + shift + m->sd[sex] * fmax(-2, fmin(drawn[i], 2));
        value[i] = fmin(fmax(value[i], m->low), m->high);
    }
}
