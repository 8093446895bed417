#include "core/math/ShProduct.h"

#include "core/base/Check.h"
#include "core/math/Quadrature.h"
#include "core/math/SphericalHarmonics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace patina {

namespace {

constexpr int kCount = kMaxShOrder * kMaxShOrder;

int bandOf(int i) {
    int l = 0;
    while (shCount(l + 1) <= i)
        ++l;
    return l;
}

// Calls visit(direction, weight) for a product rule that is exact up to degree 2 heights - 1.
template <class Visit>
void forEachNode(int heights, Visit&& visit) {
    const GaussLegendre rule(heights);
    const int azimuths = 2 * heights;
    for (int h = 0; h < heights; ++h) {
        const double z = 2.0 * rule.node01(h) - 1.0, r = std::sqrt(1.0 - z * z);
        const double weight = 2.0 * rule.weight01(h) * 2.0 * std::numbers::pi / azimuths;
        for (int a = 0; a < azimuths; ++a) {
            const double phi = 2.0 * std::numbers::pi * (a + 0.5) / azimuths;
            visit(glm::dvec3(r * std::cos(phi), r * std::sin(phi), z), weight);
        }
    }
}

// A product of three is a polynomial of degree 21 at most.
struct Node {
    double weight;
    std::array<double, kCount> y;
};
const std::vector<Node>& tripleNodes() {
    static const std::vector<Node> nodes = [] {
        std::vector<Node> result;
        forEachNode(12, [&](const glm::dvec3& direction, double weight) {
            Node& node = result.emplace_back();
            node.weight = weight;
            evaluateSh(kMaxShOrder, direction, node.y);
        });
        return result;
    }();
    return nodes;
}

// Which of Γ may differ from 0: |l1 - l2| <= l3 <= l1 + l2, an even sum, one |m| the sum or
// difference of the others and an even number of sines.
bool mayCouple(int i, int j, int k) {
    const int a = bandOf(i), b = bandOf(j), c = bandOf(k);
    if ((a + b + c) % 2 == 1 || c > a + b || c < std::abs(a - b))
        return false;
    const int p = i - shIndex(a, 0), q = j - shIndex(b, 0), r = k - shIndex(c, 0);
    if (((p < 0) + (q < 0) + (r < 0)) % 2 == 1)
        return false;
    const int sum = std::abs(p) + std::abs(q), difference = std::abs(std::abs(p) - std::abs(q));
    return std::abs(r) == sum || std::abs(r) == difference;
}

} // namespace

double gaunt(int i, int j, int k) {
    CHECK(i >= 0 && i < kCount && j >= 0 && j < kCount && k >= 0 && k < kCount);
    if (!mayCouple(i, j, k))
        return 0.0;
    double sum = 0.0;
    for (const Node& node : tripleNodes())
        sum += node.weight * node.y[i] * node.y[j] * node.y[k];
    return sum;
}

ShProduct::ShProduct(int order)
    : m_order(order) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    const int count = shCount(order);
    for (int k = 0; k < count; ++k)
        for (int i = 0; i < count; ++i)
            for (int j = 0; j <= i; ++j)
                if (const double value = gaunt(i, j, k); std::abs(value) > 1e-12) {
                    const auto term = [&](int first, int second) {
                        m_terms.push_back({static_cast<std::uint8_t>(first),
                                           static_cast<std::uint8_t>(second),
                                           static_cast<std::uint8_t>(k), value});
                    };
                    term(i, j);
                    if (i != j)
                        term(j, i);
                }
}

void ShProduct::multiply(std::span<const glm::vec3> light, std::span<const float> scalar,
                         std::span<glm::vec3> out) const {
    const auto count = static_cast<std::size_t>(shCount(m_order));
    CHECK_EQ(light.size(), count);
    CHECK_EQ(scalar.size(), count);
    CHECK_EQ(out.size(), count);
    std::array<glm::dvec3, kCount> sums{};
    for (const Term& term : m_terms)
        sums[term.k] +=
            term.value * static_cast<double>(scalar[term.j]) * glm::dvec3(light[term.i]);
    for (std::size_t k = 0; k < count; ++k)
        out[k] = glm::vec3(sums[k]);
}

void multiplyByFunction(std::span<const glm::vec3> light,
                        const std::function<double(const glm::dvec3& direction)>& scalar,
                        int resolution, std::span<glm::vec3> out) {
    const int inOrder = shOrderOf(light.size()), outOrder = shOrderOf(out.size());
    CHECK_LE(1, resolution);
    std::array<glm::dvec3, kCount> sums{};
    std::array<double, kCount> y{};
    forEachNode(resolution, [&](const glm::dvec3& direction, double weight) {
        evaluateSh(std::max(inOrder, outOrder), direction, y);
        glm::dvec3 radiance(0.0);
        for (int i = 0; i < shCount(inOrder); ++i)
            radiance += y[i] * glm::dvec3(light[i]);
        radiance *= weight * scalar(direction);
        for (int i = 0; i < shCount(outOrder); ++i)
            sums[i] += y[i] * radiance;
    });
    for (int i = 0; i < shCount(outOrder); ++i)
        out[i] = glm::vec3(sums[i]);
}

} // namespace patina
