// Two looks: their pictures, and the list of values in which they differ, of which any can be
// restored in the scene.
#pragma once

#include "app/editor/panel/LookPictures.h"
#include "core/document/Snapshot.h"
#include "core/edit/LookDifference.h"

#include <QWidget>
#include <optional>
#include <vector>

class QLabel;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace patina::editor {

class DocumentController;

class SnapshotComparison : public QWidget {
    Q_OBJECT
  public:
    explicit SnapshotComparison(DocumentController& controller, QWidget* parent = nullptr);

    struct Side {
        QString name;
        LookPtr look; // null: nothing is compared
        ImagePtr picture;
        QString absence; // why there is no picture
        bool isScene = false;
    };
    void setSides(const Side& a, const Side& b);
    void clear(const QString& hint); // what to do instead

    [[nodiscard]] const std::vector<LookDifference>& differences() const { return m_differences; }
    // A row for each element, and below it one for each of its values.
    [[nodiscard]] QTreeWidget& table() { return *m_table; }
    [[nodiscard]] LookPictures& pictures() { return *m_pictures; }

  private:
    void fillTable();
    void fillRow(QTreeWidgetItem& item, std::size_t index);
    void refreshButtons();
    void restore(const Side& side); // the selected values, or all
    void restoreOne(QTreeWidgetItem& item, int column);
    // Indexes of what is selected, an element standing for all of its values; of nothing: all.
    [[nodiscard]] std::vector<LookDifference> chosen() const;
    [[nodiscard]] QString reason(const Side& side, const LookDifference& difference) const;

    DocumentController& m_controller;
    Side m_a, m_b;
    std::vector<LookDifference> m_differences;
    LookPictures* m_pictures;
    QTreeWidget* m_table;
    QLabel *m_hint, *m_same; // instead of all; instead of the table
    QWidget* m_content;
    QPushButton *m_restoreA, *m_restoreB;
};

} // namespace patina::editor
