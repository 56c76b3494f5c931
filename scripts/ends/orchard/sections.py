"""Sections of a vessel by planes, and the way along it by sections."""
import dataclasses
import math

import numpy as np

from ends.orchard.model import outward, place, unit

STEP = 0.2      # of the way along a vessel, in diameters of the end where it begins
FURCATES = 1.6  # times the area of the sections before: two vessels are one


@dataclasses.dataclass
class Section:
    """A closed polygon and its measures."""
    polygon: np.ndarray  # [mm], #P x 3
    centre: np.ndarray   # of the area [mm]
    normal: np.ndarray   # by the right hand
    diameter: float      # of the circle of the same area [mm]
    elongation: float    # length beside width [-]


def measured(polygon):
    """The Section that a closed polygon [mm], #P x 3, is."""
    start = polygon.mean(axis=0)
    a, b = polygon - start, np.roll(polygon, -1, axis=0) - start
    parts = np.cross(a, b) / 2
    total = parts.sum(axis=0)
    normal, area = unit(total), max(np.linalg.norm(total), 1e-12)
    centre = start + ((a + b) / 3 * (parts @ normal)[:, None]).sum(axis=0) / area
    lengths = np.linalg.norm(b - a, axis=1)[:, None]
    middles = (a + b) / 2 + start - centre
    spread = np.sort(np.linalg.eigvalsh((middles * lengths).T @ middles))
    return Section(polygon, centre, normal, 2 * math.sqrt(area / math.pi), math.sqrt(spread[2] / max(spread[1], 1e-12)))


def sections(points, triangles, origin, normal, reach=math.inf):
    """Closed polygons in which a plane cuts the surface within reach [mm] of the origin, as Sections."""
    height = (points - origin) @ normal
    height[height == 0] = 1e-9
    above = height > 0
    corners = above[triangles]
    cut = corners.any(axis=1) & ~corners.all(axis=1)
    if reach < math.inf:
        cut[cut] = (np.linalg.norm(points[triangles[cut]] - origin, axis=2) < reach).all(axis=1)
    following, where = {}, {}
    for tri in triangles[cut].tolist():
        for a, b in ((tri[0], tri[1]), (tri[1], tri[2]), (tri[2], tri[0])):
            if above[a] != above[b]:
                edge = (min(a, b), max(a, b))
                if edge not in where:
                    where[edge] = points[a] + (points[b] - points[a]) * height[a] / (height[a] - height[b])
                if above[a]:
                    start = edge
                else:
                    end = edge
        following[end] = start  # seen from above, counter-clockwise
    found = []
    while following:
        first, edge = following.popitem()
        chain = [first]
        while edge != first and edge in following:
            chain.append(edge)
            edge = following.pop(edge)
        if edge == first and len(chain) > 4:
            found.append(measured(np.array([where[e] for e in chain])))
    return found


def nearest(found, origin, within):
    """That of the Sections whose centre is nearest to the origin and within so many mm; None: there is none."""
    found = [s for s in found if np.linalg.norm(s.centre - origin) < within]
    return min(found, key=lambda s: np.linalg.norm(s.centre - origin), default=None)


def march(model, index, longest):
    """Sections from an open end inward, to the furcation or as far as asked (in diameters).
    Returns their centres [mm], #S x 3, their diameters [mm], and whether a furcation was met."""
    end = model.ends[index]
    width, direction = end["diameter_mm"], -outward(end)
    at, path, widths = place(end), [place(end)], [width]
    for _ in range(int(longest / STEP)):
        guess = at + STEP * width * direction
        found = sections(model.points, model.triangles, guess, direction, 6 * width)
        found = nearest(found, guess, 1.0 * width)
        if found is None or found.diameter ** 2 > FURCATES * np.median(widths[-6:]) ** 2:
            return np.array(path), np.array(widths), len(path) > 2
        path.append(found.centre)
        widths.append(found.diameter)
        step = found.centre - path[-min(4, len(path))]
        if step @ direction < 0:
            break
        direction, at = unit(0.5 * direction + 0.5 * unit(step)), found.centre
    return np.array(path), np.array(widths), False


def fine_path(path, step):
    """A path [mm], #P x 3, smoothed, as points at equal steps [mm]. Returns them and the lengths along it [mm]."""
    path = path.copy()
    for _ in range(3):
        path[1:-1] = (path[:-2] + 2 * path[1:-1] + path[2:]) / 4
    at = np.append(0, np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1)))
    lengths = np.arange(0, at[-1], step)
    return np.column_stack([np.interp(lengths, at, path[:, i]) for i in range(3)]), lengths
