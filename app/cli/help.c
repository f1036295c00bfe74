/* gnathos help [VERB | case | plan | landmarks] */
#include "app/cli/command.h"
#include "app/cli/fields_help.h"
#include "app/planner/patient/landmark_needs.h"
#include "app/planner/plan/plan_file.h"
#include "app/planner/store/suggest.h"
#include <stdio.h>
#include <string.h>

typedef struct help_input {
    command_options common;
    const char *topic;
} help_input;

static error_t parse(int key, char *arg, struct argp_state *state)
{
    help_input *in = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = &in->common; return 0;
    case ARGP_KEY_ARG: return command_take(arg, &in->topic, 1, state);
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {NULL,
                                 parse,
                                 "[VERB | case | plan | landmarks]",
                                 "Explains a verb, or the fields of a case, of a plan, or the landmarks.",
                                 command_common,
                                 NULL,
                                 NULL};

static void print_overview(void)
{
    printf("Usage: gnathos VERB [options] ...\n\nPredicts the face after jaw surgery from a case (surfaces and "
           "landmarks of a head)\nand a plan (moves of the bones).\n\n");
    for (int i = 0; i < verb_count; i++)
        if (verbs[i].run) printf("  %-9s %s\n", verbs[i].name, verbs[i].help);
    printf("\nKnown, but not part of this build:\n\n");
    for (int i = 0; i < verb_count; i++)
        if (!verbs[i].run) printf("  %-9s %s: %s\n", verbs[i].name, verbs[i].help, verbs[i].refusal);
    printf("\ngnathos VERB --help lists the options of a verb; gnathos help case, plan and landmarks\nlist what "
           "goes "
           "into the files.\n\nExit status: 0 done, 1 internal error, 2 usage, 3 an input file is wrong, 4 the "
           "geometry is\nunusable, 5 no convergence, 6 the plan goes beyond a limit, 7 memory, time or disk, 130 "
           "interrupted.\n");
}

static void print_landmarks(void)
{
    static const char *const need[] = {"required", "le_fort_1", "bsso", "genioplasty"};
    printf("Landmarks: when each is required, what it is, and what is lost without the optional ones.\n\n");
    for (int i = 0; i < landmark_row_count; i++) {
        const landmark_row *r = &landmark_rows[i];
        char when[64] = "";
        for (int b = 0; b < 4; b++) {
            size_t n = strlen(when);
            if (r->need & (1u << b)) snprintf(when + n, sizeof when - n, "%s%s", n ? ", " : "", need[b]);
        }
        printf("  %-8s %-18s %s", r->label, *when ? when : "-", r->help);
        if (r->instead) printf("; %s will do as well", r->instead);
        if (r->lost) printf("; lost: %s", r->lost);
        printf("\n");
    }
}

int command_help(int argc, char **argv)
{
    static const char *const topics[] = {"case", "plan", "landmarks"};
    const char *names[64];
    help_input in = {0};
    int count = 0;
    argp_parse(&argp, argc, argv, 0, NULL, &in);
    if (!in.topic) {
        print_overview();
        return 0;
    }
    if (!strcmp(in.topic, "case")) {
        fields_help(case_fields());
        return 0;
    }
    if (!strcmp(in.topic, "plan")) {
        fields_help(plan_fields());
        printf("\n");
        fields_help(plan_segment_fields());
        return 0;
    }
    if (!strcmp(in.topic, "landmarks")) {
        print_landmarks();
        return 0;
    }
    for (int i = 0; i < 3; i++) names[count++] = topics[i];
    for (int i = 0; i < verb_count && count < 64; i++) {
        names[count++] = verbs[i].name;
        if (strcmp(verbs[i].name, in.topic)) continue;
        if (!verbs[i].run) {
            fprintf(stderr, "gnathos: %s %s\n", in.topic, verbs[i].refusal);
            return ERR_USAGE;
        }
        char name[64], flag[] = "--help", *arguments[] = {name, flag, NULL};
        snprintf(name, sizeof name, "gnathos %s", in.topic);
        return verbs[i].run(2, arguments);
    }
    int near = suggest_nearest(in.topic, names, count);
    if (near >= 0)
        fprintf(stderr, "gnathos: no help on \"%s\"; did you mean \"%s\"?\n", in.topic, names[near]);
    else
        fprintf(stderr, "gnathos: no help on \"%s\"; topics are case, plan, landmarks and the verbs\n", in.topic);
    return ERR_USAGE;
}
