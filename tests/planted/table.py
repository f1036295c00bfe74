"""The planted mistakes: what is done to a head, what it is read by, and the words by which it must be told."""
import numpy as np

from mistakes import *

CHECK, PLAN = "check .", "check . --plan plan.json"
rows = []
group = None


def row(name, plant, *words, status=3, by=CHECK, head="class3", quick=False, harmless=None):
    """words: all of them in one line of what the program says. A status of 0 cautions. harmless: the reason why nothing
    has to be said; then the status must be 0."""
    rows.append({"group": group, "name": name, "plant": plant, "words": words, "status": 0 if harmless else status,
                 "by": by, "head": head, "quick": quick, "harmless": harmless})


def warn(name, plant, *words, **more):
    row(name, plant, "warning", *words, status=0, **more)


group = "landmarks exchanged"
row("U1 and L1", swap("U1", "L1"), "U1", "upper jaw, where it belongs", quick=True)
row("ANS and PNS", swap("ANS", "PNS"), "ANS", "behind PNS")
row("A and B", swap("A", "B"), "A", "below B")
row("Pog and Me", swap("Pog", "Me"), "Pog", "below Me")
row("B and Pog", swap("B", "Pog"), "B", "below Pog")
row("RA and RP of the left", swap("RA_L", "RP_L"), "RA_L", "behind RP_L")
row("Co and Go of the right", swap("Co_R", "Go_R"), "Co_R", "below Go_R")
row("Pn and Sn", swap("Pn", "Sn"), "Pn", "behind Sn")
row("Ls and Li_soft", swap("Ls", "Li_soft"), "Ls", "below Li_soft")
row("G' and N'", swap("G'", "N'"), "G'", "below N'")
row("U3 and U6 of the left", swap("U3_L", "U6_L"), "U3_L", "behind U6_L")
warn("U6 and L6, both sides", swap_all("*6_L *6_R", "U", "L"), "U6_L", "exchanged, or a cross-bite")
row("Or and ZB of the right", swap("Or_R", "ZB_R"), "Or_R", "below ZB_R")
row("N and G' (bone and skin)", swap("N", "G'"), "G'")
warn("Pog and Pg' (bone and skin)", swap("Pog", "Pg'"), "Pog", "mm from the mandible")
warn("Go and Go' of the left (bone and skin)", swap("Go_L", "Go'_L"), "Go_L", "mm from the mandible")
row("sides of one pair", swap("ZB_L", "ZB_R"), "ZB_L", "swapped")
row("sides of all pairs", swap_sides, "looks the wrong way")
row("phantom: U1 and L1", swap("U1", "L1"), "U1", "upper jaw, where it belongs", head="phantom")
row("phantom: RA and RP of the right", swap("RA_R", "RP_R"), "RA_R", "behind RP_R", head="phantom")

group = "landmarks moved"
warn("Pog 3 mm before the bone", shift_point("Pog", 0, -3, 0), "Pog", "mm from the mandible", quick=True)
warn("A 3 mm before the bone", shift_point("A", 0, -3, 0), "A", "mm from the skull")
warn("Pg' 3 mm before the skin", shift_point("Pg'", 0, -3, 0), "Pg'", "mm from the skin")
warn("Me 10 mm below the bone", shift_point("Me", 0, 0, -10), "Me", "mm from the mandible")
warn("N 90 mm above", shift_point("N", 0, 0, 90), "N", "mm from the skull")
warn("Po_L 14 mm higher on the bone", along("skull", "Po_L", 14, 0, 0, 1), "porions and orbitales")
warn("Go_L 30 mm along the border", along("mandible", "Go_L", 30, 0, -1, 0), "Go_L", "mm from where")
warn("MF_R 25 mm along the body", along("mandible", "MF_R", 25, 0, 1, 0), "MF_R", "mm from where")
warn("PM_L 25 mm off on the skull", along("skull", "PM_L", 25, 0, 1, 0), "PM_L", "mm from where")
warn("ZB_R 20 mm along the bone", along("skull", "ZB_R", 20, 0, -1, 0), "ZB_R", "mm from where")
warn("Ch_L 32 mm along the cheek", along("skin", "Ch_L", 32, 1, 0, 0), "Ch_L", "mm from where")
row("Pog 3 mm along the bone", along("mandible", "Pog", 3, 0, 0, 1),
    harmless="observers differ by 1 to 3 mm along a surface; it serves measures and the chin's pivot, which moves by as little")
