#include "tests/app/editor/TextFit.h"

#include "app/editor/widget/ElidedLabel.h"
#include "app/editor/widget/NumberField.h"

#include <QAbstractButton>
#include <QCheckBox>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QRegularExpression>
#include <QStyle>
#include <QStyleOptionComboBox>
#include <QStyleOptionFrame>
#include <QTabBar>
#include <QTableView>
#include <QToolButton>
#include <QTreeView>

namespace patina::editor {
namespace {

// A pixel of rounding is no cut.
constexpr int kSlack = 1;

int widthOf(const QWidget& widget, QString text) {
    return widget.fontMetrics().horizontalAdvance(text.remove(QLatin1Char('&')));
}

bool isNumber(const QString& text) {
    static const QRegularExpression number(
        QStringLiteral("^[-−+±#]?[0-9][0-9 .,×x²%°–\\-]*[a-zA-Zµ%°/ ]{0,4}$"));
    return number.match(text.trimmed()).hasMatch();
}

bool labelIsCut(const QLabel& label) {
    if (label.text().isEmpty() || label.textFormat() == Qt::RichText ||
        Qt::mightBeRichText(label.text()))
        return label.wordWrap() && label.heightForWidth(label.width()) > label.height() + kSlack;
    const int room = label.contentsRect().width() - 2 * label.margin();
    if (qobject_cast<const ElidedLabel*>(&label))
        return isNumber(label.text()) && widthOf(label, label.text()) > room + kSlack;
    if (!label.wordWrap()) {
        int widest = 0;
        for (const QString& line : label.text().split(QLatin1Char('\n')))
            widest = std::max(widest, widthOf(label, line));
        return widest > room + kSlack;
    }
    for (const QString& word : label.text().split(QRegularExpression(QStringLiteral("\\s"))))
        if (widthOf(label, word) > room + kSlack)
            return true;
    return label.heightForWidth(label.width()) > label.height() + kSlack;
}

bool buttonIsCut(const QAbstractButton& button) {
    if (button.text().isEmpty())
        return false;
    if (const auto* tool = qobject_cast<const QToolButton*>(&button);
        tool && tool->toolButtonStyle() == Qt::ToolButtonIconOnly && !tool->icon().isNull())
        return false;
    int taken = 0; // beside the text
    if (qobject_cast<const QCheckBox*>(&button))
        taken = button.style()->pixelMetric(QStyle::PM_IndicatorWidth, nullptr, &button) +
                button.style()->pixelMetric(QStyle::PM_CheckBoxLabelSpacing, nullptr, &button);
    else if (const auto* tool = qobject_cast<const QToolButton*>(&button);
             tool && !tool->icon().isNull() &&
             tool->toolButtonStyle() == Qt::ToolButtonTextBesideIcon)
        taken = tool->iconSize().width() + 2;
    return widthOf(button, button.text()) + taken > button.width() + kSlack;
}

bool comboIsCut(const QComboBox& box) {
    QStyleOptionComboBox option;
    option.initFrom(&box);
    option.editable = box.isEditable();
    option.subControls = QStyle::SC_All;
    const QRect field = box.style()->subControlRect(QStyle::CC_ComboBox, &option,
                                                    QStyle::SC_ComboBoxEditField, &box);
    return isNumber(box.currentText()) && widthOf(box, box.currentText()) > field.width() + kSlack;
}

bool fieldIsCut(const NumberField& field) {
    QStyleOptionFrame option;
    option.initFrom(&field);
    const QRect room = field.style()->subElementRect(QStyle::SE_LineEditContents, &option, &field);
    return widthOf(field, field.text()) > room.width() - 2 + kSlack;
}

QString described(const QWidget& widget, const QString& text) {
    return QStringLiteral("%1 %2 \"%3\" in %4x%5")
        .arg(QLatin1String(widget.metaObject()->className()),
             widget.accessibleName().isEmpty() ? widget.objectName() : widget.accessibleName(),
             text)
        .arg(widget.width())
        .arg(widget.height());
}

// Numbers in columns that are narrower than they are.
void addItems(const QAbstractItemView& view, const QModelIndex& parent, QStringList& cut) {
    const QAbstractItemModel* model = view.model();
    for (int row = 0; row < model->rowCount(parent); ++row) {
        for (int column = 0; column < model->columnCount(parent); ++column) {
            const QModelIndex index = model->index(row, column, parent);
            const QString text = index.data().toString();
            const QRect rect = view.visualRect(index);
            if (rect.isEmpty() || !isNumber(text))
                continue;
            const QVariant font = index.data(Qt::FontRole);
            const QFontMetrics metrics(font.isValid() ? font.value<QFont>() : view.font());
            if (metrics.horizontalAdvance(text) > rect.width() + kSlack)
                cut << described(view, text);
        }
        addItems(view, model->index(row, 0, parent), cut);
    }
}

} // namespace

QStringList cutTexts(const QWidget& root) {
    QStringList cut;
    for (const QWidget* widget : root.findChildren<QWidget*>()) {
        if (!widget->isVisible() || widget->visibleRegion().isEmpty())
            continue;
        if (const auto* label = qobject_cast<const QLabel*>(widget)) {
            if (labelIsCut(*label))
                cut << described(*label, label->text());
        } else if (const auto* field = qobject_cast<const NumberField*>(widget)) {
            if (fieldIsCut(*field))
                cut << described(*field, field->text());
        } else if (const auto* button = qobject_cast<const QAbstractButton*>(widget)) {
            // Thumbnails and tiles paint their names with an ellipsis.
            if (!button->inherits("patina::editor::ViewThumb") && buttonIsCut(*button))
                cut << described(*button, button->text());
        } else if (const auto* box = qobject_cast<const QComboBox*>(widget)) {
            if (comboIsCut(*box))
                cut << described(*box, box->currentText());
        } else if (const auto* bar = qobject_cast<const QTabBar*>(widget)) {
            for (int i = 0; i < bar->count(); ++i)
                if (widthOf(*bar, bar->tabText(i)) > bar->tabRect(i).width() + kSlack)
                    cut << described(*bar, bar->tabText(i));
        } else if (const auto* header = qobject_cast<const QHeaderView*>(widget)) {
            for (int i = 0; header->orientation() == Qt::Horizontal && i < header->count(); ++i) {
                const QString text = header->model()->headerData(i, Qt::Horizontal).toString();
                if (!header->isSectionHidden(i) &&
                    widthOf(*header, text) > header->sectionSize(i) + kSlack)
                    cut << described(*header, text);
            }
        } else if (const auto* view = qobject_cast<const QAbstractItemView*>(widget)) {
            if (view->model())
                addItems(*view, {}, cut);
        }
    }
    cut.removeDuplicates();
    return cut;
}

} // namespace patina::editor
