// Positions of vertices [mm], relative to the centre of the start's bounding box: anchor + shift.
// Anchors are the start in single precision and constant; shifts begin with its rounding remainder,
// so that edges keep all their digits.
layout(std430, binding = 0) restrict readonly buffer Shifts { vec4 shifts[]; };
layout(std430, binding = 6) restrict readonly buffer Anchors { vec4 anchors[]; };

vec3 position_of(uint v) { return anchors[v].xyz + shifts[v].xyz; }

vec3 edge(uint from, uint to) {
    return (anchors[to].xyz - anchors[from].xyz) + (shifts[to].xyz - shifts[from].xyz);
}
