#version 430 core
// Grey by window and level, as stored: images are encoded for displays already.
in vec2 pixel;
uniform sampler2D scalars;
uniform vec2 window_level;
uniform float opacity;
out vec4 fragment;

void main() {
    float grey = clamp((texture(scalars, pixel).r - window_level.y) / window_level.x + 0.5, 0.0, 1.0);
    fragment = vec4(vec3(grey), opacity);
}
