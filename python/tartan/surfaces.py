"""Surfaces that grow among forces and boundaries."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Optional, Sequence, Tuple

from tartan._call import Watch, call, lib, made, no_option, text
from tartan._tartan import ffi
from tartan._types import Progress
from tartan.meshes import READER, InSpace, Mesh

__all__ = ["Boundary", "Force", "Surface"]


@dataclass(frozen=True)
class Force:
    """What moves each vertex in each step: by strength / distance^exponent towards `at` ("attractor") or away from it
    ("repeller"); "gravity" moves all by `at` itself."""

    kind: str
    at: Sequence[float]
    strength: float = 1.0
    exponent: float = 1.0


@dataclass(frozen=True)
class Boundary:
    """A "plane" (a: a point; b: the normal, to the allowed side), "box" (a, b: corners), "sphere" (a: centre; radius) or
    "solid" (mesh), of which the surface stays outside, or `inside`. mode: a vertex that meets it goes along it
    ("slide"), stays ("stop"), or passes and is counted ("soft")."""

    kind: str
    a: Sequence[float] = (0, 0, 0)
    b: Sequence[float] = (0, 0, 0)
    radius: float = 0.0
    mesh: Optional[Mesh] = None
    mode: str = "slide"
    inside: bool = False


_FORCES = {"attractor": lib.TARTAN_ATTRACTOR, "repeller": lib.TARTAN_REPELLER, "gravity": lib.TARTAN_GRAVITY}
_BOUNDARIES = {"plane": lib.TARTAN_PLANE, "box": lib.TARTAN_BOX, "sphere": lib.TARTAN_SPHERE, "solid": lib.TARTAN_SOLID}
_MODES = {"slide": lib.TARTAN_SLIDE, "stop": lib.TARTAN_STOP, "soft": lib.TARTAN_SOFT}

#: Options by their names here, where these differ from the interface's.
_NAMES = {"angle": "branch_angle", "max_edges": "edge_limit"}
_OPTIONS = {"scale", "start", "start_length", "branch_angle", "branch_length", "fixed_centre", "fixed_perimeter", "facing",
            "mirror", "explain", "bare", "seed", "edge_limit", "threads"}


def _one_of(words, word, what):
    if word not in words:
        raise ValueError(f"a {what} is {', '.join(words)}, not {word!r}")
    return words[word]


class Surface(InSpace):
    """A surface that grows: it begins as the seed, and every step enlarges it, moves it by its surroundings, rewrites
    its edges and joins their branches.

    Options are those of the file unless they are given: scale (a factor, or three), start, start_length, angle (by how
    many degrees branches that join may miss each other), branch_length, fixed_centre, fixed_perimeter, facing, mirror,
    bare (without the study's own forces and boundaries), seed (of weighted rules), max_edges, threads; and besides
    these `forces` and `boundaries`.
    """

    _drawn_by, _drawn_as = lib.tartan_growth_draw, "svg"

    def __init__(self, file, *, forces=(), boundaries=(), **options: Any) -> None:
        self.file = file
        settings = ffi.new("tartan_growth_options *", lib.tartan_growth_options_init())
        call(lib.tartan_growth_options_of, file._module, settings)
        self.planned = settings.steps
        for option, value in options.items():
            known = _NAMES.get(option, option)
            if known not in _OPTIONS:
                raise no_option("a surface", option, _OPTIONS | set(_NAMES) | {"forces", "boundaries"})
            setattr(settings, known, [value] * 3 if known == "scale" and not hasattr(value, "__len__") else value)
        settings.read_mesh = READER
        kept = ffi.new("tartan_force[]", [_force(force) for force in forces]) if forces else ffi.NULL
        also_kept = ffi.new("tartan_boundary[]", [_boundary(one) for one in boundaries]) if boundaries else ffi.NULL
        settings.forces, settings.force_count = kept, len(forces)
        settings.boundaries, settings.boundary_count = also_kept, len(boundaries)
        self._handle = made("tartan_growth", lib.tartan_growth_free, [file._module], lib.tartan_growth_new, file._module,
                            settings)

    def grow(self, steps: Optional[int] = None, progress: Progress = None) -> Surface:
        """Grows to so many steps from the seed on; without a number to as many as the study says. Ctrl-C ends it: the
        surface is then that of the last whole step."""
        call(lib.tartan_growth_grow, self._handle, self.planned if steps is None else steps, Watch(progress))
        return self

    def restart(self) -> Surface:
        """The seed again."""
        call(lib.tartan_growth_restart, self._handle)
        return self

    @property
    def steps(self) -> int:
        return lib.tartan_growth_steps(self._handle)

    @property
    def at_rest(self) -> bool:
        """Did the last step leave everything as it was?"""
        return lib.tartan_growth_at_rest(self._handle)

    def mesh(self, *, groups: bool = False, lines: bool = False, layers: bool = False) -> Mesh:
        """The surface as a mesh: vertices in order of creation. groups: faces by label and age; lines: the edges of the
        rules, too; layers: lines are grouped by label alone."""
        options = ffi.new("tartan_mesh_options *", lib.tartan_mesh_options_init())
        options.groups, options.lines, options.layers = groups, lines, layers
        return Mesh(made("tartan_mesh", lib.tartan_mesh_free, [], lib.tartan_growth_mesh, self._handle, options))

    @property
    def measures(self) -> Dict[str, Any]:
        """What it measures as it stands, by name."""
        found = ffi.new("tartan_measures *", lib.tartan_measures_init())
        call(lib.tartan_growth_measure, self._handle, found)
        measures = _fields(found, "tartan_measures")
        if not measures.pop("has_fitness"):
            measures["fitness"] = None
        return measures

    @property
    def counts(self) -> Dict[str, int]:
        """What the last step did; why branches did not join, if `explain` was asked for."""
        found = ffi.new("tartan_growth_counts *", lib.tartan_growth_counts_init())
        call(lib.tartan_growth_last_counts, self._handle, found)
        return _fields(found, "tartan_growth_counts")

    def _statistics(self):
        return made("tartan_statistics", lib.tartan_statistics_free, [self._handle], lib.tartan_growth_statistics,
                    self._handle)

    @property
    def ages(self) -> Dict[Tuple[int, int], int]:
        """How many edges there are, by label and age."""
        count, statistics = ffi.new("size_t *"), self._statistics()
        ages = lib.tartan_statistics_ages(statistics, count)
        return {(ages[i].label, ages[i].age): ages[i].count for i in range(count[0])}

    @property
    def sides(self) -> Dict[int, int]:
        """How many faces there are, by their number of sides."""
        count, statistics = ffi.new("size_t *"), self._statistics()
        sides = lib.tartan_statistics_sides(statistics, count)
        return {sides[i].sides: sides[i].count for i in range(count[0])}

    @property
    def expressions(self) -> Dict[str, float]:
        """The values of the study's named fitness expressions; not finite if there is none."""
        of, value, statistics = ffi.new("const char **"), ffi.new("double *"), self._statistics()
        found: Dict[str, float] = {}
        while lib.tartan_statistics_expression(statistics, len(found), of, value):
            found[text(of[0])] = value[0]
        return found

    def __repr__(self):
        return f"Surface({self.file.name!r}, {self.steps} steps)"

    def _repr_svg_(self):
        return self.draw("svg").decode()


def _force(force):
    return {"kind": _one_of(_FORCES, force.kind, "force"), "at": list(force.at), "strength": force.strength,
            "exponent": force.exponent}


def _boundary(boundary):
    return {"kind": _one_of(_BOUNDARIES, boundary.kind, "boundary"), "mode": _one_of(_MODES, boundary.mode, "mode"),
            "inside": boundary.inside, "a": list(boundary.a), "b": list(boundary.b), "radius": boundary.radius,
            "mesh": boundary.mesh._handle if boundary.mesh is not None else ffi.NULL}


def _fields(found, kind):
    """A struct's members by their names, but its size."""
    members = {}
    for member, _ in ffi.typeof(kind).fields:
        value = getattr(found, member)
        members[member] = tuple(value) if isinstance(value, ffi.CData) else value
    members.pop("size")
    return members
