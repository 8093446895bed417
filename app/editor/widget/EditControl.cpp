#include "app/editor/widget/EditControl.h"

#include <QApplication>
#include <QComboBox>
#include <QLayout>
#include <QSignalBlocker>
#include <QWidget>
#include <vector>

namespace patina::editor {
namespace {

// Hiding a popup takes the focus from its fields, which would report what was typed.
void closePopups(QWidget& root) {
    for (QWidget* popup : root.findChildren<QWidget*>()) {
        if (!popup->isWindow() || !popup->isVisible())
            continue;
        std::vector<QSignalBlocker> silent;
        for (QWidget* part : popup->findChildren<QWidget*>())
            silent.emplace_back(part);
        popup->hide();
    }
}

void releaseFocus(QWidget& widget) {
    QWidget* focus = QApplication::focusWidget();
    if (!focus || (focus != &widget && !widget.isAncestorOf(focus)))
        return;
    for (QWidget* above = widget.parentWidget(); above; above = above->parentWidget())
        if (above->focusPolicy() != Qt::NoFocus && above->isEnabled()) {
            above->setFocus(Qt::OtherFocusReason);
            return;
        }
    focus->clearFocus();
}

} // namespace

void abandonEdits(QWidget& root) {
    closePopups(root);
    QList<QWidget*> controls = root.findChildren<QWidget*>();
    controls.prepend(&root);
    for (QWidget* widget : std::as_const(controls)) {
        if (auto* control = dynamic_cast<EditControl*>(widget))
            control->abandonEdit();
        else if (auto* box = qobject_cast<QComboBox*>(widget))
            box->hidePopup();
    }
}

void retire(QWidget* widget) {
    for (QObject* part : widget->findChildren<QObject*>())
        part->blockSignals(true);
    widget->blockSignals(true);
    closePopups(*widget);
    releaseFocus(*widget);
    if (QWidget* parent = widget->parentWidget(); parent && parent->layout())
        parent->layout()->removeWidget(widget);
    widget->hide();
    widget->setParent(nullptr); // nobody finds it among the present ones
    widget->deleteLater();
}

void retireAll(QLayout& layout) {
    while (QLayoutItem* item = layout.takeAt(0)) {
        if (QWidget* widget = item->widget())
            retire(widget);
        delete item;
    }
}

} // namespace patina::editor
