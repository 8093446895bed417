#include "app/editor/sweep/LightSweepPanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/panel/JobTexts.h"
#include "app/editor/style/Icons.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/sweep/SweepControls.h"
#include "app/editor/sweep/SweepModel.h"
#include "app/editor/sweep/SweepPicture.h"
#include "app/editor/sweep/SweepSave.h"
#include "app/editor/sweep/SweepStrip.h"
#include "app/editor/sweep/SweepTexts.h"
#include "app/editor/sweep/UseLight.h"
#include "app/editor/widget/ColorScale.h"
#include "app/editor/widget/ElidedLabel.h"
#include "app/editor/widget/StatusHint.h"
#include "app/editor/widget/TextButton.h"

#include <QAbstractButton>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QListWidget>
#include <QPointer>
#include <QSortFilterProxyModel>
#include <QSplitter>
#include <QStackedWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kSweptHeight = 128; // pixels of a swept picture
// At most 2.5 times as wide as high: what a flat viewport shows at its sides is hardly the
// material.
constexpr int kNarrowest = 64, kWidest = 320; // of it
constexpr int kSweepProgressMs = 100;         // between looks at the running job
constexpr int kSweepRow = 24;                 // of the table
constexpr int kProblemsHeight = 3 * 24;       // at most
constexpr int kTableShare = 55, kPicturesShare = 45;
constexpr int kScaleWidth = 150; // of the colours of sensitivity

int pictureWidth(const QSize& viewport) {
    const double aspect = static_cast<double>(viewport.width()) / std::max(viewport.height(), 1);
    return std::clamp(static_cast<int>(std::lround(kSweptHeight * aspect)), kNarrowest, kWidest);
}

QLabel* wrappedLabel() {
    auto* label = new QLabel;
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    return label;
}

void setSweepColor(QLabel& label, QRgb color) {
    QPalette colors = label.palette();
    colors.setColor(QPalette::WindowText, QColor(color));
    label.setPalette(colors);
}

} // namespace

LightSweepPanel::LightSweepPanel(DocumentController& controller, JobManager& jobs,
                                 const QWidget& viewport, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_jobs(jobs)
    , m_viewport(viewport)
    , m_controls(new SweepControls(controller))
    , m_status(new ElidedLabel)
    , m_warning(wrappedLabel())
    , m_empty(wrappedLabel())
    , m_again(makeTextButton(tr("Run Again"), tr("Sweep the scene as it is now")))
    , m_pages(new QStackedWidget) {
    setObjectName(QStringLiteral("lightSweepPanel"));
    setSweepColor(*m_status, tokens::kTextDim);
    setSweepColor(*m_warning, tokens::kCopper);
    m_status->setObjectName(QStringLiteral("sweepStatus"));
    m_warning->setObjectName(QStringLiteral("sweepWarning"));
    m_empty->setText(tr("Lights the scene by each environment in all its rotations and ranks them: "
                        "in which light the material clips, goes flat or looks unlike itself. "
                        "Diffuse light is looked at, with its shadows, through the camera."));
    m_empty->setAlignment(Qt::AlignCenter);
    m_empty->setMargin(tokens::kMargin);
    m_use = makeTextButton(tr("Use in Scene"),
                           tr("Light the scene with the chosen environment at its rotation, as one "
                              "undo step (Enter)"));
    m_use->setObjectName(QStringLiteral("sweepUse"));
    connect(m_use, &QPushButton::clicked, this, &LightSweepPanel::useSelected);
    m_controls->add(m_use);
    m_save = makeTextButton(tr("Save…"),
                            tr("Save the ranking as JSON, as “patina rank” does, or the rotations "
                               "of the chosen environment as a picture"));
    m_save->setObjectName(QStringLiteral("sweepSave"));
    connect(m_save, &QPushButton::clicked, this, &LightSweepPanel::saveOutcome);
    m_controls->add(m_save);
    m_pages->addWidget(m_empty);
    m_pages->addWidget(makeResult());

    auto* texts = new QHBoxLayout;
    auto* lines = new QVBoxLayout;
    lines->setSpacing(0);
    lines->addWidget(m_status);
    lines->addWidget(m_warning);
    texts->addLayout(lines, 1);
    texts->addWidget(m_again, 0, Qt::AlignTop);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(tokens::kGap, tokens::kGap / 2, tokens::kGap, tokens::kGap);
    layout->setSpacing(tokens::kGap / 2);
    layout->setSizeConstraint(QLayout::SetNoConstraint); // what is wide now can flow
    layout->addWidget(m_controls);
    layout->addLayout(texts);
    layout->addWidget(m_pages, 1);

    m_progress.setInterval(kSweepProgressMs);
    connect(&m_progress, &QTimer::timeout, this, &LightSweepPanel::showProgress);
    connect(m_controls, &SweepControls::startWanted, this, &LightSweepPanel::start);
    connect(m_controls, &SweepControls::cancelWanted, this, &LightSweepPanel::cancel);
    connect(m_controls, &SweepControls::byChanged, this, &LightSweepPanel::rank);
    connect(m_again, &QPushButton::clicked, this, &LightSweepPanel::start);
    connect(&jobs, &JobManager::jobsChanged, this, &LightSweepPanel::jobsChanged);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.isAnotherDocument()) { // in which ids mean others
            cancel();
            m_ended.clear();
            take(nullptr);
        } else if (isVisible()) {
            checkState();
        }
    });
    take(nullptr);
}

