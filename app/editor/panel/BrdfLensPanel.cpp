#include "app/editor/panel/BrdfLensPanel.h"

#include "app/editor/document/Commands.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/panel/ParameterRow.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/PixelProbe.h"
#include "app/editor/widget/CurvePlot.h"
#include "app/editor/widget/FlowLayout.h"
#include "app/editor/widget/LitSphere.h"
#include "app/editor/widget/LobeView.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/PolarPlot.h"
#include "app/editor/widget/Slider.h"
#include "app/editor/widget/TileArea.h"
#include "core/document/ModelPresets.h"
#include "core/image/TexelRange.h"
#include "core/light/EnergyStudy.h"

#include <QButtonGroup>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace patina::editor {
namespace {

constexpr double kMostIncident = 89.0; // light along the surface does not reach it
constexpr QSize kSmallestTile(148, 132);

std::vector<QPointF> toPoints(const LensCurves::Curve& curve) {
    std::vector<QPointF> points;
    points.reserve(curve.size());
    for (const glm::vec2& point : curve)
        points.emplace_back(static_cast<double>(point.x), static_cast<double>(point.y));
    return points;
}

// A stroke as the look's curves have it.
QIcon sampleOf(int slot) {
    QPixmap pixmap(44, 24);
    pixmap.setDevicePixelRatio(2.0);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(plotPen(slot, 2.0));
    painter.drawLine(QPointF(1, 6), QPointF(21, 6));
    return pixmap;
}

bool hasMaps(const Material& material) {
    return material.baseColorMap.assigned() || material.metallicMap.assigned() ||
           material.perceptualRoughnessMap.assigned();
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
                             PixelProbe& probe, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_selection(selection)
    , m_probe(probe)
    , m_known(std::make_shared<Known>()) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(tokens::kGap, 6, tokens::kGap, tokens::kGap);
    layout->setSpacing(6);
    m_nothing = new QLabel(tr("No material is selected. Select one in the Scene panel to see how "
                              "it reflects."));
    m_nothing->setObjectName(QStringLiteral("dim"));
    m_nothing->setAlignment(Qt::AlignCenter);
    m_nothing->setWordWrap(true);
    auto* body = new QWidget;
    auto* rows = new QVBoxLayout(body);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(6);
    m_tiles = new TileArea(kSmallestTile);
    makePlots();
    rows->addWidget(makeControls());
    rows->addWidget(m_tiles, 1);
    m_stack = new QStackedWidget;
    m_stack->addWidget(body);
    m_stack->addWidget(m_nothing);
    layout->addWidget(m_stack);
    setPage(Page::Lobe);

    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        const std::optional<Target>& target = change.target;
        if (!target || target->scope == Scope::Model || target->scope == Scope::Material)
            refresh();
        if (!target || target->scope == Scope::Environment || target->scope == Scope::Softbox ||
            target->scope == Scope::View)
            refreshSurroundings();
    });
    connect(&selection, &SelectionModel::selectionChanged, this, &BrdfLensPanel::refresh);
    connect(&probe, &PixelProbe::pinChanged, this, &BrdfLensPanel::refresh);
    refreshLegend();
}

BrdfLensPanel::~BrdfLensPanel() = default;

// --- Controls
// --------------------------------------------------------------------------------------

