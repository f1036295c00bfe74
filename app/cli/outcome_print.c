#include "app/cli/outcome_print.h"
#include "app/cli/plan_audit_print.h"
#include "app/planner/predict/outcome_scene.h"
#include <math.h>
#include <stdio.h>

static void print_scene(const outcome *o)
{
    const scene_report *s = o->scene;
    char element[160];
    outcome_element_words(o, element, sizeof element);
    printf("tissue: %s\n", element);
    if (s->full)
        printf("scene: all %d tets are solved for\n", s->tets);
    else
        printf("scene: %d of %d tets are left out, which would move less than %.2f mm; that costs the skin "
               "%.4f mm at most, "
               "by estimate (--full leaves nothing out)\n",
               s->left_out_tets, s->tets, s->tolerance_mm, outcome_left_out_mm(o));
}

static void print_contact(const contact_report *c)
{
    if (!c->on) return;
    printf("contact%s: %d of %d nodes press on something, %.0f mm2 on bone and %.0f mm2 between the lips, deepest "
           "%.3f mm, up to %.1f kPa; %d iterations without, %d with contact\n",
           c->held ? " (lips and mucosa keep in touch)" : "", c->active_nodes, c->nodes, c->bone_area_mm2,
           c->lip_area_mm2, c->depth_mm, c->pressure_kpa, c->free_iterations, c->contact_iterations);
    if (c->passed)
        printf(
            "%d nodes of the lining went right through a bone, as between tooth rows that change places: the shape is not to "
            "be trusted near there\n",
            c->passed);
    if (c->guards)
        printf("%d nodes are held by planes before a bone that they would else have gone through\n", c->guards);
    if (c->lost) printf("%d nodes in bone were given up: on which side of it they belong is not clear\n", c->lost);
    if (c->pinched) printf("%d nodes lie where two bones overlap and cannot be out of both\n", c->pinched);
}

static void print_depth(const bone_depth *d)
{
    if (!d->nodes) return;
    printf("tissue is up to %.2f mm deeper in bone than at rest, over %.0f mm2 (more than 1 mm over %.0f mm2); "
           "deepest in the %s at (%.1f, %.1f, %.1f) mm, %.1f mm below the skin\n",
           d->depth_mm, d->area_mm2, d->area_deep_mm2, segment_name((segment_id)d->segment), d->at[0], d->at[1],
           d->at[2], d->from_skin_mm);
}

static void print_ratios(const outcome *o)
{
    soft_ratio r[SOFT_RATIOS_MAX];
    int count = soft_ratios(o->prepared, o->points, r);
    printf("\n%-8s %9s %7s %7s   %-5s %9s %7s %7s   %s\n", "soft", "forward", "up", "left", "hard", "forward", "up",
           "left", "ratio");
    for (int i = 0; i < count; i++) {
        printf("%-8s %9.2f %7.2f %7.2f   %-5s %9.2f %7.2f %7.2f   ", r[i].soft, r[i].soft_mm[0], r[i].soft_mm[1],
               r[i].soft_mm[2], r[i].hard, r[i].hard_mm[0], r[i].hard_mm[1], r[i].hard_mm[2]);
        if (isfinite(r[i].ratio))
            printf("%.2f\n", r[i].ratio);
        else
            printf("-\n");
    }
}

void outcome_print(const outcome *o)
{
    const equilibrium *q = o->solve;
    judgement_print_headline(o->limits, o->patient);
    printf("%s: %s in %d iterations; residual %.1e of the initial one; smallest J %.2f, %d inverted tets, "
           "largest stretch "
           "%.2f\n",
           o->plan->name[0] ? o->plan->name : "plan", solve_outcome_text(q->outcome), q->iterations,
           outcome_relative_residual(q), q->extremes.min_j, q->extremes.inverted_count, q->extremes.max_stretch);
    printf("prepare %.1f s%s, solve %.1f s\n", o->stages.prepare.wall_s, o->prepared->reused ? " (reused)" : "",
           o->stages.ready.wall_s + o->stages.solve.wall_s);
    print_scene(o);
    if (q->extremes.inverted_count > 0) {
        double middle[3], away = outcome_worst_tet(o, middle);
        printf("%d tets are turned inside out, the worst at (%.1f, %.1f, %.1f) mm, %.1f mm from the skin: the shape is "
               "not to be trusted near there\n",
               q->extremes.inverted_count, middle[0], middle[1], middle[2], away);
    }
    if (q->crushed_tets > 0)
        printf("%d tets were kept from turning inside out by a pressure of their own: tissue is crushed there\n",
               q->crushed_tets);
    judgement_print_brief(o->limits, o->patient);
    print_contact(&q->contact);
    if (!o->points) return;
    print_depth(o->depth);
    print_ratios(o);
    printf("\nAll in mm. %s\n", outcome_trust(o->contact));
}
