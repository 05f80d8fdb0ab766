"""Rows of numbers: numpy's arrays if numpy is there, else Python's own, over the same bytes."""
import array

from tartan._tartan import ffi

try:
    import numpy
except ImportError:  # everything works without it
    numpy = None  # type: ignore[assignment]

SIZE = "Q" if ffi.sizeof("size_t") == 8 else "L"
_NUMPY = {"I": "uint32", SIZE: "uintp", "B": "uint8", "d": "float64", "Q": "uint64"}
_C = {"I": "uint32_t[]", SIZE: "size_t[]", "B": "uint8_t[]", "d": "double[]"}


def joined(kind, parts):
    """One array of what several buffers hold."""
    if numpy is not None:
        return numpy.frombuffer(b"".join(parts), dtype=_NUMPY[kind])
    made = array.array(kind)
    for part in parts:
        made.frombytes(part)
    return made


def of(kind, numbers):
    """An array of numbers, which is not copied if it is one already."""
    if numpy is not None:
        return numpy.ascontiguousarray(numbers, dtype=_NUMPY[kind])
    return numbers if isinstance(numbers, array.array) and numbers.typecode == kind else array.array(kind, numbers)


def empty(kind, count):
    if numpy is not None:
        return numpy.empty(count, dtype=_NUMPY[kind])
    return array.array(kind, bytes(array.array(kind).itemsize * count))


def pointer(kind, numbers):
    """The array for a call, which reads or fills it."""
    return ffi.from_buffer(_C[kind], numbers) if len(numbers) else ffi.NULL


def shifted(ends, by):
    """Ends of plans that lie `by` trays further on."""
    if by == 0:
        return ends
    if numpy is not None:
        return ends + numpy.uintp(by)
    return array.array(SIZE, (end + by for end in ends))


def view(kind, start, count, owner, columns=None):
    """`count` numbers that C holds, without a copy; `owner` stays as long as the view. With numpy an array, in rows of so
    many columns if `columns` says so."""
    if start == ffi.NULL or count == 0:
        numbers = empty(kind, 0)
        return numbers.reshape(0, columns) if numpy is not None and columns else numbers
    held = ffi.gc(ffi.cast("char *", start), lambda _, owner=owner: None)
    lent = ffi.buffer(held, count * ffi.sizeof(_C[kind][:-2]))
    if numpy is None:
        return memoryview(lent).cast("B").cast("L" if kind == "Q" else kind).toreadonly()
    numbers = numpy.frombuffer(lent, dtype=_NUMPY[kind])
    numbers.flags.writeable = False
    return numbers.reshape(-1, columns) if columns else numbers
