"""Every question about a surface that grows against every other: its meshes read by Python, and a slow independent reference."""
import functools
import importlib.util
import os
import re
import sys

from file_questions import content, keeps_its_meaning, loads, says_json
from mesh_files import read_mesh
from program import answer, read_json, run, same
from subject import Subject

STEPS, EDGES = "3", "1500"
ORACLES = os.environ.get("TARTAN_ORACLES", "")


class SystemSubject(Subject):
    """A rewrite system, or a study; `limits` keep its surface small."""
    limits = ["-n", STEPS, "--edge-limit", EDGES]

    def grown(self, *more, file=None, ending="obj"):
        """(exit code, the content of the file or None)"""
        path = os.path.join(self.folder, "grown." + ending)
        if os.path.exists(path):
            os.unlink(path)
        code, _, err = run("grow", file or self.path, *self.limits, "-o", path, *more)
        same(f"grow ends with {err[:120]}" if code not in (0, 1, 4) else "grow ends with", code in (0, 1, 4), True)
        return code, content(path) if os.path.exists(path) else None

    @property
    def rules(self):
        """The text of the rewrite system."""
        return self.text

    def options_of_reference(self):
        return {}

    @functools.cached_property
    def surface(self):
        return self.grown("--lines")

    @functools.cached_property
    def steps(self):
        """(statistics, vertices, lines, faces) of each step."""
        path = os.path.join(self.folder, "step.obj")
        code, out, err = run("grow", self.path, *self.limits, "--stats", "json", "--each-step", "--lines", "-o", path)
        if code == 1:
            return []
        made = []
        for i, stats in enumerate(read_json("--stats json", out)):
            made.append((stats, *read_obj(content(os.path.join(self.folder, f"step-{i:03}.obj")).decode())))
        return made


def read_obj(text):
    rows = [line.split() for line in text.splitlines()]
    return [tuple(map(float, r[1:])) for r in rows if r[:1] == ["v"]], *([[int(w) - 1 for w in r[1:]] for r in rows if r[:1] == [word]] for word in "lf")


# ---- surfaces

def meshes(subject):
    """After each step the surface is a disc of one orientation, whose figures are those that are told."""
    for stats, vertices, lines, faces in subject.steps:
        ways = [(a, b) for face in faces for a, b in zip(face, face[1:] + face[:1])]
        same("an edge that has two faces on one side", len(ways), len(set(ways)))
        same("faces with less than three edges", [face for face in faces if len(face) < 3], [])
        edges = {frozenset(line) for line in lines}
        same("edges of faces that are no edges", [w for w in ways if frozenset(w) not in edges][:2], [])
        same("vertices, edges and faces", (stats["V"], stats["E"], stats["F"]), (len(vertices), len(lines), len(faces)))
        same("the Euler number of a disc", len(vertices) - len(lines) + len(faces), 1)
        same("labels of edges", sum(stats["labels"].values()), len(lines))
        sides = {}
        for face in faces:
            sides[str(len(face))] = sides.get(str(len(face)), 0) + 1
        same("sides of faces", stats["face_sides"], sides)


def same_bytes(subject):
    """With any number of threads, and both engines; and the last of all steps."""
    want = subject.surface
    for others in (["--threads", "1"], ["--threads", "4"], ["--engine", "vm"]):
        same(f"grown with {' '.join(others)}", subject.grown("--lines", *others), want)
    if want[0] == 0 and subject.steps:
        last = read_obj(want[1].decode())
        same("the last of all steps", subject.steps[-1][1:], last)


def of_module(subject):
    """A module is grown as its source is; it takes no options."""
    if not subject.steps or subject.steps[-1][0]["E"] > 400:
        return
    built, paths = os.path.join(subject.folder, "built.tnb"), [os.path.join(subject.folder, name) for name in ("source.obj", "module.obj")]
    answer("build", subject.path, "-o", built)
    codes = [run("grow", file, "-o", path)[0] for file, path in zip((subject.path, built), paths)]
    same("the module grown ends with", codes[1], codes[0])
    same("the module grown", os.path.exists(paths[1]) and meat(content(paths[1])), os.path.exists(paths[0]) and meat(content(paths[0])))


def meat(data):
    """Without comments, which tell of files."""
    return re.sub(rb"^[#go].*$", b"", data, flags=re.M)


