// A heading with a triangle, and rows that fold away under it.
#pragma once

#include <QWidget>

class QToolButton;
class QVBoxLayout;

namespace patina::editor {

class Section : public QWidget {
    Q_OBJECT
  public:
    explicit Section(const QString& title, QWidget* parent = nullptr);
    void add(QWidget* row);
    void setOpen(bool open);

  private:
    QToolButton* m_header;
    QWidget* m_body;
    QVBoxLayout* m_rows;
};

} // namespace patina::editor
