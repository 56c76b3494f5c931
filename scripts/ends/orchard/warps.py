"""The kinds of cases with all rims open and the surface changed: torn, decimated, noisy, turned, and scaled.
Each takes a model and random numbers, and returns a model and the number of its ends that are open."""
import math

import numpy as np

from ends.orchard.clipping import remeasured, rims
from ends.orchard.meshes import compact, from_vtk, largest_region, lighter, rim_edges, thickness, through, to_vtk
from ends.orchard.model import Model, Unfit, outward, place, unit, with_end


def unchanged(model, rng, order):
    """For "scaled", whose file is in another unit."""
    return model, len(rims(model))


def decimated(model, rng, order):
    count = int(rng.uniform(0.15, 0.5) * len(model.triangles))
    made = Model(*lighter(model.points, model.triangles, max(count, 300)), model.ends)
    return remeasured(made), len(rims(model))


def noisy(model, rng, order):
    """Noise of a few hundredths of the vessel's thickness on all vertices."""
    across = np.minimum(thickness(model.points, model.triangles), max(e["diameter_mm"] for e in model.ends))
    noise = np.clip(rng.normal(size=model.points.shape), -2, 2) * (rng.uniform(0.02, 0.05) * across / math.sqrt(3))[:, None]
    return remeasured(Model(model.points + noise, model.triangles, model.ends)), len(rims(model))


def turned(model, rng, order):
    """A random rotation about the middle of all vertices."""
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    turn = q * np.sign(np.diag(r))
    turn[:, 0] *= np.linalg.det(turn)
    middle, ends = model.points.mean(axis=0), model.ends
    for i, end in enumerate(model.ends):
        ends = with_end(ends, i, place_mm=turn @ (place(end) - middle) + middle, outward=turn @ outward(end))
    return Model((model.points - middle) @ turn.T + middle, model.triangles, ends), len(rims(model))


# --- torn ------------------------------------------------------------------------------------------------------------
def tidied(points, triangles):
    """The largest piece without triangles that hang at a vertex only. Unfit if its rims go on touching themselves."""
    for _ in range(30):
        points, triangles = compact(*from_vtk(through(to_vtk(points, triangles), largest_region())))
        twice = np.bincount(rim_edges(triangles)[:, 0], minlength=len(points)) > 1
        bad = twice[triangles].any(axis=1)
        if not bad.any():
            return points, triangles
        triangles = triangles[~bad]
    raise Unfit("a torn rim touches itself")


def from_rim(places, end, rim):
    """Distances [mm] of places to the vertices of an end's rim, inf where the end is far."""
    gaps = np.full(len(places), np.inf)
    near = np.linalg.norm(places - place(end), axis=1) < 1.5 * end["diameter_mm"]
    gaps[near] = np.linalg.norm(places[near][:, None] - rim[None], axis=2).min(axis=1)
    return gaps


def torn(model, rng, order):
    """Notches: how deep depends on the angle about the vessel; between them single triangles are missing."""
    found = rims(model)
    gone = np.zeros(len(model.triangles), bool)
    middles = model.points[model.triangles].mean(axis=1)
    for index, loop in found.items():
        end = model.ends[index]
        axis = outward(end)
        side = unit(np.cross(axis, rng.normal(size=3)))
        way = middles - place(end)
        angle = np.arctan2(way @ np.cross(axis, side), way @ side)
        deep = np.zeros(len(middles))
        for _ in range(rng.integers(2, 5)):
            off = abs((angle - rng.uniform(-math.pi, math.pi) + math.pi) % (2 * math.pi) - math.pi)
            half = rng.uniform(0.15, 0.6)
            depth = rng.uniform(0.1, 0.3) * end["diameter_mm"]
            deep = np.maximum(deep, depth * np.clip(1.5 * (1 - off / half), 0, 1))
        touching = np.isin(model.triangles, loop).any(axis=1)
        gone |= (from_rim(middles, end, model.points[loop]) < deep) | touching & (rng.random(len(middles)) < 0.25)
    return Model(*tidied(model.points, model.triangles[~gone]), model.ends), len(found)
