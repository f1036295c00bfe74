#!/usr/bin/env python3
"""identities.py GNATHOS FOLDER [--norm N] [--held N] [--fitted N] [--random N] [--predicted N] [--data DATA]

Learns identities from norm heads and tells how good they are: fits of heads that were held out and of the two real ones, what
40 coefficients make of them (norm heads in the template's numbering are taken as they are), random heads and predictions of them. FOLDER keeps what is done; the same command goes on from
there, and does again what failed. Fails if a fitted head is off by more than 0.5 mm in the mean or 1.5 mm at 95 % of the skin
or 0.8 mm in the mean of a bone or has a tetrahedron inside out, a held-out head is made with more than 0.5 mm in the mean or
3.3 mm at most over the face, or a random head cannot be had. What needs the scans in DATA (GNATHOS_DATA) is left out, and
said so, where they are not there."""
import argparse
import json
import os
import shutil
import subprocess
import sys
import time

PARTS = ["face", "skin", "tissue", "skull", "mandible", "upper teeth", "lower teeth"]


def run(*words):
    start = time.time()
    done = subprocess.run(words, capture_output=True, text=True)
    return done, time.time() - start


def record(path, made, *words):
    """The record that the command prints with --json, kept in path once it is done; what a run that was ended left of the
    folder `made` goes before."""
    if os.path.exists(path):
        with open(path) as f:
            kept = json.load(f)
        if kept["status"] == 0:
            return kept
    if made:
        shutil.rmtree(made, ignore_errors=True)
    done, wall = run(*words, "--json", "--progress=none")
    kept = {"status": done.returncode, "message": done.stderr.strip(), "wall_s": wall}
    if done.returncode == 0:
        kept["record"] = json.loads(done.stdout)
    with open(path + ".part", "w") as f:
        json.dump(kept, f)
    os.rename(path + ".part", path)
    return kept


def fits(gnathos, folder, heads, faults):
    """Fits every head; gives those that were fitted, with the folder of their fit in place of their case."""
    print(f"\n{'fitted head':34} {'skin mm mean/95 %':>18} {'guessed':>8} {'skull':>6} {'mandible':>8} {'min J':>6} "
          f"{'inverted':>8} {'seconds':>7}")
    fitted = []
    for name, case in heads:
        out = os.path.join(folder, f"fit_{name}")
        kept = record(out + ".json", out, gnathos, "fit", case, "-o", out)
        if kept["status"]:
            faults.append(f"{name}: {kept['message']}")
            continue
        r = kept["record"]
        skin, skull, mandible = (r["parts"][p] for p in ("skin", "skull", "mandible"))
        print(f"{name:34} {skin['mean_mm']:9.2f} /{skin['p95_mm']:6.2f}  {100 * skin['guessed_share']:6.1f} % "
              f"{skull['mean_mm']:6.2f} {mandible['mean_mm']:8.2f} {r['tissue']['min_j']:6.3f} {int(r['tissue']['inverted_tets']):8d} "
              f"{kept['wall_s']:7.1f}")
        fitted.append((name, out))
        if skin["mean_mm"] > 0.5 or skin["p95_mm"] > 1.5 or max(skull["mean_mm"], mandible["mean_mm"]) > 0.8:
            faults.append(f"{name}: its fit is farther from the scan than 0.5 / 1.5 mm (skin) or 0.8 mm (bones)")
        if r["tissue"]["inverted_tets"] or not r["tissue"]["min_j"] > 0:
            faults.append(f"{name}: its fit has {int(r['tissue']['inverted_tets'])} tetrahedra inside out")
    return fitted


