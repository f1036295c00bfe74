/* tissue: tetrahedra between skin and wrapped skeleton, with the attachment of each node. */
#pragma once
#include "geometry/attach_map.h"
#include "geometry/clock.h"
#include "geometry/embed.h"
#include "geometry/frame.h"
#include "geometry/landmarks.h"
#include "geometry/segments.h"
#include "geometry/tetmesh.h"
#ifdef __cplusplus
extern "C" {
#endif

/* All lengths mm. Defaults in tissue_params_default; ranges in the case field table. */
typedef struct tissue_params {
    double element_mm;  /* edge length at lips, nose and chin */
    double coarse_mm;   /* largest edge length, far from them */
    double growth;      /* growth of the edge length per mm of distance */
    double hole_mm;     /* openings of the skeleton narrower than this are spanned by the wrap */
    double collar_mm;   /* tissue kept below the wrap where it spans a hole */
    double detail_mm;   /* gaps between bones narrower than this are filled */
    double touch_mm;    /* wrap nodes nearer to bone than this are moved onto the bone */
    double cut_band_mm; /* half width of the strip along a saw cut where tissue hangs loose */
    double vestibule_upper_mm, vestibule_lower_mm; /* depth of the mouth's vestibule from the incisal edge */
    double coronal_mm;                             /* the coronal cut, behind (+) or in front (-) of the porions */
    double neck_mm, brow_mm;                       /* the neck cut below menton, the upper cut above nasion */
    double far_mm;                                 /* cut faces farther than this from moving bone are fixed */
} tissue_params;

/* Where a boundary node lies. */
typedef enum node_side { SIDE_INSIDE, SIDE_SKIN, SIDE_BONE, SIDE_HOLE, SIDE_CUT } node_side;

enum { REGION_LOWER = 1, REGION_UPPER = 2 }; /* below and above the sheet through the lip line */

typedef struct tissue_report {
    tetmesh_quality quality;
    int32_t nodes, tets, skin_nodes, tied_nodes, sliding_nodes, loose_nodes, fixed_nodes, hole_nodes, lip_pairs;
    int32_t not_snapped;    /* wrap nodes near bone that could not be moved onto it without flattening a tet */
    double max_bone_gap_mm; /* largest distance of a tied node from its bone */
    double skin_gap_mean_mm, skin_gap_max_mm; /* of the skin's vertices from the tets that carry them */
    char left_out[512];                       /* what the domain leaves out, in words */
    clock_span distances, mesh, attachment;   /* skin and bones on grids, Mesh_3, onto the bone and what hangs on it */
} tissue_report;

/* The sheet through the lip line: level from front to back (along Frankfort), a parabola through the mouth corners
 * and stomion from side to side, level beyond the corners. */
typedef struct lip_sheet {
    head_frame frame;
    double x[3], z[3]; /* right corner, stomion, left corner: left and up coordinates in the frame, mm */
} lip_sheet;

double lip_sheet_height(const lip_sheet *s, double x);
void lip_sheet_normal(const lip_sheet *s, double x, double n[3]); /* unit, upwards, LPS */

typedef struct tissue {
    tetmesh mesh;
    attach_map attach;
    uint8_t *side; /* [mesh.vertex_count] node_side */
    lip_sheet lips;
} tissue;

typedef struct tissue_input {
    const surface *skin;      /* closed, outward */
    const surface *bones;     /* skull, mandible and teeth, closed shells that may overlap, joined */
    const segments *segments; /* the same bones after the cuts */
    const landmarks *landmarks;
    const head_frame *frame;
} tissue_input;

tissue_params tissue_params_default(void);
/* The caller frees *out. Refuses (ERR_GEOMETRY) bones outside the skin, an empty or torn domain; (ERR_INPUT) missing
 * landmarks: N, Me, U1, L1, Ch_L, Ch_R, Stm or Stms and Stmi, Pn, Ls. */
bool tissue_make(const tissue_input *in, const tissue_params *p, tissue *out, tissue_report *report, err *e) MUST_CHECK;
void tissue_free(tissue *t);
/* Carries the vertices of a skin that lies on the tissue (within reach_mm): between the mouth corners, those above
 * the lip sheet by the upper lip and those below by the lower lip. The caller frees. */
embedding tissue_carry(const tissue *t, const double *xyz, int32_t count, double reach_mm);

#ifdef __cplusplus
}
#endif
