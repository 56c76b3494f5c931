#version 430 core
// One triangle that covers the view.
out float above;

void main() {
    vec2 place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    above = 0.5 * place.y + 0.5;
    gl_Position = vec4(place, 1.0, 1.0);
}
