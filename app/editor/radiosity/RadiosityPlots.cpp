#include "app/editor/radiosity/RadiosityPlots.h"

#include "app/editor/radiosity/FactorMap.h"
#include "app/editor/radiosity/HemicubeView.h"
#include "app/editor/radiosity/LeakList.h"
#include "app/editor/radiosity/RadiosityTexts.h"
#include "app/editor/radiosity/RadiosityUpdater.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/CurvePlot.h"
#include "app/editor/widget/LabelledField.h"
#include "app/editor/widget/PlotLegend.h"
#include "core/math/Shading.h"

#include <QComboBox>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <functional>

namespace patina::editor {
namespace {

double luminanceOf(const glm::dvec3& light) {
    return static_cast<double>(shading::luminance(glm::vec3(light)));
}

// Flat over each element, as it is solved.
PlotCurve curveOver(const RadiosityUpdater& radiosity, const SurfaceProfile& profile,
                    const QString& name, int look) {
    PlotCurve curve;
    curve.name = name;
    curve.look = look;
    for (const SurfaceProfile::Piece& piece : profile.pieces) {
        const double value =
            luminanceOf(radiosity.live()->lit.radiosity(*radiosity.solution(), piece.element));
        curve.points.emplace_back(piece.from, value);
        curve.points.emplace_back(piece.to, value);
    }
    return curve;
}

} // namespace

namespace {

// Of each row its factors times `scale`; rows of a group as means by area.
std::vector<float> groupedTable(const LiveRadiosity& live, std::size_t group,
                                const std::function<double(std::uint32_t)>& scale) {
    const std::size_t size = live.elements().senderCount(), cells = (size + group - 1) / group;
    std::vector<float> table(cells * cells, 0.0f);
    if (!live.factors)
        return table;
    const std::vector<double> areas = radiosity::senderAreas(live.lit.problem);
    std::vector<double> sums(cells);
    for (std::size_t cell = 0; cell < cells; ++cell) {
        std::ranges::fill(sums, 0.0);
        double area = 0.0;
        const std::size_t end = std::min(size, (cell + 1) * group);
        for (std::size_t i = cell * group; i < end; ++i) {
            const auto row = static_cast<std::uint32_t>(i);
            // Of one that lies within something nothing leaves.
            const double weight = group > 1 ? areas[row] : 1.0;
            area += weight;
            for (const radiosity::FactorRow::Share& share : live.factors->matrix.row(row))
                sums[live.elements().senderOf(share.element) / group] +=
                    weight * scale(row) * double{share.factor};
        }
        for (std::size_t column = 0; area > 0.0 && column < cells; ++column)
            table[cell * cells + column] = static_cast<float>(sums[column] / area);
    }
    return table;
}

} // namespace

std::vector<float> factorTable(const LiveRadiosity& live, std::size_t group) {
    return groupedTable(live, group, [](std::uint32_t) { return 1.0; });
}

std::vector<float> equationTable(const LiveRadiosity& live, std::size_t group) {
    const std::vector<glm::dvec3> reflectances =
        radiosity::senderMeans(live.lit.problem, live.lit.problem.reflectance);
    std::vector<float> table = groupedTable(
        live, group, [&](std::uint32_t row) { return luminanceOf(reflectances[row]); });
    const std::size_t size = live.elements().senderCount(), cells = (size + group - 1) / group;
    for (std::size_t row = 0; row < cells; ++row)
        for (std::size_t column = 0; column < cells; ++column) {
            float& value = table[row * cells + column];
            value = (row == column ? 1.0f : 0.0f) - value;
        }
    return table;
}

RadiosityPlots::RadiosityPlots(RadiosityUpdater& radiosity, DocumentController& controller,
                               QWidget* parent)
    : QWidget(parent)
    , m_radiosity(radiosity) {
    m_choice = describe(new QComboBox, tr("What is plotted"),
                        tr("Plots how the solution comes about, what it is along a surface, or the "
                           "matrices that are solved"));
    m_choice->setObjectName(QStringLiteral("radiosityPlotted"));
    m_choice->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    const std::pair<QString, QString> choices[] = {
        {tr("Convergence"), tr("Share of the emitted light that is still missing, after as many "
                               "shots, by each solver over the same form factors")},
        {tr("Along the surface"), tr("Radiosity along two lines over the chosen element's surface, "
                                     "as far as the steps are")},
        {tr("Form factors F"), tr("Which share of what an element receives from all around comes "
                                  "from which other one")},
        {tr("Equation I − ρF"), tr("The matrix that is solved: what is emitted is the product of "
                                   "it and the radiosity")},
        {tr("Hemicube"), tr("What the chosen element, or the one that shoots next, sees through "
                            "the cells of a hemicube, or of a paraboloid map where form factors "
                            "are found by those")},
        {tr("Leaks and seams"),
         tr("A list of where light comes to where it may not, and of where it jumps between "
            "surfaces that are not joined")}};
    for (const auto& [label, help] : choices) {
        m_choice->addItem(label);
        m_choice->setItemData(m_choice->count() - 1, help, Qt::ToolTipRole);
    }
    m_convergence = new CurvePlot({});
    m_convergence->setObjectName(QStringLiteral("radiosityPlot"));
    m_convergence->setAccessibleName(tr("Convergence"));
    m_convergence->setHelp(tr("Share of the emitted light that is still missing: unshot, or what a "
                              "sweep would still change. A sweep takes as long as a shot of every "
                              "element, and stands there"));
    m_convergence->setEmptyText(tr("Not solved yet."));
    m_convergenceLegend = new PlotLegend;
    m_surface = new CurvePlot({});
    m_surface->setObjectName(QStringLiteral("radiositySurfacePlot"));
    m_surface->setAccessibleName(tr("Radiosity along the surface"));
    m_surface->setHelp(tr("Radiosity along two lines over the surface, which cross in the chosen "
                          "element's middle; it follows the steps"));
    m_surfaceLegend = new PlotLegend;
    const auto page = [](CurvePlot* plot, PlotLegend* legend) {
        auto* both = new QWidget;
        auto* parts = new QVBoxLayout(both);
        parts->setContentsMargins(0, 0, 0, 0);
        parts->setSpacing(0);
        parts->addWidget(plot, 1);
        parts->addWidget(legend);
        return both;
    };
    m_matrix = new FactorMap;
    m_matrix->setObjectName(QStringLiteral("radiosityMatrix"));
    connect(m_matrix, &FactorMap::elementPicked, this, [this](int row) {
        const auto sender = static_cast<std::uint32_t>(row);
        const radiosity::Patches& patches = m_radiosity.live()->elements().patches();
        m_radiosity.choose(patches.empty() ? sender : patches.elementsOf(sender).front());
    });
    m_hemicube = new HemicubeView(radiosity, controller);
    m_leaks = new LeakList(radiosity, controller);
    m_stack = new QStackedWidget;
    for (QWidget* plot : {page(m_convergence, m_convergenceLegend),
                          page(m_surface, m_surfaceLegend), static_cast<QWidget*>(m_matrix),
                          static_cast<QWidget*>(m_hemicube), static_cast<QWidget*>(m_leaks)}) {
        m_stack->addWidget(plot);
    }
    // As high as there is room for, which need not be much.
    m_stack->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Ignored);
    m_stack->setMinimumHeight(120);
    connect(m_choice, &QComboBox::currentIndexChanged, this, &RadiosityPlots::show);
    auto* rows = new QVBoxLayout(this);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(tokens::kGap / 2);
    rows->addWidget(labelledField(tr("Plot"), m_choice), 0, Qt::AlignLeft);
    rows->addWidget(m_stack, 1);
}

