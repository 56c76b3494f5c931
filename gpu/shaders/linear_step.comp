#version 430 core
// One linear step of a filter (smoothing/filters/linear_step.h):
//   target = onto + share * (umbrella * U + source * s + target * t + start * o)
// with the factors x umbrella, y source, z target, w start; y + z + w is 0 (a step does not depend
// on where the origin is), which the differences here rely on. After a step onto nothing, the source
// holds differences of positions instead of shifts.
// 0 source, 1 target, 2 start, 3 offsets and 4 neighbours, 5 umbrellas of the anchors
#include "filter_pass.glsl"
#include "umbrella.glsl"

void main() {
    uint v = element();
    if (v >= element_count) return;
    vec4 own = shifts[v];
    vec3 before = vec3(0.0);
    if (onto == 1)
        before = own.xyz;
    else if (onto == 2)
        before = target[v].xyz;
    vec3 step = factors.x * (of_positions ? umbrella_of_positions(v, own.xyz) : umbrella_of_shifts(v, own.xyz));
    if (factors.w != 0.0) {
        vec3 origin = start[v].xyz;
        if (factors.y != 0.0) step += factors.y * (own.xyz - origin);
        if (factors.z != 0.0) step += factors.z * (before - origin);
    } else if (factors.y != 0.0) {
        step += factors.y * (own.xyz - before);
    }
    float share = last ? max(own.w, 0.0) : (own.w < 0.0 ? 0.0 : 1.0);
    vec3 moved = before + share * step;
    if (last && cell != 0) moved = inside_cell(start[v].xyz, moved);
    target[v] = vec4(moved, own.w);
}
