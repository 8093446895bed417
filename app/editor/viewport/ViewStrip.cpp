#include "app/editor/viewport/ViewStrip.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/ViewState.h"
#include "app/editor/viewport/ViewThumb.h"
#include "app/editor/widget/FoldButton.h"
#include "core/edit/ViewReasons.h"

#include <QContextMenuEvent>
#include <QHBoxLayout>
#include <QMenu>
#include <QScreen>
#include <QScrollArea>
#include <QScrollBar>
#include <QTabBar>
#include <QToolButton>
#include <QWheelEvent>

namespace patina::editor {
namespace {

constexpr int kRoomyScreen = 640; // height from which the strip is open at first
const char* const kStripFoldedKey = "viewStrip/folded";

// Short, so that all of them have room; the tool tip says the whole name.
QString tabName(ViewGroup group) {
    switch (group) {
    case ViewGroup::Factors:
        return ViewStrip::tr("BRDF");
    case ViewGroup::Direct:
        return ViewStrip::tr("Direct");
    case ViewGroup::Ibl:
        return ViewStrip::tr("IBL");
    case ViewGroup::Picture:
    case ViewGroup::Material:
    case ViewGroup::Geometry:
    case ViewGroup::Lighting:
        break;
    }
    const std::string_view label = viewGroupLabel(group);
    return QString::fromUtf8(label.data(), static_cast<qsizetype>(label.size()));
}

} // namespace

ViewStrip::ViewStrip(ViewState& views, DocumentController& controller, SheetScheduler& sheets,
                     QWidget* parent)
    : QWidget(parent)
    , m_views(views)
    , m_controller(controller)
    , m_sheets(&sheets)
    , m_fold(new FoldButton(tr("Views"), QLatin1String(kStripFoldedKey)))
    , m_groups(new QTabBar)
    , m_scroll(new QScrollArea) {
    setObjectName(QStringLiteral("viewStrip"));
    setAttribute(Qt::WA_StyledBackground);
    m_fold->setObjectName(QStringLiteral("foldViews"));
    m_fold->setAccessibleName(tr("Show the thumbnails of views"));
    m_fold->setToolTip(tr("Show or hide the thumbnails of the views (T)"));
    connect(m_fold, &QToolButton::clicked, this, [this] { setFolded(!isFolded()); });
    m_groups->setObjectName(QStringLiteral("viewGroups"));
    m_groups->setAccessibleName(tr("Groups of views"));
    m_groups->setDrawBase(false);
    m_groups->setExpanding(false);
    m_groups->setFocusPolicy(Qt::TabFocus);
    // In narrow windows they scroll: a name that is cut says nothing.
    m_groups->setUsesScrollButtons(true);
    m_groups->setElideMode(Qt::ElideNone);
    for (int i = 0; i < kViewGroupCount; ++i) {
        const std::string_view label = viewGroupLabel(static_cast<ViewGroup>(i));
        const QString name = QString::fromUtf8(label.data(), static_cast<qsizetype>(label.size()));
        m_groups->addTab(tr("%1  %2").arg(i + 1).arg(tabName(static_cast<ViewGroup>(i))));
        m_groups->setTabToolTip(
            i, tr("%1: the key %2 shows one view after another").arg(name, QString::number(i + 1)));
    }

    auto* header = new QHBoxLayout;
    header->setContentsMargins(tokens::kGap, 0, tokens::kGap, 0);
    header->setSpacing(tokens::kGap);
    header->addWidget(m_fold);
    header->addWidget(m_groups, 1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 2, 0, 2);
    layout->setSpacing(2);
    layout->addLayout(header);
    layout->addWidget(m_scroll);
    makeThumbs();

    connect(m_groups, &QTabBar::currentChanged, this, &ViewStrip::showGroup);
    connect(&m_views, &ViewState::changed, this, &ViewStrip::refreshShown);
    connect(&m_controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.isAnotherDocument()) // what is shown is of the scene before
            for (ViewThumb* thumb : m_thumbs)
                thumb->setPicture({});
        refreshWhy();
    });
    refreshWhy();
    refreshShown();
    showGroup(m_groups->currentIndex());
    const bool small = screen()->availableSize().height() < kRoomyScreen;
    setFolded(m_fold->remembered(small));
    m_sheets->add(*this);
}

ViewStrip::~ViewStrip() {
    if (m_sheets)
        m_sheets->remove(*this);
}

void ViewStrip::makeThumbs() {
    auto* row = new QWidget;
    row->setObjectName(QStringLiteral("panelContents"));
    auto* thumbs = m_row = new QHBoxLayout(row);
    thumbs->setContentsMargins(tokens::kGap, 0, tokens::kGap, 0);
    thumbs->setSpacing(6);
    for (const ViewInfo& info : views()) {
        auto* thumb = new ViewThumb(info.kind);
        connect(thumb, &ViewThumb::clicked, this, [this, kind = info.kind] { click(kind); });
        connect(thumb, &ViewThumb::doubleClicked, this,
                [this, kind = info.kind] { doubleClick(kind); });
        thumb->installEventFilter(this);
        thumbs->addWidget(thumb);
        m_thumbs.push_back(thumb);
    }
    thumbs->addStretch(1);
    m_scroll->setWidget(row);
    m_scroll->setWidgetResizable(true);
    m_scroll->setFrameShape(QFrame::NoFrame);
    m_scroll->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_scroll->setFocusPolicy(Qt::NoFocus);
    m_scroll->setFixedHeight(m_thumbs.front()->sizeHint().height() +
                             m_scroll->horizontalScrollBar()->sizeHint().height());
    m_scroll->viewport()->installEventFilter(this);
    connect(m_scroll->horizontalScrollBar(), &QScrollBar::valueChanged, m_sheets,
            &SheetScheduler::wake);
}

