/* markups: what landmark and plane files of 3D Slicer (.mrk.json) have in common. Private.
 * Facts from Slicer's markups schema v1.0.0 to v1.0.4 and its JSON storage node. */
#pragma once
#include "geometry/json_file.h"
#include <stddef.h>

/* Reads the file; *list is its markups array, not empty, every item an object. Refuses other JSON. */
bool markups_open(const char *path, json_file *out, const json_t **list, err *e) MUST_CHECK;
/* Refuses a type other than `type` (points of curves are Fiducials too), units other than mm, an unknown coordinate
 * system. */
bool markups_check(const json_file *f, size_t index, const char *type, bool *ras, err *e) MUST_CHECK;
/* Control point `k` of markup `index`: *defined false (nothing else set) if its position was not placed.
 * *label is borrowed and may be "". xyz in LPS. */
bool markups_point(const json_file *f, size_t index, size_t k, bool ras, bool *defined, const char **label,
                   double xyz[3], err *e) MUST_CHECK;
/* Of the same point, "" where there is none; borrowed. */
const char *markups_point_description(const json_file *f, size_t index, size_t k);
size_t markups_point_count(const json_file *f, size_t index);

/* A document with an empty markups array, and a point in it, in LPS. */
json_t *markups_document(json_t **list);
json_t *markups_new(const char *type, json_t **points);
void markups_add_point(json_t *points, const char *label, const double xyz[3]);
/* The same with a description, and whether its position is placed. */
void markups_add_described(json_t *points, const char *label, const double xyz[3], const char *description,
                           bool placed);
