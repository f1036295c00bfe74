#include "app/planner/bounds/audit_record.h"
#include <math.h>
#include <string.h>

static const void *next_control(const void *of, int *i, const char **key, void *space)
{
    const audit_place *p = of;
    if (*i == p->of->settings.control_count) return NULL;
    *key = p->of->settings.control[*i].name;
    *(double *)space = audit_value(p->of, *i, p->at[*i]);
    return space;
}

/* A place as a map from controls to values. */
#define PLACE(type, member, name_, when_, help_)                                                                       \
    {                                                                                                                  \
        .kind = RECORD_MAP, .offset = offsetof(type, member), .next = next_control, .item = RECORD_NUMBER,             \
        .key = "control", .name = name_, .when = when_, .help = help_                                                  \
    }

static bool is_estimated(const void *of) { return ((const audit_finding *)of)->estimated; }
static bool has_place(const void *of) { return ((const audit_finding *)of)->has_place; }
static bool has_level(const void *of) { return ((const audit_finding *)of)->level != LIMIT_NOT_JUDGED; }

static const record_row finding_row[] = {
    ROW(audit_finding, limit, "limit", NULL, "name of the limit"),
    ROW(audit_finding, where, "where", NULL, "side or place, empty where there is but one"),
    ROW(audit_finding, value, "value", NULL, "of it, in its unit"),
    ROW(audit_finding, unit, "unit", NULL, "the unit"),
    ROW(audit_finding, stop, "stop", NULL, "range beyond which it stops; null: open"),
    ROW_WHEN(is_estimated, audit_finding, estimated, "estimated", NULL, "it rests on an estimated point"),
    ROW_WHEN(has_place, audit_finding, place, "place_mm", "LPS mm", "where it is"),
    {RECORD_AT(audit_finding, level), .name = "level", .words = "not judged|fine|caution|stop", .when = has_level,
     .help = "its level whatever the controls do"},
};
static const record_table finding_table = {.title = "What limits", RECORD_ROWS(finding_row)};

static bool is_solved(const void *of) { return ((const audit_ray_view *)of)->solved; }

static const record_row ray_row[] = {
    PLACE(audit_ray_view, reach, "reach", NULL, "how far it goes"),
    ROW(audit_ray_view, solved, "solved", NULL, "the tissue was solved there"),
    ROW(audit_ray_view, limited, "limited", NULL, "the tissue ends it before bone and teeth do"),
    {.kind = RECORD_WORD,
     .offset = offsetof(audit_ray_view, level),
     .words = "fine|caution|stop",
     .when = is_solved,
     .name = "level",
     .help = "of the tissue there, or of what stops it"},
    ROW_WHEN(is_solved, audit_ray_view, limit, "limit", NULL, "the limit that decides there"),
    ROW_WHEN(is_solved, audit_ray_view, value, "value", NULL, "its value"),
};
static const record_table ray_table = {.title = "A direction from the base", RECORD_ROWS(ray_row)};

audit_ray_view audit_ray_view_of(const audit *a, const audit_ray *r)
{
    audit_ray_view v = {.reach = {.of = a},
                        .solved = r->allowed > 0,
                        .limited = r->limited,
                        .level = r->v.level,
                        .limit = limit_default[r->v.reason].name,
                        .value = r->v.value};
    audit_ray_place(r, v.reach.at);
    return v;
}

static const void *caution(const void *of, void *space)
{
    const audit_end *b = of;
    (void)space;
    return b->has_caution ? &b->caution : NULL;
}

static const void *stop(const void *of, void *space)
{
    const audit_end *b = of;
    (void)space;
    return b->has_stop ? &b->stop : NULL;
}

static bool has_ray(const void *of) { return ((const audit_end *)of)->has_ray; }

static const record_row end_row[] = {
    ROW(audit_end, fine, "fine_to", NULL, "last value that is fine"),
    ROW(audit_end, reach, "feasible_to", NULL, "last value that is feasible"),
    {.kind = RECORD_OBJECT,
     .at = caution,
     .table = &finding_table,
     .or_null = true,
     .name = "caution_beyond",
     .help = "what is not fine beyond the first"},
    {.kind = RECORD_OBJECT,
     .at = stop,
     .table = &finding_table,
     .or_null = true,
     .name = "stopped_beyond",
     .help = "what stops beyond the second"},
    {.kind = RECORD_OBJECT,
     .offset = offsetof(audit_end, ray),
     .table = &ray_table,
     .when = has_ray,
     .name = "tissue",
     .help = "what the tissue says there"},
};
static const record_table end_table = {.title = "An end of a control", RECORD_ROWS(end_row)};

typedef struct piece_view {
    double from, to, value;
    int level;
    const char *limit;
} piece_view;

