#include "tests/check.h"
#include "app/planner/store/output_dir.h"
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char root[64];

static int make_root(void **state)
{
    (void)state;
    snprintf(root, sizeof root, "output-%ld", (long)getpid());
    return mkdir(root, 0777);
}

static int drop_root(void **state)
{
    (void)state;
    char line[128];
    snprintf(line, sizeof line, "rm -r %s", root);
    return system(line);
}

static const char *at(const char *name)
{
    static char path[2][256];
    static int turn;
    char *p = path[turn = !turn];
    snprintf(p, 256, "%s/%s", root, name);
    return p;
}

static void fill(const output_dir *d, const char *name, const char *text)
{
    err e = {0};
    char *path = output_dir_file(d, name);
    assert_ok(write_whole(path, text, strlen(text), &e));
    free(path);
}

static int entries(void)
{
    char line[128];
    snprintf(line, sizeof line, "ls -A %s | wc -l", root);
    FILE *p = popen(line, "r");
    int n = -1;
    assert_int_equal(fscanf(p, "%d", &n), 1);
    pclose(p);
    return n;
}

static void results_appear_at_the_end_only(void **state)
{
    (void)state;
    err e = {0};
    output_dir d;
    assert_ok(output_dir_open(at("a"), false, &d, &e));
    fill(&d, "outcome.json", "{}");
    assert_int_equal(access(at("a"), F_OK), -1);
    assert_ok(output_dir_close(&d, &e));
    assert_int_equal(access(at("a/outcome.json"), F_OK), 0);
    assert_int_equal(entries(), 1);
}

static void an_abandoned_folder_leaves_nothing(void **state)
{
    (void)state;
    err e = {0};
    output_dir d;
    assert_ok(output_dir_open(at("b"), false, &d, &e));
    fill(&d, "x", "y");
    output_dir_abandon(&d);
    output_dir_abandon(&d);
    assert_int_equal(entries(), 1);
}

static void earlier_results_are_replaced_by_force_only(void **state)
{
    (void)state;
    err e = {0};
    output_dir d;
    assert_refused(output_dir_open(at("a"), false, &d, &e), ERR_INPUT);
    assert_ok(output_dir_open(at("a/"), true, &d, &e));
    fill(&d, "manifest.json", "new");
    assert_int_equal(access(at("a/outcome.json"), F_OK), 0); /* until the end */
    assert_ok(output_dir_close(&d, &e));
    assert_int_equal(access(at("a/outcome.json"), F_OK), -1);
    assert_int_equal(access(at("a/manifest.json"), F_OK), 0);
    assert_int_equal(entries(), 1);
}

static void what_gnathos_did_not_write_is_never_replaced(void **state)
{
    (void)state;
    err e = {0};
    output_dir d;
    assert_int_equal(mkdir(at("mine"), 0777), 0);
    assert_ok(write_whole(at("mine/letter"), "x", 1, &e));
    assert_refused(output_dir_open(at("mine"), true, &d, &e), ERR_INPUT);
    assert_refused(output_dir_open(at("mine/letter"), true, &d, &e), ERR_INPUT);
    assert_int_equal(access(at("mine/letter"), F_OK), 0);
}

static void a_folder_that_cannot_be_made_is_refused(void **state)
{
    (void)state;
    err e = {0};
    output_dir d;
    assert_refused(output_dir_open(at("no/such/place"), false, &d, &e), ERR_RESOURCE);
    assert_refused(output_dir_open("/proc/gnathos", false, &d, &e), ERR_RESOURCE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(results_appear_at_the_end_only),
        cmocka_unit_test(an_abandoned_folder_leaves_nothing),
        cmocka_unit_test(earlier_results_are_replaced_by_force_only),
        cmocka_unit_test(what_gnathos_did_not_write_is_never_replaced),
        cmocka_unit_test(a_folder_that_cannot_be_made_is_refused),
    };
    return cmocka_run_group_tests(tests, make_root, drop_root);
}
