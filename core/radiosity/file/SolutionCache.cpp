#include "core/radiosity/file/SolutionCache.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <system_error>
#include <utility>

namespace patina::radiosity {
namespace {

constexpr std::size_t kMaxSolutionFile = std::size_t{8} << 30;
constexpr std::uint64_t kMostRounds = 64;

struct SolutionHead {
    std::uint64_t elements = 0;
    double residual = 0.0;
    std::int64_t sweeps = 0;
};
struct DivisionHead {
    Hash elements;
    std::uint64_t rounds = 0;
};
static_assert(sizeof(SolutionHead) == 24 && sizeof(DivisionHead) == 24 && sizeof(glm::dvec3) == 24);

void appendBytes(Bytes& bytes, std::span<const std::byte> piece) {
    bytes.insert(bytes.end(), piece.begin(), piece.end());
}
template <class T>
void appendValue(Bytes& bytes, const T& value) {
    appendBytes(bytes, std::as_bytes(std::span<const T>(&value, 1)));
}

// The next of `left`; false where that ends early.
bool takeBytes(std::span<const std::byte>& left, std::span<std::byte> to) {
    if (left.size() < to.size())
        return false;
    if (!to.empty())
        std::memcpy(to.data(), left.data(), to.size());
    left = left.subspan(to.size());
    return true;
}
template <class T>
bool takeValue(std::span<const std::byte>& left, T& value) {
    return takeBytes(left, std::as_writable_bytes(std::span<T>(&value, 1)));
}

bool isFiniteLight(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Bounced light may be below zero where a solver shoots ahead of what will be received.
bool isPlausibleSolution(const KeptSolution& solution) {
    return std::isfinite(solution.residual) && solution.residual >= 0.0 && solution.sweeps >= 0 &&
           std::ranges::all_of(solution.bounced, isFiniteLight) &&
           std::ranges::all_of(solution.direct, [](const glm::dvec3& v) {
               return isFiniteLight(v) && v.x >= 0.0 && v.y >= 0.0 && v.z >= 0.0;
           });
}

std::optional<KeptSolution> solutionFrom(std::span<const std::byte> left, std::size_t elements) {
    SolutionHead head;
    if (!takeValue(left, head) || head.elements != elements ||
        left.size() != 2 * elements * sizeof(glm::dvec3))
        return std::nullopt;
    KeptSolution solution;
    solution.residual = head.residual;
    solution.sweeps = static_cast<int>(head.sweeps);
    for (std::vector<glm::dvec3>* light : {&solution.direct, &solution.bounced}) {
        light->resize(elements);
        takeBytes(left, std::as_writable_bytes(std::span(*light)));
    }
    return isPlausibleSolution(solution) ? std::optional(std::move(solution)) : std::nullopt;
}

std::optional<KeptDivision> divisionFrom(std::span<const std::byte> left) {
    DivisionHead head;
    if (!takeValue(left, head) || head.rounds > kMostRounds)
        return std::nullopt;
    KeptDivision division;
    division.elements = head.elements;
    for (std::uint64_t round = 0; round < head.rounds; ++round) {
        std::uint64_t count = 0;
        if (!takeValue(left, count) || count > left.size() / sizeof(std::uint32_t))
            return std::nullopt;
        division.rounds.emplace_back(count);
        takeBytes(left, std::as_writable_bytes(std::span(division.rounds.back())));
    }
    return left.empty() ? std::optional(std::move(division)) : std::nullopt;
}

} // namespace

SolutionCache::SolutionCache(std::filesystem::path folder, std::uint64_t maxBytes)
    : m_files(std::move(folder), ".radiosity", "radiosity", maxBytes, kMaxSolutionFile) {}

std::optional<KeptSolution> SolutionCache::find(const Hash& key, std::size_t elements) const {
    const std::optional<Bytes> content = m_files.find(key);
    if (!content)
        return std::nullopt;
    std::optional<KeptSolution> solution = solutionFrom(*content, elements);
    if (!solution)
        drop(key);
    return solution;
}

std::optional<KeptDivision> SolutionCache::findDivision(const Hash& key) const {
    const std::optional<Bytes> content = m_files.find(key);
    if (!content)
        return std::nullopt;
    std::optional<KeptDivision> division = divisionFrom(*content);
    if (!division)
        drop(key);
    return division;
}

bool SolutionCache::has(const Hash& key) const {
    std::error_code ignored;
    return std::filesystem::exists(file(key), ignored);
}

Result<void> SolutionCache::store(const Hash& key, const KeptSolution& solution) const {
    Bytes content;
    content.reserve(sizeof(SolutionHead) + 2 * solution.direct.size() * sizeof(glm::dvec3));
    appendValue(content, SolutionHead{solution.direct.size(), solution.residual,
                                      std::int64_t{solution.sweeps}});
    appendBytes(content, std::as_bytes(std::span(solution.direct)));
    appendBytes(content, std::as_bytes(std::span(solution.bounced)));
    return m_files.store(key, content);
}

Result<void> SolutionCache::store(const Hash& key, const KeptDivision& division) const {
    Bytes content;
    appendValue(content, DivisionHead{division.elements, division.rounds.size()});
    for (const std::vector<std::uint32_t>& round : division.rounds) {
        appendValue(content, std::uint64_t{round.size()});
        appendBytes(content, std::as_bytes(std::span(round)));
    }
    return m_files.store(key, content);
}

bool divideAgain(const KeptDivision& division, ElementMesh& elements) {
    for (const std::vector<std::uint32_t>& round : division.rounds) {
        const bool ascends =
            std::ranges::adjacent_find(round, std::ranges::greater_equal{}) == round.end();
        if (!ascends || (!round.empty() && round.back() >= elements.size()))
            return false;
        elements.divide(round);
    }
    return true;
}

} // namespace patina::radiosity