// --- Making --------------------------------------------------------------------------------------

QWidget* LightSweepPanel::makeResult() {
    auto* splitter = new QSplitter(Qt::Horizontal);
    splitter->setChildrenCollapsible(false);
    splitter->addWidget(makeLights());
    splitter->addWidget(makePictures());
    splitter->setStretchFactor(0, kTableShare);
    splitter->setStretchFactor(1, kPicturesShare);
    splitter->setSizes({100 * kTableShare, 100 * kPicturesShare}); // in proportion
    return splitter;
}

QWidget* LightSweepPanel::makeLights() {
    m_model = new SweepModel(this);
    m_sorted = new QSortFilterProxyModel(this);
    m_sorted->setSourceModel(m_model);
    m_sorted->setSortRole(SweepModel::SortRole);
    m_table = new QTableView;
    m_table->setObjectName(QStringLiteral("sweepLights"));
    m_table->setAccessibleName(tr("Lights, the worst first"));
    m_table->setStatusTip(tr("Choose a light to look at it; double-click or Enter uses it in the "
                             "scene"));
    m_table->setModel(m_sorted);
    m_table->setSortingEnabled(true);
    m_table->sortByColumn(SweepModel::Rank, Qt::AscendingOrder);
    m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_table->setSelectionMode(QAbstractItemView::SingleSelection);
    m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_table->setTabKeyNavigation(false);
    m_table->setAlternatingRowColors(true);
    m_table->setShowGrid(false);
    m_table->setWordWrap(false);
    m_table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    m_table->verticalHeader()->hide();
    m_table->setCornerButtonEnabled(false); // of both headers: there is one
    for (auto* corner : m_table->findChildren<QAbstractButton*>())
        corner->setAccessibleName(tr("All lights"));
    m_table->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    m_table->verticalHeader()->setDefaultSectionSize(kSweepRow);
    m_table->horizontalHeader()->setHighlightSections(false);
    m_table->horizontalHeader()->setStretchLastSection(true);
    m_problems = new QListWidget;
    m_problems->setObjectName(QStringLiteral("sweepProblems"));
    m_problems->setAccessibleName(tr("Environments that cannot be read"));
    m_problems->setStatusTip(tr("Environments that were left out, and why"));
    m_problems->setMaximumHeight(kProblemsHeight);
    m_problems->setWordWrap(true);
    m_problems->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* lights = new QWidget;
    auto* column = new QVBoxLayout(lights);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(tokens::kGap / 2);
    column->addWidget(m_table, 1);
    column->addWidget(m_problems);

    connect(m_table->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            [this](const QModelIndex& current) {
                if (!m_refreshing && current.isValid())
                    select(m_model->lightOf(m_sorted->mapToSource(current).row()));
            });
    // By a double-click or Enter.
    connect(m_table, &QTableView::activated, this, &LightSweepPanel::useSelected);
    return lights;
}

