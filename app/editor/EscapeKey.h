// Esc leads out of the split, out of a term of the equation and out of full screen, wherever in the
// window or its floating docks the focus is; what the focus itself ends with Esc (an entry, a drag,
// a pick) comes first.
#pragma once

#include <QObject>
#include <functional>
#include <vector>

class QMainWindow;

namespace patina::editor {

class EscapeKey : public QObject {
    Q_OBJECT
  public:
    // A way out: returns whether there was something to leave.
    using Way = std::function<bool()>;

    EscapeKey(QMainWindow& window, std::vector<Way> ways); // the first that leads out is taken

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    [[nodiscard]] bool leave() const;

    QMainWindow& m_window;
    std::vector<Way> m_ways;
};

} // namespace patina::editor
