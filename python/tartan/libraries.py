"""Libraries of plans: counted, ranked, sampled, measured and compared, without listing them."""
from __future__ import annotations

import collections.abc
import operator
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, List, Optional, Sequence

from tartan import _arrays, _html
from tartan._call import Watch, call, lib, made, name, own, said, text, texts, word
from tartan._tartan import ffi
from tartan._types import Array, PlanLike, Progress
from tartan.errors import Error
from tartan.plans import Plan, Plans, Schema, batches, file_of

if TYPE_CHECKING:
    from tartan.answers import Answer

__all__ = ["Clause", "Difference", "Distribution", "Front", "Library", "Rule", "Slice", "diff", "wishes"]


def _digits(number):
    return str(int(number)).encode()


class Plain(collections.abc.Sequence):
    """What all libraries of plans can do, also the parts of a comparison, which have no name and no clauses."""

    def __init__(self, handle, owner):
        self._handle = handle
        self.schema = Schema(lib.tartan_library_schema(handle), handle)
        self._owner = owner
        self.min_trays = lib.tartan_library_min_trays(handle)
        self.max_trays = lib.tartan_library_max_trays(handle)

    def count(self, length: Optional[int] = None) -> int:
        """How many plans it keeps, of so many trays or of any."""
        return int(said(lib.tartan_library_count, self._handle, lib.TARTAN_ANY_LENGTH if length is None else length))

    def __len__(self):
        return self.count()  # OverflowError past sys.maxsize: count() has any number

    def __bool__(self):
        return self.count() > 0

    @property
    def hash(self) -> str:
        """The same for libraries of the same plans in the same order: 32 hexadecimal digits."""
        hexadecimal = ffi.new("char[33]")
        lib.tartan_library_hash(self._handle, hexadecimal)
        return text(hexadecimal)

    def __getitem__(self, rank):
        """The plan of a rank, or those of a slice of ranks as a view."""
        if isinstance(rank, slice):
            return Slice(self, _range(rank, self.count()))
        rank = operator.index(rank)
        if rank < 0:
            rank += self.count()
        trays, length = ffi.new("uint32_t[]", max(self.max_trays, 1)), ffi.new("size_t *")
        if rank < 0 or rank >= self.count():
            raise IndexError(f"the library has {self.count():,} plans, and none of rank {rank:,}")
        call(lib.tartan_library_unrank, self._handle, _digits(rank), trays, length)
        return Plan(self.schema, trays[0:length[0]], rank=rank)

    def __iter__(self):
        return iter(self[:])

    def __contains__(self, plan):
        try:
            self.rank(plan)
        except Error:
            return False
        return True

    def rank(self, plan: PlanLike) -> int:
        """A plan's rank, from 0. One that the library does not keep is an Error."""
        trays = self.schema.plan(plan).numbers
        return int(said(lib.tartan_library_rank, self._handle, trays, len(trays)))

    def index(self, plan: PlanLike, *_: Any) -> int:
        """The same as of any sequence: ValueError if the library does not keep the plan."""
        try:
            return self.rank(plan)
        except Error as error:
            raise ValueError(str(error)) from None

    def sample(self, count: int, seed: int = 0, length: Optional[int] = None, progress: Progress = None) -> Plans:
        """So many different plans drawn uniformly, in the order of their ranks: the same seed draws the same
        everywhere. All of them if there are fewer."""
        plans = made("tartan_plans", lib.tartan_plans_free, [self._handle], lib.tartan_library_sample, self._handle, seed,
                     lib.TARTAN_ANY_LENGTH if length is None else length, count)
        return Plans.taken(self, plans, progress)

    def draw(self, format: str = "svg", count: int = 24, seed: int = 0, **how: Any) -> bytes:
        """A picture of plans drawn at random; see Plans.draw."""
        return self.sample(count, seed).draw(format, **how)


def _range(asked, count):
    return range(*asked.indices(count))


class Slice(collections.abc.Sequence):
    """Plans of a library by their ranks: a view, which holds none of them."""

    def __init__(self, library, ranks):
        self.library = library
        self.ranks = ranks

    def __len__(self):
        return len(self.ranks)

    def __bool__(self):
        return bool(self.ranks)

    def __getitem__(self, i):
        if isinstance(i, slice):
            return Slice(self.library, self.ranks[i])
        return self.library[self.ranks[i]]

    def _handle(self):
        return made("tartan_plans", lib.tartan_plans_free, [self.library._handle], lib.tartan_library_plans,
                    self.library._handle, _digits(self.ranks.start), _digits(max(self.ranks.stop, self.ranks.start)))

    def __iter__(self):
        if self.ranks.step != 1:
            yield from (self.library[rank] for rank in self.ranks)
            return
        rank = self.ranks.start
        for trays, ends in batches(self.library, self._handle()):
            trays, begin = _arrays.joined("I", [trays]), 0
            for end in _arrays.joined(_arrays.SIZE, [ends]):
                yield Plan(self.library.schema, trays[begin:end], rank=rank)
                begin, rank = end, rank + 1

    def plans(self, progress: Progress = None) -> Plans:
        """All of them in memory, as Plans."""
        if self.ranks.step != 1:
            return Plans.of(self.library.schema, list(self), self.library)
        return Plans.taken(self.library, self._handle(), progress)

    def __repr__(self):
        return f"Slice({self.library!r}, {self.ranks!r})"

    def _repr_svg_(self):
        return self[:Plans.SHOWN].plans()._repr_svg_()