row("Go_L 3 mm along the border", along("mandible", "Go_L", 3, 0, -1, 0),
    harmless="observers differ as much; the split, fitted to the ramus, is moved by less than a saw's width")
row("all landmarks 10 mm to the front", shift_points("all", 0, -10, 0), "lie off their landmarks", "10.0 mm behind", "another scan", quick=True)
row("all landmarks 3 mm to the left", shift_points("all", 3, 0, 0), "warning", "3.0 mm to the right", "another scan", status=0)
row("all landmarks 30 mm down", shift_points("all", 0, 0, -30), "lie off their landmarks", "30.0 mm above")
row("landmarks of another scanner place", shift_points("all", 0, -200, 100), "off their landmarks", "200.0 mm behind and 100.0 mm below")
row("phantom: all landmarks 10 mm to the front", shift_points("all", 0, -10, 0), "lie off their landmarks", "10.0 mm behind", head="phantom")
row("landmarks of RAS said to be LPS", points_as("LPS", times=(-1, -1, 1)), "looks the wrong way", "RAS")
row("landmarks of LPS said to be RAS", points_as("RAS"), "looks the wrong way")
row("landmarks in metres", points_as("LPS", times=(.001, .001, .001)), "not the points of a head in mm")
row("landmarks in centimetres", points_as("LPS", times=(.1, .1, .1)), "landmark", "mm")
row("unit of the landmarks um", points_as("LPS", "um"), "must be \"mm\"")
row("landmarks upside down", points_as("LPS", times=(1, -1, -1)), "looks the wrong way")
row("a label in small letters", rename("Me", "me"), "Me", "missing")
row("porions missing", lose("Po_L", "Po_R"), "Po_L", "missing")
warn("two labels on one point", place("ZB_L", "IOF_L"), "ZB_L", "lies on IOF_L")

group = "teeth missing"
row("U1 missing", lose("U1"), "U1", "is missing", "Pr would do as well")
row("L1 and the lower first molars missing", lose("L1", "L6_L", "L6_R"), "L1", "is missing", "Id would do as well")
warn("incisors missing, Pr and Id in their place", toothless(), "U1", "estimated from Pr", "overjet, overbite", "not judged", quick=True)
warn("no tooth at all, points of the crest", toothless(True), "L6_R", "estimated from L6_crest_R", "no root", quick=True)
row("no tooth at all, no other points", toothless(True, points=False), "U6_L, U6_R", "are missing", "U6_crest_L would do as well")
row("Pr and Id exchanged", after(toothless(), swap("Pr", "Id")), "Pr", "upper jaw, where it belongs")

