"""Signatures say their types, and mypy, where it is installed, finds them right."""
import ast
import glob
import os
import subprocess
import sys
import unittest

import tartan

FOLDER = os.path.dirname(tartan.__file__)


def public(path):
    """The functions that users call: each with whether it says what it returns."""
    with open(path, encoding="utf-8") as file:
        tree = ast.parse(file.read())
    found = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    for node in tree.body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            found += [inner for inner in node.body if isinstance(inner, ast.FunctionDef)]
    return {(os.path.basename(path), node.name): node.returns is not None for node in found if not node.name.startswith("_")}


class Types(unittest.TestCase):
    INNER = {"file_of", "batches", "wishes", "read"}  # what the modules share among themselves

    def test_said(self):
        functions = {}
        for path in glob.glob(FOLDER + "/[a-z]*.py"):
            functions.update(public(path))
        self.assertGreater(len(functions), 100)
        self.assertEqual({name for name, said in functions.items() if not said and name[1] not in self.INNER and
                          name not in {("answers.py", "keys"), ("meshes.py", "write")}}, set())

    def test_right(self):
        try:
            done = subprocess.run(["mypy", "--python-version", "3.9", "--ignore-missing-imports", FOLDER], capture_output=True,
                                  text=True, env=dict(os.environ, MYPY_CACHE_DIR=os.devnull))
        except FileNotFoundError:
            self.skipTest("mypy is not there")
        self.assertEqual(done.returncode, 0, done.stdout)


if __name__ == "__main__":
    sys.exit(unittest.main())
