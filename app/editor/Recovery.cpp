#include "app/editor/Recovery.h"

#include "app/editor/Actions.h"
#include "app/editor/FileFlow.h"
#include "app/editor/MainWindow.h"
#include "app/editor/RecoveryDialog.h"
#include "app/editor/Session.h"
#include "app/editor/TerminationWatch.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "core/edit/EditSteps.h"
#include "core/recovery/RecoveryLoader.h"

#include <QAction>
#include <QApplication>
#include <QFile>
#include <QStandardPaths>
#include <chrono>

namespace patina::editor {
namespace {

constexpr std::chrono::seconds kLongestSave{6};

} // namespace

std::filesystem::path recoveryFolder() {
    const QString folder = QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation);
    return std::filesystem::path(QFile::encodeName(folder).toStdString()) / "recovery";
}

Recovery::Recovery(Session& session, MainWindow& window, const std::filesystem::path& root,
                   TerminationWatch& watch)
    : m_session(session)
    , m_window(window)
    , m_root(root)
    , m_keeper(session.controller, window.viewport(), root)
    , m_signals(watch, [this] {
        m_keeper.flush();
        m_session.tasks.finishExclusive(kLongestSave);
    }) {
    connect(&m_signals, &TerminationSignals::received, this, [this](int signal) {
        m_keeper.keepNow();
        m_session.jobs.shutDown(); // bakes keep how far they came
        QCoreApplication::exit(TerminationWatch::kStatus + signal);
    });
    // Logout: whoever does not answer in time is ended, so nothing is asked.
    connect(qApp, &QGuiApplication::commitDataRequest, this, [this] { m_keeper.keepNow(); });
    connect(window.actions().recover, &QAction::triggered, this, &Recovery::offerOnRequest);
}

void Recovery::offer() {
    static_cast<void>(showOffers());
}

void Recovery::offerOnRequest() {
    if (!showOffers())
        Q_EMIT m_session.controller.noticed(
            {NoticeKind::Info, tr("There is no unsaved work to recover."), {}});
}

bool Recovery::showOffers() {
    if (m_dialog) {
        m_dialog->raise();
        return true;
    }
    AbandonedWorks found = abandonedWorks(m_root);
    for (const std::string& sentence : found.removed)
        Q_EMIT m_session.controller.noticed(
            {NoticeKind::Warning, QString::fromStdString(sentence), {}});
    if (found.works.empty())
        return false;
    m_dialog = new RecoveryDialog(std::move(found.works), &m_window);
    m_dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(m_dialog, &RecoveryDialog::recoverRequested, this, [this] {
        auto work = std::make_shared<AbandonedWork>(m_dialog->takeCurrent());
        m_dialog->close(); // what it still holds is offered again later
        m_window.files().guard([this, work] { recover(work); });
    });
    m_dialog->open();
    return true;
}

void Recovery::recover(const Work& work) {
    DocumentController& controller = m_session.controller;
    const RecoveryRecord& record = work->record;
    const auto onStartScene = [this, work] {
        m_session.controller.newDocument([this, work](bool) { load(work); });
    };
    if (record.file.empty()) {
        onStartScene();
        return;
    }
    // Where the saved file is another one by now, saving must not replace it: it asks for a name.
    if (!savedFileUnchanged(record)) {
        Q_EMIT controller.noticed(
            {NoticeKind::Warning,
             tr("%1 was changed or removed since this work was begun. It stays as it is: save the "
                "recovered work under another name.")
                 .arg(QString::fromStdString(record.name)),
             {}});
        onStartScene();
        return;
    }
    controller.openScene(QFile::decodeName(record.file.string().c_str()),
                         [this, work, onStartScene](bool opened) {
                             if (opened)
                                 load(work);
                             else
                                 onStartScene();
                         });
}

void Recovery::load(const Work& work) {
    DocumentController& controller = m_session.controller;
    // The newest wins: whoever opens another scene meanwhile does not want this one any more, and
    // it stays to be offered again.
    controller.tasks().start(
        QStringLiteral("open"), tr("Recovering %1").arg(QString::fromStdString(work->record.name)),
        [self = QPointer<Recovery>(this), &worker = m_session.worker,
         work](const JobContext& job) -> BackgroundTasks::Apply {
            auto result = std::make_shared<Result<OpenedScene>>(
                loadRecovered(worker, work->record, work->session->bakeFolder(), job));
            return [self, work, result] {
                if (!self)
                    return;
                DocumentController& target = self->m_session.controller;
                if (!result->ok()) {
                    if (result->error().kind != ErrorKind::Cancelled)
                        Q_EMIT target.noticed(UserNotice::fromError(result->error()));
                    return;
                }
                OpenedScene& opened = result->value();
                // One step on top of what was saved: undo shows the saved state.
                target.session().push(std::make_unique<ReplaceDocumentStep>(
                    tr("Recover Unsaved Work").toStdString(), target.document(),
                    std::move(opened.document)));
                self->m_keeper.adopt(std::move(work->session));
                const UserNotice notice = UserNotice::fromImport(
                    QString::fromStdString(work->record.name), opened.notices, opened.missingFiles);
                if (!notice.text.isEmpty())
                    Q_EMIT target.noticed(notice);
            };
        });
}

void Recovery::leave() {
    m_keeper.discard();
}

} // namespace patina::editor
