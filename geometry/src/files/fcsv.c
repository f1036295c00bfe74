#include "geometry/src/files/fcsv.h"
#include "geometry/input_file.h"
#include "geometry/mem.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MAX_FIELDS = 32, POSITION_DEFINED = 2 };

typedef struct columns {
    int x, y, z, label;
} columns;

void fcsv_free(fcsv_file *f)
{
    free(f->row);
    *f = (fcsv_file){0};
}

/* Splits in place at commas outside quotes; a quote counts at the start of a field only, "" inside is one
 * quote. */
static int split(char *line, char *field[MAX_FIELDS])
{
    int n = 0;
    char *from = line, *to = line;
    bool quoted = false;
    field[n++] = to;
    for (; *from; from++) {
        if (*from == '"' && quoted && from[1] == '"')
            *to++ = *from++;
        else if (*from == '"' && (quoted || to == field[n - 1]))
            quoted = !quoted;
        else if (*from == ',' && !quoted && n < MAX_FIELDS) {
            *to++ = 0;
            field[n++] = to;
        } else
            *to++ = *from;
    }
    *to = 0;
    return n;
}

static char *trim(char *text)
{
    while (*text == ' ' || *text == '\t') text++;
    for (size_t n = strlen(text); n && strchr(" \t\r\n", text[n - 1]); n--) text[n - 1] = 0;
    return text;
}

static bool read_number(const char *text, double *value)
{
    char *end;
    *value = strtod(text, &end);
    return end != text && !*trim(end) && isfinite(*value);
}

/* A line "# key = value"; system: -1 unknown, 0 RAS, 1 LPS */
static bool read_comment(char *text, const char *path, int line, int *system, columns *at, err *e)
{
    char *value = strchr(text, '=');
    if (!value) return true;
    *value++ = 0;
    char *key = trim(text + 1);
    value = trim(value);
    if (!strcasecmp(key, "CoordinateSystem")) {
        *system = !strcasecmp(value, "LPS") || !strcmp(value, "1")   ? 1
                  : !strcasecmp(value, "RAS") || !strcmp(value, "0") ? 0
                                                                     : -1;
        if (*system < 0)
            return err_at(e, ERR_INPUT, path, line, "CoordinateSystem", "must be LPS or RAS, is %s", value);
    } else if (!strcasecmp(key, "columns")) {
        char *field[MAX_FIELDS];
        int n = split(value, field);
        *at = (columns){-1, -1, -1, -1};
        for (int i = 0; i < n; i++) {
            const char *name = trim(field[i]);
            if (!strcmp(name, "x")) at->x = i;
            if (!strcmp(name, "y")) at->y = i;
            if (!strcmp(name, "z")) at->z = i;
            if (!strcmp(name, "label")) at->label = i;
        }
        if (at->x < 0 || at->y < 0 || at->z < 0 || at->label < 0)
            return err_at(e, ERR_INPUT, path, line, "columns", "must name x, y, z and label");
    }
    return true;
}

static bool read_row(char *text, const char *path, int line, int system, const columns *at, fcsv_row *row, err *e)
{
    char *field[MAX_FIELDS];
    int n = split(text, field);
    if (system < 0)
        return err_at(e, ERR_INPUT, path, line, NULL,
                      "a point before any line \"# CoordinateSystem = LPS\" (or RAS): add the line that is true");
    if (n <= at->x || n <= at->y || n <= at->z || n <= at->label)
        return err_at(e, ERR_INPUT, path, line, NULL, "has %d columns: too few for x, y, z and label", n);
    /* Slicer 5 appends two columns to the 14 named ones: the status of the position, and who made it. */
    int status = n >= 16 ? 14 : -1;
    double value = POSITION_DEFINED;
    if (status >= 0 && !read_number(field[status], &value))
        return err_at(e, ERR_INPUT, path, line, NULL, "column %d must be a number", status + 1);
    row->defined = value == POSITION_DEFINED;
    row->line = line;
    const char *label = trim(field[at->label]);
    if (strlen(label) >= sizeof row->label) return err_at(e, ERR_INPUT, path, line, NULL, "the label is too long");
    memcpy(row->label, label, strlen(label) + 1);
    if (!row->defined) return true;
    const int column[3] = {at->x, at->y, at->z};
    for (int c = 0; c < 3; c++)
        if (!read_number(field[column[c]], row->xyz + c))
            return err_at(e, ERR_INPUT, path, line, NULL, "the landmark \"%s\" has \"%.40s\" for %c, must be a number",
                          label, field[column[c]], 'x' + c);
    if (system == 0) {
        row->xyz[0] = -row->xyz[0];
        row->xyz[1] = -row->xyz[1];
    }
    return true;
}

bool fcsv_read(const char *path, fcsv_file *out, err *e)
{
    FILE *in = input_file_open_text(path, e);
    if (!in) return false;
    fcsv_file f = {0};
    columns at = {.x = 1, .y = 2, .z = 3, .label = 11};
    char *text = NULL;
    size_t size = 0;
    int system = -1, line = 0;
    bool good = true;
    while (good && getline(&text, &size, in) >= 0) {
        line++;
        char *start = trim(text);
        if (!*start) continue;
        if (*start == '#') {
            good = read_comment(start, path, line, &system, &at, e);
            continue;
        }
        f.row = GROW_ARRAY(fcsv_row, f.row, f.count + 1);
        f.row[f.count] = (fcsv_row){0};
        good = read_row(start, path, line, system, &at, f.row + f.count, e);
        f.count++;
    }
    if (good && ferror(in)) good = err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read: %s", strerror(errno));
    free(text);
    fclose(in);
    if (good)
        *out = f;
    else
        fcsv_free(&f);
    return good;
}