QWidget* LightSweepPanel::makePictures() {
    m_light = new SweepPicture(
        tr("The light that is chosen; the ring is where it differs most from the look compared "
           "with"));
    m_reference = new SweepPicture(tr("The look that contrast and difference are measured from"));
    m_sensitivity = new SweepPicture(
        tr("How far the lights drive each pixel apart: the standard deviation over all of them, in "
           "stops"));
    m_scale = new ColorScale(ColorMap::Sequential, false);
    m_scale->setAccessibleName(tr("Range of sensitivity"));
    m_scale->setFixedWidth(kScaleWidth);
    connect(m_scale, &ColorScale::dragged, this, &LightSweepPanel::showSensitivity);
    connect(m_scale, &ColorScale::resetRequested, this, &LightSweepPanel::refreshPictures);
    auto* pictures = new QHBoxLayout;
    pictures->setSpacing(tokens::kGap);
    pictures->addWidget(m_light, 1);
    pictures->addWidget(m_reference, 1);
    pictures->addWidget(m_sensitivity, 1);
    m_stripTitle = new ElidedLabel;
    setSweepColor(*m_stripTitle, tokens::kTextDim);
    m_range = new QLabel;
    setSweepColor(*m_range, tokens::kTextDim);
    auto* heading = new QHBoxLayout;
    heading->addWidget(m_stripTitle, 1);
    // Under the map that they are of.
    heading->addWidget(m_range);
    heading->addWidget(m_scale);
    m_strip = new SweepStrip(m_controller.runner());
    m_strip->setObjectName(QStringLiteral("sweepStrip"));
    connect(m_strip, &SweepStrip::chosen, this, &LightSweepPanel::select);
    connect(m_strip, &SweepStrip::picturesChanged, this, &LightSweepPanel::refreshPictures);
    connect(m_strip, &QListWidget::activated, this, &LightSweepPanel::useSelected);
    auto* side = new QWidget;
    auto* column = new QVBoxLayout(side);
    column->setContentsMargins(tokens::kGap / 2, 0, 0, 0); // the splitter's handle
    column->setSpacing(tokens::kGap / 2);
    column->addLayout(pictures, 1);
    column->addLayout(heading);
    column->addWidget(m_strip);
    return side;
}

// --- Sweeping ------------------------------------------------------------------------------------

void LightSweepPanel::start() {
    if (m_job != 0)
        return;
    auto order = std::make_shared<SweepOrder>();
    m_controls->fill(*order);
    order->document = m_controller.document();
    order->width = pictureWidth(m_viewport.size());
    order->height = kSweptHeight;
    m_ended.clear();
    // The job may outlive the window.
    const QPointer<LightSweepPanel> panel(this);
    m_job = m_jobs.start(tr("Light sweep"), false,
                         [panel, order = std::shared_ptr<const SweepOrder>(std::move(order)),
                          worker = &m_controller.worker()](const JobContext& job) -> JobOutcome {
                             const Result<SweepOutcomePtr> swept = runSweep(order, *worker, job);
                             if (!swept)
                                 return {swept.error(), {}, {}};
                             return {std::nullopt, countText(**swept), [panel, outcome = *swept] {
                                         if (panel)
                                             panel->take(outcome);
                                     }};
                         });
    m_progress.start();
    m_controls->setRunning(true);
    showProgress();
    jobsChanged(); // it may have ended
}

// At once, for the user; the job notices within 0.2 s.
void LightSweepPanel::cancel() {
    if (m_job == 0)
        return;
    m_jobs.cancel(std::exchange(m_job, 0));
    ended();
    m_ended = cancelledText();
    refresh();
}

QString LightSweepPanel::cancelledText() const {
    return m_outcome ? tr("Cancelled; the result before it stays.") : tr("Cancelled.");
}

void LightSweepPanel::jobsChanged() {
    if (m_job == 0)
        return;
    const std::optional<JobRecord> job = m_jobs.job(m_job);
    if (job && !job->ended())
        return;
    ended();
    if (job && job->state == JobState::Failed)
        m_ended = job->summary;
    else if (job && job->state == JobState::Cancelled) // in the Jobs dock
        m_ended = cancelledText();
    refresh();
}

void LightSweepPanel::ended() {
    m_job = 0;
    m_progress.stop();
    m_controls->setRunning(false);
}

void LightSweepPanel::showProgress() {
    const std::optional<JobRecord> job = m_jobs.job(m_job);
    if (!job)
        return;
    m_status->setText(stateText(*job));
    m_status->show();
}

void LightSweepPanel::take(const SweepOutcomePtr& outcome) {
    m_outcome = outcome;
    m_selected.reset();
    m_strip->show(nullptr, 0);
    m_problems->clear();
    if (outcome)
        for (const SweepProblem& problem : outcome->problems) {
            auto* item = new QListWidgetItem(icon(QStringLiteral("warning"), tokens::kCopper),
                                             problemText(problem), m_problems);
            item->setToolTip(item->text());
        }
    m_problems->setVisible(m_problems->count() > 0);
    rank();
    if (outcome) {
        m_table->resizeColumnsToContents();
        m_table->scrollToTop();
    }
    checkState();
    refresh();
}

