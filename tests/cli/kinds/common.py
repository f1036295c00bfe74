"""What the tables of mistakes share. A row is one instance of a kind of mistake: what is changed in a copy of tests/cli/base,
the command line, and what gnathos must answer. Every row is tried, then all that went wrong is told."""
import os, pathlib, re, shutil, subprocess, sys, tempfile

gnathos = os.path.realpath(sys.argv[1])
here = pathlib.Path(__file__).resolve().parent.parent
work = pathlib.Path(tempfile.mkdtemp(prefix="gnathos_kinds_"))
rows, failures = 0, []


def fresh(name="case"):
    """A new copy of the base case."""
    case = work / name
    shutil.rmtree(case, ignore_errors=True)
    shutil.copytree(here / "base", case)
    return case


def run(*words, cwd=work, seconds=60):
    """Exit status, stdout, stderr; 124 where it does not end."""
    try:
        done = subprocess.run([gnathos, *map(str, words)], cwd=cwd, capture_output=True, timeout=seconds, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return 124, "", ""
    return done.returncode, done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")


def row(name, ok, told=""):
    global rows
    rows += 1
    if not ok:
        failures.append(f"{name}: {told}")


def refused(name, words, status, *patterns, cwd=work):
    """gnathos ends with the status (or one of them), every pattern is found on stderr, each line there is one message, and no
    file changes."""
    before = snapshot(cwd)
    got, out, err = run(*words, cwd=cwd)
    wanted = (status,) if isinstance(status, int) else status
    row(name, got in wanted and all(re.search(p, err) for p in patterns) and one_message_a_line(err) and not out
        and snapshot(cwd) == before, f"status {got}, wanted {status} and {patterns}, unchanged files: {snapshot(cwd) == before}\n{err[:600]}")
    return err


def accepted(name, words, *patterns, cwd=work):
    """gnathos ends with 0 and every pattern is found on stdout or stderr."""
    got, out, err = run(*words, cwd=cwd)
    row(name, got == 0 and all(re.search(p, out + err) for p in patterns) and one_message_a_line(err),
        f"status {got}, wanted 0 and {patterns}\n{out[-300:]}{err[:600]}")


def one_message_a_line(err):
    return all(line.startswith(("gnathos", "Try `gnathos", "information.")) for line in err.splitlines()) and not re.search(r"[\x00-\x09\x0b-\x1f\x7f]", err)


def snapshot(folder):
    return sorted((str(p), p.stat().st_size, p.stat().st_mtime_ns) for p in folder.rglob("*") if p.is_file())


def edit(path, *pairs):
    text = path.read_text()
    for old, new in pairs:
        assert old in text, (path, old)
        text = text.replace(old, new)
    path.write_text(text)


def add_points(path, **points):
    """Adds landmarks to markups; B_s stands for B'."""
    edit(path, (' { "label": "Po_L"', "".join(f' {{ "label": "{re.sub("_s$", chr(39), name)}", "position": {list(xyz)} }},\n ' for name, xyz in points.items())
               + ' { "label": "Po_L"'))


def finish():
    shutil.rmtree(work, ignore_errors=True)
    print("\n".join(failures))
    print(f"{rows - len(failures)} of {rows} instances answered as they should")
    sys.exit(1 if failures or not rows else 0)
