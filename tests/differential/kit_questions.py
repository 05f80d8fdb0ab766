"""Every question about a model of a kit against every other, and against what Python works out of the text (kit_model.py)."""
import csv
import functools
import io
import os
import re
import xml.etree.ElementTree as xml
from collections import Counter

from c_place import OPTIONS, SEED, placed_by_interface
from file_questions import content, keeps_its_meaning, loads, says_json
from kit_counts import OF_COUNTS
from kit_model import MOST, SIGNS, TURNS, Greedy, Standing, cells_at, has_files, joined_pairs, measures, plus, product, read_ldraw, room_of, turned, value_of
from kit_reader import AXES, Kit
from mesh_files import read_mesh, volume
from program import Wrong, answer, read_json, run, same
from subject import Subject

LIMIT, SEARCH_LIMIT = ["--part-limit", "1500"], ["--search-limit", "400"]
NOTHING, MISSED, NO_ROOM, BLOCKED = "E1314", "E1316", "E1310", "E1341"  # of what stands, the last two: E1341 of a search
MILLIMETRES = .4


class KitSubject(Subject):
    """A model of a file; the file alone."""

    def __init__(self, path, folder, part=None, tree=None):
        super().__init__(path, folder, part, tree)
        self.options = ["--model", part] if part else []

    @functools.cached_property
    def kit(self):
        return read_kit(self.path)

    @property
    def model(self):
        return self.kit.models[self.part]

    @functools.cached_property
    def room(self):
        """(cells that are inside, cells on the edge), where that is known."""
        return room_of(self.kit, self.model.inside)

    def place(self, *more, file=None, ending="ldr"):
        """(what is said where nothing is written, or None; the content of the file)"""
        path = os.path.join(self.folder, "placed." + ending)
        if os.path.exists(path):
            os.unlink(path)
        code, _, err = run("place", file or self.path, "--model", self.part, *self.limits, "-o", path, *more)
        if os.path.exists(path):
            same("place ends with", code in (0, 4), True)
            return None, content(path)
        error = re.search(r"error\[(E\d+)\]", err)
        if code == 4 or not error:
            same("place writes a file", code, 4)
            return "limit", None
        same("place ends with", code, 1)
        return error[1], None

    def ends_in(self):
        """(what is said, the text) as the interface is asked."""
        said, data = self.place("--seed", str(SEED), *OPTIONS[2:])
        return said, data and data.decode()

    @functools.cached_property
    def free(self):
        """The file without what this model requires."""
        lines = "\n".join(f"  {text};" for word, text in self.model.lines if word != "require")
        return self.with_lines(lines)

    def with_lines(self, lines, name="free"):
        """The file with this model alone, made of other lines, and without tests."""
        kept = [text for word, text in self.kit.statements if word not in ("model", "test")]
        head = "\n".join(text if text.rstrip()[-1] in ";}" else text + ";" for text in kept)
        return self.file(f"{name}-{self.part}.kit", f"{head}\nmodel {self.part} {{\n{lines}\n}}\n")

    @functools.cached_property
    def placed(self):
        """The text of the model without what it requires; None where nothing is placed, or a limit is passed."""
        return self.place(file=self.free)[1]

    @functools.cached_property
    def parts(self):
        return read_ldraw(self.placed.decode(), self.kit) if self.placed else []

    @functools.cached_property
    def terms(self):
        sure = self.room and not self.room[1]
        return measures(self.kit, self.parts, self.room[0] if sure else None)

    @property
    def drawn(self):
        """May chance have a part in it?"""
        return any(kind == "drawn" for _, alternatives in self.kit.rules.values() for kind, _ in alternatives)

    @property
    def searched(self):
        return self.model.search not in (None, "greedy")

    @property
    def limits(self):
        return LIMIT + SEARCH_LIMIT * (not self.plain)

    @property
    def plain(self):
        """Is the model placed step by step, by an engine that can be named?"""
        return not (self.searched or self.model.symmetry or self.model.stock or self.model.order == "breadth")


def read_kit(path):
    return Kit(path)


def lines_of(data):
    """Where each part stands, in a file's order."""
    return [line for line in data.decode().splitlines() if line.startswith("1 ")]


# ---- legal

