#include "core/codec/image/PictureAttributes.h"

#include "core/base/LowerCase.h"
#include "core/codec/image/HandOn.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace patina::codec {

namespace {

bool isExposure(const std::string& lowerName) {
    return std::any_of(std::begin(kExposure), std::end(kExposure),
                       [&](const char* name) { return lowerCase(name) == lowerName; });
}

// What readers and codec::decodePicture() look for, beyond the exposure.
bool hasMeaning(const std::string& lowerName) {
    static const std::set<std::string> kNames{"textureformat", "chromaticities", "xresolution",
                                              "yresolution",   "resolutionunit", "pixelaspectratio",
                                              kOwnSize};
    return kNames.contains(lowerName) || lowerName.starts_with("oiio:");
}

} // namespace

void PictureAttributes::claim(const std::string& name) {
    if (!m_taken.insert(lowerCase(name)).second)
        throw HandOn{"two attributes of one name: " + name};
}

void PictureAttributes::addText(const std::string& name, const std::string& text) {
    if (name.empty())
        return;
    claim(name);
    if (name == "oiio:ColorSpace") // written by Patina; replaces what the reader said
        return;
    if (const std::string lower = lowerCase(name); hasMeaning(lower) || isExposure(lower))
        throw HandOn{"a text with a meaning: " + name};
    if (!isStorage(name))
        m_content[name] = text;
}

void PictureAttributes::addNumber(const std::string& name, float value) {
    claim(name);
    const bool known =
        std::find(std::begin(kExposure), std::end(kExposure), name) != std::end(kExposure);
    const std::string lower = lowerCase(name);
    if (!known && (hasMeaning(lower) || isExposure(lower)))
        throw HandOn{"a number with a meaning: " + name};
    if (known && std::isfinite(value) && value > 0.0f)
        m_content[name] = fmt::format("{}", value);
}

void PictureAttributes::addOther(const std::string& name) {
    claim(name);
    if (const std::string lower = lowerCase(name); hasMeaning(lower) || isExposure(lower))
        throw HandOn{"an attribute with a meaning: " + name};
}

} // namespace patina::codec
