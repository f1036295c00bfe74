/* How the bones meet as planned: openings, steps and contact of the cuts, bone in the way. */
#include "app/planner/judge/parts.h"
#include "geometry/vec.h"
#include <stdio.h>
#include <stdlib.h>

static const double spacing_mm = 2; /* of the samples on a cut's face */
static const double touch_mm = 1.5; /* and the saw's width: bones that near to each other count as in contact */

static const struct cut_row {
    segment_id still, moved;
    const char *where;
    limit_id gap, step, contact;
    struct {
        const char *name, *label;
    } place[CUT_PLACES_MAX];
} cut_rows[JUDGE_CUTS] = {
    {SEGMENT_CRANIUM,
     SEGMENT_MAXILLA,
     "",
     LIMIT_LE_FORT_GAP,
     LIMIT_LE_FORT_STEP,
     LIMIT_LE_FORT_CONTACT,
     {{"piriform rim left", "PR_L"},
      {"piriform rim right", "PR_R"},
      {"buttress left", "ZB_L"},
      {"buttress right", "ZB_R"}}},
    {SEGMENT_DISTAL,
     SEGMENT_PROXIMAL_LEFT,
     "left",
     LIMIT_BSSO_BUCCAL_GAP,
     LIMIT_BSSO_STEP,
     LIMIT_BSSO_CONTACT,
     {{"left", "L7_L"}}},
    {SEGMENT_DISTAL,
     SEGMENT_PROXIMAL_RIGHT,
     "right",
     LIMIT_BSSO_BUCCAL_GAP,
     LIMIT_BSSO_STEP,
     LIMIT_BSSO_CONTACT,
     {{"right", "L7_R"}}},
    {SEGMENT_DISTAL,
     SEGMENT_CHIN,
     "",
     LIMIT_CHIN_GAP,
     LIMIT_CHIN_STEP,
     LIMIT_CHIN_CONTACT,
     {{"midline", "Pog"}, {"below the foramen left", "MF_L"}, {"below the foramen right", "MF_R"}}}};

static const judge_pair pair_rows[JUDGE_PAIRS] = {
    {SEGMENT_CRANIUM, SEGMENT_PROXIMAL_LEFT, "left ramus and skull", 0},
    {SEGMENT_CRANIUM, SEGMENT_PROXIMAL_RIGHT, "right ramus and skull", 0},
    {SEGMENT_CRANIUM, SEGMENT_DISTAL, "mandible and skull", 0},
    {SEGMENT_MAXILLA, SEGMENT_PROXIMAL_LEFT, "left ramus and tuberosity", 0},
    {SEGMENT_MAXILLA, SEGMENT_PROXIMAL_RIGHT, "right ramus and tuberosity", 0},
    {SEGMENT_MAXILLA, SEGMENT_DISTAL, "mandible and maxilla", 0}};

static bool is_sagittal(const judge_cut *c) { return c->contact == LIMIT_BSSO_CONTACT; }

static void measure_contact(const judge *j, const judge_cut *c, cut_state *out)
{
    bool split = is_sagittal(c);
    out->contact = cut_contact_measure(split ? &c->plate : &c->face, j->body[c->still], split ? c->back_tree : NULL,
                                       &out->rel, j->patient->cuts.kerf_mm + touch_mm);
}

static void measure_trim(const judge *j, const judge_cut *c, cut_state *out)
{
    rigid back = rigid_inverse(&out->rel);
    out->trim = cut_face_trim(&c->face, j->body[c->still], c->back_tree, &out->rel);
    clash_spot other = cut_face_trim(&c->back, j->body[c->moved], c->face_tree, &back);
    if (other.mm > out->trim.mm) {
        out->trim = other;
        rigid_apply(&out->rel, other.place, out->trim.place);
    }
    out->mm3 = clash_volume(j->body[c->still], j->body[c->moved], &out->rel);
}

static void measure_all(const judge *j, const judge_cut *c, cut_state *out)
{
    measure_contact(j, c, out);
    measure_trim(j, c, out);
}

/* ---- before any plan ---- */

