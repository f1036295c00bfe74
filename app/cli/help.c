/* gnathos help [VERB | case | plan | landmarks] */
#include "app/cli/fields_help.h"
#include "app/cli/verb.h"
#include "app/planner/patient/landmark_needs.h"
#include "app/planner/store/suggest.h"
#include <stdio.h>
#include <string.h>

static void print_overview(void)
{
    printf("Usage: gnathos VERB [options] ...\n\nPredicts the face after jaw surgery from a case (surfaces and "
           "landmarks of a head)\nand a plan (moves of the bones).\n\n");
    for (int i = 0; i < verb_count; i++)
        if (verbs[i].verb) printf("  %-9s %s\n", verbs[i].name, verbs[i].help);
    printf("\nKnown, but not part of this build:\n\n");
    for (int i = 0; i < verb_count; i++)
        if (!verbs[i].verb) printf("  %-9s %s: %s\n", verbs[i].name, verbs[i].help, verbs[i].refusal);
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

static bool explain_verb(const verb_row *v, run_context *r, err *e)
{
    if (!v->verb) return err_set(e, ERR_USAGE, "%s %s", v->name, v->refusal);
    char name[64], flag[] = "--help", *arguments[] = {name, flag, NULL};
    snprintf(name, sizeof name, "gnathos %s", v->name);
    r->status = verb_run(v->verb, 2, arguments);
    return true;
}

static bool explain(const char *topic, run_context *r, err *e)
{
    static const char *const topics[] = {"case", "plan", "landmarks"};
    const char *names[64];
    int count = 0;
    for (int i = 0; i < 3; i++) names[count++] = topics[i];
    for (int i = 0; i < verb_count && count < 64; i++) {
        names[count++] = verbs[i].name;
        if (!strcmp(verbs[i].name, topic)) return explain_verb(&verbs[i], r, e);
    }
    int near = suggest_nearest(topic, names, count);
    if (near >= 0) return err_set(e, ERR_USAGE, "no help on \"%s\"; did you mean \"%s\"?", topic, names[near]);
    return err_set(e, ERR_USAGE, "no help on \"%s\"; topics are case, plan, landmarks and the verbs", topic);
}

static bool run(run_context *r, err *e)
{
    const char *topic = r->argument[0];
    if (!topic) {
        print_overview();
    } else if (!strcmp(topic, "case")) {
        fields_help(case_fields());
    } else if (!strcmp(topic, "plan")) {
        fields_help(plan_fields());
        printf("\n");
        fields_help(plan_segment_fields());
    } else if (!strcmp(topic, "landmarks")) {
        print_landmarks();
    } else {
        return explain(topic, r, e);
    }
    return true;
}

const verb verb_help = {.arguments = "[VERB | case | plan | landmarks]",
                        .about = "Explains a verb, or the fields of a case, of a plan, or the landmarks.",
                        .argument_count = 1,
                        .run = run};
