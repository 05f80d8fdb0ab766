"""Plans as a stream of Arrow, read by its C interface as a frame of data reads it."""
import ctypes
import gc
import unittest

from support import boxes
from tartan import _arrow
from tartan._tartan import ffi


def taken(capsule):
    """The stream in a capsule, moved out of it as the interface asks."""
    pointer = ctypes.pythonapi.PyCapsule_GetPointer
    pointer.restype, pointer.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
    inside = ffi.cast("struct ArrowArrayStream *", pointer(capsule, b"arrow_array_stream"))
    stream = ffi.new("struct ArrowArrayStream *", inside[0])
    inside.release = ffi.NULL
    return stream


def column(array, schema):
    """The values of a column, from its buffers."""
    kinds = {"l": "int64_t", "I": "uint32_t"}
    numbers = ffi.cast(kinds[ffi.string(schema.format).decode()] + " *", array.buffers[1])
    values = list(numbers[0:array.length])
    if schema.dictionary:
        spelled = array.dictionary
        offsets, text = ffi.cast("int32_t *", spelled.buffers[1]), ffi.cast("char *", spelled.buffers[2])
        words = [bytes(ffi.buffer(text + offsets[i], offsets[i + 1] - offsets[i])).decode() for i in range(spelled.length)]
        values = [words[value] for value in values]
    return values


def read(plans):
    stream = taken(plans.__arrow_c_stream__())
    schema, array = ffi.new("struct ArrowSchema *"), ffi.new("struct ArrowArray *")
    assert stream.get_schema(stream, schema) == 0 and stream.get_next(stream, array) == 0
    assert ffi.string(schema.format) == b"+s" and schema.n_children == array.n_children
    columns = {ffi.string(schema.children[i].name).decode(): column(array.children[i], schema.children[i])
               for i in range(schema.n_children)}
    schema.release(schema)
    array.release(array)
    assert stream.get_next(stream, array) == 0 and array.release == ffi.NULL
    stream.release(stream)
    return columns


class Arrow(unittest.TestCase):
    def test_columns(self):
        plans = boxes().library("rows").sample(20, seed=4)
        columns = read(plans)
        trays = [(i, k, tray) for i, plan in enumerate(plans) for k, tray in enumerate(plan)]
        self.assertEqual(columns["plan"], [i for i, _, _ in trays])
        self.assertEqual(columns["tray"], [k for _, k, _ in trays])
        self.assertEqual(columns["width"], [tray.width.text for _, _, tray in trays])
        self.assertEqual(columns["use"], [tray.use for _, _, tray in trays])
        self.assertEqual(columns["lid"], ["lid" if tray.lid else "-" for _, _, tray in trays])

    def test_none(self):
        self.assertEqual(read(boxes().library("rows").sample(0))["width"], [])

    def test_released(self):
        """Nothing is held once it is released: neither a stream that was read, nor one that nobody took."""
        gc.collect()
        before = len(_arrow._held)
        plans = boxes().library("rows").sample(5)
        read(plans)
        capsule = plans.__arrow_c_stream__()
        self.assertGreater(len(_arrow._held), before)
        del capsule
        gc.collect()
        self.assertEqual(len(_arrow._held), before)

    def test_children_moved(self):
        """A consumer may take children and release them after their parent."""
        stream = taken(boxes().library("rows").sample(5).__arrow_c_stream__())
        array = ffi.new("struct ArrowArray *")
        assert stream.get_next(stream, array) == 0
        child = ffi.new("struct ArrowArray *", array.children[2][0])
        array.children[2].release = ffi.NULL
        array.release(array)
        stream.release(stream)
        gc.collect()
        self.assertGreater(child.length, 4)
        self.assertLess(ffi.cast("uint32_t *", child.buffers[1])[0], 2)
        child.release(child)


if __name__ == "__main__":
    unittest.main()