static void make_cut(judge *j, const struct cut_row *row, const cut_bones *bones, judge_cut *c)
{
    const head_frame *f = &j->prepared->frame;
    *c = (judge_cut){.still = row->still,
                     .moved = row->moved,
                     .where = row->where,
                     .gap = row->gap,
                     .step = row->step,
                     .contact = row->contact};
    c->face = cut_face_make(bones, row->moved, row->still, spacing_mm);
    c->back = cut_face_make(bones, row->still, row->moved, spacing_mm);
    c->there = c->face.count && c->back.count;
    if (!c->there) return;
    c->face_tree = distance_tree_make(&c->face.shell);
    c->back_tree = distance_tree_make(&c->back.shell);
    double forwards[3];
    vec_scale(f->posterior, -1, forwards);
    c->plate = cut_face_towards(&c->face, f->left, 0.5, true);
    cut_face buccal = cut_face_towards(&c->face, forwards, 0.7, false);
    for (int i = 0; i < CUT_PLACES_MAX && row->place[i].label; i++) {
        const landmark *at = landmarks_find(&j->prepared->points, row->place[i].label);
        judge_place *p = &c->place[c->place_count];
        p->name = row->place[i].name;
        if (at && cut_place_make(is_sagittal(c) ? &buccal : &c->face, at->xyz, j->patient->cuts.kerf_mm, &p->at))
            c->place_count++;
    }
    cut_face_free(&buccal);
    c->rest.rel = rigid_identity();
    measure_all(j, c, &c->rest);
    c->rest.mm3 = 0; /* the saw's width lies between them */
}

void judge_bones_make(judge *j)
{
    const segments *s = &j->prepared->segments;
    cut_bones bones = {.bones = s};
    distance_tree *saw = distance_tree_make(&s->kerf);
    for (int i = 0; i < SEGMENT_COUNT; i++)
        if (j->body[i]) bones.part[i] = clash_body_tree(j->body[i]);
    bones.kerf = saw;
    for (int i = 0; i < JUDGE_CUTS; i++) make_cut(j, &cut_rows[i], &bones, &j->cut[i]);
    distance_tree_free(&saw);
    rigid rest = rigid_identity();
    for (int i = 0; i < JUDGE_PAIRS; i++) {
        judge_pair *p = &j->pair[i];
        *p = pair_rows[i];
        if (j->body[p->still] && j->body[p->moved])
            p->rest_mm = clash_depth(j->body[p->still], j->body[p->moved], &rest, KIND_BONE).mm;
    }
}

void judge_bones_free(judge *j)
{
    for (int i = 0; i < JUDGE_CUTS; i++) {
        judge_cut *c = &j->cut[i];
        cut_face_free(&c->face);
        cut_face_free(&c->back);
        cut_face_free(&c->plate);
        distance_tree_free(&c->face_tree);
        distance_tree_free(&c->back_tree);
    }
}

/* ---- a plan ---- */

static finding *add(const judge *j, judgement *out, limit_id id, const char *where, double value, segment_id a,
                    segment_id b)
{
    finding *f = judgement_add(out, j->patient, id, where, value, false, NULL);
    f->segment_a = a;
    f->segment_b = b;
    return f;
}

static void put_place(finding *f, const plan_moves *m, segment_id frame, const double p[3])
{
    f->has_place = true;
    rigid_apply(&m->move[frame], p, f->place);
}

/* `with` (may be NULL) is called for every cut. */
static void measure(const judge *j, const plan_moves *m, void (*with)(const judge *, const judge_cut *, cut_state *),
                    cut_state state[JUDGE_CUTS])
{
    for (int i = 0; i < JUDGE_CUTS; i++) {
        const judge_cut *c = &j->cut[i];
        if (!c->there) continue;
        if (!judge_relative(m, c->still, c->moved, &state[i].rel))
            state[i] = c->rest;
        else if (with)
            with(j, c, &state[i]);
    }
}

static const char *cut_name(const judge_cut *c)
{
    return c->moved == SEGMENT_MAXILLA         ? "Le Fort I"
           : c->moved == SEGMENT_CHIN          ? "chin"
           : c->moved == SEGMENT_PROXIMAL_LEFT ? "split left"
                                               : "split right";
}

/* Openings and steps of one limit at all places of all cuts that it is about. */
static void add_places(const judge *j, const plan_moves *m, const cut_state *state, limit_id id, judgement *out)
{
    int count = 0;
    for (int i = 0; i < JUDGE_CUTS; i++) {
        const judge_cut *c = &j->cut[i];
        if (!c->there || (c->gap != id && c->step != id)) continue;
        for (int k = 0; k < c->place_count; k++, count++) {
            double step, gap = cut_place_gap(&c->place[k].at, &state[i].rel, &step);
            finding *f = add(j, out, id, c->place[k].name, c->gap == id ? gap : step, c->still, c->moved);
            put_place(f, m, c->still, c->place[k].at.other);
        }
    }
    if (!count) judgement_add(out, j->patient, id, "", (double)NAN, false, "no such cut, or no landmark beside it");
}

static void add_contact(const judge *j, const cut_state *state, limit_id id, judgement *out)
{
    int count = 0;
    for (int i = 0; i < JUDGE_CUTS; i++) {
        const judge_cut *c = &j->cut[i];
        if (!c->there || c->contact != id) continue;
        add(j, out, id, c->where, state[i].contact.mm2, c->still, c->moved);
        count++;
    }
    if (!count) judgement_add(out, j->patient, id, "", (double)NAN, false, "no such cut");
}

