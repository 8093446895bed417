#include "app/editor/panel/BrdfLensPanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/panel/LensControls.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/LobeOnSurface.h"
#include "app/editor/viewport/PixelProbe.h"
#include "app/editor/widget/CurvePlot.h"
#include "app/editor/widget/LitSphere.h"
#include "app/editor/widget/LobeView.h"
#include "app/editor/widget/PolarPlot.h"
#include "app/editor/widget/TileArea.h"
#include "core/image/TexelRange.h"
#include "core/light/EnergyStudy.h"
#include "core/light/Light.h"
#include "core/material/MaterialInputs.h"
#include "render/view/Recombine.h"

#include <QComboBox>
#include <QLabel>
#include <QSignalBlocker>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/trigonometric.hpp>

namespace patina::editor {
namespace {

constexpr QSize kSmallestTile(148, 132);

std::vector<QPointF> toPoints(const LensCurves::Curve& curve) {
    std::vector<QPointF> points;
    points.reserve(curve.size());
    for (const glm::vec2& point : curve)
        points.emplace_back(static_cast<double>(point.x), static_cast<double>(point.y));
    return points;
}

PlotAxis angleAxis(const QString& name, double min = 0.0) {
    return {name, QStringLiteral("°"), min, 90.0, 30.0};
}

bool hasMaps(const Material& material) {
    return std::any_of(kMaterialInputs.begin(), kMaterialInputs.end(), [&](const auto& info) {
        return (info.role == InputRole::Number || info.input == MaterialInput::BaseColor) &&
               (material.*info.map).assigned();
    });
}

} // namespace

struct BrdfLensPanel::Known {
    struct Map {
        ImagePtr image;
        TexelRange range;
    };
    DfgTables tables;
    std::vector<Map> maps;

    const TexelRange& rangeOf(const ImagePtr& image) {
        const auto known = std::find_if(maps.begin(), maps.end(),
                                        [&](const Map& map) { return map.image == image; });
        if (known != maps.end())
            return known->range;
        constexpr std::size_t kKept = 4; // a material has no more that count here
        if (maps.size() == kKept)
            maps.erase(maps.begin());
        maps.push_back({image, texelRange(*image, JobContext())});
        return maps.back().range;
    }
};

BrdfLensPanel::BrdfLensPanel(DocumentController& controller, SelectionModel& selection,
                             PixelProbe& probe, LobeOnSurface& onSurface, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_selection(selection)
    , m_probe(probe)
    , m_onSurface(onSurface)
    , m_known(std::make_shared<Known>())
    , m_controls(new LensControls)
    , m_comparison(new LensComparison(
          [this] {
              return m_result.request.looks.empty() ? std::nullopt
                                                    : std::optional(m_result.request.looks.front());
          },
          this))
    , m_note(new QLabel)
    , m_stack(new QStackedWidget)
    , m_tiles(new TileArea(kSmallestTile))
    , m_job(controller.runner(), "BRDF lens")
    , m_ballLight(controller.runner(), "light of the ball") {
    m_note->setObjectName(QStringLiteral("dim"));
    m_note->setAccessibleName(tr("Looked at"));
    m_controls->add(m_comparison->button());
    m_controls->add(makeOnSurface());
    m_controls->add(m_comparison->legend());
    m_controls->add(m_note);
    makePlots();
    auto* body = new QWidget;
    auto* rows = new QVBoxLayout(body);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(6);
    rows->addWidget(m_controls);
    rows->addWidget(m_tiles, 1);
    auto* nothing = new QLabel(tr("No material is selected. Select one in the Scene panel to see "
                                  "how it reflects."));
    nothing->setObjectName(QStringLiteral("dim"));
    nothing->setAlignment(Qt::AlignCenter);
    nothing->setWordWrap(true);
    m_stack->addWidget(body);
    m_stack->addWidget(nothing);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(tokens::kGap, 6, tokens::kGap, tokens::kGap);
    layout->addWidget(m_stack);
    showPage();

    connect(m_controls, &LensControls::pageChanged, this, &BrdfLensPanel::showPage);
    connect(m_controls, &LensControls::changed, this, [this] {
        m_polar->setIncidence(m_controls->incidence());
        m_onSurface.setScale(m_controls->scale());
        refresh();
    });
    connect(m_comparison, &LensComparison::changed, this, &BrdfLensPanel::refresh);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        const std::optional<Target>& target = change.target;
        if (!target || target->scope == Scope::Model || target->scope == Scope::Material)
            refresh();
        if (!target || target->scope == Scope::Light)
            fillOnSurface();
        if (!target || target->scope == Scope::Environment || target->scope == Scope::Softbox ||
            target->scope == Scope::View)
            refreshEnvironment();
    });
    connect(&selection, &SelectionModel::selectionChanged, this, &BrdfLensPanel::refresh);
    connect(&probe, &PixelProbe::pinChanged, this, &BrdfLensPanel::refresh);
    connect(&onSurface, &LobeOnSurface::changed, this, &BrdfLensPanel::describe);
    fillOnSurface();
}

