#include "app/cli/ceph_print.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static void print_norm(const ceph_norm *n)
{
    if (isfinite(n->mean))
        printf("  %6.1f +- %4.1f", n->mean, n->sd);
    else
        printf("  %14s", "");
}

void ceph_print(const landmarks *before, const landmarks *after, const head_frame *frame, char sex)
{
    ceph_value was[CEPH_MEASURES_MAX], is[CEPH_MEASURES_MAX];
    ceph_evaluate(before, frame, was);
    if (after) ceph_evaluate(after, frame, is);
    const char *group = "";
    printf("%-20s      %8s", "", after ? "before" : "value");
    if (after) printf(" %8s %8s", "planned", "change");
    if (sex != 'm') printf("  %14s", "norm, women");
    if (sex != 'f') printf("  %14s", "norm, men");
    putchar('\n');
    for (int i = 0; i < ceph_measure_count; i++) {
        const ceph_measure *m = ceph_measures + i;
        if (strcmp(m->group, group)) printf("%s\n", group = m->group);
        printf("  %-18s %-4s ", m->name, m->unit);
        if (!isfinite(was[i].value)) {
            printf("%8s  %s\n", "-", was[i].note);
            continue;
        }
        printf("%8.1f", was[i].value);
        if (after) printf(" %8.1f %+8.1f", is[i].value, is[i].value - was[i].value);
        if (sex != 'm') print_norm(&m->women);
        if (sex != 'f') print_norm(&m->men);
        printf("%s%s\n", *was[i].note ? "  " : "", was[i].note);
    }
}
