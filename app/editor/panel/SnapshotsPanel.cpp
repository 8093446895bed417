#include "app/editor/panel/SnapshotsPanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/DraggedElements.h"
#include "app/editor/document/QtText.h"
#include "app/editor/panel/LookPictures.h"
#include "app/editor/panel/SnapshotComparison.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/wall/WallState.h"
#include "app/editor/widget/ListButton.h"
#include "app/editor/widget/ListItems.h"
#include "app/editor/widget/StatusHint.h"
#include "core/document/Document.h"
#include "core/document/Snapshot.h"
#include "core/edit/EditSession.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QListWidget>
#include <QMimeData>
#include <QShortcut>
#include <QSplitter>
#include <QToolButton>
#include <QVBoxLayout>

namespace patina::editor {
namespace {

constexpr QSize kThumb(80, 50);
constexpr int kKeptSide = 160; // pixels, at most
constexpr int kSnapshotRefreshMs = 50;
constexpr int kListHeight = 200;

QIcon thumbOf(const ImagePtr& picture, qreal ratio) {
    QPixmap pixmap(kThumb * ratio);
    pixmap.fill(QColor(tokens::kRaised));
    if (picture) {
        const QImage scaled =
            qImageOf(*picture).scaled(pixmap.size(), Qt::KeepAspectRatio, Qt::SmoothTransformation);
        pixmap = QPixmap::fromImage(scaled);
    }
    pixmap.setDevicePixelRatio(ratio);
    QIcon icon(pixmap);
    icon.addPixmap(pixmap, QIcon::Selected); // without the tint of the selection
    return icon;
}

// Its items can be dragged onto the viewport.
class SnapshotList : public QListWidget {
  public:
    explicit SnapshotList(const EditSession& session)
        : m_session(session) {
        setDragDropMode(QAbstractItemView::DragOnly);
    }

  protected:
    [[nodiscard]] QStringList mimeTypes() const override { return {QLatin1String(kElementsMime)}; }
    [[nodiscard]] QMimeData* mimeData(const QList<QListWidgetItem*>& items) const override {
        DraggedElements dragged{CellElement::Snapshot, {}};
        for (int row = 0; row < count(); ++row) // in their order, however they were chosen
            if (items.contains(item(row)))
                dragged.ids.push_back(idOf(*item(row)));
        auto* data = new QMimeData;
        setDraggedElements(*data, m_session, dragged);
        return data;
    }

  private:
    const EditSession& m_session;
};

} // namespace

SnapshotsPanel::SnapshotsPanel(DocumentController& controller, ViewportWidget& viewport,
                               const WallState& wall, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_viewport(viewport)
    , m_wall(wall)
    , m_list(new SnapshotList(controller.session()))
    , m_restore(makeListButton(QStringLiteral("reset"), tr("Restore"),
                               tr("Make the scene look like the snapshot, as one undo step")))
    , m_rename(makeListButton(QStringLiteral("rename"), {}, tr("Rename the snapshot (F2)")))
    , m_remove(makeListButton(QStringLiteral("remove"), {}, tr("Remove the snapshots")))
    , m_comparison(new SnapshotComparison(controller)) {
    m_list->setAccessibleName(tr("Snapshots"));
    m_list->setStatusTip(tr("Choose one to compare it with the scene, two to compare them; "
                            "double-click to restore; drag one onto a cell of a wall"));
    m_list->setIconSize(kThumb);
    m_list->setUniformItemSizes(true);
    m_list->setSelectionMode(QAbstractItemView::ExtendedSelection);
    m_list->setEditTriggers(QAbstractItemView::EditKeyPressed);
    m_list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* top = new QWidget;
    auto* column = new QVBoxLayout(top);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(tokens::kGap / 2);
    column->addWidget(makeButtons());
    column->addWidget(m_list, 1);
    auto* splitter = new QSplitter(Qt::Vertical);
    splitter->setChildrenCollapsible(false);
    splitter->addWidget(top);
    splitter->addWidget(m_comparison);
    splitter->setStretchFactor(1, 1);
    splitter->setSizes({kListHeight, 2 * kListHeight});
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(tokens::kGap, tokens::kGap / 2, tokens::kGap, tokens::kGap);
    layout->addWidget(splitter);

    m_refresh.setSingleShot(true);
    m_refresh.setInterval(kSnapshotRefreshMs);
    connect(&m_refresh, &QTimer::timeout, this, &SnapshotsPanel::refresh);
    connect(m_list, &QListWidget::itemSelectionChanged, this, [this] {
        if (!m_refreshing)
            compare();
    });
    connect(m_list, &QListWidget::itemDoubleClicked, this, &SnapshotsPanel::restore);
    connect(m_list, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
        if (m_refreshing)
            return;
        m_controller.session().renameSnapshot(idOf(*item), item->text().toStdString());
        refresh(); // without a name, or with another's, it is called otherwise
    });
    auto* removeKey = new QShortcut(QKeySequence::Delete, m_list);
    removeKey->setContext(Qt::WidgetShortcut);
    connect(removeKey, &QShortcut::activated, this, &SnapshotsPanel::remove);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.isAnotherDocument()) { // in which ids mean others
            m_refreshing = true;
            m_list->clear();
            m_refreshing = false;
            m_awaited = {};
        }
        follow();
    });
    connect(&wall, &WallState::changed, this, &SnapshotsPanel::follow);
    connect(&viewport, &ViewportWidget::frameRendered, this, [this](double, PictureState state) {
        if (state == PictureState::Refined)
            QTimer::singleShot(0, this, &SnapshotsPanel::takePictures); // it is being painted
    });
    refresh();
}

