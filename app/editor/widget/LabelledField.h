// A control with its label before it, as one item of a layout that flows.
#pragma once

#include "app/editor/style/Tokens.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QString>
#include <QWidget>

namespace patina::editor {

[[nodiscard]] inline QWidget* labelledField(const QString& text, QWidget* field) {
    auto* box = new QWidget;
    auto* row = new QHBoxLayout(box);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(tokens::kGap / 2);
    auto* label = new QLabel(text);
    label->setObjectName(QStringLiteral("dim"));
    label->setBuddy(field);
    row->addWidget(label);
    row->addWidget(field);
    return box;
}

} // namespace patina::editor
