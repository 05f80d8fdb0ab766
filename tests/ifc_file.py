#!/usr/bin/env python3
"""Reads IFC4 files as STEP, and holds them to rules of the standard and of buildingSMART: ifc_file.py FILE.ifc ... ; with --faults, asks of
one file whether faults that are put into it are found; with --kept OLD NEW, says which parts do not keep their identifiers; with --tables FOLDER, holds the tables of sets to buildingSMART's.

Each instance has to have as many attributes as IFC4 gives its entity, of their types (ISO 16739-1:2018, inherited ones included), each
reference has to lead to an instance of an entity that may stand there, and identifiers are unique. Then come rules that buildingSMART's
validation service has, by their numbers there. The tables have what houses use."""
import ast
import csv
import re
import sys
from collections import Counter
from fractions import Fraction as F

# The attributes of each entity, inherited ones first: S text, E enumeration, R real, I integer, N instance, A list of instances (O: it may be
# empty), V list of numbers, L list of such lists, D derived (*), B a value with its type. Small letters: it may be left out ($).
ROOT, PRODUCT = "Snss", "Snsssnn"
ELEMENT, SPATIAL, TYPE = PRODUCT + "s", PRODUCT + "se", ROOT + "saass"
TYPES = {
    "IFCARBITRARYCLOSEDPROFILEDEF": "EsN", "IFCARBITRARYPROFILEDEFWITHVOIDS": "EsNA", "IFCPOLYLINE": "A",
    "IFCAXIS2PLACEMENT2D": "Nn", "IFCAXIS2PLACEMENT3D": "Nnn", "IFCBUILDING": SPATIAL + "rrn",
    "IFCBUILDINGSTOREY": SPATIAL + "r", "IFCCARTESIANPOINT": "V", "IFCCARTESIANPOINTLIST2D": "L", "IFCCARTESIANPOINTLIST3D": "L", "IFCCOLOURRGB": "sRRR",
    "IFCCLASSIFICATION": "ssnSssa", "IFCCLASSIFICATIONREFERENCE": "sssnss", "IFCCOLUMN": ELEMENT + "e", "IFCBEAM": ELEMENT + "e", "IFCCONNECTIONSURFACEGEOMETRY": "Nn", "IFCCONVERSIONBASEDUNIT": "NESN", "IFCCURVEBOUNDEDPLANE": "NNO",
    "IFCDIMENSIONALEXPONENTS": "IIIIIII", "IFCDIRECTION": "V", "IFCDOOR": ELEMENT + "rrees",
    "IFCELEMENTQUANTITY": ROOT + "sA", "IFCEXTRUDEDAREASOLID": "NnNR", "IFCFURNITURE": ELEMENT + "e",
    "IFCGEOMETRICREPRESENTATIONCONTEXT": "ssIrNn", "IFCGEOMETRICREPRESENTATIONSUBCONTEXT": "ssDDDDNrEs", "IFCLOCALPLACEMENT": "nN",
    "IFCINDEXEDPOLYCURVE": "Nab", "IFCINDEXEDPOLYGONALFACE": "V", "IFCMATERIAL": "Sss", "IFCMATERIALLAYER": "nResssi", "IFCMATERIALLAYERSET": "Ass",
    "IFCMATERIALLAYERSETUSAGE": "NEERr", "IFCMEASUREWITHUNIT": "BN", "IFCOPENINGELEMENT": ELEMENT + "e", "IFCPLANE": "N", "IFCPOLYGONALFACESET": "NEAv",
    "IFCPROPERTYSET": ROOT + "A", "IFCPROPERTYSINGLEVALUE": "SsBn", "IFCPRODUCTDEFINITIONSHAPE": "ssA", "IFCPROJECT": ROOT + "sssan",
    "IFCQUANTITYAREA": "SsnRs", "IFCQUANTITYLENGTH": "SsnRs", "IFCQUANTITYVOLUME": "SsnRs", "IFCRAILING": ELEMENT + "e", "IFCRECTANGLEPROFILEDEF": "EsnRR",
    "IFCRELAGGREGATES": ROOT + "NA", "IFCRELASSIGNSTOGROUP": ROOT + "AeN", "IFCRELASSOCIATESCLASSIFICATION": ROOT + "AN", "IFCRELASSOCIATESMATERIAL": ROOT + "AN", "IFCRELCONNECTSPATHELEMENTS": ROOT + "nNNOOEE",
    "IFCRELCONTAINEDINSPATIALSTRUCTURE": ROOT + "AN", "IFCRELDEFINESBYPROPERTIES": ROOT + "AN", "IFCRELDEFINESBYTYPE": ROOT + "AN",
    "IFCRELFILLSELEMENT": ROOT + "NN", "IFCRELSPACEBOUNDARY": ROOT + "NNnEE", "IFCRELVOIDSELEMENT": ROOT + "NN", "IFCROOF": ELEMENT + "e",
    "IFCSHAPEREPRESENTATION": "NssA", "IFCSITE": SPATIAL + "vvrsn", "IFCSIUNIT": "DEeE", "IFCSLAB": ELEMENT + "e", "IFCSPACE": SPATIAL + "er",
    "IFCSTAIR": ELEMENT + "e", "IFCSTAIRFLIGHT": ELEMENT + "iirre", "IFCSTYLEDITEM": "nAs", "IFCSURFACESTYLE": "sEA", "IFCSURFACESTYLERENDERING": "NrnnnnnbE",
    "IFCUNITASSIGNMENT": "A", "IFCWALL": ELEMENT + "e", "IFCWINDOW": ELEMENT + "rrees", "IFCZONE": ROOT + "ss",
    **{f"IFC{kind}TYPE": TYPE + "E" for kind in "BEAM COLUMN RAILING ROOF SLAB STAIR STAIRFLIGHT WALL".split()},
    "IFCDOORTYPE": TYPE + "EEes", "IFCFURNITURETYPE": TYPE + "Ee", "IFCSPACETYPE": TYPE + "Es", "IFCWINDOWTYPE": TYPE + "EEes",
}
NUMBER = r"-?\d+(\.\d*(E[+-]?\d+)?)?"
REAL = r"-?\d+\.\d*(E[+-]?\d+)?"
TEXT = r"'([ -&(-\[\]-~]|''|\\\\|\\X2\\([0-9A-F]{4})+\\X0\\|\\X4\\([0-9A-F]{8})+\\X0\\)*'"
WRITTEN = {
    "S": TEXT, "E": r"\.[A-Z0-9_]+\.", "R": REAL, "I": r"-?\d+", "N": r"#\d+", "A": r"\(#\d+(,#\d+)*\)", "O": r"\((#\d+(,#\d+)*)?\)",
    "B": rf"\.[TF]\.|IFCBOOLEAN\(\.[TF]\.\)|IFCIDENTIFIER\({TEXT}\)|IFCCOUNTMEASURE\(\d+\)|IFC(POSITIVE)?(LENGTH|AREA|VOLUME)MEASURE\({REAL}\)",
    "V": rf"\({NUMBER}(,{NUMBER})*\)", "L": rf"\(\({NUMBER}(,{NUMBER})*\)(,\({NUMBER}(,{NUMBER})*\))*\)", "D": r"\*",
}
ENDS = "ATSTART ATEND"
# (entity, attribute) -> the values of its enumeration that houses have
VALUES = {
    ("IFCWALL", 8): "SOLIDWALL PARTITIONING", ("IFCSLAB", 8): "FLOOR BASESLAB ROOF LANDING", ("IFCRAILING", 8): "GUARDRAIL", ("IFCDOOR", 10): "DOOR", ("IFCWINDOW", 10): "WINDOW",
    ("IFCROOF", 8): "FLAT_ROOF SHED_ROOF GABLE_ROOF BARREL_ROOF HIP_ROOF NOTDEFINED", ("IFCCOLUMN", 8): "COLUMN", ("IFCBEAM", 8): "BEAM",
    ("IFCFURNITURE", 8): "CHAIR TABLE DESK BED SHELF SOFA NOTDEFINED", ("IFCSTAIRFLIGHT", 12): "STRAIGHT WINDER SPIRAL", ("IFCOPENINGELEMENT", 8): "OPENING RECESS",
    ("IFCSTAIR", 8): "STRAIGHT_RUN_STAIR QUARTER_WINDING_STAIR QUARTER_TURN_STAIR HALF_WINDING_STAIR HALF_TURN_STAIR SPIRAL_STAIR NOTDEFINED",
    ("IFCMATERIALLAYERSETUSAGE", 1): "AXIS2 AXIS3", ("IFCMATERIALLAYERSETUSAGE", 2): "POSITIVE NEGATIVE", ("IFCRELSPACEBOUNDARY", 7): "PHYSICAL", ("IFCRELSPACEBOUNDARY", 8): "INTERNAL EXTERNAL",
    ("IFCSPACE", 8): "ELEMENT", ("IFCSPACE", 9): "INTERNAL EXTERNAL", ("IFCRELCONNECTSPATHELEMENTS", 9): ENDS, ("IFCRELCONNECTSPATHELEMENTS", 10): ENDS,
    ("IFCSURFACESTYLE", 1): "BOTH", ("IFCSURFACESTYLERENDERING", 8): "NOTDEFINED",
}
ELEMENTS = "IFCWALL IFCBEAM IFCCOLUMN IFCSLAB IFCROOF IFCSTAIR IFCSTAIRFLIGHT IFCRAILING IFCFURNITURE IFCDOOR IFCWINDOW".split()
SPACES = ["IFCSITE", "IFCBUILDING", "IFCBUILDINGSTOREY", "IFCSPACE"]
PRODUCTS = ELEMENTS + ["IFCOPENINGELEMENT"] + SPACES
SOLIDS = ["IFCEXTRUDEDAREASOLID", "IFCPOLYGONALFACESET"]
# attribute -> what it may refer to
REFERENCES = {
    ("IFCLOCALPLACEMENT", 0): ["IFCLOCALPLACEMENT"], ("IFCLOCALPLACEMENT", 1): ["IFCAXIS2PLACEMENT3D"],
    ("IFCEXTRUDEDAREASOLID", 0): ["IFCRECTANGLEPROFILEDEF", "IFCARBITRARYCLOSEDPROFILEDEF", "IFCARBITRARYPROFILEDEFWITHVOIDS"],
    ("IFCARBITRARYCLOSEDPROFILEDEF", 2): ["IFCPOLYLINE"], ("IFCARBITRARYPROFILEDEFWITHVOIDS", 2): ["IFCPOLYLINE"], ("IFCARBITRARYPROFILEDEFWITHVOIDS", 3): ["IFCPOLYLINE"], ("IFCEXTRUDEDAREASOLID", 1): ["IFCAXIS2PLACEMENT3D"], ("IFCEXTRUDEDAREASOLID", 2): ["IFCDIRECTION"],
    ("IFCPOLYGONALFACESET", 0): ["IFCCARTESIANPOINTLIST3D"], ("IFCPOLYGONALFACESET", 2): ["IFCINDEXEDPOLYGONALFACE"],
    ("IFCSHAPEREPRESENTATION", 0): ["IFCGEOMETRICREPRESENTATIONSUBCONTEXT"],
    ("IFCSHAPEREPRESENTATION", 3): SOLIDS + ["IFCINDEXEDPOLYCURVE"], ("IFCPRODUCTDEFINITIONSHAPE", 2): ["IFCSHAPEREPRESENTATION"],
    ("IFCSTYLEDITEM", 0): SOLIDS, ("IFCSTYLEDITEM", 1): ["IFCSURFACESTYLE"], ("IFCSURFACESTYLE", 2): ["IFCSURFACESTYLERENDERING"], ("IFCSURFACESTYLERENDERING", 0): ["IFCCOLOURRGB"],
    ("IFCINDEXEDPOLYCURVE", 0): ["IFCCARTESIANPOINTLIST2D"], ("IFCPLANE", 0): ["IFCAXIS2PLACEMENT3D"], ("IFCCONNECTIONSURFACEGEOMETRY", 0): ["IFCCURVEBOUNDEDPLANE"],
    ("IFCCURVEBOUNDEDPLANE", 0): ["IFCPLANE"], ("IFCCURVEBOUNDEDPLANE", 1): ["IFCINDEXEDPOLYCURVE"],
    ("IFCRELVOIDSELEMENT", 4): ["IFCWALL"], ("IFCRELVOIDSELEMENT", 5): ["IFCOPENINGELEMENT"],
    ("IFCRELFILLSELEMENT", 4): ["IFCOPENINGELEMENT"], ("IFCRELFILLSELEMENT", 5): ["IFCDOOR", "IFCWINDOW"],
    ("IFCRELCONNECTSPATHELEMENTS", 5): ["IFCWALL"], ("IFCRELCONNECTSPATHELEMENTS", 6): ["IFCWALL"],
    ("IFCRELCONTAINEDINSPATIALSTRUCTURE", 4): ELEMENTS, ("IFCRELCONTAINEDINSPATIALSTRUCTURE", 5): ["IFCBUILDINGSTOREY"],
    ("IFCMATERIALLAYER", 0): ["IFCMATERIAL"], ("IFCMATERIALLAYERSET", 0): ["IFCMATERIALLAYER"], ("IFCMATERIALLAYERSETUSAGE", 0): ["IFCMATERIALLAYERSET"],
    ("IFCRELSPACEBOUNDARY", 4): ["IFCSPACE"], ("IFCRELSPACEBOUNDARY", 5): ["IFCWALL", "IFCSLAB", "IFCDOOR", "IFCWINDOW"], ("IFCRELSPACEBOUNDARY", 6): ["IFCCONNECTIONSURFACEGEOMETRY"],
    ("IFCRELDEFINESBYPROPERTIES", 5): ["IFCELEMENTQUANTITY", "IFCPROPERTYSET"], ("IFCPROPERTYSET", 4): ["IFCPROPERTYSINGLEVALUE"],
    ("IFCELEMENTQUANTITY", 5): ["IFCQUANTITYLENGTH", "IFCQUANTITYAREA", "IFCQUANTITYVOLUME"],
    ("IFCRELASSIGNSTOGROUP", 4): ["IFCSPACE"], ("IFCRELASSIGNSTOGROUP", 6): ["IFCZONE"],
    ("IFCRELASSOCIATESCLASSIFICATION", 4): ELEMENTS + ["IFCSPACE"], ("IFCRELASSOCIATESCLASSIFICATION", 5): ["IFCCLASSIFICATIONREFERENCE"], ("IFCCLASSIFICATIONREFERENCE", 3): ["IFCCLASSIFICATION"],
    ("IFCRELASSOCIATESMATERIAL", 5): ["IFCMATERIAL", "IFCMATERIALLAYERSET", "IFCMATERIALLAYERSETUSAGE"],
    ("IFCPROJECT", 8): ["IFCUNITASSIGNMENT"], ("IFCUNITASSIGNMENT", 0): ["IFCSIUNIT", "IFCCONVERSIONBASEDUNIT"],
    ("IFCCONVERSIONBASEDUNIT", 0): ["IFCDIMENSIONALEXPONENTS"], ("IFCCONVERSIONBASEDUNIT", 3): ["IFCMEASUREWITHUNIT"], ("IFCMEASUREWITHUNIT", 1): ["IFCSIUNIT"],
    **{(p, 5): ["IFCLOCALPLACEMENT"] for p in PRODUCTS}, **{(p, 6): ["IFCPRODUCTDEFINITIONSHAPE"] for p in PRODUCTS},
}
# whole -> what it may consist of (SPS002, BLT003)
COMPOSED = {"IFCPROJECT": ["IFCSITE"], "IFCSITE": ["IFCBUILDING"], "IFCBUILDING": ["IFCBUILDINGSTOREY"], "IFCBUILDINGSTOREY": ["IFCSPACE"],
            "IFCROOF": ["IFCSLAB"], "IFCSTAIR": ["IFCSTAIRFLIGHT", "IFCSLAB", "IFCRAILING"]}
