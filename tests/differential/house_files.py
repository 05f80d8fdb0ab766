"""Houses built: their solids, models, drawings and bills against one another, and bills against what measures add up."""
import os
import re
import subprocess
import sys
from fractions import Fraction

from program import answer, json_lines, read_json, same

TESTS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
NOT_OPENINGS = {"wall", "party", "open", "floor", "stair"}


def some_ranks(subject):
    """Of houses that have a tray."""
    if not subject.houses:
        return []
    empty = int(subject.counts["by_length"].get("0", 0))
    return sorted({empty, (empty + subject.total) // 2, subject.total - 1}) if subject.total > empty else []


def built(subject, house, *endings):
    """A folder with a house's files. A house is its line, or # and its rank."""
    folder = os.path.join(subject.folder, "house")
    os.makedirs(folder, exist_ok=True)
    outputs = [part for ending in endings for part in ("-o", os.path.join(folder, "house." + ending))]
    of = subject.options if house[0] == "#" else ["--form", subject.using()]
    layers = ["--profile", "us"] if "dxf" in endings else []
    answer("house", subject.path, house, *of, *layers, *outputs)
    return folder


def read(folder):
    with open(os.path.join(folder, "house.json"), encoding="utf-8") as file:
        return read_json("house.json", file.read())


def has_cells(subject, rank):
    """Of a house without cells nothing is drawn."""
    return bool(read(built(subject, f"#{rank}", "json"))["cells"])


def form(subject):
    return subject.source.by_name[subject.using()].text


def openings(subject, word):
    """The names of the form's openings that have this word."""
    found = re.findall(r'^\s*opening (\S+)(.*)$', form(subject), re.M)
    return {name for name, parts in found if re.search(rf"\b{word}\b", re.sub(r'(?<!\d)"(?:\\.|[^"\\])*"', "", parts))}


def solids(subject):
    """Solids are apart, the mesh is closed, IFC, DXF and the bill have the same parts: what house_solids.py and house_files.py find."""
    if not subject.houses or openings(subject, "leafless"):              # these know by an opening's name whether it has a leaf
        return
    for rank in some_ranks(subject)[:1]:
        if not has_cells(subject, rank):
            continue
        folder = built(subject, f"#{rank}", "json", "ifc", "dxf", "parts.csv", "obj")
        for program in ("house_solids.py", "house_files.py"):
            done = subprocess.run([sys.executable, "-B", os.path.join(TESTS, program), folder], capture_output=True, text=True, timeout=120)
            same(program, (done.stdout + done.stderr[-300:]).strip(), "fine")


def swings(subject):
    """Each leaf of a door that hangs in a passage has one symbol on the plans."""
    for rank in some_ranks(subject)[-1:]:
        if not has_cells(subject, rank):
            continue
        folder = built(subject, f"#{rank}", "json", "dxf")
        hung = openings(subject, "passage") - openings(subject, "leafless") - openings(subject, "sliding")
        doors = sum(face["kind"] in hung for face in read(folder)["faces"])
        same("leaves of doors on plans", leaves(os.path.join(folder, "house.dxf")), doors)


def leaves(path):
    """How many symbols of doors a DXF file inserts."""
    with open(path, encoding="utf-8") as file:
        lines = file.read().split("\n")
    counted, kind = 0, None
    for code, value in zip(lines[0:-1:2], lines[1::2]):
        kind = value if code.strip() == "0" else kind
        counted += kind == "INSERT" and code.strip() == "2" and value.startswith("DOOR-")
    return counted


def bills(subject):
    """What `sum(cost)` adds up is the total of the bill, but for a cent for each line of it."""
    if not subject.houses or not subject.total or " price " not in form(subject):
        return
    file = subject.edited(f"\nmeasure money using {subject.using()} = sum(cost)\n")
    for end in ("--least", "--most"):
        found = json_lines("best", subject.ask("best", "1", end, "money", "--format", "json", file=file))[0]
        house = read(built(subject, found["house"], "json"))
        value = Fraction(found["value"] if "value" in found else found["values"][0])
        same("the bill is what sum(cost) is", abs(Fraction(house["cost"]) - value) * 100 <= len(house["parts"]) + 1, True)
