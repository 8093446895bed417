#include "app/editor/panel/EnergyPanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/job/LatestJob.h"
#include "app/editor/panel/FurnaceControls.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ColumnsLayout.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/EnergyBars.h"
#include "app/editor/widget/EnergyMap.h"
#include "app/editor/widget/EnergyPlot.h"
#include "app/editor/widget/FlowLayout.h"
#include "app/editor/widget/NumberField.h"
#include "app/editor/widget/PanelScroll.h"
#include "app/editor/widget/PlotLegend.h"
#include "core/edit/EditSession.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr std::size_t kRemembered = 16; // maps
constexpr int kLeastPlot = 150;         // pixels high

QLabel* makeText(bool dim) {
    auto* label = new QLabel;
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    label->setFocusPolicy(Qt::NoFocus);
    if (dim)
        label->setObjectName(QStringLiteral("dim"));
    return label;
}

EnergyShares sharesOf(const EnergyStudy& study, EnergyChannel channel, bool multiScatter) {
    const EnergyBalance balance =
        energyBalance(inChannel(study.average.single, channel),
                      inChannel(study.average.compensated, channel), multiScatter);
    return {balance.specular.x, balance.diffuse.x, balance.absorbed.x, balance.lost.x};
}

} // namespace

struct EnergyPanel::MapRanges {
    std::vector<std::pair<std::weak_ptr<const Image>, TexelRange>> known;

    TexelRange of(const ImagePtr& image, const JobContext& job) {
        std::erase_if(known, [](const auto& entry) { return entry.first.expired(); });
        for (const auto& [seen, range] : known)
            if (seen.lock() == image)
                return range;
        if (known.size() >= kRemembered)
            known.erase(known.begin());
        const TexelRange range = texelRange(*image, job);
        if (!job.cancelled())
            known.emplace_back(image, range);
        return range;
    }
};

EnergyPanel::EnergyPanel(DocumentController& controller, SelectionModel& selection,
                         ViewState& views, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_selection(selection)
    , m_job(new LatestJob(controller.runner(), "energy of the material", this))
    , m_ranges(std::make_shared<MapRanges>()) {
    auto* scroll = new PanelScroll;
    auto* bar = new FlowLayout(tokens::kMargin, tokens::kGap / 2);
    bar->addWidget(new FurnaceControls(views));
    bar->addWidget(makeChoices());
    m_legend = new PlotLegend;
    bar->addWidget(m_legend);
    scroll->contents()->addLayout(bar);

    m_byRoughness = new EnergyPlot(tr("By roughness"), {tr("roughness"), {}, 0.0, 1.0, 0.25});
    m_byRoughness->setHelp(tr("Energy returned by roughness, at the chosen angle"));
    m_byAngle = new EnergyPlot(tr("By angle"), {tr("angle"), QStringLiteral("°"), 0.0, 90.0, 30.0});
    m_byAngle->setHelp(tr("Energy returned by the angle of view, at the material's roughness; "
                          "press to choose the angle of the other plot"));
    connect(m_byAngle, &EnergyPlot::picked, this, &EnergyPanel::setAngle);
    m_map = new EnergyMap;
    connect(m_map, &EnergyMap::anglePicked, this, &EnergyPanel::setAngle);
    auto* columns = new ColumnsLayout(tokens::kMargin);
    QWidget* ledger = makeLedger();
    const std::pair<QWidget*, int> items[] = {
        {ledger, 4}, {m_byRoughness, 3}, {m_byAngle, 3}, {m_map, 3}};
    for (const auto& [widget, stretch] : items) {
        QSizePolicy policy = widget->sizePolicy();
        policy.setHorizontalStretch(stretch);
        widget->setSizePolicy(policy);
        columns->addWidget(widget);
    }
    scroll->contents()->addLayout(columns, 1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);

    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (!change.target || change.target->scope == Scope::Model ||
            change.target->scope == Scope::Material)
            request();
    });
    connect(&selection, &SelectionModel::selectionChanged, this, &EnergyPanel::request);
    refresh();
}

EnergyPanel::~EnergyPanel() = default;

