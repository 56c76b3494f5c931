#version 430 core
// What is seen in a pixel (Renderer::draw_ids).
in vec3 eye_point;
flat in uint element;
uniform uint layer;
uniform uint kind;
uniform bool by_primitive;  // else by the instance
out uvec4 found;

void main() {
    found = uvec4(layer, by_primitive ? uint(gl_PrimitiveID) : element, floatBitsToUint(-eye_point.z), kind);
}
