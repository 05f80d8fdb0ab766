"""Plans: rows of trays, one by one and many at a time."""
from __future__ import annotations

import collections.abc
import re
from fractions import Fraction
from functools import total_ordering
from typing import Any, Iterable, List, Optional, Sequence, Union

from tartan import _arrays, _html
from tartan._call import Watch, call, file, lib, name, said, text
from tartan._tartan import ffi
from tartan._types import Array, PlanLike, Progress, RuleLike
from tartan.errors import Error

__all__ = ["Field", "Length", "Measures", "Plan", "Plans", "Schema", "Tray", "Zone"]

#: Plans that are taken from a library at a time.
BATCH = 1 << 15


@total_ordering
class Length:
    """A length, exact: whole nanometres, and how its author writes it."""

    __slots__ = ("nanometres", "text")

    def __init__(self, spelling, nanometres):
        self.text = spelling
        self.nanometres = nanometres

    @property
    def metres(self) -> float:
        return self.nanometres / 1e9

    @property
    def feet(self) -> float:
        return float(Fraction(self.nanometres, 304800000))

    def __eq__(self, other):
        return isinstance(other, Length) and self.nanometres == other.nanometres

    def __lt__(self, other):
        return self.nanometres < other.nanometres if isinstance(other, Length) else NotImplemented

    def __hash__(self):
        return hash(self.nanometres)

    def __str__(self):
        return self.text

    def __repr__(self):
        return f'Length("{self.text}")' if '"' not in self.text else f"Length({self.text!r})"


class Zone:
    """What fills a zone of a tray, and how deep it is (None: it is not there)."""

    __slots__ = ("name", "depth", "text")

    def __init__(self, fill, depth, spelling):
        self.name = fill
        self.depth = depth
        self.text = spelling

    def __eq__(self, other):
        return isinstance(other, Zone) and (self.name, self.depth) == (other.name, other.depth)

    def __hash__(self):
        return hash((self.name, self.depth))

    def __str__(self):
        return self.text

    def __repr__(self):
        return f"Zone({self.text!r})"


class Field:
    """A field of a tray: its name, what its author says of it, its kind and its values in file order."""

    __slots__ = ("name", "doc", "kind", "values", "spellings", "attribute")

    def __init__(self, field, values, spellings):
        self.name, self.doc = text(field.name), text(field.doc) or None
        self.kind = _KINDS[field.kind]
        self.values = values
        self.spellings = spellings
        self.attribute = re.sub(r"\W", "_", self.name)

    def __repr__(self):
        return f"Field({self.name!r}, {self.kind!r}, {list(self.spellings)!r})"


_KINDS = {lib.TARTAN_FIELD_LENGTH: "length", lib.TARTAN_FIELD_CHOICE: "choice", lib.TARTAN_FIELD_FLAG: "flag",
          lib.TARTAN_FIELD_ZONE: "zone"}


def _value(kind, value):
    spelling = text(value.spelling)
    if kind == "length":
        return Length(spelling, value.length)
    if kind == "zone":
        depth = re.sub(r"^.*:", "", spelling)
        return Zone(text(value.name), Length(depth, value.length) if value.length else None, spelling)
    return text(value.name)


