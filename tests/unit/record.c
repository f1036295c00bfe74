#include "tests/check.h"
#include "app/planner/store/record.h"
#include <math.h>
#include <string.h>

typedef struct joint {
    const char *name;
    double angle_deg;
} joint;

typedef struct robot {
    char name[16];
    double mass_kg, place[3];
    int wheels;
    int64_t steps;
    bool runs;
    enum { SLOW, FAST } gait;
    const char *note;
    const joint *arm; /* or NULL */
    joint joint[2];
    int joints;
} robot;

static const record_row joint_row[] = {ROW(joint, name, "name", NULL, "which one"),
                                       ROW(joint, angle_deg, "angle_deg", "degrees", "how far it is bent")};
static const record_table joint_table = {.title = "a joint", RECORD_ROWS(joint_row)};

static double twice(const void *of) { return 2 * ((const robot *)of)->mass_kg; }
static bool has_wheels(const void *of) { return ((const robot *)of)->wheels > 0; }

static const void *next_joint(const void *of, int *i, const char **key, void *space)
{
    const robot *r = of;
    (void)space;
    while (*i < r->joints && !r->joint[*i].name) ++*i;
    if (*i >= r->joints) return NULL;
    *key = r->joint[*i].name;
    return &r->joint[*i];
}

static const record_row robot_row[] = {
    ROW(robot, name, "name", NULL, "what it is called"),
    ROW(robot, mass_kg, "body.mass_kg", "kg", "what it weighs"),
    ROW_FOUND(NUMBER, twice, "body.twice_kg", "kg", "twice that"),
    ROW(robot, place, "place", "mm", "where it stands"),
    ROW_WHEN(has_wheels, robot, wheels, "wheels", NULL, "how many it has"),
    ROW(robot, steps, "steps", NULL, "it went so far"),
    ROW(robot, runs, "runs", NULL, "it does"),
    {RECORD_AT(robot, gait), .name = "gait", .words = "slow|very fast", .help = "how it goes"},
    {RECORD_AT(robot, note), .name = "note", .optional = true, .help = "what else"},
    {.kind = RECORD_OBJECT,
     .offset = offsetof(robot, arm),
     .pointer = true,
     .table = &joint_table,
     .name = "arm",
     .or_null = true,
     .help = "its arm"},
    {.kind = RECORD_LIST,
     .next = next_joint,
     .item = RECORD_OBJECT,
     .table = &joint_table,
     .name = "joints",
     .help = "all of them"},
    {.kind = RECORD_MAP,
     .next = next_joint,
     .item = RECORD_OBJECT,
     .table = &joint_table,
     .name = "by_name",
     .key = "joint",
     .help = "the same"}};
static const record_table robot_table = {.kind = "robot", .title = "a robot", RECORD_ROWS(robot_row)};

static robot some(void)
{
    return (robot){.name = "R2",
                   .mass_kg = 3,
                   .place = {1, (double)NAN, 2},
                   .wheels = 3,
                   .steps = 5000000000,
                   .runs = true,
                   .gait = FAST,
                   .joint = {{NULL, 0}, {"knee", HUGE_VAL}},
                   .joints = 2};
}

static void assert_json(json_t *got, const char *want)
{
    char *text = json_dumps(got, JSON_COMPACT);
    assert_string_equal(text, want);
    free(text);
    json_decref(got);
}

static void writes_the_fields_in_the_order_of_the_rows(void **state)
{
    (void)state;
    robot r = some();
    joint arm = {"elbow", 30};
    json_t *o = record_json(&robot_table, &r);
    assert_string_equal(record_kind_of(o), "robot");
    assert_string_equal(json_string_value(json_object_get(o, "version")), GNATHOS_VERSION);
    json_object_del(o, "version");
    assert_json(o, "{\"gnathos\":1,\"kind\":\"robot\",\"name\":\"R2\",\"body\":{\"mass_kg\":3.0,\"twice_kg\":6.0},"
                   "\"place\":[1.0,null,2.0],\"wheels\":3,\"steps\":5000000000,\"runs\":true,\"gait\":\"very fast\","
                   "\"arm\":null,\"joints\":[{\"name\":\"knee\",\"angle_deg\":null}],"
                   "\"by_name\":{\"knee\":{\"name\":\"knee\",\"angle_deg\":null}}}");
    r = (robot){.note = "none", .mass_kg = (double)NAN, .arm = &arm};
    assert_json(record_part(&robot_table, &r),
                "{\"name\":\"\",\"body\":{\"mass_kg\":null,\"twice_kg\":null},\"place\":[0.0,0.0,0.0],\"steps\":0,"
                "\"runs\":false,\"gait\":\"slow\",\"note\":\"none\",\"arm\":{\"name\":\"elbow\",\"angle_deg\":30.0},"
                "\"joints\":[],\"by_name\":{}}");
}

