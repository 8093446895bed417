// What a running editor does so that no work is lost: it keeps unsaved work, listens to who wants
// to end it, and offers what editors that ended left behind.
#pragma once

#include "app/editor/RecoveryKeeper.h"
#include "app/editor/TerminationSignals.h"

#include <QObject>
#include <QPointer>
#include <filesystem>
#include <memory>

namespace patina::editor {

class MainWindow;
class RecoveryDialog;
class TerminationWatch;
struct Session;

// Below the user's data, where no system empties it: ~/.local/share/Patina/Patina/recovery.
[[nodiscard]] std::filesystem::path recoveryFolder();

class Recovery : public QObject {
    Q_OBJECT
  public:
    // `watch`: hears of those who want to end the editor, and lives longer.
    Recovery(Session& session, MainWindow& window, const std::filesystem::path& root,
             TerminationWatch& watch);

    // Shows the work that was left behind; nothing when there is none.
    void offer();
    // The same when the user asks for it, with a notice when there is none.
    void offerOnRequest();
    // The window was closed by the user, who has decided about what is unsaved. Otherwise it is
    // kept when this object goes.
    void leave();

    [[nodiscard]] RecoveryKeeper& keeper() { return m_keeper; }

  private:
    bool showOffers(); // false: there is none
    using Work = std::shared_ptr<AbandonedWork>;
    // Opens what was saved, or the start scene, and then the unsaved work on top of it.
    void recover(const Work& work);
    void load(const Work& work);

    Session& m_session;
    MainWindow& m_window;
    std::filesystem::path m_root;
    RecoveryKeeper m_keeper;
    TerminationSignals m_signals;
    QPointer<RecoveryDialog> m_dialog;
};

} // namespace patina::editor
