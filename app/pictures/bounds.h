/* bounds: an audit in pictures. */
#pragma once
#include "app/planner/bounds/write.h"

/* map_*.png of every map over two controls. */
bool audit_write_pictures(const audit *a, const output_dir *dir, err *e) MUST_CHECK;
