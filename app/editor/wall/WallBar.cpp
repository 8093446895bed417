#include "app/editor/wall/WallBar.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/wall/CompareControls.h"
#include "app/editor/wall/OwnValueControls.h"
#include "app/editor/wall/WallAxisControls.h"
#include "app/editor/wall/WallComparison.h"
#include "app/editor/wall/WallState.h"
#include "app/editor/widget/FlowLayout.h"
#include "app/editor/widget/ListButton.h"
#include "app/editor/widget/TextButton.h"

#include <QToolButton>
#include <QVBoxLayout>

namespace patina::editor {

WallBar::WallBar(WallState& wall, WallComparison& comparison, DocumentController& controller,
                 SelectionModel& selection, QWidget* parent)
    : QFrame(parent)
    , m_wall(wall)
    , m_columns(new WallAxisControls(WallAxisControls::Axis::Columns, wall, controller, selection))
    , m_rows(new WallAxisControls(WallAxisControls::Axis::Rows, wall, controller, selection))
    , m_use(makeTextButton(tr("Use in Scene"),
                           tr("Make the scene what the current cell shows, as one step")))
    , m_enlarge(makeListButton(
          QStringLiteral("full-screen"), {},
          tr("Show the current cell alone, or all of them again (double-click or Enter)")))
    , m_save(makeListButton(QStringLiteral("save-as"), {},
                            tr("Save the wall as a sheet: PNG, JPEG, TIFF, OpenEXR or PDF"))) {
    setObjectName(QStringLiteral("wallBar"));
    m_enlarge->setCheckable(true);
    QToolButton* close =
        makeListButton(QStringLiteral("close"), {}, tr("Show one picture again (F3 or Esc)"));
    constexpr int kBetween = 3 * tokens::kGap / 4; // on one line in a window of 1366 pixels
    auto* row = new FlowLayout(kBetween, tokens::kGap / 2);
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(tokens::kGap, tokens::kGap / 2, tokens::kGap, tokens::kGap / 2);
    rows->setSpacing(tokens::kGap / 2);
    rows->addLayout(row);
    auto* own = new OwnValueControls(wall, controller);
    rows->addWidget(own);
    rows->addWidget(new CompareControls(wall, comparison));
    for (QWidget* widget : {static_cast<QWidget*>(m_columns), static_cast<QWidget*>(m_rows),
                            static_cast<QWidget*>(m_enlarge), static_cast<QWidget*>(own->button()),
                            static_cast<QWidget*>(m_use), static_cast<QWidget*>(m_save),
                            static_cast<QWidget*>(close)})
        row->addWidget(widget);
    connect(m_use, &QPushButton::clicked, &wall, &WallState::useInScene);
    connect(m_enlarge, &QPushButton::clicked, this,
            [this] { m_wall.enlarge(m_wall.enlarged() ? std::nullopt : m_wall.current()); });
    m_save->setObjectName(QStringLiteral("saveSheet"));
    m_save->setAccessibleName(tr("Save Sheet"));
    connect(m_save, &QToolButton::clicked, this, &WallBar::sheetWanted);
    connect(close, &QToolButton::clicked, this, [this] { m_wall.setOn(false); });
    connect(&wall, &WallState::changed, this, &WallBar::refresh);
    connect(&wall, &WallState::cellsChosen, this, &WallBar::refresh);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (m_wall.isOn() && change.affects != Affects::Nothing)
            refresh();
    });
    refresh();
}

void WallBar::refresh() {
    setVisible(m_wall.isOn());
    if (!m_wall.isOn())
        return;
    m_columns->refresh();
    m_rows->refresh();
    m_use->setEnabled(m_wall.current().has_value());
    m_enlarge->setEnabled(m_wall.current().has_value());
    m_enlarge->setChecked(m_wall.enlarged().has_value());
    m_save->setEnabled(!m_wall.cells().empty());
}

} // namespace patina::editor
