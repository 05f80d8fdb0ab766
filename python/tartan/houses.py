"""Libraries of houses: counted, numbered, drawn at random; and houses as rooms, meshes and files."""
from __future__ import annotations

import collections.abc
import json
import os
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Union

from tartan._call import Watch, call, file, lib, made, name, own, said, text, word
from tartan._tartan import ffi
from tartan._types import Path, PlanLike, Progress
from tartan.errors import Error
from tartan.libraries import Distribution, wishes
from tartan.meshes import Mesh, write
from tartan.plans import Plan, Schema

if TYPE_CHECKING:
    from tartan.answers import Answer

__all__ = ["Change", "House", "HouseLibrary", "Room"]

FORMATS = {"json": lib.TARTAN_HOUSE_JSON, "rooms": lib.TARTAN_HOUSE_ROOMS, "parts": lib.TARTAN_HOUSE_PARTS,
           "obj": lib.TARTAN_HOUSE_OBJ, "mtl": lib.TARTAN_HOUSE_MTL, "ply": lib.TARTAN_HOUSE_PLY, "glb": lib.TARTAN_HOUSE_GLB,
           "ifc": lib.TARTAN_HOUSE_IFC, "dxf": lib.TARTAN_HOUSE_DXF, "svg": lib.TARTAN_HOUSE_SVG,
           "png": lib.TARTAN_HOUSE_PNG, "pdf": lib.TARTAN_HOUSE_PDF}


class HouseLibrary:
    """A library of houses of a rule file: houses["#12:3"] is the house of a number (the rank of its plan, and its place
    on that plan), houses[5] that of a rank. It and its houses belong to one thread at a time together."""

    def __init__(self, file_, name_, progress=None, max_houses=None):
        self.file = file_
        options = ffi.new("tartan_house_library_options *", lib.tartan_house_library_options_init())
        kept = name(name_)
        options.name = kept
        options.max_houses = max_houses or 0
        self._handle = made("tartan_house_library", lib.tartan_house_library_free, [file_._module],
                            lib.tartan_house_library_open, file_._module, options, Watch(progress))
        self.name = text(lib.tartan_house_library_name(self._handle))
        self.doc = file_._docs("house_library").get(self.name)
        self.schema = Schema(lib.tartan_house_library_schema(self._handle), self._handle)

    def ask(self, question: str, *, progress: Progress = None, **request: Any) -> Any:
        """The answer to a question about this library: see File.ask."""
        return self.file.ask(question, library=self.name, progress=progress, **request)

    def _on(self, plan):
        """The plan that is asked about, for a call, and what has to stay."""
        if plan is None:
            return ffi.NULL, None
        numbers = ffi.new("uint32_t[]", self.schema.plan(plan).numbers)
        return ffi.new("tartan_on_plan *", {"trays": numbers, "length": len(numbers)}), numbers

    def count(self, length: Optional[int] = None, plan: Optional[PlanLike] = None, progress: Progress = None) -> int:
        """How many houses it keeps: on all plans, on those of so many trays, or on one."""
        if plan is not None:
            on, _kept = self._on(plan)
            return int(said(lib.tartan_house_library_count_on, self._handle, on, Watch(progress)))
        return int(said(lib.tartan_house_library_count, self._handle,
                        lib.TARTAN_ANY_LENGTH if length is None else length, Watch(progress)))

    def __len__(self):
        return self.count()  # OverflowError past sys.maxsize: count() has any number

    def __bool__(self):
        return True

    def __getitem__(self, number):
        """The house of a number "#12:3", or of a rank."""
        if isinstance(number, int):
            count = self.count() if number < 0 else 0
            number = str(number + count)
        try:
            return self.unrank(number)
        except Error as error:
            raise (IndexError(str(error)) if error.kind == "invalid" else error) from None

    def unrank(self, number: Union[int, str], progress: Progress = None) -> House:
        """The house of a rank ("5") or a number ("12:3")."""
        return House(self, made("tartan_house", lib.tartan_house_free, [self._handle], lib.tartan_house_unrank,
                                self._handle, name(str(number)), Watch(progress)))

    def house(self, line: str) -> House:
        """The house of a line, any house of the form; if values are left out, the first that has what is typed."""
        encoded = line.encode()
        return House(self, made("tartan_house", lib.tartan_house_free, [self._handle], lib.tartan_house_read,
                                self._handle, encoded, len(encoded)))

    def sample(self, count: int, seed: int = 0, plan: Optional[PlanLike] = None, progress: Progress = None) -> List[House]:
        """So many different houses drawn uniformly, in the order of their ranks; all of them if there are fewer. Of a
        library whose clauses ask for walks, houses of all plans are tried: those that were found may be fewer, too."""
        on, _kept = self._on(plan)
        return self._list(lib.tartan_house_sample, self._handle, on, seed, count, Watch(progress))

    def best(self, count: int = 10, *, plan: Optional[PlanLike] = None, progress: Progress = None, **by: Any) -> List[House]:
        """The best houses: least="cost", then_most="daylight", in the order of the arguments; then by rank."""
        on, _kept = self._on(plan)
        asked = wishes(by)
        kept = [name(wish["measure"]) for wish in asked]
        array = ffi.new("tartan_wish[]", [{"measure": of, "most": wish["most"]} for of, wish in zip(kept, asked)])
        return self._list(lib.tartan_house_best, self._handle, on, array, len(asked), count, Watch(progress))

    def _list(self, function, *arguments):
        houses = made("tartan_houses", lib.tartan_houses_free, [self._handle], function, *arguments)
        return [House._listed(self, houses, i) for i in range(lib.tartan_houses_count(houses))]

    def unit(self, measure: str) -> Optional[str]:
        """The unit of a measure of its houses or plans; None if it has none of that name."""
        return text(lib.tartan_house_library_unit(self._handle, word(measure)))

    def distribution(self, measure: str, plan: Optional[PlanLike] = None, progress: Progress = None) -> Distribution:
        """How its houses, or those on a plan, are spread over the values of a measure."""
        request = {} if plan is None else {"plan": str(self.schema.plan(plan))}
        return Distribution(self, self.ask("count", by=measure, values=True, progress=progress, **request), plan)

    def __repr__(self):
        return f"HouseLibrary({self.name!r} of {self.file.name!r})"


