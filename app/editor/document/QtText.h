// Texts and paths between Qt and the standard library.
#pragma once

#include <QFile>
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

} // namespace patina::editor
