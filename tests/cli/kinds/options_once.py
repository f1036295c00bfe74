"""Every option of every verb that has a value: given twice it is refused with both values, or it means both. The options are
those of --help, so that a new one is held too."""
from common import *

values = {"MM": ("1", "2"), "N": ("2", "3"), "HU": ("1", "2"), "DEG": ("2", "3"), "f|m": ("f", "m"), "1|2|3": ("1", "2"),
          "0..1": ("0.5", "0.6"), "WxH": ("200x200", "300x300"), "AXES": ("lps", "ras"), "UNIT": ("mm", "cm"),
          "KIND": ("bones", "off"), "FORM": ("sform", "qform"), "WHEN": ("after", "before"), "END": ("5", "6"), "HOW": ("skin", "none"),
          "FACTOR": ("2", "3"), "A,B,...": ("1", "1,2"), "FORMAT": ("obj", "ply"), "FILE.html": ("a.html", "b.html")}
both = {"import": ["skin", "skull", "mandible", "upper-teeth", "lower-teeth", "labels"], "audit": ["line", "pair", "box"],
        "render": ["show", "view"], "new": ["set"]}
everywhere = ["jobs", "progress"]  # name no part of a result
found = 0
for verb in re.findall(r"^  ([a-z]+) ", run("--help")[1], re.M):
    text = run(verb, "--help")[1]
    for option, meta in re.findall(r"--([a-z-]+)=(\S+)", text):
        if option in everywhere or option in both.get(verb, []):
            continue
        found += 1
        a, b = values.get(meta, ("one", "two"))
        refused(f"{verb} --{option}", [verb, f"--{option}", a, f"--{option}={b}"], 2, f"--{option} is given twice: {a} and {b}; which is meant")
row("options are found", found > 30, str(found))
refused("a letter and a word", ["predict", "case", "-p", "a.json", "--plan", "b.json", "-o", "out"], 2, "--plan is given twice: a.json and b.json")
refused("the same twice", ["cut", "case", "-o", "out", "-o", "out"], 2, "--output is given twice: out and out")
refused("a measure twice", ["new", "head", "--norm", "--set", "sna_deg=80", "--set", "sna_deg=82"], 2, "--set sna_deg is given twice")

fresh()
for part in ("skull", "mandible"):  # halves of a part are joined
    mesh = (work / f"case/{part}.off").read_text().split("\n")
    vertices, triangles = (int(x) for x in mesh[1].split()[:2])
    for k, half in enumerate(("a", "b")):
        own = mesh[2 + vertices + k * triangles // 2:2 + vertices + (k + 1) * triangles // 2]
        (work / f"case/{part}_{half}.off").write_text("\n".join(["OFF", f"{vertices} {len(own)} 0", *mesh[2:2 + vertices], *own, ""]))
    other = {"skull": "mandible", "mandible": "skull"}[part]
    words = ["import", "--skin", "skin.off", f"--{other}", f"{other}.off", f"--{part}", f"{part}_a.off", f"--{part}", f"{part}_b.off",
             "-o", f"new_{part}", "--json"]
    accepted(f"halves of the {part}", words, f'"triangles": {triangles},', cwd=work / "case")
finish()
