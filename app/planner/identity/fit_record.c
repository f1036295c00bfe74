#include "app/planner/identity/fit_record.h"
#include <math.h>
#include <string.h>

static const head_fit *fit_of(const void *of) { return ((const fit_record *)of)->fit; }

double fit_share(const head_fit *f, case_surface part, head_guess why)
{
    int32_t count = f->gaps[part].vertices, found = 0;
    for (int32_t v = 0; v < count; v++) found += f->guessed[part][v] == why;
    return count ? (double)found / count : 0;
}

double fit_guessed_share(const head_fit *f, case_surface part)
{
    return fit_share(f, part, GUESS_ABSENT) + fit_share(f, part, GUESS_CLOSED);
}

bool fit_point_is_guessed(const fit_record *r, const head_point *p)
{
    if (p->triangle < 0) return fit_guessed_share(r->fit, (case_surface)p->part) > 0.5;
    const int32_t *corner = r->head->part[p->part].tri + 3 * (size_t)p->triangle;
    bool guessed = false;
    for (int k = 0; k < 3; k++) guessed = guessed || r->fit->guessed[p->part][corner[k]];
    return guessed;
}

case_guess fit_case_guess(const fit_record *r)
{
    case_guess g = {.jaw_turned_deg = r->completion ? r->completion->jaw.turn_deg : 0};
    for (int p = 0; p < CASE_SURFACE_COUNT; p++) g.share[p] = 1 - fit_share(r->fit, (case_surface)p, GUESS_NONE);
    for (int32_t i = 0; i < r->head->point_count && g.point_count < CASE_GUESSED_POINTS_MAX; i++)
        if (fit_point_is_guessed(r, &r->head->point[i]))
            memcpy(g.point[g.point_count++], r->head->point[i].label, LANDMARK_LABEL_SIZE);
    return g;
}

static double turn(const void *of) { return rigid_angle(&fit_of(of)->place.motion) * 180 / M_PI; }
static const void *motion(const void *of, void *space)
{
    rigid_to_matrix(&fit_of(of)->place.motion, space);
    return space;
}
static double scale(const void *of) { return fit_of(of)->place.scale; }
static const void *by_landmarks(const void *of, void *space)
{
    (void)space;
    return &fit_of(of)->place.by_landmarks;
}
static double median(const void *of) { return fit_of(of)->place.median_mm; }
static double turn_spread(const void *of) { return fit_of(of)->place.turn_spread_deg; }
static double shift_spread(const void *of) { return fit_of(of)->place.shift_spread_mm; }
static double min_j(const void *of) { return fit_of(of)->min_j; }
static double inverted(const void *of) { return fit_of(of)->inverted_tets; }
static double iterations(const void *of) { return fit_of(of)->iterations; }
static double factorisations(const void *of) { return fit_of(of)->factorisations; }
static double place_s(const void *of) { return fit_of(of)->place_s; }
static double bones_s(const void *of) { return fit_of(of)->bones_s; }
static double tissue_s(const void *of) { return fit_of(of)->tissue_s; }
static double total_s(const void *of) { return fit_of(of)->total_s; }

typedef struct part_fit {
    bool scanned;
    int vertices, with_target, scan_vertices, covered;
    double guessed, closed, missed, gap[3], back[3], back_missed;
} part_fit;
static const record_row part_row[] = {
    ROW(part_fit, scanned, "scanned", NULL, "whether the case has this surface; if not, all of it is guessed"),
    ROW(part_fit, vertices, "vertices", NULL, "of the template"),
    ROW(part_fit, with_target, "with_target", NULL, "of these, where the scan has a surface within 5 mm"),
    ROW(part_fit, guessed, "guessed_share", NULL, "share of the vertices that are guessed: absent and closed"),
    ROW(part_fit, closed, "closed_share", NULL, "share that went with a mouth that was closed (--complete)"),
    ROW(part_fit, missed, "missed_share", NULL, "share that the fit missed: the scan's surface is 5 to 15 mm off"),
    ROW(part_fit, gap[0], "mean_mm", "mm", "distance to the scan, where it has a surface"),
    ROW(part_fit, gap[1], "p95_mm", "mm", "the same, 95 % are nearer"),
    ROW(part_fit, gap[2], "max_mm", "mm", "the same, the farthest"),
    ROW(part_fit, scan_vertices, "scan.vertices", NULL, "of the scan"),
    ROW(part_fit, covered, "scan.covered", NULL, "of these, on the outside and within 15 mm of the template"),
    ROW(part_fit, back[0], "scan.mean_mm", "mm", "distance of those from the fitted template"),
    ROW(part_fit, back[1], "scan.p95_mm", "mm", "the same, 95 % are nearer"),
    ROW(part_fit, back[2], "scan.max_mm", "mm", "the same, the farthest"),
    ROW(part_fit, back_missed, "scan.missed_share", NULL, "share of those that are more than 5 mm off"),
};
static const record_table part_table = {.title = "How a part of the template lies on the scan", RECORD_ROWS(part_row)};

static void put_gaps(const registration_gaps *g, double out[3])
{
    out[0] = g->with_target ? g->mean_mm : (double)NAN;
    out[1] = g->with_target ? g->p95_mm : (double)NAN;
    out[2] = g->with_target ? g->max_mm : (double)NAN;
}

