#include "app/pictures/bounds.h"
#include "geometry/mem.h"
#include "render/chart.h"
#include "render/png_file.h"
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1600, COLOURS = 7, TEXT = 160 };

/* Told apart in all common forms of colour blindness: M. Okabe and K. Ito, "Color Universal Design", 2008. */
static const double colours[COLOURS][3] = {{0.84, 0.37, 0.00}, {0.00, 0.45, 0.70}, {0.90, 0.62, 0.00},
                                           {0.80, 0.47, 0.65}, {0.00, 0.62, 0.45}, {0.34, 0.71, 0.91},
                                           {0.94, 0.89, 0.26}};
static const double fine_rgb[3] = {0.96, 0.97, 0.96};

struct kinds {
    int count;
    chart_kind item[2 * LIMIT_COUNT + 1];
    char text[2 * LIMIT_COUNT + 1][TEXT];
};

static int by_count(const void *a, const void *b)
{
    const int64_t *p = a, *q = b; /* nodes, limit */
    return p[0] != q[0] ? (p[0] < q[0] ? 1 : -1) : p[1] < q[1] ? -1 : p[1] > q[1];
}

/* Fine is kind 0; the limits follow by how much of the map they decide, each with a stop and a caution. */
static void make_kinds(const feasible_map *m, struct kinds *out, int32_t *kind)
{
    int64_t seen[LIMIT_COUNT][2] = {0};
    int number[LIMIT_COUNT][3] = {0};
    for (int i = 0; i < LIMIT_COUNT; i++) seen[i][1] = i;
    for (int64_t i = 0; i < m->node_count; i++)
        if (m->node[i].level != VERDICT_FINE) seen[m->node[i].reason][0]++;
    qsort(seen, LIMIT_COUNT, sizeof seen[0], by_count);
    out->item[0] = (chart_kind){.rgb = {fine_rgb[0], fine_rgb[1], fine_rgb[2]}, .text = "fine"};
    out->count = 1;
    for (int i = 0; i < LIMIT_COUNT && seen[i][0]; i++)
        for (int level = VERDICT_STOP; level >= VERDICT_CAUTION; level--) {
            int64_t nodes = 0;
            for (int64_t n = 0; n < m->node_count; n++)
                nodes += m->node[n].level == level && m->node[n].reason == seen[i][1];
            if (!nodes) continue;
            int k = out->count++;
            const limit *l = &limit_default[seen[i][1]];
            snprintf(out->text[k], TEXT, "%s: %s%s", level == VERDICT_STOP ? "stop" : "caution",
                     seen[i][1] >= LIMIT_SOLVED ? "soft tissue, " : "", l->what);
            out->item[k] = (chart_kind){.pattern = level == VERDICT_STOP ? CHART_PLAIN
                                                   : i < COLOURS         ? CHART_DOTS
                                                                         : CHART_STRIPES,
                                        .rank = level,
                                        .letter = {(char)((level == VERDICT_STOP ? 'A' : 'a') + i % 26)},
                                        .text = out->text[k]};
            memcpy(out->item[k].rgb, colours[i % COLOURS], sizeof out->item[k].rgb);
            number[seen[i][1]][level] = k;
        }
    for (int64_t n = 0; n < m->node_count; n++)
        kind[n] = m->node[n].level == VERDICT_FINE ? 0 : number[m->node[n].reason][m->node[n].level];
}

static const char *title_of(const control *x, char text[TEXT])
{
    if (x->title)
        snprintf(text, TEXT, "%s, %s", x->title, x->unit);
    else
        snprintf(text, TEXT, "%s", x->name);
    return text;
}

/* The points of this plane at which the tissue was solved. */
static int add_solved(const audit *a, const feasible_map *m, chart_mark *mark)
{
    int count = 0;
    for (int i = 0; i < a->tissue.count; i++) {
        const int32_t *at = a->tissue.point[i].at;
        bool here = true;
        for (int k = 0; k < SAMPLE_AXES_MAX; k++)
            here &= at[k] == 0 || k == m->params.axis[0] || k == m->params.axis[1];
        if (!here) continue;
        mark[count] = (chart_mark){audit_value(a, m->params.axis[0], at[m->params.axis[0]]),
                                   audit_value(a, m->params.axis[1], at[m->params.axis[1]]), CHART_DOT,
                                   count ? NULL : "soft tissue solved here"};
        count++;
    }
    return count;
}

