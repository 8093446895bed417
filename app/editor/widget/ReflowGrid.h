// A layout of equal columns that are as many as the width allows: a contact sheet. The height
// follows from the width.
#pragma once

#include <QLayout>
#include <QList>

namespace patina::editor {

class ReflowGrid : public QLayout {
    Q_OBJECT
  public:
    // `minimumColumn`: width below which a row holds one thing less.
    ReflowGrid(int minimumColumn, int spacing, QWidget* parent = nullptr);
    ~ReflowGrid() override;

    [[nodiscard]] int columns(int width) const; // at least 1

    void addItem(QLayoutItem* item) override;
    [[nodiscard]] int count() const override { return static_cast<int>(m_items.size()); }
    [[nodiscard]] QLayoutItem* itemAt(int index) const override;
    QLayoutItem* takeAt(int index) override;
    [[nodiscard]] Qt::Orientations expandingDirections() const override { return Qt::Horizontal; }
    [[nodiscard]] bool hasHeightForWidth() const override { return true; }
    [[nodiscard]] int heightForWidth(int width) const override;
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSize() const override;
    void setGeometry(const QRect& rect) override;

  private:
    // Places everything when `apply`; returns the height.
    int arrange(const QRect& rect, bool apply) const;

    int m_minimumColumn;
    QList<QLayoutItem*> m_items;
};

} // namespace patina::editor
