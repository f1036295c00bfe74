/* gnathos audit CASE [--plan P] */
#include "app/cli/audit.h"
#include <stdlib.h>

enum { KEY_NO_PICTURES = KEY_OWN, KEY_LINE, KEY_PAIR, KEY_BOX, KEY_AROUND, KEY_GEOMETRY, KEY_SPACING, KEY_TOLERANCE };

static const struct argp_option options[] = {
    OPTION_OUTPUT("Folder for the results"),
    OPTION_FORCE,
    OPTION_CACHE,
    {NULL, 0, NULL, 0, "To judge one plan:", 1},
    OPTION_PLAN("The plan (gnathos help plan)", 1),
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

static double read_number(const char *name, const char *arg, struct argp_state *state)
{
    char *end;
    double x = strtod(arg, &end);
    if (end == arg || *end || !(x >= 0.001 && x <= 5))
        command_usage(state, "%s %s: must be a number from 0.001 to 5", name, arg);
    return x;
}

static void ask_for(audit_options *s, const char *word, int axes, struct argp_state *state)
{
    if (s->word_count == AUDIT_WORDS_MAX) command_usage(state, "more than %d lines, pairs and boxes", AUDIT_WORDS_MAX);
    s->axis_count[s->word_count] = axes;
    s->word[s->word_count++] = word;
}

/* What the options without a plan say; true where key is one of them. */
static bool take_option(int key, char *arg, audit_options *o, struct argp_state *state)
{
    switch (key) {
    case KEY_LINE: ask_for(o, arg, 1, state); break;
    case KEY_PAIR: ask_for(o, arg, 2, state); break;
    case KEY_BOX: ask_for(o, arg, 3, state); break;
    case KEY_AROUND: o->around = arg; break;
    case KEY_SPACING: o->spacing = read_number("--spacing", arg, state); break;
    case KEY_TOLERANCE: o->tolerance = read_number("--tolerance", arg, state); break;
    case KEY_GEOMETRY: o->geometry_only = true; break;
    case KEY_NO_PICTURES: o->no_pictures = true; break;
    default: return false;
    }
    return true;
}

static void check(run_context *r, struct argp_state *state)
{
    audit_options *o = r->own;
    if (r->plan_path && o->named)
        command_usage(state, "%s has no meaning with --plan, which judges one plan", o->named);
    if (!r->plan_path && !r->out_path)
        command_usage(state, "name a folder for the results with -o, or a plan with --plan");
    if (o->tolerance > o->spacing)
        command_usage(state, "--tolerance %g is wider than --spacing %g", o->tolerance, o->spacing);
    o->one_plan = r->plan_path != NULL;
    if (!o->one_plan) r->plan_path = o->around;
    if (!o->one_plan && !GNATHOS_WITH_SIM) r->need = 0;
}

static const int often[] = {KEY_LINE, KEY_PAIR, KEY_BOX, 0};

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    static const char *const name[] = {[KEY_NO_PICTURES - KEY_OWN] = "--no-pictures",
                                       [KEY_LINE - KEY_OWN] = "--line",
                                       [KEY_PAIR - KEY_OWN] = "--pair",
                                       [KEY_BOX - KEY_OWN] = "--box",
                                       [KEY_AROUND - KEY_OWN] = "--around",
                                       [KEY_GEOMETRY - KEY_OWN] = "--geometry-only",
                                       [KEY_SPACING - KEY_OWN] = "--spacing",
                                       [KEY_TOLERANCE - KEY_OWN] = "--tolerance"};
    audit_options *o = r->own;
    if (key == ARGP_KEY_END) check(r, state);
    if (!take_option(key, arg, o, state)) return ARGP_ERR_UNKNOWN;
    o->named = name[key - KEY_OWN];
    return 0;
}

static void defaults(void *own) { *(audit_options *)own = (audit_options){.spacing = 1, .tolerance = 0.05}; }

static bool early(run_context *r, err *e)
{
    const audit_options *o = r->own;
    if (o->one_plan) return true;
#if GNATHOS_WITH_SIM
    return audit_space_early(r, e);
#else
    return err_set(e, ERR_USAGE, "audit without --plan cannot run: this build has no solver (GNATHOS_SIM=OFF)");
#endif
}

static bool run(run_context *r, err *e)
{
#if GNATHOS_WITH_SIM
    const audit_options *o = r->own;
    if (!o->one_plan) return audit_space_run(r, e);
#endif
    return audit_plan_run(r, e);
}

const verb verb_audit = {.arguments = "CASE",
                         .about = about,
                         .options = options,
                         .argument_count = 1,
                         .missing_argument = "name a case",
                         .need = NEED_CASE | NEED_POINTS | NEED_PLAN_JUDGED | NEED_OUTPUT | NEED_PREPARED,
                         .own_size = sizeof(audit_options),
                         .defaults = defaults,
                         .parse = parse,
                         .often = often,
                         .early = early,
                         .run = run};
