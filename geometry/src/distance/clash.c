#include "geometry/clash.h"
#include "geometry/mem.h"
#include "geometry/src/distance/clash_body.h"
#include <stdlib.h>

clash_params clash_params_default(void) { return (clash_params){.cell_mm = 0.7, .step_mm = 0.7, .tolerance_mm = 0.02}; }

bool clash_body_make(const surface *s, const uint8_t *kind, const clash_params *p, clash_body **out, err *e)
{
    clash_body *b = NEW_ARRAY(clash_body, 1);
    b->s = s;
    b->tolerance_mm = p->tolerance_mm;
    if (!solid_grid_make(s, p->step_mm, p->box, &b->grid, e)) {
        clash_body_free(&b);
        return false;
    }
    b->kind = kind ? COPY_ARRAY(uint8_t, kind, s->triangle_count) : NULL;
    b->tree = distance_tree_make(s);
    b->patches = patches_make(s, kind, p->box);
    if (p->cell_mm > 0) b->cells = bone_cells_make(s, b->grid, p->cell_mm);
    *out = b;
    return true;
}

void clash_body_free(clash_body **b)
{
    if (!*b) return;
    distance_tree_free(&(*b)->tree);
    solid_grid_free(&(*b)->grid);
    bone_cells_free(&(*b)->cells);
    patches_free(&(*b)->patches);
    free((*b)->kind);
    free(*b);
    *b = NULL;
}

const solid_grid *clash_body_grid(const clash_body *b) { return b->grid; }

const distance_tree *clash_body_tree(const clash_body *b) { return b->tree; }

double clash_volume(const clash_body *still, const clash_body *moved, const rigid *rel)
{
    return bone_cells_inside(&moved->cells, still->grid, rel);
}
