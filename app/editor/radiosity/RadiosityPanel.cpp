#include "app/editor/radiosity/RadiosityPanel.h"

#include "app/editor/Session.h"
#include "app/editor/panel/ParameterRow.h"
#include "app/editor/radiosity/ElementOverlay.h"
#include "app/editor/radiosity/RadiosityPlots.h"
#include "app/editor/radiosity/RadiosityTexts.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ColumnsLayout.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/FlowLayout.h"
#include "app/editor/widget/LabelledField.h"
#include "app/editor/widget/PanelScroll.h"
#include "app/editor/widget/TextButton.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Parameters.h"
#include "core/mix/LightList.h"
#include "core/radiosity/document/ElementLinks.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kShotMs = 150;       // between the shots that are played …
constexpr int kSweepMs = 600;      // … and the sweeps
constexpr int kSliderSteps = 1000; // over the logarithm of the steps
constexpr std::size_t kSenders = 10;
constexpr int kElementRole = Qt::UserRole; // that an item is of
enum FlowColumn { kFlowName, kFlowShare, kFlowLight, kFlowColumns };

constexpr std::array kRadiosityViews{shading::kViewFinal,      shading::kViewElementLight,
                                     shading::kViewUnshot,     shading::kViewElementArea,
                                     shading::kViewFormFactor, shading::kViewWireframe};
constexpr std::array kRadiosityParameters{
    "view.radiosityArea",    "view.radiosityAdaptive", "view.radiosityDivideBy",
    "view.radiosityDynamic", "view.radiositySolver",   "view.radiosityMethod",
    "view.radiosityPatches", "view.radiosityRays",     "view.radiosityCells",
    "view.radiosityTexels",  "view.radiosityPairs",    "view.radiosityLinkError",
    "view.radiosityClassic"};
using MethodParameter = std::pair<std::string_view, RadiosityMethod>;
constexpr std::array kMethodParameters{
    MethodParameter("view.radiosityRays", RadiosityMethod::Raycast),
    MethodParameter("view.radiosityCells", RadiosityMethod::Hemicube),
    MethodParameter("view.radiosityTexels", RadiosityMethod::Paraboloid),
    MethodParameter("view.radiosityPairs", RadiosityMethod::Analytic)};

// Positions of the slider: the first steps matter most.
int sliderOf(std::uint64_t steps, std::uint64_t most) {
    return static_cast<int>(
        std::lround(kSliderSteps * std::log1p(static_cast<double>(steps)) /
                    std::log1p(static_cast<double>(std::max<std::uint64_t>(most, 1)))));
}
std::uint64_t stepsAt(int position, std::uint64_t most) {
    return static_cast<std::uint64_t>(std::llround(std::expm1(
        static_cast<double>(position) / kSliderSteps * std::log1p(static_cast<double>(most)))));
}

QPushButton* stepButton(const QString& text, const QString& name, const QString& help) {
    QPushButton* button = makeTextButton(text, help);
    button->setAccessibleName(name);
    button->setObjectName(QStringLiteral("radiosity") + name);
    return button;
}

} // namespace

