#include "app/editor/trace/TracedTexts.h"

#include "app/editor/document/QtText.h"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>

namespace patina::editor {
namespace {

struct TracedTextsTr {
    Q_DECLARE_TR_FUNCTIONS(TracedTexts)
};

QString trTraced(const char* text) {
    return TracedTextsTr::tr(text);
}

// Two digits, and no powers of ten.
QString percentText(double noise) {
    const double percent = 100.0 * noise;
    return trTraced("± %1 %").arg(percent < 10.0 ? QLocale().toString(percent, 'g', 2)
                                                 : QLocale().toString(percent, 'f', 0));
}

QString trPaths(std::uint32_t count) {
    return count == 1 ? trTraced("1 path") : trTraced("%1 paths").arg(count);
}

QString smallText(TracedBy tracer, const TraceProgress& progress) {
    const bool whitted = tracer == TracedBy::Whitted;
    if (progress.samples == 0)
        return whitted ? trTraced("Whitted…") : trTraced("Paths…");
    if (whitted && !progress.noise)
        return trTraced("Whitted");
    QString text =
        whitted ? trTraced("Whitted %1").arg(progress.samples) : trPaths(progress.samples);
    if (progress.noise)
        text += QStringLiteral(" · ") + percentText(*progress.noise);
    return text;
}

QStringList whittedParts(const TraceProgress& progress, TracedRoom room) {
    const QLocale locale;
    QStringList parts{trTraced("Whitted")};
    if (progress.noise) // through the lens
        parts << (room == TracedRoom::Cell ? trTraced("%1 samples")
                                           : trTraced("%1 samples per pixel"))
                     .arg(progress.samples)
              << (room == TracedRoom::Cell
                      ? percentText(*progress.noise)
                      : trTraced("%1 of the mean").arg(percentText(*progress.noise)));
    if (room == TracedRoom::Whole)
        parts << trTraced("%1 million rays").arg(locale.toString(1e-6 * progress.rays, 'f', 1));
    if (room != TracedRoom::Cell)
        parts << trTraced("%1 s").arg(locale.toString(progress.seconds, 'f', 1));
    if (progress.refined)
        parts << trTraced("done");
    else if (!progress.noise)
        parts << trTraced("smoothing edges…");
    return parts;
}

QStringList pathParts(const TraceProgress& progress, TracedRoom room) {
    const QLocale locale;
    QStringList parts{trTraced("Path traced")};
    if (room == TracedRoom::Cell)
        parts << trPaths(progress.samples);
    else
        parts << (progress.samples == 1 ? trTraced("1 path per pixel")
                                        : trTraced("%1 paths per pixel").arg(progress.samples));
    if (progress.noise)
        parts << (room == TracedRoom::Whole
                      ? trTraced("%1 of the mean").arg(percentText(*progress.noise))
                      : percentText(*progress.noise));
    if (room == TracedRoom::Whole)
        parts << trTraced("%1 million rays/s")
                     .arg(locale.toString(1e-6 * progress.raysPerSecond, 'f', 1))
              << trTraced("%1 s").arg(
                     locale.toString(progress.seconds, 'f', progress.seconds < 10 ? 1 : 0));
    if (progress.refined)
        parts << trTraced("done");
    return parts;
}

} // namespace

QString tracedText(TracedBy tracer, const TraceProgress& progress, TracedRoom room) {
    if (progress.error)
        return trTraced("Cannot be traced: %1").arg(toQString(progress.error->message));
    if (room == TracedRoom::Small)
        return smallText(tracer, progress);
    const bool whitted = tracer == TracedBy::Whitted;
    if (progress.samples == 0)
        return whitted ? trTraced("Whitted, coarse at first…")
                       : trTraced("Path traced, coarse at first…");
    const QStringList parts = whitted ? whittedParts(progress, room) : pathParts(progress, room);
    const QString line = parts.join(QStringLiteral("  ·  "));
    return progress.limit && !whitted && room != TracedRoom::Cell
               ? line + trTraced("\nPoint-like lights do not shine through solid glass")
               : line;
}

QString tracedHelp(TracedBy tracer, const TraceProgress& progress) {
    if (tracer == TracedBy::Whitted)
        return trTraced("The classical ray tracer (Whitted 1980): hard shadows,\n"
                        "mirror reflection and refraction, ambient light.");
    const QString help =
        trTraced("Paths per pixel so far, and how certain that makes the picture:\n"
                 "the standard error of its pixels, as a share of its mean brightness.\n"
                 "At ± 1 % it is done.");
    return progress.limit ? help + QStringLiteral("\n\n") + toQString(*progress.limit) : help;
}

} // namespace patina::editor