# set of properties -> entity, and the types of its properties (PSE001); all have a Reference, which is an identifier
TRUTH, COUNT, POSITIVE = "IFCBOOLEAN", "IFCCOUNTMEASURE", "IFCPOSITIVELENGTHMEASURE"
STEPS = {"NumberOfRiser": COUNT, "NumberOfTreads": COUNT, "RiserHeight": POSITIVE, "TreadLength": POSITIVE}
PROPERTIES = {
    "Pset_WallCommon": ("IFCWALL", {"IsExternal": TRUTH, "LoadBearing": TRUTH}), "Pset_SlabCommon": ("IFCSLAB", {"IsExternal": TRUTH, "LoadBearing": TRUTH}),
    "Pset_DoorCommon": ("IFCDOOR", {"IsExternal": TRUTH}), "Pset_WindowCommon": ("IFCWINDOW", {"IsExternal": TRUTH}), "Pset_RoofCommon": ("IFCROOF", {"IsExternal": TRUTH}),
    "Pset_ColumnCommon": ("IFCCOLUMN", {"LoadBearing": TRUTH}), "Pset_BeamCommon": ("IFCBEAM", {"LoadBearing": TRUTH}), "Pset_RailingCommon": ("IFCRAILING", {"Height": POSITIVE}),
    "Pset_StairCommon": ("IFCSTAIR", STEPS), "Pset_StairFlightCommon": ("IFCSTAIRFLIGHT", STEPS), "Pset_SpaceCommon": ("IFCSPACE", {"IsExternal": TRUTH}),
}
# set of quantities -> entity, and the kinds of its quantities (QTY001)
BODY = {"GrossVolume": "VOLUME", "NetVolume": "VOLUME"}
FLAT = {"GrossArea": "AREA", "NetArea": "AREA"}
FILLING = {"Width": "LENGTH", "Height": "LENGTH", "Perimeter": "LENGTH", "Area": "AREA"}
BAR = {"Length": "LENGTH", "CrossSectionArea": "AREA", "OuterSurfaceArea": "AREA", **BODY}
QUANTITIES = {
    "Qto_WallBaseQuantities": ("IFCWALL", {"Length": "LENGTH", "Width": "LENGTH", "Height": "LENGTH", "GrossFootprintArea": "AREA", "GrossSideArea": "AREA", "NetSideArea": "AREA", **BODY}),
    "Qto_SlabBaseQuantities": ("IFCSLAB", {"Width": "LENGTH", "Perimeter": "LENGTH", **FLAT, **BODY}), "Qto_RoofBaseQuantities": ("IFCROOF", {**FLAT, "ProjectedArea": "AREA"}),
    "Qto_DoorBaseQuantities": ("IFCDOOR", FILLING), "Qto_WindowBaseQuantities": ("IFCWINDOW", FILLING),
    "Qto_OpeningElementBaseQuantities": ("IFCOPENINGELEMENT", {"Width": "LENGTH", "Height": "LENGTH", "Depth": "LENGTH", "Area": "AREA", "Volume": "VOLUME"}),
    "Qto_ColumnBaseQuantities": ("IFCCOLUMN", BAR), "Qto_BeamBaseQuantities": ("IFCBEAM", BAR), "Qto_RailingBaseQuantities": ("IFCRAILING", {"Length": "LENGTH"}),
    "Qto_StairFlightBaseQuantities": ("IFCSTAIRFLIGHT", BODY), "Qto_SpaceBaseQuantities": ("IFCSPACE", {"Height": "LENGTH", "GrossFloorArea": "AREA", "NetFloorArea": "AREA", "NetVolume": "VOLUME"}),
}
# what a representation is called -> the kinds that it may be of (GEM004)
SHAPES = {"Body": ["SweptSolid", "Tessellation"], "Axis": ["Curve2D"], "FootPrint": ["Curve2D"]}
UNITS = {"foot": ("LENGTHUNIT", "METRE", F("0.3048")), "square foot": ("AREAUNIT", "SQUARE_METRE", F("0.09290304")), "cubic foot": ("VOLUMEUNIT", "CUBIC_METRE", F("0.028316846592"))}
findings = []


