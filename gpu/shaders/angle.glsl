// Angle in [0, pi] of a direction with y >= 0, to single precision; GLSL guarantees no precision
// for its own atan(). Source: Cephes mathematical library, atanf.
float angle_of(float y, float x) {
    const float pi = 3.14159265358979;
    float t = y / abs(x), base = 0.0;
    if (t > 2.414213562373095) {
        base = pi / 2.0;
        t = -abs(x) / y;
    } else if (t > 0.4142135623730950) {
        base = pi / 4.0;
        t = (y - abs(x)) / (y + abs(x));
    }
    float z = t * t;
    float series = ((8.05374449538e-2 * z - 1.38776856032e-1) * z + 1.99777106478e-1) * z - 3.33329491539e-1;
    float angle = base + series * z * t + t;
    return x < 0.0 ? pi - angle : angle;
}
