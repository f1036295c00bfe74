/* Reading cases; each refusal with its message is under tests/cli. */
#include "tests/check.h"
#include "app/planner/patient/case_guess.h"
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[64];

static void put(const char *name, const char *text)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
}

static int make_folder(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "case-%ld", (long)getpid());
    if (mkdir(folder, 0777)) return 1;
    const char *const files[] = {"skin.ply", "skull.ply", "mandible.ply", "points.mrk.json"};
    for (int i = 0; i < 4; i++) put(files[i], "x");
    return 0;
}

static int drop_folder(void **state)
{
    (void)state;
    char line[128];
    snprintf(line, sizeof line, "rm -r %s", folder);
    return system(line);
}

#define NEEDED                                                                                                         \
    "\"gnathos\": 1, \"surfaces\": {\"skin\": \"skin.ply\", \"skull\": \"skull.ply\", \"mandible\": "                  \
    "\"mandible.ply\"}, \"landmarks\": \"points.mrk.json\""

static void absent_fields_take_the_defaults_of_their_stage(void **state)
{
    (void)state;
    err e = {0};
    case_file c;
    put("case.json", "{" NEEDED "}");
    assert_ok(case_file_load(folder, &c, &e));
    tissue_params t = tissue_params_default();
    osteotomy_params o = osteotomy_params_default();
    assert_memory_equal(&c.tissue, &t, sizeof t);
    assert_memory_equal(&c.cuts, &o, sizeof o);
    assert_string_equal(c.name, folder);
    assert_int_equal(c.frame, CASE_LPS);
    assert_int_equal(c.osteotomy_count, 3);
    assert_string_equal(c.surface[CASE_UPPER_TEETH], "");
    char want[128];
    snprintf(want, sizeof want, "%s/skull.ply", folder);
    assert_string_equal(c.surface[CASE_SKULL], want);
    for (int i = 0; i < LIMIT_COUNT; i++) {
        assert_memory_equal(&c.limits[i], &limit_default[i].range, sizeof c.limits[i]);
        assert_false(c.limit_from_case[i]);
    }
}

static void every_default_is_within_its_own_range(void **state)
{
    (void)state;
    const field_table *t = case_fields();
    int numbers = 0;
    for (int i = 0; i < t->count; i++) {
        const field *r = &t->row[i];
        if (r->kind != FIELD_NUMBER) continue;
        double v;
        memcpy(&v, (const char *)t->defaults + r->offset, sizeof v);
        if (!(v >= r->low && v <= r->high)) print_error("%s: %g\n", r->name, v);
        assert_true(v >= r->low && v <= r->high);
        numbers++;
    }
    assert_true(numbers > 20);
}

static void given_fields_arrive_where_they_belong(void **state)
{
    (void)state;
    err e = {0};
    case_file c;
    put("case.json",
        "{" NEEDED ", \"name\": \"A B\", \"frame\": \"RAS\", \"//\": [1], \"osteotomies\": [\"bsso\"],\n"
        "\"tissue\": {\"// why\": \"thin\", \"element_mm\": 2.5, \"poisson\": 0.3}, \"cuts\": {\"kerf_mm\": "
        "1},\n"
        "\"limits\": {\"chin_advance_mm\": {\"stop\": [-1, 2]}}}");
    char path[128];
    snprintf(path, sizeof path, "%s/case.json", folder);
    assert_ok(case_file_load(path, &c, &e));
    assert_string_equal(c.name, "A B");
    assert_string_equal(c.folder, folder);
    assert_int_equal(case_file_space(&c), MESH_SPACE_RAS);
    assert_near(c.tissue.element_mm, 2.5, 0);
    assert_near(c.material.poisson, 0.3, 0);
    assert_near(c.cuts.kerf_mm, 1, 0);
    assert_near(c.limits[LIMIT_CHIN_ADVANCE].stop[0], -1, 0);
    assert_near(c.limits[LIMIT_CHIN_ADVANCE].stop[1], 2, 0);
    assert_true(c.limit_from_case[LIMIT_CHIN_ADVANCE]);
    assert_false(c.limit_from_case[LIMIT_CHIN_LIFT]);
    assert_true(case_file_frees(&c, SEGMENT_DISTAL));
    assert_true(case_file_frees(&c, SEGMENT_PROXIMAL_LEFT));
    assert_false(case_file_frees(&c, SEGMENT_MAXILLA));
    assert_false(case_file_frees(&c, SEGMENT_CHIN));
}

