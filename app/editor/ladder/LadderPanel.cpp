#include "app/editor/ladder/LadderPanel.h"

#include "app/editor/Session.h"
#include "app/editor/document/QtText.h"
#include "app/editor/ladder/LadderModel.h"
#include "app/editor/ladder/LadderPicture.h"
#include "app/editor/panel/JobTexts.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ControlHelp.h"
#include "app/editor/widget/FlowLayout.h"
#include "app/editor/widget/LabelledField.h"
#include "app/editor/widget/StatusHint.h"
#include "app/editor/widget/TextButton.h"
#include "core/edit/Parameters.h"

#include <QAbstractButton>
#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QMetaObject>
#include <QPointer>
#include <QSettings>
#include <QSignalBlocker>
#include <QSplitter>
#include <QStackedWidget>
#include <QTableView>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

namespace patina::editor {
namespace {

constexpr const char* kLadderLive = "ladder/live";
constexpr int kLadderHeight = 216; // pixels of each picture
// At most 2.4 times as wide as high: what a flat viewport shows at its sides is hardly the
// material.
constexpr int kLadderNarrowest = 96, kLadderWidest = 520;
constexpr std::uint32_t kLadderPaths = 256; // per pixel, at most
constexpr double kLadderCertain = 0.01;     // Film::noise() that ends it
constexpr int kLadderProgressMs = 100;      // between looks at the running job
constexpr int kLadderRestMs = 700;          // since the last edit until it is made anew
constexpr QSize kLadderThumb(64, 36);
constexpr int kLadderRow = 42;
constexpr int kMethodsShare = 62, kPictureShare = 38;

int ladderWidth(const QSize& viewport) {
    const double aspect = static_cast<double>(viewport.width()) / std::max(viewport.height(), 1);
    return std::clamp(static_cast<int>(std::lround(kLadderHeight * aspect)), kLadderNarrowest,
                      kLadderWidest);
}

QLabel* ladderLabel(QRgb color) {
    auto* label = new QLabel;
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    QPalette palette = label->palette();
    palette.setColor(QPalette::WindowText, QColor(color));
    label->setPalette(palette);
    return label;
}

// What is not drawn or measured yet as it was the last time.
LadderShownPtr withEarlier(const LadderShown& now, const LadderShown* before) {
    auto both = std::make_shared<LadderShown>(now);
    for (std::size_t i = 0; before && i < both->steps.size() && i < before->steps.size(); ++i) {
        LadderStep& step = both->steps[i];
        const LadderStep& was = before->steps[i];
        if (step.picture.isNull())
            step.picture = was.picture;
        if (step.milliseconds == 0.0)
            step.milliseconds = was.milliseconds;
        if (!step.score && step.whyNot.empty() && was.whyNot.empty()) {
            step.score = was.score;
            step.exposure = was.exposure;
            step.visible = was.visible;
        }
    }
    return both;
}

} // namespace

LadderPanel::LadderPanel(Session& session, const QWidget& viewport, QWidget* parent)
    : QWidget(parent)
    , m_session(session)
    , m_viewport(viewport)
    , m_status(ladderLabel(tokens::kTextDim))
    , m_warning(ladderLabel(tokens::kCopper))
    , m_empty(new QLabel(tr("Draws the scene by every lighting mode, from a single light on to "
                            "baked transfer with bounces, and says how far each is from the "
                            "path-traced picture and what it costs.")))
    , m_pages(new QStackedWidget) {
    m_empty->setWordWrap(true);
    m_empty->setAlignment(Qt::AlignCenter);
    m_empty->setContentsMargins(tokens::kMargin, 0, tokens::kMargin, 0);
    m_pages->addWidget(m_empty);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(tokens::kGap, tokens::kGap / 2, tokens::kGap, tokens::kGap);
    layout->setSpacing(tokens::kGap / 2);
    layout->setSizeConstraint(QLayout::SetNoConstraint); // what is wide now can flow
    layout->addWidget(makeControls());
    layout->addWidget(m_status);
    layout->addWidget(m_warning);
    m_pages->addWidget(makeResult());
    layout->addWidget(m_pages, 1);

    m_progress.setInterval(kLadderProgressMs);
    m_rest.setInterval(kLadderRestMs);
    m_rest.setSingleShot(true);
    connect(&m_progress, &QTimer::timeout, this, &LadderPanel::showProgress);
    connect(&m_rest, &QTimer::timeout, this, [this] {
        if (m_live->isChecked() && isVisible() && m_stale) {
            cancel();
            start();
        }
    });
    connect(&session.jobs, &JobManager::jobsChanged, this, &LadderPanel::jobsChanged);
    connect(&session.controller, &DocumentController::changed, this, &LadderPanel::follow);
    take(nullptr);
}

// --- Making --------------------------------------------------------------------------------------

QWidget* LadderPanel::makeControls() {
    auto* controls = new QWidget;
    auto* flow = new FlowLayout(tokens::kMargin, tokens::kGap / 2, controls);
    flow->setContentsMargins(0, 0, 0, 0);
    m_start = makeTextButton(tr("Start"), {});
    m_start->setProperty("primary", true);
    m_start->setObjectName(QStringLiteral("ladderStart"));
    m_live = describe(new QCheckBox(tr("Live")), tr("Live"),
                      tr("Start again by itself a moment after each edit"));
    m_live->setChecked(QSettings().value(QLatin1String(kLadderLive), false).toBool());
    m_look = describe(new QComboBox, tr("Show"),
                      tr("What is shown of the methods: the pictures, or how far they are "
                         "from the path-traced one"));
    m_look->addItem(tr("Picture"), static_cast<int>(Look::Picture));
    m_look->addItem(tr("Too bright, too dark"), static_cast<int>(Look::Exposure));
    m_look->addItem(tr("Visible difference"), static_cast<int>(Look::Visible));
    m_other = describe(new QComboBox, tr("Compare with"),
                       tr("What the chosen method is compared with, on the right of the "
                          "line"));
    m_other->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    m_use = makeTextButton(tr("Use in Scene"),
                           tr("Light the scene by the chosen method, as one undo step; a bake that "
                              "it needs is attached (Enter)"));
    m_use->setObjectName(QStringLiteral("ladderUse"));
    m_useClosest = makeTextButton(tr("Use Closest"), tr("Light the scene by the method that is "
                                                        "closest to the path-traced picture"));
    m_useClosest->setObjectName(QStringLiteral("ladderUseClosest"));
    m_useClosest->setProperty("primary", true);
    for (QWidget* item :
         {static_cast<QWidget*>(m_start), static_cast<QWidget*>(m_live),
          labelledField(tr("Show"), m_look), labelledField(tr("Compare with"), m_other),
          static_cast<QWidget*>(m_use), static_cast<QWidget*>(m_useClosest)})
        flow->addWidget(item);
    connect(m_start, &QPushButton::clicked, this, [this] { isRunning() ? cancel() : start(); });
    connect(m_live, &QCheckBox::toggled, this, [this](bool on) {
        QSettings().setValue(QLatin1String(kLadderLive), on);
        if (on && !isRunning() && (m_stale || !m_shown))
            start();
    });
    connect(m_look, &QComboBox::currentIndexChanged, this, &LadderPanel::refreshPicture);
    connect(m_other, &QComboBox::currentIndexChanged, this, &LadderPanel::refreshPicture);
    connect(m_use, &QPushButton::clicked, this, &LadderPanel::useSelected);
    connect(m_useClosest, &QPushButton::clicked, this, &LadderPanel::useClosest);
    return controls;
}

QWidget* LadderPanel::makeResult() {
    m_model = new LadderModel(this);
    m_table = new QTableView;
    m_table->setObjectName(QStringLiteral("ladderMethods"));
    m_table->setAccessibleName(tr("Methods, the coarsest first"));
    m_table->setStatusTip(
        tr("Choose a method to look at it; double-click or Enter lights the scene "
           "by it"));
    m_table->setModel(m_model);
    m_table->setItemDelegate(new LadderDelegate(m_table));
    m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
    m_table->setSelectionMode(QAbstractItemView::SingleSelection);
    m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
    m_table->setTabKeyNavigation(false);
    m_table->setShowGrid(false);
    m_table->setWordWrap(false);
    m_table->setIconSize(kLadderThumb);
    m_table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    m_table->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
    m_table->verticalHeader()->hide();
    m_table->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    m_table->verticalHeader()->setDefaultSectionSize(kLadderRow);
    m_table->setCornerButtonEnabled(false);
    for (auto* corner : m_table->findChildren<QAbstractButton*>())
        corner->setAccessibleName(tr("All methods"));
    m_table->horizontalHeader()->setHighlightSections(false);
    m_table->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    m_table->horizontalHeader()->setStretchLastSection(true);
    m_picture = new LadderPicture;
    auto* splitter = new QSplitter(Qt::Horizontal);
    splitter->setChildrenCollapsible(false);
    splitter->addWidget(m_table);
    splitter->addWidget(m_picture);
    splitter->setStretchFactor(0, kMethodsShare);
    splitter->setStretchFactor(1, kPictureShare);
    splitter->setSizes({10 * kMethodsShare, 10 * kPictureShare}); // in proportion
    connect(m_table->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
            &LadderPanel::refreshPicture);
    connect(m_table, &QTableView::activated, this, &LadderPanel::useSelected);
    return splitter;
}

// --- Running -------------------------------------------------------------------------------------

void LadderPanel::start() {
    if (isRunning())
        return;
    m_rest.stop();
    auto order = std::make_shared<LadderOrder>();
    order->scene = sceneCopy(m_session);
    order->width = ladderWidth(m_viewport.size());
    order->height = kLadderHeight;
    order->truth.samples = kLadderPaths;
    order->truth.noise = kLadderCertain;
    order->kept = m_kept;
    m_ended.clear();
    // The job may outlive the window.
    const QPointer<LadderPanel> panel(this);
    const quint64 round = ++m_round;
    const auto tell = [panel, round](const LadderShownPtr& shown) {
        QMetaObject::invokeMethod(
            qApp,
            [panel, round, shown] {
                if (panel && panel->m_round == round)
                    panel->take(shown);
            },
            Qt::QueuedConnection);
    };
    m_job = m_session.jobs.start(
        tr("Lighting ladder"), false,
        [order = std::shared_ptr<const LadderOrder>(std::move(order)), lights = &m_session.lights,
         tell](const JobContext& job) -> JobOutcome {
            const Result<LadderShownPtr> made = runLadder(order, *lights, tell, job);
            if (!made)
                return {made.error(), {}, {}};
            return {std::nullopt,
                    tr("%1 methods against %2 paths per pixel")
                        .arg((*made)->steps.size() - 1)
                        .arg((*made)->samples),
                    [tell, shown = *made] { tell(shown); }};
        });
    m_progress.start();
    refresh();
    jobsChanged(); // it may have ended
}

// At once, for the user; the job notices within 0.2 s.
void LadderPanel::cancel() {
    if (!isRunning())
        return;
    m_session.jobs.cancel(std::exchange(m_job, 0));
    ++m_round; // what it still tells is of no interest
    m_ended = tr("Cancelled.");
    ended();
}

void LadderPanel::jobsChanged() {
    if (!isRunning())
        return;
    const std::optional<JobRecord> job = m_session.jobs.job(m_job);
    if (job && !job->ended())
        return;
    if (job && job->state == JobState::Failed)
        m_ended = job->summary;
    else if (job && job->state == JobState::Cancelled) // in the Jobs dock
        m_ended = tr("Cancelled.");
    ended();
}

void LadderPanel::ended() {
    m_job = 0;
    m_progress.stop();
    refresh();
}

void LadderPanel::showProgress() {
    if (const std::optional<JobRecord> job = m_session.jobs.job(m_job)) {
        m_status->setText(stateText(*job));
        m_status->show();
    }
}

void LadderPanel::take(const LadderShownPtr& shown) {
    const bool first = !m_shown && shown;
    m_shown = shown ? withEarlier(*shown, m_shown.get()) : nullptr;
    if (shown && shown->kept)
        m_kept = shown->kept;
    m_model->setShown(shown, kLadderThumb, devicePixelRatioF());
    fillOthers();
    if (first && m_model->rowCount() > 0)
        select(2); // as the viewport lights a scene that has no bake
    m_stale = false;
    checkState();
    refresh();
}

void LadderPanel::follow(const Change& change) {
    if (change.isAnotherDocument()) {
        cancel();
        m_ended.clear();
        m_kept = nullptr;
        take(nullptr);
        return;
    }
    if (!isVisible() || !m_shown)
        return;
    checkState();
    refreshClosest(); // how the scene is lit may have changed
    if (m_stale && m_live->isChecked())
        m_rest.start();
}

// --- What is looked at ---------------------------------------------------------------------------

const LadderStep* LadderPanel::selected() const {
    const int row = m_table->currentIndex().row();
    return m_shown && row >= 0 && static_cast<std::size_t>(row) < m_shown->steps.size()
               ? &m_shown->steps[static_cast<std::size_t>(row)]
               : nullptr;
}

void LadderPanel::select(std::size_t step) {
    m_table->selectRow(static_cast<int>(step));
    refreshPicture();
}

void LadderPanel::fillOthers() {
    const QSignalBlocker quiet(m_other);
    const int count = m_shown ? static_cast<int>(m_shown->steps.size()) : 0;
    if (m_other->count() != count) {
        m_other->clear();
        for (int i = 0; i < count; ++i)
            m_other->addItem(toQString(m_shown->steps[static_cast<std::size_t>(i)].label));
        m_other->setCurrentIndex(count - 1); // the path-traced picture
    }
    m_other->setEnabled(count > 0);
}

void LadderPanel::refreshPicture() {
    const LadderStep* step = selected();
    m_use->setEnabled(step && step->whyNot.empty());
    if (!step) {
        m_picture->setSides({}, {});
        return;
    }
    const auto look = static_cast<Look>(m_look->currentData().toInt());
    const auto side = [&](const LadderStep& of) {
        LadderPicture::Side shown;
        shown.name = toQString(of.label);
        const bool traced = of.name == "path";
        shown.picture = look == Look::Picture    ? of.picture
                        : look == Look::Exposure ? of.exposure
                                                 : of.visible;
        if (!of.whyNot.empty())
            shown.note = toQString(of.whyNot);
        else if (look != Look::Picture && traced)
            shown.note = tr("What the others are compared with");
        else if (shown.picture.isNull())
            shown.note = !isRunning()          ? tr("Not measured")
                         : needsLadderBake(of) ? tr("Is baked when the picture is traced")
                                               : tr("One moment…");
        if (of.score && look != Look::Picture)
            shown.name += QStringLiteral("   FLIP ") + flipText(of.score->flip);
        return shown;
    };
    const int other = m_other->currentIndex();
    m_picture->setSides(side(*step), other >= 0
                                         ? side(m_shown->steps[static_cast<std::size_t>(other)])
                                         : LadderPicture::Side{});
}

void LadderPanel::useSelected() {
    const LadderStep* step = selected();
    if (!step || !step->whyNot.empty())
        return;
    if (step->name == "path") {
        Q_EMIT pathTracingWanted();
        return;
    }
    use(*step);
    showHint(*this, tr("The scene is lit by: %1").arg(toQString(step->label)));
}

void LadderPanel::useClosest() {
    const LadderShownPtr shown = m_shown;
    if (!shown)
        return;
    const auto before = stepInUse(shown->steps, m_session.controller.document());
    const auto closest = closestStep(shown->steps, m_session.controller.document());
    if (!before || !closest)
        return;
    const LadderStep& step = shown->steps[*closest];
    select(*closest);
    use(step);
    showHint(*this, tr("The scene is lit by: %1. Visible difference (FLIP) %2 before, %3 now")
                        .arg(toQString(step.label), flipText(shown->steps[*before].score->flip),
                             flipText(step.score->flip)));
}

void LadderPanel::use(const LadderStep& step) {
    // Attaching a bake is no undo step, the way it lights is.
    const Document& document = m_session.controller.document();
    if (step.bake && std::ranges::find(document.bakes, step.bake) == document.bakes.end())
        m_session.controller.attachBake(step.bake);
    m_session.controller.setParameter(*findParameter("view.lighting"), {Scope::View, 0},
                                      static_cast<int>(step.lighting));
}

// What lowers the error most, as a button that says by how much. Not where the noise of the traced
// picture could be the cause, nor while what was measured is of another state.
void LadderPanel::refreshClosest() {
    m_useClosest->hide();
    if (!m_shown || !m_shown->isDone() || m_stale || isRunning())
        return;
    const auto now = stepInUse(m_shown->steps, m_session.controller.document());
    const auto closest = closestStep(m_shown->steps, m_session.controller.document());
    if (!now || !closest)
        return;
    const ErrorScore& before = *m_shown->steps[*now].score;
    const LadderStep& step = m_shown->steps[*closest];
    if (before.flip - step.score->flip <= std::max(before.flipNoise, step.score->flipNoise))
        return;
    m_useClosest->setText(
        tr("%1: FLIP %2 %")
            .arg(toQString(step.label),
                 QLocale().toString(100.0 * (step.score->flip / before.flip - 1.0), 'f', 0)));
    m_useClosest->setAccessibleName(m_useClosest->text());
    m_useClosest->setToolTip(
        tr("Light the scene by the method that is closest to the path-traced picture: visible "
           "difference (FLIP) %1, now %2")
            .arg(flipText(step.score->flip), flipText(before.flip)));
    m_useClosest->setStatusTip(m_useClosest->toolTip());
    m_useClosest->show();
}

// --- What is said --------------------------------------------------------------------------------

void LadderPanel::checkState() {
    const bool stale = m_shown && !stillHolds(*m_shown->order, m_session.controller.document());
    if (stale == m_stale)
        return;
    m_stale = stale;
    refresh();
}

void LadderPanel::refresh() {
    m_pages->setCurrentIndex(m_shown ? 1 : 0);
    m_start->setText(isRunning() ? tr("Cancel") : tr("Start"));
    m_start->setAccessibleName(m_start->text());
    m_start->setToolTip(isRunning() ? tr("Leave it as it is now")
                                    : tr("Draw the scene by every method and trace it by paths"));
    m_start->setStatusTip(m_start->toolTip());
    if (!isRunning())
        m_status->setText(m_shown && m_shown->samples > 0
                              ? tr("Against %1 paths per pixel, ± %2 %")
                                    .arg(m_shown->samples)
                                    .arg(100.0 * m_shown->noise, 0, 'f', 1)
                              : QString());
    m_status->setVisible(!m_status->text().isEmpty());
    QStringList warnings;
    if (!m_ended.isEmpty())
        warnings << m_ended;
    if (m_stale && !(m_live->isChecked() && isRunning()))
        warnings << tr("The scene or the view has changed since.");
    if (m_shown && m_shown->limit)
        warnings << toQString(*m_shown->limit);
    m_warning->setText(warnings.join(QLatin1Char(' ')));
    m_warning->setVisible(!warnings.isEmpty());
    refreshPicture();
    refreshClosest();
}

QString LadderPanel::status() const {
    return m_status->text();
}

void LadderPanel::showEvent(QShowEvent* event) {
    checkState();
    QWidget::showEvent(event);
}

} // namespace patina::editor