RadiosityPanel::RadiosityPanel(Session& session, ElementOverlay& overlay, QWidget* parent)
    : QWidget(parent)
    , m_session(session)
    , m_overlay(overlay) {
    setObjectName(QStringLiteral("radiosityPanel"));
    auto* columns = new ColumnsLayout(tokens::kMargin);
    // Where the dock is narrow, what is set once comes below what is looked at.
    const std::pair<QWidget*, int> parts[] = {
        {makeSteps(), 2}, {makePlots(), 4}, {makeElement(), 3}, {makeSettings(), 2}};
    for (const auto& [part, stretch] : parts) {
        QSizePolicy policy = part->sizePolicy();
        policy.setHorizontalStretch(stretch);
        part->setSizePolicy(policy);
        columns->addWidget(part);
    }
    m_scroll = new PanelScroll;
    m_header = makeHeader();
    m_scroll->contents()->addWidget(m_header);
    m_scroll->contents()->addLayout(columns, 1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(m_scroll);

    connect(&m_playing, &QTimer::timeout, this, [this] {
        const auto& step = m_session.radiosity.step();
        if (step && step->atEnd)
            play(false);
        else
            goTo(step ? step->done + 1 : 1);
    });
    connect(&session.radiosity, &RadiosityUpdater::changed, this, &RadiosityPanel::refresh);
    connect(&session.radiosity, &RadiosityUpdater::shownChanged, this, &RadiosityPanel::refresh);
    connect(&session.views, &ViewState::changed, this, &RadiosityPanel::refreshViews);
    connect(&session.controller, &DocumentController::changed, this, [this](const Change& change) {
        if (!change.target)
            m_listed = {}; // names may be others
        if (!change.target || change.target->scope == Scope::View)
            refresh();
    });
    refresh();
}

RadiosityPanel::~RadiosityPanel() = default;

void RadiosityPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    m_overlay.setWanted(true);
    refresh();
}

void RadiosityPanel::hideEvent(QHideEvent* event) {
    QWidget::hideEvent(event);
    m_overlay.setWanted(false);
    play(false);
    m_session.radiosity.endSteps();
}

// --- Parts ---------------------------------------------------------------------------------------

QWidget* RadiosityPanel::makeHeader() {
    m_light = makeTextButton(tr("Light by Radiosity"),
                             tr("Lights the scene by radiosity, which is solved in the background "
                                "and again after each edit; once more: by image-based light"));
    m_light->setObjectName(QStringLiteral("radiosityLight"));
    m_light->setCheckable(true);
    connect(m_light, &QPushButton::clicked, this, [this](bool on) {
        m_session.controller.showLighting(on ? LightingMode::Radiosity : LightingMode::Ibl);
    });
    m_status = new QLabel;
    m_status->setObjectName(QStringLiteral("radiosityStatus"));
    m_status->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_status->setWordWrap(true);
    m_solve = makeTextButton(tr("Stop"), {});
    m_solve->setObjectName(QStringLiteral("radiositySolve"));
    connect(m_solve, &QPushButton::clicked, this, [this] {
        if (m_session.radiosity.solving() || m_session.radiosity.findingFactors())
            m_session.radiosity.stop();
        else
            m_session.radiosity.solve();
    });
    m_view = describe(new QComboBox, tr("What of the solution is shown"),
                      tr("Shows the picture, or what radiosity knows of its elements"));
    m_view->setObjectName(QStringLiteral("radiosityView"));
    m_view->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    for (const ViewKind kind : kRadiosityViews) {
        const ViewInfo& info = viewInfo(kind);
        m_view->addItem(QString::fromUtf8(info.label.data(), qsizetype(info.label.size())), kind);
        m_view->setItemData(m_view->count() - 1,
                            QString::fromUtf8(info.help.data(), qsizetype(info.help.size())),
                            Qt::ToolTipRole);
    }
    connect(m_view, &QComboBox::activated, this,
            [this](int row) { m_session.views.show(m_view->itemData(row).toInt()); });
    auto* header = new QWidget;
    auto* buttons = new QWidget;
    auto* flow = new FlowLayout(tokens::kGap, tokens::kGap / 2, buttons);
    flow->setContentsMargins(0, 0, 0, 0);
    flow->addWidget(m_light);
    flow->addWidget(m_solve);
    flow->addWidget(labelledField(tr("Show"), m_view));
    auto* rows = new QVBoxLayout(header);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(tokens::kGap / 2);
    rows->addWidget(buttons);
    rows->addWidget(m_status);
    return header;
}