def legal(subject):
    """Parts lie inside of the space, on cells, apart; no more than the stock has; images are there, too."""
    if not subject.parts:
        return
    taken, kit = set(), subject.kit
    for standing in subject.parts:
        same("places on cells", [c for c in standing.at if c.denominator != 1], [])
        own = cells_at(kit, standing)
        same("parts in the room of others", own & taken, set())
        taken |= own
    if subject.room:
        same("cells outside of the space", sorted(taken - subject.room[0] - subject.room[1])[:3], [])
    used = Counter(standing.name for standing in subject.parts)
    same("more than the stock has", [n for n, most in subject.model.stock.items() if used[n] > most], [])
    if subject.model.symmetry:
        symmetric(subject)


def symmetric(subject):
    """The cells of all parts of a name and colour are their own image."""
    way, how = subject.model.symmetry
    by_look = {}
    for standing in subject.parts:
        by_look.setdefault((standing.name, standing.colour), set()).update(cells_at(subject.kit, standing))
    change = {("turn", "2"): lambda x, y, z: (-x - 1, y, -z - 1), ("turn", "4"): lambda x, y, z: (-z - 1, y, x), ("mirror", "x"): lambda x, y, z: (-x - 1, y, z),
              ("mirror", "z"): lambda x, y, z: (x, y, -z - 1)}[way, how]
    for look, cells in by_look.items():
        same(f"{look[0]} is its own image", {change(*cell) for cell in cells} == cells, True)


def by_rules(subject):
    """The parts that the rules say, one after the other, where nothing is drawn or searched."""
    kit, model = subject.kit, subject.model
    known = subject.room and not subject.room[1] and not subject.drawn and not subject.searched and not model.symmetry and not model.steps
    if not known:
        return
    greedy = Greedy(kit, model, subject.room[0], stands_of(subject))
    if len(greedy.parts) >= MOST // 4:
        return
    said, text = subject.place(file=subject.free)
    if not greedy.parts or greedy.blocked:
        same("a model without parts", said in (NO_ROOM, BLOCKED) if greedy.blocked else said == NOTHING, True)
        return
    want = [ldraw(kit, standing) for standing in greedy.parts]
    got = lines_of(text) if text else [said]
    for i in range(max(len(got), len(want))):
        same(f"part {i + 1} by the rules", got[i] if i < len(got) else "none", want[i] if i < len(want) else "none")


def stands_of(subject):
    with open(os.path.join(subject.folder, "stands.ldr"), encoding="utf-8") as file:
        return read_ldraw(file.read(), subject.kit)


def ldraw(kit, standing):
    at = [c * u for c, u in zip(standing.at, kit.unit)]
    return " ".join(["1", str(standing.colour), *(f"{float(c):g}" for c in at), *map(str, standing.matrix), standing.name + ".dat"])


# ---- measures and requirements

def inspected(subject):
    """`inspect` measures what Python does, and holds to conditions as they are."""
    if not subject.placed:
        return
    path = subject.file("seen.ldr", subject.placed.decode())
    code, out, _ = run("inspect", path, "--kit", subject.free, *subject.options, "--json")
    same("inspect ends with", code, 0)
    found = read_json("inspect --json", out)
    for name, want in subject.terms.items():
        if name in found and not abs(found[name] - want) <= 1e-9 * max(abs(want), 1):
            raise Wrong(f"{name} of what was placed", found[name], want)
    elements = len(subject.parts)
    for condition, holds in ((f"elements = {elements}, overlaps = 0", True), (f"elements > {elements}", False), ("components >= 1 and not open < 0", True)):
        same(f"inspect --require {condition}", run("inspect", path, "--kit", subject.path, "--require", condition)[0], 0 if holds else 1)


def holds(subject, conditions):
    """Whether each is true of what was placed; None where that is a matter of digits, or nobody knows."""
    return [truth(condition, subject.terms) for condition in conditions]


def truth(expression, terms):
    if isinstance(expression, tuple) and expression[0] in ("and", "or", "not"):
        found = [truth(part, terms) for part in expression[1:]]
        return None if None in found else SIGNS[expression[0]](*found)
    values = [value_of(part, terms) for part in expression[1:]] if isinstance(expression, tuple) else [value_of(expression, terms)]
    near = any(a is None for a in values) or any(abs(a - b) <= 1e-9 * max(abs(a), abs(b)) and not (a == b and a == int(a)) for a in values for b in values if a is not b)
    return None if near or not isinstance(expression, tuple) or expression[0] not in SIGNS else bool(value_of(expression, terms) > 0)