QWidget* BrdfLensPanel::makeControls() {
    auto* controls = new QWidget;
    auto* flow = new FlowLayout(tokens::kGap, 4, controls);
    flow->setContentsMargins(0, 0, 0, 0);
    flow->addWidget(makePages());
    flow->addWidget(makeIncidence());
    m_quantity = makeChoice(tr("Quantity"),
                            tr("What lobes show: the reflection fᵣ, or fᵣ times the cosine of the "
                               "viewer's angle, whose integral is the albedo"),
                            {QStringLiteral("fᵣ"), QStringLiteral("fᵣ · cos θₒ")});
    m_lobe = makeChoice(tr("Lobe"), tr("Which part of the reflection is shown"),
                        {tr("Both lobes"), tr("Specular"), tr("Diffuse")});
    m_channel = makeChoice(tr("Channel"), tr("Which number of a colour the curves show"),
                           {tr("Luminance"), tr("Red"), tr("Green"), tr("Blue")});
    for (QWidget* choice : {m_quantity, m_lobe, m_channel})
        flow->addWidget(choice);
    m_logarithmic = new QToolButton;
    m_logarithmic->setObjectName(QStringLiteral("segment"));
    m_logarithmic->setText(tr(" Log "));
    m_logarithmic->setCheckable(true);
    m_logarithmic->setChecked(true); // a highlight is often a thousand times what surrounds it
    m_logarithmic->setAccessibleName(tr("Logarithmic"));
    m_logarithmic->setToolTip(tr("Show lobes on a logarithmic scale, so that what is faint shows "
                                 "beside a strong highlight"));
    m_logarithmic->setStatusTip(m_logarithmic->toolTip());
    m_logarithmic->setFocusPolicy(Qt::TabFocus);
    connect(m_logarithmic, &QToolButton::toggled, this, &BrdfLensPanel::refresh);
    flow->addWidget(m_logarithmic);
    flow->addWidget(makeCompare());
    m_legend = new QWidget;
    m_legendRow = new QHBoxLayout(m_legend);
    m_legendRow->setContentsMargins(0, 0, 0, 0);
    m_legendRow->setSpacing(2);
    flow->addWidget(m_legend);
    m_note = new QLabel;
    m_note->setObjectName(QStringLiteral("dim"));
    m_note->setAccessibleName(tr("Looked at"));
    flow->addWidget(m_note);
    return controls;
}

QWidget* BrdfLensPanel::makePages() {
    auto* pages = new QWidget;
    auto* row = new QHBoxLayout(pages);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(2);
    auto* group = new QButtonGroup(pages);
    const struct {
        QString text, help;
    } texts[] = {{tr("Lobe"), tr("Where light goes: polar and Cartesian plots, in space, on a "
                                 "ball")},
                 {tr("D G F"), tr("The factors of the specular lobe")},
                 {tr("Albedo"), tr("How much light comes back, by the viewer's angle")},
                 {tr("All"), tr("Every plot")}};
    for (const auto& [text, help] : texts) {
        auto* button = new QToolButton;
        button->setObjectName(QStringLiteral("segment"));
        button->setText(QStringLiteral(" %1 ").arg(text));
        button->setToolTip(help);
        button->setStatusTip(help);
        button->setAccessibleName(tr("Show %1").arg(text));
        button->setCheckable(true);
        button->setFocusPolicy(Qt::TabFocus);
        group->addButton(button);
        row->addWidget(button);
        const auto page = static_cast<Page>(m_pages.size());
        connect(button, &QToolButton::clicked, this, [this, page] { setPage(page); });
        m_pages.push_back(button);
    }
    return pages;
}

QWidget* BrdfLensPanel::makeIncidence() {
    auto* box = new QWidget;
    auto* row = new QHBoxLayout(box);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(6);
    const QString help = tr("Angle of the light from the normal; also dragged in the polar plot");
    auto* label = new QLabel(tr("Light θᵢ"));
    label->setObjectName(QStringLiteral("dim"));
    m_slider = new Slider(0.0, kMostIncident, 0.0);
    m_slider->setFixedWidth(96);
    m_slider->setAccessibleName(tr("Angle of incidence slider"));
    m_angle =
        new NumberField({0.0, kMostIncident, 0.0, kMostIncident, 1, false, QStringLiteral("°")});
    m_angle->setAccessibleName(tr("Angle of incidence"));
    m_angle->setFixedWidth(56);
    for (QWidget* widget : {static_cast<QWidget*>(label), static_cast<QWidget*>(m_slider),
                            static_cast<QWidget*>(m_angle)}) {
        widget->setToolTip(help);
        widget->setStatusTip(help);
        row->addWidget(widget);
    }
    connect(m_slider, &Slider::dragged, this, &BrdfLensPanel::setIncidence);
    for (auto signal : {&NumberField::dragged, &NumberField::stepped, &NumberField::edited})
        connect(m_angle, signal, this, &BrdfLensPanel::setIncidence);
    m_slider->setValue(m_incidenceDeg);
    m_angle->setValue(m_incidenceDeg);
    m_polar->setIncidence(m_incidenceDeg);
    return box;
}

