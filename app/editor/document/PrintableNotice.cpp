#include "app/editor/document/PrintableNotice.h"

#include "core/base/PrintableText.h"

namespace patina::editor {

UserNotice printableNotice(const UserNotice& notice) {
    const auto clean = [](const QString& text) {
        return QString::fromStdString(printableText(text.toStdString()));
    };
    UserNotice result = notice;
    result.text = clean(notice.text);
    result.file = clean(notice.file); // compared with the text, and shown in it
    for (QString& detail : result.details)
        detail = clean(detail);
    return result;
}

} // namespace patina::editor