class Schema:
    """What trays are made of. Trays are numbered in schema order, from 0."""

    def __init__(self, handle, owner):
        self._handle = handle  # borrowed:
        self._owner = owner
        self._trays = {}
        self.name = text(lib.tartan_schema_name(handle))
        self.fields = tuple(self._field(i) for i in range(lib.tartan_schema_field_count(handle)))
        self._places = {field.name: i for i, field in enumerate(self.fields)}
        self._places.update((field.attribute, i) for i, field in enumerate(self.fields))

    def _field(self, i):
        field = ffi.new("tartan_field *", lib.tartan_field_init())
        call(lib.tartan_schema_field, self._handle, i, field)
        values, spellings = [], []
        for v in range(field.value_count):
            value = ffi.new("tartan_value *", lib.tartan_value_init())
            call(lib.tartan_schema_value, self._handle, i, v, value)
            values.append(_value(_KINDS[field.kind], value))
            spellings.append(text(value.spelling))
        if field.kind == lib.TARTAN_FIELD_FLAG:
            values = [False, True]
        return Field(field, tuple(values), tuple(spellings))

    @property
    def tray_count(self) -> int:
        return lib.tartan_schema_tray_count(self._handle)

    def column(self, field) -> Array:
        """Which of its values each tray has in the i-th field: an array by tray numbers."""
        if field not in self._trays:
            values = _arrays.empty("I", self.tray_count)
            call(lib.tartan_schema_trays, self._handle, field, _arrays.pointer("I", values))
            self._trays[field] = values
        return self._trays[field]

    def read(self, line: str) -> Plan:
        """The plan of a line: "8' public | 12' open"."""
        encoded = line.encode()
        room, length = ffi.new("uint32_t[]", encoded.count(b"|") + 1), ffi.new("size_t *")
        call(lib.tartan_plan_read, self._handle, encoded, len(encoded), room, len(room), length)
        return Plan(self, room[0:length[0]])

    def plan(self, plan: PlanLike) -> Plan:
        """The plan that is meant: a Plan, a line, or numbers of trays."""
        if isinstance(plan, Plan):
            if plan.schema is not self and not plan.schema.alike(self):
                raise Error(f"the plan has trays of schema `{plan.schema.name}`, not of `{self.name}`")
            return plan
        return self.read(plan) if isinstance(plan, str) else Plan(self, plan)

    def alike(self, other) -> bool:
        """Have both the same trays under the same numbers?"""
        return (self.name == other.name and self.tray_count == other.tray_count and
                [(field.name, field.spellings) for field in self.fields] ==
                [(field.name, field.spellings) for field in other.fields])

    def __repr__(self):
        return f"Schema({self.name!r}, {self.tray_count} trays)"


class Tray:
    """A tray of a plan: its fields are attributes, with _ for -, and items."""

    __slots__ = ("schema", "number")

    def __init__(self, schema, number):
        if not 0 <= number < schema.tray_count:
            raise IndexError(f"schema `{schema.name}` has trays 0 to {schema.tray_count - 1}, and no tray {number}")
        self.schema = schema
        self.number = int(number)

    def __getitem__(self, field):
        place = self.schema._places.get(field)
        if place is None:
            raise KeyError(field)
        return self.schema.fields[place].values[self.schema.column(place)[self.number]]

    def __getattr__(self, field):
        try:
            return self[field]
        except KeyError:
            raise AttributeError(f"trays of `{self.schema.name}` have no field `{field}`") from None

    def __dir__(self):
        return [*super().__dir__(), *(field.attribute for field in self.schema.fields)]

    def keys(self) -> List[str]:
        return [field.name for field in self.schema.fields]

    def __eq__(self, other):
        return isinstance(other, Tray) and self.number == other.number and self.schema.alike(other.schema)

    def __hash__(self):
        return hash(self.number)

    def __str__(self):
        return str(Plan(self.schema, [self.number]))

    def __repr__(self):
        return f"Tray({str(self)!r})"


class Plan(collections.abc.Sequence):
    """A plan: a sequence of trays. str(plan) is its line."""

    __slots__ = ("schema", "numbers", "rank", "value", "values")

    def __init__(self, schema, numbers, *, rank=None, value=None, values=None):
        self.schema = schema
        self.numbers = tuple(int(number) for number in numbers)
        if any(not 0 <= number < schema.tray_count for number in self.numbers):
            raise IndexError(f"schema `{schema.name}` has trays 0 to {schema.tray_count - 1}")
        self.rank = rank  # in the library that it was asked of, or None
        self.value = value  # of the measure that it was asked by, or None
        self.values = values

    @property
    def trays(self) -> List[Tray]:
        return [Tray(self.schema, number) for number in self.numbers]

    def __len__(self):
        return len(self.numbers)

    def __getitem__(self, i):
        if isinstance(i, slice):
            return [Tray(self.schema, number) for number in self.numbers[i]]
        return Tray(self.schema, self.numbers[i])

    def __eq__(self, other):
        return isinstance(other, Plan) and self.numbers == other.numbers and self.schema.alike(other.schema)

    def __hash__(self):
        return hash(self.numbers)

    def __str__(self):
        return said(lib.tartan_plan_write, self.schema._handle, self.numbers, len(self.numbers))

    def __repr__(self):
        return f"Plan({str(self)!r})"

    def draw(self, format: str = "svg", **how: Any) -> bytes:
        """A picture of it, as Plans.draw."""
        return Plans.of(self.schema, [self]).draw(format, **how)

    def _repr_svg_(self):
        return self.draw("svg").decode()


