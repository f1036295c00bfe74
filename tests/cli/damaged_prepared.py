"""damaged_prepared.py GNATHOS CASE: a prepared case that is damaged, foreign or edited is made anew, never read and never a
reason to stop. CASE is prepared; the run is ended once it begins to make it anew, which takes minutes to the end."""
import glob, hashlib, os, shutil, signal, struct, subprocess, sys, tempfile

gnathos, case = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
name, = (os.path.basename(p) for p in glob.glob(os.path.join(case, "prepared", "*.pack")))
whole = open(os.path.join(case, "prepared", name), "rb").read()


def entries():
    """Name: (where its bytes are, how many)."""
    at, found = 16, {}
    while at < len(whole) - 65:
        size, = struct.unpack_from("Q", whole, at + 32)
        found[whole[at:at + 32].rstrip(b"\0").decode()] = at + 40, size
        at += 40 + size
    return found


def signed(data):
    """With the checksum that belongs to what it holds now."""
    at, sum = 16, hashlib.sha256()
    while at < len(data) - 65:
        size, = struct.unpack_from("Q", data, at + 32)
        sum.update(data[at:at + 32] + data[at + 40:at + 40 + size])
        at += 40 + size
    return data[:-65] + sum.hexdigest().encode() + b"\0"


def put(name, kind, value, sign=True):
    at, _ = entries()[name]
    data = bytearray(whole)
    struct.pack_into(kind, data, at, value)
    return signed(bytes(data)) if sign else bytes(data)


def length(entry, size):
    at, _ = entries()[entry]
    data = bytearray(whole)
    struct.pack_into("Q", data, at - 8, size)
    return bytes(data)


damages = {
    "empty": b"",
    "torn after 100 bytes": whole[:100],
    "torn in the middle": whole[:len(whole) // 2],
    "its last byte missing": whole[:-1],
    "other bytes behind it": whole + b"more",
    "zeros": bytes(len(whole)),
    "text": b"{}\n" * 1000,
    "a byte turned": put("skin.xyz", "<d", 1e3, sign=False),
    "a length of 2^56": length("skin.xyz", 2**56),
    "a length that wraps": length("skin.xyz", 2**64 - 8),
    "of another case": put("hash", "<64s", b"0" * 64),
    "a corner of no vertex": put("skin.tri", "<i", 2**30),
    "a corner below 0": put("tet.node", "<i", -1),
    "a place that is no number": put("node.xyz", "<d", float("nan")),
    "a distance that is no number": put("field.cranium.value", "<f", float("nan")),
    "a distance of no place": put("field.cranium.block", "<i", 2**30),
    "a segment of no bone": put("node.segment", "<i", 99),
}
work, failed = tempfile.mkdtemp(), []
try:
    place = os.path.join(work, name)
    for what, data in damages.items():
        open(place, "wb").write(data)
        run = subprocess.Popen([gnathos, "prepare", case, "--cache", work, "--progress=plain"], stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
        first = run.stderr.readline()  # the first step of making it anew
        run.send_signal(signal.SIGTERM)
        said = first + run.communicate()[1]
        if run.returncode != 130 or not first.startswith("surfaces"):
            failed.append(f"{what}: status {run.returncode}: {said[:300]}")
    open(place, "wb").write(whole)
    run = subprocess.run([gnathos, "prepare", case, "--cache", work], capture_output=True, text=True)
    if run.returncode or "was prepared already" not in run.stdout:
        failed.append(f"a whole one is not taken: status {run.returncode}: {run.stderr[:300]}{run.stdout[:100]}")
finally:
    shutil.rmtree(work)
print(*(f"FAIL: {f}" for f in failed), f"{len(damages)} damages, {len(failed)} not as expected", sep="\n")
sys.exit(bool(failed))
