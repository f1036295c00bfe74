/* Lips that press each other, and part. */
#include "tests/check.h"
#include "sim/src/contact/contact_state.h"
#include "tests/physics/touching.h"

static void lips_press_each_other_and_part(void **state)
{
    (void)state;
    touching s;
    two_lips(&s);
    s.body.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){3, 0, -2});
    equilibrium q = solve_touching(&s, "lips pressed and shifted");
    assert_true(q.contact.depth_mm > 0 && q.contact.depth_mm < 0.1);
    assert_near(q.segment_force_mn[SEGMENT_MAXILLA][2], -q.segment_force_mn[SEGMENT_DISTAL][2],
                1e-6 * fabs(q.segment_force_mn[SEGMENT_DISTAL][2]));
    assert_true(q.segment_force_mn[SEGMENT_MAXILLA][2] < -100);
    assert_true(q.contact.lip_area_mm2 > 0.6 * 20 * 16);
    double gap = 0;
    for (int32_t i = 0; i < s.body.attach.pair_count; i++)
        gap += (q.xyz[3 * s.body.attach.pair[2 * i] + 2] - q.xyz[3 * s.body.attach.pair[2 * i + 1] + 2]) /
               s.body.attach.pair_count;
    assert_true(fabs(gap) < 0.3);
    equilibrium_free(&q);
    s.body.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){1, 0, 4});
    q = solve_touching(&s, "lips parted");
    for (int32_t i = 0; i < s.body.attach.pair_count; i++)
        assert_near(q.xyz[3 * s.body.attach.pair[2 * i] + 2] - q.xyz[3 * s.body.attach.pair[2 * i + 1] + 2], 4, 1e-6);
    assert_int_equal(q.contact.active_nodes, 0);
    equilibrium_free(&q);
    touching_free(&s);
}

/* The lower lip's faces end in the middle; beyond them the upper lip sinks in by 9 mm, which is deep where it lay over
 * them at rest. */
static void a_node_beside_a_lip_is_not_dragged_to_its_front(void **state)
{
    (void)state;
    err e = {0};
    contact *c = NULL;
    touching s;
    two_lips(&s);
    const double *rest = s.body.mesh.xyz;
    int32_t faces = 0, n = 3 * s.body.mesh.vertex_count, over = 0, beside = 0;
    for (int32_t f = 0; f < s.setup.lower_count; f++) {
        const int32_t *v = s.lower + 3 * (size_t)f;
        if (fmax(rest[3 * v[0]], fmax(rest[3 * v[1]], rest[3 * v[2]])) > 8) continue;
        memmove(s.lower + 3 * (size_t)faces++, v, 3 * sizeof *v);
    }
    s.setup.lower_count = faces;
    assert_ok(contact_make(&s.body.mesh, &s.body.attach, &s.setup, 15, &c, &e));
    rigid guide = rigid_identity();
    s.body.problem.motion[SEGMENT_MAXILLA] = rigid_translation((double[]){0, 0, -9});
    contact_move(c, s.body.problem.motion, &guide, rest);
    double *x = COPY_ARRAY(double, rest, n);
    for (int32_t i = 0; i < s.body.attach.pair_count; i++) x[3 * s.body.attach.pair[2 * i] + 2] -= 9;
    contact_refresh(c, x);
    contact_energy(c, x, NULL);
    for (int32_t i = 0; i < c->node_count; i++)
        for (int32_t l = c->link_start[i]; l < c->link_start[i + 1]; l++) {
            double aside = rest[3 * (size_t)c->node[i]];
            if (c->link[l].collider != COLLIDER_LOWER || !(c->link[l].delta > 0)) continue;
            over += aside <= 8;
            beside += aside >= 16;
        }
    printf("%d nodes over the lip are pushed out, %d beside it\n", over, beside);
    assert_true(over >= 12); /* of 15; at a corner little of the lip is seen */
    assert_int_equal(beside, 0);
    contact_destroy(&c);
    free(x);
    touching_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lips_press_each_other_and_part),
        cmocka_unit_test(a_node_beside_a_lip_is_not_dragged_to_its_front),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
