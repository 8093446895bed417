#include "app/editor/radiosity/RadiosityTexts.h"

#include "app/editor/panel/JobTexts.h"
#include "app/editor/radiosity/RadiosityUpdater.h"
#include "app/editor/widget/PlotStyle.h"
#include "core/document/Document.h"
#include "core/light/Light.h"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>

namespace patina::editor {
namespace {

QString radiosityWords(const char* text) {
    return QCoreApplication::translate("RadiosityTexts", text);
}

QString counted(std::uint64_t value) {
    return QLocale().toString(static_cast<qulonglong>(value));
}

QString radiosityPercent(double share, int digits = 2) {
    return plotNumber(100.0 * share, digits) + QStringLiteral(" %");
}

QString areaText(double area) {
    return area < 0.1 ? radiosityWords("%1 cm²").arg(plotNumber(1e4 * area))
                      : radiosityWords("%1 m²").arg(plotNumber(area));
}

QString meshNameOf(const Document& document, Id id) {
    const MeshInstance* mesh = document.mesh(id);
    return mesh ? QString::fromStdString(mesh->name) : radiosityWords("A mesh");
}

} // namespace

QString flowPercent(double share) {
    return QLocale().toString(100.0 * share, 'f', 1) + QStringLiteral(" %");
}

QString fluxText(const glm::dvec3& light) {
    return QStringLiteral("%1  %2  %3")
        .arg(plotNumber(light.x), plotNumber(light.y), plotNumber(light.z));
}

QString solverName(radiosity::Solver solver) {
    using radiosity::Solver;
    switch (solver) {
    case Solver::Progressive:
        return radiosityWords("Progressive");
    case Solver::Southwell:
        return radiosityWords("Southwell");
    case Solver::Overshooting:
        return radiosityWords("Overshooting");
    case Solver::Jacobi:
        return radiosityWords("Jacobi");
    case Solver::GaussSeidel:
        return radiosityWords("Gauss-Seidel");
    case Solver::Direct:
        return radiosityWords("Direct");
    case Solver::Hierarchical:
        break;
    }
    return radiosityWords("Hierarchical");
}

bool isByLinks(const LiveRadiosity& live) {
    return live.settings.solve.solver == radiosity::Solver::Hierarchical;
}

QString missingFactorsText(const RadiosityUpdater& radiosity) {
    const LiveRadiosityPtr& live = radiosity.live();
    if (!live || !live->solved || live->hasFactors())
        return {};
    if (!radiosity.factorsFailure().isEmpty())
        return radiosity.factorsFailure();
    const bool links = isByLinks(*live);
    if (radiosity.stopped())
        return links ? radiosityWords("Stopped before links were found. Solve Again finds them.")
                     : radiosityWords("Stopped before form factors were computed. Solve Again "
                                      "computes them.");
    return links ? radiosityWords("Finding links…") : radiosityWords("Computing form factors…");
}

QString radiosityStatus(const RadiosityUpdater& radiosity) {
    if (!radiosity.failure().isEmpty())
        return radiosity.failure();
    const LiveRadiosityPtr& live = radiosity.live();
    if (!radiosity.isWanted() && !live)
        return radiosityWords("The scene is not lit by radiosity.");
    if (!live)
        return radiosity.stopped() ? radiosityWords("Stopped before anything was solved")
                                   : radiosityWords("Dividing surfaces…");
    const QString elements = counted(live->elements().size());
    QStringList parts{live->elements().patches().empty()
                          ? radiosityWords("%1 elements").arg(elements)
                          : radiosityWords("%1 elements in %2 patches")
                                .arg(elements, counted(live->elements().patches().size()))};
    if (!live->solved && !live->factors && !isByLinks(*live))
        parts << radiosityWords("direct light so far");
    else
        parts << radiosityWords("residual %1").arg(radiosityPercent(live->residual));
    if (radiosity.stopped())
        parts << radiosityWords("stopped");
    else if (radiosity.solving())
        parts << radiosityWords("solving…");
    else if (radiosity.findingFactors())
        parts << (isByLinks(*live) ? radiosityWords("finding links…")
                                   : radiosityWords("computing form factors…"));
    else
        parts << radiosityWords("%1 s").arg(plotNumber(radiosity.seconds(), 2));
    // From some seconds on somebody waits.
    if (radiosity.expectedSeconds() > 5.0 && (radiosity.solving() || radiosity.findingFactors()) &&
        !live->factors)
        parts << radiosityWords("form factors take %1")
                     .arg(roughDurationText(radiosity.expectedSeconds()));
    if (live->sources.empty())
        parts << radiosityWords("nothing gives light");
    return parts.join(QStringLiteral(" · "));
}

namespace {

QString factorsText(const LiveRadiosity& live) {
    const QString count = counted(live.factors->matrix.shareCount());
    const int resolution = live.settings.factors.resolution;
    switch (live.settings.factors.method) {
    case radiosity::FactorMethod::Rays:
        return radiosityWords("Form factors: %1, of %2 rays an element").arg(count).arg(resolution);
    case radiosity::FactorMethod::Hemicube:
        return radiosityWords("Form factors: %1, of hemicubes of %2 cells along an edge")
            .arg(count)
            .arg(resolution);
    case radiosity::FactorMethod::Analytic:
        return radiosityWords("Form factors: %1, of polygons with %2 pairs of points")
            .arg(count)
            .arg(resolution);
    case radiosity::FactorMethod::Paraboloid:
        break;
    }
    return radiosityWords("Form factors: %1, of paraboloid maps of %2 texels across")
        .arg(count)
        .arg(resolution);
}

std::uint64_t linkCount(const LiveRadiosity& live) {
    std::uint64_t count = 0;
    for (const RadiositySource& source : live.sources)
        count += source.links ? source.links->links.size() : 0;
    return count;
}

} // namespace

QString radiosityHelp(const LiveRadiosity& live) {
    QStringList lines{
        radiosityWords("Elements: %1").arg(counted(live.elements().size())),
        radiosityWords("Sources that are solved each alone: %1").arg(live.sources.size()),
        (radiosity::shoots(live.settings.solve.solver) ? radiosityWords("Shots: %1")
                                                       : radiosityWords("Sweeps: %1"))
            .arg(counted(static_cast<std::uint64_t>(live.sweeps))),
        radiosityWords("Residual, of the emitted light: %1").arg(radiosityPercent(live.residual))};
    if (const std::size_t found = live.foundSources(); found > 0)
        lines << radiosityWords("Sources whose light was found in the cache, and not solved: %1")
                     .arg(found);
    if (const radiosity::Patches& patches = live.elements().patches(); !patches.empty())
        lines << radiosityWords("Patches, which shoot and have rows of form factors: %1")
                     .arg(counted(patches.size()));
    if (live.factors) {
        const radiosity::FactorQuality& quality = live.factors->quality;
        lines
            << factorsText(live)
            << radiosityWords("Off reciprocity: %1").arg(radiosityPercent(quality.reciprocity))
            << radiosityWords("Light that leaves the scene: %1")
                   .arg(radiosityPercent(quality.escaped))
            << radiosityWords("Light that meets backs: %1").arg(radiosityPercent(quality.absorbed));
    }
    if (const std::uint64_t links = linkCount(live); links > 0)
        lines << radiosityWords("Links between clusters: %1").arg(counted(links));
    if (live.lit.clamped > 0)
        lines << radiosityWords("Elements whose reflectance was too near to 1, and was lowered: %1")
                     .arg(counted(live.lit.clamped));
    return lines.join(QLatin1Char('\n'));
}

QString stepStatus(const Document& document, const RadiosityUpdater& radiosity) {
    if (!radiosity.step()) {
        if (radiosity.live() && isByLinks(*radiosity.live()))
            return radiosityWords("Hierarchical radiosity gathers over links between clusters: it "
                                  "keeps no rows of form factors, and so has no shots to step "
                                  "through. Choose another solver to step.");
        if (!radiosity.canStep())
            return missingFactorsText(radiosity);
        if (radiosity.stepUnit() == RadiosityStep::Sweep)
            return radiosityWords("Solved. Step to begin anew, from the first sweep.");
        return radiosity::shoots(radiosity.live()->settings.solve.solver)
                   ? radiosityWords("Solved. Step to begin anew, from the first shot.")
                   : radiosityWords("Solved. Step to begin anew, from the first shot: steps shoot "
                                    "over the same form factors.");
    }
    const RadiosityUpdater::Step& step = *radiosity.step();
    const double unshot = step.residuals.empty() ? 0.0 : step.residuals.back();
    const bool sweeps = step.unit == RadiosityStep::Sweep;
    const char* done =
        sweeps ? (step.done == 1 ? "After %1 sweep · residual %2" : "After %1 sweeps · residual %2")
               : (step.done == 1 ? "After %1 shot · unshot %2" : "After %1 shots · unshot %2");
    QString text = radiosityWords(done).arg(counted(step.done), radiosityPercent(unshot));
    if (step.energy && step.energy->emitted > 0.0)
        text += QStringLiteral(" · ") +
                radiosityWords("absorbed %1, escaped %2")
                    .arg(radiosityPercent(step.energy->absorbed / step.energy->emitted),
                         radiosityPercent(step.energy->lost / step.energy->emitted));
    if (step.atEnd)
        return text + QStringLiteral(" · ") +
               (sweeps ? radiosityWords("solved") : radiosityWords("all is shot"));
    if (step.next)
        text += QStringLiteral(" · ") +
                radiosityWords("next: %1").arg(senderName(document, *radiosity.live(), *step.next));
    return text;
}

QString flowName(const Document& document, const FlowShare& share) {
    switch (share.kind) {
    case FlowShare::Kind::Glow:
        return radiosityWords("Glowing surfaces");
    case FlowShare::Kind::Sky:
        return radiosityWords("Sky");
    case FlowShare::Kind::Light:
        if (const Light* light = document.light(share.id))
            return QString::fromStdString(light->name);
        return radiosityWords("A light");
    case FlowShare::Kind::Lights:
        return radiosityWords("Other lights");
    case FlowShare::Kind::Mesh:
        return meshNameOf(document, share.id);
    case FlowShare::Kind::Element:
        return radiosityWords("%1, element %2")
            .arg(meshNameOf(document, share.id), counted(share.element));
    case FlowShare::Kind::Escaped:
        return radiosityWords("Leaves the scene");
    case FlowShare::Kind::Absorbed:
        break;
    }
    return radiosityWords("Meets backs, which absorb");
}

QString sourceTitle(const Document& document, const RadiositySource& source) {
    FlowShare share;
    share.id = source.id;
    share.kind = source.kind == RadiositySource::Kind::Glow    ? FlowShare::Kind::Glow
                 : source.kind == RadiositySource::Kind::Sky   ? FlowShare::Kind::Sky
                 : source.kind == RadiositySource::Kind::Light ? FlowShare::Kind::Light
                                                               : FlowShare::Kind::Lights;
    return flowName(document, share);
}

QString elementName(const Document& document, const LiveRadiosity& live, std::uint32_t element) {
    return QStringLiteral("%1 · %2 · %3")
        .arg(meshNameOf(document, live.scene->meshId(live.elements().face(element).mesh)),
             radiosityWords("element %1").arg(counted(element)),
             areaText(live.elements().area(element)));
}

QString senderName(const Document& document, const LiveRadiosity& live, std::uint32_t sender) {
    const radiosity::Patches& patches = live.elements().patches();
    if (patches.empty())
        return elementName(document, live, sender);
    const auto elements = patches.elementsOf(sender);
    double area = 0.0;
    for (const std::uint32_t element : elements)
        area += live.elements().area(element);
    return radiosityWords("%1 · patch %2 of %3 elements · %4")
        .arg(meshNameOf(document, live.scene->meshId(live.elements().face(elements[0]).mesh)),
             counted(sender), counted(elements.size()), areaText(area));
}

} // namespace patina::editor
