#include "core/library/Field.h"

#include <cmath>

namespace patina::library {

namespace {

int floorToInt(float x) {
    const int i = static_cast<int>(x);
    return i - (static_cast<float>(i) > x ? 1 : 0);
}

// One pass along the rows, written transposed: two calls blur both directions.
Field blurRowsTransposed(const Field& source, int radius) {
    const int n = source.size();
    Field result(n);
    const float scale = 1.0f / static_cast<float>(2 * radius + 1);
    forRows(n, [&](int y) {
        const float* in = source.row(y);
        double sum = 0.0; // running: the error of floats would drift along the row
        for (int x = -radius; x <= radius; ++x)
            sum += in[x & (n - 1)];
        for (int x = 0; x < n; ++x) {
            result.row(x)[y] = static_cast<float>(sum) * scale;
            sum += in[(x + radius + 1) & (n - 1)] - in[(x - radius) & (n - 1)];
        }
    });
    return result;
}

} // namespace

float Field::sample(float x, float y) const {
    const int ix = floorToInt(x), iy = floorToInt(y);
    const float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy);
    const int mask = m_size - 1;
    const float* top = row(iy & mask);
    const float* bottom = row((iy + 1) & mask);
    const int x0 = ix & mask, x1 = (ix + 1) & mask;
    const float a = top[x0] + (top[x1] - top[x0]) * fx;
    const float b = bottom[x0] + (bottom[x1] - bottom[x0]) * fx;
    return a + (b - a) * fy;
}

Field warp(const Field& source, const Field& dx, const Field& dy, float amount) {
    return makeField(source.size(), [&](int x, int y) {
        return source.sample(static_cast<float>(x) + amount * dx.row(y)[x],
                             static_cast<float>(y) + amount * dy.row(y)[x]);
    });
}

Field blur(const Field& source, int radius) {
    Field once = blurRowsTransposed(blurRowsTransposed(source, radius), radius);
    return blurRowsTransposed(blurRowsTransposed(once, radius), radius);
}

} // namespace patina::library
