// Something to tell the user without stopping them: shown as a bar over the picture and kept in the
// log.
#pragma once

#include "core/base/Result.h"
#include "core/scene/Scene.h"

#include <QString>
#include <QStringList>
#include <vector>

namespace patina::editor {

enum class NoticeKind { Info, Warning, Error };
// What a notice is about, and goes with: the scene that is open, a file that was to be opened in
// its stead, the program itself, or the scene as the viewport draws it, which is not said of a
// traced picture.
enum class NoticeAbout { Scene, UnopenedFile, Program, Drawing };

struct UserNotice {
    NoticeKind kind = NoticeKind::Info;
    QString text;             // one sentence: what happened and what to do
    QStringList details;      // what "Details" unfolds: missing files, what a library said
    QString file = QString(); // that the text names, with its path; empty: none
    NoticeAbout about = NoticeAbout::Scene;

    [[nodiscard]] static UserNotice fromError(const Error& error);
    // One notice that sums up what opening `name` reported; `details` lists everything. Empty text
    // when there is nothing to say.
    [[nodiscard]] static UserNotice fromImport(const QString& name,
                                               const std::vector<Notice>& notices,
                                               const std::vector<std::string>& missingFiles);
};

} // namespace patina::editor
