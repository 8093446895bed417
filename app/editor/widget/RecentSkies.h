// The environments from files that lit a scene last, with small pictures of them, over sessions.
#pragma once

#include <QImage>
#include <QString>
#include <QStringList>

namespace patina::editor {

inline constexpr int kMostRecentSkies = 6;

// Absolute paths, the newest first; those that are not there any more are left out.
[[nodiscard]] QStringList recentSkies();
// Puts a file first; its picture is kept beside.
void rememberSky(const QString& file);
void keepSkyPicture(const QString& file, const QImage& picture);
[[nodiscard]] QImage skyPicture(const QString& file); // null: none is kept

} // namespace patina::editor
