// Contribution of a triangle to the operators of Meyer et al. 2003 at its first corner; the
// including shader defines REAL and VEC3 as float and vec3, or as double and dvec3.
struct CornerShare {
    VEC3 flow;    // cot (v - u) over both other corners
    VEC3 normal;  // its length is twice the area
    REAL area;    // mixed area (Eq. 7 and Figure 4)
    REAL along, across;  // the corner's angle is atan(across, along)
};

CornerShare corner_share(VEC3 to_next, VEC3 to_last) {
    VEC3 opposite = to_last - to_next, normal = cross(to_next, to_last);
    REAL doubled = length(normal);
    if (!(doubled > REAL(0.0))) return CornerShare(VEC3(0.0), VEC3(0.0), REAL(0.0), REAL(1.0), REAL(0.0));
    REAL along = dot(to_next, to_last);
    REAL cot_next = -dot(to_next, opposite) / doubled;
    REAL cot_last = dot(to_last, opposite) / doubled;
    VEC3 flow = -cot_last * to_next - cot_next * to_last;
    REAL area;
    if (along < REAL(0.0))
        area = doubled / REAL(4.0);
    else if (cot_next < REAL(0.0) || cot_last < REAL(0.0))
        area = doubled / REAL(8.0);
    else
        area = (dot(to_next, to_next) * cot_last + dot(to_last, to_last) * cot_next) / REAL(8.0);
    return CornerShare(flow, normal, area, along, doubled);
}

// Mean curvature [1/mm] from the sums over a vertex's corners, positive where it is convex (Eq. 8).
REAL mean_of(VEC3 flow, VEC3 normal, REAL area) {
    REAL size = length(flow) / (REAL(4.0) * area);
    return dot(flow, normal) < REAL(0.0) ? -size : size;
}
