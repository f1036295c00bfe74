#include "app/cli/made_record.h"

static const void *next_file(const void *of, int *i, const char **key, void *space)
{
    (void)key, (void)space;
    return json_string_value(json_array_get(((const made_record *)of)->files, (size_t)*i));
}

static bool has_size(const void *of) { return ((const made_record *)of)->bytes > 0; }
static bool is_timed(const void *of) { return ((const made_record *)of)->timed; }

static const record_row rows[] = {
    {RECORD_AT(made_record, verb), .name = "verb", .words = "export|render|report", .help = "what made them"},
    ROW_TEXTS(next_file, "files", "paths of the files that were made"),
    ROW_WHEN(has_size, made_record, bytes, "bytes", NULL, "size of the page"),
    ROW_WHEN(is_timed, made_record, load_s, "seconds.load", "s", "wall time of reading the outcome"),
    ROW_WHEN(is_timed, made_record, draw_s, "seconds.draw", "s", "wall time of drawing"),
    ROW_WHEN(is_timed, made_record, draw_cpu_s, "seconds.draw_cpu", "s", "processor time of drawing"),
};
const record_table made_record_table = {
    .kind = "files", .title = "Record of gnathos export, render and report", RECORD_ROWS(rows)};
