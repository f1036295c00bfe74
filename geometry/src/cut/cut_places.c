#include "geometry/nearest.h"
#include "geometry/src/cut/cut_plan.h"
#include <math.h>

/* The piece that anatomy puts a landmark on. */
static const struct {
    const char *label;
    segment_id want;
} places[] = {{"U1", SEGMENT_MAXILLA},
              {"Pr", SEGMENT_MAXILLA},
              {"U6_crest_L", SEGMENT_MAXILLA},
              {"U6_crest_R", SEGMENT_MAXILLA},
              {"U3_L", SEGMENT_MAXILLA},
              {"U3_R", SEGMENT_MAXILLA},
              {"U6_L", SEGMENT_MAXILLA},
              {"U6_R", SEGMENT_MAXILLA},
              {"A", SEGMENT_MAXILLA},
              {"ANS", SEGMENT_MAXILLA},
              {"PNS", SEGMENT_MAXILLA},
              {"N", SEGMENT_CRANIUM},
              {"Or_L", SEGMENT_CRANIUM},
              {"Or_R", SEGMENT_CRANIUM},
              {"Zy_L", SEGMENT_CRANIUM},
              {"Zy_R", SEGMENT_CRANIUM},
              {"IOF_L", SEGMENT_CRANIUM},
              {"IOF_R", SEGMENT_CRANIUM},
              {"L1", SEGMENT_DISTAL},
              {"Id", SEGMENT_DISTAL},
              {"L6_crest_L", SEGMENT_DISTAL},
              {"L6_crest_R", SEGMENT_DISTAL},
              {"L3_L", SEGMENT_DISTAL},
              {"L3_R", SEGMENT_DISTAL},
              {"L6_L", SEGMENT_DISTAL},
              {"L6_R", SEGMENT_DISTAL},
              {"L7_L", SEGMENT_DISTAL},
              {"L7_R", SEGMENT_DISTAL},
              {"Li_L", SEGMENT_DISTAL},
              {"Li_R", SEGMENT_DISTAL},
              {"MF_L", SEGMENT_DISTAL},
              {"MF_R", SEGMENT_DISTAL},
              {"B", SEGMENT_DISTAL},
              {"Co_L", SEGMENT_PROXIMAL_LEFT},
              {"Cor_L", SEGMENT_PROXIMAL_LEFT},
              {"RP_L", SEGMENT_PROXIMAL_LEFT},
              {"Go_L", SEGMENT_PROXIMAL_LEFT},
              {"SN_L", SEGMENT_PROXIMAL_LEFT},
              {"Co_R", SEGMENT_PROXIMAL_RIGHT},
              {"Cor_R", SEGMENT_PROXIMAL_RIGHT},
              {"RP_R", SEGMENT_PROXIMAL_RIGHT},
              {"Go_R", SEGMENT_PROXIMAL_RIGHT},
              {"SN_R", SEGMENT_PROXIMAL_RIGHT},
              {"Me", SEGMENT_CHIN},
              {"Pog", SEGMENT_CHIN},
              {"Gn", SEGMENT_CHIN}};

bool cut_places_check(const osteotomy_input *in, const segments *s, cut_report *r, err *e)
{
    nearest *tree[SEGMENT_COUNT] = {0};
    bool ok = true;
    for (int i = 0; i < SEGMENT_COUNT && ok; i++)
        if (s->part[i].triangle_count) ok = nearest_create(s->part + i, tree + i, e);
    for (size_t k = 0; k < sizeof places / sizeof *places && ok; k++) {
        const landmark *l = landmarks_find(in->points, places[k].label);
        if (!l || !tree[places[k].want]) continue;
        int best = -1;
        double least = HUGE_VAL;
        for (int i = 0; i < SEGMENT_COUNT; i++) {
            double d = tree[i] ? nearest_point(tree[i], l->xyz, NULL, NULL) : HUGE_VAL;
            if (d < least) {
                least = d;
                best = i;
            }
        }
        if (best != (int)places[k].want)
            report_warning(r, "%s lies on the %s segment, not on the %s", places[k].label, segment_name(best),
                           segment_name(places[k].want));
    }
    for (int i = 0; i < SEGMENT_COUNT; i++) nearest_destroy(tree + i);
    return ok;
}
