#!/usr/bin/env python3
"""Reads drawings that are written as DXF, by ezdxf where that is installed (status 77: it is not).

drawing_read.py FILE.dxf [TYPE[@LAYER]=COUNT]...: the audit finds nothing, there are at least so many entities of these types (on that
layer) in model space, all of them lie within the extents that the header says, every layer that is used is
in the table with a weight, every hatch has a boundary, every dimension measures what its block shows, every insert has its block, and what
windows of the layout show is there. With the word `meant`, nothing in model space or on a layout is on layer 0; with WALLS:ZONES, the lines of the one
layer are the contours of those of the other."""
import sys

try:
    import ezdxf
    from ezdxf import bbox
except ImportError:
    print("there is no ezdxf (python3-ezdxf)")
    sys.exit(77)
from collections import Counter

failures = []


def check(what, holds):
    if not holds:
        failures.append(what)


def lengths(text):
    """The number that a dimension shows, of metres or millimetres; None of others."""
    try:
        return float(text.rstrip("m "))
    except ValueError:
        return None


def check_entity(document, entity):
    kind = entity.dxftype()
    layer = document.layers.get(entity.dxf.layer)
    check(f"layer {entity.dxf.layer} has a weight", layer.dxf.lineweight >= 0)
    if kind == "HATCH":
        check("a hatch has a boundary", len(entity.paths) and all(len(path.vertices) > 1 for path in entity.paths))
        check("a hatch has a pattern", entity.dxf.solid_fill or entity.pattern.lines)
    if kind == "INSERT":
        check(f"block {entity.dxf.name}", entity.dxf.name in document.blocks and len(document.blocks.get(entity.dxf.name)))
    if kind == "DIMENSION":
        shown = [part.dxf.text for part in document.blocks.get(entity.dxf.geometry) if part.dxftype() == "TEXT"]
        check("a dimension shows one text", len(shown) == (entity.dxf.text != " "))
        factor = document.dimstyles.get(entity.dxf.dimstyle).dxf.dimlfac
        value = lengths(shown[0]) if shown else None
        if entity.dxf.text == "" and value is not None and document.header["$INSUNITS"] == 4:
            check(f"{shown} is {entity.get_measurement() * factor}", abs(entity.get_measurement() * factor - value) < 1e-3 * max(1, value))


def check_extents(document, model):
    low, high = document.header["$EXTMIN"], document.header["$EXTMAX"]
    shown = bbox.extents([entity for entity in model if entity.dxftype() in ("LINE", "LWPOLYLINE", "ARC", "CIRCLE")], flatten=1)
    if shown.has_data:
        slack = 1e-6 * max(high[0] - low[0], high[1] - low[1]) + 1e-6
        check(f"{shown} within {low} {high}", all(low[k] - slack <= shown.extmin[k] and shown.extmax[k] <= high[k] + slack for k in (0, 1)))


def check_windows(document):
    for name in document.layout_names():
        windows = [e for e in document.layout(name).query("VIEWPORT") if e.dxf.id > 1]
        for window in windows:
            middle, high = window.dxf.view_center_point, window.dxf.view_height
            wide = high * window.dxf.width / window.dxf.height
            inside = [e for e in document.modelspace() if e.dxftype() == "LINE" and
                      abs(e.dxf.start[0] - middle[0]) <= wide / 2 and abs(e.dxf.start[1] - middle[1]) <= high / 2]
            check("a window shows something", inside or not document.modelspace().query("LINE"))


def check_layers(document):
    for name in document.layout_names():
        stray = Counter(entity.dxftype() for entity in document.layout(name) if entity.dxf.layer == "0")
        check(f"nothing of {name} is on layer 0, but {dict(stray)}", not stray)


def area_of(corners):
    return sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in zip(corners, corners[1:] + corners[:1])) / 2


def check_contours(model, walls, zones):
    """Contours hold exactly the zones, and have a corner only where they turn."""
    within = {layer: [[tuple(at) for at in line.get_points("xy")] for line in model.query("LWPOLYLINE")
                      if line.dxf.layer == layer and line.closed] for layer in (walls, zones)}
    held, parts = (sum(abs(area_of(corners)) for corners in within[layer]) for layer in (walls, zones))
    check(f"contours hold {held} of {parts}", parts > 0 and abs(held - parts) < 1e-6 * parts)
    for corners in within[walls]:
        for before, at, after in zip(corners[-1:] + corners, corners, corners[1:] + corners[:1]):
            check(f"a contour turns at {at}", abs(area_of([before, at, after])) > 1)


def check_count(model, words):
    what, least = words.split("=")
    kind, _, layer = what.partition("@")
    counted = sum(entity.dxf.layer == layer or not layer for entity in model.query(kind))
    check(f"{counted} of {what}, not {least}", counted >= int(least))


def read(path, wanted):
    document = ezdxf.readfile(path)
    auditor = document.audit()
    check(f"the audit finds {[error.message for error in auditor.errors + auditor.fixes][:3]}", not auditor.errors and not auditor.fixes)
    model = document.modelspace()
    check("units", document.header["$INSUNITS"] in (1, 4) and document.header["$MEASUREMENT"] == (document.header["$INSUNITS"] == 4))
    for words in wanted:
        if words == "meant":
            check_layers(document)
        elif ":" in words:
            check_contours(model, *words.split(":"))
        else:
            check_count(model, words)
    for entity in model:
        check_entity(document, entity)
    check_extents(document, model)
    check_windows(document)


read(sys.argv[1], sys.argv[2:])
print("\n".join(failures[:20]) or "fine")
sys.exit(bool(failures))
