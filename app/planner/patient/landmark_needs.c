#include "app/planner/patient/landmark_needs.h"
#include <string.h>

/* A landmark of the left and the same of the right, in two rows that follow each other. */
#define BOTH(label_, need_, on_, help_, lost_)                                                                         \
    {label_ "_L", need_, NULL, on_, help_, lost_}, { label_ "_R", need_, NULL, on_, help_, lost_ }

const landmark_row landmark_rows[] = {
    {"Po_L", NEED_ALWAYS, NULL, CASE_SKULL, "porion, roof of the ear canal", NULL},
    {"Po_R", NEED_ALWAYS, NULL, CASE_SKULL, "porion, roof of the ear canal", NULL},
    {"Or_L", NEED_ALWAYS, "Or_R", CASE_SKULL, "orbitale, lowest point of the orbit's rim", NULL},
    {"Or_R", NEED_ALWAYS, "Or_L", CASE_SKULL, "orbitale, lowest point of the orbit's rim", NULL},
    {"N", NEED_ALWAYS, NULL, CASE_SKULL, "nasion", NULL},
    {"Me", NEED_ALWAYS, NULL, CASE_MANDIBLE, "menton, lowest point of the chin's bone", NULL},
    {"U1", NEED_ALWAYS, "Pr", CASE_UPPER_TEETH, "edge of the upper central incisors", NULL},
    {"L1", NEED_ALWAYS, "Id", CASE_LOWER_TEETH, "edge of the lower central incisors", NULL},
    {"Pr", NEED_OPTIONAL, NULL, CASE_SKULL,
     "prosthion, lowest point of the alveolar process between the upper central incisors, where these are missing",
     NULL},
    {"Id", NEED_OPTIONAL, NULL, CASE_MANDIBLE,
     "infradentale, highest point of the alveolar process between the lower central incisors, where these are missing",
     NULL},
    {"Pn", NEED_ALWAYS, NULL, CASE_SKIN, "pronasale, tip of the nose", NULL},
    {"Ls", NEED_ALWAYS, NULL, CASE_SKIN, "labrale superius, front of the upper lip", NULL},
    BOTH("Ch", NEED_ALWAYS, CASE_SKIN, "cheilion, corner of the mouth", NULL),
    {"Stm", NEED_ALWAYS, "Stms Stmi", CASE_SKIN, "stomion, middle of the lip line of a closed mouth", NULL},
    {"Stms", NEED_OPTIONAL, "Stm", CASE_SKIN, "lowest point of the upper lip of an open mouth",
     "the gap between the lips"},
    {"Stmi", NEED_OPTIONAL, "Stm", CASE_SKIN, "highest point of the lower lip of an open mouth",
     "the gap between the lips"},
    BOTH("PR", NEED_LE_FORT_1, CASE_SKULL, "rim of the nose's opening just above its floor", NULL),
    BOTH("ZB", NEED_LE_FORT_1, CASE_SKULL, "buttress below the cheekbone", NULL),
    BOTH("PM", NEED_LE_FORT_1, CASE_SKULL, "groove between maxilla and pterygoid", NULL),
    {"U6_L", NEED_LE_FORT_1, "U7_L or U5_L or U4_L or U6_crest_L", CASE_UPPER_TEETH,
     "mesiobuccal cusp of the upper first molar", NULL},
    {"U6_R", NEED_LE_FORT_1, "U7_R or U5_R or U4_R or U6_crest_R", CASE_UPPER_TEETH,
     "mesiobuccal cusp of the upper first molar", NULL},
    {"L6_L", NEED_BSSO | NEED_GENIOPLASTY, "L5_L or L4_L or L6_crest_L", CASE_LOWER_TEETH,
     "mesiobuccal cusp of the lower first molar", NULL},
    {"L6_R", NEED_BSSO | NEED_GENIOPLASTY, "L5_R or L4_R or L6_crest_R", CASE_LOWER_TEETH,
     "mesiobuccal cusp of the lower first molar", NULL},
    BOTH("U7", NEED_OPTIONAL, CASE_UPPER_TEETH,
         "mesiobuccal cusp of the upper second molar, where the first is missing", NULL),
    BOTH("U5", NEED_OPTIONAL, CASE_UPPER_TEETH,
         "buccal cusp of the upper second premolar, where the first molar is missing", NULL),
    BOTH("U4", NEED_OPTIONAL, CASE_UPPER_TEETH,
         "buccal cusp of the upper first premolar, where the first molar is missing", NULL),
    BOTH("L5", NEED_OPTIONAL, CASE_LOWER_TEETH,
         "buccal cusp of the lower second premolar, where the first molar is missing", NULL),
    BOTH("L4", NEED_OPTIONAL, CASE_LOWER_TEETH,
         "buccal cusp of the lower first premolar, where the first molar is missing", NULL),
    BOTH("U6_crest", NEED_OPTIONAL, CASE_SKULL,
         "crest of the alveolar process where the upper first molar was, in a jaw without molars and premolars", NULL),
    BOTH("L6_crest", NEED_OPTIONAL, CASE_MANDIBLE,
         "crest of the alveolar process where the lower first molar was, in a jaw without molars and premolars", NULL),
    BOTH("U3", NEED_OPTIONAL, CASE_UPPER_TEETH, "cusp of the upper canine",
         "the height of the upper roots is estimated"),
    BOTH("L3", NEED_OPTIONAL, CASE_LOWER_TEETH, "cusp of the lower canine",
         "the height of the lower roots is estimated"),
    BOTH("Co", NEED_OPTIONAL, CASE_MANDIBLE, "condylion, top of the condyle", "the shift of the condyle"),
    BOTH("Go", NEED_BSSO | NEED_GENIOPLASTY, CASE_MANDIBLE, "gonion, the jaw's angle", NULL),
    BOTH("RA", NEED_BSSO, CASE_MANDIBLE, "front border of the ramus at the height of the teeth", NULL),
    BOTH("RP", NEED_BSSO, CASE_MANDIBLE, "rear border of the ramus at the height of the teeth", NULL),
    BOTH("L7", NEED_BSSO, CASE_MANDIBLE, "rear corner of the last lower molar, or end of the crest without one", NULL),
    BOTH("Li", NEED_OPTIONAL, CASE_MANDIBLE, "lingula", "its place is estimated from the ramus"),
    BOTH("SN", NEED_BSSO, CASE_MANDIBLE, "lowest point of the notch of the ramus", NULL),
    BOTH("Cor", NEED_OPTIONAL, CASE_MANDIBLE, "tip of the coronoid process", "a check of the sagittal split"),
    BOTH("MF", NEED_GENIOPLASTY, CASE_MANDIBLE, "mental foramen", NULL),
    {"Pog", NEED_OPTIONAL, NULL, CASE_MANDIBLE, "pogonion, front of the chin's bone", "measures of the chin"},
    {"Gn", NEED_OPTIONAL, NULL, CASE_MANDIBLE, "gnathion", "measures of the bone's profile"},
    {"A", NEED_OPTIONAL, NULL, CASE_SKULL, "A point", "SNA and other measures of the bone's profile"},
    {"B", NEED_OPTIONAL, NULL, CASE_MANDIBLE, "B point", "SNB and other measures of the bone's profile"},
    {"S", NEED_OPTIONAL, NULL, CASE_SURFACE_COUNT, "sella", "SNA and SNB"},
    {"Ba", NEED_OPTIONAL, NULL, CASE_SKULL, "basion", "measures of the skull's base"},
    {"ANS", NEED_LE_FORT_1, NULL, CASE_SKULL, "anterior nasal spine", NULL},
    {"PNS", NEED_LE_FORT_1, NULL, CASE_SKULL, "posterior nasal spine", NULL},
    {"U1_apex", NEED_OPTIONAL, NULL, CASE_SURFACE_COUNT, "root tip of the upper incisors", "the incisors' inclination"},
    {"L1_apex", NEED_OPTIONAL, NULL, CASE_SURFACE_COUNT, "root tip of the lower incisors",
     "the lower incisors' inclination"},
    BOTH("IOF", NEED_OPTIONAL, CASE_SKULL, "infraorbital foramen", "the distance of the Le Fort I cut from the nerve"),
    BOTH("Zy", NEED_OPTIONAL, CASE_SKULL, "zygion, side of the cheekbone's arch", "the width of the face's bone"),
    {"G'", NEED_OPTIONAL, NULL, CASE_SKIN, "soft-tissue glabella", "the angle of facial convexity"},
    {"N'", NEED_OPTIONAL, NULL, CASE_SKIN, "soft-tissue nasion", "soft-tissue heights"},
    {"Sn", NEED_OPTIONAL, NULL, CASE_SKIN, "subnasale", "the nasolabial angle and the lip's length"},
    BOTH("Al", NEED_OPTIONAL, CASE_SKIN, "alare, side of the nose's wing", "the width of the nose"),
    {"A'", NEED_OPTIONAL, NULL, CASE_SKIN, "soft-tissue A point", "its ratio of soft to hard tissue"},
    {"Li_soft", NEED_OPTIONAL, NULL, CASE_SKIN, "labrale inferius, front of the lower lip",
     "measures of the lower lip"},
    {"B'", NEED_OPTIONAL, NULL, CASE_SKIN, "soft-tissue B point", "its ratio of soft to hard tissue"},
    {"Pg'", NEED_OPTIONAL, NULL, CASE_SKIN, "soft-tissue pogonion", "measures of the chin's skin"},
    {"Gn'", NEED_OPTIONAL, NULL, CASE_SKIN, "soft-tissue gnathion", "measures of the chin's skin"},
    {"Me'", NEED_OPTIONAL, NULL, CASE_SKIN, "soft-tissue menton", "the height of the lower face"},
    {"C", NEED_OPTIONAL, NULL, CASE_SKIN, "cervical point, between throat and chin", "the throat's angle"},
    BOTH("En", NEED_OPTIONAL, CASE_SKIN, "inner corner of the eye", "the distance of the eyes"),
    BOTH("Ex", NEED_OPTIONAL, CASE_SKIN, "outer corner of the eye", "the distance of the eyes"),
    BOTH("Zy'", NEED_OPTIONAL, CASE_SKIN, "soft-tissue zygion", "the width of the face"),
    BOTH("Go'", NEED_OPTIONAL, CASE_SKIN, "soft-tissue gonion", "the width of the jaw"),
    BOTH("T", NEED_OPTIONAL, CASE_SKIN, "tragion, notch above the ear's tragus", "depths of the face"),
};

const int landmark_row_count = sizeof landmark_rows / sizeof landmark_rows[0];

const landmark_row *landmark_row_find(const char *label)
{
    for (int i = 0; i < landmark_row_count; i++)
        if (!strcmp(landmark_rows[i].label, label)) return &landmark_rows[i];
    return NULL;
}

bool landmark_is_needed(const landmark_row *row, const case_file *c)
{
    return (row->need & NEED_ALWAYS) || ((row->need & NEED_LE_FORT_1) && case_file_cuts(c, CUT_LE_FORT_1)) ||
           ((row->need & NEED_BSSO) && case_file_cuts(c, CUT_BSSO)) ||
           ((row->need & NEED_GENIOPLASTY) && case_file_cuts(c, CUT_GENIOPLASTY));
}
