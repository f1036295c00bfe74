/* Two pictures: error over time with the front of the best, error over the size of the tets with its slopes.
 */
#include "app/study/spots.h"
#include <math.h>
#include <plplot/plplot.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { INK = 1, FIRST_SERIES = 2, FRONT = FIRST_SERIES + SERIES };
static const int shade[][3] = {{255, 255, 255}, {30, 30, 30},   {31, 119, 180}, {214, 96, 20},
                               {44, 140, 60},   {130, 90, 170}, {31, 119, 180}, {200, 30, 40}};
static const struct {
    const char *text, *mark;
} series[SERIES] = {{"meshes, plain tets", "●"},
                    {"averaged volumes", "▲"},
                    {"tolerances", "■"},
                    {"loads, parts left out", "◆"},
                    {"one mesh halved: off", "○"}};

static void set_colours(void)
{
    int rgb[3][sizeof shade / sizeof *shade], count = sizeof shade / sizeof *shade;
    for (int i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) rgb[c][i] = shade[i][c];
    plscmap0(rgb[0], rgb[1], rgb[2], count);
}

typedef struct picture {
    double x0, x1, y0, y1; /* log10 */
} picture;

static picture frame_of(const spot *s, int count)
{
    picture p = {HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < count; i++) {
        p.x0 = fmin(p.x0, log10(s[i].x));
        p.x1 = fmax(p.x1, log10(s[i].x));
        p.y0 = fmin(p.y0, log10(s[i].y));
        p.y1 = fmax(p.y1, log10(s[i].y));
    }
    double wide = fmax(p.x1 - p.x0, 0.3), high = fmax(p.y1 - p.y0, 0.3);
    return (picture){p.x0 - 0.1 * wide, p.x1 + 0.18 * wide, p.y0 - 0.16 * high, p.y1 + 0.12 * high};
}

/* Ticks and numbers at round values: PLplot labels powers of ten alone, and a study spans hardly two. */
static void line(double x0, double y0, double x1, double y1)
{
    double x[2] = {x0, x1}, y[2] = {y0, y1};
    plline(2, x, y);
}

static void axis(const picture *p, bool across)
{
    static const double steps[3][8] = {{1, 1.2, 1.5, 2, 3, 4, 5, 7}, {1, 2, 5}, {1}};
    double low = across ? p->x0 : p->y0, high = across ? p->x1 : p->y1;
    int kind = high - low < 0.9 ? 0 : high - low < 4 ? 1 : 2;
    plschr(0, 0.8);
    for (int decade = (int)floor(low); decade <= (int)ceil(high); decade++)
        for (int k = 0; k < 8 && steps[kind][k] > 0; k++) {
            double value = steps[kind][k] * pow(10, decade), at = log10(value);
            char text[32];
            if (at < low || at > high) continue;
            snprintf(text, sizeof text, "%g", value);
            if (across) {
                plmtex("b", 1.6, (at - low) / (high - low), 0.5, text);
                line(at, p->y0, at, p->y0 + 0.012 * (p->y1 - p->y0));
            } else {
                plmtex("lv", 1, (at - low) / (high - low), 1, text);
                line(p->x0, at, p->x0 + 0.008 * (p->x1 - p->x0), at);
            }
        }
}

static void begin(const char *device, const char *path, const picture *p, const char *x, const char *y,
                  const char *title, const char *subtitle)
{
    plsdev(device);
    plsfnam(path);
    plspage(0, 0, 1200, 800, 0, 0);
    set_colours();
    plfontld(1);
    plinit();
    plfont(1);
    pladv(0);
    plvpor(0.1, 0.77, 0.12, 0.89);
    plwind(p->x0, p->x1, p->y0, p->y1);
    plwidth(1);
    plcol0(INK);
    plbox("bc", 0, 0, "bc", 0, 0);
    axis(p, true);
    axis(p, false);
    plschr(0, 0.95);
    plmtex("b", 3.6, 0.5, 0.5, x);
    plmtex("l", 4.6, 0.5, 0.5, y);
    plmtex("t", 2.4, 0.5, 0.5, title);
    plschr(0, 0.75);
    plmtex("t", 0.9, 0.5, 0.5, subtitle);
}