group = "wrong surfaces"
row("the skin's file as skull", become("skull", "skin"), "one surface for two parts, skin and skull")
row("the mandible's file as skull", become("skull", "mandible"), "one surface for two parts, skull and mandible")
row("the skull's file as mandible", become("mandible", "skull"), "one surface for two parts, skull and mandible")
row("skull and mandible exchanged", exchange("skull", "mandible"), "are they exchanged", status=4, quick=True)
row("skull holds the mandible too", become("skull", "skull", "mandible"), "holds the mandible too", status=4, quick=True)
row("mandible holds the skull too", become("mandible", "mandible", "skull"), "holds the skull too", status=4)
row("both bones in both", after(become("skull", "skull", "mandible"), become("mandible", "skull")), "one surface for two parts, skull and mandible")
row("upper and lower teeth exchanged", exchange("upper_teeth", "lower_teeth"), "upper teeth", "exchanged", status=4)
row("lower teeth as both", become("upper_teeth", "lower_teeth"), "one surface for two parts, upper teeth and lower teeth")
row("skull holds the lower teeth too", become("skull", "skull", "lower_teeth"), "lower teeth", status=4)
row("skin holds the bones too", become("skin", "skin", "skull"), "skull is the skin's own surface", status=4)
row("one file for two parts", field("surfaces.upper_teeth", "lower_teeth.ply"), "one surface for two parts, upper teeth and lower teeth")
row("left half of the mandible missing", cut_off("mandible", 0, (0, .5)), "landmarks lie off the mandible", "piece of it missing")
row("rami of the mandible missing", cut_off("mandible", 1, (0, .5)), "landmarks lie off the mandible", "piece of it missing")
row("maxilla missing from the skull", cut_off("skull", 2, (.5, 1)), "landmarks lie", "the skull", status=4)
row("skin cut off below the nose", cut_off("skin", 2, (.55, 1)), "landmarks lie off the skin", "piece of it missing")
warn("hole of 15 mm in the mandible", hole("mandible", "Me", 15), "open")
warn("skin twice, 60 mm apart (two heads)", again("skin", 60, 0, 0), "skin", "2 heads")
row("skin twice, 400 mm apart (two heads)", again("skin", 400, 0, 0), "skin", "a head measures")
warn("skull twice, 5 mm apart (before and after)", again("skull", 0, -5, 0), "skull", "twice")
warn("mandible twice in one place", again("mandible", 0, 0, 0), "mandible", "twice")
warn("phantom: mandible twice, 4 mm apart", again("mandible", 0, -4, 0), "mandible", "twice", head="phantom")
row("phantom: skull holds the mandible too", become("skull", "skull", "mandible"), "holds the mandible too", status=4, head="phantom")

group = "sides and axes"
row("whole head mirrored, triangles not turned", linear("all", MIRROR_X, True), "all 5 surfaces face inwards")
row("all surfaces mirrored, landmarks not", mirror_properly("all"), harmless="this head is symmetric: its mirror image is itself")
row("phantom: all surfaces mirrored, landmarks not", mirror_properly("all"), "mirrored, left for right", head="phantom")
row("skin mirrored alone", linear("skin", MIRROR_X), harmless="this head is symmetric: its mirror image is itself, and the triangles are turned")
row("skull in RAS, the rest in LPS", linear("skull", RAS), "the skull lies off its landmarks", "in RAS", "(-x, -y, z)", status=4)
row("skin in RAS, the rest in LPS", linear("skin", RAS), "the skin lies off its landmarks", "in RAS", "(-x, -y, z)", status=4)
row("all surfaces in RAS, landmarks in LPS", linear("all", RAS), "RAS", "\"frame\": \"RAS\"", status=3, quick=True)
row("all surfaces y up, landmarks in LPS", linear("all", Y_UP), "y up", "(x, -z, y)", status=4, quick=True)
row("mandible y up", linear("mandible", Y_UP), "the mandible lies", "y up", "(x, -z, y)", status=4)
row("skull z flipped (slices in reverse order)", linear("skull upper_teeth", Z_FLIPPED), "the skull lies", "mirrored", "(x, y, -z)", status=4)
row("all z flipped", linear("all", Z_FLIPPED), "mirrored", "(x, y, -z)", status=4)
row("all upside down", linear("all", UPSIDE_DOWN), "upside down", "(x, -y, -z)", status=4)
row("all turned to x in front", linear("all", X_FRONT), "in other axes", "(y, -x, z)")
row("all and landmarks in RAS", linear("all", RAS, True), "looks the wrong way")
row("all and landmarks y up", linear("all", Y_UP, True), "looks the wrong way", status=4)
row("phantom: all surfaces in RAS, landmarks in LPS", linear("all", RAS), "in RAS", "\"frame\": \"RAS\"", head="phantom")
row("phantom: skin y up", linear("skin", Y_UP), "the skin lies", "y up", "(x, -z, y)", status=4, head="phantom")
row("mandible turned by 8 degrees (mouth opened)", turn("mandible lower_teeth", 8), "the mandible lies off its landmarks", "is turned by")
row("skull's triangles inside out", inside_out("skull"), harmless="it is told, and they are turned outwards before anything is measured")
warn("all triangles inside out", inside_out("all"), "face inwards")