def requires(subject):
    """What does not meet its requirements is not written; else it is what the model is without them."""
    if subject.searched or not subject.model.requires or not subject.placed:
        return
    found = holds(subject, subject.model.requires)
    if None in found:
        return
    said, text = subject.place()
    same("what requirements say", said, None if all(found) else MISSED)
    if text:
        same("a model that meets what it requires", lines_of(text), lines_of(subject.placed))


def tested(subject):
    """`test` counts the conditions that hold."""
    kit = subject.kit
    if len(kit.models) > 1 or subject.searched or not subject.placed:
        return
    found = holds(subject, subject.model.requires + [c for _, conditions in kit.tests for c in conditions])
    if None in found:
        return
    code, out, _ = run("test", subject.path, "--json")
    said = read_json("test --json", out)
    same("conditions that pass and fail", (said["passed"], said["failed"], code), (sum(found), len(found) - sum(found), int(not all(found))))


# ---- the same

def same_bytes(subject):
    """With any number of threads, both engines, and of a module."""
    said, want = subject.place() if subject.plain else subject.place("--threads", "1")
    for others in [["--engine", "vm"]] if subject.plain else [["--threads", "2"], ["--threads", "4"]]:
        same(f"place with {' '.join(others)}", subject.place(*others), (said, want))
    built = os.path.join(subject.folder, "built.tnb")
    answer("build", subject.path, "-o", built)
    got, text = subject.place(file=built)
    same("the module placed", (got, text and lines_of(text)), (said, want and lines_of(want)))


def moved(subject):
    """A space and starts that are moved, or turned, give the model moved or turned."""
    model = subject.model
    if not subject.placed or has_files(model.inside) or any(len(start) == 2 for start in model.starts):
        return
    by = (3, -2, 4)
    if not model.symmetry:
        compared(subject, "moved", f"at ({written(subject, by)})", lambda at, turn: (plus(at, (by[0], -by[1], by[2])), turn), lambda v: plus(v, (3, 2, 4)), TURNS[0])
    if not model.symmetry or model.symmetry[0] == "turn":
        compared(subject, "turned", "turn 1", lambda at, turn: (turned(TURNS[1], at), turn + 1), lambda v: turned(TURNS[1], v), TURNS[1])


def written(subject, cells):
    return ", ".join(f"{float(c * u):g}" for c, u in zip(cells, subject.kit.unit))


def compared(subject, what, text, change, place, matrix):
    """`change` is of starts, `place` of parts."""
    lines = []
    for word, line in subject.model.lines:
        if word == "inside":
            lines.append(f"inside ({line.partition(' ')[2]}) {text}")
        elif word in ("minimize", "maximize") and matrix != TURNS[0]:
            lines.append(re.sub("width|depth", lambda m: "depth" if m[0].lower() == "width" else "width", line, flags=re.I))
        elif word not in ("start", "require"):
            lines.append(line)
    for kind, axis, at, turn, rule in subject.model.starts:
        at, upright = change(at, turn)
        way = next(name for name, v in AXES.items() if v == turned(matrix, axis))
        turn = upright % 4 if axis[1] else turn            # one that lies is turned about its own axis
        turn = f" turn {turn}" if turn else ""
        lines.append(f"start {kind} {way} at ({written(subject, (at[0], -at[1], at[2]))}){turn} by {rule}")
    file = subject.with_lines("".join(f"  {line};\n" for line in lines), "changed")
    said, data = subject.place(file=file)
    got = [s.key() for s in read_ldraw(data.decode(), subject.kit)] if data else said
    want = [Standing(s.name, s.colour, place(s.at), product(matrix, s.matrix)).key() for s in subject.parts]
    same(f"the model {what}", got, want)


# ---- files