@dataclass(frozen=True)
class Clause:
    """A clause of a library: whether it prunes or requires, and how many plans it keeps out; `only`: how many of these
    no other clause keeps out."""

    name: str
    prunes: bool
    out: int
    only: int


class Library(Plain):
    """A library of plans of a rule file."""

    def __init__(self, file, name_, wheres=(), trays=None, progress=None):
        self.file = file
        self.wheres = tuple(wheres)
        self._trays = trays
        module = file._narrowed(name_, self.wheres, progress) if self.wheres else file._module
        options = ffi.new("tartan_library_options *", lib.tartan_library_options_init())
        kept = name(name_)
        options.name = kept
        if trays is not None:
            options.trays_min, options.trays_max = trays
        handle = made("tartan_library", lib.tartan_library_free, [module], lib.tartan_library_open, module, options,
                      Watch(progress))
        super().__init__(handle, module)
        self.name = name_
        self.doc = file._docs("library").get(name_)

    def ask(self, question: str, *, progress: Progress = None, **request: Any) -> Any:
        """The answer to a question about this library: see File.ask."""
        if self._trays is not None:
            request["trays"] = {"from": self._trays[0], "to": self._trays[1]}
        if self.wheres:
            request["where"] = list(self.wheres)
        return self.file.ask(question, library=self.name, progress=progress, **request)

    def where(self, *requirements, progress: Progress = None) -> Library:
        """The library of those of its plans that meet these requirements too, in the words of the file."""
        return Library(self.file, self.name, (*self.wheres, *requirements), self._trays, progress)

    def of_lengths(self, least: int, most: int, progress: Progress = None) -> Library:
        """The library of plans of so many trays, instead of what the file says."""
        return Library(self.file, self.name, self.wheres, (least, most), progress)

    def plan(self, line: str) -> Plan:
        """The plan of a line."""
        return self.schema.read(line)

    # ---- its clauses

    @property
    def clauses(self) -> list:
        """Its clauses, in file order, with what each does."""
        return [self._clause(i) for i in range(lib.tartan_library_clause_count(self._handle))]

    def _clause(self, i):
        out, only = ffi.new("char **"), ffi.new("char **")
        call(lib.tartan_library_clause_effect, self._handle, i, out, only)
        counts = [int(_taken(number)) for number in (out, only)]
        return Clause(text(lib.tartan_library_clause_name(self._handle, i)),
                      lib.tartan_library_clause_prunes(self._handle, i), *counts)

    def explain(self, plan: PlanLike, nearest: int = 3, progress: Progress = None) -> Answer:
        """Why it keeps a plan, or drops it: what each clause says, a tree of parts with their places in the file; and of
        one that is dropped the `nearest` plans that it keeps."""
        return self.ask("explain", plan=str(self.schema.plan(plan)), nearest=nearest, progress=progress)

    # ---- drawing at random

    def sample(self, count: int, seed: int = 0, length: Optional[int] = None, progress: Progress = None,
               uniform: bool = False) -> Plans:
        """So many different plans drawn at random, in the order of their ranks, the same for the same seed everywhere:
        each as likely as each, or by the library's weights if it has any and `uniform` does not say otherwise."""
        if uniform or not self._weighs():
            return super().sample(count, seed, length, progress)
        request = {} if length is None else {"length": length}
        found = self.ask("sample", count=count, seed=seed, lines=True, progress=progress, **request)
        return Plans.of(self.schema, [plan.plan for plan in found.plans], self)

    def _weighs(self):
        return any(found.name == self.name and found.weights for found in self.file.shown.libraries)

    # ---- measures

    @property
    def measures(self) -> List[str]:
        """The names of the measures that its plans have."""
        return [measure.name for measure in self.file.shown.measures if self.unit(measure.name) is not None]

    def unit(self, measure: str) -> Optional[str]:
        """The unit of a measure's values: "m", "ft2", "" for numbers; None if the library has no such measure."""
        return text(lib.tartan_measure_unit(self._handle, word(measure)))

    def measured(self, plans, measure: str, progress: Progress = None) -> Array:
        """The measure's values on plans, as an array; see Plans.measure."""
        values = _arrays.empty("d", len(plans))
        call(lib.tartan_measure_plans, self._handle, word(measure), *plans._for_calls(), Watch(progress),
             _arrays.pointer("d", values))
        return values

    def measure(self, measure: str, plan: PlanLike) -> Optional[Fraction]:
        """The value on one plan, exact: a Fraction; None if it has none."""
        trays = self.schema.plan(plan).numbers
        value = said(lib.tartan_measure_plan, self._handle, word(measure), trays, len(trays))
        return None if value is None else Fraction(value)

    def distribution(self, measure: str, progress: Progress = None) -> Distribution:
        """How its plans are spread over the values of a measure."""
        return Distribution(self, self.ask("count", by=measure, values=True, progress=progress))

    def best(self, count: int = 10, *, mirror: bool = False, progress: Progress = None, **by: Any) -> List[Plan]:
        """The best plans: least="area", then_most="daylight", in the order of the arguments; then by rank."""
        found = self.ask("best", by=wishes(by), count=count, lines=True, mirror=mirror, progress=progress)
        return [_found(self.schema, plan) for plan in found.plans]

    def front(self, *, progress: Progress = None, **by: Any) -> Front:
        """The best trade-offs of two or three measures: least="area", most="daylight"."""
        return Front(self.schema, self.ask("pareto", by=wishes(by), progress=progress))

    def complete(self, pattern: str, progress: Progress = None, **by: Any) -> Answer:
        """What completes an open plan ("8' public | ? | ..."): how many plans, and of each tray that is written, of each
        field, how many have which value there; with a wish (least="area") the best that each choice leaves."""
        request = {"by": wishes(by)} if by else {}
        return self.ask("complete", pattern=pattern, progress=progress, **request)

    # ---- shown

    def __repr__(self):
        return f"Library({self.name!r} of {self.file.name!r})"

    def _repr_svg_(self):
        return self.sample(Plans.SHOWN)._repr_svg_()

    def _repr_html_(self):
        rows = [(f"{clause.name} ({'prune' if clause.prunes else 'require'})", clause.out, clause.only)
                for clause in self.clauses]
        return (f"<p><b>{self.name}</b>: {self.count():,} plans of {self.min_trays} to {self.max_trays} trays</p>" +
                _html.table(["clause", "keeps out", "alone"], rows))


