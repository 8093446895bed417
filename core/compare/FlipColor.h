// The colour spaces of FLIP, for linear Rec.709 light under its white D65. Seen by this module
// only.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace patina::compare {

// Rec.709 to CIE XYZ, divided by the XYZ of white (the sum of each row): columns are R, G, B. From
// the primaries of Rec. ITU-R BT.709-6 and D65 at (0.3127, 0.3290).
inline const glm::mat3 kWhiteXyzFromRgb = [] {
    const glm::dmat3 xyz =
        glm::transpose(glm::dmat3(0.412390799265959, 0.357584339383878, 0.180480788401834,
                                  0.212639005871510, 0.715168678767756, 0.072192315360734,
                                  0.019330818715592, 0.119194779794626, 0.950532152249661));
    const glm::dvec3 white = xyz * glm::dvec3(1.0);
    return glm::mat3(glm::dmat3(xyz[0] / white, xyz[1] / white, xyz[2] / white));
}();
inline const glm::mat3 kRgbFromWhiteXyz = glm::mat3(glm::inverse(glm::dmat3(kWhiteXyzFromRgb)));

// The opponent space of Zhang & Wandell 1996 as FLIP has it: L* and a*, b* without their cube
// roots.
inline glm::vec3 ycxczFromRgb(const glm::vec3& rgb) {
    const glm::vec3 xyz = kWhiteXyzFromRgb * rgb;
    return {116.0f * xyz.y - 16.0f, 500.0f * (xyz.x - xyz.y), 200.0f * (xyz.y - xyz.z)};
}

inline glm::vec3 rgbFromYcxcz(const glm::vec3& v) {
    const float y = (v.x + 16.0f) / 116.0f;
    return kRgbFromWhiteXyz * glm::vec3(v.y / 500.0f + y, y, y - v.z / 200.0f);
}

// CIE L*a*b* (CIE 15:2004), a* and b* times L*/100: colours look less colourful in the dark (Hunt
// 1952).
inline glm::vec3 huntLabFromRgb(const glm::vec3& rgb) {
    constexpr float kDelta = 6.0f / 29.0f;
    const auto f = [](float t) {
        return t > kDelta * kDelta * kDelta ? std::cbrt(t)
                                            : t / (3.0f * kDelta * kDelta) + 4.0f / 29.0f;
    };
    const glm::vec3 xyz = kWhiteXyzFromRgb * rgb;
    const float x = f(xyz.x), y = f(xyz.y), z = f(xyz.z);
    const float lightness = 116.0f * y - 16.0f;
    return {lightness, 0.01f * lightness * 500.0f * (x - y), 0.01f * lightness * 200.0f * (y - z)};
}

// For large differences: city block of lightness, Euclid of colour (Abasi, Tehran & Fairchild
// 2020).
inline float hyab(const glm::vec3& a, const glm::vec3& b) {
    return std::abs(a.x - b.x) + glm::length(glm::vec2(a.y - b.y, a.z - b.z));
}

// ΔE_c of two Hunt-adjusted colours, 0…1 (2020, section 4.1.3): the compressed distance, of which
// the part up to 0.4 of the largest one, that of pure green and blue, takes 0.95 of the range.
class ColorDifference {
  public:
    float operator()(const glm::vec3& a, const glm::vec3& b) const {
        const float distance = std::pow(hyab(a, b), kPower);
        const float knee = 0.4f * m_largest;
        return std::min(1.0f, distance < knee
                                  ? 0.95f / knee * distance
                                  : 0.95f + 0.05f * (distance - knee) / (m_largest - knee));
    }

  private:
    static constexpr float kPower = 0.7f;
    float m_largest = std::pow(hyab(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1})), kPower);
};

// The tone curve of HDR-FLIP: Narkowicz's fit of ACES ("ACES Filmic Tone Mapping Curve", 2016) with
// his factor of 0.6 to light applied: (a x² + b x) / (c x² + d x + e).
struct FlipToneCurve {
    static constexpr float a = 0.6f * 0.6f * 2.51f, b = 0.6f * 0.03f;
    static constexpr float c = 0.6f * 0.6f * 2.43f, d = 0.6f * 0.59f, e = 0.14f;

    float operator()(float x) const {
        x = std::max(x, 0.0f);
        // Its limit, 1.03, before squares overflow.
        if (x > 1e6f)
            return 1.0f;
        return std::min(1.0f, x * (a * x + b) / (x * (c * x + d) + e));
    }
};

} // namespace patina::compare
