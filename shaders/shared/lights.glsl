// Sources of light: how much arrives of each, and what the surface reflects of it. The methods and
// their errors are described in docs/maths/lights.md.
#ifndef PT_LIGHTS_GLSL
#define PT_LIGHTS_GLSL

#include "brdf.glsl"
#include "sampling.glsl"

// ---- Points and cones ---------------------------------------------------------------------------

// The windowed range of KHR_lights_punctual, "Range Property": max(min(1 - (d / range)^4, 1), 0),
// from d² and 1 / range². Zero for the latter: the light has no end.
PT_FN float rangeWindow(float distance2, float inverseRange2) {
    float x = distance2 * inverseRange2;
    return clamp(1.0f - x * x, 0.0f, 1.0f);
}

// KHR_lights_punctual, "Inner and Outer Cone Angles": saturate(cos scale + offset)², with
//   scale = 1 / max(0.001, cos(inner) - cos(outer)), offset = -cos(outer) scale.
PT_FN float spotFalloff(float cosAngle, float scale, float offset) {
    float x = clamp(cosAngle * scale + offset, 0.0f, 1.0f);
    return x * x;
}

// What becomes of a candela on the way to a surface that faces the light: 1 / d², windowed. Closer
// than a tenth of a millimetre a point is no model of a light any more; the floor keeps 1 / 0 out.
PT_FN float pointFalloff(float distance2, float inverseRange2) {
    return rangeWindow(distance2, inverseRange2) / max(distance2, 1e-8f);
}

// ---- Spheres ------------------------------------------------------------------------------------

// Form factor of a planar element to a sphere, the part above the horizon only: irradiance / (pi L).
// `cosBeta`: angle from the normal to the centre; `sin2`: (radius / distance)², at most 1.
// Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-43…B-45; with
// w = sqrt(sin2 - cos²) both of its inverse functions become arctangents of w, which keep their
// digits where the arcsine of 1 - tiny has lost half of them.
PT_FN float sphereFormFactor(float cosBeta, float sin2) {
    float w2 = sin2 - cosBeta * cosBeta;
    if (w2 <= 0.0f) // entirely above, or below, the horizon
        return max(cosBeta, 0.0f) * sin2;
    float w = sqrt(w2);
    float c = sqrt(max(1.0f - sin2, 0.0f));
    float sum = atan(w, c) + sin2 * cosBeta * atan(w, -c * cosBeta) - c * w;
    return clamp(sum * kInvPi, 0.0f, 1.0f);
}

// ---- Polygons -----------------------------------------------------------------------------------

// Lambert 1760; Baum, Rushmeier & Winget 1989, "Improving Radiosity Solutions Through the Use of
// Analytically Determined Form-Factors", equation 2: the angle of an edge times the normal's
// share of the edge's plane, here with n = +z. `a` and `b`: unit vectors to the ends.
PT_FN float edgeFormFactor(vec3 a, vec3 b) {
    vec3 c = cross(a, b);
    float s = length(c);
    // angle / sin(angle); 1 for edges too short to tell
    return c.z * (s > 1e-6f ? atan(s, dot(a, b)) / s : 1.0f);
}

// Where the edge from a to b passes z = 0, up to its length. For a.z and b.z of opposite signs.
PT_FN vec3 horizonPoint(vec3 a, vec3 b) {
    return a * abs(b.z) + b * abs(a.z);
}

// The part of an edge above the horizon is added to `sum`; where the outline goes below and comes
// up again is noted in `down` and `up`.
PT_FN void addClippedEdge(vec3 a, vec3 b, PT_INOUT(float) sum, PT_INOUT(vec3) down,
                          PT_INOUT(vec3) up) {
    if (a.z < 0.0f && b.z < 0.0f)
        return;
    vec3 from = a;
    vec3 to = b;
    if (a.z < 0.0f) {
        from = horizonPoint(a, b);
        up = from;
    }
    if (b.z < 0.0f) {
        to = horizonPoint(a, b);
        down = to;
    }
    float length2 = dot(from, from) * dot(to, to);
    if (length2 > 0.0f)
        sum = sum + edgeFormFactor(normalize(from), normalize(to));
}

// Form factor of the planar element at the origin with normal +z to the convex quadrilateral
// a b c d, clipped at the horizon: irradiance / (pi L). Its lit side is the one from which the
// corners run clockwise; from the other it is zero.
PT_FN float quadFormFactor(vec3 a, vec3 b, vec3 c, vec3 d) {
    float sum = 0.0f;
    vec3 down = vec3(0.0f);
    vec3 up = vec3(0.0f);
    addClippedEdge(a, b, sum, down, up);
    addClippedEdge(b, c, sum, down, up);
    addClippedEdge(c, d, sum, down, up);
    addClippedEdge(d, a, sum, down, up);
    // The outline closes along the horizon.
    if (dot(down, down) * dot(up, up) > 0.0f)
        sum = sum + edgeFormFactor(normalize(down), normalize(up));
    return clamp(sum / kTwoPi, 0.0f, 1.0f);
}

