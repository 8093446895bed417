// Folds a bar to its header: a triangle that points down while the bar is open, and a name.
#pragma once

#include <QString>
#include <QToolButton>

class QScrollArea;
class QWheelEvent;

namespace patina::editor {

class FoldButton : public QToolButton {
    Q_OBJECT
  public:
    // `key`: under which it is remembered over sessions.
    FoldButton(const QString& text, QString key, QWidget* parent = nullptr);

    [[nodiscard]] bool isFolded() const { return m_folded; }
    void setFolded(bool folded); // shows and remembers, emits nothing
    // As it was left, or else.
    [[nodiscard]] bool remembered(bool otherwise) const;

  private:
    QString m_key;
    bool m_folded = false;
};

// The wheel over a bar that has nothing to scroll up and down turns it sideways.
void scrollSideways(QScrollArea& area, const QWheelEvent& event);

} // namespace patina::editor