QWidget* RadiosityPanel::makeSettings() {
    auto* column = new QWidget;
    column->setMinimumWidth(220);
    auto* rows = new QVBoxLayout(column);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(tokens::kGap / 2);
    int labels = 0;
    for (const char* id : kRadiosityParameters)
        labels = std::max(labels, fontMetrics().horizontalAdvance(QString::fromUtf8(
                                      findParameter(id)->label.data(),
                                      qsizetype(findParameter(id)->label.size()))));
    for (const char* id : kRadiosityParameters) {
        ParameterRow* row =
            makeParameterRow(*findParameter(id), {m_session.controller, m_session.thumbnails,
                                                  [] {
                                                      return std::optional(Target{Scope::View, 0});
                                                  },
                                                  labels + tokens::kMargin});
        connect(&m_session.controller, &DocumentController::changed, row, &ParameterRow::refresh);
        row->refresh();
        rows->addWidget(row);
        // What has no effect is disabled, as it would be were the scene lit by radiosity already.
        const auto enable = [this, row] {
            Document lit; // of which conditions read the view alone
            lit.view = m_session.controller.document().view;
            lit.view.lighting = LightingMode::Radiosity;
            row->setWorks(whyIdle(row->info(), lit, 0).empty());
        };
        connect(&m_session.controller, &DocumentController::changed, row, enable);
        enable();
        // What one method or solver has takes the place of what another one has.
        const std::string_view name(id);
        const auto* own = std::ranges::find(kMethodParameters, name, &MethodParameter::first);
        const bool ofLinks = name == "view.radiosityLinkError";
        if (own == kMethodParameters.end() && !ofLinks)
            continue;
        const auto show = [this, row, own, ofLinks] {
            const View& view = m_session.controller.document().view;
            const bool byLinks = view.radiositySolver == RadiositySolver::Hierarchical;
            row->setVisible(byLinks == ofLinks && (ofLinks || view.radiosityMethod == own->second));
        };
        connect(&m_session.controller, &DocumentController::changed, row, show);
        show();
    }
    rows->addStretch(1);
    return column;
}

// The settings beside the plot may be higher than the dock: the plot is what fits below the header.
void RadiosityPanel::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    const QMargins margins = m_scroll->contents()->contentsMargins();
    const int room = height() - margins.top() - margins.bottom() - m_scroll->contents()->spacing() -
                     m_header->sizeHint().height();
    m_plots->setMaximumHeight(std::max(m_plots->minimumSizeHint().height(), room));
}

QWidget* RadiosityPanel::makeSteps() {
    m_unit = describe(new QComboBox, tr("Step by"),
                      tr("What a step is: a shot of one element, or a sweep over all of them"));
    m_unit->setObjectName(QStringLiteral("radiosityStepUnit"));
    m_unit->addItem(tr("Shot"));
    m_unit->setItemData(0, tr("The element with the most unshot light sends it to all that see it"),
                        Qt::ToolTipRole);
    m_unit->addItem(tr("Sweep"));
    m_unit->setItemData(1,
                        tr("Every element gathers once: after n sweeps of Jacobi light has been "
                           "reflected n times; of Gauss-Seidel each takes the newest light"),
                        Qt::ToolTipRole);
    connect(m_unit, &QComboBox::activated, this, [this](int row) {
        play(false);
        m_session.radiosity.setStepUnit(row == 0 ? RadiosityStep::Shot : RadiosityStep::Sweep);
    });
    m_first = stepButton(tr("|◀"), QStringLiteral("First"), tr("Before the first step"));
    m_back = stepButton(tr("◀"), QStringLiteral("Back"), tr("Takes the last step back"));
    m_play = stepButton(tr("Play"), QStringLiteral("Play"), tr("Step after step"));
    m_play->setCheckable(true);
    m_next = stepButton(tr("▶"), QStringLiteral("Next"),
                        tr("The next step: a shot of the element or patch with the most unshot "
                           "light, or a sweep"));
    m_round = stepButton(tr("▶▶"), QStringLiteral("Round"),
                         tr("As many shots as there are elements, or patches"));
    m_end = stepButton(tr("Solved"), QStringLiteral("Solved"), tr("Back to the solution"));
    const auto done = [this] { return m_session.radiosity.stepGoal(); };
    connect(m_first, &QPushButton::clicked, this, [this] { goTo(0); });
    connect(m_back, &QPushButton::clicked, this,
            [this, done] { goTo(std::max<std::uint64_t>(done(), 1) - 1); });
    connect(m_next, &QPushButton::clicked, this, [this, done] { goTo(done() + 1); });
    connect(m_round, &QPushButton::clicked, this,
            [this, done] { goTo(done() + m_session.radiosity.live()->elements().senderCount()); });
    connect(m_play, &QPushButton::clicked, this, &RadiosityPanel::play);
    connect(m_end, &QPushButton::clicked, this, [this] {
        play(false);
        m_session.radiosity.endSteps();
    });
    m_slider = describe(new QSlider(Qt::Horizontal), tr("Steps"),
                        tr("Walks through the steps, from none to all, the first ones slowly"));
    m_slider->setObjectName(QStringLiteral("radiosityShots"));
    m_slider->setRange(0, kSliderSteps);
    connect(m_slider, &QSlider::valueChanged, this, [this](int position) {
        if (!m_refreshing && m_session.radiosity.canStep())
            goTo(stepsAt(position, mostSteps()));
    });
    m_stepText = new QLabel;
    m_stepText->setObjectName(QStringLiteral("radiosityStep"));
    m_stepText->setWordWrap(true);
    auto* column = new QWidget;
    column->setMinimumWidth(330);
    auto* rows = new QVBoxLayout(column);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(tokens::kGap / 2);
    auto* buttons = new QHBoxLayout;
    buttons->setSpacing(tokens::kGap / 2);
    for (QPushButton* button : {m_first, m_back, m_play, m_next, m_round, m_end})
        buttons->addWidget(button);
    buttons->addStretch(1);
    rows->addLayout(buttons);
    auto* walk = new QHBoxLayout;
    walk->setSpacing(tokens::kGap);
    walk->addWidget(labelledField(tr("Step by"), m_unit));
    walk->addWidget(m_slider, 1);
    rows->addLayout(walk);
    rows->addWidget(m_stepText);
    rows->addStretch(1);
    return column;
}

