/* Two pictures: error over time with the front of the best, error over the size of the tets with its slopes.
 */
#include "app/study/study.h"
#include "geometry/mem.h"
#include <math.h>
#include <plplot/plplot.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { INK = 1, FAINT = 2, FIRST_SERIES = 3, SERIES = 4, FRONT = 7 };
static const int shade[][3] = {{255, 255, 255}, {30, 30, 30},  {200, 200, 200}, {31, 119, 180},
                               {214, 96, 20},   {44, 140, 60}, {130, 90, 170},  {200, 30, 40}};
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

static void begin(const char *device, const char *path, const picture *p, const char *x, const char *y,
                  const char *title)
{
    plsdev(device);
    plsfnam(path);
    plspage(0, 0, 1200, 800, 0, 0);
    set_colours();
    plfontld(1);
    plinit();
    plfont(1);
    pladv(0);
    plcol0(INK);
    plvpor(0.09, 0.97, 0.11, 0.91);
    plwind(p->x0, p->x1, p->y0, p->y1);
    plwidth(1);
    plcol0(FAINT);
    plschr(0, 0.8);
    plbox("lgt", 0, 0, "lgt", 0, 0);
    plcol0(INK);
    plbox("bcnlst", 0, 0, "bcnlstv", 0, 0);
    plschr(0, 1.0);
    pllab(x, y, title);
}

static void line(double x0, double y0, double x1, double y1)
{
    double x[2] = {x0, x1}, y[2] = {y0, y1};
    plline(2, x, y);
}

static void legend(const picture *p, const bool used[SERIES], const char *more)
{
    double x = p->x1 - 0.30 * (p->x1 - p->x0), y = p->y1 - 0.05 * (p->y1 - p->y0);
    plschr(0, 0.8);
    for (int s = 0; s < SERIES; s++) {
        if (!used[s]) continue;
        plcol0(FIRST_SERIES + s);
        plptex(x, y, 1, 0, 0.5, series[s].mark);
        plcol0(INK);
        plptex(x + 0.015 * (p->x1 - p->x0), y, 1, 0, 0, series[s].text);
        y -= 0.045 * (p->y1 - p->y0);
    }
    if (!more) return;
    plcol0(FRONT);
    plwidth(2);
    line(x - 0.012 * (p->x1 - p->x0), y, x + 0.008 * (p->x1 - p->x0), y);
    plcol0(INK);
    plptex(x + 0.015 * (p->x1 - p->x0), y, 1, 0, 0, more);
}

static void mark(const study_table *t, const int *which, const double *x, const double *y, int count,
                 bool names)
{
    for (int i = 0; i < count; i++) {
        int s = series_of(t, which[i]);
        plcol0(FIRST_SERIES + s);
        plschr(0, 1.1);
        plptex(log10(x[i]), log10(y[i]), 1, 0, 0.5, series[s].mark);
        if (!names || s > 1) continue;
        plcol0(INK);
        plschr(0, 0.62);
        plptex(log10(x[i]) + 0.012, log10(y[i]) + 0.02, 1, 0, 0, t->run[which[i]].rung->name);
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

static void draw_slopes(const study_table *t, const picture *p)
{
    double wide = 0.18 * (p->x1 - p->x0), x = p->x0 + 0.08 * (p->x1 - p->x0),
           y = p->y0 + 0.5 * (p->y1 - p->y0);
    plcol0(INK);
    plschr(0, 0.75);
    for (int order = 1; order <= 2; order++) {
        line(x, y, x + wide, y + order * wide);
        char text[32];
        snprintf(text, sizeof text, "order %d", order);
        plptex(x + wide, y + order * wide, 1, 0, -0.1, text);
    }
    char text[160];
    snprintf(text, sizeof text, "slope of the plain tets %.2f, averaged %.2f; order by Richardson %.2f",
             t->plain_slope, t->average_slope, t->order);
    plptex(p->x0 + 0.02 * (p->x1 - p->x0), p->y1 - 0.05 * (p->y1 - p->y0), 1, 0, 0, text);
}

static void draw_reference(const study_table *t, const picture *p)
{
    double y = log10(t->reference_error_mm);
    if (!(y > p->y0 && y < p->y1)) return;
    plcol0(FRONT);
    pllsty(2);
    line(p->x0, y, p->x1, y);
    pllsty(1);
    plschr(0, 0.7);
    plptex(p->x0 + 0.02 * (p->x1 - p->x0), y + 0.02 * (p->y1 - p->y0), 1, 0, 0,
           "what the reference itself is off, by Richardson");
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
        char title[FIELD_TEXT_SIZE + FIELD_TEXT_SIZE];
        snprintf(title, sizeof title, "%s: %s", t->task->patient->name, t->plan_name);
        begin(device, path, &p,
              over_time ? "wall time of the solve, s" : "mean size of a tet, mm (cube root of its volume)",
              "mean skin error to the reference, mm", title);
        draw_reference(t, &p);
        if (over_time)
            draw_front(t, which, x, y, count);
        else
            draw_slopes(t, &p);
        mark(t, which, x, y, count, true);
        legend(&p, used, over_time ? "nothing is faster and nearer" : NULL);
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
