#include "render/png_file.h"
#include "geometry/mem.h"
#include "geometry/write_whole.h"
#include <assert.h>
#include <errno.h>
#include <png.h>
#include <stdlib.h>
#include <string.h>

/* libpng reports errors by a callback that must not return; the longjmp ends in the function that set it. */
static void on_error(png_structp png, png_const_charp message)
{
    err *e = png_get_error_ptr(png);
    err_set(e, ERR_INPUT, "%s", message);
    longjmp(png_jmpbuf(png), 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static bool opaque(const image *im)
{
    for (size_t i = 0; i < (size_t)im->width * (size_t)im->height; i++)
        if (im->rgba[4 * i + 3] != 255) return false;
    return true;
}

static bool encode(png_structp png, png_infop info, FILE *f, const image *im, png_textp texts, int text_count,
                   png_bytepp rows, bool rgb)
{
    if (setjmp(png_jmpbuf(png))) return false;
    png_init_io(png, f);
    png_set_IHDR(png, info, (png_uint_32)im->width, (png_uint_32)im->height, 8,
                 rgb ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    /* On smooth shading this filter at this level is 3 % larger and three times as fast than the best. */
    png_set_compression_level(png, 4);
    png_set_filter(png, 0, PNG_FILTER_AVG);
    if (text_count > 0) png_set_text(png, info, texts, text_count);
    png_write_info(png, info);
    if (rgb) png_set_filler(png, 0, PNG_FILLER_AFTER);
    png_write_image(png, rows);
    png_write_end(png, NULL);
    return true;
}

static bool ascii(const char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text > 126) return false;
    return true;
}

bool png_file_write(const image *im, const png_note *texts, int text_count, const char *path, err *e)
{
    assert(im->rgba);
    for (int i = 0; i < text_count; i++)
        if (!texts[i].key || !*texts[i].key || strlen(texts[i].key) > 79)
            return err_set(e, ERR_USAGE, "the keyword of a text in a PNG file has 1 to 79 characters");
    whole_file file;
    if (!whole_file_open(path, &file, e)) return false;
    err said = {0};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &said, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    png_textp chunk = mem_alloc((size_t)text_count, sizeof *chunk);
    for (int i = 0; i < text_count; i++) {
        chunk[i].compression = ascii(texts[i].value) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
        chunk[i].key = (char *)texts[i].key;
        chunk[i].text = (char *)texts[i].value;
        *(chunk[i].compression == PNG_TEXT_COMPRESSION_NONE ? &chunk[i].text_length : &chunk[i].itxt_length) =
            strlen(texts[i].value);
    }
    png_bytepp rows = mem_alloc((size_t)im->height, sizeof *rows);
    for (int y = 0; y < im->height; y++) rows[y] = image_pixel(im, 0, y);
    bool ok = info && encode(png, info, file.stream, im, chunk, text_count, rows, opaque(im));
    png_destroy_write_struct(&png, &info);
    free(chunk);
    free(rows);
    if (!ok && !ferror(file.stream)) { /* else closing tells why it cannot be written */
        whole_file_abandon(&file);
        return err_set(e, ERR_RESOURCE, "%s: %s", path, said.code ? said.text : "libpng cannot be set up");
    }
    return whole_file_close(&file, e);
}

static bool decode(png_structp png, png_infop info, FILE *f, image *out, png_bytepp *rows)
{
    if (setjmp(png_jmpbuf(png))) return false;
    png_init_io(png, f);
    png_read_info(png, info);
    png_uint_32 w = png_get_image_width(png, info), h = png_get_image_height(png, info);
    if (w > IMAGE_SIZE_MAX || h > IMAGE_SIZE_MAX) png_error(png, "the image is too large");
    png_set_expand(png);
    png_set_strip_16(png);
    png_set_gray_to_rgb(png);
    png_set_filler(png, 255, PNG_FILLER_AFTER);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    *out = image_new((int)w, (int)h);
    *rows = mem_alloc(h, sizeof **rows);
    for (int y = 0; y < (int)h; y++) (*rows)[y] = image_pixel(out, 0, y);
    png_read_image(png, *rows);
    png_read_end(png, info);
    return true;
}

/* Reads all; one of `out` and `value` may be NULL. */
static bool read_all(const char *path, image *out, const char *key, char **value, err *e)
{
    FILE *f = fopen(path, "rb");
    if (!f) return err_set(e, ERR_INPUT, "%s: %s", path, strerror(errno));
    err said = {0};
    image im = {0};
    png_bytepp rows = NULL;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &said, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    bool ok = info && decode(png, info, f, &im, &rows);
    if (ok && value) {
        png_textp chunk;
        int count = 0;
        *value = NULL;
        png_get_text(png, info, &chunk, &count);
        for (int i = 0; i < count && !*value; i++)
            if (!strcmp(chunk[i].key, key)) *value = mem_text(chunk[i].text);
    }
    png_destroy_read_struct(&png, &info, NULL);
    fclose(f);
    free(rows);
    if (!ok || !out) image_free(&im);
    if (!ok) return err_set(e, ERR_INPUT, "%s: not a whole PNG file: %s", path, said.code ? said.text : "libpng");
    if (out) *out = im;
    return true;
}

bool png_file_read(const char *path, image *out, err *e) { return read_all(path, out, NULL, NULL, e); }
bool png_file_note(const char *path, const char *key, char **value, err *e)
{
    return read_all(path, NULL, key, value, e);
}
