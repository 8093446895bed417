#include "core/radiosity/FactorMatrix.h"

#include "core/job/Parallel.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>

namespace patina::radiosity {

FactorMatrix FactorMatrix::fromRows(std::span<const FactorRow> rows) {
    FactorMatrix result(rows.size());
    for (std::uint32_t e = 0; e < rows.size(); ++e)
        result.set(e, rows[e]);
    return result;
}

Result<FactorMatrix> FactorMatrix::compute(const FormFactors& factors, std::size_t senders,
                                           std::size_t maxBytes, const JobContext& job) {
    FactorMatrix result(senders);
    if (Result<void> complete = result.complete(factors, {}, maxBytes, job); !complete)
        return complete.error();
    return result;
}

Result<void> FactorMatrix::complete(const FormFactors& factors, const ElementShard& shard,
                                    std::size_t maxBytes, const JobContext& job,
                                    const std::function<void()>& between) {
    const std::size_t elements = size(), held = std::max<std::size_t>(shard.held(elements), 1);
    std::atomic<std::size_t> bytes{shareCount() * sizeof(FactorRow::Share)}, done{0};
    std::atomic<bool> tooLarge{false};
    // A group is of one shard, and all of its rows are looked at by one thread.
    const std::size_t groups = (elements + kElementGroup - 1) / kElementGroup;
    parallelFor(job, groups, 1, [&](std::size_t begin, std::size_t end) {
        FactorRow row;
        for (std::size_t e = begin * kElementGroup; e < std::min(elements, end * kElementGroup);
             ++e) {
            if (job.cancelled() || tooLarge)
                return;
            const auto element = static_cast<std::uint32_t>(e);
            if (!shard.holds(element))
                continue;
            if (!has(element)) {
                factors.row(element, row);
                set(element, row);
                const std::size_t now = bytes += row.shares.size() * sizeof(FactorRow::Share);
                if (maxBytes > 0 && now > maxBytes)
                    tooLarge = true;
                if (between)
                    between();
            }
            job.setProgress(static_cast<double>(++done) / static_cast<double>(held));
        }
    });
    if (job.cancelled())
        return bakeCancelled();
    if (tooLarge)
        return Error{ErrorKind::Usage,
                     fmt::format("The form factors of {} elements or patches take more than "
                                 "{:.0f} MB; divide the scene less finely, or solve "
                                 "progressively, which keeps none.",
                                 elements, static_cast<double>(maxBytes) / 1e6),
                     {},
                     {}};
    return {};
}

FactorMatrix FactorMatrix::reversed(std::span<const double> areas) const {
    FactorMatrix result(size());
    std::vector<std::size_t> counts(size(), 0);
    for (const FactorRow& row : m_rows)
        for (const FactorRow::Share& share : row.shares)
            ++counts[share.element];
    for (std::uint32_t e = 0; e < size(); ++e) {
        result.m_rows[e].shares.reserve(counts[e]);
        result.m_found.set(e);
    }
    for (std::uint32_t e = 0; e < size(); ++e)
        for (const FactorRow::Share& share : row(e))
            result.m_rows[share.element].shares.push_back(
                {e, static_cast<float>(share.factor * areas[e] / areas[share.element])});
    return result;
}

FactorMatrix FactorMatrix::betweenPatches(const Patches& patches) const {
    FactorMatrix result(size());
    std::vector<double> sums(size(), 0.0);
    std::vector<std::uint32_t> met;
    for (std::uint32_t p = 0; p < size(); ++p) {
        met.clear();
        for (const FactorRow::Share& share : row(p)) {
            const std::uint32_t to = patches.of[share.element];
            if (sums[to] == 0.0)
                met.push_back(to);
            sums[to] += double{share.factor};
        }
        std::ranges::sort(met);
        FactorRow& out = result.m_rows[p];
        for (const std::uint32_t to : met) {
            out.shares.push_back({to, static_cast<float>(sums[to])});
            sums[to] = 0.0;
        }
        out.absorbed = absorbed(p);
        out.escaped = escaped(p);
        out.rays = rays(p);
        result.m_found.set(p);
    }
    return result;
}

std::size_t FactorMatrix::rowCount() const {
    std::size_t count = 0;
    for (std::uint32_t e = 0; e < size(); ++e)
        count += has(e) ? 1 : 0;
    return count;
}

std::size_t FactorMatrix::shareCount() const {
    std::size_t count = 0;
    for (const FactorRow& row : m_rows)
        count += row.shares.size();
    return count;
}

std::size_t FactorMatrix::memoryBytes() const {
    std::size_t bytes = m_rows.capacity() * (sizeof(FactorRow) + 1);
    for (const FactorRow& row : m_rows)
        bytes += row.shares.capacity() * sizeof(FactorRow::Share);
    return bytes;
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
