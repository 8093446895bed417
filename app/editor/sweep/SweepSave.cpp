#include "app/editor/sweep/SweepSave.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/FileOnDisk.h"
#include "app/editor/document/ProposedFolder.h"
#include "app/editor/document/QtText.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/sweep/SweepModel.h"
#include "app/editor/sweep/SweepPicture.h"
#include "core/base/AtomicFile.h"
#include "core/rank/RankingJson.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFontMetrics>
#include <QPainter>
#include <algorithm>
#include <span>
#include <string_view>
#include <utility>

namespace patina::editor {
namespace {

const QString kSweepSaveFolder = QStringLiteral("folders/sweeps");
constexpr int kSheetWidth = 1600; // of the rotations, about
constexpr int kSheetText = 13;    // pixels

struct SaveTr {
    Q_DECLARE_TR_FUNCTIONS(LightSweepPanel)
};

Result<void> writeSheetPicture(const QImage& sheet, const std::filesystem::path& file) {
    QByteArray bytes;
    QBuffer buffer(&bytes);
    if (!buffer.open(QIODevice::WriteOnly) || !sheet.save(&buffer, "PNG"))
        return Error{ErrorKind::Internal, "the picture cannot be encoded", file, {}};
    return writeFileAtomically(
        file, std::as_bytes(std::span(bytes.constData(), static_cast<std::size_t>(bytes.size()))));
}

Result<void> writeSweep(const SweepSave& save, const std::string& scene, const JobContext& job) {
    const std::filesystem::path file = absolutePath(save.file);
    if (QFileInfo(save.file).suffix().compare(QLatin1String("png"), Qt::CaseInsensitive) != 0) {
        const std::string text = rankingFile(*save.outcome, save.by, scene);
        return writeFileAtomically(file, std::string_view(text));
    }
    const QImage sheet = rotationSheet(*save.outcome, save.environment, save.by, job);
    if (sheet.isNull())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    return writeSheetPicture(sheet, file);
}

} // namespace

std::string rankingFile(const SweepOutcome& outcome, RankBy by, const std::string& scene) {
    Ranking ranking;
    ranking.scene = scene;
    ranking.by = by;
    ranking.camera = outcome.order->document.view.camera;
    ranking.settings = &outcome.settings;
    ranking.pixels = &outcome.pixels;
    ranking.sweep = &outcome.sweep;
    ranking.environments = outcome.measured;
    for (const SweptEnvironment& environment : outcome.environments)
        ranking.files.push_back(environment.source);
    ranking.same = outcome.same;
    for (const SweepProblem& problem : outcome.problems)
        ranking.unread.push_back({problem.source, problem.text});
    ranking.transfer = outcome.transfer.quick ? "quick" : "project";
    ranking.rays = outcome.transfer.rays;
    return rankingText(ranking);
}

QImage rotationSheet(const SweepOutcome& outcome, std::size_t environment, RankBy by,
                     const JobContext& job) {
    const QRect seen = surfacesRect(outcome.pixels);
    QFont font;
    font.setPixelSize(kSheetText);
    const QFontMetrics metrics(font);
    const int line = metrics.height();
    const int count = static_cast<int>(outcome.rotations());
    const int width = std::max(seen.width(), metrics.horizontalAdvance(QStringLiteral("333.3°  "
                                                                                      "0.000")));
    const QSize cell(width + tokens::kGap, seen.height() + line + tokens::kGap);
    const int columns = std::clamp(kSheetWidth / cell.width(), 1, count);
    const int rows = (count + columns - 1) / columns;
    const QPoint origin(tokens::kMargin, tokens::kMargin + line + tokens::kGap);
    QImage sheet(origin.x() + columns * cell.width() - tokens::kGap + tokens::kMargin,
                 origin.y() + rows * cell.height() - tokens::kGap + tokens::kMargin,
                 QImage::Format_RGB32);
    sheet.fill(QColor(tokens::kWindow));
    QPainter painter(&sheet);
    painter.setFont(font);
    painter.setPen(QColor(tokens::kText));
    const int room = sheet.width() - 2 * tokens::kMargin;
    painter.drawText(QRect(tokens::kMargin, tokens::kMargin, room, line),
                     Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(toQString(outcome.environments[environment].title),
                                        Qt::ElideMiddle, room));
    painter.setPen(QColor(tokens::kTextDim));
    for (int i = 0; i < count; ++i) {
        if (job.cancelled())
            return {};
        job.setProgress(static_cast<double>(i) / count);
        const LightScore& score =
            outcome.sweep.scores[environment * outcome.rotations() + static_cast<std::size_t>(i)];
        const QPoint at = origin + QPoint(i % columns * cell.width(), i / columns * cell.height());
        painter.drawImage(at, displayedImage(sweepPicture(outcome.pixels, outcome.measured,
                                                          outcome.settings, score.light),
                                             outcome.settings.view)
                                  .copy(seen));
        painter.drawText(QRect(at + QPoint(0, seen.height()), QSize(width, line)),
                         Qt::AlignLeft | Qt::AlignVCenter,
                         QStringLiteral("%1  %2").arg(rotationText(score.light.rotationDeg),
                                                      scoreText(rankingScore(score, by), by)));
    }
    return sheet;
}

void saveSweep(const SweepSave& save, DocumentController& controller, JobManager& jobs) {
    const QString suffix = QFileInfo(save.file).suffix().toLower();
    if (suffix != QLatin1String("json") && suffix != QLatin1String("png")) {
        UserNotice notice;
        notice.kind = NoticeKind::Error;
        notice.text = SaveTr::tr("A sweep is saved as .json (the ranking) or .png (the rotations "
                                 "of an environment); choose one of these endings");
        Q_EMIT controller.noticed(notice);
        return;
    }
    rememberFolder(controller, kSweepSaveFolder, save.file);
    jobs.start(SaveTr::tr("Save light sweep: %1").arg(shownFileName(save.file)), false,
               [save, scene = toPath(controller.filePath()).string(),
                target = &controller](const JobContext& job) -> JobOutcome {
                   job.setActivity("writing");
                   if (const Result<void> written = writeSweep(save, scene, job); !written)
                       return {written.error(), {}, {}};
                   return {std::nullopt, save.file, [target, file = save.file] {
                               UserNotice notice;
                               notice.text = SaveTr::tr("Saved the light sweep to %1").arg(file);
                               Q_EMIT target->noticed(notice);
                           }};
               });
}

void askAndSaveSweep(SweepSave save, DocumentController& controller, JobManager& jobs,
                     QWidget& parent) {
    const QString environment = toQString(save.outcome->environments[save.environment].title);
    const QString name = QFileInfo(controller.displayName()).completeBaseName();
    auto* dialog = new QFileDialog(&parent, SaveTr::tr("Save Light Sweep"),
                                   proposedFolder(controller, kSweepSaveFolder));
    dialog->setObjectName(QStringLiteral("sweepSaveDialog"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(QFileDialog::AcceptSave); // asks before it overwrites
    dialog->setFileMode(QFileDialog::AnyFile);
    const QString ranking = SaveTr::tr("Ranking as JSON (*.json)"),
                  picture = SaveTr::tr("Rotations of the chosen environment as a picture (*.png)");
    dialog->setNameFilters({ranking, picture});
    dialog->setDefaultSuffix(QStringLiteral("json"));
    dialog->selectFile(SaveTr::tr("%1 light sweep.json").arg(name));
    QObject::connect(
        dialog, &QFileDialog::filterSelected, dialog,
        [dialog, picture, name, environment](const QString& filter) {
            const bool isPicture = filter == picture;
            dialog->setDefaultSuffix(isPicture ? QStringLiteral("png") : QStringLiteral("json"));
            dialog->selectFile(isPicture ? SaveTr::tr("%1 in %2.png").arg(name, environment)
                                         : SaveTr::tr("%1 light sweep.json").arg(name));
        });
    QObject::connect(dialog, &QFileDialog::fileSelected, &controller,
                     [save = std::move(save), &controller, &jobs](const QString& file) mutable {
                         save.file = file;
                         saveSweep(save, controller, jobs);
                     });
    dialog->open();
}

} // namespace patina::editor
