// The surface's own positions [mm] in double precision, 3 doubles each, for threshold decisions.
// Sums are in the CPU's order.
#ifdef WIDE
layout(binding = 0) uniform usamplerBuffer exact_table;
double exact_number(uint i) { return packDouble2x32(texelFetch(exact_table, int(i)).xy); }
#else
layout(std430, binding = 0) restrict readonly buffer Exact { double exact[]; };
double exact_number(uint i) { return exact[i]; }
#endif

dvec3 exact_at(uint v) { return dvec3(exact_number(3u * v), exact_number(3u * v + 1u), exact_number(3u * v + 2u)); }

double squared_length(dvec3 a) {
    precise double sum = a.x * a.x + (a.y * a.y + a.z * a.z);
    return sum;
}