def check(what, holds):
    if not holds:
        findings.append(what)


# ---- STEP


def arguments(text):
    """The attributes of an instance: split at commas outside of brackets and quotes."""
    parts, depth, quoted, start = [], 0, False, 0
    for i, c in enumerate(text):
        if c == "'":
            quoted = not quoted
        elif not quoted and c in "()":
            depth += 1 if c == "(" else -1
        elif not quoted and c == "," and depth == 0:
            parts.append(text[start:i])
            start = i + 1
    return parts + [text[start:]]


def read(path):
    """The instances by their numbers: each an entity and its attributes, as they are written."""
    return instances_of(open(path, encoding="ascii").read())


def instances_of(text):
    check("a STEP file", text.startswith("ISO-10303-21;\nHEADER;\n") and text.endswith("ENDSEC;\nEND-ISO-10303-21;\n"))
    made = {}
    for line in text.split("DATA;\n")[1].split("ENDSEC;")[0].splitlines():
        number, name, inside = re.fullmatch(r"#(\d+)=(\w+)\((.*)\);", line).groups()
        check(f"#{number} once", int(number) not in made)
        made[int(number)] = (name, arguments(inside))
    return made


def references(argument):
    return [int(n) for n in re.findall(r"#(\d+)", re.sub(r"'[^']*'", "", argument))]


