"""Builds the extension module by cffi, for all Pythons from 3.9 on. build_tartan.py says where the libraries are."""
import os
import re

from setuptools import setup

HERE = os.path.dirname(os.path.abspath(__file__))


def version():
    with open(os.path.join(HERE, "..", "include", "tartan", "base.h"), encoding="utf-8") as header:
        return re.search(r'#define TARTAN_VERSION "([^"]+)"', header.read())[1]


setup(version=version(), cffi_modules=["build_tartan.py:ffi"], options={"bdist_wheel": {"py_limited_api": "cp39"}})
