#version 430 core
// Draws a surface (gpu/render/surface_source.h). Its position [mm] is anchor + shift; the tag is 4 *
// patch label + colour of the corner. Variant DENSE: triangles of a few pixels are lit at their vertices.
layout(location = 0) in vec3 anchor;
layout(location = 1) in vec3 shift;
layout(location = 2) in vec3 normal;
layout(location = 3) in float vertex_value;
layout(location = 4) in uint tag;
layout(location = 5) in vec4 vertex_colour;
#include "camera.glsl"
layout(std140, binding = 1) uniform Patches { vec4 patch_colours[1024]; };
uniform vec3 base_colour;
uniform int colouring;          // Colouring (gpu/render/layers.h)
uniform int highlighted_patch;  // -1: none; -2: all
#ifdef DENSE
#include "shade.glsl"
out vec4 front_light;  // encoded, with how much it hides
out vec3 back_light;
#else
out vec3 eye_normal;
out vec3 colour;
out float value;
flat out float highlight;
#endif
flat out uint element;
#ifdef EDGES
noperspective out vec4 corner;
#endif

vec3 chosen_colour(int label) {
    return colouring == 1   ? patch_colours[min(label, 1023)].rgb
           : colouring == 3 ? pow(vertex_colour.rgb, vec3(2.2))
                            : base_colour;
}

void main() {
    vec3 place = anchor + shift;
    set_place(place);
    gl_Position = clip_of(place);
    element = 0u;
    int label = int(tag >> 2u);
    vec3 chosen = chosen_colour(label);
    float chosen_highlight = highlighted_patch == -2 || highlighted_patch == label ? 1.0 : 0.0;
    vec3 eye_side = mat3(to_eye) * normal;
#ifdef DENSE
    vec3 n = normalize(eye_side), viewer = towards_eye(eye_point);
    vec3 own = front_colour(chosen, vertex_value);
    front_light = vec4(encoded(lit(lit_up(own, chosen_highlight), n, viewer)), cover(n, viewer));
    back_light = encoded(lit(lit_up(back_as_front ? own : back_colour, chosen_highlight), -n, viewer));
#else
    eye_normal = eye_side;
    colour = chosen;
    value = vertex_value;
    highlight = chosen_highlight;
#endif
#ifdef EDGES
    uint id = tag & 3u;
    corner = vec4(id == 0u, id == 1u, id == 2u, id == 3u);
#endif
}