// A column of its own: below the steps it would be cut off where the dock opens.
QWidget* RadiosityPanel::makePlots() {
    m_plots = new RadiosityPlots(m_session.radiosity, m_session.controller);
    m_plots->setMinimumWidth(280);
    m_plots->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    return m_plots;
}

QWidget* RadiosityPanel::makeElement() {
    m_elementText = new QLabel;
    m_elementText->setObjectName(QStringLiteral("radiosityElement"));
    m_elementText->setWordWrap(true);
    m_elementText->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_flow = describe(new QTreeWidget, tr("Light of the chosen element"),
                      tr("What the chosen element receives, by where it comes from, and where what "
                         "it sends goes"));
    m_flow->setObjectName(QStringLiteral("radiosityFlow"));
    m_flow->setColumnCount(kFlowColumns);
    m_flow->setHeaderLabels({tr("Light"), tr("Share"), tr("W/m²")});
    m_flow->headerItem()->setToolTip(kFlowLight,
                                     tr("Red, green and blue, per area of the element"));
    m_flow->header()->setMinimumSectionSize(64);
    m_flow->setUniformRowHeights(true);
    m_flow->setMinimumHeight(110);
    m_flow->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Ignored); // it takes what is left
    m_flow->setIndentation(14);
    m_flow->header()->setStretchLastSection(false);
    m_flow->header()->setSectionResizeMode(kFlowName, QHeaderView::Stretch);
    m_flow->header()->setSectionResizeMode(kFlowShare, QHeaderView::ResizeToContents);
    m_flow->hideColumn(kFlowLight); // in the tool tips: names need the room
    connect(m_flow, &QTreeWidget::itemActivated, this, [this](const QTreeWidgetItem* item) {
        if (const QVariant element = item->data(kFlowName, kElementRole); element.isValid())
            m_session.radiosity.choose(element.toUInt());
    });
    auto* column = new QWidget;
    column->setMinimumWidth(250);
    column->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    auto* rows = new QVBoxLayout(column);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(tokens::kGap / 2);
    rows->addWidget(m_elementText);
    rows->addWidget(m_flow, 1);
    return column;
}