QComboBox* BrdfLensPanel::makeChoice(const QString& name, const QString& help,
                                     const QStringList& items) {
    auto* box = new QComboBox;
    box->setObjectName(QStringLiteral("small"));
    box->addItems(items);
    box->setAccessibleName(name);
    box->setToolTip(help);
    box->setStatusTip(help);
    box->setFocusPolicy(Qt::StrongFocus);
    connect(box, &QComboBox::currentIndexChanged, this, &BrdfLensPanel::refresh);
    return box;
}

QToolButton* BrdfLensPanel::makeCompare() {
    m_compare = new QToolButton;
    m_compare->setObjectName(QStringLiteral("raised"));
    m_compare->setText(tr(" Compare "));
    m_compare->setAccessibleName(tr("Compare"));
    m_compare->setToolTip(tr("Put up to three other shading models, or the material as it is now, "
                             "beside the scene's"));
    m_compare->setStatusTip(m_compare->toolTip());
    m_compare->setPopupMode(QToolButton::InstantPopup);
    m_compare->setFocusPolicy(Qt::TabFocus);
    m_compareMenu = new QMenu(m_compare);
    m_compareMenu->setToolTipsVisible(true);
    m_compare->setMenu(m_compareMenu);
    connect(m_compareMenu, &QMenu::aboutToShow, this, &BrdfLensPanel::fillCompareMenu);
    return m_compare;
}

void BrdfLensPanel::makePlots() {
    m_polar = new PolarPlot(tr("Polar"));
    m_cartesian = new CurvePlot(tr("By angle"));
    m_space = new LobeView(tr("In space"));
    m_ball = new LitSphere(tr("On a ball"));
    m_distribution = new CurvePlot(tr("D  facing h"));
    m_masking = new CurvePlot(tr("G  not hidden"));
    m_fresnel = new CurvePlot(tr("F  Fresnel"));
    m_albedo = new CurvePlot(tr("Albedo"));
    for (QWidget* plot : {static_cast<QWidget*>(m_polar), static_cast<QWidget*>(m_cartesian),
                          static_cast<QWidget*>(m_space), static_cast<QWidget*>(m_ball),
                          static_cast<QWidget*>(m_distribution), static_cast<QWidget*>(m_masking),
                          static_cast<QWidget*>(m_fresnel), static_cast<QWidget*>(m_albedo)})
        m_tiles->add(plot);
    const auto describe = [](QWidget* plot, const QString& help) {
        plot->setAccessibleDescription(help);
        plot->setStatusTip(help);
    };
    describe(m_cartesian, tr("How much of the light at θᵢ is reflected to viewers at θₒ, in the "
                             "plane of incidence; positive angles lie opposite the light"));
    describe(m_distribution, tr("D: how many facets of the surface face the half vector, which "
                                "leans ∠(n,h) from the normal"));
    describe(m_masking, tr("G: the share of facets that neither light nor viewer finds hidden, the "
                           "viewer at θₒ opposite the light"));
    describe(m_fresnel, tr("F: the reflectance of a facet that light meets at ∠(v,h)"));
    describe(m_albedo, tr("The share of light from all sides that comes back to a viewer at θₒ: "
                          "scattered once, with energy compensation, and as the exact integral"));
    connect(m_polar, &PolarPlot::incidenceDragged, this, &BrdfLensPanel::setIncidence);
    connect(m_polar, &PolarPlot::probed, this, &BrdfLensPanel::probe);
    connect(m_cartesian, &CurvePlot::probed, this, &BrdfLensPanel::probe);
    connect(m_masking, &CurvePlot::probed, this, &BrdfLensPanel::probe);
    connect(m_albedo, &CurvePlot::probed, this, &BrdfLensPanel::probe);
    // h stands in the middle between the light at -θi and the viewer.
    connect(m_distribution, &CurvePlot::probed, this, [this](std::optional<double> half) {
        probe(half ? std::optional(m_incidenceDeg + 2.0 * *half) : half);
        m_distribution->setProbe(half);
    });
    connect(m_fresnel, &CurvePlot::probed, this, [this](std::optional<double> difference) {
        probe(difference ? std::optional(2.0 * *difference - m_incidenceDeg) : difference);
        m_fresnel->setProbe(difference);
    });
}