def spelt(argument):
    """What an IFC string says. A surrogate is no character of its own there (ISO 10303-21, 6.4.3)."""
    def written(found):
        digits, width = found.group(2), 4 if found.group(1) == "2" else 8
        numbers = [int(digits[i:i + width], 16) for i in range(0, len(digits), width)]
        check(f"{argument}: characters of Unicode", not any(0xD800 <= n < 0xE000 for n in numbers))
        check(f"{argument}: no shorter run does", width == 4 or all(n > 0xFFFF for n in numbers))
        return "".join(map(chr, numbers))

    check(f"{argument} is a string", re.fullmatch(WRITTEN["S"], argument))
    parts = re.split(r"\\X([24])\\([0-9A-F]+)\\X0\\", argument[1:-1])
    for i in range(0, len(parts), 3):
        parts[i] = parts[i].replace("''", "'").replace("\\\\", "\\")
    for i in range(1, len(parts), 3):
        parts[i + 1] = written(re.match(r"(.)(.*)", parts[i] + parts[i + 1]))
        parts[i] = ""
    return "".join(parts)


# ---- units

# The attributes that are lengths.
LENGTHS = {"IFCCARTESIANPOINT": [0], "IFCCARTESIANPOINTLIST2D": [0], "IFCCARTESIANPOINTLIST3D": [0], "IFCRECTANGLEPROFILEDEF": [3, 4], "IFCEXTRUDEDAREASOLID": [3], "IFCDOOR": [8, 9],
           "IFCWINDOW": [8, 9], "IFCMATERIALLAYER": [1], "IFCMATERIALLAYERSETUSAGE": [3], "IFCBUILDINGSTOREY": [9], "IFCQUANTITYLENGTH": [3], "IFCPROPERTYSINGLEVALUE": [2]}


