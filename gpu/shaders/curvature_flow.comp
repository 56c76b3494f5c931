#version 430 core
// Mean curvature flow (smoothing/mean_curvature_flow.h), factors.x lambda; with factors.y, the
// feature curvature [1/mm], anisotropic smoothing (smoothing/anisotropic.h).
// 0 source, 1 target, 2 start, 3 offsets and 4 corners of every vertex
#include "filter_pass.glsl"
#include "corners.glsl"
#include "angle.glsl"
#define REAL float
#define VEC3 vec3
#include "corner_curvature.glsl"

const float largest_cotangent = 20.0;

float clamped_cotangent(float along, float across) {
    if (across > 0.0) return clamp(along / across, 0.0, largest_cotangent);
    return along > 0.0 ? largest_cotangent : 0.0;
}

// Meyer et al. 2003, section 6: how much of the flow a vertex keeps.
float flow_share(float mean, float gauss, float feature) {
    float spread = sqrt(max(0.0, mean * mean - gauss));
    float one = mean + spread, two = mean - spread;
    if (abs(one) <= feature && abs(two) <= feature) return 1.0;
    if (abs(one) > feature && abs(two) > feature && gauss > 0.0) return 0.0;
    float smallest = abs(one) < abs(two) ? one : two;
    if (abs(mean) <= abs(smallest)) return 1.0;
    return clamp(smallest / mean, 0.0, 1.0);
}

void main() {
    uint v = element();
    if (v >= element_count) return;
    vec4 own = source[v];
    target[v] = own;
    if (own.w <= 0.0) return;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    CornerShare all = CornerShare(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0);
    float angles = 0.0;
    uint end = first_corner(v + 1u);
    for (uint i = first_corner(v); i < end; ++i) {
        vec3 to_next = source[corners[i].x].xyz - own.xyz, to_last = source[corners[i].y].xyz - own.xyz;
        vec3 opposite = to_last - to_next;
        float doubled = length(cross(to_next, to_last));
        float next = clamped_cotangent(dot(to_last, opposite), doubled);
        float last_weight = clamped_cotangent(-dot(to_next, opposite), doubled);
        sum += next * to_next + last_weight * to_last;
        weights += next + last_weight;
        if (factors.y > 0.0) {
            CornerShare share = corner_share(to_next, to_last);
            all.flow += share.flow;
            all.normal += share.normal;
            all.area += share.area;
            if (share.across > 0.0) angles += angle_of(share.across, share.along);
        }
    }
    if (!(weights > 0.0)) return;
    float share = factors.x;
    if (factors.y > 0.0 && all.area > 0.0 && !on_boundary(v)) {
        float mean = mean_of(all.flow, all.normal, all.area);
        share *= flow_share(mean, (6.28318530717959 - angles) / all.area, factors.y);
    }
    vec3 moved = own.xyz + own.w * share * (sum / weights);
    if (cell != 0) moved = inside_cell(start[v].xyz, moved);
    target[v].xyz = moved;
}
