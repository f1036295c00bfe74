#include "tests/check.h"
#include "geometry/json_file.h"
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char doc[] = "{\n"                                      /* 1 */
                          "  \"name\": \"a } \\\" \\\\\",\n"         /* 2 */
                          "  \"segments\": {\n"                      /* 3 */
                          "    \"maxilla\": { \"translate_mm\": [\n" /* 4 */
                          "      1, -2.5e0,\n"                       /* 5 */
                          "      3 ] },\n"                           /* 6 */
                          "    \"a/b~c\": true,\n"                   /* 7 */
                          "    \"\\u00e4\": null },\n"               /* 8 */
                          "  \"empty\": {}, \"none\": [],\n"         /* 9 */
                          "  \"list\": [ {}, [],\n"                  /* 10 */
                          "    {\"x\": \"]\"}, {\n"                  /* 11 */
                          "     \"deep\": false } ] }\n";            /* 12 */

static json_file parsed(void)
{
    err e = {0};
    json_file f;
    assert_ok(json_file_parse(doc, sizeof doc - 1, "doc.json", &f, &e));
    return f;
}

static void every_value_has_its_line(void **state)
{
    (void)state;
    json_file f = parsed();
    static const struct {
        const char *pointer;
        int line;
    } want[] = {{"", 1},
                {"/name", 2},
                {"/segments", 3},
                {"/segments/maxilla/translate_mm", 4},
                {"/segments/maxilla/translate_mm/0", 5},
                {"/segments/maxilla/translate_mm/1", 5},
                {"/segments/maxilla/translate_mm/2", 6},
                {"/segments/a~1b~0c", 7},
                {"/segments/\xC3\xA4", 8},
                {"/empty", 9},
                {"/none", 9},
                {"/list", 10},
                {"/list/1", 10},
                {"/list/2/x", 11},
                {"/list/3/deep", 12}};
    for (size_t i = 0; i < sizeof want / sizeof want[0]; i++) {
        int line = json_file_line(&f, want[i].pointer);
        if (line != want[i].line) print_error("%s: line %d, want %d\n", want[i].pointer, line, want[i].line);
        assert_int_equal(line, want[i].line);
    }
    json_file_free(&f);
}

static void a_missing_value_has_the_line_of_what_would_hold_it(void **state)
{
    (void)state;
    json_file f = parsed();
    assert_int_equal(json_file_line(&f, "/nothing"), 1);
    assert_int_equal(json_file_line(&f, "/segments/chin"), 3);
    assert_int_equal(json_file_line(&f, "/segments/maxilla/translate_mm/7"), 4);
    assert_int_equal(json_file_line(&f, "/list/x"), 10);
    json_file_free(&f);
}

static void a_refusal_names_file_line_and_field(void **state)
{
    (void)state;
    json_file f = parsed();
    err e = {0};
    assert_false(json_file_refuse(&f, "/segments/maxilla/translate_mm/2", &e, "too %s", "far"));
    assert_int_equal(e.code, ERR_INPUT);
    assert_string_equal(e.text, "doc.json:6: segments.maxilla.translate_mm[2]: too far");
    e = (err){0};
    assert_false(json_file_refuse(&f, "", &e, "all wrong"));
    assert_string_equal(e.text, "doc.json:1: all wrong");
    json_file_free(&f);
}

static void three_numbers_are_read_and_nothing_else(void **state)
{
    (void)state;
    json_file f = parsed();
    err e = {0};
    double v[3] = {7, 7, 7};
    const json_t *maxilla = json_object_get(json_object_get(f.root, "segments"), "maxilla");
    assert_ok(json_file_vec3(&f, json_object_get(maxilla, "translate_mm"), "/segments/maxilla/translate_mm", v, &e));
    assert_near(v[0], 1, 0);
    assert_near(v[1], -2.5, 0);
    assert_near(v[2], 3, 0);
    assert_refused(json_file_vec3(&f, json_object_get(f.root, "list"), "/list", v, &e), ERR_INPUT);
    assert_refused(json_file_vec3(&f, NULL, "/x", v, &e), ERR_INPUT);
    assert_near(v[0], 1, 0);
    json_file_free(&f);
}

