// Angle in [0, pi] of a direction with y >= 0, to double precision; GLSL has no atan() for doubles.
// Source: Cephes mathematical library, atan.
double angle_of(double y, double x) {
    const double pi = 3.14159265358979323846lf;
    double t = y / abs(x), base = 0.0lf;
    if (t > 2.41421356237309504880lf) {
        base = pi / 2.0lf;
        t = -abs(x) / y;
    } else if (t > 0.66lf) {
        base = pi / 4.0lf;
        t = (y - abs(x)) / (y + abs(x));
    }
    double z = t * t;
    double p = (((-8.750608600031904122785e-1lf * z - 1.615753718733365076637e1lf) * z -
                 7.500855792314704667340e1lf) * z - 1.228866684490136173410e2lf) * z -
               6.485021904942025371773e1lf;
    double q = ((((z + 2.485846490142306297962e1lf) * z + 1.650270098316988542046e2lf) * z +
                 4.328810604912902668951e2lf) * z + 4.853903996359136964868e2lf) * z +
               1.945506571482613964425e2lf;
    double angle = base + t * (z * p / q) + t;
    return x < 0.0lf ? pi - angle : angle;
}
