"""Meshes: views of what the engines hold, and files of them."""
from __future__ import annotations

import os
from typing import Any, List, Optional

from tartan import _arrays
from tartan._call import Watch, call, file, lib, made, name, own, path, text
from tartan._tartan import ffi
from tartan._types import Array, Path, Progress
from tartan.errors import Error
from tartan.plans import file_of

__all__ = ["Mesh", "field", "read"]

FORMATS = {"obj": lib.TARTAN_OBJ, "ply": lib.TARTAN_PLY, "glb": lib.TARTAN_GLB, "dxf": lib.TARTAN_DXF,
           "stl": lib.TARTAN_STL, "off": lib.TARTAN_OFF, "om": lib.TARTAN_OM}


class InSpace:
    """What is drawn in space: by the function of the interface that it names, and in its format unless another is asked
    for."""

    _drawn_by: Any
    _drawn_as: str
    _handle: Any

    def draw(self, format: Optional[str] = None, *, title: Optional[str] = None, caption: Optional[str] = None,
             azimuth: Optional[float] = None, elevation: Optional[float] = None, width: float = 0, dpi: int = 0,
             progress: Progress = None) -> bytes:
        """A picture of it as it stands, shaded, as bytes of "svg", "png" or "pdf". azimuth, elevation: of the camera, in
        degrees."""
        drawing = ffi.new("tartan_growth_drawing *", lib.tartan_growth_drawing_init())
        kept = [name(title), name(caption)]
        drawing.title, drawing.caption = kept
        if azimuth is not None or elevation is not None:
            drawing.camera = True
            drawing.azimuth = -60 if azimuth is None else azimuth
            drawing.elevation = 30 if elevation is None else elevation
        drawing.width, drawing.dpi = width, dpi
        return file_of(self._drawn_by, format or self._drawn_as, self._handle, drawing=drawing, progress=progress)


