#include "core/radiosity/FactorMatrix.h"

#include "core/job/Parallel.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>

namespace patina::radiosity {

FactorMatrix FactorMatrix::fromRows(std::span<const FactorRow> rows) {
    FactorMatrix result;
    std::size_t count = 0;
    for (const FactorRow& row : rows)
        count += row.shares.size();
    result.m_first.reserve(rows.size() + 1);
    result.m_first.push_back(0);
    result.m_shares.reserve(count);
    for (const FactorRow& row : rows) {
        result.m_shares.insert(result.m_shares.end(), row.shares.begin(), row.shares.end());
        result.m_first.push_back(result.m_shares.size());
        result.m_lost.push_back({row.absorbed, row.escaped, row.rays});
    }
    return result;
}

Result<FactorMatrix> FactorMatrix::compute(const FormFactors& factors, std::size_t elements,
                                           std::size_t maxBytes, const JobContext& job) {
    FactorMatrix result;
    result.m_first.assign(elements + 1, 0);
    result.m_lost.resize(elements);
    // Rows are put together in groups, so that memory is asked for neither per row nor twice.
    constexpr std::size_t kGroup = 64;
    std::vector<std::vector<FactorRow::Share>> groups((elements + kGroup - 1) / kGroup);
    std::atomic<std::size_t> bytes{0}, done{0};
    std::atomic<bool> tooLarge{false};
    parallelFor(job, groups.size(), 1, [&](std::size_t begin, std::size_t end) {
        FactorRow row;
        for (std::size_t g = begin; g < end; ++g) {
            const std::size_t last = std::min(elements, (g + 1) * kGroup);
            for (std::size_t e = g * kGroup; e < last; ++e) {
                if (job.cancelled() || tooLarge)
                    return;
                factors.row(static_cast<std::uint32_t>(e), row);
                groups[g].insert(groups[g].end(), row.shares.begin(), row.shares.end());
                result.m_first[e + 1] = row.shares.size();
                result.m_lost[e] = {row.absorbed, row.escaped, row.rays};
            }
            groups[g].shrink_to_fit();
            const std::size_t now = bytes += groups[g].size() * sizeof(FactorRow::Share);
            if (maxBytes > 0 && now > maxBytes)
                tooLarge = true;
            done += last - g * kGroup;
            job.setProgress(static_cast<double>(done) / static_cast<double>(elements));
        }
    });
    if (job.cancelled())
        return bakeCancelled();
    if (tooLarge)
        return Error{ErrorKind::Usage,
                     fmt::format("The form factors of {} elements take more than {:.0f} MB; divide "
                                 "the scene less finely, or solve progressively, which keeps none.",
                                 elements, static_cast<double>(maxBytes) / 1e6),
                     {},
                     {}};
    for (std::size_t e = 0; e < elements; ++e)
        result.m_first[e + 1] += result.m_first[e];
    result.m_shares.reserve(result.m_first.back());
    for (std::vector<FactorRow::Share>& group : groups) {
        result.m_shares.insert(result.m_shares.end(), group.begin(), group.end());
        std::vector<FactorRow::Share>().swap(group);
    }
    return result;
}

FactorMatrix FactorMatrix::reversed(std::span<const double> areas) const {
    FactorMatrix result;
    result.m_first.assign(size() + 1, 0);
    result.m_lost.resize(size());
    for (const FactorRow::Share& share : m_shares)
        ++result.m_first[share.element + 1];
    for (std::size_t e = 0; e < size(); ++e)
        result.m_first[e + 1] += result.m_first[e];
    result.m_shares.resize(m_shares.size());
    std::vector<std::size_t> next(result.m_first.begin(), result.m_first.end() - 1);
    for (std::uint32_t e = 0; e < size(); ++e)
        for (const FactorRow::Share& share : row(e))
            result.m_shares[next[share.element]++] = {
                e, static_cast<float>(share.factor * areas[e] / areas[share.element])};
    return result;
}

std::size_t FactorMatrix::memoryBytes() const {
    return m_first.capacity() * sizeof(std::size_t) +
           m_shares.capacity() * sizeof(FactorRow::Share) + m_lost.capacity() * sizeof(Lost);
}

FactorQuality qualityOf(const FactorMatrix& factors, std::span<const double> areas) {
    FactorQuality quality;
    double area = 0.0, exchanged = 0.0, difference = 0.0;
    const FactorMatrix reversed = factors.reversed(areas);
    for (std::uint32_t e = 0; e < factors.size(); ++e) {
        double sum = 0.0;
        // Both rows are in ascending order: walk them side by side.
        const auto row = factors.row(e), other = reversed.row(e);
        auto mine = row.begin();
        auto theirs = other.begin();
        while (mine != row.end() || theirs != other.end()) {
            double here = 0.0, there = 0.0;
            const std::uint32_t next = std::min(mine != row.end() ? mine->element : kNone,
                                                theirs != other.end() ? theirs->element : kNone);
            if (mine != row.end() && mine->element == next)
                here = (mine++)->factor;
            if (theirs != other.end() && theirs->element == next)
                there = (theirs++)->factor;
            sum += here;
            exchanged += areas[e] * here;
            difference += areas[e] * std::abs(here - there);
        }
        quality.closure = std::max(quality.closure,
                                   std::abs(sum + factors.absorbed(e) + factors.escaped(e) - 1.0));
        quality.escaped += areas[e] * factors.escaped(e);
        quality.absorbed += areas[e] * factors.absorbed(e);
        area += areas[e];
    }
    if (area > 0.0) {
        quality.escaped /= area;
        quality.absorbed /= area;
    }
    quality.reciprocity = exchanged > 0.0 ? difference / exchanged : 0.0;
    return quality;
}

} // namespace patina::radiosity
