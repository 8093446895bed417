#include "app/editor/job/BakeRates.h"

#include "core/job/JobContext.h"
#include "core/job/Parallel.h"

#include <QSettings>

namespace patina::editor {
namespace {

constexpr double kUsualRate = 1e6;     // rays per second of a core, before one was measured
constexpr double kLeastSeconds = 0.25; // of a bake that tells more than its preparation
constexpr double kLeastShare = 0.5;    // of its rays, or it is another bake's work

} // namespace

// Their rays differ in what follows each of them. Names of their own: what an older Patina kept
// (bake/raysPerSecond) may be the rate of the seconds in which bounces were followed.
QString BakeRates::key(const BakeRequest& request) {
    const char* kind = request.kind == BakeKind::LightMap                     ? "lightMap"
                       : !holdsTransfer(request.kind)                         ? "occlusion"
                       : request.prt.transfer == TransferKind::Interreflected ? "interreflected"
                                                                              : "transfer";
    return QStringLiteral("bake/rates/") + QLatin1String(kind);
}

double BakeRates::seconds(const BakeRequest& request, double rays) {
    const double rate = QSettings().value(key(request)).toDouble();
    return rays / (rate > 0.0 ? rate : kUsualRate * threadCount());
}

void BakeRates::learn(const BakeRequest& request, double rays, const JobProgress& whole) {
    if (whole.secondsSoFar >= kLeastSeconds && rays > 0.0 && whole.workDone >= kLeastShare * rays)
        QSettings().setValue(key(request), rays / whole.secondsSoFar);
}

} // namespace patina::editor
