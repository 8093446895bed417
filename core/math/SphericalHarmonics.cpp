#include "core/math/SphericalHarmonics.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/Quadrature.h"
#include "core/math/ShRotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace patina {

namespace {

// To the last bit: Newton's method in the x87's 64 bits, rounded once.
constexpr double squareRoot(double x) {
    long double root = x > 1.0 ? x : 1.0;
    for (long double next = root; true; root = next) {
        next = (root + x / root) / 2;
        if (next >= root)
            return static_cast<double>(root);
    }
}

// Factors of the normalised Legendre recurrences in l, so that evaluation takes no square roots:
//   P(m, m)     = start[m]                       (times sin^m, which the azimuth factors carry)
//   P(l, m)     = a[l][m] z P(l-1, m) - b[l][m] P(l-2, m)
// The factor sqrt(2) of m > 0 and the Condon-Shortley sign are part of start[m].
struct Recurrence {
    std::array<double, kMaxShOrder> start{};
    std::array<std::array<double, kMaxShOrder>, kMaxShOrder> a{}, b{};

    constexpr Recurrence() {
        double normalisation = squareRoot(1.0 / (4.0 * std::numbers::pi));
        start[0] = normalisation;
        for (int m = 1; m < kMaxShOrder; ++m) {
            normalisation *= -squareRoot((2.0 * m + 1.0) / (2.0 * m));
            start[m] = normalisation * std::numbers::sqrt2;
        }
        for (int m = 0; m < kMaxShOrder; ++m)
            for (int l = m + 1; l < kMaxShOrder; ++l) {
                const double l2 = l * l, m2 = m * m;
                a[l][m] = squareRoot((4.0 * l2 - 1.0) / (l2 - m2));
                b[l][m] = l == m + 1 ? 0.0
                                     : squareRoot((2.0 * l + 1.0) * ((l - 1.0) * (l - 1.0) - m2) /
                                                  ((2.0 * l - 3.0) * (l2 - m2)));
            }
    }
};

constexpr Recurrence kRecurrence;

// Calls visit(l, m, P) for m >= 0 and l = m … order-1, where Y_l,±m = P (sin^m) {cos, sin}(m phi).
// Real is a number or a vector of them; Scalar its element.
template <class Scalar, class Real, class Visit>
[[gnu::always_inline]] inline void forEachLegendre(int order, const Real& z, Visit&& visit) {
#pragma GCC unroll 8
    for (int m = 0; m < order; ++m) {
        Real previous{}, current = Real{} + static_cast<Scalar>(kRecurrence.start[m]);
        visit(m, m, current);
#pragma GCC unroll 8
        for (int l = m + 1; l < order; ++l) {
            const Real next = static_cast<Scalar>(kRecurrence.a[l][m]) * z * current -
                              static_cast<Scalar>(kRecurrence.b[l][m]) * previous;
            previous = current;
            current = next;
            visit(l, m, current);
        }
    }
}

// Calls store(i, Y_i). With a constant order all loops unroll and all factors become constants.
template <int order, class Scalar, class Real, class Store>
[[gnu::always_inline]] inline void evaluate(const Real& x, const Real& y, const Real& z,
                                            Store&& store) {
    // sin^m(theta) {cos, sin}(m phi) are the real and imaginary parts of (x + iy)^m.
    Real re[order], im[order];
    re[0] = Real{} + Scalar{1};
    im[0] = Real{};
#pragma GCC unroll 8
    for (int m = 1; m < order; ++m) {
        re[m] = x * re[m - 1] - y * im[m - 1];
        im[m] = x * im[m - 1] + y * re[m - 1];
    }
    forEachLegendre<Scalar>(order, z, [&](int l, int m, const Real& p) {
        store(shIndex(l, m), p * re[m]);
        if (m > 0)
            store(shIndex(l, -m), p * im[m]);
    });
}

// body.operator()<order>(): the step from an order known when running to one known when compiling.
template <class Body>
void withOrder(int order, Body&& body) {
    static_assert(kMaxShOrder == 8);
    switch (order) {
    case 1:
        return body.template operator()<1>();
    case 2:
        return body.template operator()<2>();
    case 3:
        return body.template operator()<3>();
    case 4:
        return body.template operator()<4>();
    case 5:
        return body.template operator()<5>();
    case 6:
        return body.template operator()<6>();
    case 7:
        return body.template operator()<7>();
    case 8:
        return body.template operator()<8>();
    default:
        CHECK(order >= 1 && order <= kMaxShOrder);
    }
}

template <class Real>
void evaluateOne(int order, const glm::vec<3, Real>& d, std::span<Real> out) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    CHECK_LE(static_cast<std::size_t>(shCount(order)), out.size());
    withOrder(order, [&]<int constantOrder>() {
        evaluate<constantOrder, Real>(d.x, d.y, d.z, [&](int i, Real value) { out[i] = value; });
    });
}

