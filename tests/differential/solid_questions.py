"""Every question about a design of boxes against every other, and against what Python works out (solid_reference.py, and an independent
reference where it is at hand)."""
import functools
import importlib
import math
import os
import random
import re
import sys
from fractions import Fraction

import mesh_files
from field_questions import evolved, layers, parses
from file_questions import content, keeps_its_meaning, loads, says_json, scattered
from mend import errors
from mesh_files import Mesh, close, is_closed, measured, read_mesh, same_mesh
from program import Refused, Wrong, answer, read_json, run, same
from solid_reader import Box, read_solids, value_of
from solid_reference import Squashed, Unknown, measures, on_lattice
from subject import Subject

ORACLES = os.environ.get("TARTAN_ORACLES", "")
MEASURES = ("width height depth volume mass area centre-x centre-y centre-z inertia-x inertia-y inertia-z boxes voids ghosts squashed inward parts "
            "weakest footprint support overhang shadow-x shadow-y shadow-z stable").split()
NOTHING = "E1512"                    # the error of a design of which nothing is left


class SolidSubject(Subject):
    """A design of a file; the file alone."""

    def __init__(self, path, folder, part=None, tree=None):
        super().__init__(path, folder, part, tree)
        self.options = ["--solid", part] if part else []

    @functools.cached_property
    def designs(self):
        return read_solids(self.path)[0]

    @property
    def design(self):
        return self.designs[self.part]

    @functools.cached_property
    def squashed(self):
        """How the reference squashes it; None where it does not know."""
        try:
            return Squashed(self.design)
        except Unknown:
            return None

    @functools.cached_property
    def measured(self):
        """All measures of the design; None where nothing of it is left."""
        return self.measures_of(f"solid asked from {self.part} {{\n}}\n", "asked")

    def measures_of(self, text, name):
        """All measures of a design in a file with this design more; of what the file alone says nothing is asked."""
        path = self.file("twin.solid", self.text + text.replace("}", f"  measure {', '.join(MEASURES)};\n}}", 1))
        code, out, err = run("test", "--json", path)
        found = [s["measures"] for s in read_json("test", out).get("solids", []) if s["name"] == name]
        if not found and code == 1 and f"error[{NOTHING}]" in err:
            return None
        if not found:
            raise Refused(re.search(r"error\[(E\d+)\]", err)[1], code == 4)
        made = {measure: found[0][measure] for measure in MEASURES}
        same("measures without a value", [measure for measure, value in made.items() if value is None], [])
        return made

    def design_of(self, boxes, *without, axes=None):
        """The text of a design with these boxes and the settings of this one."""
        symmetry = f"  symmetry {', '.join(axes)};\n" if axes else ""
        return f"solid asked {{\n{symmetry}{self.design.settings_text(*without, *(['symmetry'] if axes else []))}" + \
            "".join(box.text(f"box-{i}") for i, box in enumerate(boxes)) + "}\n"

    def mesh_file(self, name, *options, file=None):
        path = os.path.join(self.folder, name)
        answer("mesh", file or self.path, *self.options, "-o", path, *options)
        return content(path)

    @functools.cached_property
    def own_mesh(self):
        """With y up, as it is written."""
        self.mesh_file("asked.ply", "--up", "y")
        return read_mesh(os.path.join(self.folder, "asked.ply"))


def designs_of(path):
    return read_solids(path)[1]


def left(question):
    """Asks only of designs of which something is left."""
    @functools.wraps(question)
    def asked(subject):
        if subject.measured is not None:
            question(subject)
    return asked


def agree(question, got, want, names, tolerance=1e-9):
    for name in names:
        size = max(1, abs(float(want[name])))
        if not abs(got[name] - float(want[name])) <= tolerance * size:
            raise Wrong(f"{question}: {name}", got[name], float(want[name]))


# ---- measures

def measures_by_reference(subject):
    """Of designs without planes all is worked out from their faces."""
    if subject.squashed is None or any(box.plane for box in subject.design.boxes) and "noclip" not in subject.design.settings:
        return
    want = measures(subject.design)
    same("whether something is left", subject.measured is not None, want is not None)
    if want:
        agree("measures of boxes", subject.measured, want, MEASURES)