def is_in_feet(made):
    return any(name == "IFCCONVERSIONBASEDUNIT" for name, _ in made.values())


def of_feet(text):
    """In millimetres: what is within two thousandths of half a nanometre of one was rounded."""
    halves = F(text) * F("304.8") * 2 * 10**6
    return halves.__round__() / F(2 * 10**6) if abs(halves - halves.__round__()) < F(4, 1000) else halves / (2 * 10**6)


def in_millimetres(made):
    """The same instances with lengths in millimetres, areas in square and volumes in cubic metres, also if the file is in feet."""
    if not is_in_feet(made):
        return made
    changed = {}
    for number, (name, args) in made.items():
        args = list(args)
        for i in LENGTHS.get(name, []):
            if name != "IFCPROPERTYSINGLEVALUE" or args[i].startswith(POSITIVE):
                args[i] = re.sub(NUMBER, lambda found: str(of_feet(found.group())), args[i])
        for kind, power in (("AREA", 2), ("VOLUME", 3)):
            if name == "IFCQUANTITY" + kind:
                args[3] = str(F(args[3]) * F("0.3048") ** power)
        changed[number] = (name, args)
    return changed


# ---- geometry


def numbers_of(made, instance):
    return [F(n) for n in made[instance][1][0].strip("()").split(",")]


def points_of(made, instance):
    return [tuple(F(c) for c in point.split(",")) for point in made[instance][1][0].strip("()").split("),(")]


def placed(made, placement):
    """The origin, x and y of a placement in the house; z is up."""
    within, axes = made[placement][1]
    point, _, along = made[references(axes)[0]][1]
    at, x = numbers_of(made, references(point)[0]), numbers_of(made, references(along)[0]) if along != "$" else [F(1), F(0), F(0)]
    y = [-x[1], x[0], F(0)]
    if within == "$":
        return at, x, y
    origin, u, v = placed(made, references(within)[0])
    turned = lambda d: [d[0] * u[k] + d[1] * v[k] + (k == 2) * d[2] for k in range(3)]
    return [o + t for o, t in zip(origin, turned(at))], turned(x), turned(y)


def solids_of(made, product):
    """Those of its body."""
    if made[product][1][6] == "$":
        return []
    shape = made[references(made[product][1][6])[0]]
    return [solid for representation in references(shape[1][2]) for solid in references(made[representation][1][3]) if made[solid][0] in SOLIDS]


def rings_of(made, profile):
    """The outline of a profile, and of its holes: the corners of each."""
    name, args = made[profile]
    lines = [references(args[2])[0]] + (references(args[3]) if name == "IFCARBITRARYPROFILEDEFWITHVOIDS" else [])
    return [[tuple(numbers_of(made, n)) for n in references(made[line][1][0])][:-1] for line in lines]


def area_of(ring):
    """Above 0 if its corners go counter-clockwise."""
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1])) / 2


def parts_of(ring, holes):
    """Rectangles between all lines through corners of outlines along axes, of what is within: (x0, x1, y0, y1)."""
    xs, ys = (sorted({corner[k] for corners in [ring] + holes for corner in corners}) for k in (0, 1))
    inside = lambda corners, x, y: sum(a[0] == b[0] and a[0] > x and min(a[1], b[1]) < y < max(a[1], b[1]) for a, b in zip(corners, corners[1:] + corners[:1])) % 2
    for x0, x1 in zip(xs, xs[1:]):
        for y0, y1 in zip(ys, ys[1:]):
            middle = (x0 + x1) / 2, (y0 + y1) / 2
            if inside(ring, *middle) and not any(inside(hole, *middle) for hole in holes):
                yield x0, x1, y0, y1


def boxes_of(made, product):
    """The boxes of a product in the house, of extruded profiles along axes: (low, high) of each."""
    at, x, y = placed(made, references(made[product][1][5])[0])
    for number in solids_of(made, product):
        solid = made[number][1]
        profile = made[references(solid[0])[0]][1]
        foot = numbers_of(made, references(made[references(solid[1])[0]][1][0])[0])[2]
        if made[references(solid[0])[0]][0] == "IFCRECTANGLEPROFILEDEF":
            middle, size = numbers_of(made, references(made[references(profile[2])[0]][1][0])[0]), [F(profile[3]), F(profile[4])]
            parts = [(middle[0] - size[0] / 2, middle[0] + size[0] / 2, middle[1] - size[1] / 2, middle[1] + size[1] / 2)]
        else:
            ring, *holes = rings_of(made, references(solid[0])[0])
            parts = parts_of(ring, holes)
        for part in parts:
            ends = [[at[k] + sum(part[2 * j + i] * (x, y)[j][k] for j in range(2)) + (k == 2) * (foot + i * F(solid[3])) for k in range(3)] for i in (0, 1)]
            yield [min(pair) for pair in zip(*ends)], [max(pair) for pair in zip(*ends)]


