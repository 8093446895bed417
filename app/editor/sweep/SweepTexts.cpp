#include "app/editor/sweep/SweepTexts.h"

#include "app/editor/document/QtText.h"
#include "app/editor/sweep/SweepModel.h"
#include "app/editor/sweep/SweepPicture.h"

#include <QCoreApplication>
#include <QLocale>

namespace patina::editor {
namespace {

struct SweepTr {
    Q_DECLARE_TR_FUNCTIONS(LightSweepPanel)
};

} // namespace

QString countText(const SweepOutcome& outcome) {
    return SweepTr::tr("%1 lights of %2 environments")
        .arg(QLocale().toString(static_cast<qulonglong>(outcome.sweep.scores.size())),
             QLocale().toString(static_cast<qulonglong>(outcome.environments.size())));
}

QString summaryText(const SweepOutcome& outcome) {
    const SweepTransfer& transfer = outcome.transfer;
    const QString bands = QLocale().toString(transfer.bands);
    const QString rays = QLocale().toString(transfer.rays);
    const QString bake =
        transfer.quick ? SweepTr::tr("quick bake, %1 bands, %2 rays per vertex").arg(bands, rays)
        : transfer.rays > 0 ? SweepTr::tr("the scene's bake, %1 bands, %2 rays").arg(bands, rays)
                            : SweepTr::tr("the scene's bake, %1 bands, without rays").arg(bands);
    return SweepTr::tr("%1   ·   %2").arg(countText(outcome), bake);
}

QStringList warningTexts(const SweepOutcome& outcome) {
    QStringList texts;
    const SweepPixels& pixels = outcome.pixels;
    if (pixels.count() < pixels.covered) {
        const double percent = 100.0 - 100.0 * static_cast<double>(pixels.count()) /
                                           static_cast<double>(pixels.covered);
        texts << SweepTr::tr("%1 % of the pixels of surfaces are metal or black, which radiance "
                             "transfer does not light; they are left out.")
                     .arg(QLocale().toString(percent, 'f', percent < 10.0 ? 1 : 0));
    }
    for (const std::string& reason : outcome.transfer.stale)
        texts << SweepTr::tr("The bake is stale: %1; bake it anew.").arg(toQString(reason));
    return texts;
}

QString problemText(const SweepProblem& problem) {
    return SweepTr::tr("%1: %2").arg(fromPath(std::filesystem::path(problem.source).filename()),
                                     toQString(problem.text));
}

QString lightText(const SweepOutcome& outcome, const SweepLight& light) {
    return SweepTr::tr("%1 at %2")
        .arg(toQString(outcome.environments[light.environment].title),
             rotationText(light.rotationDeg));
}

QString referenceText(const SweepOutcome& outcome) {
    return outcome.settings.reference ? SweepTr::tr("Scene's light: %1")
                                            .arg(lightText(outcome, *outcome.settings.reference))
                                      : SweepTr::tr("Mean look");
}

QString sensitivityText(const Image& sensitivity) {
    return SweepTr::tr("0 to %1 stops")
        .arg(QLocale().toString(largestSensitivity(sensitivity), 'f', 2));
}

} // namespace patina::editor
