// The transfer of a point as a function of the direction that light comes from.
#pragma once

#include "core/bake/document/TransferPoint.h"

#include <vector>

namespace patina {

// PointTransfer::towards() at the centres of a lat-long picture's pixels.
struct TransferFunction {
    int height = 0;            // the picture is 2 height × height
    std::vector<float> values; // in rows from the top; latLongDirection() has their directions
    float lowest = 0.0f;       // of them; 0 where none is below
    float highest = 0.0f;      // 0 where none is above
    // Of the sphere, 0…1: where it is below zero, which no light is; a sum of bands rings so beside
    // the edges of what is hidden.
    double negativeShare = 0.0;

    [[nodiscard]] float peak() const; // the largest in either direction, a little above 0 at least
};

// Of the bands whose bit is set; `height`: 1 or more.
[[nodiscard]] TransferFunction transferFunction(const PointTransfer& transfer, unsigned bands,
                                                int height);

} // namespace patina
