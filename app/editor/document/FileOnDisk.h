// What an editor knows of a project's file, and what it has to do with it.
#pragma once

#include "app/editor/document/OpenProjects.h"
#include "app/editor/document/QtText.h"
#include "core/base/Hash.h"

#include <QFileInfo>
#include <QString>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace patina::editor {

struct FileOnDisk {
    // What was last read or written here. Filled before the first save of it begins; then of the
    // thread that saves.
    std::optional<Hash> version;
    std::shared_ptr<const OpenProject> mark; // that it is open here; never null, nor exchanged
    std::string sharedWith; // of the thread that saves: who the user agreed to overwrite
    quint64 saves = 0;      // of the UI thread: how many have ended well
};

[[nodiscard]] inline std::filesystem::path absolutePath(const QString& file) {
    return toPath(QFileInfo(file).absoluteFilePath());
}

} // namespace patina::editor
