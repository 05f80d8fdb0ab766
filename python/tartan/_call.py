"""How the C interface is called: its errors are raised, its texts and objects become Python's, and long work can be
watched and ended.

cffi lets other threads run during each call. An object of the interface is freed once nobody has it, and those that it
was made of after it: what frees it holds them.
"""
import difflib
import os

from tartan._tartan import ffi, lib
from tartan.errors import Diagnostic, Error

KINDS = {lib.TARTAN_INVALID: "invalid", lib.TARTAN_IO: "io", lib.TARTAN_LIMIT: "limit"}
SEVERITIES = {lib.TARTAN_NOTE: "note", lib.TARTAN_WARNING: "warning", lib.TARTAN_ERROR: "error"}


def text(pointer):
    """A text that is borrowed; None for NULL."""
    return ffi.string(pointer).decode("utf-8", "replace") if pointer else None


def taken(pointer):
    """A text that is ours, which is freed."""
    said = text(pointer)
    lib.tartan_text_free(pointer)
    return said


def name(said):
    """A text for a call; NULL for None."""
    if said is None:
        return ffi.NULL
    if not isinstance(said, str):
        raise TypeError(f"a text is wanted, not {type(said).__name__}")
    if "\0" in said:
        raise ValueError("a text cannot hold a zero byte")
    return ffi.new("char[]", said.encode())


def word(said):
    """A text for a call that has to be there."""
    if said is None:
        raise TypeError("a text is wanted, not None")
    return name(said)


def texts(items):
    """An array of texts for a call, and what it consists of, which has to stay."""
    parts = [name(item) for item in items]
    return ffi.new("const char *[]", parts) if parts else ffi.NULL, parts


def path(said):
    """The path of a file for a call."""
    encoded = os.fsencode(said)
    if b"\0" in encoded:
        raise ValueError("a path cannot hold a zero byte")
    return ffi.new("char[]", encoded)


def no_option(what, option, known):
    """That a keyword is none of those known: with the nearest, or all of them."""
    near = difflib.get_close_matches(option, known, 1)
    return TypeError(f"{what} has no option {option!r}; " +
                     (f"did you mean {near[0]!r}?" if near else f"there are {', '.join(sorted(known))}"))


def code_of(number):
    return f"E{number:04}" if number else None


def failure(error):
    """What a failed call says, as an exception."""
    if error.status == lib.TARTAN_MEMORY:
        return MemoryError(text(error.message))
    return Error(text(error.message), code=code_of(error.code), help=text(error.help) or None,
                 column=error.column or None, kind=KINDS.get(error.status, "internal"))


class Watch:
    """Whoever waits for a call: `progress(done, total)` is called now and then (total is 0 if nobody knows), and what it
    raises, as Ctrl-C does, ends the call and is raised again."""

    def __init__(self, progress=None):
        self.progress = progress
        self.raised = None
        self._handle = ffi.new_handle(self)
        self.cdata = ffi.new("tartan_watch *", lib.tartan_watch_init())
        self.cdata.go_on = lib.tartan_python_go_on
        self.cdata.context = self._handle


def _interrupted(kind, raised, traceback):
    """Ctrl-C came before the callback's own first line."""
    ffi.from_handle(traceback.tb_frame.f_locals["context"]).raised = raised


@ffi.def_extern(name="tartan_python_go_on", error=False, onerror=_interrupted)
def _go_on(context, done, total):
    watch = ffi.from_handle(context)
    try:
        if watch.progress is not None:
            watch.progress(done, total)
        return True
    except BaseException as raised:  # KeyboardInterrupt, too: it is raised again behind the call
        watch.raised = raised
        return False


def call(function, *arguments):
    """Calls a function that may fail; a Watch among the arguments is told how far it is."""
    error = ffi.new("tartan_error *")
    watch = next((argument for argument in arguments if isinstance(argument, Watch)), None)
    status = function(*(argument.cdata if argument is watch and watch else argument for argument in arguments), error)
    if watch is not None and watch.raised is not None:
        raise watch.raised
    if status != lib.TARTAN_OK:
        raise failure(error)


#: What is alive of the interface, by its address: how many hold it, the object, what frees it, and what it was made of.
_alive: dict = {}


def _address(pointer):
    return int(ffi.cast("uintptr_t", pointer))


def _let_go(address, alive=_alive):
    """One holder less; the last one frees the object, and lets go of what it was made of. The order cannot come of Python's
    references: its collector of cycles, and its end, clear them in any order."""
    waiting = [address]
    while waiting:
        entry = alive.get(waiting.pop())
        if entry is None:
            continue
        entry[0] -= 1
        if entry[0] == 0:
            _, pointer, where, free, parents, _ = entry
            del alive[where]
            free(pointer)
            waiting.extend(parents)


def own(pointer, free, *kept):
    """An object that is freed once nobody has it; `kept`, objects of the interface or others, stay as long."""
    where = _address(pointer)
    if where in _alive:  # one that is borrowed, again
        _alive[where][0] += 1
    else:
        parents = [_address(one) for one in kept if isinstance(one, ffi.CData) and _address(one) in _alive]
        for parent in parents:
            _alive[parent][0] += 1
        _alive[where] = [1, pointer, where, free, parents, _kept_objects(kept)]

    def release(_, where=where, let_go=_let_go):
        let_go(where)

    return ffi.gc(pointer, release)


def _kept_objects(kept):
    """Those that are no objects of the interface, which Python keeps."""
    return [one for one in kept if not isinstance(one, ffi.CData) or _address(one) not in _alive]


def made(kind, free, kept, function, *arguments):
    """The object that a function hands out through its last argument but the error."""
    room = ffi.new(f"{kind} **")
    call(function, *arguments, room)
    return own(room[0], free, *kept)


def said(function, *arguments):
    """The text that a function hands out so; None if it hands out NULL."""
    room = ffi.new("char **")
    call(function, *arguments, room)
    return taken(room[0]) if room[0] else None


def file(function, *arguments):
    """The bytes of a file that a function makes in memory."""
    room, size = ffi.new("void **"), ffi.new("size_t *")
    call(function, *arguments, room, size)
    try:
        return bytes(ffi.buffer(room[0], size[0]))
    finally:
        lib.tartan_bytes_free(room[0])


class Report:
    """Takes what is said of a file."""

    def __init__(self):
        self.diagnostics = []
        self.context = ffi.new_handle(self)


@ffi.def_extern(name="tartan_python_report")
def _report(context, said):
    placed = said.path != ffi.NULL
    ffi.from_handle(context).diagnostics.append(Diagnostic(
        SEVERITIES[said.severity], text(said.code) or None, text(said.message), text(said.help), text(said.path),
        said.line if placed else None, said.column if placed else None,
        said.end_line if placed else None, said.end_column if placed else None))
