/* prepared_print: repair, cuts and tissue mesh of a case on stdout. */
#pragma once
#include "app/planner/patient/prepared.h"

void prepared_print(const prepared *p);
