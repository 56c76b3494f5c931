// The surface's own positions [mm] in double precision, 3 doubles each, for threshold decisions.
// Sums are in the CPU's order.
layout(std430, binding = 0) readonly buffer Exact { double exact[]; };

dvec3 exact_at(uint v) { return dvec3(exact[3u * v], exact[3u * v + 1u], exact[3u * v + 2u]); }

double squared_length(dvec3 a) {
    precise double sum = a.x * a.x + (a.y * a.y + a.z * a.z);
    return sum;
}