static void null_is_an_open_end_and_every_number_is_a_limit(void **state)
{
    (void)state;
    err e = {0};
    case_file c;
    char words[LIMIT_WORDS_SIZE];
    put("case.json", "{" NEEDED ", \"limits\": {\"trim_volume_mm3\": {\"fine\": [0, 200], \"stop\": [0, 1000]},\n"
                     "\"chin_advance_mm\": {\"stop\": [null, 2]}, \"chin_lift_mm\": {\"stop\": [null, null]}}}");
    assert_ok(case_file_load(folder, &c, &e));
    const limit_range *trim = &c.limits[LIMIT_TRIM_VOLUME], *advance = &c.limits[LIMIT_CHIN_ADVANCE],
                      *lift = &c.limits[LIMIT_CHIN_LIFT];
    assert_int_equal(limit_judge(trim, 999), LIMIT_CAUTION);
    assert_int_equal(limit_judge(trim, 1001), LIMIT_STOP);
    assert_near(limit_margin(trim, 1001), -1, 0);
    assert_string_equal(limit_range_words(trim->stop, words), "0 to 1000");
    assert_int_equal(limit_judge(advance, -1e9), LIMIT_CAUTION);
    assert_int_equal(limit_judge(advance, 2.5), LIMIT_STOP);
    assert_string_equal(limit_range_words(advance->stop, words), "at most 2");
    assert_int_equal(limit_judge(lift, 1e9), LIMIT_CAUTION);
    assert_true(isinf(limit_margin(lift, 1e9)));
    assert_string_equal(limit_range_words(lift->stop, words), "-");
}

static void a_plane_of_ones_own_frees_its_segment(void **state)
{
    (void)state;
    err e = {0};
    case_file c;
    put("planes.mrk.json", "{}");
    put("case.json", "{" NEEDED ", \"planes\": \"planes.mrk.json\","
                     "\"osteotomies\": [{\"segment\": \"maxilla\", \"plane\": \"mine\"}]}");
    assert_ok(case_file_load(folder, &c, &e));
    assert_int_equal(c.osteotomy_count, 1);
    assert_int_equal(c.osteotomy[0].cut, CUT_USER);
    assert_int_equal(c.osteotomy[0].segment, SEGMENT_MAXILLA);
    assert_string_equal(c.osteotomy[0].plane, "mine");
    assert_true(case_file_frees(&c, SEGMENT_MAXILLA));
    assert_false(case_file_frees(&c, SEGMENT_DISTAL));
}

static void everything_wrong_is_named_by_line(void **state)
{
    (void)state;
    issue_list issues = {0};
    case_file c;
    err e = {0};
    put("case.json",
        "{" NEEDED
        ",\n\"limits\": {\"chin_lift_mm\": {\"fine\": [5, -5]}},\n\"tissue\": {\"poisson\": 1},\n\"frame\": 3}");
    assert_false(case_file_read(folder, &c, &issues));
    assert_int_equal(issue_count(&issues, ISSUE_ERROR), 3);
    for (int i = 0; i < 3; i++) assert_int_equal(issues.item[i].line, i + 2);
    assert_false(issue_none_is_error(&issues, &e));
    assert_non_null(strstr(e.text, "case.json:2: limits.chin_lift_mm.fine: "));
    assert_near(c.material.poisson, 0.45, 0); /* a wrong field keeps its default */
    issue_list_free(&issues);
}

static void a_refused_case_leaves_the_output_alone(void **state)
{
    (void)state;
    err e = {0};
    case_file c = {.name = "old"};
    put("case.json", "{\"gnathos\": 1}");
    assert_refused(case_file_load(folder, &c, &e), ERR_INPUT);
    assert_string_equal(c.name, "old");
}

