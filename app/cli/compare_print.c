#include "app/cli/compare_print.h"
#include "geometry/vec.h"
#include <math.h>
#include <stdio.h>

static void print_trivial(const face_compare *c)
{
    printf(
        "\nno change: the skin before. smoothed bone: the skin before moved by 0.85 of the bones' own moves, smoothed "
        "over 12 mm\n");
    printf("mean |d|, mm    prediction  no change  smoothed bone\n");
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

/* The errors of landmark i by the prediction and the trivial ones, mm, and the first along the head's axes; false: the
 * actual face lacks it, or it is none of the skin. */
static bool landmark_errors(const face_compare *c, int32_t i, double error[PREDICTION_COUNT], double d[3])
{
    const landmarks *of[PREDICTION_COUNT] = {&c->points, &c->rest_points, &c->smoothed_points};
    double along[3];
    if (!face_compare_on_skin(c->points.point[i].label) || !face_compare_landmark(c, &c->points, i, d)) return false;
    for (int k = 0; k < c->predictions; k++) {
        if (!face_compare_landmark(c, of[k], i, along)) return false;
        error[k] = vec_norm(along);
    }
    return true;
}

static void print_landmarks(const face_compare *c)
{
    bool rest = c->predictions > 1;
    double d[3], error[PREDICTION_COUNT], sum[PREDICTION_COUNT] = {0};
    int count = 0;
    for (int32_t i = 0; i < c->points.count; i++) {
        if (!landmark_errors(c, i, error, d)) continue;
        if (!count++)
            printf("\nlandmark     error, mm  forward     up   left%s\n", rest ? "  no change  smoothed bone" : "");
        printf("%-12s %9.2f %8.2f %6.2f %6.2f", c->points.point[i].label, error[PREDICTED], d[0], d[1], d[2]);
        if (rest) printf(" %10.2f %14.2f", error[NO_CHANGE], error[SMOOTHED_BONE]);
        putchar('\n');
        for (int k = 0; k < c->predictions; k++) sum[k] += error[k];
    }
    if (!count) return;
    printf("mean of %-3d  %9.2f", count, sum[PREDICTED] / count);
    if (rest) printf(" %33.2f %14.2f", sum[NO_CHANGE] / count, sum[SMOOTHED_BONE] / count);
    putchar('\n');
}

static double degrees(const face_alignment *a) { return rigid_angle(&a->fit.move) * (180 / acos(-1.0)); }

static void print_alignment(const face_compare *c)
{
    const surface_fit *f = &c->aligned.fit;
    printf("aligned on %s\n", face_compare_aligned_on(c));
    if (c->aligned.known && f->points)
        printf("turned %.2f deg (%.2f mm at the chin), RMS %.3f -> %.3f mm over %d of %d points\n",
               degrees(&c->aligned), c->aligned.turn_at_chin_mm, f->rms_before_mm, f->rms_after_mm, f->used, f->points);
    if (c->by_skin.known)
        printf("skin alone would turn it by %.2f deg more and move the chin by %.2f mm (RMS there %.3f -> %.3f mm)\n",
               degrees(&c->by_skin), c->by_skin.chin_mm, c->by_skin.fit.rms_before_mm, c->by_skin.fit.rms_after_mm);
    putchar('\n');
}

void compare_print(const face_compare *c)
{
    print_alignment(c);
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