class Plans(collections.abc.Sequence):
    """Plans, one after another in memory: `trays` has the numbers of their trays, and the i-th ends before
    trays[ends[i]]. Both are numpy arrays if numpy is there."""

    def __init__(self, schema, trays, ends, library=None):
        self.schema = schema
        self.trays = trays
        self.ends = ends
        self.library = library

    @classmethod
    def of(cls, schema, plans, library=None) -> Plans:
        """Of plans one by one: Plan, lines, or numbers of trays."""
        plans = [schema.plan(plan) for plan in plans]
        ends, end = [], 0
        for plan in plans:
            end += len(plan)
            ends.append(end)
        return cls(schema, _arrays.of("I", [number for plan in plans for number in plan.numbers]),
                   _arrays.of(_arrays.SIZE, ends), library)

    @classmethod
    def taken(cls, library, plans, progress: Progress = None) -> Plans:
        """Of what a tartan_plans still holds."""
        parts = list(batches(library, plans, progress))
        trays = _arrays.joined("I", [part[0] for part in parts])
        ends, before = [], 0
        for part in parts:
            ends.append(bytes(memoryview(_arrays.shifted(_arrays.joined(_arrays.SIZE, [part[1]]), before))))
            before += len(part[0]) // 4
        return cls(library.schema, trays, _arrays.joined(_arrays.SIZE, ends), library)

    def __len__(self):
        return len(self.ends)

    def _bounds(self, i):
        return (int(self.ends[i - 1]) if i else 0), int(self.ends[i])

    def __getitem__(self, i):
        if isinstance(i, slice):
            return Plans.of(self.schema, [self[k] for k in range(*i.indices(len(self)))], self.library)
        place = range(len(self))[i]
        begin, end = self._bounds(place)
        return Plan(self.schema, self.trays[begin:end])

    def __repr__(self):
        return f"Plans({len(self)} of {self.schema.name!r})"

    def _for_calls(self):
        return _arrays.pointer("I", self.trays), _arrays.pointer(_arrays.SIZE, self.ends), len(self.ends)

    def _library(self):
        if self.library is None:
            raise Error("these plans are of no library: ask the library about them")
        return self.library

    def match(self, rule: RuleLike, progress: Progress = None) -> Array:
        """Which of them a rule matches, by its name or as a Rule: an array of bools."""
        ready = self._library().file.rules[rule] if isinstance(rule, str) else rule
        return ready.match_all(self, progress=progress)

    def measure(self, *names, progress: Progress = None) -> Measures:
        """The values of measures of the library on each of them."""
        return Measures(self, {measure: self._library().measured(self, measure, progress) for measure in names})

    def to_pandas(self) -> Any:
        """A row a tray: the plan's number among these, the tray's place in it, and its fields as categories."""
        import numpy
        import pandas
        lengths = numpy.diff(numpy.asarray(self.ends, dtype="int64"), prepend=0)
        firsts = numpy.asarray(self.ends, dtype="int64") - lengths
        columns = {"plan": numpy.repeat(numpy.arange(len(self)), lengths)}
        columns["tray"] = numpy.arange(len(self.trays)) - numpy.repeat(firsts, lengths)
        for i, field in enumerate(self.schema.fields):
            codes = numpy.asarray(self.schema.column(i))[numpy.asarray(self.trays)]
            columns[field.name] = pandas.Categorical.from_codes(codes.astype("int32"), field.spellings, ordered=True)
        return pandas.DataFrame(columns)

    def __arrow_c_stream__(self, requested_schema=None):
        from tartan import _arrow
        return _arrow.stream(self)

    def draw(self, format: str = "svg", *, title: Optional[str] = None, doc: Optional[str] = None,
             captions: Optional[Iterable[object]] = None, paper: Optional[str] = None, scale: int = 0,
             columns: int = 0, dpi: int = 0, profile: Optional[str] = None, progress: Progress = None) -> bytes:
        """A picture of them, at most 5,000, as bytes of "svg", "png", "pdf" or "dxf". profile: by which the layers of a DXF
        are named, "iso" or "us"; by default as plans are measured."""
        drawing = ffi.new("tartan_plans_drawing *", lib.tartan_plans_drawing_init())
        kept = [name(title), name(doc), name(paper), name(profile)]
        drawing.title, drawing.doc, drawing.paper, drawing.profile = kept
        if captions is not None:
            captions = [name(str(caption)) for caption in captions]
            if len(captions) != len(self):
                raise ValueError(f"there are {len(self)} plans, and {len(captions)} captions")
            kept.append(ffi.new("const char *[]", captions))
            drawing.captions = kept[-1] if captions else ffi.NULL
        drawing.scale, drawing.columns, drawing.dpi = scale, columns, dpi
        return file_of(lib.tartan_plans_draw, format, self.schema._handle, *self._for_calls(), drawing=drawing,
                       progress=progress)

    #: A notebook shows so many of them.
    SHOWN = 24

    def _repr_svg_(self):
        return self[:self.SHOWN].draw("svg").decode() if len(self) else None

    def _repr_html_(self):
        rows = [(i, str(plan)) for i, plan in enumerate(self[:self.SHOWN])]
        left = len(self) - len(rows)
        return _html.table(["", "plan"], rows, f"and {left:,} more" if left else None)