void BrdfLensPanel::setPage(Page page) {
    m_pages[static_cast<std::size_t>(page)]->setChecked(true);
    switch (page) {
    case Page::Lobe:
        m_tiles->setShown({m_polar, m_cartesian, m_space, m_ball});
        break;
    case Page::Factors:
        m_tiles->setShown({m_distribution, m_masking, m_fresnel});
        break;
    case Page::Albedo:
        m_tiles->setShown({m_albedo});
        break;
    case Page::All:
        m_tiles->setShown({m_polar, m_cartesian, m_space, m_ball, m_distribution, m_masking,
                           m_fresnel, m_albedo});
        break;
    }
}

void BrdfLensPanel::setIncidence(double degrees) {
    m_incidenceDeg = std::clamp(degrees, 0.0, kMostIncident);
    m_slider->setValue(m_incidenceDeg);
    m_angle->setValue(m_incidenceDeg);
    m_polar->setIncidence(m_incidenceDeg);
    refresh();
}

// --- What is compared
// ------------------------------------------------------------------------------

std::vector<BrdfLensPanel::Compared>::iterator BrdfLensPanel::findCompared(Compared::Kind kind,
                                                                           int preset) {
    return std::find_if(m_compared.begin(), m_compared.end(), [&](const Compared& c) {
        return c.kind == kind && (kind != Compared::Kind::Preset || c.preset == preset);
    });
}

QString BrdfLensPanel::nameOf(const Compared& compared) const {
    switch (compared.kind) {
    case Compared::Kind::Preset:
        return toQString(modelPresets()[static_cast<std::size_t>(compared.preset)].title);
    case Compared::Kind::SingleScatter:
        return tr("No compensation");
    case Compared::Kind::Frozen:
        break;
    }
    return tr("Frozen");
}

ShadingModel BrdfLensPanel::modelOf(const Compared& compared) const {
    ShadingModel model = m_controller.document().model;
    switch (compared.kind) {
    case Compared::Kind::Preset: {
        const ShadingModel& preset =
            modelPresets()[static_cast<std::size_t>(compared.preset)].model;
        // Its choices; the numbers stay the document's.
        model.distribution = preset.distribution;
        model.visibility = preset.visibility;
        model.fresnel = preset.fresnel;
        model.diffuse = preset.diffuse;
        model.multiScatter = preset.multiScatter;
        model.lobeDirection = preset.lobeDirection;
        return model;
    }
    case Compared::Kind::SingleScatter:
        return withCompensation(model, false);
    case Compared::Kind::Frozen:
        break;
    }
    return compared.frozen.model;
}

void BrdfLensPanel::toggleCompared(const Compared& compared, bool compare) {
    const auto known = findCompared(compared.kind, compared.preset);
    if (known != m_compared.end()) {
        if (compare) // frozen anew, in the same colour
            known->frozen = compared.frozen;
        else
            m_compared.erase(known);
    } else if (compare) {
        if (static_cast<int>(m_compared.size()) == kPlotLooks - 1)
            m_compared.erase(m_compared.begin()); // the oldest makes room
        Compared added = compared;
        for (added.slot = 1; added.slot < kPlotLooks; ++added.slot)
            if (std::none_of(m_compared.begin(), m_compared.end(),
                             [&](const Compared& c) { return c.slot == added.slot; }))
                break;
        m_compared.push_back(added);
    }
    refreshLegend();
    refresh();
}

