/* contact_term: the energy of what touches. Without its curvature (Gauss-Newton) it is positive semidefinite. */
#pragma once
#include "sim/src/contact/contact_state.h"
#include "sim/src/energy/term.h"

term contact_term(contact *c);