bool ViewStrip::isFolded() const {
    return m_fold->isFolded();
}

void ViewStrip::setFolded(bool folded) {
    m_scroll->setVisible(!folded);
    m_groups->setVisible(!folded);
    m_fold->setFolded(folded);
    showControls();
    m_sheets->wake();
    Q_EMIT foldedChanged(folded);
}

void ViewStrip::addControl(ViewGroup group, QWidget* control) {
    m_row->insertWidget(m_row->count() - 1, control); // before what stretches
    m_controls.emplace_back(group, control);
    showControls();
}

void ViewStrip::showControls() {
    for (const auto& [group, control] : m_controls)
        control->setVisible(!isFolded() && m_groups->currentIndex() == static_cast<int>(group));
}

void ViewStrip::showGroup(int group) {
    for (ViewThumb* thumb : m_thumbs)
        thumb->setVisible(static_cast<int>(viewInfo(thumb->kind()).group) == group);
    showControls();
    m_scroll->horizontalScrollBar()->setValue(0);
    m_sheets->wake();
}

void ViewStrip::refreshShown() {
    const render::ViewSettings& settings = m_views.settings();
    const ViewKind shown = settings.shown.kind;
    for (ViewThumb* thumb : m_thumbs)
        thumb->setCurrent(thumb->kind() == shown,
                          settings.split && thumb->kind() == settings.split->other.kind);
    if (settings.light != m_light) {
        m_light = settings.light;
        refreshWhy();
    }
    if (shown == m_marked)
        return;
    m_marked = shown;
    m_groups->setCurrentIndex(static_cast<int>(viewInfo(shown).group));
    // When the thumbnails of its group have their places.
    QMetaObject::invokeMethod(
        this,
        [this, shown] {
            m_scroll->ensureWidgetVisible(m_thumbs[static_cast<std::size_t>(shown)],
                                          ViewThumb::kPicture.width() / 2, 0);
        },
        Qt::QueuedConnection);
}

void ViewStrip::refreshWhy() {
    for (ViewThumb* thumb : m_thumbs)
        thumb->setWhyEmpty(QString::fromStdString(
            whyEmpty(thumb->kind(), m_controller.document(), m_views.settings().light)));
    m_sheets->wake();
}

// --- Thumbnails ------------------------------------------------------------------------------

render::ViewSheet ViewStrip::wantedSheet() const {
    const double ratio = devicePixelRatioF();
    render::ViewSheet sheet;
    sheet.width = qRound(ViewThumb::kPicture.width() * ratio);
    sheet.height = qRound(ViewThumb::kPicture.height() * ratio);
    for (const ViewThumb* thumb : m_thumbs)
        if (!thumb->isEmpty() && !thumb->visibleRegion().isEmpty())
            sheet.kinds.push_back(thumb->kind());
    return sheet;
}

void ViewStrip::showThumbnail(ViewKind kind, const QImage& picture) {
    m_thumbs[static_cast<std::size_t>(kind)]->setPicture(picture);
}

void ViewStrip::showEvent(QShowEvent*) {
    m_sheets->wake();
}

// --- The hand --------------------------------------------------------------------------------

void ViewStrip::click(ViewKind kind) {
    m_beforeClick = m_views.shown();
    m_views.show(kind);
}

void ViewStrip::doubleClick(ViewKind kind) {
    // The first of the two clicks has shown it already.
    m_views.show(m_beforeClick);
    m_views.showOther(kind);
}

void ViewStrip::openMenu(ViewKind kind, const QPoint& global) {
    auto* menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->addAction(tr("&Show"), this, [this, kind] { m_views.show(kind); });
    menu->addAction(tr("Show on the &Other Side"), this, [this, kind] { m_views.showOther(kind); });
    menu->popup(global);
}

bool ViewStrip::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Resize || event->type() == QEvent::Show)
        m_sheets->wake();
    if (event->type() == QEvent::ContextMenu) {
        if (const auto* thumb = qobject_cast<ViewThumb*>(watched)) {
            openMenu(thumb->kind(), static_cast<QContextMenuEvent*>(event)->globalPos());
            return true;
        }
    }
    // The wheel turns sideways: there is nothing to scroll the other way.
    if (event->type() == QEvent::Wheel && watched == m_scroll->viewport()) {
        scrollSideways(*m_scroll, *static_cast<QWheelEvent*>(event));
        return true;
    }
    return QWidget::eventFilter(watched, event);
}

} // namespace patina::editor
