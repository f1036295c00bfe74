/* Two pictures: error over time with the front of the best, error over the size of the tets with its slopes.
 */
#include "app/study/study.h"
#include "geometry/mem.h"
#include <math.h>
#include <plplot/plplot.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { INK = 1, FIRST_SERIES = 2, SERIES = 4, FRONT = 6 };
static const int shade[][3] = {{255, 255, 255}, {30, 30, 30},   {31, 119, 180}, {214, 96, 20},
                               {44, 140, 60},   {130, 90, 170}, {200, 30, 40}};
static const struct {
    const char *text, *mark;
} series[SERIES] = {{"meshes, plain tets", "●"},
                    {"averaged volume changes", "▲"},
                    {"tolerances, the case's mesh", "■"},
                    {"load steps, the case's mesh", "◆"}};

/* -1: not in the pictures. */
static int series_of(const study_table *t, int i)
{
    const study_rung *r = t->run[i].rung;
    if (!(t->error[i].mean_mm > 0) || r->contact) return -1;
    switch (r->group) {
    case GROUP_MESH:
        return 0;
    case GROUP_ELEMENT:
        return 1;
    case GROUP_TOLERANCE:
        return 2;
    case GROUP_SCENE:
        return 3;
    default:
        return -1;
    }
}

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