void LightSweepPanel::rank() {
    const std::optional<std::size_t> selected = m_selected;
    m_refreshing = true;
    m_model->setOutcome(m_outcome, m_controls->by());
    m_refreshing = false;
    if (m_outcome)
        select(selected.value_or(m_model->lightOf(0)));
    else
        refreshPictures();
}

// --- What is looked at ---------------------------------------------------------------------------

void LightSweepPanel::select(std::size_t light) {
    m_selected = light;
    m_refreshing = true;
    const QModelIndex row = m_sorted->mapFromSource(m_model->index(m_model->rowOf(light), 0));
    m_table->selectionModel()->setCurrentIndex(row, QItemSelectionModel::ClearAndSelect |
                                                        QItemSelectionModel::Rows);
    m_table->scrollTo(row);
    m_refreshing = false;
    m_strip->show(m_outcome, light);
    refreshPictures();
}

void LightSweepPanel::refreshPictures() {
    m_use->setEnabled(m_selected.has_value());
    m_save->setEnabled(m_selected.has_value());
    if (!m_outcome || !m_selected)
        return;
    const SweepOutcome& outcome = *m_outcome;
    const LightScore& score = outcome.sweep.scores[*m_selected];
    const QRect seen = surfacesRect(outcome.pixels);
    m_light->setPicture(lightText(outcome, score.light), m_strip->picture(*m_selected),
                        QPoint(score.worstPixel.x, score.worstPixel.y) - seen.topLeft());
    m_reference->setPicture(
        referenceText(outcome),
        displayedImage(outcome.sweep.reference, outcome.settings.view).copy(seen));
    m_stripTitle->setText(toQString(outcome.environments[score.light.environment].title));
    m_stripTitle->setToolTip(m_stripTitle->text());
    const double most = largestSensitivity(outcome.sweep.sensitivity);
    showSensitivity(0.0, most > 0.0 ? most : 1.0);
}

void LightSweepPanel::showSensitivity(double from, double to) {
    if (!m_outcome)
        return;
    m_scale->setRange(from, to);
    m_range->setText(sensitivityText(m_outcome->sweep.sensitivity));
    m_sensitivity->setPicture(
        tr("Sensitivity"),
        sensitivityImage(m_outcome->pixels, m_outcome->sweep.sensitivity, from, to)
            .copy(surfacesRect(m_outcome->pixels)));
}

void LightSweepPanel::saveOutcome() {
    if (m_outcome && m_selected)
        askAndSaveSweep({m_outcome, m_controls->by(),
                         m_outcome->sweep.scores[*m_selected].light.environment, QString()},
                        m_controller, m_jobs, *window());
}

void LightSweepPanel::useSelected() {
    if (!m_outcome || !m_selected)
        return;
    const SweepLight& light = m_outcome->sweep.scores[*m_selected].light;
    const SweptEnvironment& environment = m_outcome->environments[light.environment];
    if (!useLight(m_controller, environment, light.rotationDeg))
        showHint(*this, tr("%1 is no longer among the scene's environments; run the sweep again")
                            .arg(toQString(environment.title)));
}

// --- What is said --------------------------------------------------------------------------------

void LightSweepPanel::checkState() {
    const bool stale = m_outcome && !stillHolds(*m_outcome, m_controller.document());
    if (stale == m_stale)
        return;
    m_stale = stale;
    refresh();
}

void LightSweepPanel::refresh() {
    m_pages->setCurrentIndex(m_outcome ? 1 : 0);
    if (m_job == 0)
        m_status->setText(m_outcome ? summaryText(*m_outcome) : QString());
    m_status->setToolTip(m_status->text());
    QStringList warnings;
    if (!m_ended.isEmpty())
        warnings << m_ended;
    if (m_stale)
        warnings << tr("The scene or the view has changed since this sweep.");
    if (m_outcome)
        warnings << warningTexts(*m_outcome);
    m_warning->setText(warnings.join(QLatin1Char(' ')));
    m_status->setVisible(!m_status->text().isEmpty());
    m_warning->setVisible(!warnings.isEmpty());
    m_again->setVisible(m_stale && m_job == 0);
}

QString LightSweepPanel::status() const {
    return m_status->text();
}

QString LightSweepPanel::warning() const {
    return m_warning->text();
}

void LightSweepPanel::showEvent(QShowEvent* event) {
    checkState();
    QWidget::showEvent(event);
}

} // namespace patina::editor