QWidget* SnapshotsPanel::makeButtons() {
    QToolButton* keepButton =
        makeListButton(QStringLiteral("add"), tr("Keep"),
                       tr("Keep what the scene looks like as a snapshot (Ctrl+K)"));
    connect(keepButton, &QToolButton::clicked, this, &SnapshotsPanel::keep);
    connect(m_restore, &QToolButton::clicked, this, &SnapshotsPanel::restore);
    connect(m_rename, &QToolButton::clicked, this, [this] {
        if (QListWidgetItem* item = m_list->currentItem())
            m_list->editItem(item);
    });
    connect(m_remove, &QToolButton::clicked, this, &SnapshotsPanel::remove);
    auto* buttons = new QWidget;
    auto* row = new QHBoxLayout(buttons);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(4);
    row->addWidget(keepButton);
    row->addWidget(m_restore);
    row->addStretch(1);
    row->addWidget(m_rename);
    row->addWidget(m_remove);
    return buttons;
}

// --- Edits ---------------------------------------------------------------------------------------

void SnapshotsPanel::keep() {
    const bool settled = m_viewport.isSettled();
    // What is shown now, though it may lag behind: better than none until the next frame.
    const Id id = m_controller.session().keepSnapshot({}, picture());
    if (id == 0) {
        showHint(
            *this,
            tr("There are %1 snapshots, the most a scene has: remove some").arg(kMaxSnapshots));
        return;
    }
    if (!settled && !m_wall.isOn())
        m_awaited = {id, m_controller.revision()};
    refresh();
    for (int row = 0; row < m_list->count(); ++row)
        if (idOf(*m_list->item(row)) == id)
            m_list->setCurrentRow(row, QItemSelectionModel::ClearAndSelect);
    m_list->scrollToItem(m_list->currentItem());
    showHint(*this, tr("%1 is kept; Ctrl+Shift+K shows the snapshots")
                        .arg(toQString(m_controller.document().snapshot(id)->name)));
}

void SnapshotsPanel::restore() {
    const std::vector<Id> ids = selected();
    if (ids.size() == 1)
        m_controller.session().restoreSnapshot(ids.front());
}

void SnapshotsPanel::remove() {
    EditSession& session = m_controller.session();
    const std::vector<Id> ids = selected();
    if (ids.size() == 1)
        session.removeSnapshot(ids.front());
    else if (!ids.empty())
        session.group(tr("Remove %1 Snapshots").arg(ids.size()).toStdString(), [&] {
            for (const Id id : ids)
                session.removeSnapshot(id);
        });
}

// --- Pictures ------------------------------------------------------------------------------------

ImagePtr SnapshotsPanel::picture() const {
    return m_wall.isOn() ? nullptr : imageOf(m_viewport.smallPicture({kKeptSide, kKeptSide}));
}