QWidget* EnergyPanel::makeChoices() {
    auto* box = new QWidget;
    auto* row = new QHBoxLayout(box);
    row->setContentsMargins(0, 0, 0, 0);
    m_channel = new QComboBox;
    m_channel->addItems({tr("Luminance"), tr("Red"), tr("Green"), tr("Blue")});
    m_channel->setAccessibleName(tr("Channel of the energy"));
    m_channel->setToolTip(tr("Which channel of the material is weighed"));
    connect(m_channel, &QComboBox::currentIndexChanged, this, &EnergyPanel::refresh);
    auto* label = new QLabel(tr("at"));
    label->setObjectName(QStringLiteral("dim"));
    m_angle = new NumberField({0.0, 90.0, 0.0, 90.0, 0, false, QStringLiteral("°")});
    m_angle->setAccessibleName(tr("Angle of view"));
    m_angle->setToolTip(tr("Angle between the surface's normal and the viewer, for the curve over "
                           "roughness"));
    m_angle->setFixedWidth(tokens::kFieldWidth - 20);
    m_angle->setValue(m_angleDeg);
    for (auto signal : {&NumberField::dragged, &NumberField::stepped, &NumberField::edited})
        connect(m_angle, signal, this, &EnergyPanel::setAngle);
    row->addWidget(m_channel);
    row->addWidget(label);
    row->addWidget(m_angle);
    return box;
}

QWidget* EnergyPanel::makeLedger() {
    auto* box = new QWidget;
    box->setMinimumWidth(236);
    auto* column = new QVBoxLayout(box);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(tokens::kGap);
    m_loss = makeText(false);
    m_loss->setAccessibleName(tr("Energy ledger"));
    m_compensate = new QPushButton;
    m_compensate->setAccessibleName(tr("Energy compensation"));
    m_compensate->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    connect(m_compensate, &QPushButton::clicked, this,
            [this] { setCompensation(!m_controller.document().model.multiScatter); });
    m_bars = new EnergyBars;
    m_return = makeText(true);
    auto* faults = new QWidget;
    m_faults = new QVBoxLayout(faults);
    m_faults->setContentsMargins(0, 0, 0, 0);
    column->addWidget(m_loss);
    column->addWidget(faults);
    column->addWidget(m_compensate);
    column->addWidget(m_bars);
    column->addWidget(m_return);
    column->addStretch(1);
    return box;
}

EnergyChannel EnergyPanel::channel() const {
    return static_cast<EnergyChannel>(m_channel->currentIndex());
}

const Material* EnergyPanel::material() const {
    return m_controller.document().material(m_selection.material());
}

// --- What is wanted ------------------------------------------------------------------------------

void EnergyPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    request();
}

void EnergyPanel::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    const int most = std::max(kLeastPlot, height() - tokens::kRowHeight - 3 * tokens::kGap -
                                              2 * tokens::kMargin);
    for (QWidget* plot : std::initializer_list<QWidget*>{m_byRoughness, m_byAngle, m_map})
        plot->setMaximumHeight(most);
}

void EnergyPanel::setAngle(double angleDeg) {
    m_angleDeg = std::clamp(angleDeg, 0.0, 90.0);
    m_angle->setValue(m_angleDeg);
    request();
}

void EnergyPanel::request() {
    if (!isVisible())
        return;
    const Material* shown = material();
    if (!shown) {
        m_job->cancel();
        m_study.reset();
        refresh();
        return;
    }
    m_job->request([this, ranges = m_ranges, material = *shown,
                    model = m_controller.document().model,
                    NoV = cosineOfAngle(static_cast<float>(m_angleDeg))](const JobContext& job) {
        const SurfaceRange surface =
            surfaceRange(material, [&](const ImagePtr& image) { return ranges->of(image, job); });
        auto study =
            std::make_shared<std::optional<EnergyStudy>>(studyEnergy(model, surface, NoV, job));
        return [this, study] {
            if (!*study)
                return; // cancelled
            m_study = std::move(*study);
            refresh();
            Q_EMIT studied();
        };
    });
}

void EnergyPanel::setCompensation(bool on) {
    m_controller.setParameter(parameter("model.multiScatter"), {Scope::Model, 0}, on);
}

void EnergyPanel::fix(EnergyFix fix) {
    if (fix == EnergyFix::TurnOnCompensation)
        setCompensation(true);
    if (fix == EnergyFix::UseSmith)
        m_controller.setParameter(parameter("model.visibility"), {Scope::Model, 0},
                                  static_cast<int>(Visibility::SmithCorrelated));
}

// --- What is shown -------------------------------------------------------------------------------

void EnergyPanel::refresh() {
    m_bars->setVisible(m_study.has_value());
    m_compensate->setVisible(m_study.has_value());
    m_return->setVisible(m_study.has_value());
    m_legend->setVisible(m_study.has_value());
    refreshFaults();
    if (!m_study) {
        m_loss->setText(tr("Select a material to weigh what it does with light."));
        const QString nothing = tr("No material is selected");
        for (PlotFrame* plot : std::initializer_list<PlotFrame*>{m_byRoughness, m_byAngle, m_map})
            plot->setMessage(nothing);
        return;
    }
    refreshLedger();
    refreshPlots();
}

