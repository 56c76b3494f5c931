"""Cases made of a source, each in its folder with its input and truth."""
import os
import zlib

import numpy as np

from ends.orchard import closing, warps
from ends.orchard.boxes import boxed
from ends.orchard.checks import problem
from ends.orchard.clipping import oblique_open
from ends.orchard.images import THRESHOLD, ends_on_piece, intensities, voxelised
from ends.orchard.model import Order, Unfit, flows
from ends.orchard.sources import UNITS, Source, file_of, is_surface, suffix
from ends.orchard.widening import not_widest
from ends.orchard.writing import IMAGES, write_image, write_surface, write_truth

TRIES = 4  # with other random numbers, before a case is dropped

# Makers by kind take a Model, random numbers and the Order. Those of surfaces take an opened model and return a model and the
# number of its ends that are open; those of voxels take a closed one and return the mask of a piece, its grid and its ends.
SURFACES = {"closed-flat": closing.closed_flat, "closed-domed": closing.closed_domed, "closed-ragged": closing.closed_ragged,
            "closed-oblique": closing.closed_oblique, "mixed-closed": closing.mixed_closed, "stub": closing.stub,
            "torn": warps.torn, "oblique-open": oblique_open, "scaled": warps.unchanged, "decimated": warps.decimated,
            "noisy": warps.noisy, "turned": warps.turned, "not-widest": not_widest}
VOLUMES = {"mask": voxelised, "image": voxelised, "box-mask": boxed, "box-image": boxed}


def as_is(truth, case, folder):
    """Writes the truth of a case whose input is the source's own file."""
    arguments = [os.path.join(truth["folder"], a) if "/" in a else a for a in truth.get("arguments") or []]
    if suffix(truth) in ("obj", "stl") and truth.get("units") and "--units" not in arguments:
        arguments += ["--units", truth["units"]]  # which these files do not state
    os.makedirs(folder, exist_ok=True)
    write_truth(folder, truth, name=case, source=truth["name"], made="as-is", arguments=arguments,
                input=os.path.abspath(file_of(truth)))


def made_surface(model, rng, order, folder):
    """Writes a surface. Returns what differs from the source's truth; Unfit if it is no case."""
    model, open_ends = SURFACES[order.kind](model, rng, order)
    if why := problem(model, open_ends):
        raise Unfit(why)
    os.makedirs(folder, exist_ok=True)
    scaled = order.kind == "scaled"
    units = ("cm", "m")[rng.integers(2)] if scaled else "mm"
    way = "stl" if scaled else ("vtp", "stl")[rng.integers(2)]
    return {"ends": model.ends, "input": write_surface(folder, model, way, UNITS[units]), "arguments": ["--units", units],
            "units": units, "kind": "surface-open" if open_ends else "surface-closed"}


def made_volume(model, rng, order, folder):
    """Writes a mask or an image. Returns what differs from the source's truth; Unfit if it is no case."""
    piece, grid, ends = VOLUMES[order.kind](model, rng, order)
    voxels = piece
    if order.image:
        voxels, piece = intensities(model, piece, grid, rng)
        ends = ends_on_piece(ends, piece, grid, order.fewest_ends)
    elif piece.sum() < 300:
        raise Unfit("too few voxels")
    os.makedirs(folder, exist_ok=True)
    file = write_image(folder, voxels, grid, list(IMAGES)[rng.integers(3)])
    return {"ends": ends, "input": file, "arguments": ["--set", f"extract-surface.threshold={THRESHOLD}"] if order.image else [],
            "units": "mm", "edge_mm": round(float(grid.spacing.max()), 4), "kind": "intensity" if order.image else "mask"}


def made_case(source, order, folder, case):
    """Makes a case by its name's random numbers. Returns why it is dropped, or None."""
    truth, reason = source.truth, None
    volume = order.kind in VOLUMES
    for attempt in range(1 if order.kind.startswith("box") else TRIES):  # a box is tried many times anyway
        rng = np.random.default_rng([zlib.crc32(case.encode()), attempt])
        try:
            model = source.model("closed" if volume else "opened")
            fields = (made_volume if volume else made_surface)(model, rng, order, folder)
            if volume and truth.get("others"):
                fields["min_openings"] = min(truth.get("min_openings") or 0, sum(map(flows, fields["ends"])))
            write_truth(folder, truth, name=case, source=truth["name"], made=order.kind, **fields)
            return None
        except Unfit as why:
            reason = str(why)
    return reason


def order_of(truth, kind, number):
    return Order(truth["name"], kind, number, lists_all=not truth.get("others"),
                 voxel_mm=None if is_surface(truth) else truth.get("edge_mm"))


def make_source(truth, cases, out):
    """Makes those of a source's cases, (kind, number), that the folder `out` has not.
    Returns the source's name, and (kind, why it is dropped or None, whether it is new) of each case."""
    source, done = Source(truth), []
    for kind, number in cases:
        case = f"{truth['name']}-{kind}" + (f"-{number + 1}" if number else "")
        folder = os.path.join(out, case)
        if os.path.exists(os.path.join(folder, "truth.json")):
            done.append((kind, None, False))
            continue
        if kind == "as-is":
            done.append((kind, as_is(truth, case, folder), True))
            continue
        try:
            done.append((kind, made_case(source, order_of(truth, kind, number), folder, case), True))
        except Exception as error:  # a fault of this script: counted with the others, so that it shows and the rest is made
            done.append((kind, f"{type(error).__name__}: {error} ({case})", True))
    return truth["name"], done
