// Totals over a work group in a fixed order: sums of x, y and z, maximum of w. The included
// dispatch layout has 256 invocations; all of them must call group_total().
shared vec4 totals[256];

vec4 joined(vec4 a, vec4 b) { return vec4(a.xyz + b.xyz, max(a.w, b.w)); }

vec4 group_total(vec4 value) {
    uint i = gl_LocalInvocationIndex;
    totals[i] = value;
    for (uint half_count = 128u; half_count > 0u; half_count /= 2u) {
        barrier();
        if (i < half_count) totals[i] = joined(totals[i], totals[i + half_count]);
    }
    barrier();
    return totals[0];
}