// ---- Linearly transformed cosines ---------------------------------------------------------------

// Heitz, Dupuy, Hill & Neubelt 2016, "Real-Time Polygonal-Light Shading with Linearly Transformed
// Cosines": a matrix turns the lobe of the BRDF into a clamped cosine, for which the form factors
// above are exact. In the frame whose z is the normal and whose xz plane holds v its inverse is
//   | fit.x  0  fit.y |
//   |   0    1    0   |
//   | fit.z  0  fit.w |
// The table holds `fit` at (perceptualRoughness, lobeAngle(N·V)); Patina made it with
// tools/FitLobes.cpp for GGX with height-correlated Smith masking.

// The table's second axis, almost proportional to the angle between n and v.
PT_FN float lobeAngle(float NoV) {
    return sqrt(clamp(1.0f - NoV, 0.0f, 1.0f));
}

// The frame of the fit as rows of (x, y, z).
PT_FN void lobeFrame(vec3 n, vec3 v, PT_OUT(vec3) x, PT_OUT(vec3) y) {
    vec3 t = v - n * dot(n, v);
    float length2 = dot(t, t);
    if (length2 < 1e-12f) // v = n: the lobe has no preferred side
        orthonormalBasis(n, x, y);
    else {
        x = t * inversesqrt(length2);
        y = cross(n, x);
    }
}

PT_FN vec3 toLobe(vec4 fit, vec3 p) {
    return vec3(fit.x * p.x + fit.y * p.z, p.y, fit.z * p.x + fit.w * p.z);
}

// The cosine-weighted lobe's share of light that a sphere sends: a number from 0 to 1, to be
// multiplied by the lobe's albedo and the radiance. `d`: unit vector to the centre in the lobe's
// frame; `sin2`: (radius / distance)².
//
// The cone of directions to the sphere, { w : wᵀ A w <= 0 } with A = (1 - sin2) I - d dᵀ, becomes an
// elliptic cone with A' = Mᵀ A M. Of its eigenvalues l1 >= l2 > 0 > l3 the last and its vector e
// suffice: light from the elliptic cone along e is F = tx ty / sqrt((1 + tx²) (1 + ty²)) with
// tx² = -l3 / l1, ty² = -l3 / l2, that is F = -l3 / sqrt(p'(l3)), p the characteristic polynomial.
// At the horizon it is cut as the round cone of the same F would be (Heitz & Hill 2017, "Real-Time
// Line- and Disk-Light Shading with Linearly Transformed Cosines").
PT_FN float lobeOfSphere(vec4 fit, vec3 d, float sin2) {
    if (sin2 >= 1.0f) // inside: light from everywhere
        return 1.0f;
    // Columns of M, up to the factor det(M⁻¹), which scales all eigenvalues alike.
    float det = fit.x * fit.w - fit.y * fit.z;
    vec3 mx = vec3(fit.w, 0.0f, -fit.z);
    vec3 my = vec3(0.0f, det, 0.0f);
    vec3 mz = vec3(-fit.y, 0.0f, fit.x);
    // A = (I - d dᵀ) - sin2 I, written without cancellation for small sources.
    float axx = d.y * d.y + d.z * d.z - sin2;
    float ayy = d.x * d.x + d.z * d.z - sin2;
    float azz = d.x * d.x + d.y * d.y - sin2;
    vec3 ax = vec3(axx, -d.x * d.y, -d.x * d.z);
    vec3 ay = vec3(-d.x * d.y, ayy, -d.y * d.z);
    vec3 az = vec3(-d.x * d.z, -d.y * d.z, azz);
    vec3 amx = ax * mx.x + az * mx.z;
    vec3 amy = ay * my.y;
    vec3 amz = ax * mz.x + az * mz.z;
    float xx = dot(mx, amx);
    float yy = dot(my, amy);
    float zz = dot(mz, amz);
    float xy = dot(mx, amy);
    float xz = dot(mx, amz);
    float yz = dot(my, amz);

    // The smallest eigenvalue by Laguerre's method, from a bound below it: it approaches from one
    // side and triples its digits with each step.
    float c2 = 1.0f - sin2;
    float trace = xx + yy + zz;
    float minors = (xx * yy - xy * xy) + (xx * zz - xz * xz) + (yy * zz - yz * yz);
    float detM = det * det; // of the scaled M
    float determinant = -c2 * c2 * sin2 * detM * detM;
    float l = (trace - 2.0f * sqrt(max(trace * trace - 3.0f * minors, 0.0f))) / 3.0f;
    for (int i = 0; i < 4; ++i) {
        float p = ((l - trace) * l + minors) * l - determinant;
        float p1 = (3.0f * l - 2.0f * trace) * l + minors;
        float p2 = 6.0f * l - 2.0f * trace;
        float root = sqrt(max(4.0f * p1 * p1 - 6.0f * p * p2, 0.0f));
        l = l - 3.0f * p / max(p1 + root, 1e-30f);
    }
    float slope = (3.0f * l - 2.0f * trace) * l + minors;
    float F = clamp(-l * inversesqrt(max(slope, 1e-30f)), 0.0f, 1.0f);

    // Its eigenvector: the largest column of the adjugate of A' - l I.
    float px = xx - l;
    float py = yy - l;
    float pz = zz - l;
    vec3 e = vec3(py * pz - yz * yz, xz * yz - xy * pz, xy * yz - xz * py);
    vec3 ey = vec3(xz * yz - xy * pz, px * pz - xz * xz, xy * xz - yz * px);
    vec3 ez = vec3(xy * yz - xz * py, xy * xz - yz * px, px * py - xy * xy);
    if (ey.y > e.x && ey.y >= ez.z)
        e = ey;
    else if (ez.z > e.x)
        e = ez;
    vec3 center = toLobe(fit, d);
    float along = dot(e, center);
    float length2 = dot(e, e);
    // A vector of zeros: the numbers ran out; the centre's direction is close.
    vec3 axis = length2 > 0.0f ? e * inversesqrt(length2) : normalize(center);
    float z = along < 0.0f ? -axis.z : axis.z;
    return sphereFormFactor(z, F);
}

