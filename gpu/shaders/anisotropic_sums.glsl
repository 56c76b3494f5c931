// Sums over the corners of a vertex for anisotropic smoothing; the including shader defines REAL,
// VEC3 and edge_of(), and includes this text for both precisions.
struct AnisotropicSums {
    VEC3 way;      // cotangent-weighted sum of the neighbours minus the own value [mm]
    REAL weights;  // of it
    REAL mean, gauss;  // curvatures [1/mm, 1/mm^2]
    REAL area;     // [mm^2]
    REAL reach;    // sum of the edges' lengths [mm]
    bool thin;     // a triangle is so thin that single precision cannot measure it
};

AnisotropicSums anisotropic_sums(uint v, VEC3 zero) {
    VEC3 flow = zero, normal = zero;
    REAL angles = REAL(0.0);
    AnisotropicSums sums = AnisotropicSums(zero, REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), REAL(0.0), false);
    uint end = first_corner(v + 1u), last = no_vertex;
    VEC3 to_last = zero;
    for (uint i = first_corner(v); i < end; ++i) {
        uvec2 others = corner(i);
        VEC3 to_next = others.x == last ? to_last : edge_of(v, others.x, zero);
        last = others.y;
        to_last = edge_of(v, last, zero);
        add_triangle(to_next, to_last, sums.way, sums.weights);
        CornerShare share = corner_share(to_next, to_last);
        flow += share.flow;
        normal += share.normal;
        sums.area += share.area;
        if (share.across > REAL(0.0)) angles += angle_of(share.across, share.along);
        REAL squared = dot(to_next, to_next) + dot(to_last, to_last);
        sums.reach += sqrt(squared);
        sums.thin = sums.thin || !(share.across > REAL(0.05) * squared);
    }
    if (!(sums.area > REAL(0.0))) return sums;
    sums.mean = mean_of(flow, normal, sums.area);
    sums.gauss = (REAL(6.28318530717958647693lf) - angles) / sums.area;
    return sums;
}

// Meyer et al. 2003, section 6: fraction of the flow that a vertex keeps.
REAL flow_share(AnisotropicSums sums, REAL feature) {
    REAL spread = sqrt(max(REAL(0.0), sums.mean * sums.mean - sums.gauss));
    REAL one = sums.mean + spread, two = sums.mean - spread;
    if (abs(one) <= feature && abs(two) <= feature) return REAL(1.0);
    if (abs(one) > feature && abs(two) > feature && sums.gauss > REAL(0.0)) return REAL(0.0);
    REAL smallest = abs(one) < abs(two) ? one : two;
    if (abs(sums.mean) <= abs(smallest)) return REAL(1.0);
    return clamp(smallest / sums.mean, REAL(0.0), REAL(1.0));
}
