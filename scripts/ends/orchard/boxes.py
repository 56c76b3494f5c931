"""The kinds of cases that vessels leave through faces of the image: box-mask and box-image."""
import copy
import dataclasses

import numpy as np

from ends.orchard.images import NARROW, across_end, coarsened, ends_on_piece, spacing_for, widest_as_inlets
from ends.orchard.model import Unfit, place, rounded
from ends.orchard.sections import nearest, sections
from ends.orchard.voxels import Grid, largest_piece, stencilled


@dataclasses.dataclass
class Box:
    """What the image shows."""
    low: np.ndarray   # corner [mm]
    high: np.ndarray  # corner [mm]
    faces: list       # (axis, 0 low or 1 high) of those that cut the model


def random_box(model, spacing, rng):
    """A Box of whole voxels, one to three faces of which cut the model."""
    lo, hi = model.points.min(axis=0), model.points.max(axis=0)
    low, high = lo - rng.uniform(3, 6, 3) * spacing, hi + rng.uniform(3, 6, 3) * spacing
    faces = [divmod(int(f), 2) for f in rng.permutation(6)[:rng.integers(1, 4)]]
    for axis, side in faces:
        part = rng.uniform(0.12, 0.45) * (hi - lo)[axis]
        if side:
            high[axis] = hi[axis] - part
        else:
            low[axis] = lo[axis] + part
    count = np.floor((high - low) / spacing)
    if (count < 8).any():
        raise Unfit("the box is too small")
    return Box(low, low + count * spacing, faces)


def end_at(cut, normal, model, spacing):
    """The end where a vessel leaves through a face, by its Section there; optional where it is narrow or grazes the face."""
    deeper = cut.centre - 0.5 * cut.diameter * normal
    inner = nearest(sections(model.points, model.triangles, deeper, normal, 4 * cut.diameter), deeper, 1.2 * cut.diameter)
    grazes = cut.elongation > 2.5 or inner is None
    optional = grazes or cut.diameter < NARROW * across_end(normal, spacing)
    return {"place_mm": rounded(cut.centre), "diameter_mm": round(cut.diameter, 4), "role": "optional" if optional else "open",
            "outward": normal.tolist(), "note": "leaves through a face" + (", grazing it" if grazes else "")}


def new_ends(model, box, spacing):
    """Ends where vessels leave through faces of the box. Unfit if one leaves through an edge, or two are at one place."""
    made = []
    for axis, side in box.faces:
        normal = np.zeros(3)
        normal[axis] = 1.0 if side else -1.0
        others = [i for i in range(3) if i != axis]
        cuts = sections(model.points, model.triangles, box.high if side else box.low, normal)
        if len(cuts) > 40:
            raise Unfit("too few or too many vessels leave the box")
        for cut in cuts:
            within = ((cut.polygon >= box.low) & (cut.polygon <= box.high))[:, others].all(axis=1)
            if not within.any():
                continue
            if not within.all():
                raise Unfit("a vessel leaves through an edge of the box")
            made.append(end_at(cut, normal, model, spacing))
    for i, a in enumerate(made):
        if any(np.linalg.norm(place(a) - place(b)) < 0.75 * max(a["diameter_mm"], b["diameter_mm"]) for b in made[:i]):
            raise Unfit("a vessel leaves twice at one place")
    return made


def kept_ends(model, box):
    """Ends of the model inside the box. Unfit if one is so close to a face that a cut there would be another end or the same."""
    kept = []
    for end in model.ends:
        gaps = np.concatenate([place(end) - box.low, box.high - place(end)])
        near = (0.8 if end["role"] == "closed" else 0.75) * end["diameter_mm"]
        if gaps.min() > 0 and (gaps[[a + 3 * s for a, s in box.faces]] > near).all():
            kept.append(end)
        elif gaps.min() > -near:
            raise Unfit("a face of the box is close to an end")
    return kept


def with_inlets(made, kept, before):
    """The ends that were kept and made. Where all inlets of those before are left they are the inlets, else the widest are."""
    ends = copy.deepcopy(kept) + made
    left = sum(e["role"] == "inlet" for e in kept)
    all_left = left and left == sum(e["role"] == "inlet" for e in before)
    return ends if all_left else widest_as_inlets(ends)


def boxed_once(model, spacing, rng, order):
    """As boxed, of one random box; Unfit if that is no case."""
    box = random_box(model, spacing, rng)
    kept = kept_ends(model, box)
    made = new_ends(model, box, spacing)
    if not 1 <= len(made) <= (4 if order.lists_all else 8):
        raise Unfit("too few or too many vessels leave the box")
    grid = Grid(box.low, spacing, np.round((box.high - box.low) / spacing).astype(int))
    piece = largest_piece(stencilled(model.points, model.triangles, grid))
    ends = ends_on_piece(with_inlets(made, kept, model.ends), piece, grid, order.fewest_ends)
    if not any("face" in e.get("note", "") and e["role"] != "optional" for e in ends):
        raise Unfit("no vessel of the piece leaves the box")
    return piece, grid, ends


def boxed(model, rng, order):
    """A part of the model in a box that vessels leave. Returns the mask of its largest piece, the grid and the ends."""
    spacing = spacing_for(model, rng, rng.uniform(5, 11), rng.uniform(2, 4) if rng.random() < 0.25 else 1.0)
    if order.voxel_mm:
        spacing *= max(1.0, order.voxel_mm / spacing.min())
    spacing = coarsened(spacing, 0.7 * np.ptp(model.points, axis=0))
    reason = None
    for _ in range(30):
        try:
            return boxed_once(model, spacing, rng, order)
        except Unfit as why:
            reason = why
    raise reason
