#include "core/image/Chromaticities.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace patina {

namespace {

glm::dvec3 xyzOf(double x, double y) {
    return {x / y, 1.0, (1.0 - x - y) / y};
}

// SMPTE RP 177: the primaries, scaled so that equal parts give the white.
std::optional<glm::dmat3> rgbToXyz(const Chromaticities& c) {
    for (const int y : {1, 3, 5, 7})
        if (!std::isfinite(c[static_cast<std::size_t>(y)]) ||
            std::abs(c[static_cast<std::size_t>(y)]) < 1e-6f)
            return std::nullopt;
    const glm::dmat3 primaries(xyzOf(c[0], c[1]), xyzOf(c[2], c[3]), xyzOf(c[4], c[5]));
    if (!(std::abs(glm::determinant(primaries)) > 1e-6))
        return std::nullopt;
    const glm::dvec3 scale = glm::inverse(primaries) * xyzOf(c[6], c[7]);
    return glm::dmat3(primaries[0] * scale.x, primaries[1] * scale.y, primaries[2] * scale.z);
}

} // namespace

std::optional<Chromaticities> parseChromaticities(std::string_view text) {
    Chromaticities result{};
    for (float& value : result) {
        text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc())
            return std::nullopt;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
    return result;
}

std::optional<glm::mat3> toRec709(const Chromaticities& from) {
    const auto source = rgbToXyz(from);
    const auto target = rgbToXyz(kRec709);
    if (!source || !target)
        return std::nullopt;
    // Lam 1985, as in ICC.1:2022, annex E.3: cone responses, scaled from white to white.
    const glm::dmat3 bradford(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367,
                              1.0296);
    const glm::dvec3 white = bradford * xyzOf(from[6], from[7]);
    const glm::dvec3 wanted = bradford * xyzOf(kRec709[6], kRec709[7]);
    glm::dmat3 scale(0.0);
    for (int i = 0; i < 3; ++i)
        scale[i][i] = wanted[i] / white[i];
    return glm::mat3(glm::inverse(*target) * glm::inverse(bradford) * scale * bradford * *source);
}

} // namespace patina
