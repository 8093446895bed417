#include "app/editor/panel/HistoryPanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/wall/WallState.h"
#include "core/edit/EditSession.h"

#include <QListWidget>
#include <QVBoxLayout>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr QSize kPicture(96, 54);
constexpr int kRefreshMs = 50;

QPixmap placeholder(qreal ratio) {
    QPixmap empty(kPicture * ratio);
    empty.setDevicePixelRatio(ratio);
    empty.fill(QColor(tokens::kRaised));
    return empty;
}

// The same picture when its row is selected, without the tint of the selection.
QIcon asIcon(const QPixmap& picture) {
    QIcon icon(picture);
    icon.addPixmap(picture, QIcon::Selected);
    return icon;
}

bool isSameState(const DocumentState& a, const DocumentState& b) {
    return a.history == b.history && a.step == b.step;
}

} // namespace

HistoryPanel::HistoryPanel(DocumentController& controller, ViewportWidget& viewport,
                           const WallState& wall, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_viewport(viewport)
    , m_wall(wall)
    , m_list(new QListWidget) {
    m_list->setAccessibleName(tr("History"));
    m_list->setStatusTip(tr("Click a step to go there; the ones after it stay until you edit"));
    m_list->setIconSize(kPicture);
    m_list->setUniformItemSizes(true);
    m_list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    m_list->setTextElideMode(Qt::ElideRight);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(tokens::kGap, 0, tokens::kGap, tokens::kGap);
    layout->addWidget(m_list);
    m_refresh.setSingleShot(true);
    m_refresh.setInterval(kRefreshMs);
    connect(&m_refresh, &QTimer::timeout, this, &HistoryPanel::refresh);
    connect(m_list, &QListWidget::itemClicked, this,
            [this](QListWidgetItem* item) { go(m_list->row(item)); });
    connect(m_list, &QListWidget::itemActivated, this,
            [this](QListWidgetItem* item) { go(m_list->row(item)); });
    connect(&controller.undoStack(), &UndoStack::stepsChanged, this, &HistoryPanel::follow);
    connect(&viewport, &ViewportWidget::frameRendered, this, [this](double, PictureState state) {
        if (state == PictureState::Refined && m_picturedRevision != m_controller.revision())
            QTimer::singleShot(0, this, &HistoryPanel::takePicture); // the frame is being painted
    });
    refresh();
}

void HistoryPanel::follow() {
    if (isVisible() && !m_refresh.isActive())
        m_refresh.start();
}

void HistoryPanel::showEvent(QShowEvent* event) {
    refresh();
    QWidget::showEvent(event);
}

void HistoryPanel::go(int row) {
    if (row != m_controller.undoStack().index())
        m_controller.session().goTo(row);
}

QImage HistoryPanel::pictureOf(const DocumentState& state) const {
    const auto found = std::ranges::find_if(
        m_pictures, [&](const auto& entry) { return isSameState(entry.first, state); });
    return found != m_pictures.end() ? found->second : QImage();
}

// Rows that show what they did are left alone: a history may have a thousand.
void HistoryPanel::refresh() {
    EditSession& session = m_controller.session();
    const int count = session.count() + 1;
    const qreal ratio = devicePixelRatioF();
    std::vector<DocumentState> states;
    for (int row = 0; row < count; ++row) {
        const EditSession::HistoryEntry entry = session.historyEntry(row);
        states.push_back(entry.state);
        const auto known = static_cast<std::size_t>(row);
        const bool same = known < m_states.size() && isSameState(m_states[known], entry.state);
        QListWidgetItem* item = m_list->item(row);
        if (item == nullptr) {
            item = new QListWidgetItem;
            m_list->addItem(item);
        }
        if (!same) {
            const QString text = row == 0 ? tr("Start") : toQString(entry.text);
            const QString values = toQString(entry.values);
            item->setText(values.isEmpty() ? text : text + QLatin1Char('\n') + values);
            item->setToolTip(item->text());
            item->setSizeHint({0, kPicture.height() + tokens::kGap});
            QPixmap icon = placeholder(ratio);
            if (const QImage picture = pictureOf(entry.state); !picture.isNull())
                icon = QPixmap::fromImage(picture);
            item->setIcon(asIcon(icon));
        }
        // What redo would do again.
        item->setForeground(QColor(row > session.index() ? tokens::kTextOff : tokens::kText));
    }
    while (m_list->count() > count)
        delete m_list->takeItem(m_list->count() - 1);
    m_states = std::move(states);
    m_list->setCurrentRow(session.index());
    m_list->scrollToItem(m_list->currentItem());
}

void HistoryPanel::takePicture() {
    if (!m_viewport.isSettled() || m_wall.isOn())
        return;
    const DocumentState state =
        m_controller.session().historyEntry(m_controller.undoStack().index()).state;
    QImage picture = m_viewport.smallPicture(kPicture * devicePixelRatioF());
    if (picture.isNull())
        return;
    m_picturedRevision = m_controller.revision();
    picture.setDevicePixelRatio(devicePixelRatioF());
    std::erase_if(m_pictures, [&](const auto& entry) { return isSameState(entry.first, state); });
    m_pictures.emplace_back(state, picture);
    if (m_pictures.size() > kMostPictures)
        m_pictures.pop_front();
    const auto row = std::ranges::find_if(
        m_states, [&](const DocumentState& other) { return isSameState(other, state); });
    if (row != m_states.end() && isVisible())
        m_list->item(static_cast<int>(row - m_states.begin()))
            ->setIcon(asIcon(QPixmap::fromImage(picture)));
}

} // namespace patina::editor