def files(subject):
    """A list of parts, sub-files, and pictures are of the same model."""
    if not subject.placed:
        return
    kit, looks = subject.kit, Counter((s.name, s.colour) for s in subject.parts)
    rows = list(csv.DictReader(io.StringIO(subject.place(file=subject.free, ending="csv")[1].decode())))
    same("parts of the list", {(row["part"], int(row["colour"])): int(row["number"]) for row in rows}, dict(looks))
    for row in rows:
        part, number = kit.parts[row["part"]], int(row["number"])
        same("title of a part", row["name"], part.title)
        for word in ("mass", "price"):
            same(f"{word} in the list", abs(float(row[word]) - number * getattr(part, word)) < 1e-9 * max(1, number), True)
    subfiles = subject.place(file=subject.free, ending="mpd")[1].decode()
    inner = [line for line in subfiles.splitlines() if line.startswith("1 ") and not line.endswith(".ldr")]
    same("parts of sub-files", Counter(inner), Counter(lines_of(subject.placed)))
    for more in ([], ["--sheet"]):
        drawn = subject.place(*more, file=subject.free, ending="svg")
        try:
            xml.fromstring(drawn[1])
        except (xml.ParseError, TypeError) as wrong:
            raise Wrong("the picture is XML", f"{wrong} {drawn[0]}", "XML") from None


def meshes(subject):
    """The mesh is closed, and has the volume of the cells, or of what slopes leave of them."""
    if not subject.placed or " slope " in " " + re.sub(r"[\s{;]+", " ", subject.text.lower()) or "bricks" in subject.text:
        return
    data = subject.place(file=subject.free, ending="off")[1]
    path = os.path.join(subject.folder, "placed.off")
    mesh = read_mesh(path)
    same("the mesh of a model is not empty", bool(data and mesh.triangles), True)
    want = subject.terms["cells"] * float(subject.kit.unit[0] * subject.kit.unit[1] * subject.kit.unit[2]) * MILLIMETRES ** 3
    same("the volume of the mesh", abs(volume(mesh) - want) <= 1e-6 * want, True)
    edges = Counter((t[k], t[k - 2]) for t in mesh.triangles for k in range(3))
    same("edges of the mesh that have other triangles beyond them", [e for e, n in edges.items() if edges[e[::-1]] != n][:3], [])


def in_steps(subject):
    """Steps have the same parts; of a number of parts, no more; each part stands on the ground or joins what stands, unless it is told."""
    if not subject.placed:
        return
    kit = subject.kit
    for steps in ("part", "layer", "3"):
        path = os.path.join(subject.folder, "steps.ldr")
        code, _, err = run("place", subject.free, *subject.options, *subject.limits, "--steps", steps, "-o", path)
        text = content(path).decode()
        same(f"parts in steps of {steps}", Counter(lines_of(text.encode())), Counter(lines_of(subject.placed)))
        groups = [read_ldraw(group, kit) for group in text.split("0 STEP")[:-1]]
        if steps in ("part", "3"):
            same(f"parts of a step of {steps}", [len(g) for g in groups if len(g) > (1 if steps == "part" else 3) or not g], [])
        else:
            same("heights of a layer", [g for g in groups if len({max(c[1] for c in cells_at(kit, s)) for s in g}) != 1], [])
        if "W192" not in err:
            stand_or_join(subject, [s for g in groups for s in g])


def stand_or_join(subject, parts):
    kit = subject.kit
    ground = max(cell[1] for s in parts for cell in cells_at(kit, s))
    for i, standing in enumerate(parts):
        low = max(cell[1] for cell in cells_at(kit, standing))
        if low < ground:
            joined = any(i in (a, b) for a, _, b, _ in joined_pairs(kit, parts[:i + 1]))
            same("a part that is put in joins what stands", joined, True)


def limits(subject):
    """A limit that is passed ends with 4 and leaves no file."""
    if len(subject.parts) < 2 or subject.searched or subject.model.steps:
        return
    path = os.path.join(subject.folder, "limited.ldr")
    for limit, passed in ((len(subject.parts) - 1, True), (len(subject.parts), False)):
        if os.path.exists(path):                           # of another model
            os.unlink(path)
        code, _, _ = run("place", subject.free, *subject.options, "--part-limit", str(limit), "-o", path)
        same(f"--part-limit {limit} of {len(subject.parts)} ends with", (code, os.path.exists(path)), (4, False) if passed else (0, True))


# ---- searches

