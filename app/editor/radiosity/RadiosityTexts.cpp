#include "app/editor/radiosity/RadiosityTexts.h"

#include "app/editor/radiosity/RadiosityUpdater.h"
#include "app/editor/widget/PlotStyle.h"
#include "core/document/Document.h"
#include "core/light/Light.h"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>

namespace patina::editor {
namespace {

QString words(const char* text) {
    return QCoreApplication::translate("RadiosityTexts", text);
}

QString count(std::uint64_t value) {
    return QLocale().toString(static_cast<qulonglong>(value));
}

QString percent(double share, int digits = 2) {
    return plotNumber(100.0 * share, digits) + QStringLiteral(" %");
}

QString meshName(const Document& document, Id id) {
    const MeshInstance* mesh = document.mesh(id);
    return mesh ? QString::fromStdString(mesh->name) : words("A mesh");
}

} // namespace

QString flowPercent(double share) {
    return QLocale().toString(100.0 * share, 'f', 1) + QStringLiteral(" %");
}

QString fluxText(const glm::dvec3& light) {
    return QStringLiteral("%1  %2  %3")
        .arg(plotNumber(light.x), plotNumber(light.y), plotNumber(light.z));
}

QString radiosityStatus(const RadiosityUpdater& radiosity) {
    if (!radiosity.failure().isEmpty())
        return radiosity.failure();
    const LiveRadiosityPtr& live = radiosity.live();
    if (!radiosity.isWanted() && !live)
        return words("The scene is not lit by radiosity.");
    if (!live)
        return radiosity.stopped() ? words("Stopped before anything was solved")
                                   : words("Dividing surfaces…");
    QStringList parts{words("%1 elements").arg(count(live->elements().size()))};
    if (!live->factors)
        parts << words("direct light so far");
    else
        parts << words("residual %1").arg(percent(live->residual));
    if (radiosity.stopped())
        parts << words("stopped");
    else if (radiosity.solving())
        parts << words("solving…");
    else
        parts << words("%1 s").arg(plotNumber(radiosity.seconds(), 2));
    if (live->sources.empty())
        parts << words("nothing gives light");
    return parts.join(QStringLiteral(" · "));
}

QString radiosityHelp(const LiveRadiosity& live) {
    QStringList lines{words("Elements: %1").arg(count(live.elements().size())),
                      words("Sources that are solved each alone: %1").arg(live.sources.size()),
                      words("Sweeps: %1").arg(live.sweeps),
                      words("Residual, of the emitted light: %1").arg(percent(live.residual))};
    if (live.factors) {
        const radiosity::FactorQuality& quality = live.factors->quality;
        lines << words("Form factors: %1, of %2 rays an element")
                     .arg(count(live.factors->matrix.shareCount()))
                     .arg(live.settings.factors.resolution)
              << words("Off reciprocity: %1").arg(percent(quality.reciprocity))
              << words("Light that leaves the scene: %1").arg(percent(quality.escaped))
              << words("Light that meets backs: %1").arg(percent(quality.absorbed));
    }
    if (live.lit.clamped > 0)
        lines << words("Elements whose reflectance was too near to 1, and was lowered: %1")
                     .arg(count(live.lit.clamped));
    return lines.join(QLatin1Char('\n'));
}

QString stepStatus(const Document& document, const RadiosityUpdater& radiosity) {
    if (!radiosity.step())
        return radiosity.canStep() ? words("Solved. Step to begin anew, from the first shot.")
                                   : QString();
    const RadiosityUpdater::Step& step = *radiosity.step();
    const double unshot = step.residuals.empty() ? 0.0 : step.residuals.back();
    QString text = words("After %1 shots · unshot %2").arg(count(step.shots), percent(unshot));
    if (step.atEnd)
        return text + QStringLiteral(" · ") + words("all is shot");
    if (step.next)
        text += QStringLiteral(" · ") +
                words("next: %1").arg(elementName(document, *radiosity.live(), *step.next));
    return text;
}

QString flowName(const Document& document, const FlowShare& share) {
    switch (share.kind) {
    case FlowShare::Kind::Glow:
        return words("Glowing surfaces");
    case FlowShare::Kind::Sky:
        return words("Sky");
    case FlowShare::Kind::Light:
        if (const Light* light = document.light(share.id))
            return QString::fromStdString(light->name);
        return words("A light");
    case FlowShare::Kind::Lights:
        return words("Other lights");
    case FlowShare::Kind::Mesh:
        return meshName(document, share.id);
    case FlowShare::Kind::Escaped:
        return words("Leaves the scene");
    case FlowShare::Kind::Absorbed:
        break;
    }
    return words("Meets backs, which absorb");
}

QString elementName(const Document& document, const LiveRadiosity& live, std::uint32_t element) {
    const double area = live.elements().area(element);
    const QString size = area < 0.1 ? words("%1 cm²").arg(plotNumber(1e4 * area))
                                    : words("%1 m²").arg(plotNumber(area));
    return QStringLiteral("%1 · %2 · %3")
        .arg(meshName(document, live.scene->meshId(live.elements().face(element).mesh)),
             words("element %1").arg(count(element)), size);
}

} // namespace patina::editor