static void refuses_what_is_not_json(void **state)
{
    (void)state;
    static const struct {
        const char *text, *want;
    } bad[] = {{"", "x.json: the file is empty"},
               {" \n\t", "x.json: the file is empty"},
               {"{\n\"a\": 1,\n}", "x.json:3: not valid JSON: string or '}' expected near '}' (column 1)"},
               {"{\"a\": 1, \"a\": 2}", "x.json:1: not valid JSON: duplicate object key near '\"a\"' (column 12)"},
               {"{\"a\": NaN}", "x.json:1: not valid JSON: invalid token near 'NaN' (column 9)"},
               {"{\"a\": 1e999}", "x.json:1: not valid JSON: real number overflow near '1e999' (column 11)"},
               {"{\"a\": 1} x", "x.json:1: not valid JSON: end of file expected near 'x' (column 10)"}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        err e = {0};
        json_file f;
        assert_false(json_file_parse(bad[i].text, strlen(bad[i].text), "x.json", &f, &e));
        assert_string_equal(e.text, bad[i].want);
        assert_int_equal(e.code, ERR_INPUT);
    }
    err e = {0};
    json_file f;
    assert_refused(json_file_parse("{\0}", 3, "x.json", &f, &e), ERR_INPUT);
    assert_refused(json_file_read("/no/such/file.json", &f, &e), ERR_INPUT);
    assert_refused(json_file_read("/", &f, &e), ERR_INPUT);
    assert_refused(json_file_read("/dev/zero", &f, &e), ERR_INPUT);
}

static void reads_a_byte_order_mark(void **state)
{
    (void)state;
    err e = {0};
    json_file f;
    assert_ok(json_file_parse("\xEF\xBB\xBF{\n\"a\": 1}", 12, "x.json", &f, &e));
    assert_int_equal(json_file_line(&f, "/a"), 2);
    json_file_free(&f);
}

static void what_is_written_is_read_back_to_the_last_bit(void **state)
{
    (void)state;
    err e = {0};
    double want[3] = {1.0 / 3, -1e-300, 6.02214076e23};
    json_t *root = json_pack("{s:[f,f,f], s:s}", "b", want[0], want[1], want[2], "a", "after b");
    char path[64];
    snprintf(path, sizeof path, "written-%ld.json", (long)getpid());
    assert_ok(json_file_write(root, path, &e));
    json_decref(root);
    json_file f;
    assert_ok(json_file_read(path, &f, &e));
    double got[3];
    assert_ok(json_file_vec3(&f, json_object_get(f.root, "b"), "/b", got, &e));
    for (int i = 0; i < 3; i++) assert_near(got[i], want[i], 0);
    assert_non_null(strstr(strstr(f.text, "\"b\""), "\"a\""));
    json_file_free(&f);
    unlink(path);
}

static void writing_where_nothing_can_be_written_is_refused(void **state)
{
    (void)state;
    err e = {0};
    json_t *root = json_object();
    assert_refused(json_file_write(root, "/no/such/folder/x.json", &e), ERR_RESOURCE);
    assert_refused(json_file_write(root, "/proc/x.json", &e), ERR_RESOURCE);
    json_decref(root);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_value_has_its_line),
        cmocka_unit_test(a_missing_value_has_the_line_of_what_would_hold_it),
        cmocka_unit_test(a_refusal_names_file_line_and_field),
        cmocka_unit_test(three_numbers_are_read_and_nothing_else),
        cmocka_unit_test(refuses_what_is_not_json),
        cmocka_unit_test(reads_a_byte_order_mark),
        cmocka_unit_test(what_is_written_is_read_back_to_the_last_bit),
        cmocka_unit_test(writing_where_nothing_can_be_written_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
