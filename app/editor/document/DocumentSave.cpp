// The part of DocumentController that saves.

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/FileOnDisk.h"
#include "app/editor/document/QtText.h"
#include "core/scene/DocumentIO.h"

#include <QFileInfo>
#include <QStandardPaths>
#include <exception>

namespace patina::editor {

// What was asked for, and of which document.
struct SaveOrder {
    QString file; // absolute
    std::function<void(bool)> done;
    SaveConsent consent;
    std::shared_ptr<const Document> document;
    DocumentState state;
    quint64 documentNumber = 0;
    std::shared_ptr<FileOnDisk> onDisk;
    std::string openIn; // the other editor that has it open, when that is in the way
};

namespace {

std::filesystem::path markFolder() {
    return absolutePath(QStandardPaths::writableLocation(QStandardPaths::CacheLocation)) / "open";
}

SaveOutcome write(WorkerClient& worker, SaveOrder& order) {
    FileOnDisk& onDisk = *order.onDisk;
    const std::filesystem::path path = absolutePath(order.file);
    const std::string others = onDisk.mark->others();
    if (order.consent.overwriteOpen)
        onDisk.sharedWith = others;
    if (!others.empty() && others != onDisk.sharedWith) {
        order.openIn = others;
        return {Error{ErrorKind::CannotCreate,
                      "the project is open in another editor, " + others,
                      path,
                      {}},
                SaveObstacle::None,
                {}};
    }
    SaveTerms terms;
    if (!order.consent.overwriteChanged)
        terms.expected = onDisk.version;
    terms.mayReplaceReadOnly = order.consent.overwriteReadOnly;
    SaveOutcome outcome = saveProject(worker, *order.document, path, terms);
    if (!outcome.error)
        onDisk.version = outcome.version;
    return outcome;
}

struct Obstacle {
    SaveQuestion::Reason reason;
    QString text;
    SaveConsent consent; // with which saving again would overwrite
};

// What the user may be asked when a save has failed; nothing when no answer would help.
std::optional<Obstacle> obstacleOf(const SaveOutcome& outcome, const SaveOrder& order) {
    Obstacle question{{}, {}, order.consent};
    const QString name = shownFileName(order.file);
    const auto tr = [](const char* text) { return DocumentController::tr(text); };
    if (!order.openIn.empty()) {
        question.reason = SaveQuestion::Reason::OpenElsewhere;
        question.consent.overwriteOpen = true;
        question.text = tr("%1 is open in another editor (%2).")
                            .arg(name, QString::fromStdString(order.openIn));
        return question;
    }
    switch (outcome.obstacle) {
    case SaveObstacle::None:
        return std::nullopt;
    case SaveObstacle::FolderGone:
        question.reason = SaveQuestion::Reason::FolderGone;
        question.text = tr("The folder of %1 is not there any more; it was moved, renamed or "
                           "removed.")
                            .arg(name);
        break;
    case SaveObstacle::Changed:
        question.reason = SaveQuestion::Reason::Changed;
        question.consent.overwriteChanged = true;
        question.text =
            tr("%1 was changed by somebody else since it was opened or saved here.").arg(name);
        break;
    case SaveObstacle::ReadOnly:
        question.reason = SaveQuestion::Reason::ReadOnly;
        question.consent.overwriteReadOnly = true;
        question.text = tr("%1 is write-protected.").arg(name);
        break;
    }
    return question;
}

} // namespace

void DocumentController::setSaveQuestion(std::function<void(const SaveQuestion&)> ask) {
    m_saveQuestion = std::move(ask);
}

std::shared_ptr<FileOnDisk> DocumentController::fileOnDisk(const QString& file, bool anew) {
    std::weak_ptr<FileOnDisk>& known = m_files[file];
    const std::shared_ptr<FileOnDisk> before = known.lock(); // also of a save that is on its way
    if (before && !anew)
        return before;
    auto result = std::make_shared<FileOnDisk>();
    result->mark = before ? before->mark : OpenProject::hold(markFolder(), absolutePath(file));
    known = result;
    return result;
}

void DocumentController::holdFile(const std::optional<Hash>& version) {
    m_onDisk = fileOnDisk(m_filePath, true);
    m_onDisk->version = version;
    const std::string others = m_onDisk->mark->others();
    if (!others.empty())
        Q_EMIT noticed({NoticeKind::Warning,
                        tr("%1 is open in another editor, too; you are asked before what is saved "
                           "there is overwritten.")
                            .arg(shownName(displayName())),
                        {QString::fromStdString(others)}});
}

QString DocumentController::saveTarget() const {
    return !m_saving.empty() && m_saving.back().first == m_session.documentNumber()
               ? m_saving.back().second
               : m_filePath;
}

void DocumentController::saveAs(const QString& file, std::function<void(bool)> done,
                                const SaveConsent& consent) {
    m_session.separateSteps(); // undo leads back to what is saved
    auto order = std::make_shared<SaveOrder>();
    order->file = QFileInfo(file).absoluteFilePath();
    order->done = std::move(done);
    order->consent = consent;
    order->document = std::make_shared<const Document>(document()); // editing goes on meanwhile
    order->state = state();
    order->documentNumber = m_session.documentNumber();
    order->onDisk = fileOnDisk(order->file, false);
    m_saving.emplace_back(m_session.documentNumber(), order->file);
    m_tasks.enqueue(
        tr("Saving %1").arg(shownFileName(file)),
        [this, order](const JobContext&) { return write(m_worker, *order); },
        [this, order](const Result<SaveOutcome>& written) {
            SaveOutcome outcome;
            if (written)
                outcome = *written;
            else
                outcome.error = Error{ErrorKind::Internal, "saving failed; the file is as it was",
                                      absolutePath(order->file), written.error().detail};
            saveEnded(outcome, *order);
        });
}

void DocumentController::saveEnded(const SaveOutcome& outcome, const SaveOrder& order) {
    m_saving.erase(m_saving.begin()); // they end in the order of the calls
    const bool stillOpen =
        order.documentNumber == m_session.documentNumber(); // else it is another document
    if (outcome.error) {
        const std::optional<Obstacle> obstacle = obstacleOf(outcome, order);
        if (obstacle && m_saveQuestion && stillOpen) {
            const auto overwrite = [this, number = m_session.documentNumber(), file = order.file,
                                    done = order.done, consent = obstacle->consent] {
                if (number == m_session.documentNumber())
                    saveAs(file, done, consent);
                else if (done)
                    done(false);
            };
            m_saveQuestion({obstacle->reason, order.file, obstacle->text, overwrite,
                            order.done ? order.done : [](bool) {}});
            return;
        }
        Q_EMIT noticed(UserNotice::fromError(*outcome.error));
    } else if (order.file == m_filePath && !stillOpen) {
        m_session.forgetSaved(); // what was opened from this file is no longer what it holds
    } else if (stillOpen) {
        m_filePath = order.file;
        m_name = QFileInfo(order.file).fileName();
        m_pristine = false;
        m_onDisk = order.onDisk;
        m_session.setSaved(order.state);
        Q_EMIT fileChanged();
    }
    if (!outcome.error) {
        ++order.onDisk->saves;
        Q_EMIT saved(order.file);
    }
    if (order.done)
        order.done(!outcome.error);
}

} // namespace patina::editor