static void a_bare_case_needs_no_landmarks_but_reads_all_else(void **state)
{
    (void)state;
    static const char start[] = "{\"gnathos\": 1, \"surfaces\": {\"skin\": \"skin.ply\", \"skull\": \"skull.ply\", "
                                "\"mandible\": \"mandible.ply\"}";
    static const char *const absent[] = {"}", ", \"landmarks\": \"not_placed.mrk.json\"}"};
    for (int i = 0; i < 2; i++) {
        char text[256];
        err e = {0}, strict = {0};
        case_file c = {.name = "old"};
        snprintf(text, sizeof text, "%s%s", start, absent[i]);
        put("case.json", text);
        assert_false(case_file_load(folder, &c, &strict));
        assert_int_equal(strict.code, ERR_INPUT);
        assert_non_null(strstr(strict.text, "`gnathos landmarks`"));
        assert_ok(case_file_load_bare(folder, &c, &e));
        assert_string_equal(c.landmarks, "");
    }
    err e = {0};
    case_file c;
    put("case.json", "{" NEEDED "}");
    assert_ok(case_file_load_bare(folder, &c, &e));
    assert_true(*c.landmarks);
    put("case.json", "{\"gnathos\": 1, \"landmarks\": 3}");
    assert_refused(case_file_load_bare(folder, &c, &e), ERR_INPUT);
}

static void a_case_of_skin_alone_needs_no_bones(void **state)
{
    (void)state;
    err e = {0}, strict = {0};
    case_file c;
    put("case.json", "{\"gnathos\": 1, \"surfaces\": {\"skin\": \"skin.ply\"}}");
    assert_ok(case_file_load_skin(folder, &c, &e));
    assert_true(*c.surface[CASE_SKIN] && !*c.surface[CASE_SKULL] && !*c.surface[CASE_MANDIBLE] && !*c.landmarks);
    assert_false(case_file_load_bare(folder, &c, &strict));
    assert_non_null(strstr(strict.text, "surfaces.skull"));
    put("case.json", "{\"gnathos\": 1, \"surfaces\": {\"skull\": \"skull.ply\"}}");
    assert_refused(case_file_load_skin(folder, &c, &e), ERR_INPUT);
}

static void what_is_guessed_comes_back_as_it_was_written(void **state)
{
    (void)state;
    err e = {0};
    char text[200];
    case_file c;
    put("case.json", "{" NEEDED ", \"guessed\": {\"skin\": 0.04, \"upper_teeth\": 1, \"jaw_turned_deg\": 5.25, "
                     "\"landmarks\": [\"U1\", \"Me\"]}}");
    assert_ok(case_file_load(folder, &c, &e));
    assert_true(c.guessed.share[CASE_SKIN] == 0.04 && c.guessed.share[CASE_SKULL] == 0 &&
                case_guess_is_any(&c.guessed));
    assert_int_equal(c.guessed.point_count, 2);
    assert_string_equal(c.guessed.point[1], "Me");
    assert_string_equal(case_guess_text(&c.guessed, text, sizeof text),
                        "upper_teeth 100 %, 2 landmarks, the bite (mandible turned up by 5.2 deg)");
    json_t *again = case_guess_json(&c.guessed);
    assert_int_equal(json_array_size(json_object_get(again, "landmarks")), 2);
    assert_near(json_number_value(json_object_get(again, "jaw_turned_deg")), 5.25, 0);
    json_decref(again);
    put("case.json", "{" NEEDED "}");
    assert_ok(case_file_load(folder, &c, &e));
    assert_false(case_guess_is_any(&c.guessed));
    assert_string_equal(case_guess_text(&c.guessed, text, sizeof text), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(absent_fields_take_the_defaults_of_their_stage),
        cmocka_unit_test(a_case_of_skin_alone_needs_no_bones),
        cmocka_unit_test(what_is_guessed_comes_back_as_it_was_written),
        cmocka_unit_test(every_default_is_within_its_own_range),
        cmocka_unit_test(given_fields_arrive_where_they_belong),
        cmocka_unit_test(null_is_an_open_end_and_every_number_is_a_limit),
        cmocka_unit_test(a_plane_of_ones_own_frees_its_segment),
        cmocka_unit_test(everything_wrong_is_named_by_line),
        cmocka_unit_test(a_refused_case_leaves_the_output_alone),
        cmocka_unit_test(a_bare_case_needs_no_landmarks_but_reads_all_else),
    };
    return cmocka_run_group_tests(tests, make_folder, drop_folder);
}
