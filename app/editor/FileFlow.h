// What the user goes through to open, save and leave: dialogs, the guard of unsaved changes, the
// list of recent files, and what a dropped file means.
#pragma once

#include <QObject>
#include <QPoint>
#include <QPointer>
#include <QStringList>
#include <functional>

class QMessageBox;
class QWidget;

namespace patina::editor {

class BracketFlow;
struct SaveQuestion;
struct Session;

class FileFlow : public QObject {
    Q_OBJECT
  public:
    FileFlow(Session& session, QWidget& window);

    void newScene();
    void openWithDialog();
    void open(const QString& scene); // a file or "builtin:NAME"
    void addModelWithDialog();
    void makeHdrWithDialog(); // from photos
    void save();
    void saveAs();
    void dropped(const QStringList& files, const QPoint& globalPosition);
    // The files and the environment of the command line; the start scene when there is no scene.
    void openFromCommandLine(const QStringList& files, const QString& environment);

    // Calls `proceed` at once, or after the user has saved or given up the changes; not at all when
    // the user stays.
    void guard(const std::function<void()>& proceed);
    // The same before leaving; jobs that still run are named too.
    void guardQuit(const std::function<void()>& proceed);

    [[nodiscard]] QStringList recentFiles() const;
    void clearRecentFiles();

  Q_SIGNALS:
    void recentFilesChanged();
    void folderAdded();                       // to the library, by a drop
    void openingChanged(const QString& name); // of the scene that is being read; empty: none is

  private:
    // Every scene is opened through this; `done` as of DocumentController::openScene().
    void openScene(const QString& scene, const std::function<void(bool)>& done = {});
    void save(const std::function<void()>& then);
    void saveAs(const std::function<void(bool)>& done);
    void askBeforeOverwriting(const SaveQuestion& question);
    void remember(const QString& file);
    void forget(const QString& file);
    [[nodiscard]] QString startFolder() const;

    Session& m_session;
    QWidget& m_window;
    BracketFlow* m_brackets; // the window's
    QPointer<QMessageBox> m_question;
};

} // namespace patina::editor
