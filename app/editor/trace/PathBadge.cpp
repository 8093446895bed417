#include "app/editor/trace/PathBadge.h"

#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/trace/PathView.h"
#include "app/editor/viewport/ViewState.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QPushButton>

namespace patina::editor {

PathBadge::PathBadge(PathView& paths, ViewState& views, QWidget& viewport)
    : QFrame(&viewport)
    , m_paths(paths)
    , m_views(views)
    , m_viewport(viewport)
    , m_text(new QLabel)
    , m_pause(new QPushButton(tr("Pause"))) {
    setObjectName(QStringLiteral("pathBadge"));
    setProperty("overlay", true);
    setAccessibleName(tr("Path tracing"));
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(tokens::kMargin, tokens::kGap, tokens::kGap, tokens::kGap);
    row->setSpacing(tokens::kMargin);
    m_text->setObjectName(QStringLiteral("pathBadgeText"));
    m_text->setToolTip(
        tr("Paths per pixel so far, and how certain that makes the picture: the standard error of "
           "its pixels, as a share of its mean brightness. At ± 1 % it is done."));
    row->addWidget(m_text);
    m_pause->setObjectName(QStringLiteral("pathPause"));
    m_pause->setCheckable(true);
    m_pause->setAccessibleName(tr("Pause path tracing"));
    m_pause->setToolTip(tr("Let the picture rest as it is; a change of the scene goes on"));
    m_pause->setStatusTip(m_pause->toolTip());
    row->addWidget(m_pause);
    connect(m_pause, &QPushButton::clicked, &paths, &PathView::setPaused);
    connect(&paths, &PathView::changed, this, &PathBadge::refresh);
    connect(&views, &ViewState::changed, this, &PathBadge::refresh);
    viewport.installEventFilter(this);
    refresh();
}

QString PathBadge::text() const {
    const render::ViewSettings& view = m_views.settings();
    if (view.split || !view.isOrdinary(view.shown))
        return tr("Path traced: the picture alone. This view is drawn as usual.");
    const PathView::Progress& progress = m_paths.progress();
    if (progress.error)
        return tr("Cannot be traced: %1").arg(toQString(progress.error->message));
    if (progress.samples == 0)
        return tr("Path traced, coarse at first…");
    const QLocale locale;
    QStringList parts{tr("Path traced"), progress.samples == 1
                                             ? tr("1 path per pixel")
                                             : tr("%1 paths per pixel").arg(progress.samples)};
    if (progress.noise)
        parts << tr("± %1 % of the mean").arg(locale.toString(100.0 * *progress.noise, 'g', 2));
    parts << tr("%1 million rays/s").arg(locale.toString(1e-6 * progress.raysPerSecond, 'f', 1));
    parts << tr("%1 s").arg(locale.toString(progress.seconds, 'f', progress.seconds < 10 ? 1 : 0));
    if (progress.refined)
        parts << tr("done");
    return parts.join(QStringLiteral("  ·  "));
}

void PathBadge::refresh() {
    setVisible(m_paths.isOn());
    m_text->setText(text());
    m_pause->setChecked(m_paths.isPaused());
    m_pause->setText(m_paths.isPaused() ? tr("Resume") : tr("Pause"));
    m_pause->setVisible(!m_paths.progress().refined);
    place();
}

void PathBadge::place() {
    adjustSize();
    move(tokens::kMargin, m_viewport.height() - height() - tokens::kMargin);
    raise();
}

bool PathBadge::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Resize && isVisible())
        place();
    return false;
}

} // namespace patina::editor
