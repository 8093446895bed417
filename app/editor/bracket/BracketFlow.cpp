#include "app/editor/bracket/BracketFlow.h"

#include "app/editor/bracket/BracketDialog.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/FileKinds.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "core/bracket/PhotoExposure.h"

#include <QFileDialog>
#include <vector>

namespace patina::editor {
namespace {

QString photosFolderKey() {
    return QStringLiteral("folders/photos");
}

} // namespace

BracketFlow::BracketFlow(DocumentController& controller, JobManager& jobs, QWidget& window)
    : QObject(&window)
    , m_controller(controller)
    , m_jobs(jobs)
    , m_window(window)
    , m_tasks(controller.runner()) {}

void BracketFlow::openWithDialog() {
    auto* dialog = new QFileDialog(&m_window, tr("Photos of One Scene"),
                                   proposedFolder(m_controller, photosFolderKey()), imageFilter());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFiles);
    connect(dialog, &QFileDialog::filesSelected, this, [this](const QStringList& photos) {
        if (photos.isEmpty())
            return;
        rememberFolder(m_controller, photosFolderKey(), photos.front());
        open(photos);
    });
    dialog->open();
}

void BracketFlow::open(const QStringList& photos) {
    auto* dialog = new BracketDialog(m_controller, m_jobs, photos, &m_window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void BracketFlow::offer(const QStringList& photos, const std::function<void()>& otherwise) {
    std::vector<std::filesystem::path> files;
    for (const QString& photo : photos)
        files.push_back(toPath(photo));
    m_tasks.run(
        {.tag = "offer", .name = "exposures of photos"},
        [files, worker = &m_controller.worker()](const JobContext& job) {
            std::vector<PhotoExposure> exposures;
            for (const std::filesystem::path& file : files) {
                const Result<PhotoExposure> read = readExposure(*worker, file);
                if (!read || job.cancelled())
                    return false;
                exposures.push_back(*read);
            }
            return isBracket(files, exposures);
        },
        [this, photos, otherwise](const Result<bool>& bracket) {
            if (bracket && *bracket)
                open(photos);
            else
                otherwise();
        });
}

} // namespace patina::editor
