/* Meshes that are small, large, or wrong. */
#include "app/stress/stress.h"

#define BLOCK .body = specimen_broken, .cells = {3, 3, 4}, .size = {15, 15, 20}, .move = {1, 2, 3}
#define FLAW(label, text, which, ...)                                                                                  \
    {                                                                                                                  \
        .name = "mesh/" label, .what = text, BLOCK, .flaw = which, __VA_ARGS__                                         \
    }
#define GEOMETRY(text) .want = WANT_REFUSED, .code = ERR_GEOMETRY, .words = text
#define INPUT(text) .want = WANT_REFUSED, .code = ERR_INPUT, .words = text
#define ONE(label, text, nodes, ...)                                                                                   \
    {                                                                                                                  \
        .name = "one_tet/" label, .what = text, .body = specimen_single, .p = nodes, .move = {1, 0, 2}, __VA_ARGS__    \
    }

static const stress_case cases[] = {
    ONE("tied", "a single tet, all nodes tied", 4, .check = CHECK_UPRIGHT),
    ONE("three_tied", "three nodes tied", 3),
    ONE("two_tied", "two: it can turn about their line", 2, GEOMETRY("not held")),
    ONE("one_tied", "one: it can turn about it", 1, GEOMETRY("3 of its 6")),
    ONE("free", "none", 0, GEOMETRY("not held")),
    FLAW("crack", "coincident nodes: two blocks that touch, both held", FLAW_CRACK),
    FLAW("double_node", "one inner node doubled, each copy used by some tets", FLAW_DOUBLE),
    FLAW("island", "a part without attachment", FLAW_ISLAND, GEOMETRY("not held")),
    FLAW("island_one", "a part held by one node: it can turn", FLAW_ISLAND_ONE, GEOMETRY("3 of its 6")),
    FLAW("island_two", "a part held by two nodes", FLAW_ISLAND_TWO, GEOMETRY("1 of its 6")),
    FLAW("hinge", "a part that hangs on one edge", FLAW_HINGE, .want = MAY_GIVE_UP),
    FLAW("point", "a part that hangs on one node", FLAW_POINT, .want = MAY_GIVE_UP),
    FLAW("flat_tet", "a tet of zero volume", FLAW_FLAT, GEOMETRY(NULL)),
    FLAW("turned_tet", "a tet of negative volume", FLAW_TURNED, GEOMETRY(NULL)),
    FLAW("nan", "a coordinate that is not a number", FLAW_NAN, GEOMETRY(NULL)),
    FLAW("infinite", "an infinite coordinate", FLAW_INFINITE, GEOMETRY(NULL)),
    FLAW("index", "a tet of a node that does not exist", FLAW_INDEX, GEOMETRY(NULL)),
    FLAW("loose_node", "a node in no tet", FLAW_LOOSE, GEOMETRY("no tet")),
    FLAW("tet_twice", "one tet listed twice", FLAW_TWICE, .want = MAY_GIVE_UP),
    FLAW("slides_only", "nothing but nodes that slide on one plane", FLAW_SLIDES, GEOMETRY("not held")),
    FLAW("normal", "a sliding normal of length 0.5", FLAW_NORMAL, INPUT("length 1")),
    FLAW("segment", "a node tied to no segment", FLAW_SEGMENT, INPUT("does not exist")),
    FLAW("count", "an attachment map of another mesh", FLAW_COUNT, INPUT("attachment map")),
    FLAW("region", "a region without material", FLAW_REGION, INPUT("material")),
    FLAW("pair", "a node paired with itself", FLAW_PAIR, INPUT("pairs")),
    {.name = "size/100k",
     .what = "a rod of 100 thousand tets",
     .body = specimen_block,
     .cells = {12, 12, 139},
     .size = {24, 24, 278},
     .move = {5, 0, 10},
     .limit_s = 120,
     .heavy = true},
    {.name = "size/1M",
     .what = "a rod of a million tets",
     .body = specimen_block,
     .cells = {12, 12, 1389},
     .size = {24, 24, 2778},
     .move = {5, 0, 10},
     .limit_s = 300,
     .heavy = true},
};
const stress_family stress_meshes = {cases, sizeof cases / sizeof *cases};