def projections(gnathos, folder, model, heads):
    print(f"\n{'head from 40 coefficients':34} " + " ".join(f"{p:>13}" for p in PARTS) + "   mm, mean / largest")
    face = []
    for name, case in heads:
        kept = record(os.path.join(folder, f"project_{name}.json"), None, gnathos, "identities", "project", model, case)
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
    words.add_argument("--fitted", type=int, default=10, help="so many of the held-out heads count as fits")
    words.add_argument("--random", type=int, default=100)
    words.add_argument("--predicted", type=int, default=20)
    words.add_argument("--data", default=os.environ.get("GNATHOS_DATA", ""))
    a = words.parse_args()
    gnathos, folder = os.path.abspath(a.gnathos), os.path.abspath(a.folder)
    os.makedirs(folder, exist_ok=True)
    model = os.path.join(folder, "identities.model")
    faults = []
    if not 0 <= a.fitted <= a.held or a.predicted > a.random:
        sys.exit("--fitted may not be more than --held, --predicted not more than --random")
    started, _ = run(gnathos, "--version")
    if started.returncode:
        sys.exit(f"{gnathos} does not run: {started.stderr}")
    if not os.path.exists(os.path.join(a.data, "phantom_head_ct", "skin.ply")):
        print(f"no scans in {a.data or 'GNATHOS_DATA'}: the two real heads are left out")

    if not os.path.exists(model):
        start = time.time()
        if subprocess.run([gnathos, "identities", "learn", "--norm", str(a.norm), "--seed", "1", "-o", model]).returncode:
            return 1
        print(f"learnt in {time.time() - start:.0f} s")
    shown, _ = run(gnathos, "identities", "show", model)
    if shown.returncode:
        print(f"{shown.stderr}Remove it to learn again.")
        return 1
    print(shown.stdout)

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
    real = []
    for name in ("phantom_head_ct", "vtk_fullhead_ct"):
        data, case = os.path.join(a.data, name), os.path.join(folder, name)
        parts = {"--skin": "skin", "--skull": "skull", "--mandible": "mandible", "--upper-teeth": "teeth_upper",
                 "--lower-teeth": "teeth_lower"}
        parts = [w for o, p in parts.items() if os.path.exists(f"{data}/{p}.ply") for w in (o, f"{data}/{p}.ply")]
        if parts and not os.path.exists(case):
            done, _ = run(gnathos, "import", *parts, "--landmarks", f"{data}/landmarks.mrk.json", "-o", case, "-q")
            if done.returncode:
                faults.append(f"{name}: {done.stderr.strip()}")
        if os.path.exists(case):
            real.append((name, case))
    fitted = dict(fits(gnathos, folder, held[:a.fitted] + real, faults))
    real = [(name, fitted.get(name, case)) for name, case in real]
    for name, face in projections(gnathos, folder, model, held):
        if not face or face["mean_mm"] > 0.5 or face["max_mm"] > 3.3:
            faults.append(f"{name}: not within 0.5 mm in the mean and 3.3 mm at most over the face")
    print("\nThe same from fits, whose vertices slide along the surface, and scans")
    projections(gnathos, folder, model, [(f"fit_{name}", fitted[name]) for name, _ in held if name in fitted] + real)

    draws, made, predicted, refused = 0, 0, 0, {}
    plan = os.path.join(folder, "plan.json")
    with open(plan, "w") as f:
        json.dump({"gnathos": 1, "maxilla_advance_mm": 2, "mandible_advance_mm": 2, "override": "one plan for all heads"}, f)
    for seed in range(1, a.random + 1):
        case = os.path.join(folder, f"random_{seed:03d}")
        kept = record(case + ".json", case, gnathos, "identities", "make", model, "--random", "--seed", str(seed),
                      "-o", case)
        if kept["status"]:
            faults.append(f"random head {seed}: {kept['message']}")
            continue
        made += 1
        draws += kept["record"]["draws"]
        for line in kept["message"].splitlines():
            if ": no head: " in line:
                why = "tissue" if "tetrahedra" in line else "teeth" if "teeth" in line else "bone"
                refused[why] = refused.get(why, 0) + 1
        checked, _ = run(gnathos, "check", case)
        if checked.returncode:
            faults.append(f"random head {seed}: {checked.stderr.strip()}")
        if seed <= a.predicted:
            out = record(case + "_outcome.json", case + "_outcome", gnathos, "predict", case, "--plan", plan, "-o",
                         case + "_outcome")
            predicted += not out["status"]
            if out["status"]:
                faults.append(f"random head {seed}: {out['message']}")
    print(f"\n{made} of {a.random} random heads, {draws} draws; draws refused: {refused or 'none'}; "
          f"{predicted} of {a.predicted} predicted")
    print("\n".join(faults) if faults else "no fault")
    return 1 if faults else 0


sys.exit(main())
