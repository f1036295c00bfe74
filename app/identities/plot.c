#include "app/identities/plot.h"
#include "geometry/mem.h"
#include <math.h>
#include <plplot/plplot.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { INK = 1, BARS, TOGETHER, ERRORS };
static const int shade[][3] = {{255, 255, 255}, {30, 30, 30}, {150, 190, 225}, {31, 90, 150}, {200, 70, 20}};

static void frame(double modes, double high, const char *right)
{
    plvpor(0.09, 0.91, 0.12, 0.9);
    plwind(0, modes + 1, 0, high);
    plcol0(INK);
    plbox(right ? "" : "bcnst", 0, 0, right ? "cmst" : "bnst", 0, 0);
}

static void draw(const head_model *m, const char *path)
{
    const principal *modes = &m->modes;
    int rgb[3][sizeof shade / sizeof *shade], count = sizeof shade / sizeof *shade;
    double x[HEAD_MODES_MOST + 1], y[HEAD_MODES_MOST + 1], together = 0;
    for (int i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) rgb[c][i] = shade[i][c];
    plscmap0(rgb[0], rgb[1], rgb[2], count);
    plsdev("pngcairo");
    plsfnam(path);
    plspage(0, 0, 1200, 800, 0, 0);
    plfontld(1);
    plinit();
    plfont(1);
    pladv(0);
    frame(modes->mode_count, 100, NULL);
    for (int32_t k = 0; k < modes->mode_count; k++) {
        double share = 100 * principal_share(modes, k), from = k + 0.6, to = k + 1.4;
        plcol0(BARS);
        plfill(4, (double[]){from, to, to, from}, (double[]){0, 0, share, share});
        x[k] = k + 1;
        y[k] = together += share;
    }
    plcol0(TOGETHER);
    plwidth(2);
    plline(modes->mode_count, x, y);
    plcol0(INK);
    plmtex("b", 3.2, 0.5, 0.5, "mode");
    plmtex("l", 3.4, 0.5, 0.5, "share of the variance, %: each (bars), together");
    char title[160];
    snprintf(title, sizeof title, "%d heads, %d modes", modes->sample_count, modes->mode_count);
    plmtex("t", 1.6, 0.5, 0.5, title);
    double most = 0;
    for (int32_t k = 0; k <= m->left_out_modes; k++) {
        x[k] = k;
        y[k] = m->left_out_rms_mm[k];
        most = fmax(most, y[k]);
    }
    plwidth(1);
    frame(modes->mode_count, 1.05 * fmax(most, 1e-3), "right");
    plcol0(ERRORS);
    plwidth(2);
    plline(m->left_out_modes + 1, x, y);
    plmtex("r", 3.6, 0.5, 0.5, "error of a head left out, rms, mm (red)");
    plend();
}

bool identities_plot(const head_model *m, const char *folder, err *e)
{
    char path[FIELD_PATH_SIZE + 64], part[FIELD_PATH_SIZE + 80];
    snprintf(path, sizeof path, "%s/variance.png", folder);
    snprintf(part, sizeof part, "%s.part", path); /* PLplot does not tell of a full disk */
    draw(m, part);
    FILE *f = fopen(part, "rb");
    bool some = f && fgetc(f) != EOF;
    if (f) fclose(f);
    if (some && !rename(part, path)) return true;
    unlink(part);
    return err_at(e, ERR_RESOURCE, path, 0, NULL, "could not be drawn (PLplot's cairo driver)");
}
