#include "app/cli/plan_audit_print.h"
#include "app/planner/patient/case_guess.h"
#include <math.h>
#include <stdio.h>

static void print_finding(const plan_audit *a, const finding *f)
{
    const limit *l = &limit_default[f->limit];
    const limit_range *r = &a->patient->limits[f->limit];
    char name[80], scan[40] = "", fine[LIMIT_WORDS_SIZE], stop[LIMIT_WORDS_SIZE], margin[24] = "-";
    snprintf(name, sizeof name, "%s%s%s", l->name, *f->where ? ", " : "", f->where);
    if (f->level == LIMIT_NOT_JUDGED) {
        printf("%-10s %-56s %s\n", limit_level_name(f->level), name, f->note);
        return;
    }
    if (isfinite(f->margin)) snprintf(margin, sizeof margin, "%.2f", f->margin);
    if (!isnan(f->scan)) snprintf(scan, sizeof scan, "  in the scan %.2f", f->scan);
    bool told = f->note && f->level >= LIMIT_CAUTION;
    printf("%-10s %-56s %8.2f  %-14s %-14s %8s%s%s%s%s\n", limit_level_name(f->level), name, f->value,
           limit_range_words(r->fine, fine), limit_range_words(r->stop, stop), margin,
           f->estimated ? "  estimated" : "", scan, told ? "  " : "", told ? f->note : "");
}

static void print_stops(const judgement *j)
{
    int count = 0;
    for (int i = 0; i < j->count; i++) {
        const finding *f = &j->finding[i];
        if (f->level != LIMIT_STOP) continue;
        printf("%s%s%s%s", count++ ? "; " : "", limit_default[f->limit].name, *f->where ? ", " : "", f->where);
    }
}

static void print_remedy(const remedy *r)
{
    if (!r->found) {
        printf(
            "No remedy was found: no change of the pieces that the plan moves brings all limits together. Nearest to it, "
            "these still stop: ");
        print_stops(&r->after);
        printf(".\n");
        return;
    }
    int caution = 0;
    for (int i = 0; i < r->after.count; i++) caution += r->after.finding[i].level == LIMIT_CAUTION;
    printf("Remedy, the nearest plan found that nothing stops (judged again: %d caution); -o DIR writes it as "
           "DIR/remedy.json:\n",
           caution);
    for (int i = 0; i < r->change_count; i++) {
        const remedy_change *x = &r->change[i];
        if (isfinite(x->wanted))
            printf("  %-28s %8.2f -> %.2f %s\n", x->control, x->wanted, x->proposed, x->unit);
        else
            printf("  %-28s by %+.2f %s, besides the matrix\n", x->control, x->by, x->unit);
    }
}

void judgement_print_headline(const judgement *j, const case_file *c)
{
    const finding *f = j->reason >= 0 ? &j->finding[j->reason] : NULL;
    char stop[LIMIT_WORDS_SIZE], guessed[256];
    if (*case_guess_text(&c->guessed, guessed, sizeof guessed)) printf("guessed, not from the scan: %s\n\n", guessed);
    if (!f || (f->level != LIMIT_STOP && !f->leads)) return;
    printf("%s: %s%s%s is %.4g", limit_level_name(f->level), limit_default[f->limit].name, *f->where ? ", " : "",
           f->where, f->value);
    if (f->level == LIMIT_STOP) printf(", must be %s", limit_range_words(c->limits[f->limit].stop, stop));
    printf("%s%s\n\n", f->note ? ": " : "", f->note ? f->note : "");
}

void plan_audit_print(const plan_audit *a)
{
    const judgement *j = &a->judgement;
    int count[4] = {0};
    for (int i = 0; i < j->count; i++) count[j->finding[i].level]++;
    judgement_print_headline(j, a->patient);
    printf("plan %s on %s: %d stop, %d caution, %d fine, %d not judged\n\n", a->plan->name, a->patient->name,
           count[LIMIT_STOP], count[LIMIT_CAUTION], count[LIMIT_FINE], count[LIMIT_NOT_JUDGED]);
    printf("%-10s %-56s %8s  %-14s %-14s %8s\n", "level", "limit", "value", "fine", "stop outside", "margin");
    static const limit_level order[] = {LIMIT_STOP, LIMIT_CAUTION, LIMIT_FINE, LIMIT_NOT_JUDGED};
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < j->count; i++)
            if (j->finding[i].level == order[k]) print_finding(a, &j->finding[i]);
    printf("\nThe soft tissue (stretch, incisor show, proportions) is judged by gnathos predict.\n");
    if (j->worst != LIMIT_STOP) return;
    print_remedy(&a->remedy);
    if (*a->plan->override)
        printf("Stops accepted because: %s\n", a->plan->override);
    else
        printf("Not feasible as it stands. Change the plan, or say why in \"override\".\n");
}

void judgement_print_brief(const judgement *j, const case_file *c)
{
    int count[4] = {0};
    char stop[LIMIT_WORDS_SIZE];
    for (int i = 0; i < j->count; i++) count[j->finding[i].level]++;
    printf("limits: %d stop, %d caution, %d not judged (gnathos audit CASE --plan lists them)\n", count[LIMIT_STOP],
           count[LIMIT_CAUTION], count[LIMIT_NOT_JUDGED]);
    for (int i = 0; i < j->count; i++) {
        const finding *f = &j->finding[i];
        if (f->level == LIMIT_STOP)
            printf("  %s%s%s is %.4g, should be %s\n", limit_default[f->limit].name, *f->where ? ", " : "", f->where,
                   f->value, limit_range_words(c->limits[f->limit].stop, stop));
    }
}