BrdfLensPanel::~BrdfLensPanel() {
    m_onSurface.show(std::nullopt);
}

void BrdfLensPanel::makePlots() {
    m_polar = new PolarPlot(tr("Polar"));
    m_cartesian = new CurvePlot(tr("By angle"));
    m_space = new LobeView(m_controller.runner(), tr("In space"));
    m_ball = new LitSphere(m_controller.runner(), tr("On a ball"));
    m_distribution = new CurvePlot(tr("D  facing h"));
    m_masking = new CurvePlot(tr("G  not hidden"));
    m_fresnel = new CurvePlot(tr("F  Fresnel"));
    m_albedo = new CurvePlot(tr("Albedo"));
    for (QWidget* plot : std::initializer_list<QWidget*>{
             m_polar, m_cartesian, m_space, m_ball, m_distribution, m_masking, m_fresnel, m_albedo})
        m_tiles->add(plot);
    m_cartesian->setHelp(tr("How much of the light at θᵢ is reflected to viewers at θₒ, in the "
                            "plane of incidence; positive angles lie opposite the light"));
    m_distribution->setHelp(tr(
        "D: how many facets of the surface face the half vector, which leans θₕ from the normal"));
    m_masking->setHelp(tr("G: the share of facets that neither light nor viewer finds hidden, the "
                          "viewer at θₒ opposite the light"));
    m_fresnel->setHelp(tr("F: the reflectance of a facet that light meets at ∠(v,h)"));
    m_albedo->setHelp(tr("The share of light from all sides that comes back to a viewer at θₒ: "
                         "scattered once, with energy compensation, and as the exact integral"));
    connect(m_polar, &PolarPlot::incidenceDragged, m_controls, &LensControls::setIncidence);
    // What is read in one plot, as the viewer's angle, is shown in all; where the pointer is, the
    // place stays what it is.
    const auto follow = [this](CurvePlot* plot, const std::function<double(double)>& viewer) {
        connect(plot, &CurvePlot::probed, this,
                [this, plot, viewer](const std::optional<QPointF>& place) {
                    probe(place ? std::optional(viewer(place->x())) : std::nullopt);
                    plot->setProbe(place);
                });
    };
    for (CurvePlot* plot : {static_cast<CurvePlot*>(m_polar), m_cartesian, m_masking, m_albedo})
        follow(plot, [](double angle) { return angle; });
    // h stands in the middle between the light at -θi and the viewer.
    follow(m_distribution, [this](double half) { return m_controls->incidence() + 2.0 * half; });
    follow(m_fresnel,
           [this](double difference) { return 2.0 * difference - m_controls->incidence(); });
}

void BrdfLensPanel::showPage() {
    switch (m_controls->page()) {
    case LensControls::Page::Lobe:
        m_tiles->setShown({m_polar, m_cartesian, m_space, m_ball});
        break;
    case LensControls::Page::Factors:
        m_tiles->setShown({m_distribution, m_masking, m_fresnel});
        break;
    case LensControls::Page::Albedo:
        m_tiles->setShown({m_albedo});
        break;
    case LensControls::Page::All:
        m_tiles->setShown({m_polar, m_cartesian, m_space, m_ball, m_distribution, m_masking,
                           m_fresnel, m_albedo});
        break;
    }
}

// --- The lobe in the viewport --------------------------------------------------------------------

QComboBox* BrdfLensPanel::makeOnSurface() {
    m_surfaceChoice = new QComboBox;
    m_surfaceChoice->setObjectName(QStringLiteral("small"));
    m_surfaceChoice->setAccessibleName(tr("Lobe on the surface"));
    m_surfaceChoice->setToolTip(
        tr("Draw the lobe in the viewport, on the surface under the pointer or at the pinned "
           "pixel: what becomes of a light, or which light the viewer sees there"));
    m_surfaceChoice->setStatusTip(m_surfaceChoice->toolTip());
    m_surfaceChoice->setFocusPolicy(Qt::StrongFocus);
    m_surfaceChoice->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_surfaceChoice->setMinimumContentsLength(14);
    connect(m_surfaceChoice, &QComboBox::currentIndexChanged, this, &BrdfLensPanel::showOnSurface);
    return m_surfaceChoice;
}

