#include "app/cli/compare_print.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static void print_trivial(const face_compare *c)
{
    printf("\nmean |d|, mm    prediction  no change  smoothed bone x 0.85\n");
    for (int r = 0; r < ROW_COUNT; r++)
        printf("%-14s %11.2f %10.2f %13.2f\n", face_row_name(r), c->row[PREDICTED][r].mean_abs,
               c->row[NO_CHANGE][r].mean_abs, c->row[SMOOTHED_BONE][r].mean_abs);
    for (int yes = 1; yes >= 0; yes--) {
        int count = 0;
        for (int r = 0; r < ROW_COUNT; r++) {
            if (face_compare_beats(c, r) != yes) continue;
            if (!count++)
                printf(yes ? "The prediction is closer than both trivial ones in: " : "It is not closer in: ");
            else
                printf(", ");
            printf("%s", face_row_name(r));
        }
        if (count)
            printf(".\n");
        else if (yes)
            printf("The prediction is nowhere closer than both trivial ones.\n");
    }
}

/* Points of the skin; the file has the bone's as well. */
static bool on_skin(const char *label)
{
    static const char *const bare[] = {"Pn",   "Sn",   "Al_L",    "Al_R", "Ls",  "Stm",
                                       "Stms", "Stmi", "Li_soft", "Ch_L", "Ch_R"};
    for (size_t i = 0; i < sizeof bare / sizeof *bare; i++)
        if (!strcmp(label, bare[i])) return true;
    return strchr(label, '\'') != NULL;
}

static void print_landmarks(const face_compare *c)
{
    bool rest = c->rest_points.count > 0;
    double d[3], unchanged[3] = {0}, sum[2] = {0, 0};
    int count = 0;
    for (int32_t i = 0; i < c->points.count; i++) {
        if (!on_skin(c->points.point[i].label) || !face_compare_landmark(c, &c->points, i, d)) continue;
        if (rest && !face_compare_landmark(c, &c->rest_points, i, unchanged)) continue;
        if (!count++) printf("\nlandmark     error, mm  forward     up   left%s\n", rest ? "  no change" : "");
        printf("%-12s %9.2f %8.2f %6.2f %6.2f", c->points.point[i].label, vec_norm(d), d[0], d[1], d[2]);
        if (rest) printf(" %10.2f", vec_norm(unchanged));
        putchar('\n');
        sum[0] += vec_norm(d);
        sum[1] += vec_norm(unchanged);
    }
    if (count) printf("mean of %-3d  %9.2f", count, sum[0] / count);
    if (count && rest) printf(" %34.2f", sum[1] / count);
    if (count) putchar('\n');
}

void compare_print(const face_compare *c)
{
    if (c->aligned)
        printf("aligned on forehead and nasal bridge: turned %.2f deg (%.2f mm at the chin), RMS %.3f -> "
               "%.3f mm over %d of %d points\n\n",
               rigid_angle(&c->fit.move) * (180 / acos(-1.0)), c->turn_at_chin_mm, c->fit.rms_before_mm,
               c->fit.rms_after_mm, c->fit.used, c->fit.points);
    else
        printf("not aligned: both faces taken as they lie\n\n");
    printf("signed distance, mm: positive where the actual face lies in front of the predicted one\n");
    printf("%-12s %7s %7s %7s %7s %7s %7s  %6s %6s\n", "", "points", "mean", "mean|d|", "RMS", "90 %", "95 %", "< 1 mm",
           "< 2 mm");
    for (int r = 0; r < ROW_COUNT; r++) {
        const distance_stats *s = &c->row[PREDICTED][r];
        printf("%-12s %7d ", face_row_name(r), s->count);
        if (s->count)
            printf("%+7.2f %7.2f %7.2f %7.2f %7.2f  %4.0f %% %4.0f %%\n", s->mean, s->mean_abs, s->rms, s->p90, s->p95,
                   100 * s->under_1, 100 * s->under_2);
        else
            printf("      - not covered by the actual face\n");
    }
    if (c->predictions > 1) print_trivial(c);
    print_landmarks(c);
}
