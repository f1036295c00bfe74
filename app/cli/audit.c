/* gnathos audit CASE [--plan P] */
#include "app/cli/audit_plan.h"
#include "app/cli/audit_space.h"
#include <stdlib.h>

enum {
    KEY_CACHE = 300,
    KEY_NO_PICTURES,
    KEY_LINE,
    KEY_PAIR,
    KEY_BOX,
    KEY_AROUND,
    KEY_GEOMETRY,
    KEY_SPACING,
    KEY_TOLERANCE
};

static const struct argp_option options[] = {
    {"output", 'o', "DIR", 0, "Folder for the results", 0},
    {"force", 'f', NULL, 0, "Replace an earlier output in DIR", 0},
    {"cache", KEY_CACHE, "DIR", 0, "Keep what is prepared in DIR instead of CASE/prepared", 0},
    {NULL, 0, NULL, 0, "To judge one plan:", 1},
    {"plan", 'p', "FILE", 0, "The plan (gnathos help plan)", 1},
    {NULL, 0, NULL, 0, "To find out what is possible:", 2},
    {"line", KEY_LINE, "A", 0, "Bounds of control A alone; may be given often", 2},
    {"pair", KEY_PAIR, "A,B", 0, "A map over two controls, and the bounds of each; may be given often", 2},
    {"box", KEY_BOX, "A,B,C", 0, "A map over three controls, and the bounds of each; may be given often", 2},
    {"around", KEY_AROUND, "PLAN", 0, "Start from this plan instead of from nothing moved, and mark it", 2},
    {"spacing", KEY_SPACING, "MM", 0, "Between the points of a map (default 1; degrees for angles)", 2},
    {"tolerance", KEY_TOLERANCE, "MM", 0, "To which bounds are found (default 0.05; degrees for angles)", 2},
    {"geometry-only", KEY_GEOMETRY, NULL, 0, "Judge bones and teeth only, solve no soft tissue", 2},
    {"no-pictures", KEY_NO_PICTURES, NULL, 0, "Leave the pictures out", 2},
    {0}};

static const char about[] =
    "Judge a plan by all limits of bone, teeth and nerve; or, without --plan, find out how far each bone may be moved and "
    "what stops it.\v"
    "Without --plan, --line, --pair and --box: the bounds of maxilla_advance_mm, maxilla_impaction_mm, "
    "mandible_advance_mm (and of chin_advance_mm where the chin is cut), the map of every pair of the first three (and of "
    "mandible and chin), and the box of the three.\n\n"
    "Controls are PIECE_advance_mm, PIECE_lift_mm (of the maxilla maxilla_impaction_mm), PIECE_lateral_mm, "
    "PIECE_pitch_deg, PIECE_yaw_deg and PIECE_roll_deg for the pieces maxilla, mandible, chin, proximal_left and "
    "proximal_right, along and about the head's own axes. Their box is the stop range of the case's limits of moves.\n\n"
    "What is finished is kept in DIR.journal while the audit runs: after an interruption the same command goes on from "
    "there.";

struct input {
    command_options common;
    const char *case_path[1], *out, *cache, *plan;
    bool force;
    const char *space_only; /* an option that has no meaning with --plan */
    audit_space_options space;
};

static double read_number(const char *name, const char *arg, struct argp_state *state)
{
    char *end;
    double x = strtod(arg, &end);
    if (end == arg || *end || !(x >= 0.001 && x <= 5))
        argp_error(state, "%s %s: must be a number from 0.001 to 5", name, arg);
    return x;
}

static void ask_for(audit_space_options *s, const char *word, int axes, struct argp_state *state)
{
    if (s->word_count == AUDIT_WORDS_MAX) argp_error(state, "more than %d lines, pairs and boxes", AUDIT_WORDS_MAX);
    s->axis_count[s->word_count] = axes;
    s->word[s->word_count++] = word;
}

/* Options of the audit without a plan. */
static error_t parse_space(int key, char *arg, struct input *in, struct argp_state *state)
{
    audit_space_options *s = &in->space;
    switch (key) {
    case KEY_LINE:
        in->space_only = "--line";
        ask_for(s, arg, 1, state);
        return 0;
    case KEY_PAIR:
        in->space_only = "--pair";
        ask_for(s, arg, 2, state);
        return 0;
    case KEY_BOX:
        in->space_only = "--box";
        ask_for(s, arg, 3, state);
        return 0;
    case KEY_AROUND:
        in->space_only = "--around";
        s->around = arg;
        return 0;
    case KEY_SPACING:
        in->space_only = "--spacing";
        s->spacing = read_number("--spacing", arg, state);
        return 0;
    case KEY_TOLERANCE:
        in->space_only = "--tolerance";
        s->tolerance = read_number("--tolerance", arg, state);
        return 0;
    case KEY_GEOMETRY:
        in->space_only = "--geometry-only";
        s->geometry_only = true;
        return 0;
    case KEY_NO_PICTURES:
        in->space_only = "--no-pictures";
        s->no_pictures = true;
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static void check(const struct input *in, struct argp_state *state)
{
    const audit_space_options *s = &in->space;
    if (in->plan && in->space_only)
        argp_error(state, "%s has no meaning with --plan, which judges one plan", in->space_only);
    if (!in->plan && !in->out) argp_error(state, "name a folder for the results with -o, or a plan with --plan");
    if (s->tolerance > s->spacing)
        argp_error(state, "--tolerance %g is wider than --spacing %g", s->tolerance, s->spacing);
}

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct input *in = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &in->common; return 0;
    case 'p': in->plan = arg; return 0;
    case 'o': in->out = arg; return 0;
    case 'f': in->force = true; return 0;
    case KEY_CACHE: in->cache = arg; return 0;
    case ARGP_KEY_ARG: return command_take(arg, in->case_path, 1, state);
    case ARGP_KEY_NO_ARGS: argp_error(state, "name a case"); return 0;
    case ARGP_KEY_END: check(in, state); return 0;
    default: return parse_space(key, arg, in, state);
    }
}

int command_audit(int argc, char **argv)
{
    static const struct argp argp = {options, parse, "CASE", about, command_common, NULL, NULL};
    struct input in = {.space = {.spacing = 1, .tolerance = 0.05}};
    argp_parse(&argp, argc, argv, 0, NULL, &in);
    if (in.plan)
        return command_audit_plan(&(audit_plan_options){.common = in.common,
                                                        .case_path = in.case_path[0],
                                                        .plan = in.plan,
                                                        .cache = in.cache,
                                                        .out = in.out,
                                                        .force = in.force});
    in.space.common = in.common;
    in.space.case_path = in.case_path[0];
    in.space.out = in.out;
    in.space.cache = in.cache;
    in.space.force = in.force;
#if GNATHOS_WITH_SIM
    return command_audit_space(&in.space);
#else
    err e = {0};
    err_set(&e, ERR_USAGE, "audit without --plan cannot run: this build has no solver (GNATHOS_SIM=OFF)");
    return command_fail(&e);
#endif
}
