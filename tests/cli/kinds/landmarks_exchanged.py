"""Two landmarks that took each other's place, for every pair whose order a head decides: check names one of the two and what it
lies behind, below or on. And points of another head, unit or side."""
from common import *

extra = {"A": (0, -70, -14), "B": (0, -75, -40), "U3_L": (15, -65, -20), "U3_R": (-15, -65, -20), "L3_L": (14, -68, -25), "L3_R": (-14, -68, -25),
         "U1_apex": (0, -65, -10), "L1_apex": (0, -70, -35), "G_s": (0, -88, 45), "N_s": (0, -88, 25), "Sn": (0, -85, -8), "Li_soft": (0, -90, -32), "B_s": (0, -88, -42),
         "Pg_s": (0, -88, -60), "Me_s": (0, -85, -80), "Stms": (0, -90, -24), "Stmi": (0, -90, -25), "T_L": (75, 5, -10), "T_R": (-75, 5, -10),
         "Cor_L": (45, -5, -25), "Cor_R": (-45, -5, -25)}
pairs = """N ANS|ANS PNS|A B|A U1|L1 B|B Me|Pog Me|B Pog|U3_L U6_L|U3_R U6_R|L3_L L6_L|L6_R L7_R|RA_L RP_L|RA_R RP_R|Co_L Go_L
SN_R Go_R|Or_L ZB_L|PR_R PM_R|U1_apex U1|L1 L1_apex|G' N'|N' Pn|Pn Sn|Sn Ls|Ls Li_soft|Li_soft B'|B' Pg'|Pg' Me'|Stms Stmi|Pn T_L
U6_L U6_R|Co_L Co_R|MF_L MF_R|T_L T_R|Cor_L Cor_R|U3_L U3_R|N Me|ANS Me|Ch_L Ch_R|Or_L Or_R|U1 L1|U6_L L6_L|U1 Pog""".replace("\n", "|").split("|")

def with_points():
    path = fresh() / "landmarks.mrk.json"
    add_points(path, **extra)
    return path

with_points()
accepted("all in their places", ["check", "case"], "no errors")
for a, b in (p.split() for p in pairs):
    path = with_points()
    edit(path, (f'"{a}"', '"@"'), (f'"{b}"', f'"{a}"'), ('"@"', f'"{b}"'))
    names = {re.escape(n) for n in (a, b)}
    refused(f"{a} and {b}", ["check", "case"], 3, rf": ({'|'.join(sorted(names))}): lies ")
finish()
