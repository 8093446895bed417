// The icons: line drawings in resources/icons, painted in the colour that the state asks for.
#pragma once

#include <QIcon>
#include <QString>

namespace patina::editor {

// `name` of a file in resources/icons without ".svg". Sharp at every scale; greyed when disabled,
// in the accent colour when checked.
[[nodiscard]] QIcon icon(const QString& name);
// The same drawing in one fixed colour.
[[nodiscard]] QIcon icon(const QString& name, QRgb color);

} // namespace patina::editor