void EnergyPanel::refreshLedger() {
    const bool on = m_study->model.multiScatter;
    m_loss->setText(lossText(*m_study, channel()));
    m_return->setText(returnText(*m_study, channel()));
    m_compensate->setText(on ? tr("Turn Off Compensation") : tr("Turn On Compensation"));
    m_compensate->setToolTip(on ? tr("Leave out the light that bounces more than once, to compare")
                                : tr("Give back the light that bounces more than once"));
    m_compensate->setProperty("primary", !on && compensationMatters(*m_study, channel()));
    m_compensate->style()->unpolish(m_compensate);
    m_compensate->style()->polish(m_compensate);
    m_bars->setShares(sharesOf(*m_study, channel(), false), sharesOf(*m_study, channel(), true),
                      on);
}

void EnergyPanel::refreshFaults() {
    retireAll(*m_faults);
    if (!m_study)
        return;
    const Material* shown = material();
    std::vector<std::pair<QString, EnergyFix>> faults;
    for (const EnergyFault& fault : m_study->faults)
        faults.emplace_back(faultText(fault, m_study->model), fixOf(fault, m_study->model));
    if (shown && shown->emissiveStrength > 0.0f && shown->emissive != glm::vec3(0.0f))
        faults.emplace_back(tr("It also gives light of its own: in the furnace that is brighter "
                               "than the environment."),
                            EnergyFix::None);
    for (const auto& [text, help] : faults) {
        auto* row = new QWidget;
        auto* layout = new QHBoxLayout(row);
        layout->setContentsMargins(0, 0, 0, 0);
        auto* mark = new QLabel;
        mark->setPixmap(icon(QStringLiteral("warning"), tokens::kCopper).pixmap(16, 16));
        layout->addWidget(mark, 0, Qt::AlignTop);
        QLabel* words = makeText(false);
        words->setObjectName(QStringLiteral("energyFault"));
        words->setText(text);
        layout->addWidget(words, 1);
        m_faults->addWidget(row);
        // Compensation has its own button right below.
        if (help != EnergyFix::UseSmith)
            continue;
        auto* button = new QPushButton(tr("Use Smith's Visibility"));
        button->setToolTip(tr("Take the same, derived visibility for lights and environment"));
        button->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
        connect(button, &QPushButton::clicked, this, [this, help = help] { fix(help); });
        m_faults->addWidget(button);
    }
    m_faults->parentWidget()->setVisible(!faults.empty());
}

void EnergyPanel::refreshPlots() {
    const EnergyStudy& study = *m_study;
    const EnergyChannel c = channel();
    const bool on = study.model.multiScatter;
    std::vector<PlotCurve> looks(3);
    looks[0].name = tr("as it is");
    looks[1].name = on ? tr("not compensated") : tr("compensated");
    looks[2].name = tr("lights");
    looks[1].look = 1;
    looks[2].look = 2;
    looks[2].shape = CurveShape::Thin;
    m_legend->setCurves(looks);
    const auto curves = [&](const std::vector<EnergyPoint>& points, double xMax) {
        std::vector<PlotCurve> all = looks;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double x = xMax * static_cast<double>(i) / static_cast<double>(points.size() - 1);
            const double single = 100.0 * channelOf(points[i].single.total(), c);
            const double whole = 100.0 * channelOf(points[i].compensated.total(), c);
            all[0].points.emplace_back(x, on ? whole : single);
            all[1].points.emplace_back(x, on ? single : whole);
            all[2].points.emplace_back(x, 100.0 * channelOf(points[i].lights.total(), c));
        }
        return all;
    };
    const auto show = [&](EnergyPlot& plot, std::vector<PlotCurve> all, double x,
                          const QString& label) {
        const QPointF at = plotPoint(all.front().points, x);
        plot.setMessage({});
        plot.setCurves(std::move(all));
        plot.setMarker(x, label);
        plot.setDot(at.x(), at.y());
    };
    const double roughness = static_cast<double>(study.surface.mean.perceptualRoughness);
    const double low = static_cast<double>(study.surface.low.perceptualRoughness);
    const double high = static_cast<double>(study.surface.high.perceptualRoughness);
    show(*m_byRoughness, curves(study.byRoughness, 1.0), roughness,
         QString::number(roughness, 'f', 2));
    m_byRoughness->setBand(low, high);
    show(*m_byAngle, curves(study.byAngle, 90.0), m_angleDeg, tr("%1°").arg(m_angleDeg));

    std::vector<double> values;
    values.reserve(study.map.size());
    for (const glm::vec3& total : study.map)
        values.push_back(channelOf(glm::dvec3(total), c));
    m_map->setMessage({});
    m_map->setValues(std::move(values), EnergyStudy::kMapSize);
    m_map->setPlace(low, roughness, high, m_angleDeg);
}

} // namespace patina::editor
