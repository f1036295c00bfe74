#include "tests/check.h"
#include "app/planner/store/journal.h"
#include "geometry/mem.h"
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char key[HASH_TEXT_SIZE] = "aaaa", other[HASH_TEXT_SIZE] = "bbbb";

static const char *file(void)
{
    static char path[64];
    snprintf(path, sizeof path, "journal-%ld", (long)getpid());
    return path;
}

struct seen {
    int count;
    char text[4][16];
};

static bool read_one(uint32_t kind, const void *bytes, size_t size, void *context, err *e)
{
    struct seen *s = context;
    assert_in_range(s->count, 0, 3);
    assert_in_range(size, 0, 15);
    memcpy(s->text[s->count], bytes, size);
    s->text[s->count++][size] = 0;
    return kind != 9 || err_set(e, ERR_INPUT, "kind 9");
}

static void add(journal *j, uint32_t kind, const char *text)
{
    err e = {0};
    assert_ok(journal_add(j, kind, text, strlen(text), &e));
}

static long size_now(void)
{
    struct stat info;
    assert_int_equal(stat(file(), &info), 0);
    return (long)info.st_size;
}

static void records_come_back_in_order(void **state)
{
    (void)state;
    err e = {0};
    journal j;
    struct seen s = {0};
    assert_ok(journal_open(file(), key, false, read_one, &s, &j, &e));
    add(&j, 1, "one");
    add(&j, 2, "");
    add(&j, 1, "three");
    journal_close(&j);
    journal_close(&j);
    assert_int_equal(s.count, 0);
    assert_ok(journal_open(file(), key, false, read_one, &s, &j, &e));
    assert_int_equal(s.count, 3);
    assert_int_equal(j.record_count, 3);
    assert_string_equal(s.text[0], "one");
    assert_string_equal(s.text[1], "");
    assert_string_equal(s.text[2], "three");
    journal_close(&j);
}

/* Wherever a kill cuts the file, the whole records before the cut are there and new ones go behind them. */
static void a_cut_loses_only_what_was_not_whole(void **state)
{
    (void)state;
    err e = {0};
    journal j;
    long full = size_now(), empty = full - 3 * 24 - 8, ends[4] = {empty, empty + 27, empty + 51, full};
    for (long cut = full; cut >= 0; cut--) {
        struct seen s = {0};
        int want = 0;
        while (want < 3 && ends[want + 1] <= cut) want++;
        assert_int_equal(truncate(file(), cut), 0);
        assert_ok(journal_open(file(), key, false, read_one, &s, &j, &e));
        assert_int_equal(s.count, want);
        assert_int_equal(j.record_count, want);
        assert_int_equal(size_now(), ends[want]);
        add(&j, 1, "new");
        journal_close(&j);
        s = (struct seen){0};
        assert_ok(journal_open(file(), key, false, read_one, &s, &j, &e));
        assert_int_equal(s.count, want + 1);
        assert_string_equal(s.text[want], "new");
        journal_close(&j);
        assert_int_equal(truncate(file(), ends[want]), 0);
    }
}

static void a_flipped_bit_ends_the_journal(void **state)
{
    (void)state;
    err e = {0};
    journal j;
    struct seen s = {0};
    assert_ok(journal_open(file(), key, true, read_one, &s, &j, &e));
    add(&j, 1, "one");
    add(&j, 1, "two");
    journal_close(&j);
    FILE *f = fopen(file(), "r+b");
    assert_int_equal(fseek(f, -1, SEEK_END), 0);
    fputc('O', f);
    fclose(f);
    assert_ok(journal_open(file(), key, false, read_one, &s, &j, &e));
    assert_int_equal(s.count, 1);
    journal_close(&j);
}

static void other_files_are_refused(void **state)
{
    (void)state;
    err e = {0};
    journal j, again;
    struct seen s = {0};
    assert_refused(journal_open(file(), other, false, read_one, &s, &j, &e), ERR_INPUT);
    assert_true(size_now() > 0);
    assert_ok(journal_open(file(), other, true, read_one, &s, &j, &e));
    assert_int_equal(s.count, 0);
    assert_refused(journal_open(file(), other, false, read_one, &s, &again, &e), ERR_RESOURCE);
    add(&j, 9, "nine");
    journal_close(&j);
    assert_refused(journal_open(file(), other, false, read_one, &s, &j, &e), ERR_INPUT);
    FILE *f = fopen(file(), "wb");
    fputs("letter", f);
    fclose(f);
    assert_refused(journal_open(file(), key, false, read_one, &s, &j, &e), ERR_INPUT);
    assert_int_equal(size_now(), 6);
    assert_ok(journal_open(file(), key, true, read_one, &s, &j, &e));
    journal_remove(&j);
    assert_int_equal(access(file(), F_OK), -1);
    assert_refused(journal_open("no/such/folder/j", key, false, read_one, &s, &j, &e), ERR_RESOURCE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(records_come_back_in_order),
        cmocka_unit_test(a_cut_loses_only_what_was_not_whole),
        cmocka_unit_test(a_flipped_bit_ends_the_journal),
        cmocka_unit_test(other_files_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
