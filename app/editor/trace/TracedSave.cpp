#include "app/editor/trace/TracedSave.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/FileOnDisk.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/document/UserNotice.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/trace/PathView.h"
#include "core/base/AtomicFile.h"
#include "core/document/DisplayedPicture.h"
#include "core/image/Channels.h"
#include "core/io/ImageIO.h"
#include "core/trace/file/OutputImages.h"

#include <QCoreApplication>
#include <QFileDialog>
#include <QFileInfo>
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace patina::editor {
namespace {

const QString kTracedSaveFolder = QStringLiteral("folders/traced");
constexpr double kTracedParts = 0.95; // of the progress, when they are traced
constexpr std::uint32_t kTracedPass = 16;

struct TracedTr {
    Q_DECLARE_TR_FUNCTIONS(TracedSave)
};

// As `patina render --aov all` has them.
Result<std::vector<ImagePart>> partsOf(const TracedSave& save, const JobContext& job) {
    Film film(save.view.width, save.view.height);
    TraceOutputs outputs(save.view.width, save.view.height);
    TraceTiles tiles;
    tiles.outputs = &outputs;
    for (std::uint32_t done = 0; done < save.samples;) {
        const std::uint32_t count = std::min(kTracedPass, save.samples - done);
        job.setActivity("tracing " + std::to_string(done) + " of " + std::to_string(save.samples) +
                        " paths per pixel");
        if (Result<void> traced =
                tracePaths(*save.scene, save.view, {}, film, done, count, job, nullptr, tiles);
            !traced)
            return traced.error();
        done += count;
        job.setProgress(kTracedParts * done / save.samples);
        if (job.stopping())
            return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    }
    std::vector<ImagePart> parts;
    for (const OutputInfo& info : outputInfos()) {
        ImagePart& part = parts.emplace_back();
        part.name = info.id;
        part.image = outputImage(info.kind, film, outputs, save.view.camera, save.view.transparent);
        part.attributes["patina:view"] = info.label;
        if (!info.unit.empty())
            part.attributes["patina:units"] = info.unit;
    }
    return parts;
}

} // namespace

Result<void> writeTraced(const TracedSave& save, WorkerClient& worker, const JobContext& job) {
    const std::filesystem::path file = absolutePath(save.file);
    const Result<ImageFileFormat> format = imageFormatForPath(file);
    if (!format)
        return format.error();
    if (!isLinearFormat(*format)) {
        const Result<Image> shown =
            displayedPicture(*save.picture, save.look, luminanceOf(*save.picture));
        if (!shown)
            return shown.error();
        job.setActivity("writing");
        return saveImage(worker, save.view.transparent ? *shown : withoutAlpha(*shown), file);
    }
    std::vector<ImagePart> parts(1);
    if (save.withParts) {
        Result<std::vector<ImagePart>> traced = partsOf(save, job);
        if (!traced)
            return traced.error();
        parts = *std::move(traced);
    } else {
        parts[0].image = save.view.transparent ? *save.picture : withoutAlpha(*save.picture);
    }
    job.setActivity("writing");
    const Result<Bytes> bytes = encodeImage(worker, std::move(parts), *format);
    return bytes ? writeFileAtomically(file, *bytes) : Result<void>(bytes.error());
}

void askAndSaveTraced(const PathView& paths, DocumentController& controller, JobManager& jobs,
                      QWidget& parent) {
    const std::optional<PathView::Frame> frame = paths.frame();
    if (!frame || !paths.picture())
        return;
    TracedSave save;
    save.picture = paths.picture();
    save.look = controller.document().view;
    save.samples = paths.progress().samples;
    save.scene = frame->scene;
    save.view = frame->view;
    const QString name = QFileInfo(controller.displayName()).completeBaseName();
    auto* dialog = new QFileDialog(&parent, TracedTr::tr("Save Traced Picture"),
                                   proposedFolder(controller, kTracedSaveFolder));
    dialog->setObjectName(QStringLiteral("tracedSaveDialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave); // asks before it overwrites
    dialog->setFileMode(QFileDialog::AnyFile);
    const QString displayed = TracedTr::tr("As displayed (*.png *.jpg *.tif *.tga)"),
                  linear = TracedTr::tr("OpenEXR, linear (*.exr)"),
                  withParts = TracedTr::tr("OpenEXR with its parts, traced once more (*.exr)");
    QStringList filters{displayed, linear};
    if (!paths.isWhitted())
        filters << withParts;
    dialog->setNameFilters(filters);
    dialog->setDefaultSuffix(QStringLiteral("png"));
    dialog->selectFile(TracedTr::tr("%1 traced.png").arg(name));
    QObject::connect(dialog, &QFileDialog::filterSelected, dialog,
                     [dialog, displayed, name](const QString& filter) {
                         const QString suffix =
                             filter == displayed ? QStringLiteral("png") : QStringLiteral("exr");
                         dialog->setDefaultSuffix(suffix);
                         dialog->selectFile(TracedTr::tr("%1 traced.%2").arg(name, suffix));
                     });
    QObject::connect(
        dialog, &QFileDialog::fileSelected, &controller,
        [save = std::move(save), dialog, withParts, &controller,
         &jobs](const QString& file) mutable {
            save.file = file;
            save.withParts = dialog->selectedNameFilter() == withParts;
            rememberFolder(controller, kTracedSaveFolder, file);
            jobs.start(TracedTr::tr("Save traced picture: %1").arg(shownFileName(file)), false,
                       [save = std::move(save), worker = &controller.worker(),
                        target = &controller](const JobContext& job) -> JobOutcome {
                           if (const Result<void> written = writeTraced(save, *worker, job);
                               !written)
                               return {written.error(), {}, {}};
                           return {std::nullopt, save.file, [target, file = save.file] {
                                       UserNotice notice;
                                       notice.text =
                                           TracedTr::tr("Saved the traced picture to %1").arg(file);
                                       Q_EMIT target->noticed(notice);
                                   }};
                       });
        });
    dialog->open();
}

} // namespace patina::editor