typedef float FourFloats __attribute__((vector_size(4 * sizeof(float)))); // NOLINT: GCC's

// Four directions, coordinate by coordinate.
[[gnu::always_inline]] inline void loadFour(const glm::vec3* directions, FourFloats& x,
                                            FourFloats& y, FourFloats& z) {
    FourFloats a, b, c; // x0 y0 z0 x1, y1 z1 x2 y2, z2 x3 y3 z3
    static_assert(sizeof(glm::vec3) == 12);
    const auto* from = reinterpret_cast<const char*>(directions);
    __builtin_memcpy(&a, from, sizeof(a));
    __builtin_memcpy(&b, from + sizeof(a), sizeof(b));
    __builtin_memcpy(&c, from + 2 * sizeof(a), sizeof(c));
    const FourFloats yzyz = __builtin_shufflevector(a, b, 1, 2, 4, 5); // of 0 and 1
    const FourFloats xyxy = __builtin_shufflevector(b, c, 2, 3, 5, 6); // of 2 and 3
    x = __builtin_shufflevector(a, xyxy, 0, 3, 4, 6);
    y = __builtin_shufflevector(yzyz, xyxy, 0, 2, 5, 7);
    z = __builtin_shufflevector(yzyz, c, 1, 3, 4, 7);
}

// Of four vectors each one's (0 + 1) + (2 + 3).
[[gnu::always_inline]] inline FourFloats sumsOfLanes(const FourFloats* v) {
    const FourFloats low01 = __builtin_shufflevector(v[0], v[1], 0, 4, 1, 5);
    const FourFloats high01 = __builtin_shufflevector(v[0], v[1], 2, 6, 3, 7);
    const FourFloats low23 = __builtin_shufflevector(v[2], v[3], 0, 4, 1, 5);
    const FourFloats high23 = __builtin_shufflevector(v[2], v[3], 2, 6, 3, 7);
    return (__builtin_shufflevector(low01, low23, 0, 1, 4, 5) +
            __builtin_shufflevector(low01, low23, 2, 3, 6, 7)) +
           (__builtin_shufflevector(high01, high23, 0, 1, 4, 5) +
            __builtin_shufflevector(high01, high23, 2, 3, 6, 7));
}

// Azimuth sums of one image row: Σ_x L(x) {cos, sin}(m phi_x) for each channel.
struct RowSums {
    std::array<glm::dvec3, kMaxShOrder> cosine{}, sine{};
};

// `planes`: red, green and blue, one after another; `cosines`, `sines`: of m phi, m = 0 … order -
// 1, one after another; each `padded` long, a multiple of 16, zeros at the end.
template <int lanes>
[[gnu::always_inline]] inline void sumRow(const float* planes, const float* cosines,
                                          const float* sines, int padded, int order,
                                          RowSums& sums) {
    typedef float Lanes __attribute__((vector_size(lanes * sizeof(float)))); // NOLINT: GCC's
    for (int m = 0; m < order; ++m) {
        Lanes re[3] = {}, im[3] = {};
        for (int x = 0; x < padded; x += lanes) {
            Lanes cosine, sine;
            __builtin_memcpy(&cosine, cosines + static_cast<std::ptrdiff_t>(m) * padded + x,
                             sizeof(Lanes));
            __builtin_memcpy(&sine, sines + static_cast<std::ptrdiff_t>(m) * padded + x,
                             sizeof(Lanes));
            for (int c = 0; c < 3; ++c) {
                Lanes value;
                __builtin_memcpy(&value, planes + static_cast<std::ptrdiff_t>(c) * padded + x,
                                 sizeof(Lanes));
                re[c] += value * cosine;
                im[c] += value * sine;
            }
        }
        std::array<float, 3 * lanes> reLanes, imLanes;
        __builtin_memcpy(reLanes.data(), re, sizeof(re));
        __builtin_memcpy(imLanes.data(), im, sizeof(im));
        for (int i = 0; i < 3 * lanes; ++i) {
            sums.cosine[m][i / lanes] += reLanes[i];
            sums.sine[m][i / lanes] += imLanes[i];
        }
    }
}

