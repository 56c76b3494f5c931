#version 430 core
// Variants: EDGES draws the triangles' edges, ONLY_EDGES nothing else; FLAT shades by the
// triangle's own normal; VALUES colours by a map; GLASS is transparent and denser towards its outline.
in vec3 eye_point;
in vec3 eye_normal;
in vec3 colour;
in float value;
flat in float highlight;
uniform vec3 back_colour;
uniform bool back_as_front;
uniform float opacity;
uniform vec4 edge_colour;  // a: opacity
uniform float edge_width;  // [pixels]
out vec4 fragment;
#include "light.glsl"

#ifdef VALUES
layout(std140, binding = 0) uniform Scale { vec4 scale[256]; };
uniform vec2 range;
uniform vec3 no_value;

vec3 front_colour() {
    if (isnan(value)) return no_value;
    float share = range.y > range.x ? (value - range.x) / (range.y - range.x) : 0.0;
    return scale[int(255.0 * clamp(share, 0.0, 1.0) + 0.5)].rgb;
}
#else
vec3 front_colour() { return colour; }
#endif

#ifdef EDGES
noperspective in vec4 corner;

// How much of a pixel an edge covers; each triangle draws its half of it. The edges of triangles of
// a few pixels are paler, so that dense meshes keep their shading.
float edge_cover() {
    vec4 dx = dFdx(corner), dy = dFdy(corner);
    vec4 slope = sqrt(dx * dx + dy * dy);
    // the colour that the triangle does not use has no slope
    vec4 way = mix(corner / max(slope, 1e-12), vec4(1e9), lessThan(slope, vec4(1e-7)));
    float nearest = min(min(way.x, way.y), min(way.z, way.w));
    float height = 1.0 / max(max(max(slope.x, slope.y), max(slope.z, slope.w)), 1e-9);
    return clamp(0.5 * edge_width + 0.5 - nearest, 0.0, 1.0) * mix(0.3, 1.0, smoothstep(2.0, 9.0, height));
}
#endif

vec3 normal_towards_eye() {
#ifdef FLAT
    vec3 n = normalize(cross(dFdx(eye_point), dFdy(eye_point)));
    return dot(n, towards_eye(eye_point)) < 0.0 ? -n : n;
#else
    vec3 n = normalize(eye_normal);
    return gl_FrontFacing ? n : -n;
#endif
}

void main() {
#ifdef ONLY_EDGES
    fragment = vec4(encoded(edge_colour.rgb), opacity * edge_colour.a * edge_cover());
    if (fragment.a < 0.004) discard;
#else
    vec3 n = normal_towards_eye();
    vec3 viewer = towards_eye(eye_point);
    vec3 own = gl_FrontFacing || back_as_front ? front_colour() : back_colour;
    vec3 shown = mix(own, vec3(1.0, 0.78, 0.30), 0.45 * highlight);
    vec3 light = lit(shown, n, viewer);
#ifdef EDGES
    light = mix(light, edge_colour.rgb, edge_colour.a * edge_cover());
#endif
    float alpha = opacity;
#ifdef GLASS
    float away = 1.0 - abs(dot(n, viewer));
    alpha = mix(opacity, 1.0, 0.6 * away * away);
#endif
    fragment = vec4(encoded(light), alpha);
#endif
}
