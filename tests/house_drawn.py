#!/usr/bin/env python3
"""Holds the drawings of a house to what offices ask: house_drawn.py SVG JSON (of a sheet in metres, both of one house),
or house_drawn.py SVG (of any sheet), of which it looks only at whether what is written is legible.

Lines are as wide as ISO 128 has them, capitals at least 2.5 mm high; each tag in a circle is in the table of doors and windows, with as many
as the house has; each room's number is in the table of rooms, with the net area that the JSON has; furniture is drawn by symbols; nothing is written over something else that is written, or into the circle of a tag."""
import html
import json
import re
import sys
from collections import Counter

WIDTHS = {".51": "hatch", ".709": "thin", ".992": "seen", "1.417": "cut"}  # 0.18, 0.25, 0.35, 0.5 mm in points
CAPITALS, MM = 0.729, 72 / 25.4
failures = []


def check(what, holds):
    if not holds:
        failures.append(what)


def place(at, text):
    """Where a text surely is, as left, top, right, bottom: letters are half as wide as high, at least on the mean."""
    of = {name: value for name, value in re.findall(r'([a-z-]+)="([^"]*)"', at)}
    x, y, size = float(of["x"]), float(of["y"]), float(of["font-size"])
    wide = 0.5 * len(html.unescape(text)) * size
    if "text-anchor" in of and re.fullmatch(r"[DW]\d+", text):
        return x - 0.9 * size, y - 1.25 * size, x + 0.9 * size, y + 0.55 * size  # in its circle
    before = {"start": 0, "middle": wide / 2, "end": wide}[of.get("text-anchor", "start")]
    if of.get("transform", "").startswith("rotate(-90 "):
        return x - 0.7 * size, y + before - wide, x, y + before
    return x - before, y - 0.7 * size, x - before + wide, y


def check_apart(texts):
    places = [place(at, text) for at, text in texts]
    for i, a in enumerate(places):
        for k, b in enumerate(places[:i]):
            check(f"{texts[i][1]} is written over {texts[k][1]}", a[0] >= b[2] or b[0] >= a[2] or a[1] >= b[3] or b[1] >= a[3])


def finish():
    for failure in failures:
        print(failure)
    sys.exit(bool(failures))


def main():
    svg = open(sys.argv[1], encoding="utf-8").read()
    check_apart(re.findall(r"<text ([^>]*)>([^<]*)", svg))
    if len(sys.argv) < 3:
        finish()
    house = json.load(open(sys.argv[2], encoding="utf-8"))
    black = re.findall(r'stroke="#000" stroke-width="([^"]*)"', svg)
    check(f"widths {set(black) - set(WIDTHS)}", set(black) <= set(WIDTHS) and {".709", ".992", "1.417"} <= set(black))
    texts = re.findall(r'<text ([^>]*)>([^<]*)', svg)
    sizes = [float(re.search(r'font-size="([^"]*)"', at)[1]) for at, _ in texts]
    check(f"capitals {min(sizes) * CAPITALS / MM:.2f} mm high", min(sizes) * CAPITALS / MM > 2.49)
    said = [text for _, text in texts]

    plain = {"wall", "party", "open", "floor", "stair"}
    kinds = Counter(face["kind"] for face in house["faces"] if face["kind"] not in plain and face["rel"] != "above")
    table = {said[i]: (said[i + 1], said[i + 2]) for i, text in enumerate(said[:-2]) if re.fullmatch(r"[DW]\d+", text) and re.match(r"\d+: ", said[i + 2])}
    tags = Counter(text for text in said if re.fullmatch(r"[DW]\d+", text))
    for tag, (kind, size) in table.items():
        check(f"{tag} is {kind}: {size}, of {kinds}", int(size.split(":")[0]) == kinds[kind])
        check(f"{tag} is drawn {tags[tag] - 1} times", tags[tag] - 1 == kinds[kind])
    check(f"tags {set(tags) - set(table)} are in the table", set(tags) <= set(table) and len(table) == len(kinds))

    # Each flight says how many risers it has: on its own floor, and where it comes up.
    flights = sum(face["rel"] == "above" and face["kind"] not in plain for face in house["faces"])
    for word in ("UP", "DN"):
        told = sum(re.match(word + r" \d+(R| \u00d7 \d+/\d+)$", text) is not None for text in said)
        check(f"{told} times {word}, of {flights} flights", told == flights)

    net = Counter(f"{int(room['net']) / 1e18:.1f} m\u00b2" for room in house["rooms"])
    rooms = {said[i]: said[i + 2] for i, text in enumerate(said[:-2]) if re.fullmatch(r"\d\.\d\d", text) and said[i + 2].endswith(" net")}
    check(f"areas {rooms} are net {net}", Counter(area.removesuffix(" net") for area in rooms.values()) == net)
    check("each room has its number", len(rooms) == len(house["rooms"]))
    areas = {text for text in said if text.endswith("m\u00b2")}
    check(f"areas in plans {areas - set(net)}", areas <= set(net))
    check("each room is in a plan and in the table", all(said.count(number) == 2 for number in rooms))

    things = [solid for solid in house["solids"] if solid["kind"] == "item"]
    used = len(re.findall(r"<use ", svg))
    wide = {tag: float(size.split()[1]) for tag, (_, size) in table.items()}
    leaves = sum(kinds[kind] * (2 if wide[tag] > 1.22 else 1) for tag, (kind, _) in table.items() if tag[0] == "D")
    panes = sum(kinds[kind] for tag, (kind, _) in table.items() if tag[0] == "W")
    check(f"{used} symbols for {len(things)} things, {leaves} leaves and {panes} panes", used == len(things) + leaves + panes)
    # Forms have storeys that not each house has.
    levels = {found[1] for text in said if (found := re.fullmatch(r"(\S+) [+\u00b1-]\d[\d.]*", text))}
    storeys = {cell["storey"] for cell in house["cells"]}
    check(f"levels {levels} are those of {storeys}", len(levels - {"top"}) == len(storeys))
    for word in ("A-A", "B-B", "UP ", "areas are net", "\u00b10.00", "1:100"):
        check(f"the sheet says {word}", any(word in text for text in said))
    finish()


main()