def history(subject):
    """`explain` says faces that are those of the reference."""
    if subject.squashed is None:
        return
    faces = [(list(map(float, box.low)), list(map(float, box.high))) for box in subject.design.boxes]
    gone = [any(l >= h for l, h in zip(*f)) for f in faces]
    code, out, err = run("explain", "--json", subject.path, *subject.options)
    same("explain --json is read", code == 0 or NOTHING in err, True)
    if code:
        return
    names = names_of(subject.design)
    for step in read_json("explain", out):
        i = names.index(step["box"])
        faces[i][step["side"] == "high"]["xyz".index(step["axis"])] = step["after"]
        gone[i] |= not step["left"]
    for name, (low, high), box_gone, cell in zip(names, faces, gone, subject.squashed.cells):
        same(f"{name} is gone", box_gone, cell.gone)
        if not cell.gone:
            worst = max(abs(a - float(b)) for a, b in zip(low + high, cell.low + cell.high))
            same(f"faces of {name}", worst <= 1e-12 * max(1, *map(abs, low + high)), True)


def names_of(design):
    return [f"box {i + 1}" if box.genes else box.name for i, box in enumerate(design.boxes)]


def by_oracle(subject):
    """Volume, area, parts and centre of mass by an independent reference, where it is at hand."""
    ref = oracle()
    if not ref or subject.squashed is None:
        return
    cells = [ref.clip(box) for box in images(ref, subject)]
    cells = [cell for cell in cells if cell[0]]
    same("whether something is left", subject.measured is not None, bool(cells))
    if not cells:
        return
    totals = [ref.volume(*cell) for cell in cells]
    volume = float(sum(v for v, _ in totals))
    if volume < 1e-6:
        return
    vertices, polygons, contacts = ref.union_surface(cells)
    want = {"volume": volume, "area": sum(polygon_area(vertices, polygon) for polygon in polygons)}
    for a, name in enumerate("xyz"):
        want[f"centre-{name}"] = float(sum(moment[a] for _, moment in totals)) / volume
        values = [float(v[a]) for cell in cells for v in cell[0]]
        want[("width", "height", "depth")[a]] = max(values) - min(values)
    agree("measures of clipped boxes", subject.measured, want, list(want), 1e-7)


def images(ref, subject):
    """The boxes that the reference of this folder has squashed, as those of the independent one."""
    design = subject.design
    for group in subject.squashed.groups:
        for cell, box in zip(subject.squashed.cells, design.boxes):
            made = ref.Box()
            made.lo, made.hi, made.void = list(map(float, cell.low)), list(map(float, cell.high)), cell.gone
            made.plane = bool(box.plane) and "noclip" not in design.settings
            made.n, made.d = plane_of(ref, box) if made.plane else ([1.0, 0.0, 0.0], 0.0)
            made.infl, made.base, made.mir = box.rigid, cell.number, ""
            yield ref._img(made, group)


def plane_of(ref, box):
    if box.plane[0] == "angles":
        return ref.normal(float(box.plane[2]), float(box.plane[3])), float(box.plane[1])
    normal, point = ([float(v) for v in part] for part in box.plane[1:])
    length = math.sqrt(sum(v * v for v in normal))
    centre = [(float(l) + float(h)) / 2 for l, h in zip(box.low, box.high)]
    return [v / length for v in normal], sum(v / length * (p - c) for v, p, c in zip(normal, point, centre))


def polygon_area(vertices, polygon):
    first, total = vertices[polygon[0]], (0.0, 0.0, 0.0)
    for a, b in zip(polygon[1:], polygon[2:]):
        turn = mesh_files.cross(mesh_files.minus(vertices[a], first), mesh_files.minus(vertices[b], first))
        total = tuple(t + u for t, u in zip(total, turn))
    return math.sqrt(mesh_files.dot(total, total)) / 2


def oracle():
    folder = os.path.join(ORACLES, "solid")
    if not ORACLES or not os.path.isfile(os.path.join(folder, "ref.py")):
        return None
    if folder not in sys.path:
        sys.path.insert(0, folder)
    return importlib.import_module("ref")


@left
def requirements(subject):
    """`test` says of each requirement what its measures say."""
    path = subject.file("twin.solid", subject.text + f"solid asked from {subject.part} {{\n}}\n")
    code, _, err = run("test", path, "--diagnostics=json")
    found = [d for d in read_json("test --diagnostics=json", err or "[]") if d["code"] == "E1514" and d["message"].startswith("`asked`")]
    broken = [text for tree, text in subject.design.requirements if not holds(tree, subject.measured)]
    near = [text for tree, text in subject.design.requirements if any(holds(tree, nudged(subject.measured, s)) != holds(tree, subject.measured)
                                                                     for s in (1e-9, -1e-9))]
    if not near:
        same("requirements that do not hold", len(found), len(broken))
        same("exit code of test", code == 1 or not broken, True)