static picture frame_of(const double *x, const double *y, int count)
{
    picture p = {HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};
    for (int i = 0; i < count; i++) {
        p.x0 = fmin(p.x0, log10(x[i]));
        p.x1 = fmax(p.x1, log10(x[i]));
        p.y0 = fmin(p.y0, log10(y[i]));
        p.y1 = fmax(p.y1, log10(y[i]));
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
    int kind = high - low < 0.9 ? 0 : high - low < 2.5 ? 1 : 2;
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
    plvpor(0.1, 0.76, 0.12, 0.89);
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

/* Beside the frame. */
static void legend(const bool used[SERIES], const char *more)
{
    double y = 0.97;
    plschr(0, 0.72);
    for (int s = 0; s < SERIES; s++) {
        if (!used[s]) continue;
        plcol0(FIRST_SERIES + s);
        plmtex("rv", 1.2, y, 0.5, series[s].mark);
        plcol0(INK);
        plmtex("rv", 2.2, y, 0, series[s].text);
        y -= 0.045;
    }
    plmtex("rv", 1.2, 0.06, 0, "x2: edges twice as long");
    plmtex("rv", 1.2, 0.02, 0, "/2: every edge halved");
    if (!more) return;
    plcol0(FRONT);
    plmtex("rv", 1.2, y, 0.5, "—");
    plcol0(INK);
    plmtex("rv", 2.2, y, 0, more);
}

static void mark(const study_table *t, const int *which, const double *x, const double *y, int count,
                 const picture *p)
{
    for (int i = 0; i < count; i++) {
        int s = series_of(t, which[i]);
        plcol0(FIRST_SERIES + s);
        plschr(0, 1.1);
        plptex(log10(x[i]), log10(y[i]), 1, 0, 0.5, series[s].mark);
        if (s > 1) continue;
        const study_rung *r = t->run[which[i]].rung;
        char name[32];
        snprintf(name, sizeof name, r->refined ? "x%g /%d" : "x%g", r->coarsening, 1 << r->refined);
        bool right = log10(x[i]) < (p->x0 + p->x1) / 2;
        plcol0(INK);
        plschr(0, 0.62);
        plptex(log10(x[i]) + (right ? 0.012 : -0.012) * (p->x1 - p->x0),
               log10(y[i]) + (i % 2 ? -0.03 : 0.025) * (p->y1 - p->y0), 1, 0, right ? 0 : 1, name);
    }
}

static int by_x(const void *a, const void *b)
{
    double x = ((const double *)a)[0], y = ((const double *)b)[0];
    return (x > y) - (x < y);
}

/* The front as steps: from each best run on, no slower one is needed. */
static void draw_front(const study_table *t, const int *which, const double *x, const double *y, int count)
{
    double(*front)[2] = mem_alloc((size_t)count, sizeof *front);
    int n = 0;
    for (int i = 0; i < count; i++) {
        if (!t->best[which[i]]) continue;
        front[n][0] = log10(x[i]);
        front[n++][1] = log10(y[i]);
    }
    qsort(front, (size_t)n, sizeof *front, by_x);
    plcol0(FRONT);
    plwidth(2);
    for (int i = 1; i < n; i++) {
        line(front[i - 1][0], front[i - 1][1], front[i][0], front[i - 1][1]);
        line(front[i][0], front[i - 1][1], front[i][0], front[i][1]);
    }
    plwidth(1);
    free(front);
}

/* Lines through the meshes made anew, and dashed from each to its halves. */
static void draw_families(const study_table *t)
{
    plcol0(FIRST_SERIES);
    for (int i = 0; i < t->count; i++)
        for (int k = 0; k < t->count; k++) {
            const study_rung *a = t->run[i].rung, *b = t->run[k].rung;
            if (series_of(t, i) != 0 || series_of(t, k) != 0) continue;
            bool anew = !a->refined && !b->refined && k == i + 1,
                 halves = a->coarsening == b->coarsening && b->refined == a->refined + 1;
            if (!anew && !halves) continue;
            pllsty(anew ? 1 : 2);
            line(log10(t->run[i].result.size_mm), log10(t->error[i].mean_mm), log10(t->run[k].result.size_mm),
                 log10(t->error[k].mean_mm));
        }
    pllsty(1);
}

static void draw_slopes(const picture *p)
{
    double wide = 0.12 * (p->x1 - p->x0), x = p->x1 - 0.28 * (p->x1 - p->x0),
           y = p->y0 + 0.1 * (p->y1 - p->y0);
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
    for (int k = 0; k < 3; k++)
        snprintf(text[k], sizeof text[k], isnan(value[k]) ? "not known" : "%.2f", value[k]);
    snprintf(out, size, "slope of meshes made anew: plain %s, averaged %s; order of one mesh halved twice %s",
             text[0], text[1], text[2]);
}

static void draw_reference(const study_table *t, const picture *p)
{
    double y = log10(t->reference_error_mm);
    if (!(y > p->y0 && y < p->y1)) return;
    plcol0(FRONT);
    pllsty(2);
    line(p->x0, y, p->x1, y);
    pllsty(1);
    plschr(0, 0.62);
    plptex(p->x0 + 0.02 * (p->x1 - p->x0), y - 0.02 * (p->y1 - p->y0), 1, 0, 0,
           isnan(t->order) ? "about what the finest mesh itself is off"
                           : "what the finest mesh itself is off, by Richardson");
}

static bool draw(const study_table *t, bool over_time, const char *device, const char *path)
{
    int *which = NEW_ARRAY(int, t->count), count = 0;
    double *x = NEW_ARRAY(double, t->count), *y = NEW_ARRAY(double, t->count);
    bool used[SERIES] = {0};
    for (int i = 0; i < t->count; i++) {
        int s = series_of(t, i);
        if (s < 0 || (!over_time && s > 1)) continue;
        used[s] = true;
        which[count] = i;
        x[count] = over_time ? t->run[i].result.wall_s : t->run[i].result.size_mm;
        y[count++] = t->error[i].mean_mm;
    }
    bool any = count > 0;
    if (any) {
        picture p = frame_of(x, y, count);
        char title[2 * FIELD_TEXT_SIZE],
            subtitle[160] = "distances to the finest mesh, over the skin that moves by more than 0.1 mm";
        snprintf(title, sizeof title, "%s: %s", t->task->patient->name, t->plan_name);
        if (!over_time) describe_orders(t, subtitle, sizeof subtitle);
        begin(device, path, &p,
              over_time ? "wall time of the solve, s" : "mean size of a tet, mm (cube root of its volume)",
              "mean skin error, mm", title, subtitle);
        draw_reference(t, &p);
        if (over_time) {
            draw_front(t, which, x, y, count);
        } else {
            draw_families(t);
            draw_slopes(&p);
        }
        mark(t, which, x, y, count, &p);
        legend(used, over_time ? "the best (Pareto front)" : NULL);
        plend();
    }
    free(which);
    free(x);
    free(y);
    return any;
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
