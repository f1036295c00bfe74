#include "bodies.h"

bodies bodies_build(void)
{
    bodies b = {.face = body_skin_base(), .vault = body_skull_vault()};
    body_skin_tubes(b.skin);
    body_skull_tubes(b.skull);
    body_mandible_tubes(b.mandible);
    body_skin_lids(&b);
    return b;
}

void bodies_free(bodies *b)
{
    radial_free(&b->face);
    radial_free(&b->vault);
    for (int i = 0; i < SKIN_TUBES; i++) tube_free(&b->skin[i]);
    for (int i = 0; i < SKULL_TUBES; i++) tube_free(&b->skull[i]);
    for (int i = 0; i < MANDIBLE_TUBES; i++) tube_free(&b->mandible[i]);
}
