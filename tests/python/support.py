"""Folders, surfaces and stand-ins of the program for the tests of packaging/python/vesselbench."""
import os
import stat
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["VESSELBENCH"]
CUBE_EDGE = 20.0  # [mm]
CUBE = "OFF, 8 12 0, " \
    "0 0 0, 20 0 0, 20 20 0, 0 20 0, 0 0 20, 20 0 20, 20 20 20, 0 20 20, " \
    "3 0 2 1, 3 0 3 2, 3 4 5 6, 3 4 6 7, 3 0 1 5, 3 0 5 4, 3 1 2 6, 3 1 6 5, 3 2 3 7, 3 2 7 6, 3 3 0 4, 3 3 4 7"


class InFolder(unittest.TestCase):
    """Each test has an empty current folder, whose name has a space and letters beyond ASCII."""

    def setUp(self):
        made = tempfile.TemporaryDirectory(prefix="gefäß 血管 ")
        self.addCleanup(made.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(made.name)
        self.folder = Path(made.name)

    def cube(self, name="cube.off"):
        """A cube with edges of 20 mm and 12 triangles."""
        Path(name).write_text(CUBE.replace(", ", "\n") + "\n")
        return name

    def stand_in(self, script, name="stand-in"):
        """A shell script in the program's place."""
        path = self.folder / name
        path.write_text("#!/bin/sh\n" + script + "\n")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return path

    def set_variable(self, name, value):
        """Of the environment, until the test's end; None: not set."""
        before = os.environ.get(name)
        self.addCleanup(lambda: os.environ.pop(name, None) if before is None else os.environ.update({name: before}))
        os.environ.pop(name, None)
        if value is not None:
            os.environ[name] = str(value)