def box_of(made, product):
    """Of one box: its two corners in the house, the directions of its x and y axes, and its origin."""
    (low, high), = boxes_of(made, product)
    at, x, y = placed(made, references(made[product][1][5])[0])
    return low, high, x, y, at


def volume_of_faces(made, args):
    """Of a solid of flat faces: each of its edges is between two of them."""
    points = points_of(made, references(args[0])[0])
    rings = [[points[int(n) - 1] for n in made[face][1][0].strip("()").split(",")] for face in references(args[2])]
    edges = Counter((a, b) for ring in rings for a, b in zip(ring, ring[1:] + ring[:1]))
    check("a solid is closed", all(n == 1 and edges[b, a] == 1 for (a, b), n in edges.items()))
    total = F(0)
    for ring in rings:
        for b, c in zip(ring[1:], ring[2:]):
            u, v, w = ([p[k] - points[0][k] for k in range(3)] for p in (ring[0], b, c))
            total += sum(u[k] * (v[k - 2] * w[k - 1] - v[k - 1] * w[k - 2]) for k in range(3)) / 6
    check("and has a volume", total > 0)
    return total


def volume_of(made, product):
    """Cubic millimetres, of all solids of its shape."""
    total = F(0)
    for solid in solids_of(made, product):
        if made[solid][0] == "IFCPOLYGONALFACESET":
            total += volume_of_faces(made, made[solid][1])
            continue
        profile, _, _, depth = made[solid][1]
        name, args = made[references(profile)[0]]
        if name == "IFCRECTANGLEPROFILEDEF":
            area = F(args[3]) * F(args[4])
        else:
            ring, *holes = rings_of(made, references(profile)[0])
            check("outlines go counter-clockwise", all(area_of(corners) > 0 for corners in [ring] + holes))
            area = area_of(ring) - sum(map(area_of, holes))
        check("a solid has a volume", area > 0 and F(depth) > 0)
        total += area * F(depth)
    return total


# ---- relations


def related(made, relation, one, many):
    """Pairs of a relation: what one attribute refers to, and each that another does."""
    return [(references(args[one])[0], to) for name, args in made.values() if name == relation for to in references(args[many])]


def of_kind(made, name):
    return [number for number, (entity, _) in made.items() if entity == name]


def sets_of(made, kind):
    """(product, name of a set of that kind, {name of a value: what is written})."""
    for definition, product in related(made, "IFCRELDEFINESBYPROPERTIES", 5, 4):
        name, args = made[definition]
        if name == kind:
            values = {spelt(made[n][1][0]): made[n][1][3 if kind == "IFCELEMENTQUANTITY" else 2] for n in references(args[-1])}
            yield product, spelt(args[2]), values


# ---- the rules


def check_schema(made):
    """Attributes, references and identifiers."""
    ids = Counter()
    for number, (name, args) in made.items():
        check(f"{name}, known", name in TYPES)
        check(f"#{number}={name} has {len(args)} attributes", len(args) == len(TYPES.get(name, "")))
        for i, (argument, wanted) in enumerate(zip(args, TYPES.get(name, ""))):
            left_out = argument == "$" and wanted.islower()
            check(f"#{number}={name}: attribute {i} is {argument}", left_out or re.fullmatch(WRITTEN[wanted.upper()], argument))
            values = VALUES.get((name, i))
            check(f"#{number}={name}: {argument}", values is None or argument.strip(".") in values.split())
        for i, argument in enumerate(args):
            for to in references(argument):
                check(f"#{number} refers to #{to}", to in made)
                wanted = REFERENCES.get((name, i))
                check(f"#{number}={name}: {made[to][0]} as attribute {i}", wanted is None or made[to][0] in wanted)
        if TYPES.get(name, "").startswith(ROOT):
            check(f"#{number}: an identifier", re.fullmatch(r"'[0-3][0-9A-Za-z_$]{21}'", args[0]))
            ids[args[0]] += 1
    check("PJS003: identifiers are unique", all(n == 1 for n in ids.values()))


def check_structure(made):
    """SPS002, SPS005, SPS007, SPS008, OJP001, BLT003: each element is in one storey, or of one whole, in whose placement it is."""
    whole = {}
    for of, part in related(made, "IFCRELAGGREGATES", 4, 5):
        check(f"SPS002: {made[part][0]} of {made[of][0]}", made[part][0] in COMPOSED.get(made[of][0], []))
        check(f"#{part} is of one whole", part not in whole)
        whole[part] = of
        if made[of][0] in ELEMENTS:
            within = made[references(made[part][1][5])[0]][1][0]
            check(f"OJP001: {made[part][0]} is placed in {made[of][0]}", within == made[of][1][5])
    inside = Counter(to for _, to in related(made, "IFCRELCONTAINEDINSPATIALSTRUCTURE", 5, 4))
    voided = Counter(to for _, to in related(made, "IFCRELVOIDSELEMENT", 4, 5))
    for number, (name, args) in made.items():
        if name in ELEMENTS:
            check(f"SPS007: #{number}={name} is in one storey, or of a whole there", inside[number] + (number in whole) == 1)
        elif name == "IFCOPENINGELEMENT":
            check(f"an opening is of one wall, and nowhere else: #{number}", voided[number] == 1 and not inside[number] and number not in whole)
        elif name in SPACES:
            check(f"SPS002: {name} is of something", number in whole)
            check("SPS008: only spaces have a shape", (args[6] != "$") == (name == "IFCSPACE"))
    check("one project", len(of_kind(made, "IFCPROJECT")) == 1)


