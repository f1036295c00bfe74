"""What leaving tissue out saves and costs on a prepared case. Prints CSV; exit status 1 where it costs more than it says.
   scene_head.py GNATHOS CASE PLAN..."""
import json, math, os, struct, subprocess, sys, tempfile


def vertices(path):
    data = open(path, "rb").read()
    head, body = data.split(b"end_header\n", 1)
    assert b"binary_little_endian" in head
    count, kinds, inside = 0, [], False
    for line in head.decode().splitlines():
        word = line.split()
        if word[0] == "element":
            inside = word[1] == "vertex"
            count = int(word[2]) if inside else count
        elif word[0] == "property" and inside:
            kinds.append({"double": "d", "float": "f", "uchar": "B"}[word[1]])
    row = struct.Struct("<" + "".join(kinds))
    return [row.unpack_from(body, row.size * i)[:3] for i in range(count)]


def predict(gnathos, case, plan, out, more):
    subprocess.run([gnathos, "predict", case, "--plan", plan, "-o", out, "--no-pictures", "-q", "-j", "1"] + more,
                   check=True, stdout=subprocess.DEVNULL)
    return json.load(open(os.path.join(out, "outcome.json"))), vertices(os.path.join(out, "skin_after.ply"))


def main(gnathos, case, *plans):
    bad = False
    print("plan,tets,left_out_tets,rounds,said_skin_mm,true_skin_mm,solve_s,full_s,ratio")
    for plan in plans:
        with tempfile.TemporaryDirectory() as folder:
            part, a = predict(gnathos, case, plan, folder + "/part", [])
            full, b = predict(gnathos, case, plan, folder + "/full", ["--full"])
        true = max(map(math.dist, a, b))
        scene = part["scene"]
        said = max([x["skin_error_mm"] or 0 for x in scene["left_out"]])
        seconds = [o["seconds"]["solve_wall"] for o in (part, full)]
        print(f'{os.path.basename(plan)},{scene["tets"]},{scene["left_out_tets"]},{scene["rounds"]},{said:.4f},{true:.4f},'
              f'{seconds[0]:.2f},{seconds[1]:.2f},{seconds[0] / seconds[1]:.2f}', flush=True)
        bad |= true > 1.5 * said + 0.001
    return bad


sys.exit(main(*sys.argv[1:]))
