#!/usr/bin/env python3
"""Walks through houses and ways out of them, against an independent slow model: house_walks.py TARTAN MODEL.py FIRST COUNT

Makes so many forms at random, as house_ways.py does. Of the houses on one plan each walk and each number of ways out is found here: the model
says how long ways over single floors are; walks go from passage to passage over these; ways out are counted by the fewest doors and flights
that have to be shut until none is left. Libraries that keep houses with a walk of at most one of these lengths, less than it, or at least it,
have just the houses that have it so: in their order, by their number, and by their ranks on the plan. So a nanometre decides."""
import heapq
import itertools
import json
import math
import os
import sys
import tempfile

import house_ways

PLAN_HOUSES = 40  # on the plan that is looked at
OPPOSITE = {"back": "front", "front": "back", "left": "right", "right": "left"}
QUERIES = ("walk(cell(any), to outside)", "least walk(cell(any), to outside)", "walk(cell(hall), to cell(room or bath or stair))",
           "walk(cell(room or bath or stair), to cell(hall), through cell(hall or stair))", "walk(cell(any), to outside, by door or open or steps)",
           "exits(cell(any))", "exits(cell(room or bath))")


class Walked:
    """A house as JSON, with the floors that the model judges it by."""

    lengths = {}  # of floors that were seen before

    def __init__(self, model, asked, house):
        self.model, self.asked, self.house = model, asked, house
        self.cells = {cell["id"]: cell for cell in house["cells"]}
        self.faces = {face["id"]: face for face in house["faces"]}
        self.floors = self.floors_of()
        self.flights = {face["id"]: face for face in house["faces"] if "foot" in face}
        self.climbed = {end for face in self.flights.values() for end in (face["a"], face["b"])}
        self.points = [point for cell in self.floors for point in self.points_of(cell)]
        self.near = self.join()

    def floors_of(self):
        seen, judge = [], self.model.judge

        def recorded(floor):
            seen.append(floor)
            return judge(floor)

        self.model.judge = recorded
        faults = self.model.house(self.asked, self.house)
        self.model.judge = judge
        if [fault for fault in faults if fault[1] != "no way leads to it"]:
            raise RuntimeError(f"no house: {faults}")
        cells = [cell["id"] for cell in self.house["cells"] if cell.get("function") and cell["function"] != "void"]
        return dict(zip(cells, seen[-len(cells):]))

    def bare(self, cell):
        function = self.cells[cell]["function"]
        return function not in self.asked["tiled"] | self.asked["climb"] | self.asked["outdoor"] and cell not in self.climbed

    def landing(self, cell, landing):
        """The cell in which it lies, and the side over which it reaches into that, or None."""
        floor = self.floors[cell]
        if self.model.within(landing, floor["clear"]):
            return cell, None
        for number, beyond in floor["bare"]:
            passage, clear = floor["passages"][number], floor["clear"]
            across = passage["side"] in ("back", "front")
            pick = (max, min, min, max) if across else (min, max, max, min)
            if self.model.within(landing, [one(a, b) for one, a, b in zip(pick, clear, beyond)]):
                return passage["other"], OPPOSITE[passage["side"]]
        raise RuntimeError("a landing lies nowhere")

    def points_of(self, cell):
        """(cell, face, spot, place) of all places where one stands in a passage or on a landing; the floor gets what is open there."""
        floor = self.floors[cell]
        half, clear, more, points = floor["way"] // 2, floor["clear"], [], []
        middle = lambda box: ((box[0] + box[1]) // 2, (box[2] + box[3]) // 2)
        line = lambda passage: middle(self.model.line(clear, passage, half))
        for passage in floor["passages"]:
            points.append((cell, passage["face"], "middle", line(passage)))
            if passage["kind"] == "door" or passage["other"] is None or not (self.bare(cell) or self.bare(passage["other"])):
                continue
            at = self.faces[passage["face"]]["at"]
            low, high = at[:2] if passage["side"] in ("back", "front") else at[2:]
            low, high = low + self.asked["wall"] // 2, high - self.asked["wall"] // 2
            for spot, start in (("low", low), ("high", high - floor["way"])):
                more.append(dict(passage, **{"from": start, "to": start + floor["way"]}))
                points.append((cell, passage["face"], spot, line(more[-1])))
        for face in self.flights.values():
            for own, landing in ((face["a"], face["foot"]), (face["b"], face["head"])):
                where, side = self.landing(own, landing)
                if where != cell:
                    continue
                if side:
                    ends = landing[:2] if side in ("back", "front") else landing[2:]
                    more.append({"side": side, "from": ends[0], "to": ends[1], "kind": "open"})
                x, y = middle(landing)
                points.append((cell, face["id"], "landing", (min(max(x, clear[0]), clear[1]), min(max(y, clear[2]), clear[3]))))
        floor = dict(floor, passages=floor["passages"] + more, keeps=[], landings=[])
        self.reach(cell, floor, [point[3] for point in points])
        return [point for point in points if self.length(cell, point[3], point[3]) is not None]

    def reach(self, cell, floor, ends):
        key = json.dumps([floor[name] for name in ("way", "clear", "obstacles")] + [[p[n] for n in ("side", "from", "to")] for p in floor["passages"]] + [ends])
        if key not in self.lengths:
            self.lengths[key] = self.model.walks(floor, list(ends)) if ends else {}
        floor["lengths"] = self.lengths[key]
        self.floors[cell]["lengths"] = self.lengths[key]

    def length(self, cell, a, b):
        return self.floors[cell]["lengths"][a, b]

    def join(self):
        """From each point to others: how far."""
        near = {point: [] for point in self.points}
        up = lambda n: (lambda r: r + (r * r < n))(math.isqrt(n))
        for a, b in itertools.permutations(self.points, 2):
            if a[0] == b[0] and self.length(a[0], a[3], b[3]) is not None:
                near[a].append((b, self.length(a[0], a[3], b[3]), a[0]))
            elif a[0] != b[0] and a[1:3] == b[1:3]:
                far = self.flight_length(a[1]) if a[2] == "landing" else up((a[3][0] - b[3][0]) ** 2 + (a[3][1] - b[3][1]) ** 2)
                near[a].append((b, far, None))
        return near

    def flight_length(self, face):
        face = self.flights[face]
        flight = self.asked["flights"][face["kind"]]
        storey = self.asked["storeys"][self.cells[face["a"]]["storey"]]
        shape = self.model.shape(flight, storey, self.asked["deck"], self.asked["headroom"])
        if flight["turn"] == "quarter":   # as long whatever its arms are
            steps = -(-storey // flight["rise"][1])
            return (steps - 1 - max(flight["winders"], 1)) * flight["going"] + 2 * flight["wide"]
        return shape["going"] + flight["wide"]

    def passages(self, cell):
        return {passage["face"] for passage in self.floors[cell]["passages"]}

    def is_of(self, point, cell):
        return point[1] in self.passages(cell) if point[2] != "landing" else point[0] == cell and not self.passages(cell)

    def outdoors(self, cell):
        return self.cells[cell]["storey"] == 0 and self.cells[cell]["function"] in self.asked["outdoor"]

    def goals(self, to, by):
        there = [cell for cell in self.floors if (self.outdoors(cell) if to is None else self.cells[cell]["function"] in to)]
        outside = lambda point: to is None and self.faces[point[1]]["rel"] == "outside"
        return {point for point in self.points if self.faces[point[1]]["kind"] in by and (outside(point) or any(self.is_of(point, cell) for cell in there))}, there

    def walk(self, start, to, through, by, most):
        """The number, None where a cell has no walk, or "none" without cells."""
        goals, there = self.goals(to, by)
        far = {}
        heap = [(0, point) for point in goals]
        while heap:
            length, point = heapq.heappop(heap)
            if point in far:
                continue
            far[point] = length
            for other, more, cell in self.near[point]:
                if self.faces[other[1]]["kind"] in by and (cell is None or self.cells[cell]["function"] in through):
                    heapq.heappush(heap, (length + more, other))
        found = []
        for cell in self.floors:
            if self.cells[cell]["function"] in start:
                ways = [far[point] for point in far if self.is_of(point, cell)]
                found.append(0 if cell in there else min(ways) if ways else None)
        return "none" if not found else None if None in found else (max if most else min)(found)

    def leads_out(self, cell, shut):
        """Is there a way out with these faces shut?"""
        todo = [face for face in ({p[1] for p in self.points if self.is_of(p, cell)} | self.passages(cell)) - shut]
        met = set(todo)
        over = {point for point in self.points if any(where is None for _, _, where in self.near[point]) or self.faces[point[1]]["rel"] == "outside"}
        while todo:
            face = todo.pop()
            if self.faces[face]["rel"] == "outside":
                return True
            for point in (point for point in self.points if point[1] == face):
                if self.outdoors(point[0]):
                    return True
                for other in over:
                    if other[0] == point[0] and self.length(point[0], point[3], other[3]) is not None and other[1] not in met | shut:
                        met.add(other[1])
                        todo.append(other[1])
        return False

    def exits(self, start):
        found = []
        for cell in self.floors:
            if self.cells[cell]["function"] not in start or self.outdoors(cell):
                continue
            faces = sorted({point[1] for point in self.points})
            found.append(next(n for n in range(len(faces) + 1) if any(not self.leads_out(cell, set(shut)) for shut in itertools.combinations(faces, n))))
        return min(found, default="none")


def value(walked, query, form):
    functions = {"hall", "room", "bath", "stair", "terrace"}
    words = lambda text: functions if text == "any" else set(text.split(" or "))
    inner = lambda word: words(query.split(word + "cell(")[1].split(")")[0]) if word + "cell(" in query else None
    start = words(query.split("cell(")[1].split(")")[0])
    if query.startswith("exits"):
        return walked.exits(start)
    kinds = set(form.openings) | {"open", "steps"}
    by = set(query.split(" by ")[1].rstrip(")").split(" or ")) if " by " in query else kinds
    return walked.walk(start, inner("to "), inner("through ") or functions, by, not query.startswith("least"))


def written(number, query):
    return str(number) if query.startswith("exits") else f"{number // 1000000}.{number % 1000000:06}mm"


def holds(number, sign, bound):
    if number is None:
        return False
    return {"<=": number <= bound, "<": number < bound, ">=": number >= bound}[sign]


def compare(form, path, query, lines, numbers, plan, scratch):
    """What differs between the houses that libraries keep and those that ought to be, or None; how many were kept."""
    least = query.startswith("least") or query.startswith("exits")
    known = sorted({number for number in numbers if isinstance(number, int)})
    if not known:
        return None, 0
    bound, kept = known[len(known) // 2], 0
    for sign in ("<=", "<", ">="):
        own = os.path.join(scratch, "asked.plan")
        with open(path) as text, open(own, "w") as out:
            out.write(text.read() + f"library some from rows in huts {{ require {query} {sign} {written(bound, query)} }}\n")
        infinite = float("inf") if least else float("-inf")
        wanted = [line for line, number in zip(lines, numbers) if holds(infinite if number == "none" else number, sign, bound)]
        got = house_ways.run("enumerate", own, "--library", "some", "--plan", plan).splitlines()
        if got != wanted:
            odd = next((line for line in lines if (line in got) != (line in wanted)), "in another order")
            return f"{query} {sign} {written(bound, query)}: {len(got)} houses, not {len(wanted)}; the first that differs: {odd}, {dict(zip(lines, numbers)).get(odd)}", 0
        counted = " ".join(house_ways.run("count", own, "--library", "some", "--plan", plan).split())
        if f"houses {len(wanted)} " not in counted + " ":
            return f"{query}: counted otherwise than {len(wanted)}: {counted}", 0
        kept += len(wanted)
    return None, kept


def check(model, seed, scratch):
    form = house_ways.Form(seed)
    path = os.path.join(scratch, "ways.plan")
    with open(path, "w") as file:
        file.write(form.text(True))
    houses = house_ways.houses_of(path)
    plans = {line.split(";")[0].strip() for line in houses}
    by_plan = {plan: [line for line in houses if line.split(";")[0].strip() == plan] for plan in plans}
    fit = sorted((plan for plan, lines in by_plan.items() if 1 < len(lines) <= PLAN_HOUSES), key=lambda plan: (len(by_plan[plan]), plan))
    if len(houses) > house_ways.HOUSES or not fit:
        return None
    plan = fit[-1]
    asked = model.form_of(path)
    asked["headroom"] = form.headroom * house_ways.INCH
    walked, out = [], os.path.join(scratch, "house.json")
    for line in by_plan[plan]:
        house_ways.run("house", path, line, "-o", out)
        with open(out) as file:
            walked.append(Walked(model, asked, house_ways.tell(form, model, json.load(file))))
    kept, valued = 0, 0
    for query in QUERIES:
        for name, words in (("bath", "function bath"), ("stair", "function stair"), ("steps", "flight steps")):
            query = query if words in form.text(True) else query.replace(f" or {name}", "")
        numbers = [value(one, query, form) for one in walked]
        odd, some = compare(form, path, query, by_plan[plan], numbers, plan, scratch)
        if odd:
            return len(walked), f"form {seed}: {odd}", 0, 0
        kept, valued = kept + some, valued + sum(isinstance(number, int) and number > 0 for number in numbers)
    return len(walked), None, kept, valued


def main():
    house_ways.tartan, model, first, count = sys.argv[1], house_ways.load(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
    forms, seen, kept, valued, bad, seed = 0, 0, 0, 0, 0, first
    with tempfile.TemporaryDirectory() as scratch:
        while forms < count:
            found = check(model, seed, scratch)
            seed += 1
            if found is None:
                continue
            forms, seen, kept, valued = forms + 1, seen + found[0], kept + found[2], valued + found[3]
            if found[1]:
                bad += 1
                print(found[1])
    print(seen, "houses of", forms, "forms,", kept, "kept,", valued, "numbers above 0,", bad, "differ")
    sys.exit(bad > 0 or kept == 0 or valued == 0)


if __name__ == "__main__":
    main()
