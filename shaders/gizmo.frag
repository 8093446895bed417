#version 450 core
// The marks of lights: SUN (disc and rays), BULB (disc in a ring), SPOT (a cone), BALL (a full disc),
// PANEL (a square); KNOB and BOX (handles), LINE and DASHED. Drawn twice as it were: a dark rim below keeps
// them legible on a bright sky.
in vec2 v_local;

uniform vec3 u_color;
uniform float u_scale; // pixels per unit of the drawing, which is about 28 wide

layout(location = 0) out vec4 o_color;

// Distance to the shape in units of the drawing, negative inside.
float shape(vec2 p) {
    float r = length(p);
#if defined(SUN)
    float sector = 6.2831853 / 8.0;
    float angle = atan(p.y, p.x);
    angle -= sector * round(angle / sector);
    vec2 q = r * vec2(cos(angle), sin(angle)); // turned into the sector of the ray along +x
    vec2 ray = vec2(max(abs(q.x - 9.0) - 2.0, 0.0), q.y);
    return min(r - 4.5, length(ray) - 0.9);
#elif defined(BULB)
    return min(r - 4.5, abs(r - 8.5) - 0.8);
#elif defined(SPOT)
    // A lamp shade at the top that widens downwards: a triangle with its tip cut off, and three rays.
    vec2 q = vec2(abs(p.x), p.y);
    float side = dot(q - vec2(2.2, 8.0), normalize(vec2(9.0, 4.0)));
    float lamp = max(max(side, q.y - 8.0), -q.y);
    vec2 ray = vec2(0.45, -0.89);
    vec2 along = q - vec2(5.0, -3.0);
    float t = clamp(dot(along, ray), 0.0, 5.0);
    float middle = length(vec2(q.x, max(abs(q.y + 6.0) - 2.5, 0.0)));
    return min(lamp, min(length(along - t * ray), middle) - 0.9);
#elif defined(BALL)
    return min(r - 6.0, abs(r - 9.5) - 0.8);
#elif defined(PANEL)
    vec2 q = abs(p);
    float square = max(q.x, q.y);
    return min(square - 5.0, abs(square - 8.5) - 0.8);
#elif defined(KNOB)
    return r - 5.0;
#elif defined(BOX)
    vec2 q = abs(p);
    return max(q.x, q.y) - 4.2;
#elif defined(DASHED)
    float dash = abs(mod(p.x, 9.0) - 4.5) - 2.5;
    return max(abs(p.y) - 0.7, dash);
#else
    return abs(p.y) - 0.7;
#endif
}

void main() {
    float d = shape(v_local / u_scale) * u_scale;
    float cover = clamp(0.5 - d, 0.0, 1.0);
    float rim = 0.5 * clamp(1.0 - max(d, 0.0) / (2.2 * u_scale), 0.0, 1.0);
    float alpha = max(cover, rim);
    if (alpha <= 0.0)
        discard;
    o_color = vec4(mix(vec3(0.05), u_color, cover), alpha);
}