void BrdfLensPanel::compareWithPreset(int preset, bool compare) {
    Compared compared;
    compared.preset = preset;
    toggleCompared(compared, compare);
}

void BrdfLensPanel::fillCompareMenu() {
    m_compareMenu->clear();
    const auto addChoice = [this](const Compared& compared, const QString& help) {
        QAction* action = m_compareMenu->addAction(nameOf(compared));
        action->setToolTip(help);
        action->setStatusTip(help);
        action->setCheckable(true);
        action->setChecked(findCompared(compared.kind, compared.preset) != m_compared.end());
        connect(action, &QAction::triggered, this,
                [this, compared](bool checked) { toggleCompared(compared, checked); });
    };
    for (int i = 0; i < static_cast<int>(modelPresets().size()); ++i) {
        Compared compared;
        compared.preset = i;
        addChoice(compared, toQString(modelPresets()[static_cast<std::size_t>(i)].help));
    }
    m_compareMenu->addSeparator();
    Compared single;
    single.kind = Compared::Kind::SingleScatter;
    addChoice(single, tr("The scene's model, light scattered once only"));
    m_compareMenu->addSeparator();
    QAction* freeze = m_compareMenu->addAction(tr("Freeze as It Is Now"), this, [this] {
        Compared frozen;
        frozen.kind = Compared::Kind::Frozen;
        if (!m_result.request.looks.empty()) {
            frozen.frozen = m_result.request.looks.front();
            toggleCompared(frozen, true);
        }
    });
    freeze->setToolTip(tr("Keep the material and its model as they are, to compare with what you "
                          "do next"));
    freeze->setStatusTip(freeze->toolTip());
    QAction* nothing = m_compareMenu->addAction(tr("Compare with Nothing"), this, [this] {
        m_compared.clear();
        refreshLegend();
        refresh();
    });
    nothing->setToolTip(tr("Show the scene's material alone"));
    nothing->setStatusTip(nothing->toolTip());
    nothing->setEnabled(!m_compared.empty());
}

void BrdfLensPanel::refreshLegend() {
    while (QLayoutItem* item = m_legendRow->takeAt(0)) {
        item->widget()->deleteLater();
        item->widget()->hide();
        delete item;
    }
    const auto add = [this](int slot, const QString& name, const QString& help) {
        auto* entry = new QToolButton;
        entry->setIcon(sampleOf(slot));
        entry->setIconSize({22, 12});
        entry->setText(name);
        entry->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
        entry->setToolTip(help);
        entry->setStatusTip(help);
        entry->setAccessibleName(tr("Legend: %1").arg(name));
        entry->setFocusPolicy(Qt::TabFocus);
        m_legendRow->addWidget(entry);
        return entry;
    };
    add(0, tr("Scene"), tr("The selected material with the scene's shading model"))
        ->setFocusPolicy(Qt::NoFocus);
    for (const Compared& compared : m_compared)
        connect(add(compared.slot, nameOf(compared), tr("Click to compare with it no longer")),
                &QToolButton::clicked, this, [this, compared] { toggleCompared(compared, false); });
    m_legend->updateGeometry();
}

// --- What is shown
// ---------------------------------------------------------------------------------

