#include "app/editor/document/UserNotice.h"

#include <QCoreApplication>

namespace patina::editor {
namespace {

QString trNotice(const char* text, int count = -1) {
    return QCoreApplication::translate("UserNotice", text, nullptr, count);
}

QString fileName(const std::filesystem::path& file) {
    return QString::fromStdString(file.filename().string());
}

} // namespace

UserNotice UserNotice::fromError(const Error& error) {
    UserNotice notice{NoticeKind::Error, QString::fromStdString(error.message), {}};
    if (!error.file.empty()) {
        // Many messages name the file already; saying it twice would only make them longer.
        if (!notice.text.contains(fileName(error.file)))
            notice.text = trNotice("%1: %2").arg(fileName(error.file), notice.text);
        notice.file = QString::fromStdString(error.file.string());
        notice.details << notice.file;
    }
    if (!error.detail.empty())
        notice.details << QString::fromStdString(error.detail);
    return notice;
}

UserNotice UserNotice::fromImport(const QString& name, const std::vector<Notice>& notices,
                                  const std::vector<std::string>& missingFiles) {
    UserNotice result;
    for (const std::string& file : missingFiles)
        result.details << trNotice("Missing: %1").arg(QString::fromStdString(file));
    for (const Notice& notice : notices) {
        const QString text = QString::fromStdString(notice.message);
        result.details << (notice.file.empty() || text.contains(fileName(notice.file))
                               ? text
                               : trNotice("%1: %2").arg(fileName(notice.file), text));
    }
    const int missing = static_cast<int>(missingFiles.size());
    if (missing == 1)
        result.text = trNotice("%1 refers to a file that is missing: %2")
                          .arg(name, QString::fromStdString(missingFiles.front()));
    else if (missing > 1)
        result.text = trNotice("%1 refers to %2 files that are missing; a checkered placeholder "
                               "stands in for them.")
                          .arg(name)
                          .arg(missing);
    else if (notices.size() == 1)
        result.text = result.details.front();
    else if (!notices.empty())
        result.text = trNotice("%1: %2 remarks on what was repaired or left out.")
                          .arg(name)
                          .arg(notices.size());
    result.kind = missing > 0 ? NoticeKind::Warning : NoticeKind::Info;
    if (result.details.size() == 1)
        result.details.clear();
    return result;
}

} // namespace patina::editor
