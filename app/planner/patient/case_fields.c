/* The fields of case.json, one line each. A new parameter of a stage is one more line here; its default is
 * the one of its own params struct, through case_file_default(). */
#include "app/planner/patient/case_file.h"
#include <math.h>
#include <pthread.h>
#include <string.h>

#define SURFACE(word, id, needed, help_)                                                                               \
    {                                                                                                                  \
        .name = "surfaces." word, .kind = FIELD_FILE, .offset = offsetof(case_file, surface[id]), .required = needed,  \
        .help = help_                                                                                                  \
    }
#define MATERIAL(member, unit_, low_, high_, help_)                                                                    \
    {                                                                                                                  \
        .name = "tissue." #member, .kind = FIELD_NUMBER, .offset = offsetof(case_file, material.member),               \
        .unit = unit_, low_, high_, .help = help_                                                                      \
    }
#define GUESSED(word, id)                                                                                              \
    {                                                                                                                  \
        .name = "guessed." word, .kind = FIELD_NUMBER, .offset = offsetof(case_file, guessed.share[id]), FROM(0),      \
        TO(1), .help = "Share of it that no scan shows: `gnathos fit` guessed it, and check and predict tell."         \
    }
#define CASE(member, unit_, low_, high_, help_) NUMBER(case_file, member, unit_, low_, high_, help_)