group = "size and place"
row("all in metres", linear("all", .001, True), "metres", quick=True)
row("all in centimetres", linear("all", .1, True), "centimetres")
row("all in inches", linear("all", 1 / 25.4, True), "inches")
row("skin in centimetres alone", linear("skin", .1), "centimetres")
row("mandible in centimetres alone", linear("mandible", .1), "the mandible lies", "in centimetres", status=4)
row("skull in metres alone", linear("skull", .001), "the skull lies", "in metres", status=4)
warn("bones x 1.02, landmarks not", linear("bones", 1.02), "1.02", quick=True)
row("bones x 1.05, landmarks not", linear("bones", 1.05), "1.050 times")
warn("mandible x 1.02 about its middle", scale_about_middle("mandible", 1.02), "mandible", "1.02")
warn("mandible x 0.97 about its middle", scale_about_middle("mandible", .97), "mandible", "0.97")
warn("skull x 1.05 about its middle, teeth not", scale_about_middle("skull", 1.05), "landmarks lie off the skull")
warn("skin x 1.03", linear("skin", 1.03), "skin", "1.03")
warn("phantom: bones x 1.03", linear("bones", 1.03), "1.03", head="phantom")
row("whole head x 1.02, landmarks too", linear("all", 1.02, True),
    harmless="a head 2 % larger: people differ by 4 %. Moves are a plan's mm, the face's answer is off by 2 % of them, 0.1 mm of 5")
row("whole head x 1.05, landmarks too", linear("all", 1.05, True),
    harmless="a head 5 % larger: people differ by 4 %. The face's answer is off by 5 % of a move, 0.25 mm of 5")
warn("whole head x 1.25, landmarks too", linear("all", 1.25, True), "a head 1.2", "is the scale right")
warn("bones and their landmarks x 1.05, skin not", bones_with_points(1.05), "the skin lies", "scaled or moved against each other", quick=True)
warn("bones and their landmarks x 0.93, skin not", bones_with_points(.93), "the skin lies", "scaled or moved against each other")
row("bones and their landmarks x 1.02, skin not", bones_with_points(1.02),
    harmless="1.8 mm less of soft tissue, as much as people differ (norm 8.6 mm, 6.3 to 7.1 here): not told; it alters the face's answer by 2 %")
warn("bones and their landmarks moved 10 mm back", bones_with_points(1, (0, 10, 0)), "the skin lies", "scaled or moved against each other")
row("skin moved 10 mm to the front", shift("skin", 0, -10, 0), "the skin lies", "10.0 mm in front", "moved")
warn("skin moved 4 mm up", shift("skin", 0, 0, 4), "the skin lies", "4.0 mm above", "moved")
row("bones moved 10 mm back", shift("bones", 0, 10, 0), "the skull and mandible lie", "10.0 mm behind", "moved")
row("bones moved 6 mm to the left", shift("bones", 6, 0, 0), "the skull and mandible lie", "6.0 mm to the left", "moved")
warn("mandible moved 4 mm to the front", shift("mandible lower_teeth", 0, -4, 0), "the mandible lies", "4.0 mm in front", "moved")
warn("lower teeth moved 3 mm to the front", shift("lower_teeth", 0, -3, 0), "L1", "mm from the lower_teeth")
row("phantom: skin moved 10 mm to the front", shift("skin", 0, -10, 0), "the skin lies", "10.0 mm in front", head="phantom")
warn("phantom: mandible moved 4 mm down", shift("mandible", 0, 0, -4), "the mandible lies", "4.0 mm below", head="phantom")
warn("bones of slices 5 mm thick", stairs("skull mandible", 5), "planes", "mm apart along z", "slices", quick=True)
warn("bones of slices 3 mm thick", stairs("skull mandible", 3), "mm apart along z", "slices")
warn("skin of slices 4 mm thick", stairs("skin", 4), "mm apart along z", "slices")
warn("mandible a soup of loose triangles", soup("mandible", .0001), "loose triangles")
