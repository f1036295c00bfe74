#include "app/cli/new_record.h"

typedef struct measured {
    double asked, obtained;
} measured;

static const record_row measure_row[] = {
    ROW(measured, asked, "asked", NULL, "the value asked for"),
    ROW(measured, obtained, "obtained", NULL, "the value that the head has"),
};
static const record_table measure_table = {.title = "A measure of a synthetic head", RECORD_ROWS(measure_row)};

typedef struct new_record {
    const char *folder;
    const norm_head *head;
} new_record;

static const void *next_measure(const void *of, int *i, const char **key, void *space)
{
    const norm_head *h = ((const new_record *)of)->head;
    measured *m = space;
    if (*i == MEASURE_COUNT) return NULL;
    *key = measures[*i].name;
    *m = (measured){h->asked[*i], h->obtained[*i]};
    return m;
}

static const record_row new_row[] = {
    ROW(new_record, folder, "case", NULL, "folder of the new case"),
    ROW_MAP(next_measure, "measure", OBJECT, &measure_table, "measures", NULL,
            "what the head was built to (gnathos new --measures has their units)"),
};
const record_table new_record_table = {.kind = "new", .title = "Record of gnathos new", RECORD_ROWS(new_row)};

json_t *new_record_json(const char *folder, const norm_head *h)
{
    const new_record r = {folder, h};
    return record_json(&new_record_table, &r);
}
