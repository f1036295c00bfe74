"""run_kills.py GNATHOS [CASE [KILLS [SEED]]]: kill -9 at random moments; every third while files are being written.

Two commands that write into one place take turns, so that an earlier result stands whenever one is killed. Right is:
afterwards the place holds the earlier result whole or the new one whole, no process goes on, the next run ends well, and
nothing else is left. Without a CASE it is stress --force, four times; with one (a folder) KILLS (60) of predict --force,
audit --force, prepare and study. Prints a table. Times and memory in a record are not compared."""
import ctypes, hashlib, json, os, random, select, shutil, signal, struct, subprocess, sys, tempfile, time

gnathos = os.path.abspath(sys.argv[1])
chance = random.Random(int(sys.argv[4]) if len(sys.argv) > 4 else 1)
libc = ctypes.CDLL(None, use_errno=True)
MODIFY, CREATE, MOVED_TO = 2, 0x100, 0x80


class watch:
    """Tells what happens in folders."""

    def __init__(self, folders, events):
        self.fd, self.events, self.at = libc.inotify_init1(os.O_CLOEXEC), events, {}
        for folder in folders:
            os.makedirs(folder, exist_ok=True)
            self.add(folder)

    def add(self, folder):
        self.at[libc.inotify_add_watch(self.fd, folder.encode(), self.events)] = folder

    def next(self, run):
        """Path and event of what happens next; None once the run has ended."""
        while run.poll() is None:
            if select.select([self.fd], [], [], 0.1)[0]:
                number, event, _, size = struct.unpack_from("iIII", data := os.read(self.fd, 4096))
                return os.path.join(self.at[number], data[16:16 + size].rstrip(b"\0").decode()), event
        return None

    def writing(self, run):
        """Waits for a write into a hidden file, or for a file in a hidden folder."""
        while (seen := self.next(run)) and not (seen[0].endswith(".part") and seen[1] & MODIFY) and ".part/" not in seen[0]:
            if seen[0].endswith(".part") and os.path.isdir(seen[0]):
                self.add(seen[0])


def timeless(value):
    if isinstance(value, dict):
        return {k: timeless(v) for k, v in value.items() if not k.endswith(("seconds", "_s", "memory_MB"))}
    return [timeless(v) for v in value] if isinstance(value, list) else value


def whole(path):
    """What a file holds but for times; refuses a file that is not whole."""
    data = open(path, "rb").read()
    name = os.path.basename(path)
    if name.endswith(".json"):
        return timeless(json.loads(data))
    if name.endswith(".pack"):
        at, sum = 16, hashlib.sha256()
        while at < len(data) - 65:
            size, = struct.unpack_from("Q", data, at + 32)
            sum.update(data[at:at + 32] + data[at + 40:at + 40 + size])
            at += 40 + size
        assert data[-65:-1].decode() == sum.hexdigest(), path
    return data.count(b"\n") if name.startswith("stress.") else data


def files(place):
    found = [os.path.join(folder, n) for folder, _, names in os.walk(place) for n in names]
    return {os.path.relpath(f, place): whole(f) for f in found if ".part" not in os.path.relpath(f, place)}


def hidden(where):
    return sum(n.endswith(".part") for _, below, names in os.walk(where) for n in below + names)


def start(command):
    return subprocess.Popen([gnathos] + command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True)


def run_to_end(command):
    begin, run = time.time(), start(command)
    said = run.communicate()[1].decode()
    if run.returncode:
        sys.exit(f"FAIL: gnathos {' '.join(command)} ends with {run.returncode}: {said}")
    return time.time() - begin


def kill_once(command, folders, while_writing, lasts, tally):
    seen = watch(folders, MODIFY | CREATE)
    run = start(command)
    if while_writing:
        seen.writing(run)
    time.sleep(chance.uniform(0, 0.2 if while_writing else lasts))
    tally["late"] += run.poll() is not None
    run.kill()
    run.communicate()
    os.close(seen.fd)
    for _ in range(40):  # children have the session's number as their group
        try:
            os.killpg(run.pid, 0)
        except ProcessLookupError:
            return
        time.sleep(0.05)
    tally["going on"] += 1
    os.killpg(run.pid, signal.SIGKILL)


