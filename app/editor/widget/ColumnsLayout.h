// A layout whose items stand side by side while there is room for their least widths, and in
// further rows below when there is not: panels that are wide and short as well as narrow and tall.
#pragma once

#include <QLayout>
#include <vector>

namespace patina::editor {

class ColumnsLayout : public QLayout {
    Q_OBJECT
  public:
    explicit ColumnsLayout(int gap, QWidget* parent = nullptr);
    ~ColumnsLayout() override;

    // The items of a row share what is left by their widgets' horizontal stretch. Rows that hold
    // widgets which expand vertically share the height that is left; none grows beyond its greatest
    // height.
    void addItem(QLayoutItem* item) override;
    [[nodiscard]] int count() const override;
    [[nodiscard]] QLayoutItem* itemAt(int index) const override;
    QLayoutItem* takeAt(int index) override;

    [[nodiscard]] bool hasHeightForWidth() const override { return true; }
    [[nodiscard]] int heightForWidth(int width) const override;
    [[nodiscard]] Qt::Orientations expandingDirections() const override;
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSize() const override;
    void setGeometry(const QRect& rect) override;

  private:
    struct Row {
        std::vector<QLayoutItem*> items;
        std::vector<int> widths;
        int height = 0;
        bool expands = false;
    };
    [[nodiscard]] std::vector<Row> rows(int width) const;

    int m_gap;
    std::vector<QLayoutItem*> m_items;
};

} // namespace patina::editor
