/* The lines of the cuts, on two halves of a block. */
#include "tests/check.h"
#include "geometry/cut_rims.h"
#include "geometry/mem.h"
#include <string.h>

/* A box of n x n squares to a side, outward. */
static surface block(double x0, double y0, double z0, double x1, double y1, double z1, int n)
{
    surface s = surface_new(6 * (n + 1) * (n + 1), 12 * n * n);
    int32_t t = 0;
    const double low[3] = {x0, y0, z0}, high[3] = {x1, y1, z1};
    for (int face = 0; face < 6; face++) {
        int axis = face / 2, side = face % 2, u = (axis + 1) % 3, v = (axis + 2) % 3, base = face * (n + 1) * (n + 1);
        for (int i = 0; i <= n; i++)
            for (int j = 0; j <= n; j++) {
                double *p = s.xyz + 3 * (base + i * (n + 1) + j);
                p[axis] = side ? high[axis] : low[axis];
                p[u] = low[u] + (high[u] - low[u]) * i / n;
                p[v] = low[v] + (high[v] - low[v]) * j / n;
            }
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) {
                int32_t a = base + i * (n + 1) + j, b = a + n + 1, c = b + 1, d = a + 1;
                int32_t quad[2][6] = {{a, c, b, a, d, c}, {a, b, c, a, c, d}};
                memcpy(s.tri + 3 * t, quad[side], sizeof quad[side]);
                t += 2;
            }
    }
    /* faces meet in shared vertices: weld */
    int32_t *first = NEW_ARRAY(int32_t, s.vertex_count);
    for (int32_t v = 0; v < s.vertex_count; v++) {
        first[v] = v;
        for (int32_t w = 0; w < v; w++)
            if (!memcmp(s.xyz + 3 * v, s.xyz + 3 * w, 3 * sizeof(double))) {
                first[v] = w;
                break;
            }
    }
    for (int32_t i = 0; i < 3 * s.triangle_count; i++) s.tri[i] = first[s.tri[i]];
    free(first);
    return s;
}

static double total_length(const cut_rims *r, int segment)
{
    double sum = 0;
    for (int i = 0; i < r->count[segment]; i++) {
        const double *p = r->piece[segment] + 6 * i;
        sum += sqrt(pow(p[3] - p[0], 2) + pow(p[4] - p[1], 2) + pow(p[5] - p[2], 2));
    }
    return sum;
}

static void the_rim_of_a_sawn_block_runs_once_around_each_half(void **state)
{
    (void)state;
    segments s = {0};
    s.part[SEGMENT_CRANIUM] = block(0, 0, 0.5, 20, 10, 12, 10);
    s.part[SEGMENT_MAXILLA] = block(0, 0, -8, 20, 10, 0, 10);
    cut_rims r = cut_rims_find(&s, 1.2);
    static const int sawn[] = {SEGMENT_CRANIUM, SEGMENT_MAXILLA};
    for (int k = 0; k < 2; k++) {
        assert_near(total_length(&r, sawn[k]), 60, 1e-9);
        for (int i = 0; i < r.count[sawn[k]]; i++)
            for (int end = 0; end < 2; end++) assert_near(r.piece[sawn[k]][6 * i + 3 * end + 2], k ? 0 : 0.5, 1e-12);
    }
    cut_rims_free(&r);
    cut_rims_free(&r);
    segments_free(&s);
}

static void teeth_that_touch_are_no_cut(void **state)
{
    (void)state;
    segments s = {0};
    s.part[SEGMENT_MAXILLA] = block(0, 0, 0.5, 20, 10, 12, 10);
    s.part[SEGMENT_DISTAL] = block(0, 0, -8, 20, 10, 0, 10);
    cut_rims r = cut_rims_find(&s, 1.2);
    for (int k = 0; k < SEGMENT_COUNT; k++) assert_int_equal(r.count[k], 0);
    cut_rims_free(&r);
    segments_free(&s);
}

static void far_halves_have_no_rim(void **state)
{
    (void)state;
    segments s = {0};
    s.part[SEGMENT_DISTAL] = block(0, 0, 3, 20, 10, 12, 4);
    s.part[SEGMENT_CHIN] = block(0, 0, -8, 20, 10, 0, 4);
    cut_rims r = cut_rims_find(&s, 1.2);
    for (int k = 0; k < SEGMENT_COUNT; k++) assert_int_equal(r.count[k], 0);
    cut_rims_free(&r);
    segments_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_rim_of_a_sawn_block_runs_once_around_each_half),
        cmocka_unit_test(teeth_that_touch_are_no_cut),
        cmocka_unit_test(far_halves_have_no_rim),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
