// The docks of the main window: how they are opened and tabbed, where they are at first.
#pragma once

#include <QList>
#include <QObject>

class QAction;
class QDockWidget;
class QMainWindow;
class QWidget;

namespace patina::editor {

class Docks : public QObject {
    Q_OBJECT
  public:
    explicit Docks(QMainWindow& window);

    QDockWidget* add(const QString& name, const QString& title, const QString& iconName,
                     const QString& help, QWidget* panel);
    // A dock to look closer with: below the viewport, hidden at first; `toggle` shows and hides it.
    QDockWidget* addInstrument(QAction* toggle, const QString& name, QWidget* panel);

    [[nodiscard]] QList<QAction*> toggles() const; // of those that are no instruments
    void reset();                                  // all of them are where they are at first

  private:
    void refreshTitles();

    QMainWindow& m_window;
    QList<QDockWidget*> m_docks;
    QList<QDockWidget*> m_instruments; // of m_docks
};

} // namespace patina::editor
