"""A notebook without a screen: what objects show there."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

from support import BOXES

CELLS = [
    f"import tartan\nfile = tartan.File(text={BOXES!r}, name='boxes.plan')\nrows = file.library('rows')\nfile",
    "rows", "rows[3]", "rows.sample(5)", "rows.sample(5).measure('long')", "file.rules['pair']", "rows.distribution('long')",
    "rows.front(least='long', most='halls')", "rows.explain(rows[0])", "file.test()",
    "tartan.File('square').surface().grow(3)", "tartan.File('primitives').mesh('sphere', grid=20)",
    "tartan.File('cottage').houses()[0]",
]


class Notebook(unittest.TestCase):
    def test_shown(self):
        try:
            import ipykernel  # noqa: F401
            import nbconvert  # noqa: F401
        except ImportError:
            self.skipTest("python3-nbconvert and python3-ipykernel are not there")
        book = {"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": [
            {"cell_type": "code", "id": f"c{i}", "metadata": {}, "execution_count": None, "outputs": [], "source": source}
            for i, source in enumerate(CELLS)]}
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "book.ipynb")
            with open(path, "w", encoding="utf-8") as file:
                json.dump(book, file)
            environment = dict(os.environ, JUPYTER_PATH=folder, IPYTHONDIR=folder, HOME=folder)
            kernel = os.path.join(folder, "kernels", "python3")
            os.makedirs(kernel)
            with open(os.path.join(kernel, "kernel.json"), "w", encoding="utf-8") as file:
                json.dump({"argv": [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"],
                           "display_name": "Python", "language": "python"}, file)
            subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output", "done.ipynb", path],
                           check=True, env=environment, capture_output=True, timeout=280)
            with open(os.path.join(folder, "done.ipynb"), encoding="utf-8") as file:
                cells = json.load(file)["cells"]
        for source, cell in zip(CELLS, cells):
            kinds = {kind for output in cell["outputs"] for kind in output.get("data", {})}
            self.assertTrue(kinds & {"image/svg+xml", "image/png", "text/html"}, source)


if __name__ == "__main__":
    unittest.main()
