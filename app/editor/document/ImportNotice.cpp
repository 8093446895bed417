#include "app/editor/document/ImportNotice.h"

#include "core/scene/ImageProblem.h"

#include <QCoreApplication>

namespace patina::editor {
namespace {

QString trImport(const char* text) {
    return QCoreApplication::translate("ImportNotice", text);
}

} // namespace

UserNotice importNotice(const QString& name, const OpenedScene& opened) {
    // The first notice sums up the missing files, which are listed here one by one.
    std::vector<Notice> notices = opened.notices;
    if (!opened.missingFiles.empty() && !notices.empty())
        notices.erase(notices.begin());
    UserNotice result = UserNotice::fromImport(name, notices, opened.missingFiles);
    const std::vector<std::string> damagedFiles = damagedMaps(opened.document);
    const int missing = static_cast<int>(opened.missingFiles.size());
    const int damaged = static_cast<int>(damagedFiles.size());
    if (missing + damaged == 0)
        return result;
    result.kind = NoticeKind::Warning;
    if (missing + damaged == 1) {
        result.text = (missing == 1 ? trImport("%1 refers to a file that is missing: %2")
                                    : trImport("%1 refers to a file that is damaged: %2"))
                          .arg(name, QString::fromStdString(missing == 1 ? opened.missingFiles[0]
                                                                         : damagedFiles[0]));
        return result;
    }
    if (damaged == 0)
        result.text = trImport("%1 refers to %2 files that are missing.").arg(name).arg(missing);
    else if (missing == 0)
        result.text = trImport("%1 refers to %2 files that are damaged.").arg(name).arg(damaged);
    else
        result.text = trImport("%1 refers to files of which %2 are missing and %3 damaged.")
                          .arg(name)
                          .arg(missing)
                          .arg(damaged);
    result.text +=
        QLatin1Char(' ') +
        trImport("Their materials are marked in the Scene list; a checkered pattern stands in "
                 "for base colours.");
    return result;
}

} // namespace patina::editor
