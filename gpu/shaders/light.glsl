// Soft lights fixed to the eye: a broad one from above, a weak one from the side, a faint gleam.
uniform float eye_distance;  // from the view's centre [mm]; 0: parallel view

vec3 towards_eye(vec3 point) {
    return eye_distance > 0.0 ? normalize(vec3(0.0, 0.0, eye_distance) - point) : vec3(0.0, 0.0, 1.0);
}

// Linear RGB of a surface with a unit normal that faces the eye.
vec3 lit(vec3 colour, vec3 n, vec3 viewer) {
    float facing = max(dot(n, viewer), 0.0);
    float key = max(dot(n, vec3(0.309, 0.514, 0.800)) * 0.8 + 0.2, 0.0);
    float fill = max(dot(n, vec3(-0.781, -0.195, 0.593)), 0.0);
    float gleam = max(dot(n, vec3(0.168, 0.300, 0.939)), 0.0);
    gleam *= gleam;
    gleam *= gleam;
    gleam *= gleam;
    gleam *= gleam;
    gleam *= gleam;
    float away = 1.0 - facing;
    return colour * (0.20 + 0.70 * key + 0.20 * fill) * (1.0 - 0.35 * away * away * away) + 0.05 * gleam;
}

vec3 encoded(vec3 linear) { return pow(clamp(linear, 0.0, 1.0), vec3(1.0 / 2.2)); }
