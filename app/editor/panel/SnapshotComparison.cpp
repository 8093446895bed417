#include "app/editor/panel/SnapshotComparison.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "core/edit/Looks.h"
#include "core/image/Srgb.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QTreeWidget>
#include <QTreeWidgetItemIterator>
#include <QVBoxLayout>
#include <algorithm>
#include <filesystem>
#include <set>

namespace patina::editor {
namespace {

enum Column { kParameter, kValueA, kValueB, kTableColumns };
// Of a value its index; of an element nothing.
constexpr int kIndexRole = Qt::UserRole, kKeyRole = Qt::UserRole + 1;

// Of a file its name: its folder is in the tip.
QString shortText(const LookDifference& difference, const std::string& text) {
    const bool isFile = difference.info != nullptr && difference.info->type == ParameterType::Map &&
                        text.find('/') != text.npos;
    return isFile ? fromPath(toPath(toQString(text)).filename()) : toQString(text);
}

void setSwatch(QTreeWidgetItem& item, int column, const ParameterValue& value) {
    const glm::vec3 color = std::get<glm::vec3>(value);
    item.setData(column, Qt::DecorationRole,
                 QColor(linearToSrgb8(color.r), linearToSrgb8(color.g), linearToSrgb8(color.b)));
}

QLabel* makeComparisonHint() {
    auto* hint = new QLabel;
    hint->setWordWrap(true);
    hint->setAlignment(Qt::AlignCenter);
    hint->setEnabled(false);
    return hint;
}

} // namespace

SnapshotComparison::SnapshotComparison(DocumentController& controller, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_pictures(new LookPictures(controller.runner()))
    , m_table(new QTreeWidget)
    , m_hint(makeComparisonHint())
    , m_same(makeComparisonHint())
    , m_content(new QWidget)
    , m_restoreA(new QPushButton(tr("Restore All")))
    , m_restoreB(new QPushButton(tr("Restore All"))) {
    m_table->setAccessibleName(tr("Values that differ"));
    m_table->setStatusTip(tr("Double-click a value to restore it; select some to restore those"));
    m_table->setColumnCount(kTableColumns);
    m_table->setIndentation(tokens::kMargin);
    m_table->setUniformRowHeights(true);
    m_table->setExpandsOnDoubleClick(false);
    m_table->setSelectionMode(QAbstractItemView::ExtendedSelection);
    m_table->setTextElideMode(Qt::ElideMiddle);
    QHeaderView* header = m_table->header();
    header->setStretchLastSection(false);
    header->setMinimumSectionSize(48);
    header->setSectionResizeMode(QHeaderView::Stretch);
    connect(m_table, &QTreeWidget::itemSelectionChanged, this, &SnapshotComparison::refreshButtons);
    connect(m_table, &QTreeWidget::itemDoubleClicked, this,
            [this](QTreeWidgetItem* item, int column) { restoreOne(*item, column); });
    connect(m_restoreA, &QPushButton::clicked, this, [this] { restore(m_a); });
    connect(m_restoreB, &QPushButton::clicked, this, [this] { restore(m_b); });

    auto* column = new QVBoxLayout(m_content);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(tokens::kGap);
    column->addWidget(m_pictures);
    m_same->setText(tr("No value differs."));
    column->addWidget(m_same, 1);
    column->addWidget(m_table, 1);
    auto* buttons = new QHBoxLayout;
    buttons->setSpacing(tokens::kGap);
    buttons->addWidget(m_restoreA);
    buttons->addWidget(m_restoreB);
    column->addLayout(buttons);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(m_hint, 1);
    layout->addWidget(m_content, 1);
    clear({});
}

void SnapshotComparison::clear(const QString& hint) {
    m_a = m_b = {};
    m_differences.clear();
    m_pictures->clear();
    m_table->clear();
    m_hint->setText(hint);
    m_hint->show();
    m_content->hide();
}

void SnapshotComparison::setSides(const Side& a, const Side& b) {
    m_a = a;
    m_b = b;
    const bool moved = a.look->view.camera != b.look->view.camera;
    m_pictures->setSides({a.name, a.picture, a.absence}, {b.name, b.picture, b.absence},
                         moved ? tr("The camera has moved between them") : QString());
    m_differences = differencesOf(*a.look, *b.look);
    fillTable();
    refreshButtons();
    m_same->setVisible(m_differences.empty());
    m_table->setVisible(!m_differences.empty());
    m_hint->hide();
    m_content->show();
}

QString SnapshotComparison::reason(const Side& side, const LookDifference& difference) const {
    if (side.isScene)
        return {};
    return toQString(whyNotRestored(m_controller.document(), *side.look, difference));
}

void SnapshotComparison::fillRow(QTreeWidgetItem& item, std::size_t index) {
    const LookDifference& one = m_differences[index];
    item.setData(kParameter, kIndexRole, static_cast<int>(index));
    item.setText(kParameter, one.info ? toQString(one.label) : tr("All of it"));
    item.setToolTip(kParameter, item.text(kParameter));
    const auto side = [&](int column, const Side& of, const std::string& text,
                          const ParameterValue& value) {
        const QString why = reason(of, one);
        item.setText(column, shortText(one, text));
        item.setToolTip(column, why.isEmpty()
                                    ? toQString(text)
                                    : tr("%1. Cannot be restored: %2 %3")
                                          .arg(toQString(text), toQString(one.element), why));
        item.setForeground(column, QColor(why.isEmpty() ? tokens::kText : tokens::kTextOff));
        if (one.info != nullptr && one.info->type == ParameterType::Color)
            setSwatch(item, column, value);
    };
    side(kValueA, m_a, one.textA, one.a);
    side(kValueB, m_b, one.textB, one.b);
}

// What is selected and how far it is scrolled stays, while values change under it.
void SnapshotComparison::fillTable() {
    const QSignalBlocker quiet(m_table);
    std::set<QString> selected, folded;
    for (QTreeWidgetItemIterator it(m_table); *it; ++it) {
        if ((*it)->isSelected())
            selected.insert((*it)->data(kParameter, kKeyRole).toString());
        if ((*it)->childCount() > 0 && !(*it)->isExpanded())
            folded.insert((*it)->data(kParameter, kKeyRole).toString());
    }
    const int scrolled = m_table->verticalScrollBar()->value();
    m_table->clear();
    m_table->setHeaderLabels({tr("Parameter"), m_a.name, m_b.name});
    QTreeWidgetItem* element = nullptr;
    for (std::size_t i = 0; i < m_differences.size(); ++i) {
        const LookDifference& one = m_differences[i];
        const QString of =
            QStringLiteral("%1 %2").arg(static_cast<int>(one.target.scope)).arg(one.target.id);
        if (element == nullptr || element->data(kParameter, kKeyRole).toString() != of) {
            element = new QTreeWidgetItem(m_table, {toQString(one.element)});
            element->setData(kParameter, kKeyRole, of);
            element->setToolTip(kParameter, toQString(one.element));
            element->setFirstColumnSpanned(true);
            element->setExpanded(!folded.contains(of));
            element->setSelected(selected.contains(of));
        }
        auto* row = new QTreeWidgetItem(element);
        const QString key =
            of + QLatin1Char(' ') + (one.info ? toQString(one.info->id) : QString());
        row->setData(kParameter, kKeyRole, key);
        fillRow(*row, i);
        row->setSelected(selected.contains(key));
    }
    m_table->verticalScrollBar()->setValue(scrolled);
}

std::vector<LookDifference> SnapshotComparison::chosen() const {
    std::vector<LookDifference> found;
    for (QTreeWidgetItemIterator it(m_table); *it; ++it) {
        const QTreeWidgetItem& item = **it;
        const bool isChosen = item.isSelected() || (item.parent() && item.parent()->isSelected());
        if (item.parent() && isChosen)
            found.push_back(
                m_differences[static_cast<std::size_t>(item.data(kParameter, kIndexRole).toInt())]);
    }
    return found.empty() ? m_differences : found;
}

void SnapshotComparison::restoreOne(QTreeWidgetItem& item, int column) {
    const Side side = column == kValueB ? m_b : m_a;
    if (side.isScene || item.parent() == nullptr)
        return;
    const LookDifference one =
        m_differences[static_cast<std::size_t>(item.data(kParameter, kIndexRole).toInt())];
    m_controller.session().restoreLook(
        *side.look, {one},
        tr("Restore %1 of %2")
            .arg(toQString(one.info ? one.label : one.element), side.name)
            .toStdString());
}

void SnapshotComparison::refreshButtons() {
    const std::vector<LookDifference> restored = chosen();
    const bool all = m_table->selectedItems().isEmpty();
    const auto show = [&](QPushButton* button, const Side& side) {
        button->setVisible(!side.isScene && side.look != nullptr);
        if (side.isScene || !side.look)
            return;
        const auto possible =
            std::ranges::count_if(restored, [&](const LookDifference& difference) {
                return reason(side, difference).isEmpty();
            });
        const QString name = fontMetrics().elidedText(side.name, Qt::ElideRight, 90);
        button->setText(all ? tr("Restore All of %1").arg(name)
                            : tr("Restore %1 of %2").arg(possible).arg(name));
        button->setEnabled(possible > 0);
        const QString tip = m_differences.empty() ? tr("Both look the same")
                            : possible == 0
                                ? tr("None of the values can be restored; their tips say why")
                                : tr("Give the scene these values, as one undo step");
        button->setToolTip(tip);
        button->setStatusTip(tip);
    };
    show(m_restoreA, m_a);
    show(m_restoreB, m_b);
}

void SnapshotComparison::restore(const Side& side) {
    const std::vector<LookDifference> restored = chosen();
    const LookPtr look = side.look; // the edit may end what is compared
    const QString text =
        restored.size() == 1 && restored.front().info != nullptr
            ? tr("Restore %1 of %2").arg(toQString(restored.front().label), side.name)
            : tr("Restore %1").arg(side.name);
    m_controller.session().restoreLook(*look, restored, text.toStdString());
}

} // namespace patina::editor