void RadiosityPlots::show(int plot) {
    constexpr int kPages[] = {0, 1, 2, 2, 3, 4}; // both matrices are one
    m_stack->setCurrentIndex(kPages[plot]);
    refresh();
}

void RadiosityPlots::refresh() {
    const LiveRadiosityPtr& live = m_radiosity.live();
    const bool paraboloid =
        live && live->settings.factors.method == radiosity::FactorMethod::Paraboloid;
    m_choice->setItemText(kHemicube, paraboloid ? tr("Paraboloid map") : tr("Hemicube"));
    switch (m_choice->currentIndex()) {
    case kConvergence:
        plotConvergence();
        break;
    case kSurface:
        plotSurface();
        break;
    case kHemicube:
        m_hemicube->refresh();
        break;
    case kLeaks:
        m_leaks->refresh();
        break;
    default:
        showMatrix();
    }
}

void RadiosityPlots::plotConvergence() {
    m_radiosity.findConvergence();
    const auto& found = m_radiosity.convergence();
    if (!found) {
        const QString missing = missingFactorsText(m_radiosity);
        m_convergence->setEmptyText(m_radiosity.live() && isByLinks(*m_radiosity.live())
                                        ? tr("Hierarchical radiosity keeps no rows of form "
                                             "factors that others could be solved over.")
                                    : missing.isEmpty() ? tr("Not solved yet.")
                                                        : missing);
        m_convergence->setCurves({});
        m_convergenceLegend->setCurves({});
        return;
    }
    const auto senders = static_cast<double>(m_radiosity.live()->elements().senderCount());
    std::vector<PlotCurve> curves;
    double most = 1.0, least = 100.0;
    for (const ConvergenceCurve& curve : *found) {
        PlotCurve& plotted = curves.emplace_back();
        plotted.look = static_cast<int>(curves.size()) - 1;
        plotted.name = solverName(curve.solver);
        for (const ConvergenceCurve::Point& point : curve.points)
            plotted.points.emplace_back(1.0 + point.rounds * senders, 100.0 * point.residual);
        most = std::max(most, plotted.points.back().x());
        least = std::min(least, plotted.points.back().y());
    }
    m_convergence->setAxes({tr("shots + 1"), {}, 1.0, most, 0.0, true, false},
                           {tr("missing"), QStringLiteral(" %"), std::clamp(least, 1e-3, 10.0),
                            100.0, 0.0, true, false});
    const auto& step = m_radiosity.step();
    if (step)
        m_convergence->setMarker(1.0 + static_cast<double>(step->done) * senders /
                                           static_cast<double>(step->perRound),
                                 tr("here"));
    else
        m_convergence->setMarker({}, {});
    m_convergenceLegend->setCurves(curves);
    m_convergence->setCurves(std::move(curves));
}