def holds(tree, values):
    value = value_of(tree, values)
    return math.isfinite(value) and value != 0


def nudged(values, by):
    return {name: value + by * max(1, abs(value)) for name, value in values.items()}


# ---- the same design otherwise

@left
def written_out(subject):
    """A design with the boxes of this one by their corners has the same measures; so has one that begins with it."""
    if any(box.plane and box.genes and "flat" in subject.design.settings for box in subject.design.boxes):
        return
    if {"unit", "model"} & set(subject.design.settings):
        return
    agree("written out", subject.measures_of(subject.design_of(subject.design.boxes), "asked"), subject.measured, MEASURES)


def changed(box, change, size=1):
    """Its faces and its plane changed by a function of a coordinate and its axis."""
    faces = [[change(v, a) for a, v in enumerate(corner)] for corner in (box.low, box.high)]
    low, high = [min(pair) for pair in zip(*faces)], [max(pair) for pair in zip(*faces)]
    plane = box.plane
    if plane and plane[0] == "angles":
        plane = (plane[0], plane[1] * size, *plane[2:])
    elif plane:
        plane = (plane[0], plane[1], [change(v, a) for a, v in enumerate(plane[2])])
    return Box(box.name, low, high, plane, box.rigid, box.genes)


@left
def moved(subject):
    """Boxes on a lattice, all moved, or all twice as large."""
    design = subject.design
    if not plain(subject) or design.axes:
        return
    by = (8, -4, 16)
    got = subject.measures_of(subject.design_of([changed(b, lambda v, a: v + by[a]) for b in design.boxes]), "asked")
    want = {**subject.measured, **{f"centre-{name}": subject.measured[f"centre-{name}"] + d for name, d in zip("xyz", by)}}
    agree("moved", got, want, MEASURES, 1e-7)


@left
def scaled(subject):
    design = subject.design
    if not plain(subject):
        return
    got = subject.measures_of(subject.design_of([changed(b, lambda v, a: 2 * v, 2) for b in design.boxes]), "asked")
    powers = {"volume": 3, "mass": 3, "squashed": 3, "area": 2, "weakest": 2, "footprint": 2, "overhang": 2, "shadow-x": 2, "shadow-y": 2, "shadow-z": 2,
              "inertia-x": 5, "inertia-y": 5, "inertia-z": 5, "boxes": 0, "voids": 0, "ghosts": 0, "inward": 0, "parts": 0, "support": 0}
    want = {name: value * 2**powers.get(name, 1) for name, value in subject.measured.items()}
    agree("twice as large", got, want, MEASURES, 1e-7)


def plain(subject):
    """Are all sums of its numbers exact, so that nothing hangs on rounding?"""
    return on_lattice(subject.design) and not {"flat", "unit", "model"} & set(subject.design.settings)


@left
def turned(subject):
    """Axes exchanged, where no box is squashed: x for y, y for z, z for x."""
    design = subject.design
    if not plain(subject) or any(b.plane and b.plane[0] == "angles" for b in design.boxes) or squashed_at_all(subject):
        return
    around = lambda v: [v[1], v[2], v[0]]
    boxes = [Box(b.name, around(b.low), around(b.high), b.plane and ("normal", around(b.plane[1]), around(b.plane[2])), b.rigid, b.genes) for b in design.boxes]
    axes = ["xyz"["yzx".index(axis)] for axis in design.axes]
    got = subject.measures_of(subject.design_of(boxes, axes=sorted(axes)), "asked")
    names = {"width": "height", "height": "depth", "depth": "width"}
    for stem in ("centre", "inertia", "shadow"):
        names.update({f"{stem}-{a}": f"{stem}-{b}" for a, b in zip("xyz", "yzx")})
    for name in ("volume", "area", "boxes", "voids", "ghosts", "parts", "weakest"):
        names[name] = name
    agree("turned", got, {name: subject.measured[of] for name, of in names.items()}, names)


def squashed_at_all(subject):
    return bool(read_json("explain", subject.ask("explain", "--json")))