/* One line of the legend, at height y of the frame. */
static void entry(double y, int colour, const char *sign, const char *text)
{
    plcol0(colour);
    plmtex("rv", 1.2, y, 0.5, sign);
    plcol0(INK);
    plmtex("rv", 2.2, y, 0, text);
}

/* Beside the frame. */
static void legend(const bool used[SERIES], bool over_time, bool reference)
{
    const double line_high = 0.045;
    double y = 0.97;
    plschr(0, 0.72);
    for (int s = 0; s < SERIES; s++) {
        if (!used[s]) continue;
        entry(y, FIRST_SERIES + s, series[s].mark, series[s].text);
        y -= line_high;
    }
    if (used[HALVED]) {
        entry(y, INK, "", "its own finest");
        y -= line_high;
    }
    if (over_time) {
        entry(y, FRONT, "—", "the best (Pareto front)");
        y -= line_high;
    }
    if (reference) {
        entry(y, FRONT, "- -", "what the finest mesh");
        entry(y - line_high, INK, "", "is itself off, about");
    }
    plmtex("rv", 1.2, 0.02, 0, "/2: every edge halved");
    plmtex("rv", 1.2, 0.02 + line_high, 0, "x2: edges twice as long");
    if (used[TOLERANCES]) plmtex("rv", 1.2, 0.02 + 2 * line_high, 0, "1e-04: of the first force");
}

/* In parts of the frame. */
typedef struct box {
    double x0, x1, y0, y1;
} box;

static bool meet(const box *a, const box *b)
{
    return a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1;
}

/* Marks, and beside each its name in the first of six places that is free; none where none is. */
static void mark(const spot *s, int count, const picture *p)
{
    /* right, up, justified */
    static const double at[6][3] = {{0.012, 0.03, 0},   {0.012, -0.03, 0}, {-0.012, 0.03, 1},
                                    {-0.012, -0.03, 1}, {0.016, 0, 0},     {-0.016, 0, 1}};
    box taken[2 * SPOTS_MAX];
    int boxes = 0;
    for (int i = 0; i < count; i++) {
        double u = (log10(s[i].x) - p->x0) / (p->x1 - p->x0), v = (log10(s[i].y) - p->y0) / (p->y1 - p->y0);
        taken[boxes++] = (box){u - 0.01, u + 0.01, v - 0.013, v + 0.013};
        plcol0(FIRST_SERIES + s[i].series);
        plschr(0, 1.0);
        plptex(log10(s[i].x), log10(s[i].y), 1, 0, 0.5, series[s[i].series].mark);
    }
    plcol0(INK);
    plschr(0, 0.62);
    for (int i = 0; i < count; i++) {
        double u = (log10(s[i].x) - p->x0) / (p->x1 - p->x0), v = (log10(s[i].y) - p->y0) / (p->y1 - p->y0);
        double wide = 0.0105 * (double)strlen(s[i].label);
        for (int k = 0; s[i].label[0] && k < 6; k++) {
            double x = u + at[k][0], y = v + at[k][1];
            box b = {x - at[k][2] * wide, x + (1 - at[k][2]) * wide, y - 0.013, y + 0.013};
            bool free_place = b.x0 > 0 && b.x1 < 1;
            for (int n = 0; free_place && n < boxes; n++) free_place = !meet(&b, &taken[n]);
            if (!free_place) continue;
            taken[boxes++] = b;
            plptex(p->x0 + x * (p->x1 - p->x0), p->y0 + y * (p->y1 - p->y0), 1, 0, at[k][2], s[i].label);
            break;
        }
    }
}

static int by_x(const void *a, const void *b)
{
    double x = ((const double *)a)[0], y = ((const double *)b)[0];
    return (x > y) - (x < y);
}

/* The front as steps: from each best run on, no slower one is needed. */
static void draw_front(const study_table *t, const spot *s, int count)
{
    double front[SPOTS_MAX][2];
    int n = 0;
    for (int i = 0; i < count; i++) {
        if (!t->best[s[i].run]) continue;
        front[n][0] = log10(s[i].x);
        front[n++][1] = log10(s[i].y);
    }
    qsort(front, (size_t)n, sizeof *front, by_x);
    plcol0(FRONT);
    plwidth(2);
    for (int i = 1; i < n; i++) {
        line(front[i - 1][0], front[i - 1][1], front[i][0], front[i - 1][1]);
        line(front[i][0], front[i - 1][1], front[i][0], front[i][1]);
    }
    plwidth(1);
}

