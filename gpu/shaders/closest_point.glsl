// The point of a triangle closest to the origin. Uses segments and edge functions, which keep their
// precision on slivers.
struct Closest {
    float squared;  // distance [mm^2]
    bool outer;     // on the edge from b to c, including its ends
};

// Squared distance to the segment; `along` is 0 at a, 1 at b.
float to_segment(vec3 a, vec3 b, out float along) {
    vec3 edge = b - a;
    float squared = dot(edge, edge);
    along = squared > 0.0 ? clamp(-dot(a, edge) / squared, 0.0, 1.0) : 0.0;
    vec3 nearest = along == 1.0 ? b : a + along * edge;
    return dot(nearest, nearest);
}

Closest to_triangle(vec3 a, vec3 b, vec3 c) {
    vec3 normal = cross(b - a, c - a);
    float squared = dot(normal, normal);
    if (squared > 0.0 && dot(normal, cross(a, b)) > 0.0 && dot(normal, cross(b, c)) > 0.0 &&
        dot(normal, cross(c, a)) > 0.0) {
        float height = dot(normal, a);
        return Closest(height * height / squared, false);
    }
    float along;
    Closest best = Closest(to_segment(b, c, along), true);
    float other = to_segment(a, b, along);
    if (other < best.squared) best = Closest(other, along == 1.0);
    other = to_segment(a, c, along);
    if (other < best.squared) best = Closest(other, along == 1.0);
    return best;
}
