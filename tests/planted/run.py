#!/usr/bin/python3
"""run.py GNATHOS CASE [PHANTOM] [--quick] [--only WORDS]: plants every mistake of table.py in a copy of the synthetic
class III head CASE (`gnathos new cases/class3`) or of the phantom's surfaces, runs the program and prints what became of
it: caught by name, harmless with the reason, or not caught. PHANTOM: the folder of its data; without it its mistakes are
left out, saying so. The status is 1 if one is not caught."""
import argparse
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from head import Head
import labels  # noqa: F401  its rows join those of the table
import plans  # noqa: F401
from table import rows


def import_phantom(gnathos, data, folder):
    parts = [w for part in ("skin", "skull", "mandible") for w in ("--" + part, f"{data}/{part}.ply")]
    subprocess.run([gnathos, "import", "-q", *parts, "--landmarks", f"{data}/landmarks.mrk.json", "-o", folder], check=True)


def result(gnathos, row, head, folder):
    """caught, harmless or not caught, and the line that says it."""
    damaged = head.copy()
    row["plant"](damaged)
    damaged.write(folder)
    done = subprocess.run([gnathos, *row["by"].split()], cwd=folder, capture_output=True, text=True)
    lines = [line.removeprefix("gnathos: ") for line in done.stderr.splitlines()]
    if done.returncode != row["status"]:
        return "not caught", f"status {done.returncode}, not {row['status']}: " + " | ".join(lines[:4])
    if row["harmless"]:
        return "harmless", row["harmless"]
    found = [line for line in lines if all(word in line for word in row["words"])]
    return ("caught", found[0]) if found else ("not caught", f"status {done.returncode}: " + " | ".join(lines[:4]))


def main():
    options = argparse.ArgumentParser()
    options.add_argument("gnathos", type=os.path.abspath)
    options.add_argument("case")
    options.add_argument("phantom", nargs="?")
    options.add_argument("--quick", action="store_true")
    options.add_argument("--only", default="")
    o = options.parse_args()
    chosen = [r for r in rows if o.only in r["name"] and (r["quick"] or not o.quick)]
    count = {"caught": 0, "harmless": 0, "not caught": 0}
    left_out, group = 0, None
    with tempfile.TemporaryDirectory() as work:
        heads = {"class3": Head(o.case)}
        if o.phantom and os.path.isdir(o.phantom) and any(r["head"] == "phantom" for r in chosen):
            import_phantom(o.gnathos, o.phantom, work + "/phantom")
            heads["phantom"] = Head(work + "/phantom")
            heads["phantom"].data = o.phantom
        for r in chosen:
            if r["head"] not in heads:
                left_out += 1
                continue
            if r["group"] != group:
                group = r["group"]
                print(f"\n**{group}**\n\n| planted | said | |\n|---|---|---|")
            what, line = result(o.gnathos, r, heads[r["head"]], work + "/planted")
            count[what] += 1
            line = line.replace(work, "").replace("|", "/")
            print(f"| {r['name']} | {line if len(line) < 330 else line[:330] + ' ...'} | {what} |", flush=True)
    print(f"\n{sum(count.values())} mistakes: {count['caught']} caught by name, {count['harmless']} harmless, "
          f"{count['not caught']} not caught" + (f"; {left_out} left out: no phantom" if left_out else ""))
    sys.exit(count["not caught"] > 0)


main()