static void add_splits(const judge *j, const cut_state *state, judgement *out)
{
    int count = 0;
    for (int i = 0; i < JUDGE_CUTS; i++) {
        const judge_cut *c = &j->cut[i];
        if (!c->there || !is_sagittal(c)) continue;
        finding *f = add(j, out, LIMIT_BSSO_GAP, c->where, state[i].contact.gap_mm, c->still, c->moved);
        if (isnan(f->value)) f->note = "the plates do not face each other any more; see bsso_contact_mm2";
        count++;
    }
    if (!count) judgement_add(out, j->patient, LIMIT_BSSO_GAP, "", (double)NAN, false, "no such cut");
}

static void add_trims(const judge *j, const plan_moves *m, const cut_state *state, judgement *out)
{
    for (int l = LIMIT_TRIM_DEPTH; l <= LIMIT_TRIM_VOLUME; l++) {
        int count = 0;
        for (int i = 0; i < JUDGE_CUTS; i++) {
            const judge_cut *c = &j->cut[i];
            if (!c->there) continue;
            finding *f = add(j, out, (limit_id)l, cut_name(c), l == LIMIT_TRIM_DEPTH ? state[i].trim.mm : state[i].mm3,
                             c->still, c->moved);
            if (state[i].trim.found) put_place(f, m, c->still, state[i].trim.place);
            count++;
        }
        if (!count) judgement_add(out, j->patient, (limit_id)l, "", (double)NAN, false, "the case has no cut");
    }
}

void judge_pairs(const judge *j, const plan_moves *m, judgement *out)
{
    for (int i = 0; i < JUDGE_PAIRS; i++) {
        const judge_pair *p = &j->pair[i];
        rigid rel;
        if (!j->body[p->still] || !j->body[p->moved]) continue;
        clash_spot spot = {0};
        if (judge_relative(m, p->still, p->moved, &rel))
            spot = clash_depth(j->body[p->still], j->body[p->moved], &rel, KIND_BONE);
        finding *f = add(j, out, LIMIT_INTERFERENCE, p->where, fmax(spot.mm - p->rest_mm, 0), p->still, p->moved);
        if (spot.found) put_place(f, m, p->still, spot.place);
        if (p->rest_mm > 0.1) f->note = "beyond the overlap that the scan itself shows";
    }
}

void judge_bones(const judge *j, const plan_moves *m, judgement *out)
{
    cut_state state[JUDGE_CUTS];
    measure(j, m, measure_all, state);
    add_places(j, m, state, LIMIT_LE_FORT_GAP, out);
    add_places(j, m, state, LIMIT_LE_FORT_STEP, out);
    add_contact(j, state, LIMIT_LE_FORT_CONTACT, out);
    add_splits(j, state, out);
    add_places(j, m, state, LIMIT_BSSO_BUCCAL_GAP, out);
    add_places(j, m, state, LIMIT_BSSO_STEP, out);
    add_contact(j, state, LIMIT_BSSO_CONTACT, out);
    add_places(j, m, state, LIMIT_CHIN_GAP, out);
    add_places(j, m, state, LIMIT_CHIN_STEP, out);
    add_contact(j, state, LIMIT_CHIN_CONTACT, out);
    add_trims(j, m, state, out);
    judge_pairs(j, m, out);
}

void judge_places(const judge *j, const plan_moves *m, judgement *out)
{
    static const limit_id of[] = {LIMIT_LE_FORT_GAP, LIMIT_LE_FORT_STEP, LIMIT_BSSO_BUCCAL_GAP,
                                  LIMIT_BSSO_STEP,   LIMIT_CHIN_GAP,     LIMIT_CHIN_STEP};
    cut_state state[JUDGE_CUTS];
    measure(j, m, NULL, state);
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) add_places(j, m, state, of[i], out);
}

void judge_contacts(const judge *j, const plan_moves *m, judgement *out)
{
    cut_state state[JUDGE_CUTS];
    measure(j, m, measure_contact, state);
    add_contact(j, state, LIMIT_LE_FORT_CONTACT, out);
    add_splits(j, state, out);
    add_contact(j, state, LIMIT_BSSO_CONTACT, out);
    add_contact(j, state, LIMIT_CHIN_CONTACT, out);
}

void judge_trims(const judge *j, const plan_moves *m, judgement *out)
{
    cut_state state[JUDGE_CUTS];
    measure(j, m, measure_trim, state);
    add_trims(j, m, state, out);
}
