#include "core/math/Quadrature.h"

#include "core/base/Check.h"

#include <cmath>
#include <numbers>

namespace patina {

GaussLegendre::GaussLegendre(int n)
    : m_nodes(n)
    , m_weights(n) {
    CHECK_LE(1, n);
    for (int i = 0; i < n; ++i) {
        // Tricomi's estimate of the root lies in Newton's basin; it converges quadratically.
        double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
        double derivative = 0.0;
        for (int step = 0; step < 8; ++step) {
            double p = 1.0, previous = 0.0;
            for (int k = 1; k <= n; ++k) {
                const double next = ((2.0 * k - 1.0) * x * p - (k - 1.0) * previous) / k;
                previous = p;
                p = next;
            }
            derivative = n * (x * p - previous) / (x * x - 1.0);
            x -= p / derivative;
        }
        m_nodes[i] = 0.5 * (1.0 - x);
        m_weights[i] = 1.0 / ((1.0 - x * x) * derivative * derivative);
    }
}

} // namespace patina