// Data: nothing, 0 for the viewer, or the light's id.
void BrdfLensPanel::fillOnSurface() {
    const QVariant chosen = m_surfaceChoice->currentData();
    {
        const QSignalBlocker blocker(m_surfaceChoice);
        m_surfaceChoice->clear();
        m_surfaceChoice->addItem(tr("Not on the surface"));
        m_surfaceChoice->addItem(tr("Surface: the viewer"), 0u);
        for (const Light& light : m_controller.document().lights)
            m_surfaceChoice->addItem(tr("Surface: %1").arg(QString::fromStdString(light.name)),
                                     light.id);
        m_surfaceChoice->setCurrentIndex(
            chosen.isValid() ? std::max(m_surfaceChoice->findData(chosen), 0) : 0);
    }
    showOnSurface();
}

void BrdfLensPanel::showOnSurface() {
    const QVariant chosen = m_surfaceChoice->currentData();
    m_onSurface.setScale(m_controls->scale());
    m_onSurface.show(isVisible() && chosen.isValid() ? std::optional<Id>(chosen.toUInt())
                                                     : std::nullopt);
    describe();
}

// --- What is shown -------------------------------------------------------------------------------

void BrdfLensPanel::showEvent(QShowEvent*) {
    if (m_stale)
        refresh();
    refreshEnvironment();
    showOnSurface();
}

void BrdfLensPanel::hideEvent(QHideEvent*) {
    m_onSurface.show(std::nullopt);
}

void BrdfLensPanel::refresh() {
    m_stale = true;
    if (!isVisible())
        return;
    const Document& document = m_controller.document();
    const Material* material = document.material(m_selection.material());
    m_stack->setCurrentIndex(material ? 0 : 1);
    m_stale = false;
    if (!material) {
        m_job.cancel(); // the answer would be about a material that is gone
        m_result = {};
        return;
    }
    describe();
    LensRequest request;
    request.incidence = static_cast<float>(glm::radians(m_controls->incidence()));
    request.scale = m_controls->scale();
    m_job.request([this, request, looks = m_comparison->looks(document.model),
                   pinned = pinnedPoint(*material), of = *material,
                   known = m_known](const JobContext& job) mutable -> LatestJob::Apply {
        const SurfacePoint point = pinned ? *pinned : surfaceRange(of, [&](const ImagePtr& image) {
                                                          return known->rangeOf(image);
                                                      }).mean;
        for (const LensComparison::Look& look : looks)
            request.looks.push_back({look.model, look.point.value_or(point)});
        const LensResult result = evaluateLens(request, known->tables, job);
        return [this, result, looks] { showResult(result, looks); };
    });
}

std::optional<SurfacePoint> BrdfLensPanel::pinnedPoint(const Material& material) const {
    const std::optional<render::Inspection>& pin = m_probe.pin();
    if (!pin || !pin->onSurface() || pin->material != material.id)
        return std::nullopt;
    return render::surfaceInputs(*pin, material);
}

void BrdfLensPanel::describe() {
    const Material* material = m_controller.document().material(m_selection.material());
    if (!material)
        return;
    QString note = QString::fromStdString(material->name);
    if (pinnedPoint(*material))
        note += tr(", at the pinned pixel");
    else if (hasMaps(*material))
        note += tr(", mean of its maps");
    if (material->perceptualRoughness < shading::kMinPerceptualRoughness)
        note += tr(", lights see roughness %1")
                    .arg(static_cast<double>(shading::kMinPerceptualRoughness), 0, 'f', 3);
    if (!m_onSurface.problem().isEmpty())
        note += QStringLiteral(". ") + m_onSurface.problem();
    m_note->setText(note);
}

void BrdfLensPanel::refreshEnvironment() {
    if (!isVisible())
        return;
    const Document& document = m_controller.document();
    m_ball->setEnvironment(m_maps, document.environment(), document.view);
    const ImagePtr image = document.environment().image;
    if (!image || image == m_environment)
        return;
    m_environment = image;
    m_ballLight.request([this, image](const JobContext& job) -> LatestJob::Apply {
        auto maps = computeIbl(*image, IblSettings::quick(), job);
        if (!maps)
            return {};
        return [this, made = std::make_shared<const IblMaps>(std::move(*maps))] {
            m_maps = made;
            const Document& now = m_controller.document();
            m_ball->setEnvironment(m_maps, now.environment(), now.view);
        };
    });
}

void BrdfLensPanel::showResult(const LensResult& result, const Looks& looks) {
    if (result.curves.empty())
        return;
    m_result = result;
    const QString dark = result.peak > 0.0f ? QString()
                         : result.request.scale.lobe == LensLobe::Diffuse
                             ? tr("Nothing is reflected: this material has no diffuse lobe.")
                             : tr("Nothing is reflected.");
    m_polar->setMessage(dark);
    m_cartesian->setMessage(dark);
    m_space->setMessage(dark);
    showCurves(looks);
    showAlbedo(looks);
    std::vector<LobeView::Lobe> lobes;
    std::vector<LitSphere::Ball> balls;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        lobes.push_back({{looks[i].slot, looks[i].name},
                         std::make_shared<const LobeMesh>(result.curves[i].mesh),
                         result.curves[i].lens});
        balls.push_back({{looks[i].slot, looks[i].name}, result.curves[i].lens});
    }
    m_space->setLobes(std::move(lobes), glm::degrees(static_cast<double>(result.request.incidence)),
                      result.request.scale, double{result.peak});
    m_ball->setBalls(std::move(balls));
}

