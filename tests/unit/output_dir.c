#include "tests/check.h"
#include "app/planner/store/output_dir.h"
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
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

/* A process that ran and is gone. */
static long gone(void)
{
    pid_t child = fork();
    if (!child) _exit(0);
    waitpid(child, NULL, 0);
    return (long)child;
}

static void what_killed_runs_left_is_removed(void **state)
{
    (void)state;
    err e = {0};
    output_dir d;
    char name[64], line[256];
    int before = entries();
    for (int i = 0; i < 3; i++) { /* a gone process, one that had our number, and a file */
        long process = i == 1 ? (long)getpid() : gone();
        snprintf(name, sizeof name, ".%s.%ld.part", i < 2 ? "c" : "d", process);
        snprintf(line, sizeof line, i < 2 ? "mkdir %s; echo x > %s/x" : "echo x > %s", at(name), at(name));
        assert_int_equal(system(line), 0);
    }
    assert_int_equal(mkdir(at(".other.1.part"), 0777), 0);
    assert_int_equal(entries(), before + 4);
    assert_ok(output_dir_open(at("c"), false, &d, &e));
    assert_int_equal(entries(), before + 3); /* the new one, the file of d, and of another target */
    output_dir_abandon(&d);
    assert_ok(write_whole(at("d"), "x", 1, &e));
    assert_int_equal(entries(), before + 2);
    assert_int_equal(rmdir(at(".other.1.part")), 0);
    assert_int_equal(unlink(at("d")), 0);
}

static void two_runs_into_one_folder_are_refused(void **state)
{
    (void)state;
    err e = {0};
    output_dir d, second;
    for (int force = 0; force < 2; force++) { /* a new folder, then earlier results */
        const char *target = force ? at("a") : at("e");
        assert_ok(output_dir_open(target, force, &d, &e));
        pid_t child = fork();
        if (!child) _exit(output_dir_open(target, force, &second, &e) ? 99 : (int)e.code);
        int status;
        waitpid(child, &status, 0);
        assert_int_equal(WEXITSTATUS(status), ERR_RESOURCE);
        assert_refused(output_dir_open(target, force, &second, &e), ERR_RESOURCE);
        output_dir_abandon(&d);
        assert_ok(output_dir_open(target, force, &d, &e));
        output_dir_abandon(&d);
    }
}

/* As a signal handler does it; a forked child leaves the folder of its parent alone. */
static void a_sudden_end_leaves_no_folder(void **state)
{
    (void)state;
    err e = {0};
    output_dir d;
    int before = entries(), status;
    assert_ok(output_dir_open(at("f"), false, &d, &e));
    pid_t child = fork();
    if (!child) {
        whole_folder_abandon_all();
        _exit(0);
    }
    waitpid(child, &status, 0);
    assert_int_equal(entries(), before + 1);
    fill(&d, "x", "y");
    char *inner = output_dir_file(&d, "stills");
    assert_int_equal(mkdir(inner, 0777), 0);
    free(inner);
    fill(&d, "stills/y", "z");
    whole_folder_abandon_all();
    assert_int_equal(entries(), before);
    output_dir_abandon(&d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(results_appear_at_the_end_only),
        cmocka_unit_test(an_abandoned_folder_leaves_nothing),
        cmocka_unit_test(earlier_results_are_replaced_by_force_only),
        cmocka_unit_test(what_gnathos_did_not_write_is_never_replaced),
        cmocka_unit_test(what_killed_runs_left_is_removed),
        cmocka_unit_test(two_runs_into_one_folder_are_refused),
        cmocka_unit_test(a_sudden_end_leaves_no_folder),
        cmocka_unit_test(a_folder_that_cannot_be_made_is_refused),
    };
    return cmocka_run_group_tests(tests, make_root, drop_root);
}