@left
def split(subject):
    """A box in two halves that meet, where no box is squashed, each cut by the plane that cuts the whole."""
    design = subject.design
    if not plain(subject) or squashed_at_all(subject) or "noclip" not in design.settings and any(b.plane and b.plane[0] == "angles" for b in design.boxes):
        return
    chosen = random.Random(subject.text)
    which, a = chosen.randrange(len(design.boxes)), chosen.randrange(3)
    whole = design.boxes[which]
    middle = (whole.low[a] + whole.high[a]) / 2
    halves = [Box(whole.name, put(whole.low, a, low), put(whole.high, a, high), whole.plane, whole.rigid, whole.genes)
              for low, high in ((whole.low[a], middle), (middle, whole.high[a]))]
    if any(l >= h for l, h in zip(whole.low, whole.high)):
        return
    got = subject.measures_of(subject.design_of(design.boxes[:which] + halves + design.boxes[which + 1:]), "asked")
    agree("a box in halves", got, subject.measured, ["width", "height", "depth", "volume", "area", "centre-x", "centre-y", "centre-z", "inertia-x", "parts",
                                                     "footprint", "overhang", "support", "shadow-x", "shadow-y", "shadow-z", "stable"], 1e-7)


def put(values, axis, value):
    return [value if a == axis else v for a, v in enumerate(values)]


@left
def on_grid(subject):
    """With faces on whole 1/1024ths, nothing moves that lies on 64ths."""
    if not plain(subject) or not subject.design.boxes:
        return
    got = subject.measures_of(f"solid asked from {subject.part} {{\n  unit 1/1024;\n}}\n", "asked")
    same("with a unit", got, subject.measured)


# ---- meshes

@left
def closed(subject):
    """The mesh is closed, has no triangle without area, and measures what the design does."""
    mesh, found = subject.own_mesh, subject.measured
    is_closed("mesh", mesh)
    flat = [t for t in mesh.triangles if exact_area(mesh, t) == 0]
    same("triangles without area", flat[:2], [])
    measured("mesh", read_json("mesh --stats", subject.ask("mesh", "--stats", "json")), mesh)
    low, high = mesh_files.bounds(mesh)
    want = {"volume": mesh_files.volume(mesh), "area": mesh_files.area(mesh), "width": high[0] - low[0], "height": high[1] - low[1],
            "depth": high[2] - low[2]}
    agree("measures of the mesh", found, want, want, 1e-8)


def exact_area(mesh, triangle):
    a, b, c = ([Fraction(v) for v in corner] for corner in mesh.corners(triangle))
    turn = mesh_files.cross(mesh_files.minus(b, a), mesh_files.minus(c, a))
    return mesh_files.dot(turn, turn)


@left
def cells(subject):
    """With --cells each box is closed by itself; together they have the volume of all."""
    groups = read_groups(subject.mesh_file("asked.obj", "--cells", "--up", "y").decode())
    total = 0.0
    for name, mesh in groups:
        is_closed(f"cell {name}", mesh)
        total += mesh_files.volume(mesh)
    close("volume of the cells", total, subject.measured["volume"], 1e-8 * max(1, total))
    gone = subject.measured["voids"] + subject.measured["ghosts"]
    same("how many cells", len(groups), subject.measured["boxes"] - gone)


def read_groups(text):
    """(name, mesh of its own vertices) of each group of an OBJ file."""
    vertices, groups = [], []
    for words in (line.split() for line in text.splitlines()):
        if words[:1] == ["v"]:
            vertices.append(tuple(map(float, words[1:4])))
        elif words[:1] == ["g"]:
            groups.append((words[1], []))
        elif words[:1] == ["f"]:
            groups[-1][1].append(tuple(int(word.split("/")[0]) - 1 for word in words[1:]))
    made = []
    for name, faces in groups:
        triangles = [(f[0], b, c) for f in faces for b, c in zip(f[1:], f[2:])]
        used = sorted({v for t in triangles for v in t})
        number = {v: i for i, v in enumerate(used)}
        made.append((name, Mesh([vertices[v] for v in used], [tuple(number[v] for v in t) for t in triangles])))
    return made


@left
def formats(subject):
    """What other formats hold is what a PLY holds, but for the digits of floats. z is up in all but a GLB."""
    subject.mesh_file("z.ply")
    want, metres = read_mesh(os.path.join(subject.folder, "z.ply")), "model" not in subject.design.settings
    same_mesh("ply with z up", want, subject.own_mesh, lambda v: (v[0], -v[2], v[1]))
    for ending in ["obj", "off", "3mf"] + ["glb"] * metres:
        subject.mesh_file("asked." + ending)
        same_mesh(ending, read_mesh(os.path.join(subject.folder, "asked." + ending)), want,
                  lambda v: (v[0], v[2], -v[1]) if ending == "glb" else v)
    same("the same mesh again", subject.mesh_file("asked.obj") == subject.mesh_file("asked.obj"), True)
    for ending in ("dxf", "scad", "stl", "om"):
        subject.mesh_file("asked." + ending)


