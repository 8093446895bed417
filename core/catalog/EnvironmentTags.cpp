#include "core/catalog/EnvironmentTags.h"

#include <array>
#include <cstddef>

namespace patina {
namespace {

struct TagRow {
    std::string_view label, help;
};

// In the order of EnvironmentTag.
constexpr std::array<TagRow, kEnvironmentTags> kTagRows{{
    {"Sun", "one small source above the horizon has 15 % of the light or more"},
    {"Soft", "the brightest side gets less than 3.5 times the light of the sides away from it"},
    {"High contrast",
     "the brightest side gets 8 times the light of the sides away from it or more"},
    {"Warm", "the mean colour is that of a black body below 4500 K"},
    {"Neutral", "the mean colour is that of a black body of 4500 to 7500 K"},
    {"Cool", "the mean colour is that of a black body above 7500 K"},
    {"Dark", "half of the sphere is darker than a third of its mean without the brightest source"},
    {"Clipped", "the brightest light was cut off at the largest value of the file"},
}};

const TagRow& rowOf(EnvironmentTag tag) {
    return kTagRows[static_cast<std::size_t>(tag)];
}

} // namespace

std::vector<EnvironmentTag> tagsOf(const EnvironmentMeasures& m) {
    std::vector<EnvironmentTag> tags;
    if (!(m.meanLuminance > 0.0))
        return tags; // black
    if (m.source && m.source->isClear && m.source->share >= kSunShare &&
        m.source->diameterDeg <= kSunDiameterDeg && m.source->elevationDeg > 0.0)
        tags.push_back(EnvironmentTag::Sun);
    if (m.keyToFill < kSoftKeyToFill)
        tags.push_back(EnvironmentTag::Soft);
    if (m.keyToFill >= kHighKeyToFill)
        tags.push_back(EnvironmentTag::HighContrast);
    if (m.temperature)
        tags.push_back(m.temperature->kelvin < kWarmBelowK    ? EnvironmentTag::Warm
                       : m.temperature->kelvin <= kCoolAboveK ? EnvironmentTag::Neutral
                                                              : EnvironmentTag::Cool);
    const double sourceShare = m.source ? m.source->share : 0.0;
    if (m.medianLuminance <= kDarkMedian * m.meanLuminance * (1.0 - sourceShare))
        tags.push_back(EnvironmentTag::Dark);
    if (m.clippedShare > 0.0)
        tags.push_back(EnvironmentTag::Clipped);
    return tags;
}

std::string_view tagLabel(EnvironmentTag tag) {
    return rowOf(tag).label;
}

std::string_view tagHelp(EnvironmentTag tag) {
    return rowOf(tag).help;
}

} // namespace patina