void BrdfLensPanel::showEvent(QShowEvent*) {
    if (m_stale)
        refresh();
    refreshSurroundings();
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
    LensRequest request;
    request.incidence = static_cast<float>(glm::radians(m_incidenceDeg));
    request.scale.lobe = static_cast<LensLobe>(m_lobe->currentIndex());
    request.scale.cosine = m_quantity->currentIndex() == 1;
    request.scale.logarithmic = m_logarithmic->isChecked();
    request.scale.channel = m_channel->currentIndex() - 1;
    request.looks.push_back({document.model, {}});
    std::vector<int> slots{0};
    QStringList names{tr("Scene")};
    std::optional<std::size_t> frozen; // whose point is its own
    for (const Compared& compared : m_compared) {
        if (compared.kind == Compared::Kind::Frozen)
            frozen = request.looks.size();
        request.looks.push_back({modelOf(compared), compared.frozen.point});
        slots.push_back(compared.slot);
        names << nameOf(compared);
    }
    const std::optional<SurfacePoint> pinned = pinnedPoint(*material);
    describe(*material, pinned.has_value());
    m_job.request([this, request, slots, names, frozen, pinned, of = *material,
                   known = m_known](const JobContext& job) mutable -> LatestJob::Apply {
        const SurfacePoint point = pinned ? *pinned : surfaceRange(of, [&](const ImagePtr& image) {
                                                          return known->rangeOf(image);
                                                      }).mean;
        for (std::size_t i = 0; i < request.looks.size(); ++i)
            if (i != frozen)
                request.looks[i].point = point;
        const LensResult result = evaluateLens(request, known->tables, job);
        return [this, result, slots, names] { showResult(result, slots, names); };
    });
}

std::optional<SurfacePoint> BrdfLensPanel::pinnedPoint(const Material& material) const {
    const std::optional<render::Inspection>& pin = m_probe.pin();
    if (!pin || !pin->onSurface() || pin->material != material.id)
        return std::nullopt;
    return SurfacePoint{glm::vec3(pin->value(shading::kViewBaseColor)),
                        pin->value(shading::kViewMetallic).x,
                        pin->value(shading::kViewPerceptualRoughness).x, material.diffuseRoughness};
}

void BrdfLensPanel::describe(const Material& material, bool pinned) {
    QString note = QString::fromStdString(material.name);
    if (pinned)
        note += tr(", at the pinned pixel");
    else if (hasMaps(material))
        note += tr(", mean of its maps");
    if (material.perceptualRoughness < shading::kMinPerceptualRoughness)
        note += tr(", lamps see roughness %1")
                    .arg(static_cast<double>(shading::kMinPerceptualRoughness), 0, 'f', 3);
    m_note->setText(note);
}

void BrdfLensPanel::refreshSurroundings() {
    if (!isVisible())
        return;
    const Document& document = m_controller.document();
    m_ball->setSurroundings(m_maps, document.environment, document.view);
    const ImagePtr image = document.environment.image;
    if (!image || image == m_environment)
        return;
    m_environment = image;
    m_surroundings.request([this, image](const JobContext& job) -> LatestJob::Apply {
        auto maps = computeIbl(*image, IblSettings::quick(), job);
        if (!maps)
            return {};
        return [this, made = std::make_shared<const IblMaps>(std::move(*maps))] {
            m_maps = made;
            const Document& now = m_controller.document();
            m_ball->setSurroundings(m_maps, now.environment, now.view);
        };
    });
}

void BrdfLensPanel::showResult(const LensResult& result, const std::vector<int>& slots,
                               const QStringList& names) {
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
    showCurves(slots, names);
    showAlbedo(slots, names);
    std::vector<LobeView::Lobe> lobes;
    std::vector<LitSphere::Ball> balls;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const QString& name = names[static_cast<int>(i)];
        lobes.push_back({slots[i], name, std::make_shared<const LobeMesh>(result.curves[i].mesh)});
        balls.push_back({slots[i], name, result.curves[i].lens});
    }
    m_space->setLobes(std::move(lobes), m_incidenceDeg,
                      tr("peak %1 sr⁻¹").arg(plotNumber(static_cast<double>(result.peak))));
    m_ball->setBalls(std::move(balls));
}

