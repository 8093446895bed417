#include "app/editor/style/LightIcon.h"

#include "core/light/Light.h"

namespace patina::editor {

QString lightIcon(LightType type) {
    switch (type) {
    case LightType::Point:
        return QStringLiteral("light-point");
    case LightType::Directional:
        return QStringLiteral("light-sun");
    case LightType::Spot:
        return QStringLiteral("light-spot");
    case LightType::Sphere:
        return QStringLiteral("light-sphere");
    case LightType::Rectangle:
        return QStringLiteral("light-rectangle");
    }
    return {};
}

} // namespace patina::editor
