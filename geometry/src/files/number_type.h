/* number_type: numbers as files store them. Private. */
#pragma once
#include "geometry/src/files/scan.h"
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

typedef enum number_type {
    NUMBER_I8,
    NUMBER_U8,
    NUMBER_I16,
    NUMBER_U16,
    NUMBER_I32,
    NUMBER_U32,
    NUMBER_I64,
    NUMBER_U64,
    NUMBER_F32,
    NUMBER_F64,
    NUMBER_UNKNOWN
} number_type;

static inline size_t number_size(number_type type)
{
    static const uint8_t size[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8, 0};
    return size[type];
}

/* The number at p, which need not be aligned; swap: its bytes come in the other order. */
static inline double number_at(const void *p, number_type type, bool swap)
{
    uint8_t b[8];
    size_t n = number_size(type);
    memcpy(b, p, n);
    for (size_t i = 0; swap && i < n / 2; i++) {
        uint8_t t = b[i];
        b[i] = b[n - 1 - i];
        b[n - 1 - i] = t;
    }
    switch (type) {
#define NUMBER_CASE(type_, c_)                                                                                         \
    case type_: {                                                                                                      \
        c_ v;                                                                                                          \
        memcpy(&v, b, sizeof v);                                                                                       \
        return (double)v;                                                                                              \
    }
        NUMBER_CASE(NUMBER_I8, int8_t)
        NUMBER_CASE(NUMBER_U8, uint8_t)
        NUMBER_CASE(NUMBER_I16, int16_t)
        NUMBER_CASE(NUMBER_U16, uint16_t)
        NUMBER_CASE(NUMBER_I32, int32_t)
        NUMBER_CASE(NUMBER_U32, uint32_t)
        NUMBER_CASE(NUMBER_I64, int64_t)
        NUMBER_CASE(NUMBER_U64, uint64_t)
        NUMBER_CASE(NUMBER_F32, float)
        NUMBER_CASE(NUMBER_F64, double)
#undef NUMBER_CASE
    default: return 0;
    }
}

/* The next number of a file, words or bytes; words of a 32-bit type are rounded, so that both forms say the same. False
 * where there is none. */
static inline bool number_next(scan *s, bool binary, bool swap, number_type type, double *out)
{
    if (!binary) {
        if (!scan_number(s, out)) return false;
        if (type == NUMBER_F32) *out = (double)(float)*out;
        return true;
    }
    size_t n = number_size(type);
    if ((size_t)(s->end - s->at) < n) return false;
    *out = number_at(s->at, type, swap);
    s->at += n;
    return true;
}
