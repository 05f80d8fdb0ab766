"""Questions about houses whose answers an independent reference works out: a program outside of this project, which reads files itself.
TARTAN_ORACLES names the folder of the references; where it is not there, nothing is asked of it."""
import importlib
import itertools
import os
import re
import sys

from program import same

HOUSES = 2500            # no more houses than this are gone through
ORACLES = os.environ.get("TARTAN_ORACLES", "")


class Beyond(Exception):
    """More houses than are gone through."""


def reference():
    folder = os.path.join(ORACLES, "house")
    if not ORACLES or not os.path.isfile(os.path.join(folder, "house.py")):
        return None
    if folder not in sys.path:
        sys.path.insert(0, folder)
    return importlib.import_module("house")


def houses_by_reference(subject):
    """The houses of a library, in order."""
    house = reference() if subject.houses else None
    form = subject.source.by_name[subject.source.about(subject.item)[1]].text if house else ""
    if not house or re.search(r"^\s*(way|headroom)\b|\b(near (left|right|back|front)|sliding)\b", form, re.M):
        return    # it does not know these
    try:
        want = list(listed(house, subject))
    except Exception:    # the reference does not read this file: it knows a part of the language
        return
    same("houses, as the reference counts", subject.total, len(want))
    if subject.lines is not None:
        same("houses, as the reference lists them", list(map(parts, subject.lines)), list(map(parts, want)))


def listed(house, subject):
    file = house.parse(subject.file("reference.plan", without_measures(subject.source)))
    library, form = file.libs[subject.item.name], file.forms[subject.source.about(subject.item)[1]]
    plans = file.libs[plans_of(subject)]
    unit, spent = house.unit_of(form.schema), 0
    for trays in house.plans(file, plans):
        for section in house.sections(file, form):
            for line in on_plan(house, file, library, form, trays, section, unit):
                spent += 1
                if spent > HOUSES:
                    raise Beyond()
                if line:
                    yield line


def parts(line):
    """The reference leaves a part empty where the program writes `-`, and writes lengths in metres, and feet and eaves without `-`."""
    line = re.sub(r"(?<!\d)(\d+)mm", lambda length: f"{int(length[1]) / 1000:g}m", line)
    return [[words.strip().replace("'-", "'").replace("eaves-", "eaves") or "-" for words in part.split("|")] for part in line.split(";")]


def without_measures(source):
    """What the reference needs of a file: it does not read measures and tests, nor rules that no library asks for may stop it."""
    kept = [i for i in source.items if i.kind in ("schema", "form", "library")]
    waiting = [i.text for i in kept if i.kind == "library"]
    for text in waiting:
        for rule in source.of("rule"):
            if rule not in kept and re.search(rf"(?<![\w-]){re.escape(rule.name)}(?![\w-])", text):
                kept.append(rule)
                waiting.append(rule.text)
    return "".join(with_schema(source, i) for i in source.items if i in kept)


def with_schema(source, item):
    """As the reference reads it: without what changes no house, with the words that it knows, and with the schema that a library is of."""
    lines = [line for line in item.text.split("\n") if not re.match(r"\s*(number|material|allow)\b", line)]
    text = re.sub(r'(?<!\d)"(?:\\.|[^"\\])*"|\b(glazed|leafless)\b', "", "\n".join(lines))
    text = re.sub(r"\boption(?= *\()|^( *)option\b", r"\1section", text, flags=re.M)    # it knows the words of before
    text = re.sub(r"^( *)floor (?=\d)", r"\1deck ", text, flags=re.M)
    if item.kind != "library" or item.using or item.older:
        return text
    return text.replace("{", f"using {source.about(item)[0]} {{", 1)


def plans_of(subject):
    item = subject.item
    while not item.form:
        item = subject.source.by_name[item.older]
    return item.older


def on_plan(house, file, library, form, trays, section, unit):
    """The lines of the houses of one plan and section; None for those that a clause keeps out."""
    made = house.House(file, form.schema, trays, form, section)
    cells = [c for c in made.cells if not c.void]
    options = [house.functions_of(made, c) for c in cells]
    for cell, own in zip(cells, options):
        cell.fn = own[0] if own else None
    for functions in itertools.product(*options):
        for cell, function in zip(cells, functions):
            cell.fn = function
        faces = [house.face_options(made, f) for f in made.faces]
        for kinds in itertools.product(*faces):
            for face, kind in zip(made.faces, kinds):
                face.kind = kind
            tiles = [house.tile_variants(made, c) for c in made.cells]
            if house.dropped(made, library) or any(variants == [] for variants in tiles):
                yield None
                continue
            for chosen in itertools.product(*[[None] if variants is None else variants for variants in tiles]):
                yield house.show(made, faces, chosen, unit)
