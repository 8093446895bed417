#include "app/editor/widget/ColorConversion.h"

#include "core/math/Shading.h"

#include <algorithm>

namespace patina::editor {

QColor toDisplay(const glm::vec3& linear) {
    const glm::vec3 encoded = shading::srgbEncode(linear);
    return QColor::fromRgbF(encoded.x, encoded.y, encoded.z);
}

glm::vec3 toLinear(const QColor& display) {
    return shading::srgbDecode(glm::vec3(display.redF(), display.greenF(), display.blueF()));
}

Hsv hsvOf(const glm::vec3& linear) {
    const glm::vec3 c = shading::srgbEncode(linear);
    const float high = std::max({c.x, c.y, c.z});
    const float range = high - std::min({c.x, c.y, c.z});
    Hsv hsv{0, high > 0 ? range / high : 0, high};
    if (range > 0) {
        const float sextant = high == c.x   ? (c.y - c.z) / range
                              : high == c.y ? 2 + (c.z - c.x) / range
                                            : 4 + (c.x - c.y) / range;
        hsv.hue = (sextant < 0 ? sextant + 6 : sextant) / 6;
    }
    return hsv;
}

glm::vec3 linearOf(const Hsv& hsv) {
    const auto channel = [&](float n) {
        const float k = std::fmod(n + hsv.hue * 6, 6.0f);
        return hsv.value * (1 - hsv.saturation * std::clamp(std::min(k, 4 - k), 0.0f, 1.0f));
    };
    return shading::srgbDecode(glm::vec3(channel(5), channel(3), channel(1)));
}

QString hexOf(const glm::vec3& linear) {
    return toDisplay(linear).name();
}

std::optional<glm::vec3> parseHex(const QString& text) {
    QString name = text.trimmed();
    if (!name.startsWith(QLatin1Char('#')))
        name.prepend(QLatin1Char('#'));
    if (name.size() != 4 && name.size() != 7)
        return std::nullopt;
    const QColor color(name);
    if (!color.isValid())
        return std::nullopt;
    return toLinear(color);
}

} // namespace patina::editor
