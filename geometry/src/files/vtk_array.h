/* vtk_array: the arrays of VTK's XML files: as text, base64 or raw, in the element or appended, plain or by zlib.
 * Private. */
#pragma once
#include "geometry/src/files/number_type.h"
#include <stddef.h>

typedef struct vtk_xml_tag { /* <name attributes>; lies in the text of the file */
    const char *name, *end, *after;
    size_t length;
    bool closes; /* </name> */
} vtk_xml_tag;

/* The next tag from *at on, which is set behind it; false where there is none. */
bool vtk_xml_next(const char **at, const char *end, vtk_xml_tag *tag);
bool vtk_xml_is(const vtk_xml_tag *tag, const char *name);
/* The value of an attribute, "" if it is not there or does not fit. */
void vtk_xml_attribute(const vtk_xml_tag *tag, const char *key, char *value, size_t size);

typedef struct vtk_layout {        /* what the file says of all of its arrays */
    const char *end;               /* of the file */
    const char *appended;          /* behind the _ of AppendedData, or NULL */
    bool swap, wide, zlib, base64; /* wide: lengths of 64 bits; base64: of the appended arrays */
} vtk_layout;

typedef struct vtk_array {
    number_type type;
    bool swap;
    char *bytes;
    int64_t count;
} vtk_array;

/* Decodes the DataArray at the tag; NULL, or what is wrong with it. The caller frees out->bytes, which is never larger
 * than the file can hold. */
const char *vtk_array_read(const vtk_layout *of, const vtk_xml_tag *tag, vtk_array *out);
static inline double vtk_array_at(const vtk_array *a, int64_t i)
{
    return number_at(a->bytes + (size_t)i * number_size(a->type), a->type, a->swap);
}
