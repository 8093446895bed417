// Tabs of docks, which stand for their title bars: a tab that is dragged off its bar or double-
// clicked floats its dock, and its menu floats or closes it.
#pragma once

#include <QObject>
#include <QPoint>
#include <QPointer>

class QDockWidget;
class QMainWindow;
class QMouseEvent;
class QTabBar;

namespace patina::editor {

class DockTabs : public QObject {
    Q_OBJECT
  public:
    explicit DockTabs(QMainWindow& window);

    // The window makes tab bars as it needs them: watches those that are new.
    void watch();

    [[nodiscard]] QDockWidget* dockOf(const QTabBar& bar, int tab) const; // null: of none

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    void openMenu(QDockWidget& dock, const QPoint& global);
    void tearOff(QTabBar& bar, const QMouseEvent& move);

    QMainWindow& m_window;
    QPointer<QDockWidget> m_pressed; // whose tab the mouse button went down on
};

} // namespace patina::editor