// The same for a quadrilateral with corners in the lobe's frame.
PT_FN float lobeOfQuad(vec4 fit, vec3 a, vec3 b, vec3 c, vec3 d) {
    return quadFormFactor(toLobe(fit, a), toLobe(fit, b), toLobe(fit, c), toLobe(fit, d));
}

// ---- Shading ------------------------------------------------------------------------------------

// Light of radiance L from an area of which the cosine sees `diffuseShare` and the specular lobe
// `specularShare` (form factors).
PT_FN ShadedLight shadeArea(SurfaceTerms s, float diffuseShare, float specularShare,
                            vec3 radiance) {
    ShadedLight result;
    result.diffuse = s.diffuseAlbedo * radiance * diffuseShare;
    result.specular = s.specularAlbedo * radiance * specularShare;
    return result;
}

// `toCenter`: from the surface to the sphere's centre. Light comes from its outside; a surface
// inside is lit from everywhere.
PT_FN ShadedLight shadeSphere(SurfaceTerms s, vec4 fit, vec3 toCenter, float radius,
                              vec3 radiance) {
    float distance2 = dot(toCenter, toCenter);
    float sin2 = min(radius * radius / max(distance2, 1e-12f), 1.0f);
    // In the very centre every direction is right.
    vec3 d = distance2 > 1e-12f ? toCenter * inversesqrt(distance2) : s.n;
    float inside = sin2 >= 1.0f ? 1.0f : sphereFormFactor(dot(s.n, d), sin2);
    vec3 x;
    vec3 y;
    lobeFrame(s.n, s.v, x, y);
    vec3 local = vec3(dot(x, d), dot(y, d), dot(s.n, d));
    return shadeArea(s, inside, lobeOfSphere(fit, local, sin2), radiance);
}

// `toCenter`: from the surface to the centre; `halfX`, `halfY`: half the sides. The side that
// cross(halfY, halfX) points to emits.
PT_FN ShadedLight shadeRectangle(SurfaceTerms s, vec4 fit, vec3 toCenter, vec3 halfX, vec3 halfY,
                                 vec3 radiance) {
    vec3 x;
    vec3 y;
    lobeFrame(s.n, s.v, x, y);
    vec3 center = vec3(dot(x, toCenter), dot(y, toCenter), dot(s.n, toCenter));
    vec3 hx = vec3(dot(x, halfX), dot(y, halfX), dot(s.n, halfX));
    vec3 hy = vec3(dot(x, halfY), dot(y, halfY), dot(s.n, halfY));
    vec3 a = center - hx - hy;
    vec3 b = center + hx - hy;
    vec3 c = center + hx + hy;
    vec3 d = center - hx + hy;
    return shadeArea(s, quadFormFactor(a, b, c, d), lobeOfQuad(fit, a, b, c, d), radiance);
}

#endif
