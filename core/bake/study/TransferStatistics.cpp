#include "core/bake/study/TransferStatistics.h"

#include "core/bake/transfer/TransferMeaning.h"
#include "core/base/Check.h"

#include <algorithm>

namespace patina {

TransferStatistics transferStatistics(std::span<const float> values, std::span<const float> bounced,
                                      int order) {
    const auto stride = static_cast<std::size_t>(shCount(order));
    CHECK_EQ(values.size() % stride, 0u);
    CHECK(bounced.empty() || bounced.size() == 3 * values.size());
    TransferStatistics statistics;
    statistics.elements = values.size() / stride;
    statistics.bandShares.assign(static_cast<std::size_t>(order), 0.0);
    std::vector<std::size_t> bandOf;
    for (std::size_t l = 0; l < statistics.bandShares.size(); ++l)
        bandOf.insert(bandOf.end(), 2 * l + 1, l);
    double visibilities = 0.0;
    for (std::size_t from = 0; from < values.size(); from += stride) {
        const std::span<const float> direct = values.subspan(from, stride);
        bool dark = true;
        for (std::size_t i = 0; i < stride; ++i) {
            double c = direct[i];
            if (!bounced.empty()) {
                const float* b = bounced.data() + 3 * (from + i);
                c += (double{b[0]} + double{b[1]} + double{b[2]}) / 3.0;
            }
            dark = dark && c == 0.0;
            statistics.bandShares[bandOf[i]] += c * c;
        }
        if (dark) {
            ++statistics.dark;
            continue;
        }
        const float visibility = std::clamp(ambientVisibility(direct), 0.0f, 1.0f);
        const bool first = from / stride == statistics.dark;
        statistics.lowestVisibility =
            first ? visibility : std::min(statistics.lowestVisibility, visibility);
        statistics.highestVisibility = std::max(statistics.highestVisibility, visibility);
        visibilities += visibility;
    }
    const std::size_t lit = statistics.elements - statistics.dark;
    if (lit == 0)
        return statistics;
    statistics.meanVisibility = visibilities / static_cast<double>(lit);
    double squares = 0.0;
    for (const double band : statistics.bandShares)
        squares += band;
    for (double& band : statistics.bandShares)
        band /= squares;
    return statistics;
}

} // namespace patina