// --- What is shown -------------------------------------------------------------------------------

void RadiosityPanel::refresh() {
    const RadiosityUpdater& radiosity = m_session.radiosity;
    m_light->setChecked(m_session.controller.document().view.lighting == LightingMode::Radiosity);
    QString status = radiosityStatus(radiosity);
    // A forgotten environment is the commonest reason why a room is too bright.
    if (radiosity.live())
        status = tr("%1 · lit by %2")
                     .arg(status, QString::fromStdString(
                                      lightNamesText(lightNames(m_session.controller.document()))));
    m_status->setText(status);
    m_status->setToolTip(radiosity.live() ? radiosityHelp(*radiosity.live()) : QString());
    const bool solving = radiosity.solving() || radiosity.findingFactors();
    m_solve->setText(solving ? tr("Stop") : tr("Solve Again"));
    m_solve->setToolTip(solving ? tr("Keeps what is solved, and lets edits wait until it is "
                                     "solved again")
                                : tr("Divides surfaces and solves their light anew"));
    m_solve->setStatusTip(m_solve->toolTip());
    m_solve->setEnabled(radiosity.isWanted());
    refreshViews();
    refreshSteps();
    refreshElement();
    if (isVisible())
        m_plots->refresh();
}

void RadiosityPanel::refreshViews() {
    const int row = m_view->findData(m_session.views.shown());
    m_view->setCurrentIndex(row); // -1: another one
    m_view->setEnabled(m_session.radiosity.isWanted());
}

void RadiosityPanel::refreshSteps() {
    const RadiosityUpdater& radiosity = m_session.radiosity;
    const bool can = radiosity.canStep() && radiosity.isWanted();
    if (!can)
        play(false);
    const auto& step = radiosity.step();
    const bool shots = radiosity.stepUnit() == RadiosityStep::Shot;
    m_unit->setCurrentIndex(shots ? 0 : 1);
    for (QWidget* widget : {static_cast<QWidget*>(m_unit), static_cast<QWidget*>(m_first),
                            static_cast<QWidget*>(m_play), static_cast<QWidget*>(m_slider)})
        widget->setEnabled(can);
    for (QPushButton* forth : {m_next, m_round})
        forth->setEnabled(can && !(step && step->atEnd));
    m_round->setVisible(shots);
    m_back->setEnabled(can && step && step->done > 0);
    m_end->setEnabled(can && step);
    m_stepText->setText(stepStatus(m_session.controller.document(), radiosity));
    if (can && !m_slider->isSliderDown()) {
        m_refreshing = true;
        m_slider->setValue(step ? sliderOf(step->done, mostSteps()) : kSliderSteps);
        m_refreshing = false;
    }
}

void RadiosityPanel::refreshElement() {
    const RadiosityUpdater& radiosity = m_session.radiosity;
    if (!isVisible())
        return; // until it is
    const auto chosen = radiosity.chosen();
    // A list that somebody is clicking in is not made anew without a reason.
    const Listed listed{radiosity.live(), radiosity.step(), chosen, radiosity.isWanted(),
                        missingFactorsText(radiosity)};
    if (listed == m_listed)
        return;
    m_listed = listed;
    m_flow->clear();
    if (!chosen || !radiosity.live() || *chosen >= radiosity.live()->elements().size()) {
        m_elementText->setText(radiosity.live() && radiosity.isWanted()
                                   ? tr("Click a surface in the viewport: who lights it, and "
                                        "where its light goes.")
                                   : QString());
        return;
    }
    const Document& document = m_session.controller.document();
    const LiveRadiosity& live = *radiosity.live();
    const QString name = elementName(document, live, *chosen);
    m_elementText->setText(listed.missing.isEmpty() ? name
                                                    : name + QLatin1Char('\n') + listed.missing);
    const auto add = [&](const QString& title, const std::optional<glm::dvec3>& sum,
                         const std::vector<FlowShare>& shares) {
        auto* top = new QTreeWidgetItem(m_flow, {title, {}, sum ? fluxText(*sum) : QString()});
        for (int part = 0; sum && part < kFlowColumns; ++part)
            top->setToolTip(part, tr("%1: %2 W/m²").arg(title, fluxText(*sum)));
        for (const FlowShare& share : shares) {
            auto* item = new QTreeWidgetItem(
                top, {flowName(document, share), flowPercent(share.share), fluxText(share.light)});
            item->setTextAlignment(kFlowShare, Qt::AlignRight | Qt::AlignVCenter);
            QString help = tr("%1: %2 W/m²").arg(item->text(kFlowName), item->text(kFlowLight));
            if (share.kind == FlowShare::Kind::Element) {
                item->setData(kFlowName, kElementRole, share.element);
                help += tr("\nDouble-click: who lights that element?");
            }
            for (int part = 0; part < kFlowColumns; ++part)
                item->setToolTip(part, help);
        }
        top->setExpanded(true);
    };
    add(tr("Receives"), live.lit.irradiance(*radiosity.solution(), *chosen),
        arrivingLight(live, *radiosity.solution(), *chosen));
    if (isByLinks(live))
        addLinks(live, *chosen);
    add(tr("Brightest senders"), {},
        largestSenders(live, *radiosity.solution(), *chosen, kSenders));
    add(tr("Sends"), live.lit.radiosity(*radiosity.solution(), *chosen),
        leavingLight(live, *radiosity.solution(), *chosen));
}

