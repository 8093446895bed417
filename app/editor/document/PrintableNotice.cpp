#include "app/editor/document/PrintableNotice.h"

#include "core/base/PrintableText.h"

namespace patina::editor {

UserNotice printableNotice(const UserNotice& notice) {
    const auto clean = [](const QString& text) {
        return QString::fromStdString(printableText(text.toStdString()));
    };
    UserNotice result{notice.kind, clean(notice.text), {}};
    for (const QString& detail : notice.details)
        result.details << clean(detail);
    return result;
}

} // namespace patina::editor