static const record_row piece_row[] = {
    ROW(piece_view, from, "from", NULL, "first value"),
    ROW(piece_view, to, "to", NULL, "last value"),
    {.kind = RECORD_WORD,
     .offset = offsetof(piece_view, level),
     .words = "fine|caution|stop",
     .name = "level",
     .help = "its level"},
    ROW(piece_view, limit, "limit", NULL, "the limit that decides where it begins"),
    ROW(piece_view, value, "value", NULL, "its value there"),
};
static const record_table piece_table = {.title = "Values of one level in a row", RECORD_ROWS(piece_row)};

static const void *next_piece(const void *of, int *i, const char **key, void *space)
{
    const audit_line_view *v = of;
    (void)key;
    if (*i == v->line->piece_count) return NULL;
    const line_piece *p = &v->line->piece[*i];
    piece_view *out = space;
    *out = (piece_view){.from = audit_value(v->of, v->which, p->from),
                        .to = audit_value(v->of, v->which, p->to),
                        .value = p->value,
                        .level = p->level,
                        .limit = limit_default[p->reason].name};
    return out;
}

static const record_row line_row[] = {
    ROW(audit_line_view, control, "control", NULL, "name of the control"),
    ROW(audit_line_view, unit, "unit", NULL, "its unit"),
    ROW(audit_line_view, base, "base", NULL, "its value in the base"),
    ROW(audit_line_view, box, "box", NULL, "the range that was looked at"),
    ROW(audit_line_view, base_feasible, "base_feasible", NULL, "the base is feasible"),
    ROW_OBJECT(audit_line_view, low, &end_table, "low", "downwards from the base"),
    ROW_OBJECT(audit_line_view, high, &end_table, "high", "upwards from the base"),
    ROW_LIST(next_piece, &piece_table, "pieces", "the whole range, in pieces of one level"),
};
static const record_table line_table = {.title = "Bounds of a control", RECORD_ROWS(line_row)};

static const void *next_axis(const void *of, int *i, const char **key, void *space)
{
    const audit_map_view *v = of;
    (void)key, (void)space;
    return *i < v->map->params.axis_count ? v->of->settings.control[v->map->params.axis[*i]].name : NULL;
}

static double nodes(const void *of) { return (double)((const audit_map_view *)of)->map->node_count; }
static double count_of(const void *of, int level)
{
    return (double)((const audit_map_view *)of)->map->level_count[level];
}
static double fine_nodes(const void *of) { return count_of(of, VERDICT_FINE); }
static double caution_nodes(const void *of) { return count_of(of, VERDICT_CAUTION); }
static double stop_nodes(const void *of) { return count_of(of, VERDICT_STOP); }
static double behind_nodes(const void *of) { return (double)((const audit_map_view *)of)->map->behind_count; }

static double is_star(const void *of)
{
    const feasible_map *m = ((const audit_map_view *)of)->map;
    return m->base_stopped ? (double)NAN : !m->behind_count;
}

static bool has_behind(const void *of) { return behind_nodes(of) > 0; }
static bool is_asked(const void *of) { return ((const audit_map_view *)of)->asked; }

static const void *next_ray(const void *of, int *i, const char **key, void *space)
{
    const audit_map_view *v = of;
    const int *ray = v->of->request_ray[v->request], end = v->map->params.axis_count == 2 ? 9 : 27;
    (void)key;
    while (*i < end && ray[*i] < 0) ++*i;
    if (*i >= end) return NULL;
    *(audit_ray_view *)space = audit_ray_view_of(v->of, &v->of->ray[ray[*i]]);
    return space;
}

static const record_row map_row[] = {
    ROW_TEXTS(next_axis, "controls", "its controls"),
    ROW(audit_map_view, files, "files", NULL, "name of its files, without the ending"),
    ROW_FOUND(LONG, nodes, "nodes", NULL, "points of the grid"),
    ROW(audit_map_view, judged, "judged", NULL, "of them, judged; the others lie between equal ones"),
    ROW_FOUND(LONG, fine_nodes, "levels.fine", NULL, "points that are fine"),
    ROW_FOUND(LONG, caution_nodes, "levels.caution", NULL, "points of caution"),
    ROW_FOUND(LONG, stop_nodes, "levels.stop", NULL, "points that are stopped"),
    {.kind = RECORD_BOOL,
     .number = is_star,
     .or_null = true,
     .name = "star_shaped",
     .help = "every feasible point is reached from the base straight on; null: the base itself is stopped"},
    ROW_FOUND(LONG, behind_nodes, "nodes_behind", NULL, "feasible points that are not"),
    PLACE(audit_map_view, feasible, "behind_example.feasible", has_behind, "one of these"),
    PLACE(audit_map_view, stopped, "behind_example.stopped_before", has_behind, "a point on the way that is stopped"),
    {.kind = RECORD_LIST,
     .next = next_ray,
     .item = RECORD_OBJECT,
     .table = &ray_table,
     .when = is_asked,
     .name = "tissue_rim",
     .help = "what the tissue says on the rim of what bone and teeth allow"},
    ROW_WHEN(is_asked, audit_map_view, further, "nodes_further_out_than_solved", NULL,
             "points further out than the tissue was asked"),
};
static const record_table map_table = {.title = "A map over two or three controls", RECORD_ROWS(map_row)};

