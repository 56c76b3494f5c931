#version 430 core
// Grey by window and level, as stored: images are encoded for displays already. Or whole numbers as
// colours. Nothing where there is no value.
in vec2 pixel;
uniform sampler2D scalars;
uniform vec2 window_level;
uniform float opacity;
uniform bool labels;
uniform vec3 label_colours[12];
out vec4 fragment;

vec3 label_colour(float value) {
    int label = int(round(value));
    if (label <= 0) discard;
    return label_colours[label % 12];
}

void main() {
    float value = texture(scalars, pixel).r;
    if (isnan(value)) discard;
    float grey = clamp((value - window_level.y) / window_level.x + 0.5, 0.0, 1.0);
    fragment = vec4(labels ? label_colour(value) : vec3(grey), opacity);
}
