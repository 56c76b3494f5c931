// Where things are seen. Positions [mm] are relative to the centre of what is drawn.
uniform mat4 to_clip;
uniform mat4 to_eye;      // right, up and back, relative to the view's centre [mm]
uniform vec4 eye;         // w = 1: the eye's place; w = 0: the direction towards it
uniform vec4 clip_plane;  // kept where its product with (position, 1) is positive
uniform float pull;       // how much nearer to the eye things are for hiding others [mm]
out vec3 eye_point;
out float gl_ClipDistance[1];

vec4 clip_of(vec3 place) {
    vec4 clip = to_clip * vec4(place, 1.0);
    if (pull != 0.0) {
        vec4 nearer = to_clip * vec4(place + pull * normalize(eye.xyz - eye.w * place), 1.0);
        if (nearer.w > 0.0) clip.z = nearer.z / nearer.w * clip.w;
    }
    return clip;
}

void set_place(vec3 place) {
    eye_point = (to_eye * vec4(place, 1.0)).xyz;
    gl_ClipDistance[0] = dot(clip_plane, vec4(place, 1.0));
}