/* Lines through the meshes made anew, and dashed from each to its halves. */
static void draw_families(const study_table *t, const spot *s, int count)
{
    for (int i = 0; i < count; i++)
        for (int k = 0; k < count; k++) {
            const study_rung *a = t->run[s[i].run].rung, *b = t->run[s[k].run].rung;
            bool halves = s[i].series == HALVED && a->coarsening == b->coarsening && b->refined == a->refined + 1;
            if (s[i].series != s[k].series || !(halves || (s[i].series < HALVED && k == i + 1))) continue;
            plcol0(FIRST_SERIES + s[i].series);
            pllsty(halves ? 2 : 1);
            line(log10(s[i].x), log10(s[i].y), log10(s[k].x), log10(s[k].y));
        }
    pllsty(1);
}

static void draw_slopes(const picture *p)
{
    double wide = 0.12 * (p->x1 - p->x0), x = p->x1 - 0.28 * (p->x1 - p->x0), y = p->y0 + 0.1 * (p->y1 - p->y0);
    plcol0(INK);
    plschr(0, 0.7);
    for (int order = 1; order <= 2; order++) {
        line(x, y, x + wide, y + order * wide);
        char text[32];
        snprintf(text, sizeof text, "order %d", order);
        plptex(x + wide, y + order * wide, 1, 0, -0.1, text);
    }
}

static void describe_orders(const study_table *t, char *out, size_t size)
{
    const double value[3] = {t->plain_slope, t->average_slope, t->order};
    char text[3][24];
    for (int k = 0; k < 3; k++) snprintf(text[k], sizeof text[k], isnan(value[k]) ? "not known" : "%.2f", value[k]);
    snprintf(out, size, "slope of meshes made anew: plain %s, averaged %s; order of x3 halved twice: %s", text[0],
             text[1], text[2]);
}

/* False: it lies outside of the frame. */
static bool draw_reference(const study_table *t, const picture *p)
{
    double y = log10(t->reference_error_mm);
    if (!(y > p->y0 && y < p->y1)) return false;
    plcol0(FRONT);
    pllsty(2);
    line(p->x0, y, p->x1, y);
    pllsty(1);
    return true;
}

static bool draw(const study_table *t, bool over_time, const char *device, const char *path)
{
    spot s[SPOTS_MAX];
    bool used[SERIES] = {0};
    int count = spots_collect(t, over_time, s);
    if (count == 0) return false;
    for (int i = 0; i < count; i++) used[s[i].series] = true;
    picture p = frame_of(s, count);
    char title[2 * FIELD_TEXT_SIZE],
        subtitle[160] = "distances to the finest mesh, over the skin that moves by more than 0.1 mm";
    snprintf(title, sizeof title, "%s: %s", t->task->patient->name, t->plan_name);
    if (!over_time) describe_orders(t, subtitle, sizeof subtitle);
    begin(device, path, &p,
          over_time ? "wall time of the solve, s" : "mean size of a tet, mm (cube root of its volume)",
          "mean skin error, mm", title, subtitle);
    bool reference = draw_reference(t, &p);
    if (over_time) {
        draw_front(t, s, count);
    } else {
        draw_families(t, s, count);
        draw_slopes(&p);
    }
    mark(s, count, &p);
    legend(used, over_time, reference);
    plend();
    return true;
}

bool study_plot(const study_table *t, const char *folder, err *e)
{
    static const char *const device[2] = {"pngcairo", "svgcairo"}, *const ending[2] = {"png", "svg"};
    for (int k = 0; k < 4; k++) { /* beside its name first: PLplot does not tell of a full disk */
        char path[FIELD_PATH_SIZE + 64], part[FIELD_PATH_SIZE + 80];
        snprintf(path, sizeof path, "%s/error_%s.%s", folder, k < 2 ? "time" : "size", ending[k % 2]);
        snprintf(part, sizeof part, "%s.part", path);
        if (!draw(t, k < 2, device[k % 2], part)) continue;
        FILE *f = fopen(part, "rb");
        bool some = f && fgetc(f) != EOF;
        if (f) fclose(f);
        if (!some || rename(part, path)) {
            unlink(part);
            return err_at(e, ERR_RESOURCE, path, 0, NULL, "could not be drawn (PLplot's cairo driver)");
        }
    }
    return true;
}
