// An axis of a plot as a value: what it is of, its range, its scale, where its numbers stand.
#pragma once

#include <QString>
#include <vector>

namespace patina::editor {

struct PlotAxis {
    QString name, unit;       // "θₒ", "°"; the unit stands right behind numbers: " sr⁻¹"
    double min = 0, max = 1;  // at the left or bottom, at the right or top; in any order
    double tickStep = 0;      // between numbers; 0: round ones, as many as there is room for
    bool logarithmic = false; // then 0 < min < max
    bool whole = false;       // counts things: min, min ± 1 … max, each with a place of its own

    [[nodiscard]] QString title() const; // "θₒ [°]"
    [[nodiscard]] QString number(double value) const;
    [[nodiscard]] double share(double value) const; // of the axis, 0 at min, 1 at max
    [[nodiscard]] double value(double share) const; // within the axis, rounded to what is told
    [[nodiscard]] double rounded(double value) const;
    [[nodiscard]] double step() const; // of a key, towards max; a tenth of it can be told apart
    [[nodiscard]] std::vector<double> ticks(int most) const; // numbers; about `most` round ones
};

} // namespace patina::editor
