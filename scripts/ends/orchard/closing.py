"""Caps on rims, and the kinds of cases with closed ends: closed-*, mixed-closed, stub."""
import dataclasses
import math

import numpy as np

from ends.cases import STUB
from ends.orchard.clipping import clipped, cut_end, rims
from ends.orchard.meshes import edge_near, loops, normals
from ends.orchard.model import Model, Unfit, unit, with_end
from ends.orchard.sections import STEP, march, measured


# --- caps ------------------------------------------------------------------------------------------------------------
def along(polygon):
    """Where the points of a closed polygon are along it, from 0 at the first to 1 back at it, and its length [mm]."""
    lengths = np.linalg.norm(np.roll(polygon, -1, axis=0) - polygon, axis=1)
    return np.append(0, np.cumsum(lengths)) / lengths.sum(), lengths.sum()


def strip(outer, outer_at, inner, inner_at):
    """Triangles between two rings of vertices, whose positions along the ring are given in [0, 1)."""
    outer_at, inner_at = np.append(outer_at, 1.0), np.append(inner_at, 1.0 + inner_at[0])
    i, j, made = 0, 0, []
    while i < len(outer) or j < len(inner):
        a, b = outer[i % len(outer)], inner[j % len(inner)]
        if j == len(inner) or (i < len(outer) and outer_at[i + 1] <= inner_at[j + 1]):
            made.append((outer[(i + 1) % len(outer)], a, b))
            i += 1
        else:
            made.append((a, b, inner[(j + 1) % len(inner)]))
            j += 1
    return made


def capped(model, loop, rise=0.0, bumps=None):
    """A rim closed by rings of triangles about as large as the surface's. `rise` [mm]: of the cap's middle, a half ellipsoid;
    `bumps`: heights [mm] of places in the rim's plane, also by how far inward they are, 0 to 1.
    Returns the model, its ends unchanged, and the cap's middle. Unfit if the cap folds."""
    polygon = model.points[loop]
    rim = measured(polygon)
    normal = -rim.normal
    at, length = along(polygon)
    edge = max(edge_near(model.points, model.triangles, rim.centre, rim.diameter), rim.diameter / 24)
    closed = np.vstack([polygon, polygon[:1]])
    count = max(2, round((rim.diameter / 2 + 0.57 * rise) / (0.87 * edge)))
    added, made, outer, outer_at = [], [], list(loop), at[:-1]
    for k in range(1, count):
        angle = k / count * math.pi / 2
        shrink, height = (math.cos(angle), rise * math.sin(angle)) if rise else (1 - k / count, 0.0)
        number = max(6, round(length * shrink / edge))
        inner_at = (np.arange(number) + 0.5 * (k % 2)) / number
        ring = np.column_stack([np.interp(inner_at, at, closed[:, i]) for i in range(3)])
        ring = rim.centre + shrink * (ring - rim.centre)
        ring += (height + bumps(ring, 1 - shrink))[:, None] * normal if bumps else height * normal
        inner = [len(model.points) + len(added) + i for i in range(number)]
        made += strip(outer, outer_at, inner, inner_at)
        added += list(ring)
        outer, outer_at = inner, inner_at
    middle = rim.centre + (rise + (bumps(rim.centre[None], 1.0)[0] if bumps else 0.0)) * normal
    made += [(outer[(i + 1) % len(outer)], outer[i], len(model.points) + len(added)) for i in range(len(outer))]
    points, made = np.vstack([model.points, added, [middle]]), np.array(made)
    facing = normals(points, made) @ normal
    if not bumps and facing[facing < 0].sum() < -0.02 * facing.sum():
        raise Unfit("a cap folds")
    return Model(points, np.vstack([model.triangles, made]), model.ends), middle


def all_capped(model):
    """Every rim closed flat; of ends nothing changes."""
    for loop in loops(model.triangles):
        model, _ = capped(model, loop)
    return model


def cap_end(model, index, loop, way, rng):
    """An end's rim closed "flat", "domed" or "ragged"; the end's place is then on the cap, or in a ragged one's plane."""
    rim = measured(model.points[loop])
    rise = rng.uniform(0.3, 1.0) * rim.diameter / 2 if way == "domed" else 0.0
    waves = [(rng.normal(size=3) * 2 * math.pi / (rng.uniform(0.3, 0.8) * rim.diameter), rng.uniform(0, 6.3)) for _ in range(5)]
    size = rng.uniform(0.1, 0.25) * rim.diameter

    def bumps(where, inward):
        waving = sum(np.sin(where @ k + phase) for k, phase in waves) / math.sqrt(len(waves))
        frayed = rng.normal(scale=0.35, size=len(where))
        return size * np.minimum(1, 3 * inward) * (0.7 * waving + frayed)

    model, middle = capped(model, loop, rise, bumps if way == "ragged" else None)
    if way == "ragged":
        middle = rim.centre
    return dataclasses.replace(model, ends=with_end(model.ends, index, place_mm=middle))


# --- kinds: each returns a model and the number of its ends that are open ----------------------------------------------
def closed(model, way, rng, depth=(0.1, 0.3), tilt=(0, 0)):
    """The model with all ends cut, in ranges of depth [diameters] and tilt [deg], and capped in a way (see cap_end)."""
    for index in rims(model):
        model, loop = cut_end(model, index, rng.uniform(*depth), rng.uniform(*tilt), rng)
        model = cap_end(model, index, loop, way, rng)
    return model


def closed_flat(model, rng, order):
    return closed(model, "flat", rng), 0


def closed_domed(model, rng, order):
    return closed(model, "domed", rng), 0


def closed_ragged(model, rng, order):
    return closed(model, "ragged", rng), 0


def closed_oblique(model, rng, order):
    return closed(model, "flat", rng, depth=(0.05, 0.1), tilt=(20, 50)), 0


def mixed_closed(model, rng, order):
    """Some ends closed flat, the others open."""
    open_ones = sorted(rims(model))
    if len(open_ones) < 2:
        raise Unfit("too few ends")
    chosen = rng.permutation(open_ones)[:rng.integers(1, len(open_ones))]
    for index in chosen:
        model, loop = cut_end(model, index, rng.uniform(0.1, 0.3), 0, rng)
        model = cap_end(model, index, loop, "flat", rng)
    return model, len(open_ones) - len(chosen)


def stub(model, rng, order):
    """A branch cut off beside its furcation, and what is left of it closed by a dome."""
    found = rims(model)
    branches = [i for i in found if model.ends[i]["role"] == "open"]
    if len(found) < 3 or not branches:
        raise Unfit("no branch to cut off")
    index = int(rng.choice(branches))
    path, widths, furcates = march(model, index, 14)
    width = float(np.median(widths[-4:]))
    back = int(round(rng.uniform(0.2, 0.8) * width / (STEP * model.ends[index]["diameter_mm"])))
    last = len(path) - 1 - back
    if not furcates or last < 3:
        raise Unfit("no furcation found")
    direction = unit(path[last - 2] - path[last])
    reach = 1.5 * np.linalg.norm(path[:last + 1] - path[last], axis=1).max() + 2 * width
    ends = with_end(model.ends, index, diameter_mm=width)
    model, loop = clipped(dataclasses.replace(model, ends=ends), index, path[last], direction, reach)
    if not 0.5 < model.ends[index]["diameter_mm"] / width < 1.6:
        raise Unfit("the stub is no tube")
    model = cap_end(model, index, loop, "domed", rng)
    ends = with_end(model.ends, index, role="closed", note=STUB, branch_mm=None)
    return dataclasses.replace(model, ends=ends), len(found) - 1