void BrdfLensPanel::showCurves(const std::vector<int>& slots, const QStringList& names) {
    const LobeScale& scale = m_result.request.scale;
    const double incidence = glm::degrees(static_cast<double>(m_result.request.incidence));
    const QString sr = QStringLiteral(" sr⁻¹");
    const QString quantity = scale.cosine ? QStringLiteral("fᵣ·cos θₒ") : QStringLiteral("fᵣ");
    const auto curvesOf = [&](LensCurves::Curve LensCurves::*member) {
        std::vector<PlotCurve> curves;
        for (std::size_t i = 0; i < slots.size(); ++i)
            curves.push_back({slots[i], CurveShape::Line,
                              slots.size() > 1 ? names[static_cast<int>(i)] : QString(),
                              toPoints(m_result.curves[i].*member)});
        return curves;
    };
    m_polar->setQuantity(quantity, sr);
    m_polar->setCurves(curvesOf(&LensCurves::lobe), static_cast<double>(m_result.peak),
                       scale.logarithmic, static_cast<double>(kLobeDecades));
    m_cartesian->setAxes({QStringLiteral("θₒ"), quantity, QStringLiteral("°"), sr, -90, 90, 30,
                          scale.logarithmic, std::nullopt});
    m_cartesian->setMarker(incidence, tr("mirror"));
    m_cartesian->setCurves(curvesOf(&LensCurves::lobe));
    m_distribution->setAxes({QStringLiteral("∠(n,h)"), QStringLiteral("D"), QStringLiteral("°"), sr,
                             0, 90, 30, scale.logarithmic, std::nullopt});
    m_distribution->setCurves(curvesOf(&LensCurves::distribution));
    m_masking->setAxes({QStringLiteral("θₒ"),
                        QStringLiteral("G"),
                        QStringLiteral("°"),
                        {},
                        0,
                        90,
                        30,
                        false,
                        1.0});
    m_masking->setMarker(incidence, tr("mirror"));
    m_masking->setCurves(curvesOf(&LensCurves::masking));
    m_fresnel->setAxes({QStringLiteral("∠(v,h)"),
                        QStringLiteral("F"),
                        QStringLiteral("°"),
                        {},
                        0,
                        90,
                        30,
                        false,
                        1.0});
    m_fresnel->setMarker(incidence, tr("mirror"));
    m_fresnel->setCurves(curvesOf(&LensCurves::fresnel));
}

void BrdfLensPanel::showAlbedo(const std::vector<int>& slots, const QStringList& names) {
    std::vector<PlotCurve> curves;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const LensCurves& of = m_result.curves[i];
        const QString prefix =
            slots.size() > 1 ? names[static_cast<int>(i)] + QStringLiteral(", ") : QString();
        curves.push_back(
            {slots[i], CurveShape::Line, prefix + tr("compensated"), toPoints(of.multi)});
        curves.push_back(
            {slots[i], CurveShape::Thin, prefix + tr("single scatter"), toPoints(of.single)});
        curves.push_back(
            {slots[i], CurveShape::Dots, prefix + tr("exact, as set"), toPoints(of.exact)});
    }
    m_albedo->setAxes(
        {QStringLiteral("θₒ"), tr("share"), QStringLiteral("°"), {}, 0, 90, 30, false, 1.0});
    m_albedo->setKey({{CurveShape::Line, tr("compensated")},
                      {CurveShape::Thin, tr("single scatter")},
                      {CurveShape::Dots, tr("exact, as set")}});
    m_albedo->setCurves(std::move(curves));
}

void BrdfLensPanel::probe(std::optional<double> viewerDeg) {
    m_polar->setProbe(viewerDeg);
    m_cartesian->setProbe(viewerDeg);
    // Their axes begin at the normal.
    const std::optional<double> away = viewerDeg && *viewerDeg >= 0.0 ? viewerDeg : std::nullopt;
    m_masking->setProbe(away);
    m_albedo->setProbe(viewerDeg ? std::optional(std::abs(*viewerDeg)) : std::nullopt);
    m_distribution->setProbe(viewerDeg ? std::optional(std::abs(*viewerDeg - m_incidenceDeg) / 2.0)
                                       : std::nullopt);
    m_fresnel->setProbe(viewerDeg ? std::optional(std::abs(*viewerDeg + m_incidenceDeg) / 2.0)
                                  : std::nullopt);
}

} // namespace patina::editor
