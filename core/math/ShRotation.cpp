#include "core/math/ShRotation.h"

#include "core/base/Check.h"
#include "core/math/Quadrature.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace patina {

namespace {

// Pinchon & Hoggan 2007, "Rotation matrices for real spherical harmonics: general rotations of
// atomic orbitals in space-fixed axes": with S the swap of y and z,
//   R = Rz(α) Ry(β) Rz(γ),  Ry(β) = S Rz(-β) S,
// and the same holds for the matrices of a band, of which Rz's only mixes m with -m and S's, J, is
// constant. J is sparse: it trades the parity in y for that in z and keeps that in x, so that a row
// has at most (l + 1) / 2 elements.
constexpr int kSwapElements = kMaxShOrder / 2;

struct SwapRow {
    std::array<int, kSwapElements> column{}; // m; where there are fewer, elements of value 0
    std::array<double, kSwapElements> value{};
};

struct Swap {
    std::array<SwapRow, kMaxShOrder * kMaxShOrder> rows{}; // by shIndex

    // J_ij = ∫ Y_i(S d) Y_j(d) dd, whose integrand Gauss-Legendre in z times equal steps in azimuth
    // integrates exactly.
    Swap() {
        constexpr int kCount = kMaxShOrder * kMaxShOrder, kAzimuths = 2 * kMaxShOrder;
        std::array<std::array<double, kCount>, kCount> matrix{};
        const GaussLegendre rule(kMaxShOrder);
        std::array<double, kCount> from{}, to{};
        for (int i = 0; i < rule.size(); ++i)
            for (int k = 0; k < kAzimuths; ++k) {
                const double z = 2.0 * rule.node01(i) - 1.0, r = std::sqrt(1.0 - z * z);
                const double phi = 2.0 * std::numbers::pi * k / kAzimuths;
                const double x = r * std::cos(phi), y = r * std::sin(phi);
                const double weight = 2.0 * rule.weight01(i) * 2.0 * std::numbers::pi / kAzimuths;
                evaluateSh(kMaxShOrder, glm::dvec3(x, y, z), from);
                evaluateSh(kMaxShOrder, glm::dvec3(x, z, y), to);
                for (int row = 0; row < kCount; ++row)
                    for (int column = 0; column < kCount; ++column)
                        matrix[row][column] += weight * to[row] * from[column];
            }
        for (int l = 0; l < kMaxShOrder; ++l)
            for (int m = -l; m <= l; ++m) {
                int found = 0;
                for (int column = -l; column <= l; ++column) {
                    const double value = matrix[shIndex(l, m)][shIndex(l, column)];
                    if (std::abs(value) < 1e-9)
                        continue; // zero but for rounding: the least element is above 0.01
                    CHECK_LT(found, kSwapElements);
                    rows[shIndex(l, m)].column[found] = column;
                    rows[shIndex(l, m)].value[found++] = value;
                }
            }
    }
};

const Swap& swapYZ() {
    static const Swap swap;
    return swap;
}

// cos(m a) and sin(m a) for m = 0 … kMaxShOrder - 1.
struct Multiples {
    std::array<double, kMaxShOrder> cosine{}, sine{};

    // Of the angle from the x axis to (x, y); of zero where there is none.
    Multiples(double x, double y) {
        const double r = std::hypot(x, y);
        const double c = r > 0.0 ? x / r : 1.0, s = r > 0.0 ? y / r : 0.0;
        cosine[0] = 1.0;
        for (int m = 1; m < kMaxShOrder; ++m) {
            cosine[m] = cosine[m - 1] * c - sine[m - 1] * s;
            sine[m] = sine[m - 1] * c + cosine[m - 1] * s;
        }
    }
    // The row m of Rz's matrix: its elements at columns m and -m.
    [[nodiscard]] double atSame(int m) const { return cosine[std::abs(m)]; }
    [[nodiscard]] double atOpposite(int m) const { return m > 0 ? -sine[m] : sine[-m]; }
};

} // namespace

ShRotation::ShRotation(const glm::dmat3& rotation, int order)
    : m_order(order) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    // A mirror image is a rotation of the opposite direction, and Y_l(-d) = (-1)^l Y_l(d).
    const bool mirror = glm::determinant(rotation) < 0.0;
    const glm::dmat3 r = mirror ? -rotation : rotation; // r[column][row]

    // α from where the zonal axis goes; β and γ from what is left when α is undone, which keeps
    // their sum exact where the axis stays and α could be anything.
    const Multiples alpha(r[2][0], r[2][1]);
    const double c = alpha.cosine[1], s = alpha.sine[1];
    const Multiples minusBeta(r[2][2], -(c * r[2][0] + s * r[2][1]));
    const Multiples gamma(c * r[1][1] - s * r[1][0], c * r[0][1] - s * r[0][0]);

    const Swap& swap = swapYZ();
    m_elements.resize(static_cast<std::size_t>(order) * (2 * order - 1) * (2 * order + 1) / 3);
    double* band = m_elements.data();
    for (int l = 0; l < order; ++l) {
        const int size = 2 * l + 1;
        std::array<std::array<double, 2 * kMaxShOrder - 1>, 2 * kMaxShOrder - 1> turned{};
        // J Rz(-β) J
        for (int row = -l; row <= l; ++row) {
            double* out = turned[row + l].data() + l;
            const auto add = [&](int middle, double factor) {
                const SwapRow& second = swap.rows[shIndex(l, middle)];
                for (int k = 0; k < kSwapElements; ++k)
                    out[second.column[k]] += factor * second.value[k];
            };
            const SwapRow& first = swap.rows[shIndex(l, row)];
            for (int k = 0; k < kSwapElements; ++k) {
                const int m = first.column[k];
                add(m, first.value[k] * minusBeta.atSame(m));
                add(-m, first.value[k] * minusBeta.atOpposite(m));
            }
        }
        // Rz(α) on its left, Rz(γ) on its right
        const double sign = mirror && l % 2 == 1 ? -1.0 : 1.0;
        for (int row = -l; row <= l; ++row) {
            const double same = sign * alpha.atSame(row), opposite = sign * alpha.atOpposite(row);
            std::array<double, 2 * kMaxShOrder - 1> mixed{};
            for (int i = 0; i < size; ++i)
                mixed[i] = same * turned[l + row][i] + opposite * turned[l - row][i];
            for (int column = -l; column <= l; ++column)
                band[(row + l) * size + column + l] = mixed[l + column] * gamma.atSame(column) +
                                                      mixed[l - column] * gamma.atOpposite(-column);
        }
        band += size * size;
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
