#include "dense.h"
#include <assert.h>
#include <math.h>

static void swap(double *a, double *b, int n)
{
    for (int i = 0; i < n; i++) {
        double t = a[i];
        a[i] = b[i];
        b[i] = t;
    }
}

void dense_solve(double *a, double *b, int n, int columns)
{
    for (int i = 0; i < n; i++) {
        int pivot = i;
        for (int r = i + 1; r < n; r++)
            if (fabs(a[n * r + i]) > fabs(a[n * pivot + i])) pivot = r;
        assert(a[n * pivot + i] != 0);
        if (pivot != i) {
            swap(a + n * i, a + n * pivot, n);
            swap(b + columns * i, b + columns * pivot, columns);
        }
        for (int r = i + 1; r < n; r++) {
            double f = a[n * r + i] / a[n * i + i];
            if (f == 0) continue;
            for (int c = i; c < n; c++) a[n * r + c] -= f * a[n * i + c];
            for (int c = 0; c < columns; c++) b[columns * r + c] -= f * b[columns * i + c];
        }
    }
    for (int i = n - 1; i >= 0; i--)
        for (int c = 0; c < columns; c++) {
            double sum = b[columns * i + c];
            for (int k = i + 1; k < n; k++) sum -= a[n * i + k] * b[columns * k + c];
            b[columns * i + c] = sum / a[n * i + i];
        }
}
