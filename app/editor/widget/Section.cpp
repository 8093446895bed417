#include "app/editor/widget/Section.h"

#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"

#include <QToolButton>
#include <QVBoxLayout>

namespace patina::editor {

Section::Section(const QString& title, QWidget* parent)
    : QWidget(parent)
    , m_header(new QToolButton)
    , m_body(new QWidget) {
    m_header->setObjectName(QStringLiteral("sectionHeader"));
    m_header->setText(QString(title).replace(QLatin1Char('&'), QStringLiteral("&&")));
    m_header->setAccessibleName(title);
    m_header->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    m_header->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    m_header->setCheckable(true);
    m_header->setFocusPolicy(Qt::TabFocus);
    m_header->setIconSize({14, 14});

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, tokens::kGap);
    layout->setSpacing(2);
    layout->addWidget(m_header);
    layout->addWidget(m_body);
    m_rows = new QVBoxLayout(m_body);
    m_rows->setContentsMargins(0, 2, 0, 0);
    m_rows->setSpacing(4);
    connect(m_header, &QToolButton::toggled, this, &Section::setOpen);
    setOpen(true);
}

void Section::add(QWidget* row) {
    m_rows->addWidget(row);
}

void Section::setOpen(bool open) {
    m_header->setChecked(open);
    m_header->setIcon(icon(open ? QStringLiteral("chevron-down") : QStringLiteral("chevron-right"),
                           tokens::kTextDim));
    m_body->setVisible(open);
}

} // namespace patina::editor
