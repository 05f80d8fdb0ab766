"""Plans as a stream of Arrow, for whatever reads its C interface: a row a tray, in one batch.

Columns are the plan's number, the tray's place in it, and each field, as indices into a dictionary of its values.
https://arrow.apache.org/docs/format/CDataInterface.html"""
import ctypes

from tartan import _arrays
from tartan._tartan import ffi, lib

#: What C holds, by the address of the structure that holds it, until it is released.
_held = {}


def _hold(structure, *kept):
    _held[int(ffi.cast("uintptr_t", structure.private_data))] = kept


def _private(structure):
    """A number of its own for a structure, which a consumer may move."""
    handle = ffi.new("char[1]")
    structure.private_data = handle
    return handle


class _Stream:
    def __init__(self, plans):
        self.plans = plans
        self.done = False


def stream(plans):
    """A capsule that holds an ArrowArrayStream of the plans."""
    made = ffi.cast("struct ArrowArrayStream *", _allocate(ffi.sizeof("struct ArrowArrayStream")))
    handle = ffi.new_handle(_Stream(plans))
    made.private_data = handle
    _held[int(ffi.cast("uintptr_t", handle))] = handle
    made.get_schema = lib.tartan_python_get_schema
    made.get_next = lib.tartan_python_get_next
    made.get_last_error = lib.tartan_python_last_error
    made.release = lib.tartan_python_free_stream
    capsule = ctypes.pythonapi.PyCapsule_New
    capsule.restype, capsule.argtypes = ctypes.py_object, [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p]
    drop = ffi.cast("uintptr_t", ffi.addressof(lib, "tartan_python_drop_stream"))
    return capsule(int(ffi.cast("uintptr_t", made)), b"arrow_array_stream", int(drop))


def _allocate(size):
    """Zeros that the destructor of a capsule frees by C's free."""
    return ffi.cast("void *", lib.calloc(1, size))


def _complete(structure, kept, children, dictionary):
    """What schemas and arrays have alike: children of their own kind, a dictionary, and what is kept until their release."""
    pointers = ffi.new(f"{ffi.typeof(structure).item.cname} *[]", list(children))
    structure.n_children, structure.children = len(children), pointers if children else ffi.NULL
    structure.dictionary = dictionary if dictionary is not None else ffi.NULL
    _hold(structure, kept, pointers, children, dictionary)


# ---- the schema

def _schema(structure, format, name, children=(), dictionary=None):
    """Fills a schema; what it points to is kept until it is released."""
    kept = [ffi.new("char[]", format.encode()), ffi.new("char[]", name.encode()), _private(structure)]
    structure.format, structure.name, structure.metadata = kept[0], kept[1], ffi.NULL
    structure.flags = 0
    structure.release = lib.tartan_python_free_schema
    _complete(structure, kept, children, dictionary)


def _fill_schema(schema, out):
    children = []
    for column in ("plan", "tray"):
        child = ffi.new("struct ArrowSchema *")
        _schema(child, "l", column)
        children.append(child)
    for field in schema.fields:
        values, child = ffi.new("struct ArrowSchema *"), ffi.new("struct ArrowSchema *")
        _schema(values, "u", "")
        _schema(child, "I", field.name, dictionary=values)
        children.append(child)
    _schema(out, "+s", "", children)


# ---- the rows

def _array(structure, length, buffers, children=(), dictionary=None):
    """Fills an array over buffers, which are kept until it is released."""
    pointers = ffi.new("const void *[]", [ffi.NULL if buffer is None else ffi.cast("void *", ffi.from_buffer(buffer))
                                          for buffer in buffers])
    kept = [list(buffers), pointers, _private(structure)]
    structure.length, structure.null_count, structure.offset = length, 0, 0
    structure.n_buffers, structure.buffers = len(buffers), pointers
    structure.release = lib.tartan_python_free_array
    _complete(structure, kept, children, dictionary)


def _numbers(kind, numbers):
    """Bytes of whole numbers, never none of them, so that there is an address."""
    import array
    return array.array(kind, numbers).tobytes() or b"\0"


def _places(plans):
    """The plan of each tray, and its place there."""
    plan, tray, begin = [], [], 0
    for i, end in enumerate(plans.ends):
        plan.extend([i] * int(end - begin))
        tray.extend(range(int(end - begin)))
        begin = end
    return plan, tray


def _dictionary(spellings):
    texts = [spelling.encode() for spelling in spellings]
    offsets = [0]
    for said in texts:
        offsets.append(offsets[-1] + len(said))
    values = ffi.new("struct ArrowArray *")
    _array(values, len(texts), [None, _numbers("i", offsets), b"".join(texts) or b"\0"])
    return values


def _codes(plans, field):
    column = plans.schema.column(field)
    if _arrays.numpy is not None:
        return _arrays.numpy.ascontiguousarray(column[plans.trays]).tobytes() or b"\0"
    return _numbers("I", [column[tray] for tray in plans.trays])


def _fill_array(plans, out):
    rows, children = len(plans.trays), []
    for numbers in _places(plans):
        child = ffi.new("struct ArrowArray *")
        _array(child, rows, [None, _numbers("q", numbers)])
        children.append(child)
    for i, field in enumerate(plans.schema.fields):
        child = ffi.new("struct ArrowArray *")
        _array(child, rows, [None, _codes(plans, i)], dictionary=_dictionary(field.spellings))
        children.append(child)
    _array(out, rows, [None], children)


# ---- what the consumer calls

FAILED = 5  # EIO


@ffi.def_extern(name="tartan_python_get_schema", error=FAILED)
def _get_schema(structure, out):
    _fill_schema(ffi.from_handle(structure.private_data).plans.schema, out)
    return 0


@ffi.def_extern(name="tartan_python_get_next", error=FAILED)
def _get_next(structure, out):
    of = ffi.from_handle(structure.private_data)
    if of.done:
        out.release = ffi.NULL
    else:
        _fill_array(of.plans, out)
        of.done = True
    return 0


_SORRY = ffi.new("char[]", b"the plans could not be handed out")


@ffi.def_extern(name="tartan_python_last_error")
def _last_error(structure):
    return _SORRY


def _release(structure):
    """Releases the children that a consumer has not taken, and lets go of what was held."""
    for i in range(structure.n_children):
        child = structure.children[i]
        if child.release:
            child.release(child)
    if structure.dictionary and structure.dictionary.release:
        structure.dictionary.release(structure.dictionary)
    structure.release = ffi.NULL
    _held.pop(int(ffi.cast("uintptr_t", structure.private_data)), None)


@ffi.def_extern(name="tartan_python_free_schema")
def _free_schema(structure):
    _release(structure)


@ffi.def_extern(name="tartan_python_free_array")
def _free_array(structure):
    _release(structure)


@ffi.def_extern(name="tartan_python_free_stream")
def _free_stream(structure):
    structure.release = ffi.NULL
    _held.pop(int(ffi.cast("uintptr_t", structure.private_data)), None)
