/* attach_map: how each tissue node hangs on the bones. Data the user can see and override. */
#pragma once
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif

typedef enum node_kind {
    NODE_FREE,   /* inside the tissue, on the skin, or over a hole of the skeleton */
    NODE_TIED,   /* takes the rigid motion of its segment exactly */
    NODE_SLIDING /* stays on the tangent plane of its segment's surface, free along it (mucosa over teeth) */
} node_kind;

typedef struct attach_map {
    int32_t node_count;
    uint8_t *kind;    /* [node_count] node_kind */
    int32_t *segment; /* [node_count] segment_id of tied and sliding nodes, else -1 */
    double *normal;   /* [3*node_count] unit, of sliding nodes, out of the bone into the tissue */
    double *shift_mm; /* [node_count] or NULL: how far along its normal a sliding node lies off its place at rest */
    /* Facing nodes of the two lips: at rest in one place, free to slide along each other in the plane across
     * pair_normal and kept together across it. A node is in at most one pair; sliding or tied nodes are in none. */
    int32_t pair_count;
    int32_t *pair;       /* [2*pair_count] node numbers: upper, lower */
    double *pair_normal; /* [3*pair_count] unit, from lower to upper */
} attach_map;

attach_map attach_map_new(int32_t node_count, int32_t pair_count);
void attach_map_free(attach_map *a);

#ifdef __cplusplus
}
#endif
