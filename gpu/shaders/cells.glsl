// Equal cells over the surface, x fastest (smoothing/context/point_grid.h), holding the sources.
layout(location = 2) uniform dvec3 origin;
layout(location = 3) uniform double per_length;  // cells per length [1/mm]
layout(location = 4) uniform ivec3 cells;        // along each axis

int cell_along(double at, int axis) { return int(clamp(at, 0.0lf, double(cells[axis] - 1))); }

uint first_in_row(int y, int z) { return uint(z * cells.y + y) * uint(cells.x); }

uint cell_of(dvec3 p) {
    dvec3 at = (p - origin) * per_length;
    return first_in_row(cell_along(at.y, 1), cell_along(at.z, 2)) + uint(cell_along(at.x, 0));
}