typedef struct limit_view {
    int number;
    const char *name, *what, *unit, *source;
    double fine[2], stop[2];
} limit_view;

static const void *next_limit(const void *of, int *i, const char **key, void *space)
{
    const case_file *c = ((const audit_view *)of)->patient;
    (void)key;
    if (*i == LIMIT_COUNT) return NULL;
    const limit *l = &limit_default[*i];
    limit_view *v = space;
    *v = (limit_view){.number = *i,
                      .name = l->name,
                      .what = l->what,
                      .unit = l->unit,
                      .source = c->limit_from_case[*i] ? "set by the case" : l->source};
    memcpy(v->fine, c->limits[*i].fine, sizeof v->fine);
    memcpy(v->stop, c->limits[*i].stop, sizeof v->stop);
    return v;
}

static const record_row limit_row[] = {
    ROW(limit_view, number, "number", NULL, "its number in the .vti files"),
    ROW(limit_view, name, "name", NULL, "its name"),
    ROW(limit_view, what, "what", NULL, "what it limits"),
    ROW(limit_view, unit, "unit", NULL, "its unit, empty where it has none"),
    ROW(limit_view, fine, "fine", NULL, "range that is fine; null: open"),
    ROW(limit_view, stop, "stop", NULL, "range beyond which it stops; null: open"),
    ROW(limit_view, source, "source", NULL, "where it comes from"),
};
static const record_table limit_table = {.title = "A limit", RECORD_ROWS(limit_row)};

static const record_row gap_row[] = {
    ROW(audit_gap, limit, "limit", NULL, "name of the limit"),
    ROW(audit_gap, what, "what", NULL, "what it limits"),
    ROW(audit_gap, why, "why", NULL, "why nothing is said of it"),
};
static const record_table gap_table = {.title = "A limit that is not judged", RECORD_ROWS(gap_row)};

static const void *next_gap(const void *of, int *i, const char **key, void *space)
{
    const audit_view *v = of;
    (void)key, (void)space;
    return *i < v->unknown ? &v->gap[*i] : NULL;
}

static const record_row tissue_row[] = {
    ROW(audit_tissue_view, contact, "contact", NULL, "whether its contact with bone is counted in"),
    ROW(audit_tissue_view, allowed, "points_that_bone_and_teeth_allow", NULL, "judged points that are not stopped"),
    ROW(audit_tissue_view, solves, "solves", NULL, "of them, solved"),
    ROW(audit_tissue_view, left_out, "solves_left_out", NULL, "of them, taken from those"),
    ROW(audit_tissue_view, rounds, "rounds", NULL, "rounds of solves"),
    ROW(audit_tissue_view, warm, "started_from_a_neighbour", NULL, "solves that began at another's result"),
    ROW(audit_tissue_view, iterations, "iterations", NULL, "of all solves"),
};
static const record_table tissue_table = {.title = "The tissue's part", RECORD_ROWS(tissue_row)};

static const void *tissue_part(const void *of, void *space)
{
    const audit_view *v = of;
    (void)space;
    return v->has_tissue ? &v->tissue : NULL;
}

static const record_row audit_row[] = {
    ROW(audit_view, case_name, "case", NULL, "name of the case"),
    ROW(audit_view, hash, "hash", NULL, "of everything of the case that it rests on"),
    ROW(audit_view, spacing, "spacing", "mm or degrees", "between the points of a map"),
    ROW(audit_view, tolerance, "tolerance", "mm or degrees", "to which bounds were asked"),
    ROW(audit_view, step, "step", "mm or degrees", "to which they are found"),
    PLACE(audit_view, base, "base", NULL, "the plan that it starts from"),
    ROW(audit_view, points, "points", NULL, "plans that were judged"),
    ROW_ARRAY(audit_view, line, lines, &line_table, "bounds", "how far each control goes alone"),
    ROW_ARRAY(audit_view, map, maps, &map_table, "maps", "over two or three controls"),
    ROW_LIST(next_limit, &limit_table, "limits", "all limits, as they hold for the case"),
    ROW_ARRAY(audit_view, throughout, always, &finding_table, "throughout", "what is not fine whatever they do"),
    ROW_LIST(next_gap, &gap_table, "not_judged", "limits of which nothing is said"),
    {.kind = RECORD_OBJECT,
     .at = tissue_part,
     .table = &tissue_table,
     .or_null = true,
     .name = "tissue",
     .help = "what was solved of the tissue"},
};
const record_table audit_table = {
    .kind = "audit", .title = "Record of gnathos audit of a case, audit.json", RECORD_ROWS(audit_row)};