static chart_axis axis_of(const audit *a, const feasible_map *m, int k, char title[TEXT])
{
    int c = m->params.axis[k];
    return (chart_axis){.title = title_of(&a->settings.control[c], title),
                        .low = audit_value(a, c, m->params.low[k]),
                        .step = a->settings.spacing,
                        .count = m->count[k]};
}

/* What holds whatever these controls do. */
static void throughout_words(const audit *a, char *text, size_t size)
{
    *text = 0;
    for (int l = 0; l < LIMIT_COUNT; l++) {
        size_t n = strlen(text);
        if (a->throughout[l] > LIMIT_FINE)
            snprintf(text + n, size - n, "%s%s (%s)", n ? "; " : "Throughout, so not drawn: ", limit_default[l].what,
                     limit_level_name(a->throughout[l]));
    }
}

/* The solved points, where nothing is moved, and the plan. Returns their number. */
static int make_marks(const audit *a, const feasible_map *m, chart_mark *mark, char base[TEXT])
{
    int count = add_solved(a, m, mark);
    mark[count++] = (chart_mark){0, 0, CHART_CROSS, "nothing moved"};
    if (!*a->base.path) return count;
    snprintf(base, TEXT, "the plan: %.120s", a->base.name);
    mark[count++] =
        (chart_mark){audit_value(a, m->params.axis[0], 0), audit_value(a, m->params.axis[1], 0), CHART_RING, base};
    return count;
}

/* Fills what the map says: kinds and where they meet. The caller frees kind and both crossings. */
static void make_content(const feasible_map *m, struct kinds *kinds, int32_t **kind, double *crossing[2])
{
    *kind = NEW_ARRAY(int32_t, m->node_count);
    make_kinds(m, kinds, *kind);
    for (int k = 0; k < 2; k++) {
        crossing[k] = NEW_ARRAY(double, m->node_count);
        for (int64_t i = 0; i < m->node_count; i++) crossing[k][i] = m->edge[k][i] / m->params.spacing;
    }
}

static bool draw(const audit *a, int request, const char *path, err *e)
{
    const feasible_map *m = &a->map[request];
    const control *x = a->settings.control;
    char titles[2][TEXT], subtitle[2 * TEXT], base[TEXT], others[2 * TEXT], always[1024];
    struct kinds *kinds = NEW_ARRAY(struct kinds, 1);
    int32_t *kind;
    double *crossing[2];
    chart_mark *mark = NEW_ARRAY(chart_mark, 2 + a->tissue.count);
    int marks = make_marks(a, m, mark, base);
    make_content(m, kinds, &kind, crossing);
    throughout_words(a, always, sizeof always);
    snprintf(subtitle, sizeof subtitle, "%s, %.12s; other controls %s", a->patient->name, a->prepared->hash,
             *a->base.path ? "as in the plan" : "unmoved");
    snprintf(others, sizeof others,
             "Heavy line: where a limit stops, found to %.3g; light line: where caution begins. Colours name the limit "
             "that decides. Points are judged every %g, %g apart where nothing changes.",
             a->step, a->settings.spacing, a->settings.spacing * 2);
    const char *notes[] = {others, always};
    chart c = {.title = "What is feasible, and what stops it",
               .subtitle = subtitle,
               .x = axis_of(a, m, 0, titles[0]),
               .y = axis_of(a, m, 1, titles[1]),
               .kind = kind,
               .crossing = {crossing[0], crossing[1]},
               .veiled = m->behind_count ? m->behind : NULL,
               .veil_text = m->behind_count ? "feasible, but behind an infeasible point as seen from the base" : NULL,
               .kinds = kinds->item,
               .kind_count = kinds->count,
               .marks = mark,
               .mark_count = marks,
               .notes = notes,
               .note_count = *always ? 2 : 1};
    image im = {0};
    const png_note note[] = {{"case", a->prepared->hash}};
    bool same_unit = !strcmp(x[m->params.axis[0]].unit, x[m->params.axis[1]].unit);
    bool ok = chart_draw(&c, WIDTH, same_unit, &im, e) && png_file_write(&im, note, 1, path, e);
    image_free(&im);
    for (int k = 0; k < 2; k++) free(crossing[k]);
    free(mark);
    free(kind);
    free(kinds);
    return ok;
}

bool audit_write_pictures(const audit *a, const output_dir *dir, err *e)
{
    bool ok = true;
    for (int i = 0; ok && i < a->settings.request_count; i++) {
        if (a->settings.request[i].axis_count != 2) continue;
        char *name = audit_map_name(a, i, ".png"), *path = output_dir_file(dir, name);
        ok = draw(a, i, path, e);
        free(path);
        free(name);
    }
    return ok;
}
