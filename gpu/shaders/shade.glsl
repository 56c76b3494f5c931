// The colour of a place on a surface. VALUES colours by a map; GLASS is denser towards its outline.
uniform vec3 back_colour;
uniform bool back_as_front;
uniform float opacity;
#include "light.glsl"
#include "finite.glsl"

#ifdef VALUES
layout(std140, binding = 0) uniform Scale { vec4 scale[256]; };
uniform vec2 range;
uniform vec3 no_value;

vec3 front_colour(vec3 colour, float value) {
    if (!is_finite(value)) return no_value;
    float share = range.y > range.x ? (value - range.x) / (range.y - range.x) : 0.0;
    return scale[int(255.0 * clamp(share, 0.0, 1.0) + 0.5)].rgb;
}
#else
vec3 front_colour(vec3 colour, float value) { return colour; }
#endif

vec3 lit_up(vec3 colour, float highlight) { return mix(colour, vec3(1.0, 0.78, 0.30), 0.45 * highlight); }

// How much of what is behind it is hidden.
float cover(vec3 n, vec3 viewer) {
#ifdef GLASS
    float away = 1.0 - abs(dot(n, viewer));
    return mix(opacity, 1.0, 0.6 * away * away);
#else
    return opacity;
#endif
}