def _taken(room):
    value = text(room[0])
    lib.tartan_text_free(room[0])
    return value


def _found(schema, found):
    plan = schema.read(found.plan)
    return Plan(schema, plan.numbers, rank=found.rank, value=found.value, values=found.values)


def wishes(by):
    """What is better, from arguments in their order: least=, most=, then_least=, then_most=, each a name or names."""
    found = []
    for word, names in by.items():
        if word not in ("least", "most", "then_least", "then_most"):
            raise TypeError(f"wishes are least, most, then_least and then_most, not {word!r}")
        for measure in [names] if isinstance(names, str) else names:
            found.append({"measure": measure, "most": word.endswith("most")})
    return found


class Distribution:
    """How plans, or houses, are spread over the values of a measure: `values`, ascending and exact, and `counts` of each.
    `least`, `most`, `mean`, `variance` and `quartiles` are exact too, and None if no plan has a value; `none`: how many
    have none."""

    def __init__(self, library, answer, plan=None):
        self.library, self.plan = library, plan
        self.measure, self.unit = answer.measure, answer.unit
        self.least, self.most, self.mean, self.variance = answer.least, answer.most, answer.mean, answer.variance
        self.quartiles, self.none = answer.quartiles, answer.none or 0
        self.values = [row.value for row in answer.distribution]
        self.counts = [row.plans if row.plans is not None else row.houses for row in answer.distribution]

    def __len__(self):
        return len(self.values)

    def __iter__(self):
        return zip(self.values, self.counts)

    def to_pandas(self) -> Any:
        """A row a value. Counts past 64 bits stay Python's whole numbers."""
        import pandas
        return pandas.DataFrame({self.measure: [float(value) for value in self.values], "count": self.counts})

    def draw(self, format: str = "svg") -> bytes:
        """A histogram, as bytes."""
        request = {} if self.plan is None else {"plan": str(self.plan)}
        answer = self.library.ask("count", by=self.measure, picture=format, **request)
        found = answer.files[0]
        return found.text.encode() if found.text is not None else found.base64

    def __repr__(self):
        return f"Distribution({self.measure!r}, {len(self)} values)"

    def _repr_svg_(self):
        return self.draw("svg").decode()