def tell(name, count, tally):
    print(f"{name:8} killed {count:3} times ({tally['late']} had ended): {tally['earlier']} earlier whole, {tally['new']} new "
          f"whole, {tally['neither']} neither; {tally['going on']} went on; left after the next run: {tally['left']}", flush=True)
    return not tally["neither"] and not tally["left"] and not tally["going on"]


def counts():
    return dict.fromkeys(("late", "earlier", "new", "neither", "going on", "left"), 0)


def exchanged(name, commands, place, count):
    """Two commands that replace each other's result."""
    lasts, right, tally, now = [], [], counts(), 1
    for command in commands:
        lasts.append(run_to_end(command))
        right.append(files(place))
    for i in range(count):
        other = 1 - now
        kill_once(commands[other], [os.path.dirname(place)], i % 3 == 0, lasts[other], tally)
        found = files(place)
        tally["earlier" if found == right[now] else "new" if found == right[other] else "neither"] += 1
        run_to_end(commands[other])
        tally["neither"] += files(place) != right[other]
        tally["left"] += hidden(os.path.dirname(place))
        now = other
    return tell(name, count, tally)


def prepared(case, count, work):
    """Into an empty folder each time, but for what the killed ones left; the last run goes to its end."""
    cache, first, tally = os.path.join(work, "cache"), os.path.join(work, "first"), counts()
    lasts = run_to_end(["prepare", case, "--cache", first])
    right = files(first)
    for i in range(count):
        kill_once(["prepare", case, "--cache", cache], [cache], i % 3 == 0, lasts, tally)
        found = files(cache)
        tally["earlier" if not found else "new" if found == right else "neither"] += 1
        for name in found:
            os.remove(os.path.join(cache, name))
    run_to_end(["prepare", case, "--cache", cache])
    tally["neither"] += files(cache) != right
    tally["left"] = hidden(work)
    return tell("prepare", count, tally)


def studied(case, plan, count, work):
    """One study that is killed again and again: what is done stays, whole. The last run goes on until it has kept something
    more, and is interrupted then."""
    place, tally = os.path.join(work, "study"), counts()
    command, before = ["study", case, "--plan", plan, "-o", place], {}
    inside = [place, os.path.join(place, "prepared"), os.path.join(place, "runs")]
    for i in range(count):
        kill_once(command, [work] + (inside if before else []), i % 3 == 2, 20, tally)
        found = files(place)
        kept = all(found.get(name) == data for name, data in before.items())
        tally["neither" if not kept else "new" if len(found) > len(before) else "earlier"] += 1
        before = found
    run, seen = start(command), watch(inside, MOVED_TO)
    while (event := seen.next(run)) and not event[0].endswith(".pack"):
        pass
    run.terminate()
    run.communicate()
    tally["left"] = hidden(work)
    return tell("study", count, tally)


def main(work):
    at = lambda name: os.path.join(work, name, "result")
    for name in ("stress", "predict", "audit"):
        os.mkdir(os.path.join(work, name))
    if len(sys.argv) < 3:
        return exchanged("stress", [["stress", "--only", only, "-o", at("stress"), "--force", "-q"]
                                    for only in ("poisson/0.45", "poisson/0.47")], at("stress"), 4)
    case, count = os.path.abspath(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 60
    plans = [os.path.join(work, f"{mm}.json") for mm in (2, 4)]
    for mm, path in zip((2, 4), plans):
        with open(path, "w") as f:
            json.dump({"gnathos": 1, "name": f"{mm} mm", "maxilla_advance_mm": mm}, f)
    predict = [["predict", case, "--plan", p, "-o", at("predict"), "--force", "--no-pictures", "--contact", "off"] for p in plans]
    audit = [["audit", case, "--line", f"{jaw}_advance_mm", "--geometry-only", "--no-pictures", "-o", at("audit"), "--force"]
             for jaw in ("maxilla", "mandible")]
    good = exchanged("predict", predict, at("predict"), count * 20 // 60)
    good = exchanged("audit", audit, at("audit"), count * 18 // 60) and good
    good = prepared(case, count * 12 // 60, work) and good
    return studied(case, plans[0], count - count * 20 // 60 - count * 18 // 60 - count * 12 // 60, work) and good


work = tempfile.mkdtemp()
try:
    if not main(work):
        sys.exit("FAIL: see above")
    print("killed as they may be")
finally:
    shutil.rmtree(work)
