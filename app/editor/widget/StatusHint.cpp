#include "app/editor/widget/StatusHint.h"

#include <QCoreApplication>
#include <QStatusTipEvent>
#include <QWidget>

namespace patina::editor {

void showHint(QWidget& from, const QString& text) {
    QStatusTipEvent event(text);
    QCoreApplication::sendEvent(&from, &event);
}

} // namespace patina::editor