void SnapshotsPanel::takePictures() {
    const bool compares = isVisible() && selected().size() == 1;
    const bool awaits = m_awaited.snapshot != 0;
    if ((!compares && !awaits) || m_wall.isOn() || !m_viewport.isSettled())
        return;
    const quint64 revision = m_controller.revision();
    if (compares && m_now && m_nowRevision == revision && !awaits)
        return;
    const ImagePtr shown = picture();
    if (compares) {
        m_now = shown;
        m_nowRevision = revision;
    }
    if (awaits) {
        const auto awaited = std::exchange(m_awaited, {});
        if (awaited.revision == revision && shown)
            m_controller.session().setSnapshotPicture(awaited.snapshot, shown);
    }
    if (compares)
        compare();
}

// --- What is shown -------------------------------------------------------------------------------

void SnapshotsPanel::showEvent(QShowEvent* event) {
    refresh();
    QWidget::showEvent(event);
}

void SnapshotsPanel::follow() {
    if (isVisible() && !m_refresh.isActive())
        m_refresh.start();
}

std::vector<Id> SnapshotsPanel::selected() const {
    std::vector<Id> ids;
    for (int row = 0; row < m_list->count(); ++row)
        if (m_list->item(row)->isSelected())
            ids.push_back(idOf(*m_list->item(row)));
    return ids;
}

void SnapshotsPanel::refresh() {
    refreshList();
    compare();
}

void SnapshotsPanel::refreshList() {
    const Document& document = m_controller.document();
    m_refreshing = true;
    removeItems(*m_list, [&](Id id) { return document.snapshot(id) == nullptr; });
    for (int row = 0; row < static_cast<int>(document.snapshots.size()); ++row) {
        const Snapshot& snapshot = document.snapshots[static_cast<std::size_t>(row)];
        QListWidgetItem* item = placeItem(*m_list, snapshot.id, row, Qt::ItemIsEditable);
        item->setText(toQString(snapshot.name));
        item->setToolTip(item->text());
        item->setSizeHint({0, kThumb.height() + tokens::kGap});
        // Its picture comes once, or twice.
        const QVariant known =
            QVariant::fromValue<void*>(const_cast<Image*>(snapshot.picture.get()));
        if (item->icon().isNull() || item->data(Qt::UserRole + 1) != known) {
            item->setData(Qt::UserRole + 1, known);
            item->setIcon(thumbOf(snapshot.picture, devicePixelRatioF()));
        }
    }
    m_refreshing = false;
}

void SnapshotsPanel::compare() {
    const std::vector<Id> ids = selected();
    m_restore->setEnabled(ids.size() == 1);
    m_rename->setEnabled(ids.size() == 1);
    m_remove->setEnabled(!ids.empty());
    if (!isVisible())
        return;
    const Document& document = m_controller.document();
    if (ids.empty() || ids.size() > 2) {
        m_comparison->clear(
            document.snapshots.empty()
                ? tr("A snapshot keeps what the scene looks like: materials, lights, environments, "
                     "exposure. Press Keep, go on editing, and come back to any of its values.")
            : ids.empty() ? tr("Choose a snapshot to compare it with the scene, or two of them "
                               "(Ctrl + click) to compare them with each other.")
                          : tr("Choose one snapshot or two."));
        return;
    }
    const auto side = [&](Id id) {
        const Snapshot& snapshot = *document.snapshot(id);
        return SnapshotComparison::Side{toQString(snapshot.name), snapshot.look, snapshot.picture,
                                        tr("Kept without a picture"), false};
    };
    const SnapshotComparison::Side a = side(ids.front());
    if (ids.size() == 2) {
        m_comparison->setSides(a, side(ids.back()));
        return;
    }
    const bool wall = m_wall.isOn();
    m_comparison->setSides(a, {tr("Scene"), lookOf(document, a.look.get()), wall ? nullptr : m_now,
                               wall ? tr("The viewport shows a wall") : tr("Drawing…"), true});
    if (!wall && m_nowRevision != m_controller.revision() && m_viewport.isSettled())
        QTimer::singleShot(0, this, &SnapshotsPanel::takePictures);
}

} // namespace patina::editor
