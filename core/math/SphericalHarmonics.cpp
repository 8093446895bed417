#include "core/math/SphericalHarmonics.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/Quadrature.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace patina {

namespace {

constexpr double kPi = std::numbers::pi;

// Factors of the normalised Legendre recurrences in l, so that evaluation takes no square roots:
//   P(m, m)     = start[m]                       (times sin^m, which the azimuth factors carry)
//   P(l, m)     = a[l][m] z P(l-1, m) - b[l][m] P(l-2, m)
// The factor sqrt(2) of m > 0 and the Condon-Shortley sign are part of start[m].
struct Recurrence {
    std::array<double, kMaxShOrder> start{};
    std::array<std::array<double, kMaxShOrder>, kMaxShOrder> a{}, b{};

    Recurrence() {
        double normalisation = std::sqrt(1.0 / (4.0 * kPi));
        start[0] = normalisation;
        for (int m = 1; m < kMaxShOrder; ++m) {
            normalisation *= -std::sqrt((2.0 * m + 1.0) / (2.0 * m));
            start[m] = normalisation * std::numbers::sqrt2;
        }
        for (int m = 0; m < kMaxShOrder; ++m)
            for (int l = m + 1; l < kMaxShOrder; ++l) {
                const double l2 = l * l, m2 = m * m;
                a[l][m] = std::sqrt((4.0 * l2 - 1.0) / (l2 - m2));
                b[l][m] = l == m + 1 ? 0.0
                                     : std::sqrt((2.0 * l + 1.0) * ((l - 1.0) * (l - 1.0) - m2) /
                                                 ((2.0 * l - 3.0) * (l2 - m2)));
            }
    }
};

const Recurrence& recurrence() {
    static const Recurrence factors;
    return factors;
}

// Calls visit(l, m, P) for m >= 0 and l = m … order-1, where Y_l,±m = P (sin^m) {cos, sin}(m phi).
template <class Real, class Visit>
void forEachLegendre(int order, Real z, Visit&& visit) {
    const Recurrence& f = recurrence();
    for (int m = 0; m < order; ++m) {
        Real previous = 0, current = static_cast<Real>(f.start[m]);
        visit(m, m, current);
        for (int l = m + 1; l < order; ++l) {
            const Real next = static_cast<Real>(f.a[l][m]) * z * current -
                              static_cast<Real>(f.b[l][m]) * previous;
            previous = current;
            current = next;
            visit(l, m, current);
        }
    }
}

template <class Real>
void evaluate(int order, Real x, Real y, Real z, std::span<Real> out) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    CHECK_LE(static_cast<std::size_t>(shCount(order)), out.size());
    // sin^m(theta) {cos, sin}(m phi) are the real and imaginary parts of (x + iy)^m.
    std::array<Real, kMaxShOrder> re{}, im{};
    re[0] = 1;
    for (int m = 1; m < order; ++m) {
        re[m] = x * re[m - 1] - y * im[m - 1];
        im[m] = x * im[m - 1] + y * re[m - 1];
    }
    forEachLegendre(order, z, [&](int l, int m, Real p) {
        out[shIndex(l, m)] = p * re[m];
        if (m > 0)
            out[shIndex(l, -m)] = p * im[m];
    });
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

void evaluateSh(int order, const glm::dvec3& d, std::span<double> out) {
    evaluate<double>(order, d.x, d.y, d.z, out);
}

void evaluateSh(int order, const glm::vec3& d, std::span<float> out) {
    evaluate<float>(order, d.x, d.y, d.z, out);
}

double cosineConvolution(int l) {
    CHECK_LE(0, l);
    if (l == 1)
        return 2.0 * kPi / 3.0;
    if (l % 2 == 1)
        return 0.0;
    // A_0 = pi; A_l = A_l-2 * -(l - 3) / (l + 2), from the quotient of the closed forms
    // 2 pi (-1)^(l/2-1) / ((l+2)(l-1)) * l! / (2^l ((l/2)!)²).
    double a = kPi;
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
            const double phi = 2.0 * kPi * (x + 0.5) / width;
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
        const double half = m * kPi / width;
        azimuth[m] = (m == 0 ? 1.0 : std::sin(half) / half) * 2.0 * kPi / width;
    }
    std::vector<glm::dvec3> local(shCount(order), glm::dvec3(0.0));
    for (int y = 0; y < height; ++y) {
        for (int node = 0; node < rule.size(); ++node) {
            const double theta = kPi * (y + rule.node01(node)) / height;
            const double z = std::cos(theta), sinTheta = std::sin(theta);
            const double extent = sinTheta * kPi / height;
            std::array<double, kMaxShOrder> sinPower{};
            sinPower[0] = 1.0;
            for (int m = 1; m < order; ++m)
                sinPower[m] = sinPower[m - 1] * sinTheta;
            forEachLegendre(order, z, [&](int l, int m, double p) {
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

ShRotation::ShRotation(const glm::dmat3& rotation, int order)
    : m_order(order) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    std::size_t size = 0;
    for (int l = 0; l < order; ++l)
        size += static_cast<std::size_t>(2 * l + 1) * (2 * l + 1);
    m_elements.assign(size, 0.0);

    // M_ij = ∫ Y_i(R d) Y_j(d) dd. The integrand is a polynomial of degree 2(order - 1), which
    // Gauss-Legendre in z times equal steps in azimuth integrates exactly.
    const GaussLegendre rule(order);
    const int azimuths = 2 * order;
    std::array<double, kMaxShOrder * kMaxShOrder> from{}, to{};
    for (int i = 0; i < rule.size(); ++i) {
        const double z = 2.0 * rule.node01(i) - 1.0;
        const double sinTheta = std::sqrt(1.0 - z * z);
        const double weight = 2.0 * rule.weight01(i) * 2.0 * kPi / azimuths;
        for (int k = 0; k < azimuths; ++k) {
            const double phi = 2.0 * kPi * k / azimuths;
            const glm::dvec3 d(sinTheta * std::cos(phi), sinTheta * std::sin(phi), z);
            evaluateSh(order, d, from);
            evaluateSh(order, rotation * d, to);
            double* element = m_elements.data();
            for (int l = 0; l < order; ++l)
                for (int row = -l; row <= l; ++row)
                    for (int column = -l; column <= l; ++column)
                        *element++ += weight * to[shIndex(l, row)] * from[shIndex(l, column)];
        }
    }
}

ShRotation ShRotation::aboutAxis(const glm::dvec3& axis, double angleRad, int order) {
    return {glm::dmat3(glm::rotate(glm::dmat4(1.0), angleRad, glm::normalize(axis))), order};
}

double ShRotation::element(int l, int row, int column) const {
    CHECK(l >= 0 && l < m_order && std::abs(row) <= l && std::abs(column) <= l);
    // Bands below l hold Σ (2k+1)² = l (2l - 1)(2l + 1) / 3 elements.
    const int start = l * (2 * l - 1) * (2 * l + 1) / 3;
    return m_elements[start + (row + l) * (2 * l + 1) + (column + l)];
}

void ShRotation::apply(std::span<const glm::vec3> in, std::span<glm::vec3> out) const {
    CHECK_EQ(in.size(), static_cast<std::size_t>(shCount(m_order)));
    CHECK_EQ(out.size(), in.size());
    const double* element = m_elements.data();
    for (int l = 0; l < m_order; ++l)
        for (int row = -l; row <= l; ++row) {
            glm::dvec3 sum(0.0);
            for (int column = -l; column <= l; ++column)
                sum += *element++ * glm::dvec3(in[shIndex(l, column)]);
            out[shIndex(l, row)] = glm::vec3(sum);
        }
}

void ShRotation::apply(std::span<const float> in, std::span<float> out) const {
    CHECK_EQ(in.size(), static_cast<std::size_t>(shCount(m_order)));
    CHECK_EQ(out.size(), in.size());
    const double* element = m_elements.data();
    for (int l = 0; l < m_order; ++l)
        for (int row = -l; row <= l; ++row) {
            double sum = 0.0;
            for (int column = -l; column <= l; ++column)
                sum += *element++ * in[shIndex(l, column)];
            out[shIndex(l, row)] = static_cast<float>(sum);
        }
}

} // namespace patina
