/* elastic_term: the elastic energy of the tissue, first in a list of terms: it fills what the others add to. Negative
 * curvature is projected element by element. */
#pragma once
#include "sim/src/energy/term.h"

term elastic_term(assembly *a);
