#include "app/editor/widget/PlotAxis.h"

#include "app/editor/widget/PlotStyle.h"

#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {
constexpr double kSteps = 50.0; // of an axis, at least

// Ascending. Where fewer than two lie within, what is 2 and 5 times one stands, too; or the ends.
std::vector<double> powersOfTen(double min, double max, int most) {
    constexpr double kSlack = 1e-9;
    const int first = static_cast<int>(std::ceil(std::log10(min) - kSlack)),
              last = static_cast<int>(std::floor(std::log10(max) + kSlack));
    std::vector<double> values;
    // The largest one always: what is small is a matter of how long one looks.
    const int step = std::max(1, (last - first) / most);
    for (int power = last; power >= first; power -= step)
        values.insert(values.begin(), std::pow(10.0, power));
    if (values.size() > 1)
        return values;
    values.clear();
    for (int power = first - 1; power <= last + 1; ++power)
        for (const double factor : {1.0, 2.0, 5.0})
            if (const double value = factor * std::pow(10.0, power);
                value >= min * (1.0 - kSlack) && value <= max * (1.0 + kSlack))
                values.push_back(value);
    return values.size() > 1 ? values : std::vector{min, max};
}
} // namespace

QString PlotAxis::title() const {
    const QString bare = unit.trimmed();
    return bare.isEmpty() ? name : QStringLiteral("%1 [%2]").arg(name, bare);
}

QString PlotAxis::number(double value) const {
    return plotNumber(value) + unit;
}

double PlotAxis::share(double value) const {
    if (logarithmic)
        return std::log(std::max(value, min * 0.5) / min) / std::log(max / min);
    const double half = whole ? (max < min ? -0.5 : 0.5) : 0.0;
    return (value - min + half) / (max - min + 2.0 * half);
}

double PlotAxis::value(double share) const {
    const double t = std::clamp(share, 0.0, 1.0);
    if (logarithmic)
        return min * std::pow(max / min, t);
    const double half = whole ? (max < min ? -0.5 : 0.5) : 0.0;
    return rounded(min - half + t * (max - min + 2.0 * half));
}

double PlotAxis::rounded(double value) const {
    const double perUnit = whole ? 1.0 : std::abs(10.0 / step());
    return std::clamp(std::round(value * perUnit) / perUnit, std::min(min, max),
                      std::max(min, max));
}

double PlotAxis::step() const {
    const double size =
        whole ? 1.0 : std::pow(10.0, std::floor(std::log10(std::abs(max - min) / kSteps)));
    return max < min ? -size : size;
}

std::vector<double> PlotAxis::ticks(int most) const {
    if (!logarithmic && tickStep <= 0.0)
        return roundSteps(min, max, most);
    if (logarithmic)
        return powersOfTen(min, max, most);
    std::vector<double> values;
    const double low = std::min(min, max), high = std::max(min, max);
    for (int i = 0; low + i * tickStep <= high + 1e-6; ++i)
        values.push_back(low + i * tickStep);
    return values;
}

} // namespace patina::editor