def check_shapes(made):
    """GEM001 to GEM004, GEM111, GEM112: representations; solids are closed and have a volume."""
    for product, (name, args) in made.items():
        if name not in PRODUCTS or args[6] == "$":
            continue
        found = [(spelt(made[r][1][1]), spelt(made[r][1][2])) for r in references(made[references(args[6])[0]][1][2])]
        check(f"GEM003: {found}", len({said for said, _ in found}) == len(found))
        check(f"GEM004: {found}", all(kind in SHAPES.get(said, []) for said, kind in found))
        check(f"GEM002: {name} has a body", name == "IFCSTAIR" or "Body" in dict(found))
        check("a wall of one box has an axis", name != "IFCWALL" or ("Axis" in dict(found)) == ("SweptSolid" in dict(found).values()))
        volume_of(made, product)
        for solid in solids_of(made, product):
            swept = made[solid][0] == "IFCEXTRUDEDAREASOLID"
            check(f"GEM004: {made[solid][0]}", (dict(found)["Body"] == "SweptSolid") == swept)
    for number in of_kind(made, "IFCINDEXEDPOLYCURVE"):
        points = points_of(made, references(made[number][1][0])[0])
        check("GEM112: points of a curve differ", all(a != b for a, b in zip(points, points[1:])))
    for number in of_kind(made, "IFCPOLYLINE"):
        points = [tuple(numbers_of(made, n)) for n in references(made[number][1][0])]
        check("GEM111: corners of a line differ, but that it ends where it begins", points[0] == points[-1] and len(set(points)) == len(points) - 1)
    styled = [to for name, args in made.values() if name == "IFCSTYLEDITEM" for to in references(args[0])]
    check("what has a look has one", len(styled) == len(set(styled)))
    coloured = {solid for number, (name, _) in made.items() if name in ELEMENTS for solid in solids_of(made, number)}
    check("all solids of elements have a look", set(styled) == coloured)


def check_sets(made):
    """PSE001, QTY001, OJT001: properties, quantities and types."""
    seen = Counter()
    for product, name, values in sets_of(made, "IFCPROPERTYSET"):
        entity, known = PROPERTIES.get(name, ("", {}))
        check(f"PSE001: {name} of {made[product][0]}", made[product][0] == entity)
        check(f"{name} has a reference", values.get("Reference", "").startswith("IFCIDENTIFIER("))
        check(f"PSE001: {name}: {values}", all(values[value].startswith(known.get(value, "-") + "(") for value in values if value != "Reference"))
        seen[product] += 1
    for number in of_kind(made, "IFCELEMENTQUANTITY"):
        args = made[number][1]
        _, known = QUANTITIES.get(spelt(args[2]), ("", {}))
        check("QTY001: MethodOfMeasurement", args[4] == "'BaseQuantities'")
        check(f"QTY001: {args[2]}", all("IFCQUANTITY" + known.get(spelt(made[n][1][0]), "") == made[n][0] for n in references(args[5])))
    for product, name, _ in sets_of(made, "IFCELEMENTQUANTITY"):
        check(f"QTY001: {name} of {made[product][0]}", made[product][0] == QUANTITIES.get(name, ("",))[0])
    asked = {entity for entity, _ in PROPERTIES.values()}
    check("elements have their common properties", all(seen[n] == 1 for n, (name, _) in made.items() if name in asked))
    typed = Counter()
    for kind, product in related(made, "IFCRELDEFINESBYTYPE", 5, 4):
        check(f"{made[product][0]} of {made[kind][0]}", made[kind][0] == made[product][0] + "TYPE")
        predefined = {"IFCFURNITURETYPE": 10}.get(made[kind][0], 9)
        check("OJT001: either a part or its type says its kind", made[kind][1][predefined] == ".NOTDEFINED.")
        typed[product] += 1
    check("elements and spaces have one type", all(typed[n] == 1 for n, (name, _) in made.items() if name in ELEMENTS + ["IFCSPACE"]))
    check("each type is of something", len({kind for kind, _ in related(made, "IFCRELDEFINESBYTYPE", 5, 4)}) == sum(name.endswith("TYPE") and name in TYPES and TYPES[name].startswith(TYPE) for name, _ in made.values()))
    names = Counter((made[n][0], made[n][1][2], tuple(made[n][1][9:])) for n, (name, _) in made.items() if TYPES.get(name, "").startswith(TYPE))
    check("no two types are alike", all(count == 1 for count in names.values()))


def check_resources(made):
    """IFC102, IFC105, PJS001: nothing that is deprecated, nothing that nobody needs, units as they are known."""
    for args in (args for name, args in made.values() if name == "IFCSTAIRFLIGHT"):
        check("IFC102: sizes of flights are properties", args[8:12] == ["$"] * 4)
    needed, left = set(), [n for n, (name, _) in made.items() if TYPES.get(name, "").startswith(ROOT)]
    looks, parts = {}, {}
    for number, (name, args) in made.items():
        if name == "IFCSTYLEDITEM":
            looks[references(args[0])[0]] = number
        if name == "IFCGEOMETRICREPRESENTATIONSUBCONTEXT":
            parts.setdefault(references(args[6])[0], []).append(number)
    while left:
        number = left.pop()
        if number in needed:
            continue
        needed.add(number)
        left += [to for argument in made[number][1] for to in references(argument)] + parts.get(number, []) + ([looks[number]] if number in looks else [])
    check(f"IFC105: {sorted({made[n][0] for n in made if n not in needed})} that nobody needs", len(needed) == len(made))
    for args in (args for name, args in made.values() if name == "IFCCONVERSIONBASEDUNIT"):
        kind, of, size = UNITS.get(spelt(args[2]), ("", "", 0))
        value, base = made[references(args[3])[0]][1]
        check(f"PJS001: {args[2]}", args[1] == f".{kind}." and F(re.search(REAL, value).group()) == size and made[references(base)[0]][1][1:] == [f".{kind}.", "$", f".{of}."])