void RadiosityPanel::addLinks(const LiveRadiosity& live, std::uint32_t element) {
    const ElementLinks found = linksOf(live, element);
    if (found.links.empty())
        return;
    const Document& document = m_session.controller.document();
    const auto clusters = std::ranges::count(found.links, radiosity::kNone, &ElementLink::element);
    auto* top = new QTreeWidgetItem(m_flow, {tr("%1 links, %2 to clusters")
                                                 .arg(found.links.size())
                                                 .arg(static_cast<qulonglong>(clusters))});
    const QString help =
        tr("What its light is gathered over, its own links and those of its clusters, as drawn in "
           "the viewport: yellow to clusters, blue to elements. Those of %1, whose bounced light "
           "counts most here. Their form factors add up to %2.")
            .arg(sourceTitle(document, live.sources[found.source]),
                 QLocale().toString(found.factorSum, 'f', 3));
    for (int part = 0; part < kFlowColumns; ++part)
        top->setToolTip(part, help);
    for (std::size_t i = 0; i < std::min(found.links.size(), kSenders); ++i) {
        const ElementLink& link = found.links[i];
        const bool isCluster = link.element == radiosity::kNone;
        auto* item =
            new QTreeWidgetItem(top, {isCluster ? tr("Cluster of %1 elements").arg(link.elements)
                                                : elementName(document, live, link.element),
                                      flowPercent(link.share)});
        item->setTextAlignment(kFlowShare, Qt::AlignRight | Qt::AlignVCenter);
        if (!isCluster)
            item->setData(kFlowName, kElementRole, link.element);
        for (int part = 0; part < kFlowColumns; ++part)
            item->setToolTip(part,
                             tr("Form factor %1, %2 W/m²; a link of %3 elements")
                                 .arg(QLocale().toString(link.factor, 'g', 3), fluxText(link.light))
                                 .arg(link.receivers));
    }
    top->setExpanded(true);
}

void RadiosityPanel::goTo(std::uint64_t steps) {
    m_session.radiosity.goTo(steps);
}

std::uint64_t RadiosityPanel::mostSteps() const {
    const RadiosityUpdater& radiosity = m_session.radiosity;
    return radiosity.stepUnit() == RadiosityStep::Shot
               ? 4 * radiosity.live()->elements().senderCount()
               : std::uint64_t{kConvergenceRounds};
}

void RadiosityPanel::play(bool on) {
    m_play->setChecked(on);
    m_playing.setInterval(m_session.radiosity.stepUnit() == RadiosityStep::Shot ? kShotMs
                                                                                : kSweepMs);
    if (on)
        m_playing.start();
    else
        m_playing.stop();
}

} // namespace patina::editor