class Front(collections.abc.Sequence):
    """Trade-offs, best first: plans with the `values` of each measure, of which no plan betters one without losing in
    another; `counts`: how many plans have these values."""

    def __init__(self, schema, answer):
        self.measures = answer.measures
        self.counts = [point.plans for point in answer.points]
        self._plans = [Plan(schema, schema.read(point.plan).numbers, rank=point.rank, values=point.values)
                       for point in answer.points]

    def __len__(self):
        return len(self._plans)

    def __getitem__(self, i):
        return self._plans[i]

    def to_pandas(self) -> Any:
        """A row a trade-off."""
        import pandas
        rows = [[*map(float, plan.values), count, str(plan)] for plan, count in zip(self, self.counts)]
        return pandas.DataFrame(rows, columns=[*self.measures, "count", "plan"])

    def __repr__(self):
        return f"Front({', '.join(self.measures)}: {len(self)} trade-offs)"

    def _repr_html_(self):
        rows = [(*plan.values, count, plan) for plan, count in zip(self, self.counts)]
        return _html.table([*self.measures, "plans", "the first"], rows)


class Rule:
    """A rule about plans: what it matches, and its picture."""

    def __init__(self, file, name_, doc):
        self.file = file
        self.name = name_
        self.doc = doc or None
        names, kept = texts([name_])
        self._handle = made("tartan_rules", lib.tartan_rules_free, [file._module], lib.tartan_rules_new, file._module,
                            names, len(kept), Watch())
        self.schema = Schema(lib.tartan_rules_schema(self._handle), self._handle)

    def match(self, plan: PlanLike) -> bool:
        """Does it match the plan?"""
        return bool(self.match_all(Plans.of(self.schema, [plan]))[0])

    def match_all(self, plans, threads: int = 0, progress: Progress = None) -> Array:
        """Which of the plans it matches: an array of bools, with numpy; else of 0 and 1."""
        if not isinstance(plans, Plans):
            plans = Plans.of(self.schema, plans)
        if not plans.schema.alike(self.schema):
            raise Error(f"rule `{self.name}` is about trays of `{self.schema.name}`, not of `{plans.schema.name}`")
        matches = _arrays.empty("B", len(plans))
        call(lib.tartan_match_any, self._handle, *plans._for_calls(), threads, _arrays.pointer("B", matches),
             Watch(progress))
        return matches.view("bool") if _arrays.numpy is not None else matches

    def explain(self, plan: PlanLike, progress: Progress = None) -> Answer:
        """Why it matches a plan, or does not: a tree of parts with their places in the file."""
        return self.file.ask("explain", plan=str(self.schema.plan(plan)), rules=[self.name], progress=progress)

    def draw(self, format: str = "svg") -> bytes:
        """Its picture, in the manner of the LaHave paper, as bytes."""
        return file_of(lib.tartan_rules_draw, format, self._handle)

    def __repr__(self):
        return f"Rule({self.name!r})"

    def _repr_svg_(self):
        return self.draw("svg").decode()


@dataclass(frozen=True)
class ChangedClause:
    """A clause in which two libraries differ. `removes`: how many removed plans the new clause keeps out; `adds`: how
    many added ones the old clause kept out; None if that is not known. name None: how many trays there are."""

    name: str
    change: str  # "changed", "added", "removed"
    removes: int
    adds: int


class Difference:
    """What an edit does to a library: `removed`, `added` and `kept` are libraries themselves."""

    def __init__(self, before, after, progress=None):
        handle = made("tartan_diff", lib.tartan_diff_free, [before._handle, after._handle], lib.tartan_diff_new,
                      before._handle, after._handle, Watch(progress))
        self._handle = handle
        self.before, self.after = before, after
        self.removed = self._part(lib.tartan_diff_removed)
        self.added = self._part(lib.tartan_diff_added)
        self.kept = self._part(lib.tartan_diff_kept)

    def _part(self, function):
        return Plain(own(function(self._handle), lambda _: None, self._handle), self._handle)

    @property
    def clauses(self) -> list:
        return [self._clause(i) for i in range(lib.tartan_diff_clause_count(self._handle))]

    def _clause(self, i):
        clause = ffi.new("tartan_changed_clause *", lib.tartan_changed_clause_init())
        call(lib.tartan_diff_clause, self._handle, i, clause)
        numbers = [None if text(number) == "-" else int(text(number)) for number in (clause.removes, clause.adds)]
        return ChangedClause(text(clause.name), _CHANGES[clause.change], *numbers)

    def __repr__(self):
        return f"Difference({self.removed.count()} removed, {self.added.count()} added, {self.kept.count()} kept)"


_CHANGES = {lib.TARTAN_CHANGED: "changed", lib.TARTAN_ADDED: "added", lib.TARTAN_REMOVED: "removed"}


def diff(before, after, progress: Progress = None) -> Difference:
    """Compares two libraries of the same trays, perhaps of two files."""
    return Difference(before, after, progress)