static const field rows[] = {
    {.name = "gnathos",
     .kind = FIELD_VERSION,
     .offset = offsetof(case_file, version),
     .required = true,
     .help = "Version of the format."},
    {.name = "name",
     .kind = FIELD_TEXT,
     .offset = offsetof(case_file, name),
     .help = "Shown in results; the folder's name where absent."},
    {.name = "units",
     .kind = FIELD_WORD,
     .offset = offsetof(case_file, units),
     .words = "mm",
     .help = "Length unit of all files of the case."},
    {.name = "frame",
     .kind = FIELD_WORD,
     .offset = offsetof(case_file, frame),
     .words = "LPS RAS",
     .help = "Axes of meshes that carry no SPACE tag: LPS is +x left, +y posterior, +z up; RAS meshes are "
             "turned."},
    SURFACE("skin", CASE_SKIN, true,
            "Skin of the head (.ply .stl .obj .off .gltf .glb .vtk .vtp); may be open at the neck."),
    SURFACE("skull", CASE_SKULL, true, "Skull with the maxilla, without the mandible."),
    SURFACE("mandible", CASE_MANDIBLE, true, "Mandible."),
    SURFACE("upper_teeth", CASE_UPPER_TEETH, false, "Upper teeth where they are not part of the skull."),
    SURFACE("lower_teeth", CASE_LOWER_TEETH, false, "Lower teeth where they are not part of the mandible."),
    {.name = "landmarks",
     .kind = FIELD_FILE,
     .offset = offsetof(case_file, landmarks),
     .help =
         "Named points (.mrk.json or .fcsv of 3D Slicer), needed by all but `gnathos landmarks`, which places them; "
         "`gnathos help landmarks` lists the labels."},
    {.name = "planes",
     .kind = FIELD_FILE,
     .offset = offsetof(case_file, planes),
     .help = "Planes of osteotomies of your own (.mrk.json of 3D Slicer)."},
    {.name = "osteotomies",
     .kind = FIELD_OTHER,
     .words = "a list of le_fort_1, bsso, genioplasty, or of objects {\"segment\", \"plane\"}",
     .help = "The cuts of this patient; all three where absent. An object names a plane of your own in place "
             "of the default "
             "cut of the maxilla, proximal_left, proximal_right or chin."},
    CASE(cuts.kerf_mm, "mm", FROM(0.1), TO(3), "Width of the saw cut."),
    CASE(cuts.apex_clearance_mm, "mm", FROM(0), TO(15), "Distance of the cuts from the estimated root tips."),
    CASE(cuts.foramen_clearance_mm, "mm", FROM(0), TO(15),
         "Distance of the Le Fort I cut from the infraorbital foramen."),
    CASE(cuts.palate_clearance_mm, "mm", FROM(0), TO(15), "Height of the Le Fort I cut above the palate."),
    CASE(cuts.le_fort_raise_mm, "mm", FROM(0), TO(15), "Most that the Le Fort I cut is raised to clear the root tips."),
    CASE(cuts.above_lingula_mm, "mm", FROM(0), TO(10), "Height of the sagittal split's medial cut above the lingula."),
    CASE(cuts.behind_lingula_mm, "mm", FROM(0), TO(15), "End of the medial cut behind the lingula."),
    CASE(cuts.buccal_depth_mm, "mm", FROM(1), TO(10), "Thickest lateral plate that the sagittal cut leaves."),
    CASE(cuts.ramus_depth_share, NULL, FROM(0.2), TO(0.8),
         "The lateral plate's share of the bone where that is thinner."),
    CASE(cuts.canal_clearance_mm, "mm", FROM(0), TO(10), "Distance of the sagittal cut from the middle of the canal."),
    CASE(cuts.lingula_width_share, NULL, FROM(0.2), TO(0.8),
         "Place of a missing lingula: share of the ramus from behind."),
    CASE(cuts.lingula_height_share, NULL, FROM(0.2), TO(0.9),
         "Place of a missing lingula: share of the ramus from below."),
    CASE(cuts.below_mental_foramen_mm, "mm", FROM(0), TO(15), "Distance of the genioplasty below the mental foramina."),
    CASE(cuts.chin_height_mm, "mm", FROM(0), TO(30), "Height of the chin piece kept at the midline."),
    CASE(cuts.fragment_mm3, "mm3", FROM(0), TO(100000), "Islands smaller than this go to the piece next to them."),
    CASE(tissue.element_mm, "mm", FROM(0.5), TO(20), "Edge length of tetrahedra at lips, nose and chin."),
    CASE(tissue.coarse_mm, "mm", FROM(0.5), TO(40), "Largest edge length, far from them."),
    CASE(tissue.growth, "mm/mm", FROM(0), TO(2), "Growth of the edge length per mm of distance."),
    CASE(tissue.hole_mm, "mm", FROM(1), TO(60), "Openings of the skeleton narrower than this are spanned."),
    CASE(tissue.collar_mm, "mm", FROM(0), TO(30), "Tissue kept below the spanned openings."),
    CASE(tissue.detail_mm, "mm", FROM(0.1), TO(10), "Gaps between bones narrower than this are filled."),
    CASE(tissue.touch_mm, "mm", FROM(0), TO(10), "Tissue nodes nearer to bone than this are moved onto it."),
    CASE(tissue.cut_band_mm, "mm", FROM(0), TO(20),
         "Half width of the strip along a saw cut where tissue hangs loose."),
    CASE(tissue.vestibule_upper_mm, "mm", FROM(0), TO(40), "Depth of the upper vestibule from the incisal edge."),
    CASE(tissue.vestibule_lower_mm, "mm", FROM(0), TO(40), "Depth of the lower vestibule from the incisal edge."),
    CASE(tissue.coronal_mm, "mm", FROM(-60), TO(100), "The rear end of the tissue, behind the porions."),
    CASE(tissue.neck_mm, "mm", FROM(-20), TO(100), "The lower end of the tissue, below menton."),
    CASE(tissue.brow_mm, "mm", FROM(-20), TO(100), "The upper end of the tissue, above nasion."),
    CASE(tissue.far_mm, "mm", FROM(0), TO(100),
         "Cut faces of the tissue farther than this from moving bone are fixed."),
    MATERIAL(young_kpa, "kPa", ABOVE(0), TO(100000),
             "Stiffness; it does not change the shape while only bones move it."),
    MATERIAL(poisson, NULL, FROM(0), TO(0.499), "Poisson's ratio; near 0.5 the element matters."),
    {.name = "tissue.element",
     .kind = FIELD_WORD,
     .offset = offsetof(case_file, material.element),
     .words = "auto linear averaged",
     .help =
         "linear: tetrahedra of one strain each, which stiffen falsely (lock) near Poisson's ratio 0.5; averaged: "
         "with volume changes averaged around each node (what exceeds Poisson's ratio 0.4), dearer and without that; "
         "auto: averaged from 0.48 on."},
    GUESSED("skin", CASE_SKIN),
    GUESSED("skull", CASE_SKULL),
    GUESSED("mandible", CASE_MANDIBLE),
    GUESSED("upper_teeth", CASE_UPPER_TEETH),
    GUESSED("lower_teeth", CASE_LOWER_TEETH),
    {.name = "guessed.jaw_turned_deg",
     .kind = FIELD_NUMBER,
     .offset = offsetof(case_file, guessed.jaw_turned_deg),
     .unit = "deg",
     FROM(0),
     TO(45),
     .help = "By which `gnathos fit --complete` turned the mandible up to close an open mouth: the bite is guessed."},
    {.name = "guessed.landmarks",
     .kind = FIELD_OTHER,
     .words = "a list of labels",
     .help = "Landmarks where the scan has nothing: `gnathos fit` guessed them."},
#define LIMIT(id, field, part, unit_, help_)                                                                           \
    {                                                                                                                  \
        .name = "limits." #field "." #part, .kind = FIELD_RANGE,                                                       \
        .offset = offsetof(case_file, limits[LIMIT_##id].part), .unit = unit_, ANY, .help = help_ "."                  \
    }
#define X(id, field, unit, f0, f1, s0, s1, what, source)                                                               \
    LIMIT(id, field, fine, unit, "Fine within: " what), LIMIT(id, field, stop, unit, "Refused outside: " source),
    LIMITS(X)
#undef X
};

static case_file case_defaults; /* filled once */
static void set_defaults(void) { case_defaults = case_file_default(); }

const field_table *case_fields(void)
{
    static const field_table table = {"case.json, one patient:", rows, sizeof rows / sizeof rows[0], &case_defaults,
                                      NULL};
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, set_defaults);
    return &table;
}
