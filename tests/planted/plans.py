"""Mistakes in plans and in the fields of a case."""
import numpy as np

import table
from mistakes import *
from table import PLAN, row, warn

table.group = "plans"
NOSE_DOWN = np.array([[1, 0, 0], [0, np.cos(.1), -np.sin(.1)], [0, np.sin(.1), np.cos(.1)]])
row("metres for mm (0.004)", plan(maxilla_advance_mm=0.004), "moves the maxilla segment by no more than 0.004 mm", by=PLAN, status=0)
row("um for mm (4000)", plan(maxilla_advance_mm=4000), "maxilla_advance_mm", "at least -100 and at most 100 mm", by=PLAN)
row("cm for mm in the other direction (40)", plan(maxilla_advance_mm=40), "maxilla_advance_mm", "outside", by=PLAN, status=6)
row("a sign too few: set back 12 mm", plan(maxilla_advance_mm=-12), "maxilla_advance_mm", "outside", by=PLAN, status=6)
row("a sign exchanged: -4 for 4", plan(name="maxillary advancement", maxilla_advance_mm=-4), "advance", "backwards", by=PLAN, status=0, quick=True)
row("a name that says setback, mandible forwards", plan(name="mandible setback 5", mandible_advance_mm=5), "setback", "forwards", by=PLAN, status=0)
row("a name that says impaction, maxilla down", plan(name="impaction 3 mm", maxilla_impaction_mm=-3), "impaction", "down", by=PLAN, status=0)
row("degrees for radians", segments(maxilla={"pitch_deg": 57.3}), "maxilla", "outside", by=PLAN, status=6)
row("radians for degrees", segments(distal={"yaw_deg": 0.0698}), "moves the distal segment by no more than 0 mm and 0.0698 degrees", by=PLAN, status=0)
row("the word of an audit for a plan", plan(maxilla_roll_deg=3), "segments", by=PLAN)
row("a field misspelt", plan(maxila_advance_mm=4), "did you mean", by=PLAN)
row("a text for a number", plan(maxilla_advance_mm="4"), "must be a number", by=PLAN)
row("short field and segment for one bone", plan(maxilla_advance_mm=4, segments={"maxilla": {"translate_mm": [0, -4, 0]}}), "maxilla", by=PLAN)
row("translation in RAS", plan(name="maxilla forward 4", segments={"maxilla": {"translate_mm": [0, 4, 0]}}), "backwards", by=PLAN, status=0)
row("translation in metres", segments(maxilla={"translate_mm": [0, -.004, 0]}), "moves the maxilla segment by no more than 0.004 mm", by=PLAN, status=0)
row("transform in RAS", tfm("maxilla_advance_4mm.tfm", moved(y=4), maxilla={}), "advance", "backwards", by=PLAN, status=0, quick=True)
row("inverse transform", tfm("mandible_setback.tfm", moved(y=-5), distal={}), "setback", "forwards", by=PLAN, status=0)
row("transform of another bone", tfm("maxilla.tfm", moved(y=-4), distal={}), "maxilla.tfm", "distal", by=PLAN, status=0)
row("transform of the other ramus", tfm("proximal_left.tfm", moved(y=-1), proximal_right={}), "proximal_left.tfm", "right", by=PLAN, status=0)
row("transform in metres", tfm("maxilla.tfm", moved(y=-.004), maxilla={}), "moves the maxilla segment by no more than 0.004 mm", by=PLAN, status=0)
row("transform with a scale", tfm("maxilla.tfm", moved(matrix=1.02 * np.eye(3)), maxilla={}), "not rigid", by=PLAN)
row("transform that mirrors", tfm("maxilla.tfm", moved(matrix=MIRROR_X), maxilla={}), "maxilla.tfm", by=PLAN)
row("transform about the scanner's origin, 80 mm away", tfm("distal.tfm", np.c_[NOSE_DOWN, [0, 0, 40]], distal={}), "distal", "outside", by=PLAN, status=6)
row("matrix read column by column", segments(maxilla={"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -4, 0, 1]}), "matrix", by=PLAN)
row("matrix of 12 numbers", segments(maxilla={"matrix": [1, 0, 0, 0, 0, 1, 0, -4, 0, 0, 1, 0]}), "16 numbers", by=PLAN)
row("a bone that is not cut", after(field("osteotomies", ["bsso"]), plan(maxilla_advance_mm=4)), "maxilla", by=PLAN)
row("condyle moved 9 mm", segments(proximal_left={"translate_mm": [0, -9, 0]}), "condyle", by=PLAN, status=6)
row("registered ramus turned by 40 degrees", segments(proximal_left={"yaw_deg": 40}), "proximal_left", by=PLAN, status=6)
row("no move at all", plan(), "moves nothing", by=PLAN, status=0)
row("a case for a plan", lambda h: h.plan.update(h.case), "is a case, not a plan", by=PLAN)

table.group = "fields of a case"
row("units inch", field("units", "inch"), "units", "mm", quick=True)
row("frame that is not true (RAS)", field("frame", "RAS"),
    harmless="these files say themselves that they are LPS, which wins; files that do not are the rows above")
row("frame misspelt", field("frame", "LPI"), "frame")
row("limit wider than a head (40 mm)", field("limits", {"maxilla_advance_mm": {"stop": [-40, 40]}}),
    harmless="a case may set its own limits: every outcome then says \"set by the case\" beside the number")
row("limit reversed", field("limits", {"maxilla_advance_mm": {"stop": [8, -5]}}), "maxilla_advance_mm")
row("limit unknown", field("limits", {"maxila_advance_mm": {"stop": [-5, 8]}}), "did you mean")
row("kerf in cm", field("cuts", {"kerf_mm": 0.05}), "kerf_mm", "0.1")
row("stiffness in Pa", field("tissue", {"young_kpa": 15000}),
    harmless="bones drive the tissue: one stiffness everywhere drops out of the face")
row("Poisson's ratio 0.5", field("tissue", {"poisson": 0.5}), "poisson")
row("elements of 30 mm", field("tissue", {"element_mm": 30}), "element_mm")
row("a field nobody knows (scan date)", field("scan_date", "2031-02-30"), "unknown field")
row("surface that is not there", field("surfaces.skin", "face.ply"), "face.ply")
row("a cut twice", field("osteotomies", ["bsso", "bsso"]), "osteotomies")
row("version of another format", field("gnathos", 2), "gnathos")