class Mesh(InSpace):
    """A mesh, which does not change. Its arrays look into the engine's memory, without a copy, and keep it alive.

    positions: x, y, z of each vertex, in rows. corners: the vertices of all faces, counter-clockwise seen from outside,
    one face after another; the i-th begins at face_starts[i]. faces: the same in rows, if all faces have as many.
    """

    _drawn_by, _drawn_as = lib.tartan_mesh_draw, "png"

    def __init__(self, handle):
        self._handle = handle
        self.findings = None  # of an implicit surface: what was found on the way

    @classmethod
    def of(cls, positions, faces) -> Mesh:
        """A mesh of one's own: points, and of each face the numbers of its points."""
        coordinates = _arrays.of("d", [float(number) for point in positions for number in point])
        starts: list = [0]
        corners: list = []
        for face in faces:
            corners.extend(int(corner) for corner in face)
            starts.append(len(corners))
        starts, corners = _arrays.of("I", starts), _arrays.of("I", corners)
        return cls._copy(coordinates, starts, corners)

    @classmethod
    def _copy(cls, coordinates, starts, corners):
        return cls(made("tartan_mesh", lib.tartan_mesh_free, [], lib.tartan_mesh_new, _arrays.pointer("d", coordinates),
                        len(coordinates) // 3, _arrays.pointer("I", starts), _arrays.pointer("I", corners),
                        len(starts) - 1))

    @property
    def positions(self) -> Array:
        count = ffi.new("size_t *")
        start = lib.tartan_mesh_positions(self._handle, count)
        return _arrays.view("d", start, 3 * count[0], self._handle, 3)

    def _faces(self):
        corners, count = ffi.new("const uint32_t **"), ffi.new("size_t *")
        starts = lib.tartan_mesh_faces(self._handle, corners, count)
        return starts, corners[0], count[0]

    @property
    def face_starts(self) -> Array:
        starts, _, count = self._faces()
        return _arrays.view("I", starts, count + 1, self._handle)

    @property
    def corners(self) -> Array:
        starts, corners, count = self._faces()
        return _arrays.view("I", corners, starts[count] if count else 0, self._handle)

    @property
    def faces(self) -> Array:
        """With numpy: an array with a row a face. Error if faces have different numbers of corners."""
        starts, corners, count = self._faces()
        sides = starts[1] if count else 3
        if count and (starts[count] != sides * count or any(starts[i] != sides * i for i in range(count))):
            raise Error("the faces have different numbers of corners", help="take `corners` and `face_starts`, or "
                        "triangulated()")
        return _arrays.view("I", corners, sides * count, self._handle, sides)

    @property
    def lines(self) -> Array:
        """Pairs of vertices: the edges of the rules, if they were asked for."""
        count = ffi.new("size_t *")
        start = lib.tartan_mesh_lines(self._handle, count)
        return _arrays.view("I", start, 2 * count[0], self._handle, 2)

    @property
    def groups(self) -> List[str]:
        """The names of its groups, to which `face_groups` and `line_groups` are indices."""
        return [text(lib.tartan_mesh_group_name(self._handle, i))
                for i in range(lib.tartan_mesh_group_count(self._handle))]

    @property
    def face_groups(self) -> Optional[Array]:
        return self._grouped(lib.tartan_mesh_face_groups(self._handle), self._faces()[2])

    @property
    def line_groups(self) -> Optional[Array]:
        return self._grouped(lib.tartan_mesh_line_groups(self._handle), len(self.lines) // (1 if _arrays.numpy else 2))

    def _grouped(self, start, count):
        return None if start == ffi.NULL else _arrays.view("I", start, count, self._handle)

    @property
    def normals(self) -> Array:
        """Unit normals of the vertices, weighted by area; zeros if there is none."""
        count = ffi.new("size_t *")
        lib.tartan_mesh_positions(self._handle, count)
        normals = _arrays.empty("d", 3 * count[0])
        call(lib.tartan_mesh_normals, self._handle, _arrays.pointer("d", normals) or ffi.new("double[1]"))
        return normals.reshape(-1, 3) if _arrays.numpy is not None else normals

    # ---- other meshes of it, without lines and groups

    def _changed(self, function, *arguments):
        starts, corners, count = self._faces()
        vertices = ffi.new("size_t *")
        positions = lib.tartan_mesh_positions(self._handle, vertices)
        copy = made("tartan_mesh", lib.tartan_mesh_free, [], lib.tartan_mesh_new, positions, vertices[0], starts, corners,
                    count)
        call(function, copy, *arguments)
        return Mesh(copy)

    def triangulated(self) -> Mesh:
        return self._changed(lib.tartan_mesh_triangulate)

    def smoothed(self, rounds: int = 1) -> Mesh:
        """Vertices moved towards their neighbours, but for the outline."""
        return self._changed(lib.tartan_mesh_smooth, rounds)

    def subdivided(self, rounds: int = 1) -> Mesh:
        """Four faces of one in each round: Catmull-Clark, or Loop if all faces are triangles."""
        return self._changed(lib.tartan_mesh_subdivide, rounds)

    def decimated(self, faces) -> Mesh:
        """About so many triangles."""
        return self._changed(lib.tartan_mesh_decimate, faces)

    # ---- files

    def file(self, format: str, *, note: Optional[str] = None, normals: bool = False, y_up: bool = False,
             progress: Progress = None) -> bytes:
        """The mesh as a file in memory: obj, ply, glb, dxf, stl, off or om."""
        if format not in FORMATS:
            raise ValueError(f"meshes are {', '.join(FORMATS)}, not {format!r}")
        style = ffi.new("tartan_mesh_style *", lib.tartan_mesh_style_init())
        kept = name(note)
        style.note, style.normals, style.y_up = kept, normals, y_up
        return file(lib.tartan_mesh_write, self._handle, FORMATS[format], style, Watch(progress))

    def write(self, path: Path, **how: Any) -> None:
        """Writes a file whose name says the format; see file()."""
        write(path, lambda format: self.file(format, **how))

    def __repr__(self):
        count = ffi.new("size_t *")
        lib.tartan_mesh_positions(self._handle, count)
        return f"Mesh({count[0]:,} vertices, {self._faces()[2]:,} faces)"

    def _repr_png_(self):
        return self.draw("png", dpi=96)


def write(path_, make):
    """Writes what `make` makes of the format that a file's name ends in: beside its place first, so that nothing half
    written stands there."""
    path_ = os.fspath(path_)
    data = make(os.path.splitext(path_)[1][1:].lower())
    beside = f"{path_}.{os.getpid()}.tmp"
    try:
        with open(beside, "wb") as out:
            out.write(data)
        os.replace(beside, path_)
    except BaseException:
        if os.path.exists(beside):
            os.remove(beside)
        raise


def read(path_) -> Mesh:
    """The mesh of an OBJ, PLY, STL, OFF or OM file."""
    return Mesh(made("tartan_mesh", lib.tartan_mesh_free, [], lib.tartan_mesh_read, path(path_)))


READER = ffi.addressof(lib, "tartan_mesh_read")


class Findings:
    """What was found when a surface was meshed: `inside`, `outside`, which sides of the box `cut` it ("low x"), how many
    samples had `no_values`, over how many vertices the field `jumps`, the `spacing` of samples, and how many points
    were added for `sharp` edges."""

    SIDES = ("low x", "high x", "low y", "high y", "low z", "high z")

    def __init__(self, found):
        self.inside, self.outside = found.inside, found.outside
        self.cut = [side for i, side in enumerate(self.SIDES) if found.cut >> i & 1]
        self.no_values, self.jumps = found.no_values, found.jumps
        self.no_value = tuple(found.no_value) if found.no_values else None
        self.jump = tuple(found.jump) if found.jumps else None
        self.spacing, self.sharp = found.spacing, found.sharp

    def __repr__(self):
        return f"Findings({', '.join(f'{key}={value!r}' for key, value in self.__dict__.items())})"


def field(of, surface: Optional[str] = None, progress: Progress = None, *, grid: int = 0, open: bool = False,
          jumps_open: bool = False, sharp: bool = False, max_samples: int = 0, max_triangles: int = 0,
          threads: int = 0) -> Mesh:
    """The mesh of an implicit surface of a file; without a name of its last. grid: samples on the longest side of its
    box. open: ends at the box. jumps_open: is open where the field jumps. sharp: has sharp edges and corners."""
    options = ffi.new("tartan_field_options *", lib.tartan_field_options_init())
    kept = name(surface)
    options.surface, options.samples, options.open, options.jumps_open = kept, grid, open, jumps_open
    options.sharp, options.sample_limit, options.triangle_limit = sharp, max_samples, max_triangles
    options.threads, options.read_mesh = threads, READER
    findings = ffi.new("tartan_field_findings *", lib.tartan_field_findings_init())
    room = ffi.new("tartan_mesh **")
    call(lib.tartan_field_mesh, of._module, options, Watch(progress), room, findings)
    mesh = Mesh(own(room[0], lib.tartan_mesh_free))
    mesh.findings = Findings(findings)
    return mesh
