#include "app/editor/panel/ParameterRow.h"

#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/RowLabel.h"
#include "core/edit/ResetValue.h"

#include <QDateTime>
#include <QHBoxLayout>

namespace patina::editor {

ParameterRow::ParameterRow(const ParameterInfo& info, const RowContext& context)
    : m_info(info)
    , m_context(context)
    , m_label(new RowLabel(toQString(info.label)))
    , m_layout(new QHBoxLayout(this)) {
    m_layout->setContentsMargins(0, 0, 0, 0);
    m_layout->setSpacing(tokens::kGap);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    m_label->setFixedWidth(context.labelWidth);
    m_layout->addWidget(m_label, 0, Qt::AlignTop);
    const QString help = toQString(info.help);
    m_label->setToolTip(tr("%1\nDouble-click to reset.").arg(help));
    setStatusTip(help);
    connect(m_label, &RowLabel::resetRequested, this, [this] {
        if (const auto element = target())
            m_context.controller.resetParameter(m_info, *element);
    });
}

void ParameterRow::addField(QWidget* field, int stretch) {
    describe(field);
    m_layout->addWidget(field, stretch);
}

void ParameterRow::describe(QWidget* field, const QString& suffix) const {
    field->setAccessibleName(toQString(m_info.label) + suffix);
    field->setAccessibleDescription(toQString(m_info.help));
    field->setToolTip(toQString(m_info.help));
    field->setStatusTip(toQString(m_info.help));
}

std::optional<ParameterValue> ParameterRow::current() const {
    const auto element = target();
    if (!element || !targetExists(m_context.controller.document(), *element))
        return std::nullopt;
    return m_info.get(m_context.controller.document(), element->id);
}

void ParameterRow::refresh() {
    const auto value = current();
    // What was begun for another element, or for one that is gone, is not done to this one.
    if (target() != m_shown || !value) {
        abandonEdits(*this);
        m_session = m_stepSession = 0;
        m_shown = target();
    }
    setEnabled(value.has_value() && m_works);
    if (!value)
        return;
    m_label->setAtDefault(*value == resetValue(m_context.controller.document(), m_info, *m_shown));
    show(*value);
}

void ParameterRow::setWorks(bool works) {
    if (works == m_works)
        return;
    m_works = works;
    if (!works)
        abandonEdits(*this);
    setEnabled(works && current().has_value());
}

void ParameterRow::beginDrag() {
    m_session = m_context.controller.newDragSession();
}

void ParameterRow::drag(const ParameterValue& value) {
    if (const auto element = target())
        m_context.controller.setParameter(m_info, *element, value, m_session);
}

void ParameterRow::endDrag() {
    m_session = 0;
}

void ParameterRow::edit(const ParameterValue& value) {
    if (const auto element = target())
        m_context.controller.setParameter(m_info, *element, value);
    refresh(); // an equal or clamped value makes no change, but the text may differ
}

void ParameterRow::step(const ParameterValue& value) {
    const qint64 now = QDateTime::currentMSecsSinceEpoch();
    if (m_stepSession == 0 || now - m_lastStepMs > kStepPauseMs)
        m_stepSession = m_context.controller.newDragSession();
    m_lastStepMs = now;
    if (const auto element = target())
        m_context.controller.setParameter(m_info, *element, value, m_stepSession);
}

} // namespace patina::editor
