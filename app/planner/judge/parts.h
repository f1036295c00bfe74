/* judge_parts: what the files of judge share. */
#pragma once
#include "app/planner/judge/judgement.h"
#include "app/planner/patient/prepared.h"
#include "app/planner/plan/plan_moves.h"
#include "geometry/clash.h"
#include "geometry/cut_face.h"

enum { CUT_PLACES_MAX = 4, JUDGE_CUTS = 4, JUDGE_PAIRS = 6 };
enum { KIND_BONE = 1, KIND_CROWN = 2, KIND_ALL = 3 }; /* of a triangle of a bone */

typedef struct judge_place { /* where a cut's opening is measured */
    const char *name;
    cut_place at;
} judge_place;

typedef struct cut_state { /* how a cut stands after a plan */
    rigid rel;
    cut_contact contact;
    clash_spot trim; /* place in the frame of the still bone */
    double mm3;
} cut_state;

typedef struct judge_cut {
    segment_id still, moved;
    const char *where; /* "", "left", "right" */
    limit_id gap, step, contact;
    bool there;
    cut_face face, back; /* of the moved bone and of the still one */
    cut_face plate;      /* of `face`: what is in contact side by side; BSSO only */
    distance_tree *face_tree, *back_tree;
    int place_count;
    judge_place place[CUT_PLACES_MAX];
    cut_state rest; /* where both bones keep their place to each other, which is most cuts of most plans */
} judge_cut;

typedef struct judge_pair { /* bones that no cut parted */
    segment_id still, moved;
    const char *where;
    double rest_mm; /* depth of overlap in the scan */
} judge_pair;

typedef struct judge {
    const case_file *patient;
    const prepared *prepared;
    int *carrier;    /* [points.count] the segment each landmark moves with */
    bool jaws_apart; /* the scan shows the jaws out of occlusion */
    clash_body *body[SEGMENT_COUNT];
    judge_cut cut[JUDGE_CUTS];
    judge_pair pair[JUDGE_PAIRS];
    double canal[2][3 * CANAL_POINTS_MAX]; /* left, right: the estimated course, one point per millimetre or so, without
                                              its mouth */
    int canal_count[2];
    const char *no_crowns; /* why the crowns are not known; NULL: they are */
    double tooth_rest_mm;  /* overlap of the crowns in the scan */
    int tooth_rest_places; /* where the teeth meet in the scan */
    int32_t bite_count;
    double *bite; /* [3*bite_count] points of the lower teeth's chewing side */
} judge;

/* Where the plan puts a landmark; false if the case has none. */
bool judge_landmark(const judge *j, const plan_moves *m, const char *label, double out[3]);
/* From the frame of one bone into that of another; false where the two move alike. */
bool judge_relative(const plan_moves *m, segment_id still, segment_id moved, rigid *out);

/* Which triangles of a bone are crowns [triangle_count]; NULL with a reason where it cannot be known. */
uint8_t *judge_crowns(const prepared *p, segment_id bone, const char **why);
/* Needs the bodies. */
void judge_bones_make(judge *j);
void judge_bones_free(judge *j);
void judge_teeth_make(judge *j);
void judge_nerve_make(judge *j);

void judge_moves(const judge *j, const plan_moves *m, judgement *out);
void judge_bones(const judge *j, const plan_moves *m, judgement *out);
/* The parts of judge_bones one by one, for those who need not know all: from cheap to dear. */
void judge_places(const judge *j, const plan_moves *m, judgement *out);
void judge_contacts(const judge *j, const plan_moves *m, judgement *out);
void judge_pairs(const judge *j, const plan_moves *m, judgement *out);
void judge_trims(const judge *j, const plan_moves *m, judgement *out);
void judge_nerve(const judge *j, const plan_moves *m, judgement *out);
void judge_teeth(const judge *j, const plan_moves *m, judgement *out);
void judge_bite(const judge *j, const plan_moves *m, judgement *out);
void judge_cuts(const judge *j, judgement *out);
void judge_warnings(const judge *j, judgement *out);
