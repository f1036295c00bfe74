#include "render/src/harmonics.h"
#include <math.h>

void harmonics_at(const double d[3], double y[HARMONICS])
{
    double x = d[0], v = d[1], z = d[2];
    y[0] = 0.28209479177387814;
    y[1] = 0.4886025119029199 * v;
    y[2] = 0.4886025119029199 * z;
    y[3] = 0.4886025119029199 * x;
    y[4] = 1.0925484305920792 * x * v;
    y[5] = 1.0925484305920792 * v * z;
    y[6] = 0.31539156525252005 * (3 * z * z - 1);
    y[7] = 1.0925484305920792 * x * z;
    y[8] = 0.5462742152960396 * (x * x - v * v);
}

/* The cosine lobe: 1, 2/3, 1/4 in degrees 0, 1, 2 (R. Ramamoorthi and P. Hanrahan 2001, equation 8, over pi).
 */
void lobe_at(const float normal[3], float t[HARMONICS])
{
    static const double lobe[HARMONICS] = {1, 2.0 / 3, 2.0 / 3, 2.0 / 3, 1.0 / 4, 1.0 / 4, 1.0 / 4, 1.0 / 4, 1.0 / 4};
    double y[HARMONICS];
    harmonics_at((const double[3]){(double)normal[0], (double)normal[1], (double)normal[2]}, y);
    for (int i = 0; i < HARMONICS; i++) t[i] = (float)(lobe[i] * y[i]);
}

void sphere_direction(int i, int n, double d[3])
{
    const double turn = M_PI * (3 - sqrt(5.0));
    double z = 1 - (2 * i + 1.0) / n, r = sqrt(fmax(0, 1 - z * z));
    d[0] = r * cos(turn * i);
    d[1] = r * sin(turn * i);
    d[2] = z;
}
