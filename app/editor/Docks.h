// The docks of the main window: how they are opened, tabbed, floated and reached by keys, where
// they are at first and where the last session left them.
#pragma once

#include <QList>
#include <QObject>
#include <QSet>
#include <QStringList>
#include <vector>

class QAction;
class QDockWidget;
class QMainWindow;
class QWidget;

namespace patina::editor {

class DockTabs;

class Docks : public QObject {
    Q_OBJECT
  public:
    explicit Docks(QMainWindow& window);

    // `toggle` is checked while the dock is seen, which one behind a tab is not; it shows and
    // raises the dock, or closes it.
    QDockWidget* add(QAction* toggle, const QString& name, QWidget* panel);
    // A dock to look closer with: below the viewport, hidden at first.
    QDockWidget* addInstrument(QAction* toggle, const QString& name, QWidget* panel);

    void reset(); // all of them are where they are at first
    // QMainWindow::saveState(): false when it is of another version or damaged. Before the window
    // is shown, floating docks wait for it.
    bool restore(const QByteArray& state, int version);
    // Closes those that are not open at first; their titles.
    QStringList closeOpened();

    // The keys go to the next dock that is open, or to the picture between them; docks behind tabs
    // come to the front.
    void focusNext();
    void focusPrevious();

  protected:
    bool eventFilter(QObject* window, QEvent* event) override;

  private:
    [[nodiscard]] bool isOpenAtFirst(QDockWidget* dock) const;
    void open(QDockWidget* dock);
    void floatingChanged(QDockWidget* dock, bool floating);
    void placeFloating(QDockWidget* dock);
    void showWaiting();
    void refreshTitles();
    [[nodiscard]] std::vector<QWidget*> stations() const;
    void focusBy(int step);

    QMainWindow& m_window;
    DockTabs* m_tabs;
    QList<QDockWidget*> m_docks;
    QList<QDockWidget*> m_instruments;  // of m_docks
    QList<QDockWidget*> m_waiting;      // floating, to be shown after the window
    QSet<QDockWidget*> m_floatedBefore; // they float where they were left
    bool m_restoring = false;
};

} // namespace patina::editor
