"""Models of parts, placed by a connection grammar or by a kit's model."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, List

from tartan._call import Watch, call, failure, lib, name, no_option, own, text
from tartan._tartan import ffi
from tartan._types import Path, Progress
from tartan.meshes import write
from tartan.surfaces import _fields

__all__ = ["Model", "Part"]


@dataclass(frozen=True)
class Part:
    """A placed part. at: x and z in half studs, y in plates, downwards; heading: quarter turns, or which way it lies."""

    name: str
    at: tuple
    heading: int
    colour: int


class Model:
    """A model of parts: `parts` in the order in which they were placed, or of building.

    model: which of a kit's models. seed: of drawn alternatives. max_parts, max_steps, max_frames, max_lookahead,
    max_models: limits. threads: of a search. `complete`: false if a search came to its limit and this is the best that
    it looked at; `counts`: what placing took.
    """

    _LIMITS = {"max_parts": "part_limit", "max_steps": "step_limit", "max_frames": "frame_limit",
               "max_lookahead": "lookahead_limit", "max_models": "search_limit"}

    def __init__(self, file, progress: Progress = None, *, model=None, seed: int = 0, threads: int = 0, **limits: Any) -> None:
        self.file = file
        options = ffi.new("tartan_place_options *", lib.tartan_place_options_init())
        kept = name(model)
        options.model, options.seed, options.threads = kept, seed, threads
        for limit, value in limits.items():
            if limit not in self._LIMITS:
                raise no_option("placing", limit, {"model", "seed", "threads", *self._LIMITS})
            setattr(options, self._LIMITS[limit], value)
        self._handle = self._placed(file, options, Watch(progress))

    def _placed(self, file, options, watch):
        """A search that came to its limit, or was ended, may hand out the best that it has."""
        room, error = ffi.new("tartan_placement **"), ffi.new("tartan_error *")
        status = lib.tartan_place(file._module, options, watch.cdata, room, error)
        handle = own(room[0], lib.tartan_placement_free, file._module) if room[0] else None
        self.complete = status == lib.TARTAN_OK
        if watch.raised is not None and handle is None:
            raise watch.raised
        if handle is None:
            raise failure(error)
        return handle

    @property
    def parts(self) -> List[Part]:
        count = ffi.new("size_t *")
        parts = lib.tartan_placement_parts(self._handle, count)
        return [Part(text(parts[i].name), tuple(parts[i].at), parts[i].heading, parts[i].colour)
                for i in range(count[0])]

    def __len__(self):
        count = ffi.new("size_t *")
        lib.tartan_placement_parts(self._handle, count)
        return count[0]

    @property
    def counts(self) -> Dict[str, Any]:
        found = ffi.new("tartan_placement_counts *", lib.tartan_placement_counts_init())
        call(lib.tartan_placement_count, self._handle, found)
        return _fields(found, "tartan_placement_counts")

    def _text(self, function):
        room, size = ffi.new("char **"), ffi.new("size_t *")
        call(function, self._handle, room, size)
        try:
            return bytes(ffi.buffer(room[0], size[0])).decode()
        finally:
            lib.tartan_text_free(room[0])

    def ldraw(self) -> str:
        """The model as the text of an LDraw file."""
        return self._text(lib.tartan_placement_ldraw)

    def list(self) -> str:
        """Its parts as CSV: part, colour, number; of a kit also title, mass and price."""
        return self._text(lib.tartan_placement_list)

    def write(self, path: Path) -> None:
        """Writes an LDraw file (.ldr, .mpd, .dat) or the list of parts (.csv)."""
        write(path, self._file)

    def _file(self, format):
        if format not in ("ldr", "mpd", "dat", "csv"):
            raise ValueError(f"models are ldr, mpd, dat or csv, not {format!r}")
        return (self.list() if format == "csv" else self.ldraw()).encode()

    def __repr__(self):
        return f"Model({self.file.name!r}, {len(self)} parts)"