using SumRow = void (*)(const float*, const float*, const float*, int, int, RowSums&);

void sumRowBaseline(const float* planes, const float* cosines, const float* sines, int padded,
                    int order, RowSums& sums) {
    sumRow<8>(planes, cosines, sines, padded, order, sums);
}

#if defined(__x86_64__)
[[gnu::target("avx2,fma")]] void sumRowAvx2(const float* planes, const float* cosines,
                                            const float* sines, int padded, int order,
                                            RowSums& sums) {
    sumRow<16>(planes, cosines, sines, padded, order, sums);
}
#endif

// For the widest instructions this machine has.
SumRow chooseSumRow() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return sumRowAvx2;
#endif
    return sumRowBaseline;
}

} // namespace

int shOrderOf(std::size_t coefficients) {
    const int order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(coefficients))));
    CHECK(order >= 1 && order <= kMaxShOrder);
    CHECK_EQ(static_cast<std::size_t>(shCount(order)), coefficients);
    return order;
}

void evaluateSh(int order, const glm::dvec3& direction, std::span<double> out) {
    evaluateOne(order, direction, out);
}

void evaluateSh(int order, const glm::vec3& direction, std::span<float> out) {
    evaluateOne(order, direction, out);
}

void sumSh(int order, std::span<const glm::vec3> directions, std::span<float> sums) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    CHECK_LE(static_cast<std::size_t>(shCount(order)), sums.size());
    if (directions.empty())
        return;
    withOrder(order, [&]<int constantOrder>() {
        constexpr int kCount = shCount(constantOrder);
        const glm::vec3* d = directions.data();
        std::size_t left = directions.size();
        FourFloats total[(kCount + 3) / 4 * 4] = {}, x, y, z;
        for (; left >= 4; left -= 4, d += 4) {
            loadFour(d, x, y, z);
            evaluate<constantOrder, float>(
                x, y, z, [&](int i, const FourFloats& value) { total[i] += value; });
        }
        if (left > 0) { // the last few, in lanes that count and lanes that do not
            constexpr FourFloats kCounts[4] = {
                {0, 0, 0, 0}, {1, 0, 0, 0}, {1, 1, 0, 0}, {1, 1, 1, 0}};
            glm::vec3 last[4] = {};
            std::copy_n(d, left, last);
            loadFour(last, x, y, z);
            evaluate<constantOrder, float>(x, y, z, [&](int i, const FourFloats& value) {
                total[i] += kCounts[left] * value;
            });
        }
        for (int i = 0; i < kCount; i += 4) {
            const FourFloats four = sumsOfLanes(total + i);
            for (int k = 0; k < std::min(4, kCount - i); ++k)
                sums[i + k] += four[k];
        }
    });
}

double cosineConvolution(int l) {
    CHECK_LE(0, l);
    if (l == 1)
        return 2.0 * std::numbers::pi / 3.0;
    if (l % 2 == 1)
        return 0.0;
    // A_0 = pi; A_l = A_l-2 * -(l - 3) / (l + 2), from the quotient of the closed forms
    // 2 pi (-1)^(l/2-1) / ((l+2)(l-1)) * l! / (2^l ((l/2)!)²).
    double a = std::numbers::pi;
    for (int k = 2; k <= l; k += 2)
        a *= -(k - 3.0) / (k + 2.0);
    return a;
}

void convolveWithCosine(std::span<glm::vec3> coefficients) {
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
        const int l = static_cast<int>(std::sqrt(static_cast<double>(i) + 0.5));
        coefficients[i] *= static_cast<float>(cosineConvolution(l));
    }
}