def searches(subject):
    """What is proved to be best is at least as good as what others find; a beam of one is greedy."""
    model = subject.model
    if not subject.room or len(subject.room[0]) > 120 or subject.kit.turns == 24 and len(subject.room[0]) > 60:
        return
    kept = "".join(f"  {text};\n" for word, text in model.lines if word not in ("require", "search", "minimize", "maximize", "steps"))
    way, goal = model.goal or (-1, "elements")
    told = next((text for word, text in model.lines if word in ("minimize", "maximize")), "minimize elements")
    found = {}
    for search in ("exact", "greedy", "beam 1", "beam 4", "anneal 20"):
        file = subject.with_lines(f"{kept}  {told};\n  search {search};\n", "searched")
        path, limit = os.path.join(subject.folder, "searched.ldr"), ["--search-limit", "3000"] * (search != "greedy" or not subject.plain)
        code, out, err = run("place", file, "--model", subject.part, *limit, *LIMIT, "--stats", "json", "-o", path)
        if code == 1 or code == 4 and search == "exact":
            same(f"search {search} finds nothing", (code, NOTHING in err or search == "exact"), (code, True)) if code == 1 else None
            return
        if search == "exact" and not read_json("--stats json", out).get("proved"):
            return
        found[search] = read_ldraw(content(path).decode(), subject.kit)
    if not subject.drawn:
        same("a beam of one", [s.key() for s in found["beam 1"]], [s.key() for s in found["greedy"]])
    values = {name: value_of(goal, measures(subject.kit, parts, subject.room[0] if not subject.room[1] else None)) for name, parts in found.items()}
    if None in values.values():
        return
    for name, value in values.items():
        better = way * (value - values["exact"])
        if better > 1e-9 * max(1, abs(value)):
            raise Wrong("search exact is at least as good", f"{values['exact']} by exact", f"{value} by {name}")


# ---- other notations

def as_grammar(subject):
    """A model as a connection grammar places the same parts."""
    code, text, err = run("export", subject.free, *subject.options, "--pcfg")
    if code == 1 and "E1333" in err or not subject.placed:
        return
    same("export --pcfg ends with", code, 0)
    path, out = subject.file("model.pcfg", text), os.path.join(subject.folder, "grammar.ldr")
    code, _, err = run("place", path, "-o", out, *LIMIT)
    if subject.model.steps:
        same("parts of the grammar", (code, Counter(lines_of(content(out)))), (0, Counter(lines_of(subject.placed))))
    else:
        same("parts of the grammar", (code, lines_of(content(out)) if code == 0 else err[:200]), (0, lines_of(subject.placed)))


def as_drawn(subject):
    """What was placed, taken as drawn, is placed again: as a kit, and as a grammar."""
    if not subject.placed:
        return
    path = subject.file("seen.ldr", subject.placed.decode())
    for form, options in (("kit", ["--kit", subject.path]), ("pcfg", ["--pcfg"])):
        code, text, err = run("export", path, *options)
        if code == 1 and "E1361" in err:
            continue
        same(f"export of a model as {form} ends with {err[:160]}", code, 0)
        if "W197" in err or "W198" in err:
            continue
        out = os.path.join(subject.folder, "again.ldr")
        code, _, err = run("place", subject.file("again." + form, text), "-o", out)
        same(f"the model drawn, as {form}", (code, Counter(lines_of(content(out))) if code == 0 else err[:200]), (0, Counter(lines_of(subject.placed))))


def reported(subject):
    """The page is the same each time, and names the models and parts."""
    paths = [os.path.join(subject.folder, f"{i}.html") for i in (1, 2)]
    for path in paths:
        answer("report", subject.path, "-o", path, "--search-limit", "100", "--part-limit", "200")
    same("a page made twice", content(paths[0]) == content(paths[1]), True)
    page = content(paths[0]).decode()
    same("what the page does not name", [name for name in list(subject.kit.models) + list(subject.kit.parts) if name.replace("&", "&amp;") not in page], [])


QUICK = [legal, by_rules]
OF_KITS = [loads, keeps_its_meaning, says_json, reported, *OF_COUNTS]
OF_MODELS = [inspected, requires, tested, same_bytes, moved, files, meshes, in_steps, limits, searches, as_grammar, as_drawn, placed_by_interface]
