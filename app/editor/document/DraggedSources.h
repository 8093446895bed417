// What is dragged over the window: local files, and built-in skies of the Environment Library,
// which are no files.
#pragma once

#include <QStringList>

class QMimeData;

namespace patina::editor {

// The text of its data: "builtin:NAME", a line each.
inline constexpr const char* kEnvironmentMime = "application/x-patina-environment";

[[nodiscard]] QStringList draggedFiles(const QMimeData& data); // paths
// Those, and "builtin:NAME" of skies that there are.
[[nodiscard]] QStringList draggedSources(const QMimeData& data);
// Files as URLs, for other programs, too; built-in skies for editors alone.
void setDraggedSources(QMimeData& data, const QStringList& sources);

} // namespace patina::editor
