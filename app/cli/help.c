/* gnathos help [VERB | case | plan | landmarks | records | KIND] */
#include "app/cli/fields_help.h"
#include "app/cli/records.h"
#include "app/cli/verb.h"
#include "app/planner/patient/landmark_needs.h"
#include "geometry/landmark_names.h"
#include "geometry/suggest.h"
#include <stdio.h>
#include <string.h>

typedef struct help_options {
    bool record, schema;
} help_options;

enum { KEY_RECORD = KEY_OWN, KEY_SCHEMA, NAMES_MAX = 96 };

static const struct argp_option options[] = {
    {"record", KEY_RECORD, NULL, 0, "The fields of records of this KIND, which can be named as a verb is", 0},
    {"schema", KEY_SCHEMA, NULL, 0, "JSON schema of records of this KIND", 0},
    {0}};

static error_t parse(int key, char *arg, run_context *r, struct argp_state *state)
{
    help_options *in = r->own;
    (void)arg;
    switch (key) {
    case KEY_RECORD: in->record = true; return 0;
    case KEY_SCHEMA: in->schema = true; return 0;
    case ARGP_KEY_END:
        if ((in->record || in->schema) && !r->argument[0])
            command_usage(state, "name a kind of records (gnathos help records lists them)");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static void print_overview(void)
{
    printf("Usage: gnathos VERB [options] ...\n\nPredicts the face after jaw surgery from a case (surfaces and "
           "landmarks of a head)\nand a plan (moves of the bones).\n\n");
    for (int i = 0; i < verb_count; i++)
        if (verbs[i].verb) printf("  %-9s %s\n", verbs[i].name, verbs[i].help);
    printf("\nKnown, but not part of this build:\n\n");
    for (int i = 0; i < verb_count; i++)
        if (!verbs[i].verb) printf("  %-9s %s: %s\n", verbs[i].name, verbs[i].help, verbs[i].refusal);
    printf(
        "\ngnathos VERB --help lists the options of a verb; gnathos help case, plan and landmarks\nlist what "
        "goes "
        "into the files, gnathos help records what comes out.\n\nExit status: 0 done, 1 internal error, 2 usage, 3 an input file is wrong, 4 the "
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
    printf("\nNames of ALI-CBCT (Slicer Automated Dental Tools) that are taken for these; of two, their middle:\n\n");
    for (int i = 0; i < landmark_alias_count; i++)
        printf("  %-8s %s\n", landmark_aliases[i].label, landmark_aliases[i].names);
}

static bool explain_verb(const verb_row *v, run_context *r, err *e)
{
    if (!v->verb) return err_set(e, ERR_USAGE, "%s %s", v->name, v->refusal);
    char name[64], flag[] = "--help", *arguments[] = {name, flag, NULL};
    snprintf(name, sizeof name, "gnathos %s", v->name);
    r->status = verb_run(v->verb, 2, arguments);
    return true;
}

static bool no_help(const char *topic, const char *const *names, int count, const char *known, err *e)
{
    int near = suggest_nearest(topic, names, count);
    if (near >= 0) return err_set(e, ERR_USAGE, "no help on \"%s\"; did you mean \"%s\"?", topic, names[near]);
    return err_set(e, ERR_USAGE, "no help on \"%s\"; %s", topic, known);
}

/* Fields or schema of a kind of records. */
static bool explain_record(const char *kind, const help_options *in, err *e)
{
    const char *names[NAMES_MAX];
    int count = 0;
    const record_table *t = records_find(kind);
    for (; records_nth(count) && count < NAMES_MAX; count++) names[count] = records_nth(count)->kind;
    if (!t) return no_help(kind, names, count, "gnathos help records lists the kinds of records", e);
    if (in->schema)
        command_print_record(record_schema(t));
    else
        records_help(t);
    return true;
}

static void print_case(void) { fields_help(case_fields()); }

static void print_plan(void)
{
    fields_help(plan_fields());
    printf("\n");
    fields_help(plan_segment_fields());
}

static bool run(run_context *r, err *e)
{
    static const struct {
        const char *name;
        void (*print)(void);
    } topics[] = {
        {"case", print_case}, {"plan", print_plan}, {"landmarks", print_landmarks}, {"records", records_list}};
    const char *topic = r->argument[0], *names[NAMES_MAX];
    const help_options *in = r->own;
    int count = 0;
    if (!topic) {
        print_overview();
        return true;
    }
    if (in->record || in->schema) return explain_record(topic, in, e);
    for (size_t i = 0; i < sizeof topics / sizeof *topics; i++) {
        names[count++] = topics[i].name;
        if (strcmp(topics[i].name, topic)) continue;
        topics[i].print();
        return true;
    }
    for (int i = 0; i < verb_count && count < NAMES_MAX; i++) {
        names[count++] = verbs[i].name;
        if (!strcmp(verbs[i].name, topic)) return explain_verb(&verbs[i], r, e);
    }
    if (records_find(topic)) return explain_record(topic, in, e);
    for (int i = 0; records_nth(i) && count < NAMES_MAX; i++) names[count++] = records_nth(i)->kind;
    return no_help(topic, names, count, "topics are case, plan, landmarks, records, their kinds and the verbs", e);
}

const verb verb_help = {.arguments = "[VERB | case | plan | landmarks | records | KIND]",
                        .about =
                            "Explains a verb, the fields of a case or of a plan, the landmarks, or the fields of the "
                            "records that verbs write and print.",
                        .options = options,
                        .argument_count = 1,
                        .own_size = sizeof(help_options),
                        .parse = parse,
                        .run = run};
