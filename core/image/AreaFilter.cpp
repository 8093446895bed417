#include "core/image/AreaFilter.h"

#include "core/base/Check.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace patina {

std::vector<Footprint> footprints(int from, int to) {
    std::vector<Footprint> result(static_cast<std::size_t>(to));
    const double scale = static_cast<double>(from) / to;
    for (int i = 0; i < to; ++i) {
        Footprint& footprint = result[static_cast<std::size_t>(i)];
        const double begin = i * scale;
        const double end = std::min((i + 1) * scale, static_cast<double>(from));
        footprint.first = static_cast<int>(begin);
        for (int k = footprint.first; k < from && k < end; ++k) {
            const double covered = std::min<double>(end, k + 1) - std::max<double>(begin, k);
            footprint.weights.push_back(static_cast<float>(covered / (end - begin)));
        }
    }
    return result;
}

ImageSize reducedSize(ImageSize size, int maxSide) {
    const int longSide = std::max(size.width, size.height);
    if (maxSide <= 0 || longSide <= maxSide)
        return size;
    const int common = std::gcd(size.width, size.height);
    if (const int steps = maxSide / (longSide / common); steps > 0)
        return {size.width / common * steps, size.height / common * steps};
    const auto scaled = [&](int side) {
        return std::max(
            1, static_cast<int>(std::lround(static_cast<double>(side) * maxSide / longSide)));
    };
    return {scaled(size.width), scaled(size.height)};
}

RowReducer::RowReducer(int fromWidth, int fromHeight, int toWidth, int toHeight, int channels)
    : m_channels(channels)
    , m_columns(footprints(fromWidth, toWidth))
    , m_rows(footprints(fromHeight, toHeight))
    , m_reduced(static_cast<std::size_t>(toWidth) * static_cast<std::size_t>(channels))
    , m_result(m_reduced.size() * static_cast<std::size_t>(toHeight)) {
    CHECK_LE(toWidth, fromWidth);
    CHECK_LE(toHeight, fromHeight);
}

void RowReducer::addRow(std::span<const float> row) {
    const auto channels = static_cast<std::size_t>(m_channels);
    std::fill(m_reduced.begin(), m_reduced.end(), 0.0f);
    for (std::size_t x = 0; x < m_columns.size(); ++x) {
        const Footprint& column = m_columns[x];
        const float* source = row.data() + static_cast<std::size_t>(column.first) * channels;
        for (const float weight : column.weights)
            for (std::size_t c = 0; c < channels; ++c)
                m_reduced[x * channels + c] += weight * *source++;
    }
    // Neighbouring target rows share at most one source row.
    for (std::size_t y = m_firstRow; y < m_rows.size() && m_rows[y].first <= m_sourceRow; ++y) {
        const auto at = static_cast<std::size_t>(m_sourceRow - m_rows[y].first);
        if (at >= m_rows[y].weights.size()) {
            m_firstRow = y + 1;
            continue;
        }
        const float weight = m_rows[y].weights[at];
        float* target = m_result.data() + y * m_reduced.size();
        for (std::size_t i = 0; i < m_reduced.size(); ++i)
            target[i] += weight * m_reduced[i];
    }
    ++m_sourceRow;
}

} // namespace patina