class Measures(collections.abc.Mapping):
    """Values of measures of plans: a column a measure, by its name; not a number if a plan has none."""

    def __init__(self, plans, columns):
        self.plans = plans
        self.columns = columns
        self.units = {measure: plans.library.unit(measure) for measure in columns}

    def __getitem__(self, measure):
        return self.columns[measure]

    def __iter__(self):
        return iter(self.columns)

    def __len__(self):
        return len(self.columns)

    def to_pandas(self) -> Any:
        """A row a plan."""
        import pandas
        return pandas.DataFrame(dict(self.columns))

    def __repr__(self):
        return f"Measures({', '.join(self.columns)} of {len(self.plans)} plans)"

    def _repr_html_(self):
        heads = [f"{measure} ({unit})" if unit else measure for measure, unit in self.units.items()]
        shown = min(len(self.plans), Plans.SHOWN)
        rows = [(i, *(f"{column[i]:.6g}" for column in self.columns.values())) for i in range(shown)]
        left = len(self.plans) - shown
        return _html.table(["plan", *heads], rows, f"and {left:,} more" if left else None)


FORMATS = {"svg": lib.TARTAN_SVG, "png": lib.TARTAN_PNG, "pdf": lib.TARTAN_PDF, "dxf": lib.TARTAN_DRAWN_DXF}


def file_of(function, format, *arguments, drawing=None, progress=None):
    """The bytes of a picture; `drawing`: options, if the function takes such."""
    if format not in FORMATS:
        raise ValueError(f"pictures are {', '.join(FORMATS)}, not {format!r}")
    options = [] if drawing is None else [drawing]
    return file(function, *arguments, FORMATS[format], *options, Watch(progress))


def batches(library, plans, progress=None):
    """The plans of a tartan_plans, many at a time: pairs of bytes, trays and ends."""
    capacity = max(BATCH * 8, library.max_trays, 1)
    trays, ends = ffi.new("uint32_t[]", capacity), ffi.new("size_t[]", BATCH)
    done = 0
    while True:
        count = lib.tartan_plans_take(plans, BATCH, trays, capacity, ends)
        if count == 0:
            return
        yield bytes(ffi.buffer(trays, ends[count - 1] * 4)), bytes(ffi.buffer(ends, count * ffi.sizeof("size_t")))
        done += count
        if progress is not None:
            progress(done, 0)
