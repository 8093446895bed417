#include "core/bake/study/TransferFunction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {

float TransferFunction::peak() const {
    return std::max({highest, -lowest, 1e-6f}); // it is divided by
}

TransferFunction transferFunction(const PointTransfer& transfer, unsigned bands, int height) {
    TransferFunction function;
    function.height = height;
    function.values.reserve(2 * static_cast<std::size_t>(height) *
                            static_cast<std::size_t>(height));
    double negative = 0.0, whole = 0.0;
    for (int y = 0; y < height; ++y) {
        const double solidAngle = std::sin(std::numbers::pi * (y + 0.5) / height);
        for (int x = 0; x < 2 * height; ++x) {
            const float value = transfer.towards(latLongDirection(x, y, 2 * height, height), bands);
            function.values.push_back(value);
            function.lowest = std::min(function.lowest, value);
            function.highest = std::max(function.highest, value);
            whole += solidAngle;
            if (value < 0.0f)
                negative += solidAngle;
        }
    }
    function.negativeShare = negative / whole;
    return function;
}

} // namespace patina
