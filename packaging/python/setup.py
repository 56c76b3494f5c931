"""The version is that of the program, ../../CMakeLists.txt."""
import pathlib
import re

import setuptools

cmake = (pathlib.Path(__file__).resolve().parents[2] / "CMakeLists.txt").read_text()
setuptools.setup(version=re.findall(r"project\(vesselbench VERSION ([\d.]+)", cmake)[0])
