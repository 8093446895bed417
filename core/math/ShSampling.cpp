#include "core/math/ShSampling.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/Sampling.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace patina {

namespace {

using Sums = std::array<glm::dvec3, kMaxShOrder * kMaxShOrder>;

// Blocks of one size are summed each in order and then one after another, on whatever threads.
template <class PointAt>
std::vector<glm::vec3> project(const SphereFunction& f, int order, std::uint64_t count,
                               const JobContext& job, PointAt&& pointAt) {
    CHECK(order >= 1 && order <= kMaxShOrder);
    constexpr std::uint64_t kBlock = 1024;
    const auto coefficients = static_cast<std::size_t>(shCount(order));
    std::vector<Sums> blocks((count + kBlock - 1) / kBlock, Sums{});
    parallelFor(job, blocks.size(), 1, [&](std::size_t begin, std::size_t end) {
        std::array<double, kMaxShOrder * kMaxShOrder> y{};
        for (std::size_t block = begin; block < end; ++block)
            for (std::uint64_t i = block * kBlock; i < std::min(count, (block + 1) * kBlock); ++i) {
                const glm::vec3 direction = uniformSphere(pointAt(i));
                const glm::dvec3 value(f(direction));
                evaluateSh(order, glm::dvec3(direction), y);
                for (std::size_t k = 0; k < coefficients; ++k)
                    blocks[block][k] += y[k] * value;
            }
    });
    std::vector<glm::vec3> result(coefficients);
    for (std::size_t k = 0; k < coefficients; ++k) {
        glm::dvec3 sum(0.0);
        for (const Sums& block : blocks)
            sum += block[k];
        result[k] = glm::vec3(sum * (4.0 * std::numbers::pi / static_cast<double>(count)));
    }
    return result;
}

} // namespace

std::vector<glm::vec3> projectStratified(const SphereFunction& f, int order, int side,
                                         std::uint32_t seed, const JobContext& job) {
    CHECK(side >= 1 && side <= 32768);
    const auto columns = static_cast<std::uint64_t>(side);
    return project(f, order, columns * columns, job, [&](std::uint64_t i) {
        const std::uint32_t cell = seedFor(seed, static_cast<std::uint32_t>(i));
        const glm::vec2 inside(detail::unitFloat(hash32(cell)),
                               detail::unitFloat(hash32(cell ^ 0x68bc21ebu)));
        return (glm::vec2(i % columns, i / columns) + inside) / static_cast<float>(side);
    });
}

std::vector<glm::vec3> projectSobol(const SphereFunction& f, int order, std::uint32_t count,
                                    std::uint32_t seed, const JobContext& job) {
    CHECK_LE(1u, count);
    return project(f, order, count, job, [&](std::uint64_t i) {
        return sobolOwen2D(static_cast<std::uint32_t>(i), seed);
    });
}

} // namespace patina
