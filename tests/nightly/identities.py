#!/usr/bin/env python3
"""identities.py GNATHOS FOLDER [--norm N] [--held N] [--random N] [--predicted N] [--data DATA]

Learns identities from norm heads and tells how good they are: heads that were held out made from 40 coefficients, the two
real heads, random heads and predictions of them. FOLDER keeps what is done; the same command goes on from there. Fails if a
held-out head is off by more than 0.5 mm in the mean or 3.3 mm at most over the face, or a random head cannot be had."""
import argparse
import json
import os
import subprocess
import sys
import time

PARTS = ["face", "skin", "tissue", "skull", "mandible", "upper teeth", "lower teeth"]


def run(*words):
    start = time.time()
    done = subprocess.run(words, capture_output=True, text=True)
    return done, time.time() - start


def record(path, *words):
    """The record that the command prints with --json, kept in path."""
    if os.path.exists(path):
        with open(path) as f:
            return json.load(f)
    done, wall = run(*words, "--json", "--progress=none")
    kept = {"status": done.returncode, "message": done.stderr.strip(), "wall_s": wall}
    if done.returncode == 0:
        kept["record"] = json.loads(done.stdout)
    with open(path + ".part", "w") as f:
        json.dump(kept, f)
    os.rename(path + ".part", path)
    return kept


def projections(gnathos, folder, model, heads):
    print(f"{'head':34} " + " ".join(f"{p:>13}" for p in PARTS) + "   mm, mean / largest")
    face = []
    for name, case in heads:
        kept = record(os.path.join(folder, f"project_{name}.json"), gnathos, "identities", "project", model, case)
        if kept["status"]:
            print(f"{name:34} {kept['message']}")
            face.append((name, None))
            continue
        error = kept["record"]["error"]
        print(f"{name:34} " + " ".join("      -/     -" if error[p]["mean_mm"] is None else
                                       f"{error[p]['mean_mm']:6.3f}/{error[p]['max_mm']:6.2f}" for p in PARTS))
        face.append((name, error["face"]))
    return face


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("gnathos")
    words.add_argument("folder")
    words.add_argument("--norm", type=int, default=120)
    words.add_argument("--held", type=int, default=12)
    words.add_argument("--random", type=int, default=100)
    words.add_argument("--predicted", type=int, default=20)
    words.add_argument("--data", default=os.environ.get("GNATHOS_DATA", ""))
    a = words.parse_args()
    gnathos, folder = os.path.abspath(a.gnathos), os.path.abspath(a.folder)
    os.makedirs(folder, exist_ok=True)
    model = os.path.join(folder, "identities.model")
    faults = []

    if not os.path.exists(model):
        start = time.time()
        if subprocess.run([gnathos, "identities", "learn", "--norm", str(a.norm), "--seed", "1", "-o", model]).returncode:
            return 1
        print(f"learnt in {time.time() - start:.0f} s")
    print(run(gnathos, "identities", "show", model)[0].stdout)

    held = []
    for i in range(a.held):
        name = f"norm_{'fm'[i % 2]}_class_{1 + i // 2 % 3}_seed_{100001 + i}"
        case = os.path.join(folder, name)
        if not os.path.exists(case):
            done, _ = run(gnathos, "new", case, "--norm", "--sex", "fm"[i % 2], "--class", str(1 + i // 2 % 3), "--seed",
                          str(100001 + i), "--coarseness", "2")
            if done.returncode:
                print(done.stderr)
                return 1
        held.append((name, case))
    for name, face in projections(gnathos, folder, model, held):
        if not face or face["mean_mm"] > 0.5 or face["max_mm"] > 3.3:
            faults.append(f"{name}: not within 0.5 mm in the mean and 3.3 mm at most over the face")
    real = []
    for name in ("phantom_head_ct", "vtk_fullhead_ct"):
        data, case = os.path.join(a.data, name), os.path.join(folder, name)
        parts = [w for p in ("skin", "skull", "mandible") for w in ("--" + p, f"{data}/{p}.ply")]
        if os.path.exists(f"{data}/skin.ply") and not os.path.exists(case):
            done, _ = run(gnathos, "import", *parts, "--landmarks", f"{data}/landmarks.mrk.json", "-o", case, "-q")
            if done.returncode:
                print(done.stderr)
        if os.path.exists(case):
            real.append((name, case))
    projections(gnathos, folder, model, real)

    draws, refused = 0, {}
    plan = os.path.join(folder, "plan.json")
    with open(plan, "w") as f:
        json.dump({"gnathos": 1, "maxilla_advance_mm": 2, "mandible_advance_mm": 2, "override": "one plan for all heads"}, f)
    for seed in range(1, a.random + 1):
        case = os.path.join(folder, f"random_{seed:03d}")
        kept = record(case + ".json", gnathos, "identities", "make", model, "--random", "--seed", str(seed), "-o", case)
        if kept["status"]:
            faults.append(f"random head {seed}: {kept['message']}")
            continue
        draws += kept["record"]["draws"]
        for line in kept["message"].splitlines():
            if ": no head: " in line:
                why = "tissue" if "tetrahedra" in line else "teeth" if "teeth" in line else "bone"
                refused[why] = refused.get(why, 0) + 1
        checked, _ = run(gnathos, "check", case)
        if checked.returncode:
            faults.append(f"random head {seed}: {checked.stderr.strip()}")
        if seed <= a.predicted:
            out = record(case + "_outcome.json", gnathos, "predict", case, "--plan", plan, "-o", case + "_outcome")
            if out["status"]:
                faults.append(f"random head {seed}: {out['message']}")
    print(f"{a.random} random heads of {draws} draws; draws refused: {refused or 'none'}; {a.predicted} predicted")
    print("\n".join(faults) if faults else "no fault")
    return 1 if faults else 0


sys.exit(main())
