"""Every question about a surface of a field against every other, and against values that Python works out (field_values.py)."""
import functools
import importlib
import math
import os
import random
import re
import shutil
import sys
import xml.etree.ElementTree as xml

from field_interface import by_c_interface
from field_reader import read_fields
from field_values import box_of, value_at
from file_questions import content, keeps_its_meaning, loads, says_json, scattered
from mesh_files import is_closed, measured, read_mesh, same_mesh, volume
from mend import errors
from program import Wrong, answer, read_json, run, same
from subject import Subject

SAMPLES = 17             # no grid of a random file has more on a side here
PLACES = 60              # so many places are asked for the value there
FORMATS = ("obj", "ply", "off", "stl", "glb", "3mf", "om")
HALVING = 2.0**-24       # of a cell: what is left between both signs after 24 halvings
LIMIT = 1 / 4096         # and keeps so far from samples, and is moved for that
ORACLES = os.environ.get("TARTAN_ORACLES", "")


class FieldSubject(Subject):
    """A surface of a file; the file alone."""

    def __init__(self, path, folder, part=None, tree=None):
        super().__init__(path, folder, part, tree)
        self.options = ["--surface", part] if part else []

    @functools.cached_property
    def fields(self):
        return read_fields(self.path)

    @property
    def samples(self):
        return min(self.fields.grid, SAMPLES)

    def mesh_file(self, name, *options, file=None, samples=None):
        """The content of a file that `mesh` writes."""
        path = os.path.join(self.folder, name)
        answer("mesh", file or self.path, *self.options, "--grid", str(samples or self.samples), "-o", path, *options)
        return content(path)

    def mesh(self, *options, file=None, samples=None):
        self.mesh_file("asked.ply", *options, file=file, samples=samples)
        return read_mesh(os.path.join(self.folder, "asked.ply"))

    @functools.cached_property
    def own_mesh(self):
        return self.mesh()

    def stats(self, *options):
        return self.ask_json("mesh", "--grid", str(self.samples), "--stats", "json", *options)

    def ask_json(self, command, *more):
        return read_json(command, self.ask(command, *more))

    def values(self, places, file=None, surface=None):
        """(value, gradient, word) at each."""
        options = ["--surface", surface] if surface else self.options
        text = "".join(" ".join(map(repr, place)) + "\n" for place in places)
        lines = answer("mesh", file or self.path, *options, "--points", "-", text=text).splitlines()
        same("a line for each place", len(lines), len(places))
        same("what has no value has no sign", [line for line in lines if "-nan" in line][:1], [])
        words = [line.split() for line in lines]
        return [(float(w[0]), tuple(map(float, w[1:4])), w[4]) for w in words]

    @functools.cached_property
    def places(self):
        """Some of the box: on whole numbers, and anywhere."""
        chosen, (low, high) = random.Random(self.part), box_of(self.fields)
        whole = [tuple(float(chosen.randint(-4, 4)) / chosen.choice([1, 1, 2]) for _ in range(3)) for _ in range(PLACES // 3)]
        return whole + [tuple(chosen.uniform(l, h) for l, h in zip(low, high)) for _ in range(PLACES - len(whole))]

    @functools.cached_property
    def grid(self):
        """The samples' coordinates on each axis."""
        low, high = box_of(self.fields)
        longest = max(h - l for l, h in zip(low, high))
        counts = [max(3, math.floor((h - l) / (longest / (self.samples - 1)) + .5) + 1) for l, h in zip(low, high)]
        return [[(l * (n - 1 - i) + h * i) / (n - 1) for i in range(n)] for l, h, n in zip(low, high, counts)]

    def twin(self, more, settings=None):
        """A file with more statements, perhaps with another box and grid; of a formula alone the surface stands there by its name."""
        kept = [text for word, text in self.fields.statements if settings is None or word not in ("box", "grid")]
        if self.fields.bare:
            kept = [f"surface {self.part} = {self.fields.reader.text.strip()}"]
        return self.file("twin.field", "\n".join(kept + [settings or "", more]) + "\n")


def agree(question, got, want):
    """Two lists of values, to the last bit; where there is no value, neither has one."""
    for i, (one, other) in enumerate(zip(got, want)):
        if one != other and not (one != one and other != other):
            raise Wrong(f"{question}, place {i}", one, other)


# ---- values

def values(subject):
    """At some places the field is worth what Python works out of the file's text."""
    for place, (value, _, word) in zip(subject.places, subject.values(subject.places)):
        want, beside = value_at(subject.fields, subject.part, place)
        same("inside or outside", word, "inside" if value < 0 else "outside")
        known = beside == beside and not (value != value and want != want) and value != want
        if known and not abs(value - want) <= beside:
            raise Wrong("the value at a place", f"{value!r} at {place}", f"{want!r}, within {beside:g}")


def gradients(subject):
    """Where differences over 1e-5 and half of that agree, the gradient does, too."""
    chosen = subject.places[-12:]
    around = [tuple(c + (step if i == axis else 0) for i, c in enumerate(p)) for p in chosen for axis in range(3)
              for step in (1e-5, -1e-5, 5e-6, -5e-6)]
    found, near = subject.values(chosen), [value for value, _, _ in subject.values(around)]
    for n, (place, (value, gradient, _)) in enumerate(zip(chosen, found)):
        for axis in range(3):
            a, b, c, d = near[12 * n + 4 * axis:12 * n + 4 * axis + 4]
            whole, half = (a - b) / 2e-5, (c - d) / 1e-5
            size = max(abs(whole), abs(value), 1)
            smooth = all(map(math.isfinite, (a, b, c, d))) and abs(whole - half) < 1e-4 * size and abs(a + b - 2 * value) < 1e-7 * size
            if smooth and size < 1e6 and not abs(gradient[axis] - half) <= 1e-2 * size:
                raise Wrong("the gradient", f"{gradient} at {place}", f"{half} along axis {axis}")


def written_out(subject):
    """The surface as a function, by its name, as it is written in parentheses, at its own coordinates, with its numbers named."""
    body = subject.fields.surfaces[subject.part].body
    named, lets = numbers_named(body)
    by_function = "x, y, z" if not any(part.kind == "at" for part in body.all()) else "a, b, c"      # x of the function is not the coordinate
    twin = subject.twin(f"fn as_function({by_function}) = {body.text}\nsurface by_function = as_function(x, y, z)\n"
                        f"surface in_place = ({body.text})\nsurface at_home = ({subject.part}) at (x, y, z)\nsurface by_name = {subject.part}\n"
                        f"fn reversed_(z, y, x) = {subject.part} at (x, y, z)\nsurface back = reversed_(z, y, x)\n"
                        f"{lets}surface named = {named}\n")
    want = [value for value, _, _ in subject.values(subject.places)]
    for other in ("by_function", "in_place", "at_home", "by_name", "back", "named"):
        agree(f"{other}, as written out", [value for value, _, _ in subject.values(subject.places, file=twin, surface=other)], want)


def numbers_named(body):
    """The formula's text with each number as a name, and the `let` of each; the exponents of powers stay."""
    kept = {id(part) for formula in body.all() if formula.kind == "call" and formula.of == "pow" for part in formula.parts[1].all()}
    texts = sorted({re.sub(r"[()\s]", "", part.text) for part in body.all() if part.kind == "number" and id(part) not in kept})
    names = {text: f"number_{i}" for i, text in enumerate(texts)}
    return renamed(body, names, kept), "".join(f"let {name} = {text}\n" for text, name in names.items())


def renamed(formula, names, kept):
    if id(formula) in kept:
        return formula.text
    parts = [renamed(part, names, kept) for part in formula.parts]
    if formula.kind == "number":
        return names[re.sub(r"[()\s]", "", formula.text)]
    if formula.kind == "call":
        return f"{formula.of}({', '.join(parts)})"
    if formula.kind == "at":
        return f"({parts[3]}) at ({', '.join(parts[:3])})"
    if formula.kind == "negative":
        return f"(-{parts[0]})"
    return f"({parts[0]} {formula.kind} {parts[1]})" if parts else formula.text


# ---- meshes

def closed(subject):
    """The mesh is closed, and measures what its triangles do; it has a vertex on each edge of the grid whose ends differ."""
    mesh = subject.own_mesh
    is_closed("mesh", mesh)
    stats = subject.stats()
    measured("mesh", stats, mesh)
    same("the volume is not below 0", volume(mesh) >= 0, True)
    vertices_at_signs(subject, mesh)


def vertices_at_signs(subject, mesh):
    """By the values of the program itself, which `values` compares with others."""
    axes = subject.grid
    signs = samples_inside(subject, axes)
    crossed = {(place, axis) for place in signs for axis in range(3) if signs[place] != signs.get(step(place, axis), signs[place])}
    found, near = {}, []
    for vertex in mesh.vertices:
        place, axis, share = edge_of(axes, vertex)
        found[place, axis] = vertex
        if LIMIT * 1.001 < share < 1 - LIMIT * 1.001:
            near += halvings(axes, place, axis, share)
    same("vertices, one on each edge", len(found), len(mesh.vertices))
    same("vertices on edges whose ends differ", sorted(set(found) ^ crossed)[:3], [])
    words = [word for _, _, word in subject.values(near)] if near else []
    wrong = [near[i + 1] for i in range(0, len(near), 4) if len(set(words[i:i + 4])) == 1]
    same("signs beside a vertex differ", wrong[:2], [])


def halvings(axes, place, axis, share):
    """The ends of the last bracket in which a vertex was sought, and of its neighbours, of which it may be an end."""
    whole, low = math.floor(share / HALVING), axes[axis][place[axis]]
    width = axes[axis][place[axis] + 1] - low
    along = [low + k * HALVING * width for k in range(whole - 1, whole + 3)]
    return [tuple(v if i == axis else axes[i][place[i]] for i in range(3)) for v in along]


def step(place, axis):
    return tuple(i + (k == axis) for k, i in enumerate(place))


def samples_inside(subject, axes):
    """Those on the box's sides are outside."""
    indices = [(i, j, k) for k in range(len(axes[2])) for j in range(len(axes[1])) for i in range(len(axes[0]))]
    found = subject.values([tuple(axis[i] for axis, i in zip(axes, index)) for index in indices])
    on_side = lambda index: any(i in (0, len(axis) - 1) for axis, i in zip(axes, index))
    return {index: word == "inside" and not on_side(index) for index, (_, _, word) in zip(indices, found)}


def edge_of(axes, vertex):
    """(sample at its low end, axis, share of the edge) of the grid's edge on which a vertex lies."""
    below = [max(i for i in range(len(axis) - 1) if axis[i] <= c or i == 0) for axis, c in zip(axes, vertex)]
    shares = [(c - axis[i]) / (axis[i + 1] - axis[i]) for axis, i, c in zip(axes, below, vertex)]
    off = [min(share, 1 - share) for share in shares]
    axis = off.index(max(off))
    place = tuple(i + (shares[k] > .5) if k != axis else i for k, i in enumerate(below))
    return place, axis, shares[axis]


def same_bytes(subject):
    """Any number of threads, and both engines."""
    ending = random.Random(subject.text).choice(FORMATS)
    want = subject.mesh_file("asked." + ending, "--threads", "1")
    for others in (["--threads", "2"], ["--threads", "4"], ["--engine", "vm"], ["--engine", "vm", "--threads", "3"]):
        same(f"the same {ending} with {' '.join(others)}", subject.mesh_file("asked." + ending, *others) == want, True)


def formats(subject):
    """What other formats hold is what a PLY holds, but for the digits of floats. A GLB has y up, and is in metres."""
    want, metres = subject.own_mesh, subject.fields.unit in (None, "m")
    for ending in ["obj", "off", "3mf", "stl"] + ["glb"] * metres:
        subject.mesh_file("asked." + ending)
        same_mesh(ending, read_mesh(os.path.join(subject.folder, "asked." + ending)), want,
                  lambda v: (v[0], v[2], -v[1]) if ending == "glb" else v)


def of_module(subject):
    """A module gives the mesh that its source gives."""
    built = os.path.join(subject.folder, "built.tnb")
    answer("build", subject.path, "-o", built)
    same("the mesh of the module", subject.mesh_file("asked.ply", file=built) == subject.mesh_file("asked.ply"), True)


def measures_agree(subject):
    """Proven bounds of the volume hold what random places say, and a finer grid brings them together."""
    low, high = box_of(subject.fields)
    whole = math.prod(h - l for l, h in zip(low, high))
    wide, narrow = (subject.ask_json("mesh", "--grid", str(n), "--stats", "json", "--bounds")["volume_bounds"] for n in (8, 16))
    same("the bounds of the volume are in order", 0 <= wide[0] <= narrow[0] * (1 + 1e-12) and narrow[1] <= wide[1] * (1 + 1e-12) and narrow[0] <= narrow[1], True)
    chosen = random.Random(7)
    places = [tuple(chosen.uniform(l, h) for l, h in zip(low, high)) for _ in range(2000)]
    share = sum(word == "inside" for _, _, word in subject.values(places)) / len(places)
    error = 6 * math.sqrt(max(share * (1 - share), 1 / len(places)) / len(places)) * whole
    same("the volume is within its bounds", narrow[0] - error <= share * whole <= narrow[1] + error, True)


def moved(subject):
    """The form at (x - 2, y + 1, z) in a box that is moved so, and stretched twice in a box of twice the size: samples are the same to the
    last bit, since all these numbers are short."""
    name = subject.part
    want = subject.mesh(file=subject.twin("", "box (-4, -4, -4)..(4, 4, 4)\ngrid 9"), samples=9)
    for text, box, change in ((f"surface changed = {name} at (x - 2, y + 1, z)", "box (-2, -5, -4)..(6, 3, 4)", lambda v: (v[0] + 2, v[1] - 1, v[2])),
                              (f"surface changed = {name} at (x/2, y/2, z/2)", "box (-8, -8, -8)..(8, 8, 8)", lambda v: (2 * v[0], 2 * v[1], 2 * v[2]))):
        twin = subject.twin(text, box + "\ngrid 9")
        path = os.path.join(subject.folder, "changed.ply")
        answer("mesh", twin, "--surface", "changed", "-o", path)
        got = read_mesh(path)
        same(f"triangles of {text}", got.triangles == want.triangles, True)
        worst = max((abs(a - b) for one, other in zip(got.vertices, want.vertices) for a, b in zip(one, change(other))), default=0)
        same(f"vertices of {text}", worst <= 1e-6, True)


def sharp(subject):
    """With sharp edges the mesh is closed, too, and the same at any number of threads."""
    mesh = subject.mesh("--sharp")
    is_closed("--sharp", mesh)
    stats = subject.stats("--sharp")
    measured("--sharp", stats, mesh)
    same("--sharp adds vertices", len(mesh.vertices), len(subject.own_mesh.vertices) + stats["sharp"])
    same("--sharp with 4 threads", subject.mesh_file("asked.obj", "--sharp", "--threads", "4") == subject.mesh_file("asked.obj", "--sharp"), True)


def reworked(subject):
    """Subdivided, each triangle is four; smoothed, the triangles are the same; both are closed. With y up, vertices are turned; normals are
    as long as 1, or none."""
    mesh = subject.own_mesh
    finer, smoother = subject.mesh("--subdivide", "1"), subject.mesh("--smooth", "2")
    is_closed("--subdivide", finer)
    same("triangles of --subdivide", len(finer.triangles), 4 * len(mesh.triangles))
    same("triangles of --smooth", smoother.triangles == mesh.triangles, True)
    same_mesh("--up y", subject.mesh("--up", "y"), mesh, lambda v: (v[0], v[2], -v[1]))
    lines = [line.split() for line in subject.mesh_file("asked.obj", "--normals").decode().splitlines()]
    lengths = [math.hypot(*map(float, words[1:])) for words in lines if words[:1] == ["vn"]]
    same("a normal for each vertex", len(lengths), len(mesh.vertices))
    same("normals that are not as long as 1", [n for n in lengths if not (abs(n - 1) < 1e-5 or n == 0)][:2], [])


def open_jumps(subject):
    """What `--jumps open` leaves out is some of the triangles."""
    whole, left = triangles_of(subject.own_mesh), triangles_of(subject.mesh("--jumps", "open"))
    jumps = subject.stats()["jumps"]
    same("--jumps open leaves triangles out, and adds none", left <= whole and (jumps > 0 or left == whole), True)


def triangles_of(mesh):
    return {frozenset(mesh.corners(t)) for t in mesh.triangles}


def by_oracle(subject):
    """The mesh of an independent contourer, where it is at hand: of a cube, without functions of which it has other digits."""
    contour = oracle()
    low, high = box_of(subject.fields)
    body = subject.fields.surfaces[subject.part].body
    text = expanded(subject.fields, body, {}, ("x", "y", "z"))
    if not contour or text is None or len(set(low + (high[0],))) > 2 or len(set(high)) > 1 or len(text) > 20000:
        return
    vertices, triangles = contour.contour(subject.samples, text, low[0], high[0])
    mesh = subject.own_mesh
    same("triangles, as the contourer has them", mesh.triangles == [tuple(t) for t in triangles], True)
    worst = max((abs(a - b) for p, q in zip(mesh.vertices, vertices) for a, b in zip(p, q)), default=0)
    same("vertices, as the contourer has them", worst <= 1e-9 * (high[0] - low[0]), True)


def oracle():
    folder = os.path.join(ORACLES, "field")
    if not ORACLES or not os.path.isfile(os.path.join(folder, "contour.py")):
        return None
    if folder not in sys.path:
        sys.path.insert(0, folder)
    return importlib.import_module("contour")


OTHER_DIGITS = {"sin", "cos", "tan", "exp", "log", "tanh", "atan2"}


def expanded(fields, formula, given, place):
    """The formula's text without names; None where the contourer has other digits, or does not know a part."""
    if formula.kind == "number":
        return repr(formula.of) if formula.of < 1e15 else None
    if formula.kind == "name":
        if formula.of in given:
            return given[formula.of]
        if formula.of in ("x", "y", "z"):
            return place["xyz".index(formula.of)]
        return expanded(fields, fields.definitions[formula.of].body, {}, place)
    if formula.kind == "distance":
        return None
    texts = [expanded(fields, part, given, place) for part in formula.parts[:3 if formula.kind == "at" else None]]
    if None in texts:
        return None
    if formula.kind == "at":
        return expanded(fields, formula.parts[3], given, tuple(texts))
    if formula.kind == "call":
        return called(fields, formula, texts, place)
    return f"(-{texts[0]})" if formula.kind == "negative" else f"({texts[0]}{formula.kind}{texts[1]})"


def called(fields, formula, texts, place):
    own = fields.definitions.get(formula.of)
    if own:
        return expanded(fields, own.body, dict(zip(own.params, texts)), place)
    broken = formula.of == "pow" and not re.fullmatch(r"-?\d+", formula.parts[1].text)
    return None if formula.of in OTHER_DIGITS or broken else f"{formula.of}({', '.join(texts)})"


# ---- slices and pictures

def slices(subject):
    """At each layer's height, samples of the grid are inside of the outlines where they are inside of the form."""
    low, high = box_of(subject.fields)
    height = (high[2] - low[2]) / 3
    path = os.path.join(subject.folder, "asked.cli")
    options = ["--grid", str(subject.samples), "--layer", repr(height)]
    subject.ask("slice", *options, "-o", path)
    axes = subject.grid
    for z, lines in layers(content(path).decode()):
        places = [(x, y, z) for x in axes[0][1:-1] for y in axes[1][1:-1]]
        found = subject.values(places) if places else []
        wrong = [p for p, (_, _, word) in zip(places, found) if sum(around(p, line) for line in lines) % 2 != (word == "inside")]
        same("samples inside of a slice's outlines", wrong[:3], [])
    want = content(path)
    for others in (["--threads", "4"], ["--engine", "vm"]):
        subject.ask("slice", *options, "-o", path, *others)
        same(f"the same slices with {' '.join(others)}", content(path) == want, True)
    drawn = os.path.join(subject.folder, "asked.svg")
    subject.ask("slice", *options, "-o", drawn)
    parses("slices", drawn)


def layers(text):
    """(height, lines of points) of each layer of a CLI file, each line closed."""
    made = []
    for line in text.splitlines():
        if line.startswith("$$LAYER/"):
            made.append((float(line[8:]), []))
        elif line.startswith("$$POLYLINE/"):
            numbers = [float(word) for word in line[11:].split(",")[3:]]
            points = list(zip(numbers[::2], numbers[1::2]))
            same("an outline is closed", points[0], points[-1])
            made[-1][1].append(points)
    return made


def around(place, line):
    """Does the line run around the place?"""
    x, y = place[:2]
    return sum((a[1] > y) != (b[1] > y) and x < (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) + a[0] for a, b in zip(line, line[1:])) % 2


def parses(question, path):
    try:
        return xml.parse(path).getroot()
    except xml.ParseError as wrong:
        raise Wrong(f"{question}: XML", wrong, "XML") from None


def pictures(subject):
    """The same at any number of threads; an SVG is XML, a PNG a PNG."""
    for ending in ("svg", "png"):
        paths = [os.path.join(subject.folder, f"{threads}.{ending}") for threads in "14"]
        for threads, path in zip("14", paths):
            subject.ask("draw", "--grid", str(subject.samples), "--threads", threads, "--width", "200", "-o", path)
        same(f"the same {ending} with 4 threads", content(paths[0]) == content(paths[1]), True)
    parses("draw", os.path.join(subject.folder, "1.svg"))
    same("a PNG begins as one", content(paths[0])[:8], b"\x89PNG\r\n\x1a\n")


def evolved(subject, study):
    """The folder of a run of the study, which is the same with another number of threads; None where a parent measures a distance."""
    folders = [os.path.join(subject.folder, f"run-{threads}") for threads in "13"]
    for threads, folder in zip("13", folders):
        shutil.rmtree(folder, ignore_errors=True)
        code, _, err = run("evolve", study, "-o", folder, "--threads", threads, "--seed", "5")
        if code == 1 and "distance" in err and 'distance("' in subject.text:
            return None
        same("evolve ends with", (code, err[:200] if code else ""), (0, ""))
    same("a run with 3 threads", *(content(os.path.join(folder, "run.sqlite")) == content(os.path.join(folders[0], "run.sqlite")) for folder in folders))
    return folders[0]


def bred(subject):
    """A run is the same with any number of threads. The parent that it begins with has the same values, and each child can be checked."""
    name = os.path.basename(subject.path)
    study = subject.file("bred.study", f'evolution {{\n  parent "{name}:{subject.part}"\n  parent "torus" weight 0.4\n  population 6\n  generations 2\n'
                                       "  grid 7\n  mutation-rate 0.5\n  nudge 3\n  fitness volume target 20\n}\n")
    folder = evolved(subject, study)
    if folder is None:
        return
    for member in ("0", "9"):
        path = subject.file("replayed.field", answer("runs", "replay", folder, member))
        same("an individual that is replayed has errors", errors(path), [])
        if member == "0":
            got = answer("mesh", path, "--points", "-", text="".join(" ".join(map(repr, place)) + "\n" for place in subject.places))
            agree("the first parent", [float(line.split()[0]) for line in got.splitlines()], [value for value, _, _ in subject.values(subject.places)])


def limits(subject):
    """A limit that is passed ends with 4 and leaves no file; one that is not changes nothing."""
    path = os.path.join(subject.folder, "limited.ply")
    count = len(subject.own_mesh.triangles)
    for limit, passed in ((["--max-samples", "8"], True), (["--max-triangles", str(max(1, count))], False),
                          (["--max-triangles", str(max(1, count - 1))], count > 1)):
        code, _, _ = run("mesh", subject.path, *subject.options, "--grid", str(subject.samples), "-o", path, *limit)
        same(f"{' '.join(limit)} ends with", code, 4 if passed else 0)
        same(f"{' '.join(limit)} leaves a file", os.path.exists(path), not passed)
        if not passed:
            os.unlink(path)
    code, _, _ = run("mesh", subject.path, *subject.options, "--grid", "40", "-o", path, "--memory-limit", "1")
    same("--memory-limit ends with 0 or 4, and leaves a file with 0 alone", (code in (0, 4), os.path.exists(path)), (True, code == 0))
    if code == 0:
        os.unlink(path)


QUICK = [values]
OF_FIELDS = [loads, keeps_its_meaning, scattered, says_json]
OF_SURFACES = [gradients, written_out, closed, same_bytes, formats, of_module, measures_agree, moved, sharp, reworked, open_jumps, by_oracle, slices, pictures, bred,
               limits, by_c_interface]