def check_file(made):
    for rule in (check_schema, check_structure, check_shapes, check_sets, check_resources):
        rule(made)


# What is changed in a file, so that a rule is broken: what is found, and what stands there then.
FAULTS = {
    "a negative depth": (r"(IFCEXTRUDEDAREASOLID\([^)]*,)(\d)", r"\1-\2"),
    "a kind that IFC has not": (r"(IFCWALL\(.*),\.SOLIDWALL\.\);", r"\1,.SOLIDWALLX.);"),
    "USERDEFINED without a name": (r"(IFCWALL\(.*),\.SOLIDWALL\.\);", r"\1,.USERDEFINED.);"),
    "elements in no storey": (r"#\d+=IFCRELCONTAINEDINSPATIALSTRUCTURE.*\n", ""),
    "an attribute too few": (r"(IFCSPACE\(.*),\$\);", r"\1);"),
    "another reference": (r"(IFCRELVOIDSELEMENT\('[^']*',\$,\$,\$,)(#\d+),(#\d+)", r"\1\3,\2"),
    "a quantity that no set has": ("'NetSideArea'", "'SideArea'"),
    "quantities by another method": ("'BaseQuantities'", "'Tartan'"),
    "a property of another type": (r"('IsExternal',\$),IFCBOOLEAN\(\.T\.\)", r"\1,IFCIDENTIFIER('yes')"),
    "a set of another entity": ("'Pset_WallCommon'", "'Pset_DoorCommon'"),
    "two words for one kind": (r"(IFCWALLTYPE\(.*),\.NOTDEFINED\.\);", r"\1,.SOLIDWALL.);"),
    "a wall without a type": (r"#\d+=IFCRELDEFINESBYTYPE.*\n", ""),
    "a body that is no body": ("'Body','SweptSolid'", "'Body','Curve2D'"),
    "a solid without a look": (r"#\d+=IFCSTYLEDITEM.*\n", ""),
    "a point that nobody needs": ("ENDSEC;\nEND-ISO", "#999999=IFCCARTESIANPOINT((0.,0.,0.));\nENDSEC;\nEND-ISO"),
    "a room in a room": (r"(IFCRELAGGREGATES\(.*,)(#\d+),\((#\d+)\)\);", r"\1\3,(\2));"),
}


def find_faults(path):
    """Each fault has to be found: also one identifier twice."""
    text = open(path, encoding="ascii").read()
    first, second = re.findall(r"IFCWALL\('([^']+)'", text)[:2]
    for name, (old, new) in {**FAULTS, "one identifier twice": (re.escape(second), first)}.items():
        changed = re.sub(old, new, text, count=1)
        findings.clear()
        check_file(instances_of(changed))
        seen = changed != text and bool(findings)
        findings.clear()
        if not seen:
            sys.exit(f"{name}: {'not found' if changed != text else 'cannot be put in'}")


def lost(old, new):
    """The entities of what is in one file and, by its identifier, not in the other."""
    first, second = ({args[0]: name for name, args in made.values() if TYPES.get(name, "").startswith(ROOT)} for made in (read(old), read(new)))
    same = all(first[n] == second[n] for n in first.keys() & second.keys())
    return " ".join(sorted(first[n] for n in first.keys() - second.keys())) if same else "identifiers are of other entities"


def check_tables(folder):
    """Sets of properties and quantities here are some of those in buildingSMART's tables."""
    csv.field_size_limit(10**9)
    for name, own, kind_of in (("pset", PROPERTIES, lambda d: str(d["data_type"]["instance"]).upper()), ("qto", QUANTITIES, lambda d: d["property_type"].upper().replace("IFCQUANTITY", ""))):
        with open(f"{folder}/{name}_definitions.csv", newline="", encoding="utf-8") as file:
            theirs = {row["Name"]: row for row in csv.DictReader(file)}
        for set_name, (entity, values) in own.items():
            row = theirs.get(set_name)
            kinds = {d["property_name"]: kind_of(d) for d in ast.literal_eval(row["property_definitions"])} if row else {}
            applies = row and entity in (applicable.upper() for applicable in ast.literal_eval(row["applicable_entities"]))
            check(f"{set_name} is of {entity}, and has {values}, not {kinds}", applies and all(kinds.get(value) == kind for value, kind in values.items()))


def main():
    if sys.argv[1] == "--tables":
        check_tables(sys.argv[2])
        sys.exit("\n".join(findings) or print("the tables agree"))
    if sys.argv[1] == "--kept":
        print(lost(sys.argv[2], sys.argv[3]))
        return
    for path in sys.argv[2 if sys.argv[1] == "--faults" else 1:]:
        check_file(read(path))
        if findings:
            sys.exit("\n".join([path] + findings[:20]))
    if sys.argv[1] == "--faults":
        find_faults(sys.argv[2])
    print("fine")


if __name__ == "__main__":
    main()
