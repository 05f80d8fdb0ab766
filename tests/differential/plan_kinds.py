"""Files of plans and of houses, which share a grammar."""
import houses
import plans
from by_house_reference import houses_by_reference
from by_reference import circles_by_reference, plans_by_reference
from kind import Kind
from plan_questions import OF_FILES, OF_LIBRARIES, QUICK, PlanSubject
from searched import OF_SEARCHED
from source import read_source


class PlanKind(Kind):
    grammar_file, suffix, notation = "plan.y", ".plan", plans.Plans()
    not_reached = {
        "file: ONE_EXPRESSION expression": "the command line's, not a file's",
        "file: ONE_PATTERN pattern": "the command line's, not a file's",
        "file: ONE_LITERAL plan": "the command line's, not a file's",
        "file: ONE_SETTING setting": "the command line's, not a file's",
        "file: items": "the start is `items`",
        **dict.fromkeys(plans.OF_LIBRARIES, "what trays there are is known once plans are counted: plan.rows makes such files"),
        **dict.fromkeys(["form_clause: thickness size OPEN_BRACE CLOSE_BRACE", "form_clause: thickness size OPEN_BRACE layers CLOSE_BRACE", "layers: layer",
                         "layers: layers COMMA layer", "layer: NAME size", "thickness: WALL OUTSIDE", "thickness: WALL NAME"], "layers add up to a thickness: house.layers makes such forms"),
        **dict.fromkeys([*plans.WALKED, "walk: WALK", "walk: LEAST WALK", "walk_end: cells", "walk_end: NAME"],
                        "houses of all plans are not counted by walks: house.walks makes libraries of houses on one plan"),
        "value: NUMBER doc role": "taken by the grammar in order to say that a number has no unit",
    }

    def __init__(self, name, make_file):
        self.name, self.make_file = name, make_file

    def subject(self, path, folder, part, tree):
        return PlanSubject(path, folder, part, tree)

    def questions(self, path):
        libraries = [item.name for item in read_source(path).of("library")]
        always = [(q, name) for q in QUICK + [plans_by_reference, houses_by_reference] for name in libraries]
        always.append((circles_by_reference(self), None))
        return always, [(q, None) for q in OF_FILES] + [(q, name) for name in libraries for q in OF_LIBRARIES]


class SearchedKind(PlanKind):
    """Of the same files as plans: only what is answered by search where an automaton passes a limit."""

    def questions(self, path):
        return [(q, item.name) for item in read_source(path).of("library") for q in OF_SEARCHED], []


PLANS = PlanKind("plans", plans.make_file)
SEARCHED = SearchedKind("searched", plans.make_file)
HOUSES = PlanKind("houses", houses.make_file)
