/* fragments: islands that a cut leaves go to the piece next to which they lie. */
#pragma once
#include "geometry/osteotomy.h"

/* Looks at the shells of *piece other than its largest, and at those of *rest that touch *kerf; moves the
 * ones smaller than limit_mm3 that lie nearer to the other's largest shell. Cavities go with the shell around
 * them. Every island is entered in the report, whether it moved or not. */
bool fragments_settle(surface *piece, segment_id piece_id, surface *rest, segment_id rest_id, const surface *kerf,
                      double limit_mm3, cut_report *r, err *e) MUST_CHECK;