static const void *next_part(const void *of, int *i, const char **key, void *space)
{
    if (*i == CASE_SURFACE_COUNT) return NULL;
    const head_fit *f = fit_of(of);
    case_surface which = (case_surface)*i;
    part_fit *p = space;
    *key = case_surface_name(which);
    *p = (part_fit){.scanned = ((const fit_record *)of)->scan->part[which].triangle_count > 0,
                    .vertices = f->gaps[which].vertices,
                    .with_target = f->gaps[which].with_target,
                    .scan_vertices = f->back[which].vertices,
                    .covered = f->back[which].with_target,
                    .guessed = fit_guessed_share(f, which),
                    .closed = fit_share(f, which, GUESS_CLOSED),
                    .missed = fit_share(f, which, GUESS_MISSED),
                    .back_missed = f->back[which].with_target ? f->back_missed[which] : (double)NAN};
    put_gaps(&f->gaps[which], p->gap);
    put_gaps(&f->back[which], p->back);
    return p;
}

static const void *next_guessed_point(const void *of, int *i, const char **key, void *space)
{
    const fit_record *r = of;
    (void)key, (void)space;
    while (*i < r->head->point_count && !fit_point_is_guessed(r, &r->head->point[*i])) (*i)++;
    return *i < r->head->point_count ? r->head->point[*i].label : NULL;
}

static const char *template_numbering(const void *of, char *space)
{
    return (void)space, ((const fit_record *)of)->head->numbering;
}

static const void *next_coefficient(const void *of, int *i, const char **key, void *space)
{
    (void)key, (void)space;
    const head_likeliest *l = &((const head_completion *)of)->likeliest;
    return *i < l->mode_count ? &l->p[*i] : NULL;
}
static bool by_model(const void *of) { return ((const head_completion *)of)->likeliest.mode_count > 0; }

static const record_row completion_row[] = {
    ROW_WORD(head_completion, jaw.stop, "jaw.stop", "not_open|at_bite|at_teeth|at_limit",
             "what ended the turn that closes an open mouth: the template's overlap of the incisors, other teeth, the "
             "joint"),
    ROW(head_completion, jaw.open_mm, "jaw.open_mm", "mm",
        "by which the incisors' edges lie apart, upwards, from where they overlap as the template's do"),
    ROW(head_completion, jaw.turn_deg, "jaw.turn_deg", "deg", "by which the mandible was turned up about its condyles"),
    ROW(head_completion, jaw.left_mm, "jaw.left_mm", "mm", "of open_mm that is left"),
    {.kind = RECORD_LIST,
     .next = next_coefficient,
     .item = RECORD_NUMBER,
     .name = "p",
     .when = by_model,
     .help = "coefficients of the model's likeliest head, in standard deviations"},
    ROW_WHEN(by_model, head_completion, likeliest.noise_mm, "noise_mm", "mm",
             "standard deviation that a coordinate of the scan was taken to have for that"),
};
static const record_table completion_table = {.title = "How a scan was made a whole head", RECORD_ROWS(completion_row)};

static const record_row rows[] = {
    ROW(fit_record, patient, "case", NULL, "path of the case"),
    ROW_TEXT(template_numbering, "numbering", "of the template (gnathos template)"),
    {.kind = RECORD_NUMBERS,
     .length = 16,
     .at = motion,
     .name = "place.matrix",
     .help = "x' = motion(scale x), from the template to the patient as a whole, row by row, LPS mm"},
    ROW_FOUND(NUMBER, turn, "place.turn_deg", "deg", "angle of that motion"),
    ROW_FOUND(NUMBER, scale, "place.scale", NULL, "size of the patient against the template"),
    {.kind = RECORD_BOOL, .at = by_landmarks, .name = "place.by_landmarks", .help = "else by the surfaces alone"},
    ROW_FOUND(NUMBER, median, "place.median_mm", "mm", "distance of the scan from the placed template"),
    ROW_FOUND(NUMBER, turn_spread, "place.turn_spread_deg", "deg", "between starts that end about as well"),
    ROW_FOUND(NUMBER, shift_spread, "place.shift_spread_mm", "mm", "between starts that end about as well"),
    ROW(fit_record, told, "place.told", NULL, "what was found out of the ordinary, as other axes; or empty"),
    ROW_MAP(next_part, "part", OBJECT, &part_table, "parts", NULL, "how each part lies on the scan"),
    ROW_TEXTS(next_guessed_point, "guessed_landmarks", "labels that hang where the scan has nothing"),
    {.kind = RECORD_OBJECT,
     .offset = offsetof(fit_record, completion),
     .pointer = true,
     .optional = true,
     .table = &completion_table,
     .name = "completion",
     .help = "with --complete"},
    ROW_FOUND(NUMBER, min_j, "tissue.min_j", NULL,
              "smallest volume of a tet, at rest and neutral, against the template's at the patient's size"),
    ROW_FOUND(NUMBER, inverted, "tissue.inverted_tets", NULL, "tets turned inside out; always 0"),
    ROW_FOUND(NUMBER, iterations, "solve.iterations", NULL, "of all solves"),
    ROW_FOUND(NUMBER, factorisations, "solve.factorisations", NULL, "of all solves"),
    ROW_FOUND(NUMBER, place_s, "seconds.place", "s", "wall time of finding the place"),
    ROW_FOUND(NUMBER, bones_s, "seconds.bones", "s", "wall time of bending the whole, the bones and the teeth"),
    ROW_FOUND(NUMBER, tissue_s, "seconds.tissue", "s", "wall time of tissue and skin"),
    ROW_FOUND(NUMBER, total_s, "seconds.total", "s", "wall time of the fit"),
};
const record_table fit_record_table = {.kind = "fit", .title = "Record of gnathos fit", RECORD_ROWS(rows)};
