"""The kind "not-widest": an outlet that is wider than the inlet, by dilation of its vessel or narrowing of the inlet's."""
import dataclasses

import numpy as np

from ends.orchard.checks import check_widened
from ends.orchard.clipping import cut_end, remeasured, rims
from ends.orchard.closing import cap_end
from ends.orchard.meshes import connected
from ends.orchard.model import Unfit
from ends.orchard.sections import STEP, fine_path, march


def widened(model, index, factor, reach):
    """An end's vessel scaled about its axis, by 1 `reach` diameters inside and by the factor at the rim."""
    width = model.ends[index]["diameter_mm"]
    path, widths, _ = march(model, index, reach)
    at_least = 1.5 if factor > 1 else 1.0
    if (len(path) - 1) * STEP < at_least:
        raise Unfit("the vessel is too short to be widened")
    path, lengths = fine_path(path, 0.05 * width)
    gaps = np.linalg.norm(model.points[:, None] - path[None, ::4], axis=2)
    close = gaps.argmin(axis=1) * 4
    inside = (gaps.min(axis=1) < 0.75 * widths.max()) & (close < len(path) - 5)
    part = connected(model.triangles, inside, rims(model)[index])
    if not part.any():
        raise Unfit("the vessel is too short to be widened")
    exact = np.linalg.norm(model.points[part][:, None] - path[None], axis=2).argmin(axis=1)
    to_rim = np.clip(1 - lengths[exact] / lengths[-5], 0, 1)  # 0 at the path's inner end, 1 at the rim
    scale = 1 + (factor - 1) * to_rim ** 2 * (3 - 2 * to_rim)
    points = model.points.copy()
    tangents = np.gradient(path, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    off = points[part] - path[exact]
    off -= (off * tangents[exact]).sum(axis=1)[:, None] * tangents[exact]
    points[part] += (scale - 1)[:, None] * off
    check_widened(model, points, part, width)
    return remeasured(dataclasses.replace(model, points=points))


def inlet_of(model):
    """Index of the first inlet."""
    return next(i for i, end in enumerate(model.ends) if end["role"] == "inlet")


def wider_outlet(model, narrows, outlets, rng):
    """The model with the inlet narrowed or an outlet dilated; `outlets`: the inlet's diameter beside that of each, by index."""
    inlet = inlet_of(model)
    if narrows:
        widest = 1 / min(outlets.values())
        if widest < 0.64:
            raise Unfit("no outlet is wide enough beside a narrowed inlet")
        return widened(model, inlet, rng.uniform(0.6, min(0.85, 0.95 * widest)), rng.uniform(2, 4))
    likely = [i for i, ratio in outlets.items() if ratio < 2.4] or [min(outlets, key=outlets.get)]
    index = int(rng.choice(likely))
    return widened(model, index, rng.uniform(1.1, 1.5) * outlets[index], 4)


def not_widest(model, rng, order):
    """An outlet made wider than the inlet, then perhaps all ends closed. Returns the model and the number of open ends."""
    found, inlet = rims(model), inlet_of(model)
    outlets = {i: model.ends[inlet]["diameter_mm"] / model.ends[i]["diameter_mm"]
               for i in found if model.ends[i]["role"] == "open"}
    if inlet not in found or not outlets:
        raise Unfit("no inlet and outlet with rims")
    model = wider_outlet(model, order.narrows, outlets, rng)
    if max(model.ends[i]["diameter_mm"] for i in found) < 1.04 * model.ends[inlet]["diameter_mm"]:
        raise Unfit("the inlet is still the widest")
    if not order.closes:
        return model, len(found)
    way = ("flat", "domed", "ragged")[rng.integers(3)]
    for index in found:
        model, loop = cut_end(model, index, rng.uniform(0.05, 0.15), 0, rng)
        model = cap_end(model, index, loop, way, rng)
    if max(model.ends[i]["diameter_mm"] for i in found) <= model.ends[inlet]["diameter_mm"]:
        raise Unfit("the inlet is still the widest")
    return model, 0
