// Cotangent-weighted mean of the neighbours minus the own value (smoothing/filters/cotangents.h),
// summed triangle by triangle; the including shader defines REAL and VEC3.
const REAL largest_cotangent = REAL(20.0);

REAL clamped_cotangent(REAL along, REAL across) {
    if (across > REAL(0.0)) return clamp(along / across, REAL(0.0), largest_cotangent);
    return along > REAL(0.0) ? largest_cotangent : REAL(0.0);
}

// Adds a triangle by its edges at the vertex.
void add_triangle(VEC3 to_next, VEC3 to_last, inout VEC3 sum, inout REAL weights) {
    VEC3 opposite = to_last - to_next;
    REAL doubled = length(cross(to_next, to_last));
    REAL of_next = clamped_cotangent(dot(to_last, opposite), doubled);
    REAL of_last = clamped_cotangent(-dot(to_next, opposite), doubled);
    sum += of_next * to_next + of_last * to_last;
    weights += of_next + of_last;
}