def formats(subject):
    """Other files have the same vertices; lines are in a DXF. (OpenMesh refuses two edges between the same vertices.)"""
    if not subject.surface[1]:
        return
    subject.grown("-t")
    want = read_mesh(os.path.join(subject.folder, "grown.obj"))
    subject.grown("-t", ending="ply")
    head = re.search(rb"element vertex (\d+)", content(os.path.join(subject.folder, "grown.ply")))
    same("vertices of ply", int(head[1]), len(want.vertices))
    subject.grown(ending="dxf")
    same("a DXF ends", content(os.path.join(subject.folder, "grown.dxf")).decode().split()[-1], "EOF")


def letters(subject):
    """Edges with other names are the same edges."""
    code, data = subject.grown("--lines", file=subject.file("edges.hemls", by_numbers(subject.text)))
    same("grown with other names of edges", (code, data and meat(data)), (subject.surface[0], subject.surface[1] and meat(subject.surface[1])))


def by_numbers(text):
    """Letters as the edges that they are: in the order in which they first appear."""
    lines, names = re.sub(r"(?m)^\s*//.*$", "", text), []
    for name in re.findall(r"\b[A-Z](?=_i|\b)", lines):
        if name not in names:
            names.append(name)
    return re.sub(r"\b([A-Z])(?=_i|\b)", lambda found: f"Edge{names.index(found[1])}", lines)


def limits(subject):
    """A limit of edges ends with 4, and what is written are the last edges within it."""
    if not subject.steps:
        return
    most = subject.steps[-1][0]["E"]
    for limit in {most - 1, most} if most > 12 and subject.surface[0] == 0 else ():
        path = os.path.join(subject.folder, "limited.obj")
        code, out, _ = run("grow", subject.path, "-n", STEPS, "--edge-limit", str(limit), "--stats", "json", "-o", path)
        kept = [stats["E"] for stats, *_ in subject.steps if stats["E"] <= limit]
        if all(a <= b for a, b in zip([s[0]["E"] for s in subject.steps], [s[0]["E"] for s in subject.steps][1:])):
            same(f"--edge-limit {limit} of {most} ends with", code, 0 if limit == most else 4)
            same("edges within the limit", read_json("--stats json", out)[-1]["E"], kept[-1])


def by_reference(subject):
    """As an independent reference grows it, for as long as rounding decides nothing there."""
    oracle = reference()
    if not oracle or "Even" in subject.rules or not subject.steps:
        return
    try:
        grown = oracle.Careful(oracle.ref.parse(by_numbers(subject.rules)), oracle.ref.Options(**subject.options_of_reference()))
    except (oracle.ref.HemlsError, ValueError, IndexError, KeyError):
        return
    for i, (stats, vertices, lines, _) in enumerate(subject.steps):
        try:
            if i:
                grown.step()
        except (oracle.Fragile, ZeroDivisionError):
            return
        positions, _, edges, *_ = grown.mesh()
        same(f"edges of the reference, step {i}", lines, [list(e[:2]) for e in edges])
        same(f"labels of the reference, step {i}", stats["labels"], grown.histogram())
        size = max([1.0] + [abs(c) for p in positions for c in p])
        far = max((abs(a - b) for p, q in zip(positions, vertices) for a, b in zip(p, q)), default=0)
        same(f"vertices of the reference, step {i}", far <= 1e-7 * size, True)


class Oracle:
    pass


@functools.lru_cache(maxsize=1)
def reference():
    """The reference, with a class that stops where rounding would decide, as tests/growth_oracle.py has it."""
    folder = os.path.join(ORACLES, "growth")
    if not ORACLES or not os.path.isfile(os.path.join(folder, "ref.py")):
        return None
    sys.path.insert(0, folder)
    found = Oracle()
    found.ref = importlib.import_module("ref")
    with open(os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "growth_oracle.py"), encoding="utf-8") as file:
        text = file.read()
    scope = {"ref": found.ref, "math": __import__("math")}
    exec(text[text.index("class Fragile"):text.index("def random_system(")], scope)
    found.Careful, found.Fragile = scope["Careful"], scope["Fragile"]
    return found


QUICK = [meshes, by_reference]
OF_SYSTEMS = [loads, keeps_its_meaning, says_json, same_bytes, of_module, formats, letters, limits]
