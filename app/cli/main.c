/* gnathos VERB ...: finds the verb and runs it. */
#include "app/cli/verb.h"
#include "geometry/suggest.h"
#include <stdio.h>
#include <string.h>

#define NOT_BUILT NULL, "is not built yet"
#if GNATHOS_WITH_CGAL
#define WITH_CGAL(verb) &verb, NULL
#else
#define WITH_CGAL(verb) NULL, "cannot run: this build has no cuts and meshing (GNATHOS_CGAL=OFF)"
#endif
#if GNATHOS_WITH_SIM && GNATHOS_WITH_CGAL
#define WITH_SIM(verb) &verb, NULL
#elif GNATHOS_WITH_SIM
#define WITH_SIM(verb) WITH_CGAL(verb)
#else
#define WITH_SIM(verb) NULL, "cannot run: this build has no solver (GNATHOS_SIM=OFF)"
#endif
#if GNATHOS_WITH_SIM
#define WITH_SOLVER(verb) &verb, NULL
#else
#define WITH_SOLVER(verb) WITH_SIM(verb)
#endif
#if GNATHOS_WITH_RENDER
#define WITH_RENDER(verb) &verb, NULL
#else
#define WITH_RENDER(verb) NULL, "cannot run: this build has no renderer (GNATHOS_RENDER=OFF)"
#endif

#if GNATHOS_WITH_REPORT && GNATHOS_WITH_RENDER && GNATHOS_WITH_CGAL
#define WITH_REPORT(verb) &verb, NULL
#elif GNATHOS_WITH_REPORT && GNATHOS_WITH_RENDER
#define WITH_REPORT(verb) WITH_CGAL(verb)
#elif GNATHOS_WITH_REPORT
#define WITH_REPORT(verb) WITH_RENDER(verb)
#else
#define WITH_REPORT(verb) NULL, "cannot run: this build has no report (GNATHOS_REPORT=OFF)"
#endif

const verb_row verbs[] = {
    {"help", "what a verb, a case, a plan or the landmarks are made of", &verb_help, NULL},
    {"new", "make a case of a synthetic head", WITH_CGAL(verb_new)},
    {"import", "make a case from meshes or a label map", WITH_CGAL(verb_import)},
    {"check", "read a case and a plan and name everything wrong in them", WITH_CGAL(verb_check)},
    {"cut", "cut the bones along the osteotomies", WITH_CGAL(verb_cut)},
    {"prepare", "cut the bones and mesh the soft tissue of a case", WITH_CGAL(verb_prepare)},
    {"predict", "predict the face after a plan", WITH_SIM(verb_predict)},
    {"render", "draw the pictures of an outcome again", WITH_RENDER(verb_render)},
    {"report", "one page about an outcome, to open in a browser", WITH_REPORT(verb_report)},
    {"export", "write the shapes of an outcome for other programs", WITH_CGAL(verb_export)},
    {"compare", "compare a prediction with an actual face", WITH_CGAL(verb_compare)},
    {"ceph", "measure the profile of a case or an outcome", &verb_ceph, NULL},
    {"audit", "judge a plan by the limits of bone, teeth and nerve", WITH_CGAL(verb_audit)},
    {"template", "the head in whose numbering all heads are described", WITH_SIM(verb_template)},
    {"fit", "bring the template of heads into the shape of a patient", WITH_SIM(verb_fit)},
    {"landmarks", "place the landmarks of a head", WITH_SIM(verb_landmarks)},
    {"study", "error against run time of a case", WITH_SIM(verb_study)},
    {"identities", "learn how heads differ, and make new ones", WITH_SIM(verb_identities)},
    {"stress", "stiff materials and extreme moves", WITH_SOLVER(verb_stress)},
    {"serve", "plan in a browser", NOT_BUILT},
    {"cohort", "run many cases", NOT_BUILT},
    {"strain", "muscle strains from face captures", NOT_BUILT},
};
const int verb_count = sizeof verbs / sizeof verbs[0];

static int unknown_verb(const char *word)
{
    const char *names[sizeof verbs / sizeof verbs[0]];
    for (int i = 0; i < verb_count; i++) names[i] = verbs[i].name;
    int near = suggest_nearest(word, names, verb_count);
    if (near >= 0)
        fprintf(stderr, "gnathos: unknown verb \"%s\"; did you mean \"%s\"?\n", command_shown(word), names[near]);
    else
        fprintf(stderr, "gnathos: unknown verb \"%s\"; gnathos --help lists the verbs\n", command_shown(word));
    return ERR_USAGE;
}

/* It looks like an option, but control bytes are in its name. */
static bool is_no_option(const char *word)
{
    char name[1024], shown[sizeof name];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(word, "="), word);
    err_printable(strcpy(shown, name), sizeof shown);
    return word[0] == '-' && strcmp(name, shown) != 0;
}

static int dispatch(int argc, char **argv)
{
    const char *word = argc > 1 ? argv[1] : "--help";
    if (!strcmp(word, "--help") || !strcmp(word, "-h") || !strcmp(word, "-?")) word = "help";
    if (!strcmp(word, "--version") || !strcmp(word, "-V")) {
        printf("gnathos %s\n", GNATHOS_VERSION);
        return 0;
    }
    if (argc < 2) {
        fprintf(stderr, "gnathos: name a verb; gnathos --help lists them\n");
        return ERR_USAGE;
    }
    if (word[0] == '-') {
        fprintf(stderr, "gnathos: unknown option \"%s\"; options come after the verb\n", command_shown(word));
        return ERR_USAGE;
    }
    for (int i = 2; i < argc; i++) { /* getopt would quote it as it is */
        if (!is_no_option(argv[i])) continue;
        fprintf(stderr, "gnathos %s: unknown option \"%s\"\n", command_shown(word), command_shown(argv[i]));
        return ERR_USAGE;
    }
    for (int i = 0; i < verb_count; i++) {
        if (strcmp(verbs[i].name, word)) continue;
        if (!verbs[i].verb) {
            fprintf(stderr, "gnathos: %s %s\n", word, verbs[i].refusal);
            return ERR_USAGE;
        }
        char name[64];
        snprintf(name, sizeof name, "gnathos %s", word);
        argv[1] = name;
        command_step(word);
        return verb_run(verbs[i].verb, argc - 1, argv + 1);
    }
    return unknown_verb(word);
}

int main(int argc, char **argv)
{
    argp_err_exit_status = ERR_USAGE;
    argp_program_version = "gnathos " GNATHOS_VERSION;
    int status = dispatch(argc, argv);
    if ((fflush(stdout) || ferror(stdout)) && status == 0) {
        fprintf(stderr, "gnathos: the result could not be written to its end\n");
        return ERR_RESOURCE;
    }
    return status;
}
