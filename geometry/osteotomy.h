/* osteotomy: the saw cuts of orthognathic surgery, from landmarks or from the user's planes.
 *
 * Each cut is a closed cutter, once smaller and once larger by half the kerf: piece = bone and smaller, rest
 * = bone without larger, kerf = bone and what lies between. The three are computed apart from each other, so
 * that their sum checks them. Default planes, margins and sources: Le Fort I after PR and ZB to PM with
 * pterygoid separation; BSSO after Obwegeser, Dal Pont and Hunsuck (medial above and behind the lingula,
 * sagittal inside the external oblique ridge, vertical behind the second molar); genioplasty below the mental
 * foramina. Needs GNATHOS_CGAL. */
#pragma once
#include "geometry/frame.h"
#include "geometry/landmarks.h"
#include "geometry/plane_file.h"
#include "geometry/segments.h"
#ifdef __cplusplus
extern "C" {
#endif

typedef enum osteotomy_kind { /* bits */
                              OSTEOTOMY_LE_FORT_1 = 1,
                              OSTEOTOMY_BSSO = 2,
                              OSTEOTOMY_GENIOPLASTY = 4
} osteotomy_kind;

typedef struct osteotomy_params { /* mm, mm^3, shares in [0, 1] */
    double kerf_mm;
    double apex_clearance_mm;    /* cut to the estimated root tips, both jaws */
    double foramen_clearance_mm; /* Le Fort I to the infraorbital foramen */
    double palate_clearance_mm;  /* Le Fort I above the line ANS-PNS, between the choanae */
    double le_fort_raise_mm;     /* most that the Le Fort I sheet is raised above PR, ZB, PM to clear the root
                                    tips */
    double above_lingula_mm, behind_lingula_mm;       /* BSSO medial cut */
    double buccal_depth_mm;                           /* thickest lateral plate that the sagittal cut leaves */
    double ramus_depth_share;                         /* the plate is this share of the bone where that is thinner */
    double canal_clearance_mm;                        /* sagittal cut to the middle of the canal */
    double lingula_width_share, lingula_height_share; /* rule where Li is missing: from behind, from below */
    double below_mental_foramen_mm, chin_height_mm;   /* genioplasty; height kept at the midline */
    double fragment_mm3; /* islands smaller than this go to the piece next to which they lie */
} osteotomy_params;

osteotomy_params osteotomy_params_default(void);
bool osteotomy_params_check(const osteotomy_params *p, err *e) MUST_CHECK;

typedef struct osteotomy_input {
    const surface *skull, *mandible; /* closed, outward, teeth united with their jaw (repair, boolean) */
    const landmarks *points;
    unsigned kinds; /* osteotomy_kind bits */
    /* User's planes: label is the segment to be cut off (maxilla, proximal_left, proximal_right, chin); it
     * lies on the side of the normal, and within all planes of the same label. They replace the default cut
     * of that segment. */
    const cut_plane *plane;
    int plane_count;
    const double *canal[2]; /* mandibular canal, left and right, [3*canal_count] from behind; NULL: estimated */
    int canal_count[2];
} osteotomy_input;

typedef struct cut_clearance {
    char name[64];
    double value_mm, limit_mm; /* at least limit */
    bool ok, estimated;        /* estimated: rests on mean tooth lengths, an assumed canal or a rule */
} cut_clearance;

typedef struct cut_balance { /* one cut: before = piece + rest + kerf up to error_share */
    char name[32];
    double before_mm3, piece_mm3, rest_mm3, kerf_mm3, error_share, seconds;
} cut_balance;

typedef struct cut_fragment {             /* an island that the cut left */
    segment_id from, to;                  /* equal: it stayed */
    double volume_mm3, centre[3], gap_mm; /* distance to the piece that it went to */
} cut_fragment;

typedef struct cut_report {
    int balance_count, clearance_count, fragment_count, plane_count, warning_count, note_count;
    cut_balance *balance;
    cut_clearance *clearance;
    cut_fragment *fragment;
    cut_plane *plane;     /* the planes that were used, for display */
    char (*warning)[256]; /* what is not as it should be */
    char (*note)[256];    /* what the cuts did to keep off roots and teeth */
    double volume_mm3[SEGMENT_COUNT], kerf_mm3;
    int32_t handles[SEGMENT_COUNT]; /* genus of each segment (geometry/handles.h) */
} cut_report;

void cut_report_free(cut_report *r);

/* Cuts. A split that comes out of the lateral plate is laid anew further inside and says so; a window that a cut of the
 * mandible leaves is a warning with its place. Without Le Fort I the skull is the cranium; without BSSO the mandible is
 * the distal segment. The caller frees *out and *report (report may be NULL). Refuses: a missing bone or landmark, all
 * names at once (ERR_INPUT); open or self-crossing bone, a cut that misses it, a balance error above 0.1 %
 * (ERR_GEOMETRY).
 */
bool osteotomy_cut(const osteotomy_input *in, const osteotomy_params *p, segments *out, cut_report *report,
                   err *e) MUST_CHECK;

enum { CANAL_POINTS_MAX = 64 };
/* The mandibular canal of one side (+1 left, -1 right) as the sagittal split assumes it where none is given: behind
 * the lingula, along the body, to the mental foramen; xyz[3*CANAL_POINTS_MAX], LPS mm, from behind. mandible: whole, or
 * its pieces joined. Returns the number of points; 0 where landmarks are missing or the jaw is not one. */
int osteotomy_canal(const surface *mandible, const landmarks *points, const osteotomy_params *p, int side, double *xyz);

#ifdef __cplusplus
}
#endif