void BrdfLensPanel::showCurves(const Looks& looks) {
    const LobeScale& scale = m_result.request.scale;
    const double incidence = glm::degrees(static_cast<double>(m_result.request.incidence));
    const QString sr = QStringLiteral(" sr⁻¹");
    const QString quantity = scale.cosine ? QStringLiteral("fᵣ·cos θₒ") : QStringLiteral("fᵣ");
    const auto curvesOf = [&](LensCurves::Curve LensCurves::*member) {
        std::vector<PlotCurve> curves;
        for (std::size_t i = 0; i < looks.size(); ++i)
            curves.push_back({looks[i].slot, CurveShape::Line,
                              looks.size() > 1 ? looks[i].name : QString(),
                              toPoints(m_result.curves[i].*member)});
        return curves;
    };
    m_polar->setQuantity(quantity, sr);
    m_polar->setCurves(curvesOf(&LensCurves::lobe), static_cast<double>(m_result.peak),
                       scale.logarithmic, static_cast<double>(kLobeDecades));
    PlotAxis reflected{quantity, sr}, facets{QStringLiteral("D"), sr};
    reflected.logarithmic = facets.logarithmic = scale.logarithmic;
    const auto show = [&](CurvePlot& plot, const PlotAxis& x, const PlotAxis& y,
                          LensCurves::Curve LensCurves::*member, std::optional<double> yMax) {
        plot.setAxes(x, y, yMax);
        plot.setCurves(curvesOf(member));
    };
    show(*m_cartesian, angleAxis(QStringLiteral("θₒ"), -90.0), reflected, &LensCurves::lobe, {});
    show(*m_distribution, angleAxis(QStringLiteral("θₕ")), facets, &LensCurves::distribution, {});
    show(*m_masking, angleAxis(QStringLiteral("θₒ")), {QStringLiteral("G"), {}},
         &LensCurves::masking, 1.0);
    show(*m_fresnel, angleAxis(QStringLiteral("∠(v,h)")), {QStringLiteral("F"), {}},
         &LensCurves::fresnel, 1.0);
    for (CurvePlot* plot : {m_cartesian, m_masking, m_fresnel})
        plot->setMarker(incidence, tr("mirror"));
}

void BrdfLensPanel::showAlbedo(const Looks& looks) {
    std::vector<PlotCurve> curves;
    for (std::size_t i = 0; i < looks.size(); ++i) {
        const LensCurves& of = m_result.curves[i];
        const QString prefix = looks.size() > 1 ? looks[i].name + QStringLiteral(", ") : QString();
        curves.push_back(
            {looks[i].slot, CurveShape::Line, prefix + tr("compensated"), toPoints(of.multi)});
        curves.push_back(
            {looks[i].slot, CurveShape::Thin, prefix + tr("single scatter"), toPoints(of.single)});
        curves.push_back(
            {looks[i].slot, CurveShape::Dots, prefix + tr("exact, as set"), toPoints(of.exact)});
    }
    m_albedo->setAxes(angleAxis(QStringLiteral("θₒ")), {tr("share"), {}}, 1.0);
    m_albedo->setKey({{CurveShape::Line, tr("compensated")},
                      {CurveShape::Thin, tr("single scatter")},
                      {CurveShape::Dots, tr("exact, as set")}});
    m_albedo->setCurves(std::move(curves));
}

void BrdfLensPanel::probe(std::optional<double> viewerDeg) {
    const auto at = [](std::optional<double> degrees) {
        return degrees ? std::optional(QPointF(*degrees, 0.0)) : std::nullopt;
    };
    const double incidence = m_controls->incidence();
    m_polar->setProbe(at(viewerDeg));
    m_cartesian->setProbe(at(viewerDeg));
    // Their axes begin at the normal.
    m_masking->setProbe(viewerDeg && *viewerDeg >= 0.0 ? at(viewerDeg) : std::nullopt);
    const auto show = [&](CurvePlot& plot, const std::function<double(double)>& angle) {
        plot.setProbe(viewerDeg ? at(std::abs(angle(*viewerDeg))) : std::nullopt);
    };
    show(*m_albedo, [](double viewer) { return viewer; });
    show(*m_distribution, [&](double viewer) { return (viewer - incidence) / 2.0; });
    show(*m_fresnel, [&](double viewer) { return (viewer + incidence) / 2.0; });
}

} // namespace patina::editor