@dataclass(frozen=True)
class Room:
    """A room: what it is for, its cells (as `data` numbers them), and its area to the middle of walls and within them,
    in square metres, exact."""

    function: str
    cells: list
    area: Fraction
    net: Fraction


@dataclass(frozen=True)
class Change:
    """What was changed of a house: a "section", "function", "face" or "tile", where, from which value to which."""

    kind: str
    where: str
    before: str
    after: str


_CHANGES = {lib.TARTAN_CHANGE_SECTION: "section", lib.TARTAN_CHANGE_FUNCTION: "function",
            lib.TARTAN_CHANGE_FACE: "face", lib.TARTAN_CHANGE_TILE: "tile"}


class House:
    """A house. str(house) is its line. `values`: of the best, what it has by each wish; `change`: of variants, what was
    changed."""

    def __init__(self, library, handle, values=None, change=None):
        self.library = library
        self._handle = handle
        self.values = values
        self.change = change

    @classmethod
    def _listed(cls, library, houses, i):
        values = []
        while lib.tartan_houses_value(houses, i, len(values)) != ffi.NULL:
            values.append(Fraction(text(lib.tartan_houses_value(houses, i, len(values)))))
        change = lib.tartan_houses_change(houses, i)
        changed = None if change == ffi.NULL else Change(_CHANGES[change.kind], text(change.where),
                                                         text(getattr(change, "from")), text(change.to))
        return cls(library, own(lib.tartan_houses_house(houses, i), lambda _: None, houses), values or None, changed)

    @property
    def plan(self) -> Plan:
        length = ffi.new("size_t *")
        trays = lib.tartan_house_plan(self._handle, length)
        return Plan(self.library.schema, trays[0:length[0]])

    @property
    def number(self) -> str:
        """Its number, "12:3": the rank of its plan, and its place on that plan."""
        return said(lib.tartan_house_number, self._handle, Watch())

    def rank(self, progress: Progress = None) -> int:
        """Its rank among all houses of the library."""
        return int(said(lib.tartan_house_rank, self._handle, Watch(progress)))

    def variants(self, cell: Optional[str] = None, progress: Progress = None) -> List[House]:
        """What else it could be: each other value of one choice with which the library still keeps it; of a cell
        ("2.body.ground", trays from 1) only what is about it."""
        return self.library._list(lib.tartan_house_variants, self._handle, name(cell), Watch(progress))

    def explain(self, progress: Progress = None) -> Answer:
        """Why its library keeps it, or drops it."""
        return self.library.ask("explain", house=str(self), progress=progress)

    def mesh(self, progress: Progress = None) -> Mesh:
        """The boundary of all that it is built of: metres, z up; its groups are kinds of parts and materials."""
        return Mesh(made("tartan_mesh", lib.tartan_mesh_free, [], lib.tartan_house_mesh, self._handle, Watch(progress)))

    def file(self, format: str, *, title: Optional[str] = None, views: Sequence[str] = (), cut: Optional[str] = None,
             bare: bool = False, azimuth: Optional[float] = None, elevation: Optional[float] = None, scale: int = 0,
             dpi: int = 0, mtl: Optional[str] = None, progress: Progress = None) -> bytes:
        """The house as a file in memory: json, rooms, parts (CSV), obj, mtl (the materials of an obj; mtl= is the name
        by which that cites them), ply, glb, ifc, dxf, svg, png or pdf. views:
        "plan:STOREY", "plan:roof", "section:x=LENGTH", "elevation:SIDE", "axonometric", "sheet"."""
        if format not in FORMATS:
            raise ValueError(f"houses are {', '.join(FORMATS)}, not {format!r}")
        drawing = ffi.new("tartan_house_drawing *", lib.tartan_house_drawing_init())
        kept = [name(title), name(cut), [name(view) for view in views], name(mtl)]
        array = ffi.new("const char *[]", kept[2]) if views else ffi.NULL
        drawing.title, drawing.cut, drawing.views, drawing.view_count = kept[0], kept[1], array, len(kept[2])
        drawing.bare, drawing.scale, drawing.dpi, drawing.mtl = bare, scale, dpi, kept[3]
        if azimuth is not None or elevation is not None:
            drawing.camera = True
            drawing.azimuth = 60 if azimuth is None else azimuth
            drawing.elevation = 30 if elevation is None else elevation
        return file(lib.tartan_house_file, self._handle, FORMATS[format], drawing, Watch(progress))

    def write(self, path: Path, **how: Any) -> None:
        """Writes a file whose name says the format; see file(). Beside an .obj is an .mtl, with its materials."""
        stem, ending = os.path.splitext(os.fspath(path))
        if ending.lower() == ".obj":
            write(stem + ".mtl", lambda format: self.file(format))
            how.setdefault("mtl", os.path.basename(stem) + ".mtl")
        write(path, lambda format: self.file(format, **how))

    @property
    def data(self) -> Dict[str, Any]:
        """All that is known of it, as `tartan house --json` has it."""
        return json.loads(self.file("json"))

    @property
    def rooms(self) -> List[Room]:
        """Its rooms."""
        return [Room(room["function"], room["cells"], Fraction(int(room["area"]), 10**18),
                     Fraction(int(room["net"]), 10**18)) for room in self.data["rooms"]]

    def __str__(self):
        return said(lib.tartan_house_write, self._handle)

    def __eq__(self, other):
        return isinstance(other, House) and str(self) == str(other)

    def __hash__(self):
        return hash(str(self))

    def __repr__(self):
        return f"House({str(self)!r})"

    def _repr_svg_(self):
        return self.file("svg").decode()