std::vector<glm::vec3> projectLatLong(const Image& environment, int order, const JobContext& job) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    CHECK(environment.type() == PixelType::F32);
    CHECK_LE(3, environment.channels());
    const int width = environment.width(), height = environment.height();
    const int channels = environment.channels();
    const std::span<const float> texels = environment.f32();

    // In the image's own frame (zonal axis = its pole, +Y of the world) the basis separates into
    // azimuth and latitude: a texel costs 2·order - 1 products, not order² basis values.
    // Azimuth phi grows with u from 0 at the image's left edge.
    constexpr int kPad = 16;
    const int padded = (width + kPad - 1) / kPad * kPad;
    std::vector<float> cosines(static_cast<std::size_t>(order) * padded);
    std::vector<float> sines(cosines.size());
    for (int m = 0; m < order; ++m)
        for (int x = 0; x < width; ++x) {
            const double phi = 2.0 * std::numbers::pi * (x + 0.5) / width;
            cosines[static_cast<std::size_t>(m) * padded + x] =
                static_cast<float>(std::cos(m * phi));
            sines[static_cast<std::size_t>(m) * padded + x] = static_cast<float>(std::sin(m * phi));
        }

    std::vector<RowSums> rows(height);
    const SumRow sumOneRow = chooseSumRow();
    parallelFor(job, height, 16, [&](std::size_t begin, std::size_t end) {
        std::vector<float> planes(3 * static_cast<std::size_t>(padded), 0.0f);
        for (std::size_t y = begin; y < end; ++y) {
            const float* source = texels.data() + y * width * channels;
            float *red = planes.data(), *green = red + padded, *blue = green + padded;
            const auto separate = [&](int stride) {
                for (int x = 0; x < width; ++x) {
                    red[x] = source[x * stride];
                    green[x] = source[x * stride + 1];
                    blue[x] = source[x * stride + 2];
                }
            };
            if (channels == 3) // a constant stride becomes SIMD
                separate(3);
            else
                separate(channels);
            sumOneRow(planes.data(), cosines.data(), sines.data(), padded, order, rows[y]);
        }
    });

    // Latitude: ∫ P(l, m) sin^m(theta) sin(theta) dtheta over the row, by Gauss-Legendre in theta,
    // in which the integrand is smooth up to the pole; the error is below 1e-14 even for one row.
    // Azimuth: a texel's ∫ cos(m phi) dphi is its centre's value times the sinc below.
    const GaussLegendre rule(4 + 16 / height);
    std::array<double, kMaxShOrder> azimuth{}; // sinc times the texel's width
    for (int m = 0; m < order; ++m) {
        const double half = m * std::numbers::pi / width;
        azimuth[m] = (m == 0 ? 1.0 : std::sin(half) / half) * 2.0 * std::numbers::pi / width;
    }
    std::vector<glm::dvec3> local(shCount(order), glm::dvec3(0.0));
    for (int y = 0; y < height; ++y) {
        for (int node = 0; node < rule.size(); ++node) {
            const double theta = std::numbers::pi * (y + rule.node01(node)) / height;
            const double z = std::cos(theta), sinTheta = std::sin(theta);
            const double extent = sinTheta * std::numbers::pi / height;
            std::array<double, kMaxShOrder> sinPower{};
            sinPower[0] = 1.0;
            for (int m = 1; m < order; ++m)
                sinPower[m] = sinPower[m - 1] * sinTheta;
            forEachLegendre<double>(order, z, [&](int l, int m, double p) {
                const double weight = p * sinPower[m] * azimuth[m] * extent * rule.weight01(node);
                local[shIndex(l, m)] += rows[y].cosine[m] * weight;
                if (m > 0)
                    local[shIndex(l, -m)] += rows[y].sine[m] * weight;
            });
        }
    }

    // From the image's frame to the world's. phi = 0 is the left edge, +Z of the world; phi = pi/2
    // is a quarter to the right, -X. Columns: where the frame's x, y and z axes lie in the world.
    // The frame is left-handed, because u grows clockwise as seen from above.
    const glm::dmat3 frame(glm::dvec3(0, 0, 1), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0));
    const ShRotation toWorld(frame, order);
    std::vector<glm::vec3> result(shCount(order));
    for (int l = 0; l < order; ++l)
        for (int row = -l; row <= l; ++row) {
            glm::dvec3 sum(0.0);
            for (int column = -l; column <= l; ++column)
                sum += toWorld.element(l, row, column) * local[shIndex(l, column)];
            result[shIndex(l, row)] = glm::vec3(sum);
        }
    return result;
}

} // namespace patina