@left
def of_module(subject):
    built = os.path.join(subject.folder, "built.tnb")
    answer("build", subject.path, "-o", built)
    same("the mesh of the module", subject.mesh_file("asked.ply", file=built) == subject.mesh_file("asked.ply"), True)
    for command in (["test", "--json"], ["explain", "--json", *subject.options]):
        same(f"{command[0]} of the module", run(*command, built)[:2], run(*command, subject.path)[:2])


# ---- slices and pictures

@left
def slices(subject):
    """Areas of slices are those of the mesh, cut at their heights, where it has no corner there."""
    mesh = subject.own_mesh
    low, high = mesh_files.bounds(mesh)
    height = (high[1] - low[1]) / 3.37
    path = os.path.join(subject.folder, "asked.cli")
    subject.ask("slice", "--layer", repr(height), "-o", path)
    for z, lines in layers(content(path).decode()):
        if any(abs(v[1] - z) < 1e-6 for v in mesh.vertices):
            continue
        got = sum((a[0] * b[1] - b[0] * a[1]) / 2 for line in lines for a, b in zip(line, line[1:]))
        close("area of a slice", got, cut_area(mesh, z), 1e-5 * max(1, (high[0] - low[0]) * (high[2] - low[2])))
    drawn = os.path.join(subject.folder, "asked.svg")
    subject.ask("slice", "--layer", repr(height), "-o", drawn)
    parses("slices", drawn)


def cut_area(mesh, y):
    """Of the section at a height, by the sides that the plane cuts from triangles; seen from above, with -z upwards."""
    total = 0.0
    for triangle in mesh.triangles:
        corners = mesh.corners(triangle)
        points = {}
        for k in range(3):
            a, b = corners[k], corners[(k + 1) % 3]
            if (a[1] < y) != (b[1] < y):
                t = (y - a[1]) / (b[1] - a[1])
                points[a[1] < y] = (a[0] + t * (b[0] - a[0]), -(a[2] + t * (b[2] - a[2])))
        if points:
            p, q = points[True], points[False]           # from where the triangle's edge rises through the plane to where one falls
            total += (p[0] * q[1] - q[0] * p[1]) / 2
    return abs(total)


@left
def pictures(subject):
    """Each kind of picture is XML, and is the same again."""
    paths = [os.path.join(subject.folder, name) for name in ("1.svg", "2.svg")]
    for options in ([], ["--before"], ["--exploded"], ["--sheet"]):
        for path in paths:
            subject.ask("draw", *options, "-o", path)
        same(f"the same picture again {options}", *map(content, paths))
        parses("draw", paths[0])
    subject.ask("explain", "-o", paths[0])
    parses("explain", paths[0])
    subject.ask("draw", "-o", os.path.join(subject.folder, "1.png"))
    same("a PNG begins as one", content(os.path.join(subject.folder, "1.png"))[:8], b"\x89PNG\r\n\x1a\n")


@left
def bred(subject):
    """A run is the same with any number of threads, and each design that it makes can be checked, if anything of it is left."""
    subject.file("skeleton.solid", subject.design_of(subject.design.boxes, "unit"))
    most = max(8, len(subject.design.boxes))
    study = subject.file("bred.study", 'evolution {\n  design "skeleton.solid"\n  region "(-4, -4, -4)..(4, 4, 4)"\n  sizes 0.5..4\n'
                                       f"  boxes 1..{most}\n  population 6\n  generations 2\n  split 0.3\n  delete 0.3\n  fitness volume target 10\n}}\n")
    folder = evolved(subject, study)
    for member in ("0", "9", "14"):
        path = subject.file("replayed.solid", answer("runs", "replay", folder, member))
        same("a design that is replayed has errors", [error for error in errors(path) if error["code"] != "E1512"], [])


@left
def limits(subject):
    """A limit that is passed ends with 4 and leaves no file."""
    path, count = os.path.join(subject.folder, "limited.obj"), subject.measured["boxes"]
    for most, passed in ((count, False), (count - 1, True)):
        if most < 1:
            continue
        code, _, _ = run("mesh", subject.path, *subject.options, "-o", path, "--max-boxes", f"{most:g}")
        same(f"--max-boxes {most:g} of {count:g} ends with", code, 4 if passed else 0)
        same(f"--max-boxes {most:g} leaves a file", os.path.exists(path), not passed)
        if not passed:
            os.unlink(path)


QUICK = [measures_by_reference]
OF_SOLIDS = [loads, keeps_its_meaning, scattered, says_json]
OF_DESIGNS = [history, by_oracle, requirements, written_out, moved, scaled, turned, split, on_grid, closed, cells, formats, of_module, slices, pictures, bred,
              limits]
