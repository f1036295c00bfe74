#include "render/label.h"
#include "geometry/mem.h"
#include <math.h>
#include <stdlib.h>

static const double ink[3] = {0.16, 0.19, 0.23}, faint[3] = {0.55, 0.59, 0.64};

typedef struct placed {
    double x, y, at; /* point; base line of the name */
    int index;
} placed;

static int by_x(const void *a, const void *b)
{
    const placed *p = a, *q = b;
    if (p->x < q->x || p->x > q->x) return p->x < q->x ? -1 : 1;
    return p->index - q->index;
}

static int by_y(const void *a, const void *b)
{
    const placed *p = a, *q = b;
    if (p->y < q->y || p->y > q->y) return p->y < q->y ? -1 : 1;
    return p->index - q->index;
}

/* Heights as near as possible (least squares) to those of the points with `step` between them: isotonic
 * regression of y - i step by pooling neighbours that violate the order, then the borders. */
static void spread(placed *q, int n, double step, double low, double high)
{
    double *sum = NEW_ARRAY(double, n);
    int *size = NEW_ARRAY(int, n), blocks = 0;
    for (int i = 0; i < n; i++) {
        sum[blocks] = q[i].y - i * step;
        size[blocks++] = 1;
        while (blocks > 1 && sum[blocks - 2] / size[blocks - 2] > sum[blocks - 1] / size[blocks - 1]) {
            sum[blocks - 2] += sum[blocks - 1];
            size[blocks - 2] += size[blocks - 1];
            blocks--;
        }
    }
    for (int b = 0, i = 0; b < blocks; b++)
        for (int k = 0; k < size[b]; k++, i++)
            q[i].at = fmax(low, fmin(sum[b] / size[b], high - (n - 1) * step)) + i * step;
    free(sum);
    free(size);
}

void label_points(pen *p, const image *im, double size, const camera *c, const label_point *points, int count,
                  const uint8_t *seen)
{
    placed *all = NEW_ARRAY(placed, count);
    int n = 0;
    for (int i = 0; i < count; i++) {
        double near_mm;
        placed q = {.index = i};
        if (seen && !seen[i]) continue;
        camera_project(c, im->width, im->height, points[i].xyz, &q.x, &q.y, &near_mm);
        if (q.x >= 0 && q.y >= 0 && q.x < im->width && q.y < im->height) all[n++] = q;
    }
    /* Half of the names go to each border; they shrink where a column would be too long. */
    qsort(all, (size_t)n, sizeof *all, by_x);
    double low = 5 * size, high = im->height - 5 * size;
    for (int side = 0; side < 2; side++) {
        placed *q = all + (side ? n / 2 : 0);
        int m = side ? n - n / 2 : n / 2;
        double step = m > 1 ? fmin(1.3 * size, (high - low) / (m - 1)) : size, font = fmin(size, step / 1.1);
        qsort(q, (size_t)m, sizeof *q, by_y);
        spread(q, m, step, low, high);
        for (int i = 0; i < m; i++) {
            const char *text = points[q[i].index].text;
            double wide = pen_text_width(p, font, false, text), edge = side ? im->width - 4.4 * size : 4.4 * size;
            double elbow = side ? edge - wide - 0.4 * size : edge + wide + 0.4 * size;
            pen_line(p, elbow, q[i].at - 0.35 * font, q[i].x, q[i].y, fmax(1, size / 16), ink);
            pen_text(p, edge, q[i].at, side ? LABEL_RIGHT : LABEL_LEFT, font, false, ink, text);
        }
    }
    free(all);
}

void label_column(pen *p, int width, int height, double size, const camera *c, const label_point *points, int count)
{
    placed *q = NEW_ARRAY(placed, count);
    double left = width, near_mm;
    for (int i = 0; i < count; i++) {
        q[i].index = i;
        camera_project(c, width, height, points[i].xyz, &q[i].x, &q[i].y, &near_mm);
        left = fmin(left, q[i].x);
    }
    qsort(q, (size_t)count, sizeof *q, by_y);
    spread(q, count, 1.35 * size, 2 * size, height - 3 * size);
    double edge = fmax(left - 2.5 * size, 3.5 * size);
    for (int i = 0; i < count; i++) {
        pen_line(p, edge + 0.3 * size, q[i].at - 0.35 * size, q[i].x, q[i].y, fmax(1, size / 18), faint);
        pen_text(p, edge, q[i].at, LABEL_RIGHT, size, false, ink, points[q[i].index].text);
    }
    free(q);
}
