"""Rims of ends, and cuts that make them."""
import dataclasses
import math

import numpy as np

from ends.orchard.meshes import compact, connected, edge_near, loops
from ends.orchard.model import Model, Unfit, outward, place, unit, with_end
from ends.orchard.sections import measured


# --- rims ------------------------------------------------------------------------------------------------------------
def rims(model):
    """The rim of each end that has one: index of the end to the rim's vertices in order. The nearest pairs first."""
    found = loops(model.triangles)
    middles = [measured(model.points[loop]) for loop in found]
    pairs = sorted((np.linalg.norm(place(end) - m.centre) / max(end["diameter_mm"], m.diameter), i, j)
                   for i, end in enumerate(model.ends) for j, m in enumerate(middles) if end["role"] != "closed")
    of = {}
    for distance, i, j in pairs:
        if distance < 0.8 and i not in of and j not in of.values():
            of[i] = j
    return {i: found[j] for i, j in of.items()}


def as_rim(ends, index, points, loop):
    """The ends, one of them as its rim has it; the loop is of vertices among the points."""
    rim = measured(points[loop])
    return with_end(ends, index, place_mm=rim.centre, diameter_mm=round(rim.diameter, 4), outward=-rim.normal)


def remeasured(model):
    """The model, each end that has a rim as the rim has it."""
    ends = model.ends
    for index, loop in rims(model).items():
        ends = as_rim(ends, index, model.points, loop)
    return dataclasses.replace(model, ends=ends)


# --- cuts ------------------------------------------------------------------------------------------------------------
def snapped(model, height, gone, direction, tolerance):
    """Vertices close to a plane put on it, or its cut would leave slivers.
    `height` [mm] above the plane, whose normal is `direction`, is changed with them; `gone`: which vertices the cut takes.
    Returns points [mm] and what is gone now."""
    border = gone.copy()
    border[model.triangles[gone[model.triangles].any(axis=1)]] = True
    close = border & (abs(height) < tolerance)
    points = model.points.copy()
    points[close] -= height[close, None] * direction
    height[close] = 0
    return points, gone & ~close


def split(points, triangles, height, gone):
    """Without the vertices that are gone; triangles at their border are cut at height 0.
    Returns points, of which some are unused, triangles, and which points are on the cut."""
    count = gone[triangles].sum(axis=1)
    kept, added, new = triangles[count == 0].tolist(), [], {}

    def crossing(stays, goes):
        if height[stays] == 0:
            return stays
        if (stays, goes) not in new:
            new[stays, goes] = len(points) + len(added)
            part = height[stays] / (height[stays] - height[goes])
            added.append(points[stays] + part * (points[goes] - points[stays]))
        return new[stays, goes]

    for tri in triangles[(count == 1) | (count == 2)].tolist():
        lone = next(i for i in range(3) if gone[tri[i]] != gone[tri[i - 1]] and gone[tri[i]] != gone[tri[i - 2]])
        a, b, c = tri[lone], tri[(lone + 1) % 3], tri[(lone + 2) % 3]
        if gone[a]:
            p, q = crossing(b, a), crossing(c, a)
            pieces = ((p, b, c), (p, c, q))
        else:
            pieces = ((a, crossing(a, b), crossing(a, c)),)
        kept += [piece for piece in pieces if len(set(piece)) == 3]
    all_points = np.vstack([points, added]) if added else points
    return all_points, np.array(kept), np.append(height == 0, np.ones(len(added), bool))


def nearest_loop(points, found, origin, within):
    """That of the loops whose middle is nearest to the origin; Unfit if that is farther than so many mm, or there is none."""
    def gap(loop):
        return np.linalg.norm(points[loop].mean(axis=0) - origin)

    best = min(found, key=gap, default=None)
    if best is None or gap(best) > within:
        raise Unfit("the cut leaves no rim")
    return best


def clipped(model, index, origin, direction, reach):
    """What is beyond the plane through the origin and hangs at this end cut off. Unfit if it goes farther than reach [mm] from
    the origin. Returns the model, the end measured, and the new rim's vertices."""
    end, width = model.ends[index], model.ends[index]["diameter_mm"]
    height = (model.points - origin) @ direction
    seeds = rims(model).get(index)
    if seeds is None:
        seeds = np.array([np.linalg.norm(model.points - place(end), axis=1).argmin()])
    beyond = height > 0
    if not beyond[seeds].any():
        raise Unfit("the cut misses the end")
    gone = connected(model.triangles, beyond, seeds)
    if np.linalg.norm(model.points[gone] - origin, axis=1).max() > reach:
        raise Unfit("the cut takes more than the end")
    edge = edge_near(model.points, model.triangles, origin, width)
    points, gone = snapped(model, height, gone, direction, 0.2 * edge)
    points, triangles, on_cut = split(points, model.triangles, height, gone)
    found = [loop for loop in loops(triangles)
             if on_cut[loop].mean() > 0.4 and abs((points[loop] - origin) @ direction).max() < 1.5 * width]
    rim = nearest_loop(points, found, origin, max(reach / 2, width))
    ends = as_rim(model.ends, index, points, rim)
    return Model(*compact(points, triangles), ends), np.searchsorted(np.unique(triangles), rim)


def cut_end(model, index, depth, tilt, rng):
    """An end cut back by a depth (in diameters), the plane tilted [deg] about a random axis.
    Returns the model, the end measured, and the new rim's vertices."""
    end = model.ends[index]
    width, axis = end["diameter_mm"], outward(end)
    across = unit(np.cross(axis, rng.normal(size=3)))
    direction = math.cos(math.radians(tilt)) * axis + math.sin(math.radians(tilt)) * across
    depth = depth + 0.5 * math.tan(math.radians(tilt))  # so that the plane passes below the whole rim
    return clipped(model, index, place(end) - depth * width * axis, direction, (2.2 + depth) * width)


def oblique_open(model, rng, order):
    """All ends cut obliquely. Returns the model and the number of open ends."""
    found = sorted(rims(model))
    for index in found:
        model, _ = cut_end(model, index, 0.05, rng.uniform(20, 50), rng)
    return model, len(found)
