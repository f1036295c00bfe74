#include "app/cli/landmarks_record.h"

typedef struct placed_point {
    const char *label;
    double at[3], doubt_mm, moved_mm, spread_mm, gap_mm;
    bool by_definition, used;
} placed_point;

static const record_row point_row[] = {
    ROW(placed_point, label, "label", NULL, "its label"),
    ROW(placed_point, at, "lps_mm", "LPS mm", "where it is"),
    ROW(placed_point, doubt_mm, "doubt_mm", "mm", "about how far off it may be"),
    ROW(placed_point, by_definition, "by_definition", NULL, "found on the surface by its definition, not only carried"),
    ROW(placed_point, moved_mm, "moved_mm", "mm", "from where the template carried it"),
    ROW(placed_point, spread_mm, "spread_mm", "mm", "of where it ends, carried 2 mm to each side"),
    ROW(placed_point, gap_mm, "gap_mm", "mm", "between fitted template and patient around it; null: nothing there"),
    ROW(placed_point, used, "placed", NULL, "false: too doubtful to be written as placed"),
};
static const record_table point_table = {.title = "A landmark that the program placed", RECORD_ROWS(point_row)};

static const void *next_point(const void *of, int *i, const char **key, void *space)
{
    const landmarks_record *r = of;
    placed_point *p = space;
    (void)key;
    if (*i >= r->found->count) return NULL;
    const head_landmark *l = &r->found->item[*i];
    *p = (placed_point){.label = l->label,
                        .at = {l->at[0], l->at[1], l->at[2]},
                        .doubt_mm = l->doubt_mm,
                        .moved_mm = l->moved_mm,
                        .spread_mm = l->spread_mm,
                        .gap_mm = l->gap_mm,
                        .by_definition = l->by_definition,
                        .used = l->doubt_mm <= r->most_mm};
    return p;
}

static const char *mouth(const void *of, char *space)
{
    (void)space;
    return ((const landmarks_record *)of)->found->mouth_open ? "open" : "closed";
}

static const record_row rows[] = {
    ROW(landmarks_record, path, "file", NULL, "the markups that were written"),
    ROW(landmarks_record, most_mm, "bound_mm", "mm", "the doubt beyond which a point is not written as placed"),
    {.name = "mouth", .kind = RECORD_TEXT, .text = mouth, .words = "open|closed", .help = "as its lips are found"},
    ROW_LIST(next_point, &point_table, "landmarks", "every landmark that the template knows"),
};
const record_table landmarks_record_table = {
    .kind = "landmarks", .title = "Record of gnathos landmarks", RECORD_ROWS(rows)};
