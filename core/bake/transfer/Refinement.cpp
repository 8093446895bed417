#include "core/bake/transfer/Refinement.h"

#include <algorithm>
#include <cmath>

namespace patina {

std::vector<std::uint8_t> pointsToRefine(std::span<const PointError> points, float tolerance,
                                         int maxRays) {
    constexpr double kFall = 0.83;
    std::vector<std::uint8_t> refine(points.size(), 0);
    const double target =
        static_cast<double>(tolerance) * tolerance * static_cast<double>(points.size());
    double squares = 0.0;
    for (const PointError& point : points)
        squares += static_cast<double>(point.error) * point.error;
    if (squares <= target)
        return refine;

    // The squared error that would remain with N = c^(2 / (2a + 1)), and the s that brings it to
    // the target.
    const auto shape = [&](const PointError& point) {
        const double c = point.error * std::pow(static_cast<double>(point.rays), kFall);
        return std::pow(c, 2.0 / (2.0 * kFall + 1.0));
    };
    double remaining = 0.0;
    for (const PointError& point : points)
        remaining += shape(point);
    // c² N^-2a = c^(2 / (2a + 1)) too.
    const double scale = std::pow(remaining / target, 1.0 / (2.0 * kFall));
    for (const double threshold : {std::sqrt(0.5), 1.0}) { // the second when all are close
        bool some = false;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool wants =
                points[i].rays < maxRays && points[i].rays < threshold * scale * shape(points[i]);
            refine[i] = wants ? 1 : 0;
            some = some || wants;
        }
        if (some)
            break;
    }
    return refine;
}

} // namespace patina
