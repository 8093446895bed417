#include "app/editor/library/PreviewBadge.h"

#include "app/editor/library/EnvironmentPreview.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/ViewportWidget.h"

#include <QEvent>

namespace patina::editor {

PreviewBadge::PreviewBadge(EnvironmentPreview& preview, ViewportWidget& viewport)
    : QLabel(&viewport)
    , m_preview(preview)
    , m_viewport(viewport) {
    setObjectName(QStringLiteral("previewBadge"));
    setProperty("overlay", true);
    setAccessibleName(tr("Preview of an environment"));
    setTextFormat(Qt::PlainText);
    setContentsMargins(tokens::kMargin, tokens::kGap, tokens::kMargin, tokens::kGap);
    setAttribute(Qt::WA_TransparentForMouseEvents);
    connect(&preview, &EnvironmentPreview::changed, this, &PreviewBadge::refresh);
    viewport.installEventFilter(this);
    hide();
}

void PreviewBadge::refresh() {
    if (!m_preview.problem().isEmpty())
        setText(tr("No preview of %1: %2").arg(m_preview.title(), m_preview.problem()));
    else if (m_preview.isOn() && !m_viewport.showsPreviews())
        setText(tr("No preview: click a cell to see it there"));
    else
        setText(tr("Preview: %1").arg(m_preview.title()));
    setVisible(m_preview.isOn() || !m_preview.problem().isEmpty());
    place();
}

// In the upper left corner of what shows it, where it covers little.
void PreviewBadge::place() {
    const QRect area = m_viewport.previewArea();
    setMaximumWidth(m_viewport.width() - 2 * tokens::kMargin);
    adjustSize();
    move(area.topLeft() + QPoint(tokens::kMargin, tokens::kMargin));
    raise();
}

bool PreviewBadge::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Resize && isVisible())
        place();
    return false;
}

} // namespace patina::editor
