// False for infinity and not-a-number: drivers may assume that there are none, and simplify isnan()
// and comparisons, but not bits.
bool is_finite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool is_finite(vec3 p) { return is_finite(p.x) && is_finite(p.y) && is_finite(p.z); }
