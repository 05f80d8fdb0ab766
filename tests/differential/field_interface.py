"""The mesh of a surface by the C interface, by ctypes, against the command's. A crash of the library is one of the process that asks it:
field_interface.py LIBTARTAN FILE SURFACE SAMPLES THREADS, which prints the mesh as JSON."""
import ctypes
import json
import os
import shutil
import subprocess
import sys

from c_interface import Error, Refusal
from program import TARTAN, Wrong, environment, read_json, same


class Options(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("surface", ctypes.c_char_p), ("samples", ctypes.c_uint32), ("open", ctypes.c_bool),
                ("jumps_open", ctypes.c_bool), ("sample_limit", ctypes.c_uint64), ("triangle_limit", ctypes.c_uint64), ("threads", ctypes.c_uint32),
                ("folder", ctypes.c_char_p), ("read_mesh", ctypes.c_void_p), ("sharp", ctypes.c_bool)]


def meshed(path, file, surface, samples, threads):
    c, module, mesh, error = ctypes.CDLL(path), ctypes.c_void_p(), ctypes.c_void_p(), Error()
    reader = ctypes.cast(c.tartan_mesh_read, ctypes.c_void_p)
    options = Options(ctypes.sizeof(Options), surface.encode(), samples, threads=threads, read_mesh=reader)
    if c.tartan_compile_file(file.encode(), None, ctypes.byref(module), ctypes.byref(error)) or \
            c.tartan_field_mesh(module, ctypes.byref(options), None, ctypes.byref(mesh), None, ctypes.byref(error)):
        raise Refusal(error.message.decode())
    c.tartan_mesh_positions.restype, c.tartan_mesh_faces.restype = ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_uint32)
    count, faces, corners = ctypes.c_size_t(), ctypes.c_size_t(), ctypes.POINTER(ctypes.c_uint32)()
    positions = c.tartan_mesh_positions(mesh, ctypes.byref(count))
    c.tartan_mesh_faces(mesh, ctypes.byref(corners), ctypes.byref(faces))
    made = {"vertices": [positions[3 * i:3 * i + 3] for i in range(count.value)], "triangles": [corners[3 * i:3 * i + 3] for i in range(faces.value)]}
    c.tartan_mesh_free(mesh)
    c.tartan_module_free(module)
    return made


# ---- the question

def by_c_interface(subject):
    path = os.path.join(os.path.dirname(shutil.which(TARTAN) or ""), "libtartan.so")
    if not os.path.exists(path) or 'use "shapes"' in subject.text:           # the standard library is the caller's to find
        return
    command = [sys.executable, "-B", os.path.abspath(__file__), path, subject.path, subject.part, str(subject.samples), "2"]
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", timeout=120, env=environment())
    if "runtime does not come first" in done.stderr:
        return
    if done.returncode:
        raise Wrong("the C interface ends", f"{done.returncode}: {done.stderr[-300:]}", "0")
    found, mesh = read_json("mesh of the C interface", done.stdout), subject.own_mesh
    same("triangles of the C interface", found["triangles"] == [list(t) for t in mesh.triangles], True)
    same("vertices of the C interface", found["vertices"] == [list(v) for v in mesh.vertices], True)


if __name__ == "__main__":
    print(json.dumps(meshed(*sys.argv[1:4], *map(int, sys.argv[4:6]))))