static const char *at(const json_t *o, const char *path)
{
    static char text[512];
    char part[64];
    for (; *path; path += *path == '/') {
        size_t n = strcspn(path, "/");
        snprintf(part, sizeof part, "%.*s", (int)n, path);
        o = json_object_get(o, part);
        path += n;
    }
    char *all = json_dumps(o, JSON_COMPACT | JSON_ENCODE_ANY);
    snprintf(text, sizeof text, "%s", all ? all : "nothing");
    free(all);
    return text;
}

static void the_schema_names_every_field(void **state)
{
    (void)state;
    json_t *s = record_schema(&robot_table);
    assert_string_equal(at(s, "$schema"), "\"https://json-schema.org/draft/2020-12/schema\"");
    assert_string_equal(at(s, "additionalProperties"), "false");
    assert_string_equal(at(s, "required"), "[\"gnathos\",\"kind\",\"version\",\"name\",\"body\",\"place\",\"steps\","
                                           "\"runs\",\"gait\",\"arm\",\"joints\",\"by_name\"]");
    assert_string_equal(at(s, "properties/kind/const"), "\"robot\"");
    assert_string_equal(at(s, "properties/body/additionalProperties"), "false");
    assert_string_equal(at(s, "properties/body/required"), "[\"mass_kg\",\"twice_kg\"]");
    assert_string_equal(at(s, "properties/body/properties/mass_kg/type"), "[\"number\",\"null\"]");
    assert_string_equal(at(s, "properties/body/properties/mass_kg/description"), "\"what it weighs, kg\"");
    assert_string_equal(at(s, "properties/place/maxItems"), "3");
    assert_string_equal(at(s, "properties/wheels/type"), "\"integer\"");
    assert_string_equal(at(s, "properties/gait/enum"), "[\"slow\",\"very fast\"]");
    assert_string_equal(at(s, "properties/arm/type"), "[\"object\",\"null\"]");
    assert_string_equal(at(s, "properties/joints/items/properties/name/type"), "\"string\"");
    assert_string_equal(at(s, "properties/by_name/additionalProperties/required"), "[\"name\",\"angle_deg\"]");
    json_decref(s);
}

/* What record_check says of a file with this text; "" where it is right. */
static const char *said(const char *text)
{
    static err e;
    json_file f;
    e = (err){0};
    assert_true(json_file_parse(text, strlen(text), "a.json", &f, &e));
    bool right = record_check(&f, "robot", &e);
    json_file_free(&f);
    assert_int_equal(right, e.code == 0);
    return e.text;
}

static void refuses_other_kinds_and_formats(void **state)
{
    (void)state;
    assert_string_equal(said("{\"gnathos\": 1, \"kind\": \"robot\", \"version\": \"0\"}"), "");
    assert_non_null(
        strstr(said("{\"gnathos\": 1,\n\"kind\": \"check\"}"), "a.json:2: kind: is \"check\"; must be \"robot\""));
    assert_non_null(strstr(said("{\"gnathos\": 2, \"kind\": \"robot\"}"), "version 2 is not known"));
    assert_non_null(strstr(said("{\"gnathos\": 2}"), "version 2 is not known"));
    assert_non_null(strstr(said("{\"gnathos\": 0, \"kind\": \"robot\"}"), "gnathos: is 0; must be 1"));
    assert_non_null(strstr(said("{\"gnathos\": 1, \"case\": \"a\"}"), "lacks \"gnathos\" or \"kind\""));
    assert_non_null(strstr(said("{\"schema\": \"gnathos.robot.1\"}"), "make it again"));
    assert_non_null(strstr(said("[]"), "lacks"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(writes_the_fields_in_the_order_of_the_rows),
                                       cmocka_unit_test(the_schema_names_every_field),
                                       cmocka_unit_test(refuses_other_kinds_and_formats)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
