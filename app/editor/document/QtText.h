// Texts and paths between Qt and the standard library.
#pragma once

#include "core/base/PrintableText.h"

#include <QFile>
#include <QFileInfo>
#include <QString>
#include <filesystem>
#include <string_view>

namespace patina::editor {

[[nodiscard]] inline QString toQString(std::string_view utf8) {
    return QString::fromUtf8(utf8.data(), static_cast<qsizetype>(utf8.size()));
}

// Bytes of paths are those of the file system, whatever they mean as text.
[[nodiscard]] inline QString fromPath(const std::filesystem::path& path) {
    return QFile::decodeName(path.string().c_str());
}
[[nodiscard]] inline std::filesystem::path toPath(const QString& path) {
    return QFile::encodeName(path).toStdString();
}

// Names from elsewhere as they are shown: on one line, and no character of theirs reorders what
// stands around it (core/base/PrintableText.h). Not for looking up files.
[[nodiscard]] inline QString shownName(const QString& name) {
    return toQString(printableLine(name.toStdString()));
}
[[nodiscard]] inline QString shownFileName(const QString& path) {
    return shownName(QFileInfo(path).fileName());
}

} // namespace patina::editor
