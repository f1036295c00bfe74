#include "render/colormap.h"
#include <assert.h>
#include <math.h>
#include <pthread.h>

const double colormap_no_data[3] = {0.55, 0.55, 0.55};

static void viridis(double t, double rgb[3])
{
    static const double c[7][3] = {{0.2777273272234177, 0.005407344544966578, 0.3340998053353061},
                                   {0.1050930431085774, 1.404613529898575, 1.384590162594685},
                                   {-0.3308618287255563, 0.214847559468213, 0.09509516302823659},
                                   {-4.634230498983486, -5.799100973351585, -19.33244095627987},
                                   {6.228269936347081, 14.17993336680509, 56.69055260068105},
                                   {4.776384997670288, -13.74514537774601, -65.35303263337234},
                                   {-5.435455855934631, 4.645852612178535, 26.3124352495832}};
    for (int k = 0; k < 3; k++) {
        rgb[k] = 0;
        for (int i = 6; i >= 0; i--) rgb[k] = rgb[k] * t + c[i][k];
    }
}

double colormap_linear(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : pow((srgb + 0.055) / 1.055, 2.4); }
double colormap_encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

static const double white_d65[3] = {0.95047, 1.0, 1.08883};

static void rgb_to_lab(const double rgb[3], double lab[3])
{
    static const double m[3][3] = {
        {0.4124564, 0.3575761, 0.1804375}, {0.2126729, 0.7151522, 0.0721750}, {0.0193339, 0.1191920, 0.9503041}};
    double f[3];
    for (int r = 0; r < 3; r++) {
        double x = 0;
        for (int k = 0; k < 3; k++) x += m[r][k] * colormap_linear(rgb[k]);
        x /= white_d65[r];
        f[r] = x > 0.008856 ? cbrt(x) : 7.787 * x + 16.0 / 116;
    }
    lab[0] = 116 * f[1] - 16;
    lab[1] = 500 * (f[0] - f[1]);
    lab[2] = 200 * (f[1] - f[2]);
}

static void lab_to_rgb(const double lab[3], double rgb[3])
{
    static const double m[3][3] = {
        {3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};
    double y = (lab[0] + 16) / 116, f[3] = {y + lab[1] / 500, y, y - lab[2] / 200}, xyz[3];
    for (int k = 0; k < 3; k++)
        xyz[k] = white_d65[k] * (f[k] > 0.206893 ? f[k] * f[k] * f[k] : (f[k] - 16.0 / 116) / 7.787);
    for (int r = 0; r < 3; r++) {
        double x = m[r][0] * xyz[0] + m[r][1] * xyz[1] + m[r][2] * xyz[2];
        rgb[r] = colormap_encode(x < 0 ? 0 : x);
    }
}

/* Msh: Lab in polar form, magnitude, saturation, hue (Moreland 2009, section 4). */
static void lab_to_msh(const double lab[3], double msh[3])
{
    msh[0] = sqrt(lab[0] * lab[0] + lab[1] * lab[1] + lab[2] * lab[2]);
    msh[1] = msh[0] > 1e-9 ? acos(lab[0] / msh[0]) : 0;
    msh[2] = msh[1] > 1e-9 ? atan2(lab[2], lab[1]) : 0;
}

/* The hue that an unsaturated end takes so that the path does not swing through foreign hues (Moreland,
 * figure 6). */
static double adjusted_hue(const double saturated[3], double grey_magnitude)
{
    if (saturated[0] >= grey_magnitude) return saturated[2];
    double spin = saturated[1] * sqrt(grey_magnitude * grey_magnitude - saturated[0] * saturated[0]) /
                  (saturated[0] * sin(saturated[1]));
    return saturated[2] > -1.0471975511965976 ? saturated[2] + spin : saturated[2] - spin;
}

static void coolwarm(double t, double rgb[3])
{
    static const double ends[2][3] = {{59.0 / 255, 76.0 / 255, 192.0 / 255}, {180.0 / 255, 4.0 / 255, 38.0 / 255}};
    const double middle = 88;                                 /* magnitude of the light grey between two distant hues */
    double lab[3], msh[3], mix = t < 0.5 ? 2 * t : 2 - 2 * t; /* 0 at the coloured end, 1 at grey */
    rgb_to_lab(ends[t < 0.5 ? 0 : 1], lab);
    lab_to_msh(lab, msh);
    double hue = adjusted_hue(msh, middle);
    double m = (1 - mix) * msh[0] + mix * middle, s = (1 - mix) * msh[1], h = (1 - mix) * msh[2] + mix * hue;
    double out[3] = {m * cos(s), m * sin(s) * cos(h), m * sin(s) * sin(h)};
    lab_to_rgb(out, rgb);
}

static uint8_t table[2][3 * COLORMAP_SIZE];

static void make_tables(void)
{
    for (int i = 0; i < COLORMAP_SIZE; i++) {
        double rgb[2][3], t = i / (COLORMAP_SIZE - 1.0);
        viridis(t, rgb[COLORMAP_VIRIDIS]);
        coolwarm(t, rgb[COLORMAP_COOLWARM]);
        for (int m = 0; m < 2; m++)
            for (int k = 0; k < 3; k++) table[m][3 * i + k] = (uint8_t)(255 * fmin(1, fmax(0, rgb[m][k])) + 0.5);
    }
}

const uint8_t *colormap_table(colormap map)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    assert(map == COLORMAP_VIRIDIS || map == COLORMAP_COOLWARM);
    pthread_once(&once, make_tables);
    return table[map];
}

void colormap_color(colormap map, double value, double low, double high, double rgb[3])
{
    for (int k = 0; k < 3; k++) rgb[k] = colormap_no_data[k];
    if (isnan(value) || !(high > low)) return;
    double t = fmin(1, fmax(0, (value - low) / (high - low)));
    const uint8_t *entry = colormap_table(map) + 3 * (int)(t * (COLORMAP_SIZE - 1) + 0.5);
    for (int k = 0; k < 3; k++) rgb[k] = entry[k] / 255.0;
}

double colormap_nice_ceiling(double x)
{
    static const double step[] = {1, 2, 2.5, 3, 4, 5, 6, 8, 10};
    if (!(x > 0) || !isfinite(x)) return 1;
    double power = pow(10, floor(log10(x)));
    for (int i = 0; i < 9; i++)
        if (step[i] * power >= x * (1 - 1e-9)) return step[i] * power;
    return 10 * power;
}
