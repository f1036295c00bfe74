"""What check refuses, every verb that prepares the case refuses too: the same words, the same status, and at once."""
from common import *

def swap(a, b):
    return lambda case: edit(case / "landmarks.mrk.json", (f'"{a}"', '"@"'), (f'"{b}"', f'"{a}"'), ('"@"', f'"{b}"'))

def scaled(mesh, factor):
    def change(case):
        lines = (case / mesh).read_text().split("\n")
        vertices = int(lines[1].split()[0])
        for i in range(2, 2 + vertices):
            lines[i] = " ".join(f"{float(x) * factor:g}" for x in lines[i].split())
        (case / mesh).write_text("\n".join(lines))
    return change

def meshes(a, b):
    def change(case):
        one, two = (case / a).read_bytes(), (case / b).read_bytes()
        (case / a).write_bytes(two)
        (case / b).write_bytes(one)
    return change

mistakes = {
    "incisors exchanged": swap("U1", "L1"),
    "palate turned round": swap("ANS", "PNS"),
    "sides exchanged": swap("Co_L", "Co_R"),
    "chin above the brow": swap("N", "Me"),
    "skin in centimetres": scaled("skin.off", 0.1),
    "skull of a giant": scaled("skull.off", 20),
    "jaw for skull": meshes("skull.off", "mandible.off"),
    "one file for both bones": lambda case: edit(case / "case.json", ("mandible.off", "skull.off")),
}
verbs = {
    "prepare": ["prepare", "case"],
    "predict": ["predict", "case", "--plan", "case/plan.json", "-o", "out"],
    "audit of a plan": ["audit", "case", "--plan", "case/plan.json"],
    "audit": ["audit", "case", "-o", "out", "--geometry-only"],
    "cut": ["cut", "case", "-o", "out"],
    "ratios": ["study", "case", "--ratios", "-o", "study"],
}
for i, (name, change) in enumerate(mistakes.items()):
    change(fresh())
    status, _, err = run("check", "case")
    first = next((l for l in err.splitlines() if not re.search(": (info|warning): ", l)), None)
    row(name, status in (3, 4) and first, f"check itself says {status} {err}")
    for verb, words in list(verbs.items()) if i == 0 else [list(verbs.items())[(2 * i + k) % len(verbs)] for k in (0, 1)]:
        got, out, said = run(*words)
        row(f"{name}, {verb}", got == status and first and said.startswith(first) and said.count("\n") == 1 and not out
            and not any((work / made).exists() for made in ("out", "study", "case/prepared")),
            f"status {got}, wanted {status} and {first}\n{said}")
finish()
