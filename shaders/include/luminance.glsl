// Sums over pixels of a picture, for its log-average luminance. Pixels count by their alpha.
#ifndef PT_LUMINANCE_GLSL
#define PT_LUMINANCE_GLSL

struct LuminanceSum {
    float weightedLog; // sum of alpha · log2(delta + L)
    float weight;      // sum of alpha
    float darkest, brightest; // log2(delta + L) of pixels that are there at all
};

LuminanceSum noPixels() {
    return LuminanceSum(0.0, 0.0, 1e30, -1e30);
}

LuminanceSum add(LuminanceSum a, LuminanceSum b) {
    return LuminanceSum(a.weightedLog + b.weightedLog, a.weight + b.weight,
                        min(a.darkest, b.darkest), max(a.brightest, b.brightest));
}

layout(local_size_x = 256) in;

shared LuminanceSum s_sums[256];

// The sum over the work group, in the first invocation. The order of addition is fixed: the same
// picture gives the same bits.
LuminanceSum addGroup(LuminanceSum own) {
    uint i = gl_LocalInvocationIndex;
    barrier(); // the sum before has been read
    s_sums[i] = own;
    barrier();
    for (uint half_ = 128u; half_ > 0u; half_ /= 2u) {
        if (i < half_)
            s_sums[i] = add(s_sums[i], s_sums[i + half_]);
        barrier();
    }
    return s_sums[0];
}

#endif
