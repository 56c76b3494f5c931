"""What made surfaces must be."""
import numpy as np

from ends.cases import STUB
from ends.orchard.meshes import connected, half_edges, loops, manifold, normals
from ends.orchard.model import Unfit, flows, place


def problem(model, open_ends):
    """Why a made surface with so many open ends is no case, or None."""
    if not np.isfinite(model.points).all() or not manifold(model.triangles):
        return "not manifold"
    if len(loops(model.triangles)) != open_ends:
        return "other rims than open ends"
    for end in model.ends:
        if np.linalg.norm(model.points - place(end), axis=1).min() > end["diameter_mm"]:
            return "an end is off the surface"
    sacs = [end for end in model.ends if end["role"] == "closed" and end.get("note") != STUB]
    for end in filter(flows, model.ends):
        if any(np.linalg.norm(place(end) - place(sac)) < 0.3 * end["diameter_mm"] for sac in sacs):
            return "a sac is cut"
    return None


def check_widened(model, points, part, width):
    """Unfit if what is widened folds, tears, or runs into other vessels. `points` [mm]: the new ones of the model; `part`:
    which of them were moved, #V booleans; `width` [mm]: of the vessel before."""
    before, after = normals(model.points, model.triangles), normals(points, model.triangles)
    moved = part[model.triangles].any(axis=1)
    if ((before * after).sum(axis=1)[moved] < 0).mean() > 0.003:
        raise Unfit("the widened vessel folds")
    edges = half_edges(model.triangles[moved])
    growth = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1) / np.maximum(
        np.linalg.norm(model.points[edges[:, 0]] - model.points[edges[:, 1]], axis=1), 1e-9)
    if growth.max() > 5:
        raise Unfit("the widened vessel tears")
    near = np.linalg.norm(points - points[part].mean(axis=0), axis=1) < 8 * width
    beside = points[near & ~connected(model.triangles, near, np.flatnonzero(part))]  # near, but far along the surface
    if len(beside) and len(beside) * part.sum() < 2e7:
        if np.linalg.norm(points[part][:, None] - beside[None], axis=2).min() < 0.1 * width:
            raise Unfit("the widened vessel meets another")
