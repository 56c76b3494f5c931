#version 430 core
// An iteration of anisotropic smoothing (smoothing/filters/anisotropic.h), factors.x lambda. In
// single precision, and again in double precision where that may decide a feature differently:
// then the whole neighbourhood would show it.
// 0 source, 1 target, 2 start, 3 offsets and 4 corners of every vertex, 6 anchors
#include "filter_pass.glsl"
#include "corners.glsl"
#include "angle.glsl"
#include "angle_double.glsl"

vec3 edge_of(uint from, uint to, vec3 zero) { return edge(from, to); }

dvec3 edge_of(uint from, uint to, dvec3 zero) {
    return (dvec3(anchors[to].xyz) - dvec3(anchors[from].xyz)) + (dvec3(shifts[to].xyz) - dvec3(shifts[from].xyz));
}

#define REAL float
#define VEC3 vec3
#include "cotangent_umbrella.glsl"
#include "corner_curvature.glsl"
#include "anisotropic_sums.glsl"
#undef REAL
#undef VEC3
#define REAL double
#define VEC3 dvec3
#define largest_cotangent largest_cotangent_double
#define CornerShare CornerShareDouble
#define AnisotropicSums AnisotropicSumsDouble
#again "cotangent_umbrella.glsl"
#again "corner_curvature.glsl"
#again "anisotropic_sums.glsl"
#undef CornerShare
#undef AnisotropicSums

layout(location = 9) uniform double feature_curvature;  // [1/mm]

// Whether a principal curvature is so near the threshold that rounding may decide, or a number is
// none. A sum of curvatures errs by 1e-5 at most, where triangles are not thin: angles by some
// roundings, cotangents by 20 times as many.
bool in_doubt(AnisotropicSums sums, float feature) {
    const float rounding = 1e-5;
    float mean_error = rounding * sums.reach / sums.area;
    float squared = sums.mean * sums.mean - sums.gauss;
    float squared_error = 2.0 * abs(sums.mean) * mean_error + rounding / sums.area;
    float spread = sqrt(max(0.0, squared));
    float error = mean_error + squared_error / (spread + sqrt(squared_error));
    bool certain = abs(abs(sums.mean + spread) - feature) > error && abs(abs(sums.mean - spread) - feature) > error;
    return sums.thin || !certain;
}

void main() {
    uint v = element();
    if (v >= element_count) return;
    vec4 own = shifts[v];
    target[v] = own;
    if (own.w <= 0.0) return;
    AnisotropicSums sums = anisotropic_sums(v, vec3(0.0));
    vec3 step;
    if (!on_boundary(v) && in_doubt(sums, float(feature_curvature))) {
        AnisotropicSumsDouble exact = anisotropic_sums(v, dvec3(0.0lf));
        if (!(exact.weights > 0.0lf)) return;
        double share = exact.area > 0.0lf ? flow_share(exact, feature_curvature) : 1.0lf;
        step = vec3(share * (exact.way / exact.weights));
    } else {
        if (!(sums.weights > 0.0)) return;
        float share = sums.area > 0.0 && !on_boundary(v) ? flow_share(sums, float(feature_curvature)) : 1.0;
        step = share * (sums.way / sums.weights);
    }
    vec3 moved = own.xyz + own.w * factors.x * step;
    if (cell != 0) moved = inside_cell(start[v].xyz, moved);
    target[v].xyz = moved;
}
