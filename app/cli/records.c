#include "app/cli/records.h"
#include "app/cli/made_record.h"
#include "app/planner/predict/ceph_report.h"
#if GNATHOS_WITH_CGAL
#include "app/cli/new_record.h"
#include "app/planner/judge/judgement_record.h"
#include "app/planner/patient/check_record.h"
#include "app/planner/patient/cut_record.h"
#include "app/planner/patient/import_record.h"
#include "app/planner/patient/prepared_report.h"
#include "app/planner/predict/compare_record.h"
#endif
#if GNATHOS_WITH_SIM && GNATHOS_WITH_CGAL
#include "app/cli/landmarks_record.h"
#include "app/planner/bounds/audit_record.h"
#include "app/planner/identity/fit_record.h"
#include "app/planner/predict/outcome_record.h"
#include "app/identities/identities.h"
#include "app/study/record.h"
#include "app/cli/template_record.h"
#endif
#if GNATHOS_WITH_SIM
#include "app/stress/record.h"
#endif
#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 256 };

static const record_table *const all[] = {
#if GNATHOS_WITH_CGAL
    &new_record_table,
    &import_record_table,
    &check_record_table,
    &cut_record_table,
    &prepared_record_table,
    &plan_audit_table,
    &comparison_table,
#endif
#if GNATHOS_WITH_SIM && GNATHOS_WITH_CGAL
    &outcome_table,
    &audit_table,
    &study_record_table,
    &study_ratios_table,
    &study_folder_table,
    &template_record_table,
    &identities_table,
    &identity_table,
    &identity_made_table,
    &fit_record_table,
    &landmarks_record_table,
#endif
#if GNATHOS_WITH_SIM
    &stress_table,
#endif
    &cephalometry_table,
    &made_record_table,
    NULL};

const record_table *records_nth(int n) { return all[n]; }

const record_table *records_find(const char *kind)
{
    for (int i = 0; all[i]; i++)
        if (!strcmp(all[i]->kind, kind)) return all[i];
    return NULL;
}

static void print_words(const record_row *r)
{
    char word[64];
    printf("one of");
    for (int i = 0; record_word(r, i, word); i++) printf("%s %s", i ? "," : ":", word);
}

static void print_kind(const record_row *r, record_kind kind)
{
    switch (kind) {
    case RECORD_NUMBER: printf("a number"); break;
    case RECORD_COUNT:
    case RECORD_LONG: printf("a whole number"); break;
    case RECORD_BOOL: printf("true or false"); break;
    case RECORD_TEXT:
    case RECORD_CHARS:
    case RECORD_WORD:
        if (r->words)
            print_words(r);
        else
            printf("a text");
        break;
    case RECORD_NUMBERS: printf("a list of %d numbers", r->length); break;
    default: break;
    }
    if (r->unit) printf(", %s", r->unit);
}

static bool is_object(record_kind kind) { return kind == RECORD_OBJECT || kind == RECORD_JSON; }

static void print_rows(const record_table *t, const char *base)
{
    for (int i = 0; i < t->count; i++) {
        const record_row *r = &t->row[i];
        bool list = r->kind == RECORD_LIST, map = r->kind == RECORD_MAP, object;
        record_kind kind = list || map ? r->item : r->kind;
        char path[PATH_SIZE];
        snprintf(path, sizeof path, "%s%s%s%s%s", base, r->name,
                 list  ? "[]"
                 : map ? ".<"
                       : "",
                 map ? r->key : "", map ? ">" : "");
        object = is_object(kind);
        printf("\n  %s\n      ", path);
        print_kind(r, kind);
        printf("%s%s%s%s\n", object ? "" : "; ", r->help, r->when || r->optional ? "; not always there" : "",
               r->or_null ? "; null where there is none" : "");
        if (!object) continue;
        snprintf(path + strlen(path), sizeof path - strlen(path), ".");
        print_rows(r->table, path);
    }
}

void records_help(const record_table *t)
{
    printf("%s\n\n  gnathos\n      the number %d, the format's version\n\n  kind\n      the text \"%s\"\n\n"
           "  version\n      a text; the program that wrote it\n",
           t->title, RECORD_FORMAT, t->kind);
    print_rows(t, "");
    printf("\nNumbers that are not known or not finite are null. []: a list; <>: one field for each.\n");
}

void records_list(void)
{
    printf("Records, which verbs write into files and print with --json. gnathos help --record KIND lists the fields "
           "of one,\ngnathos help --schema KIND prints its JSON schema.\n\n");
    for (int i = 0; all[i]; i++) printf("  %-14s %s\n", all[i]->kind, all[i]->title);
}
