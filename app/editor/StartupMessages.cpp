#include "app/editor/StartupMessages.h"

#include "app/editor/OpenGlProbe.h"
#include "core/base/PrintableText.h"

#include <QString>
#include <QStringList>
#include <cstdio>
#include <cstdlib>

namespace patina::editor {
namespace {

// Qt's handler is a plain function.
QStringList& heldBack() {
    static QStringList messages;
    return messages;
}

void take(QtMsgType type, const QMessageLogContext&, const QString& message) {
    if (type != QtFatalMsg) {
        heldBack() << message;
        return;
    }
    const auto variable = [](const char* name) {
        return QStringLiteral("%1=%2").arg(QLatin1String(name),
                                           qEnvironmentVariable(name, QStringLiteral("(not set)")));
    };
    const QString text =
        QStringLiteral("patina-editor: no window can be opened on this display (%1, %2). Check "
                       "that it exists and that you may use it; or use 'patina render' and "
                       "'patina bake', which need none.\n")
            .arg(variable("DISPLAY"), variable("WAYLAND_DISPLAY"));
    std::fputs(printableText(text.toStdString()).c_str(), stderr);
    for (const QString& earlier : heldBack())
        std::fprintf(stderr, "  %s\n", printableText(earlier.toStdString()).c_str());
    std::_Exit(kNoOpenGlStatus);
}

} // namespace

StartupMessages::StartupMessages() {
    qInstallMessageHandler(take);
}

StartupMessages::~StartupMessages() {
    qInstallMessageHandler(nullptr);
    for (const QString& message : heldBack())
        qWarning("%s", qPrintable(message));
    heldBack().clear();
}

} // namespace patina::editor
