"""What the makers of cases pass to each other: a surface with its true ends, and what is asked of it."""
import copy
import dataclasses

import numpy as np

FLOWING = ("inlet", "open")  # roles of ends that have to be open


class Unfit(Exception):
    """A case that cannot be made, and why."""


@dataclasses.dataclass
class Model:
    """A surface with its true ends; functions return new ones."""
    points: np.ndarray     # [mm], #V x 3
    triangles: np.ndarray  # indices, #F x 3, counter-clockwise from outside
    ends: list             # as in a truth's `ends`, each with `outward`


@dataclasses.dataclass
class Order:
    """What is asked for: the number-th case of a kind from a source."""
    source: str
    kind: str
    number: int              # from 0
    lists_all: bool          # whether the source's truth lists all ends of the source
    voxel_mm: float | None   # largest voxel edge of a source that is a mask; None: a surface

    @property
    def image(self):
        """Whether an image of intensities is asked for, not a mask."""
        return self.kind in ("image", "box-image")

    @property
    def narrows(self):
        """Of "not-widest": whether the inlet is narrowed, not an outlet dilated."""
        return self.number in (1, 3)

    @property
    def closes(self):
        """Of "not-widest": whether all ends are closed at last."""
        return self.number >= 2

    @property
    def fewest_ends(self):
        """How many flowing ends a case needs at least."""
        return 2 if self.lists_all else 1


def unit(vector):
    """The vector at length 1; 0 stays 0."""
    return vector / max(np.linalg.norm(vector), 1e-12)


def place(end):
    """An end's middle [mm]."""
    return np.array(end["place_mm"], float)


def outward(end):
    """An end's direction out of the vessel, of length 1."""
    return unit(np.array(end["outward"], float))


def flows(end):
    """Whether an end has to be open."""
    return end["role"] in FLOWING


def rounded(vector):
    """A vector as truths have it."""
    return [round(float(x), 4) for x in vector]


def with_end(ends, index, **fields):
    """A copy of the ends, some fields of one of them changed."""
    ends = copy.deepcopy(ends)
    for name, value in fields.items():
        ends[index][name] = rounded(value) if isinstance(value, np.ndarray) else value
    return ends
