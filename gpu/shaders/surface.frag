#version 430 core
// Variants: EDGES draws the triangles' edges, ONLY_EDGES nothing else; FLAT shades by the
// triangle's own normal; DENSE was lit at the vertices.
in vec3 eye_point;
uniform vec4 edge_colour;  // a: opacity
uniform float edge_width;  // [pixels]
out vec4 fragment;
#ifdef DENSE
in vec4 front_light;
in vec3 back_light;

vec4 surface_light() { return gl_FrontFacing ? front_light : vec4(back_light, front_light.a); }
#else
in vec3 eye_normal;
in vec3 colour;
in float value;
flat in float highlight;
#include "shade.glsl"

vec3 normal_towards_eye(vec3 viewer) {
#ifdef FLAT
    vec3 n = normalize(cross(dFdx(eye_point), dFdy(eye_point)));
    return dot(n, viewer) < 0.0 ? -n : n;
#else
    vec3 n = normalize(eye_normal);
    return gl_FrontFacing ? n : -n;
#endif
}

vec4 surface_light() {
    vec3 viewer = towards_eye(eye_point);
    vec3 n = normal_towards_eye(viewer);
    vec3 own = gl_FrontFacing || back_as_front ? front_colour(colour, value) : back_colour;
    return vec4(encoded(lit(lit_up(own, highlight), n, viewer)), cover(n, viewer));
}
#endif

#ifdef EDGES
noperspective in vec4 corner;

// How much of a pixel an edge covers; each triangle draws its half of it. The edges of triangles of
// a few pixels are paler, so that dense meshes keep their shading.
float edge_cover() {
    vec4 dx = dFdx(corner), dy = dFdy(corner);
    vec4 slope = max(sqrt(dx * dx + dy * dy), 1e-9);
    // the colour that the triangle does not use has no slope
    vec4 way = mix(corner / slope, vec4(1e9), lessThan(slope, vec4(1e-7)));
    float nearest = min(min(way.x, way.y), min(way.z, way.w));
    float height = 1.0 / max(max(slope.x, slope.y), max(slope.z, slope.w));
    return clamp(0.5 * edge_width + 0.5 - nearest, 0.0, 1.0) *
           mix(0.3, 1.0, clamp((height - 2.0) / 7.0, 0.0, 1.0));
}
#endif

void main() {
#ifdef ONLY_EDGES
    fragment = vec4(edge_colour.rgb, edge_colour.a * edge_cover());
    if (fragment.a < 0.004) discard;
#else
    fragment = surface_light();
#ifdef EDGES
    fragment.rgb = mix(fragment.rgb, edge_colour.rgb, edge_colour.a * edge_cover());
#endif
#endif
}
