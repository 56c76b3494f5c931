"""The kinds of cases on a grid around the whole vessel, mask and image, and what they share with those in a box."""
import copy
import zlib

import numpy as np

from ends.orchard.model import Unfit, flows, outward, place
from ends.orchard.voxels import VOXELS, Grid, blurred, largest_piece, stencilled

VESSEL, BACKGROUND = 300, 75  # intensities; the background varies by 25
THRESHOLD = 187  # halfway from the background's mean to the vessel
NARROW = 2.5     # voxels across a vessel below which its end need not be open
ACCEPTED = 0.8   # of the widest end's diameter: may be the inlet where the flow is not known


# --- grids -----------------------------------------------------------------------------------------------------------
def across_end(direction, spacing):
    """The largest voxel edge [mm] that lies across a direction."""
    return float((spacing * np.sqrt(np.maximum(0, 1 - direction ** 2))).max())


def spacing_for(model, rng, voxels, thick):
    """Voxel edges [mm]: so many across the median end, one edge longer by the factor `thick`."""
    flowing = [e["diameter_mm"] for e in model.ends if flows(e)]
    spacing = np.full(3, float(np.median(flowing)) / voxels)
    spacing[rng.integers(3) if rng.random() < 0.3 else 2] *= thick
    return spacing


def coarsened(spacing, size):
    """Voxel edges [mm] so large that a grid of this size [mm] has not too many voxels."""
    return spacing * max(1.0, (np.prod(size / spacing) / VOXELS) ** (1 / 3))


# --- ends ------------------------------------------------------------------------------------------------------------
def is_on(end, middles, spacing):
    """Whether an end is on a piece that has these middles of voxels [mm]."""
    gap = np.linalg.norm(middles - place(end), axis=1).min()
    return gap < max(0.6 * end["diameter_mm"], 1.2 * spacing.max())


def piece_ends(ends, piece, grid, fewest):
    """Ends that are on the piece, those too narrow for its voxels optional. Unfit if an inlet is lost, or if there are fewer
    flowing ones than asked for."""
    kept, middles = [], grid.middles(piece)
    for end in ends:
        if not is_on(end, middles, grid.spacing):
            if end["role"] == "inlet":
                raise Unfit("the voxels lose an inlet")
            continue
        end = copy.deepcopy(end)
        if end["role"] == "open" and end["diameter_mm"] < NARROW * across_end(outward(end), grid.spacing):
            end["role"] = "optional"
        kept.append(end)
    if not any(e["role"] == "inlet" for e in kept) or sum(map(flows, kept)) < fewest:
        raise Unfit("too few ends are left")
    return kept


def widest_as_inlets(ends):
    """A copy of the ends, where every flowing one of at least ACCEPTED of the widest's diameter is an inlet."""
    ends = copy.deepcopy(ends)
    widest = max([e["diameter_mm"] for e in ends if flows(e)], default=0.0)
    for end in ends:
        if end["role"] == "open" and end["diameter_mm"] >= ACCEPTED * widest:
            end["role"] = "inlet"
    return ends


def ends_on_piece(ends, piece, grid, fewest):
    """As piece_ends, but the inlet may be on another piece: then the widest ends are inlets."""
    middles = grid.middles(piece)
    found = [end for end in ends if is_on(end, middles, grid.spacing)]
    if not any(e["role"] == "inlet" for e in found):
        found = widest_as_inlets(found)
    return piece_ends(found, piece, grid, fewest)


# --- voxels ----------------------------------------------------------------------------------------------------------
def intensities(model, piece, grid, rng):
    """A bright vessel with partial volumes, blur and noise, on a background that varies slowly. `piece`: the mask that shows.
    Returns the image and the mask of the vessel above the threshold."""
    x, y, z = grid.dims
    fine = stencilled(model.points, model.triangles, Grid(grid.low, grid.spacing / 2, grid.dims * 2)).astype(np.float32)
    part = fine.reshape(z, 2, y, 2, x, 2).mean(axis=(1, 3, 5))
    part *= blurred(piece.astype(np.float32), 0.8) > 1e-3  # fragments beside the piece would be other vessels
    part = blurred(part, rng.uniform(0.6, 1.0))
    z, y, x = np.meshgrid(*(np.linspace(0, 1, n) for n in piece.shape), indexing="ij", sparse=True)
    a, b, c = rng.uniform(2, 5, 3)
    ground = BACKGROUND + 25 * np.sin(a * x + b * y + c * z + rng.uniform(0, 6))
    image = ground + (VESSEL - ground) * part + rng.normal(scale=rng.uniform(8, 16), size=piece.shape)
    # What is too thin for the blur parts the vessel, and a threshold finds the largest piece only.
    return np.round(image).astype(np.int16), largest_piece(ground + (VESSEL - ground) * part > THRESHOLD)


def voxelised(model, rng, order):
    """The whole model on a grid. Returns the mask of its largest piece, the grid and the ends."""
    draw = order.number + zlib.crc32(order.source.encode())
    thick = rng.uniform(2, 6) if draw // 3 % 3 == 2 and not order.image else 1.0
    spacing = spacing_for(model, rng, 8 if order.image else (4, 7, 12)[draw % 3], thick)
    if order.voxel_mm:  # a mask again: coarser than it was
        spacing *= max(1.0, 1.3 * order.voxel_mm / spacing.min())
    spacing = coarsened(spacing, np.ptp(model.points, axis=0))
    low = model.points.min(axis=0) - rng.uniform(3, 6, 3) * spacing
    dims = np.ceil((np.ptp(model.points, axis=0) + 9 * spacing) / spacing).astype(int)
    grid = Grid(low, spacing, dims)
    piece = largest_piece(stencilled(model.points, model.triangles, grid))
    return piece, grid, piece_ends(model.ends, piece, grid, order.fewest_ends)
