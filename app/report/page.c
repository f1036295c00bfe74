/* The page's own text comes ready from app/report (the build embeds it in report_shell): markup, style and script, with
 * their hashes in a content security policy that lets nothing else run or load. Here the data are put in, as blocks
 * that a browser does not run. */
#include "app/report/page.h"
#include "app/report/scene.h"
#include "app/report/stills.h"
#include "geometry/mem.h"
#include "geometry/write_whole.h"
#include "geometry/input_file.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

__asm__(".section .rodata,\"a\",%progbits\n"
        ".global report_shell\n"
        "report_shell:\n"
        ".incbin \"" REPORT_SHELL "\"\n"
        ".byte 0\n"
        ".previous\n");
extern const char report_shell[];

/* The file in a new array, or NULL. */
static char *read_bytes(const char *path, size_t *size, err *e)
{
    int64_t bytes = 0;
    FILE *f = input_file_open(path, INT32_MAX, &bytes, e);
    if (!f) return NULL;
    char *text = NEW_ARRAY(char, bytes);
    *size = fread(text, 1, (size_t)bytes, f);
    fclose(f);
    if (*size == (size_t)bytes) return text;
    free(text);
    err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read to its end");
    return NULL;
}

/* What follows "<" in the text of a script block could end it: "<" is written as JSON's own escape. */
static void write_json(const char *id, const json_t *value, FILE *to)
{
    char *text = json_dumps(value, JSON_COMPACT | JSON_REAL_PRECISION(17));
    fprintf(to, "<script type=\"application/json\" id=\"%s\">", id);
    for (const char *c = text, *next; *c; c = next) {
        next = c + strcspn(c, "<");
        (void)!fwrite(c, 1, (size_t)(next - c), to);
        if (*next) {
            fputs("\\u003c", to);
            next++;
        }
    }
    fputs("</script>\n", to);
    free(text);
}

static bool write_stills(const char *folder, FILE *to, err *e)
{
    for (int i = 0; folder && i < report_still_count; i++) {
        char path[4096];
        size_t size = 0;
        snprintf(path, sizeof path, "%s/%s", folder, report_stills[i].file);
        char *png = read_bytes(path, &size, e);
        if (!png) return false;
        char *text = base64_text(png, size);
        fprintf(to, "<figure><img alt=\"%s\" src=\"data:image/png;base64,%s\"></figure>\n", report_stills[i].title,
                text);
        free(text);
        free(png);
    }
    return true;
}

static void write_data(const outcome_shapes *o, const report_params *params, FILE *to)
{
    packed shapes = {0};
    json_t *record = report_record(o->record.file.root, params->names), *scene = report_scene(o, &shapes);
    char *text = packed_text(&shapes);
    write_json("outcome", record, to);
    write_json("scene", scene, to);
    if (params->audit) write_json("audit", params->audit, to);
    fprintf(to, "<script type=\"application/octet-stream\" id=\"shapes\">%s</script>\n", text);
    free(text);
    packed_free(&shapes);
    json_decref(record);
    json_decref(scene);
}

bool report_page_write(const outcome_shapes *o, const report_params *params, const char *path, size_t *bytes, err *e)
{
    static const char stills[] = "<!--stills-->", data[] = "<!--data-->";
    const char *a = strstr(report_shell, stills), *b = strstr(report_shell, data);
    assert(a && b && a < b);
    whole_file w;
    if (!whole_file_open(path, &w, e)) return false;
    (void)!fwrite(report_shell, 1, (size_t)(a - report_shell), w.stream);
    bool ok = write_stills(params->pictures, w.stream, e);
    a += sizeof stills - 1;
    (void)!fwrite(a, 1, (size_t)(b - a), w.stream);
    write_data(o, params, w.stream);
    fputs(b + sizeof data - 1, w.stream);
    long size = ftell(w.stream);
    *bytes = size > 0 ? (size_t)size : 0;
    if (ok) return whole_file_close(&w, e);
    whole_file_abandon(&w);
    return false;
}
