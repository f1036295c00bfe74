/* A prepared case of one tetrahedron; then each of its numbers spoilt. */
#include "tests/check.h"
#include "tests/unit/bodies.h"
#include "app/planner/patient/prepared_sound.h"
#include "geometry/mem.h"

static const head_frame upright = {.left = {1, 0, 0}, .posterior = {0, 1, 0}, .up = {0, 0, 1}};

static prepared small(void)
{
    static const double corner[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    prepared p = {.frame = upright, .skin = body_box(0, 0, 0, 1, 1, 1), .report = json_object()};
    p.segments.part[SEGMENT_CRANIUM] = body_box(0, 0, 0, 1, 1, 1);
    landmarks_set(&p.points, "N", corner);
    landmarks_set(&p.points, "S", corner);
    tissue *t = &p.tissue;
    t->mesh = tetmesh_new(4, 1);
    memcpy(t->mesh.xyz, corner, sizeof corner);
    for (int i = 0; i < 4; i++) t->mesh.tet[i] = i;
    t->mesh.region[0] = REGION_UPPER;
    t->attach = attach_map_new(4, 1);
    for (int i = 0; i < 4; i++) t->attach.segment[i] = -1;
    t->attach.kind[0] = NODE_TIED;
    t->attach.segment[0] = SEGMENT_CRANIUM;
    t->attach.pair[0] = 2;
    t->attach.pair[1] = 3;
    t->side = NEW_ARRAY(uint8_t, 4);
    t->lips.frame = upright;
    p.fields.part[SEGMENT_CRANIUM] = (distance_samples){
        .count = 2, .block = NEW_ARRAY(int32_t, 2), .centre = NEW_ARRAY(float, 2), .value = NEW_ARRAY(float, 128)};
    p.fields.part[SEGMENT_CRANIUM].block[1] = 3;
    p.skin_on_tissue = (embedding){.point_count = 8, .tet = NEW_ARRAY(int32_t, 8), .weight = NEW_ARRAY(double, 32)};
    return p;
}

/* With one number changed the case is refused; with the old one it is sound again. */
#define SPOILT(place, bad)                                                                                             \
    do {                                                                                                               \
        __typeof__(place) kept_ = (place);                                                                             \
        (place) = (__typeof__(place))(bad);                                                                            \
        if (prepared_is_sound(&p)) fail_msg("%s = %s is taken", #place, #bad);                                         \
        (place) = kept_;                                                                                               \
        assert_true(prepared_is_sound(&p));                                                                            \
    } while (0)

static void every_number_is_looked_at(void **state)
{
    (void)state;
    prepared p = small();
    assert_true(prepared_is_sound(&p));
    SPOILT(p.skin.tri[5], 8);
    SPOILT(p.skin.tri[5], -1);
    SPOILT(p.skin.xyz[7], NAN);
    SPOILT(p.skin.triangle_count, 0);
    SPOILT(p.segments.part[SEGMENT_CRANIUM].tri[35], 1 << 30);
    SPOILT(p.points.count, 0);
    SPOILT(p.points.point[1].label[0], 'N');
    SPOILT(p.points.point[0].xyz[2], INFINITY);
    SPOILT(p.frame.up[2], 2);
    SPOILT(p.frame.left[1], NAN);
    SPOILT(p.tissue.mesh.tet[3], 4);
    SPOILT(p.tissue.mesh.region[0], 0);
    SPOILT(p.tissue.mesh.region[0], 77);
    SPOILT(p.tissue.side[3], SIDE_CUT + 1);
    SPOILT(p.tissue.attach.kind[1], NODE_SLIDING + 1);
    SPOILT(p.tissue.attach.kind[1], NODE_TIED); /* on no bone */
    SPOILT(p.tissue.attach.segment[0], SEGMENT_COUNT);
    SPOILT(p.tissue.attach.segment[0], SEGMENT_CHIN); /* which the case has not */
    SPOILT(p.tissue.attach.segment[3], -2);
    SPOILT(p.tissue.attach.normal[11], NAN);
    SPOILT(p.tissue.attach.node_count, 3);
    SPOILT(p.tissue.attach.pair[1], 4);
    SPOILT(p.tissue.attach.pair[1], 2);
    SPOILT(p.tissue.attach.pair_normal[2], INFINITY);
    SPOILT(p.tissue.lips.x[1], NAN);
    SPOILT(p.tissue.lips.frame.up[0], 1);
    SPOILT(p.fields.part[SEGMENT_CRANIUM].block[0], -1);
    SPOILT(p.fields.part[SEGMENT_CRANIUM].block[0], 3); /* the next one's */
    SPOILT(p.fields.part[SEGMENT_CRANIUM].block[1], 1 << 30);
    SPOILT(p.fields.part[SEGMENT_CRANIUM].centre[1], NAN);
    SPOILT(p.fields.part[SEGMENT_CRANIUM].value[127], INFINITY);
    SPOILT(p.fields.part[SEGMENT_CHIN].count, 1); /* of a bone that the case has not */
    SPOILT(p.skin_on_tissue.tet[7], 1);
    SPOILT(p.skin_on_tissue.tet[7], -2);
    SPOILT(p.skin_on_tissue.weight[31], NAN);
    SPOILT(p.skin_on_tissue.point_count, 7);
    char label[LANDMARK_LABEL_SIZE];
    memcpy(label, p.points.point[0].label, sizeof label);
    memset(p.points.point[0].label, 'x', sizeof label); /* which does not end */
    assert_false(prepared_is_sound(&p));
    memcpy(p.points.point[0].label, label, sizeof label);
    p.skin_on_tissue.tet[0] = -1; /* not carried: in order */
    assert_true(prepared_is_sound(&p));
    prepared_free(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_number_is_looked_at)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
