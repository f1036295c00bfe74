/* ITK's text transforms (itkTxtTransformIO). */
#include "geometry/input_file.h"
#include "geometry/src/files/stored_transform.h"
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool read_numbers(const char *text, const char *path, int line, const char *key, double *out, int *count, err *e)
{
    if (*count >= 0) return err_at(e, ERR_INPUT, path, line, key, "is there twice; one transform per file is read");
    int n = 0;
    for (;;) {
        text += strspn(text, " \t\r\n");
        if (!*text) break;
        char *end;
        double value = strtod(text, &end);
        if (end == text || !isfinite(value))
            return err_at(e, ERR_INPUT, path, line, key, "\"%.20s\" is not a finite number", text);
        if (n == STORED_NUMBERS_MOST) return err_at(e, ERR_INPUT, path, line, key, "too many numbers");
        out[n++] = value;
        text = end;
    }
    *count = n;
    return true;
}

static bool read_line(char *text, const char *path, int line, stored_transform *s, err *e)
{
    text += strspn(text, " \t\r\n");
    if (!*text || *text == '#') return true;
    char *colon = strchr(text, ':');
    if (!colon) return err_at(e, ERR_INPUT, path, line, NULL, "must be \"name: value\"");
    char *value = colon + 1 + strspn(colon + 1, " \t");
    *colon = 0;
    if (!strcmp(text, "Transform")) {
        value[strcspn(value, " \t\r\n")] = 0;
        return stored_transform_type(s, value, path, line, e);
    }
    if (s->type < 0) return err_at(e, ERR_INPUT, path, line, NULL, "\"Transform:\" must come first");
    if (!strcmp(text, "Parameters")) {
        s->parameter_line = line;
        return read_numbers(value, path, line, text, s->parameter, &s->parameter_count, e);
    }
    if (!strcmp(text, "FixedParameters")) return read_numbers(value, path, line, text, s->fixed, &s->fixed_count, e);
    return err_at(e, ERR_INPUT, path, line, NULL, "unknown entry \"%.40s\"", text);
}

bool read_transform_text(const char *path, stored_transform *out, err *e)
{
    FILE *in = input_file_open_text(path, e);
    if (!in) return false;
    stored_transform s = stored_transform_new();
    char *text = NULL;
    size_t size = 0;
    bool good = true;
    for (int line = 1; good && getline(&text, &size, in) >= 0; line++) {
        if (line == 1 && strncmp(text, "#Insight Transform File", 23))
            good = err_at(e, ERR_INPUT, path, 1, NULL,
                          "not a text transform: must begin with \"#Insight Transform File\"");
        else
            good = read_line(text, path, line, &s, e);
    }
    if (good && ferror(in)) good = err_at(e, ERR_INPUT, path, 0, NULL, "cannot be read: %s", strerror(errno));
    free(text);
    fclose(in);
    if (good) *out = s;
    return good;
}
