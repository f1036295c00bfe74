/* What gnathos identities writes and prints for programs. */
#include "app/identities/identities.h"
#include "geometry/mem.h"
#include <math.h>

static const record_row gap_row[] = {
    ROW(head_gap, mean_mm, "mean_mm", "mm", "mean distance of vertices from the same vertices"),
    ROW(head_gap, p95_mm, "p95_mm", "mm", "distance that 95 % do not exceed"),
    ROW(head_gap, max_mm, "max_mm", "mm", "largest distance"),
};
static const record_table gap_table = {.title = "How far one head is from another", RECORD_ROWS(gap_row)};

static const void *next_gap(const head_gap *gap, int i, const char **key)
{
    if (i >= HEAD_GAP_COUNT) return NULL;
    *key = head_gap_name(i);
    return &gap[i];
}

typedef struct mode_view {
    double sd_mm, share, left_out_mm;
} mode_view;

static const record_row mode_row[] = {
    ROW(mode_view, sd_mm, "sd_mm", "mm", "root mean square move of the head by one standard deviation"),
    ROW(mode_view, share, "share", NULL, "of the variance"),
    ROW(mode_view, left_out_mm, "left_out_rms_mm", "mm",
        "root mean square error of a head that was left out, with this and all modes before it"),
};
static const record_table mode_table = {.title = "A direction in which heads differ", RECORD_ROWS(mode_row)};

static const identities_learnt *learnt_of(const void *of) { return of; }

static const void *next_mode(const void *of, int *i, const char **key, void *space)
{
    const head_model *m = &learnt_of(of)->model;
    (void)key;
    if (*i >= m->modes.mode_count) return NULL;
    double *rms = m->left_out_rms_mm;
    mode_view *v = space;
    *v = (mode_view){m->modes.sd[*i] / sqrt(HEAD_BLOCK_COUNT - 1), principal_share(&m->modes, *i),
                     *i + 1 <= m->left_out_modes ? rms[*i + 1] : (double)NAN};
    return v;
}

static const void *next_name(const void *of, int *i, const char **key, void *space)
{
    const head_model *m = &learnt_of(of)->model;
    (void)key, (void)space;
    return *i < m->modes.sample_count ? m->name[*i] : NULL;
}

static const void *next_left_out(const void *of, int *i, const char **key, void *space)
{
    (void)space;
    return next_gap(learnt_of(of)->model.left_out, *i, key);
}

static double heads(const void *of) { return learnt_of(of)->model.modes.sample_count; }
static bool was_learnt(const void *of) { return learnt_of(of)->bytes > 0; }

static const record_row learnt_row[] = {
    ROW_FOUND(NUMBER, heads, "heads", NULL, "heads it was learnt from"),
    ROW(identities_learnt, model.numbering, "numbering", NULL, "hash of the numbering of the template that was fitted"),
    ROW_WHEN(was_learnt, identities_learnt, refused, "refused", NULL, "heads that could not be had"),
    ROW_WHEN(was_learnt, identities_learnt, fresh, "fitted", NULL, "heads that were fitted in this run"),
    ROW_WHEN(was_learnt, identities_learnt, fit_s, "seconds.fit", "s", "wall time of these fits"),
    ROW_WHEN(was_learnt, identities_learnt, learn_s, "seconds.learn", "s", "wall time of learning"),
    ROW_WHEN(was_learnt, identities_learnt, bytes, "bytes", NULL, "size of the model's file"),
    ROW_LIST(next_mode, &mode_table, "modes", "directions in which heads differ"),
    ROW_MAP(next_left_out, "part", OBJECT, &gap_table, "left_out", NULL,
            "each head made from all others: mean of the heads' means and 95 %, largest of all"),
    ROW_TEXTS(next_name, "names", "the heads"),
};
const record_table identities_table = {.kind = "identities",
                                       .title = "A model of identities, of gnathos identities learn and show",
                                       RECORD_ROWS(learnt_row)};

typedef struct numbers {
    const double *p;
    int count;
} numbers;

static const void *next_number(const numbers *n, int i) { return i < n->count ? &n->p[i] : NULL; }

static const void *next_coefficient(const void *of, int *i, const char **key, void *space)
{
    const identities_projection *p = of;
    (void)key, (void)space;
    return next_number(&(numbers){p->p, p->model->modes.mode_count}, *i);
}

static const void *next_error(const void *of, int *i, const char **key, void *space)
{
    (void)space;
    return next_gap(((const identities_projection *)of)->gap, *i, key);
}

static const record_row projection_row[] = {
    ROW(identities_projection, name, "case", NULL, "name of the case"),
    {.kind = RECORD_LIST,
     .next = next_coefficient,
     .item = RECORD_NUMBER,
     .name = "p",
     .help = "coefficients, in standard deviations of their modes"},
    ROW_MAP(next_error, "part", OBJECT, &gap_table, "error", NULL, "of what the model makes of the head"),
    ROW(identities_projection, guessed, "guessed", NULL,
        "share of the skin that is not in the scan: it decides nothing and is in no error"),
    ROW(identities_projection, fit_s, "seconds.fit", "s", "wall time of the fit"),
};
const record_table identity_table = {.kind = "identity",
                                     .title = "A head in a model of identities, of gnathos identities project",
                                     RECORD_ROWS(projection_row)};

static const void *next_given(const void *of, int *i, const char **key, void *space)
{
    const identities_made *m = of;
    (void)key, (void)space;
    return next_number(&(numbers){m->p, m->p_count}, *i);
}

static bool is_random(const void *of) { return ((const identities_made *)of)->random; }
static double seed(const void *of) { return (double)((const identities_made *)of)->seed; }
static double inverted(const void *of) { return ((const identities_made *)of)->sound.inverted_tets; }

static const record_row made_row[] = {
    ROW(identities_made, folder, "case", NULL, "the folder that was made"),
    {.kind = RECORD_NUMBER, .number = seed, .name = "seed", .when = is_random, .help = "of the draw"},
    ROW_WHEN(is_random, identities_made, tries, "draws", NULL, "until one was a head"),
    {.kind = RECORD_LIST,
     .next = next_given,
     .item = RECORD_NUMBER,
     .name = "p",
     .help = "coefficients, in standard deviations of their modes; those of further modes are 0"},
    ROW(identities_made, sound.min_j, "min_J", NULL, "least volume of a tetrahedron over its volume in the template"),
    ROW_FOUND(NUMBER, inverted, "inverted_tets", NULL, "tetrahedra turned inside out"),
    ROW(identities_made, tissue_anew, "tissue_anew", NULL,
        "the tissue that the modes made had some: it is the elastic one between the parts instead"),
    ROW(identities_made, sound.bone_out_mm, "bone_out_mm", "mm", "farthest that bone lies outside the skin"),
    ROW(identities_made, sound.teeth_overlap_mm, "teeth_overlap_mm", "mm",
        "deepest that upper and lower teeth lie in each other"),
};
const record_table identity_made_table = {
    .kind = "identity_made", .title = "A head that was made, of gnathos identities make", RECORD_ROWS(made_row)};

json_t *identities_json(const identities_learnt *l) { return record_json(&identities_table, l); }
json_t *identity_json(const identities_projection *p) { return record_json(&identity_table, p); }
json_t *identity_made_json(const identities_made *m) { return record_json(&identity_made_table, m); }