void RadiosityPlots::findProfiles() {
    const LiveRadiosity& live = *m_radiosity.live();
    const std::uint32_t element = *m_radiosity.chosen();
    if (m_profiles.shape == live.shape && m_profiles.element == element)
        return;
    m_profiles = {live.shape, element, profileOver(live, element, ProfileWay::Across),
                  profileOver(live, element, ProfileWay::Up)};
}

void RadiosityPlots::plotSurface() {
    const auto chosen = m_radiosity.chosen();
    if (!m_radiosity.live() || !chosen || *chosen >= m_radiosity.live()->elements().size()) {
        m_surface->setEmptyText(tr("Click a surface in the viewport."));
        m_surface->setCurves({});
        m_surfaceLegend->setCurves({});
        return;
    }
    findProfiles();
    const bool level = std::abs(m_profiles.up.way.y) < 0.1f;
    std::vector<PlotCurve> curves{
        curveOver(m_radiosity, m_profiles.across, level ? tr("Along X") : tr("Across"), 0),
        curveOver(m_radiosity, m_profiles.up, level ? tr("Along Z") : tr("Up"), 1)};
    std::erase_if(curves, [](const PlotCurve& curve) { return curve.points.size() < 2; });
    if (curves.empty()) {
        m_surface->setEmptyText(tr("The element is too narrow for a line over it."));
        m_surface->setCurves({});
        m_surfaceLegend->setCurves({});
        return;
    }
    double from = 0.0, to = 0.0, most = 0.0;
    for (const PlotCurve& curve : curves) {
        from = std::min(from, curve.points.front().x());
        to = std::max(to, curve.points.back().x());
        for (const QPointF& point : curve.points)
            most = std::max(most, point.y());
    }
    m_surface->setAxes({tr("from the element's middle"), QStringLiteral(" m"), from, to},
                       {tr("radiosity"), QStringLiteral(" W/m²"), 0.0, most > 0.0 ? most : 1.0});
    m_surfaceLegend->setCurves(curves);
    m_surface->setCurves(std::move(curves));
    m_surface->setMarker(0.0, tr("chosen"));
}

void RadiosityPlots::showMatrix() {
    const LiveRadiosityPtr& live = m_radiosity.live();
    const std::size_t size = live ? live->elements().senderCount() : 0;
    if (!live || !live->factors) {
        const QString missing = missingFactorsText(m_radiosity);
        m_matrixOf.reset();
        m_matrix->setEmptyText(
            live && isByLinks(*live)
                ? tr("Hierarchical radiosity links clusters, and has no matrix of form factors.")
            : !missing.isEmpty() ? missing
                                 : tr("No form factors yet."));
        m_matrix->setValues({}, 0, 1, {});
        return;
    }
    const int plot = m_choice->currentIndex();
    if (m_matrixOf.lock() == live && m_matrixPlot == plot)
        return;
    m_matrixOf = live;
    m_matrixPlot = plot;
    const bool factors = plot == kFactors;
    const std::size_t group = (size + kMostInMatrix - 1) / kMostInMatrix;
    m_matrix->setValues(factors ? factorTable(*live, group) : equationTable(*live, group),
                        static_cast<int>(size), static_cast<int>(group),
                        factors ? tr("F") : tr("I − ρF"));
}

} // namespace patina::editor
