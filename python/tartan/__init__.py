"""Tartan: rules of design, compiled; what they make counted, ranked, sampled, grown, meshed and drawn.

    import tartan
    cabins = tartan.File("cabins.plan").library("cabins")
    cabins.count(), cabins[10**6], cabins.sample(12, seed=7)

Everything is exact, and the same on every machine: counts are ints of any size, values of measures Fractions. What
needs numpy or pandas uses them if they are there."""
from tartan._call import lib as _lib, text as _text
from tartan.answers import QUESTIONS, Answer
from tartan.errors import Diagnostic, Error
from tartan.evolution import Evolution, Grammar
from tartan.files import File, stdlib
from tartan.houses import House, HouseLibrary
from tartan.libraries import Library, diff
from tartan.meshes import Mesh
from tartan.models import Model
from tartan.plans import Length, Plan, Plans, Tray, Zone
from tartan.surfaces import Boundary, Force, Surface

__version__ = _text(_lib.tartan_version())
__all__ = ["Answer", "Boundary", "Diagnostic", "Error", "Evolution", "File", "Force", "Grammar", "House", "HouseLibrary",
           "Length", "Library", "Mesh", "Model", "Plan", "Plans", "QUESTIONS", "Surface", "Tray", "Zone", "diff", "stdlib"]
