#include "core/bake/domain/HemisphereSamples.h"

#include "core/base/Check.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace patina {
namespace {

// How far along the curve that fills the unit square: directions that follow each other are
// neighbours, and their rays travel together. Warren 2012, "Hacker's Delight", section 16-1.
std::uint32_t alongHilbertCurve(const glm::vec2& u) {
    constexpr std::uint32_t kSide = 1u << 12;
    auto x = static_cast<std::uint32_t>(u.x * static_cast<float>(kSide));
    auto y = static_cast<std::uint32_t>(u.y * static_cast<float>(kSide));
    std::uint32_t distance = 0;
    for (std::uint32_t half = kSide / 2; half > 0; half /= 2) {
        const std::uint32_t right = (x & half) != 0 ? 1 : 0, upper = (y & half) != 0 ? 1 : 0;
        distance += half * half * ((3 * right) ^ upper);
        if (upper == 0) { // turn the quarter
            if (right == 1) {
                x = kSide - 1 - x;
                y = kSide - 1 - y;
            }
            std::swap(x, y);
        }
    }
    return distance;
}

} // namespace

HemisphereSamples::HemisphereSamples(std::uint32_t seed, std::uint32_t first, std::uint32_t count,
                                     SampleMethod method)
    : m_first(first)
    , m_count(count)
    , m_method(method) {
    if (method != SampleMethod::Qmc)
        return;
    m_directions.reserve(std::size_t{kSequences} * count);
    std::vector<std::pair<std::uint32_t, glm::vec2>> points(count);
    for (std::uint32_t sequence = 0; sequence < kSequences; ++sequence) {
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::vec2 u = sobolOwen2D(first + i, seedFor(seed, sequence));
            points[i] = {alongHilbertCurve(u), u};
        }
        // Few places are taken twice; sorted by a stable sort those are alike everywhere too.
        std::ranges::stable_sort(points, {}, &std::pair<std::uint32_t, glm::vec2>::first);
        for (const auto& [place, u] : points)
            m_directions.push_back(cosineHemisphere(u));
    }
}

glm::vec2 HemisphereSamples::turn(std::uint32_t elementSeed) {
    // kSequences is a power of two: the bits above pick the angle.
    const float angle = static_cast<float>(elementSeed / kSequences) *
                        (2.0f * shading::kPi / (4294967296.0f / kSequences));
    return {std::cos(angle), std::sin(angle)};
}

glm::mat3 HemisphereSamples::frame(const glm::vec3& normal, const glm::vec2& turn) {
    glm::vec3 t, b;
    orthonormalBasis(normal, t, b);
    return {turn.x * t + turn.y * b, turn.x * b - turn.y * t, normal};
}

std::span<const glm::vec3> HemisphereSamples::drawn(std::uint32_t elementSeed,
                                                    std::vector<glm::vec3>& scratch) const {
    scratch.resize(m_count);
    const auto side = static_cast<std::uint32_t>(std::lround(std::sqrt(m_count)));
    CHECK(m_method == SampleMethod::Random || (m_first == 0 && side * side == m_count));
    for (std::uint32_t i = 0; i < m_count; ++i) {
        const std::uint32_t hash = seedFor(elementSeed, m_first + i);
        glm::vec2 u(detail::unitFloat(hash), detail::unitFloat(hash32(hash ^ 0x9e3779b9u)));
        if (m_method == SampleMethod::Stratified) // one in each cell of an N × N grid
            u = (u + glm::vec2(i % side, i / side)) / static_cast<float>(side);
        scratch[i] = cosineHemisphere(u);
    }
    return scratch;
}

} // namespace patina
