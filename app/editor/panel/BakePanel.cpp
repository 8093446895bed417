#include "app/editor/panel/BakePanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/job/LivePreview.h"
#include "app/editor/panel/AttachedBakes.h"
#include "app/editor/panel/BakeSettingsForm.h"
#include "app/editor/panel/JobRow.h"
#include "app/editor/panel/JobTexts.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/EditControl.h"
#include "app/editor/widget/PanelScroll.h"
#include "app/editor/widget/Section.h"
#include "app/editor/widget/TextButton.h"
#include "core/bake/Bake.h"
#include "core/bake/BakeMemory.h"
#include "core/bake/document/BakeStaleness.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/base/ProcessMemory.h"
#include "core/document/AbsentBake.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"

#include <QColor>
#include <QDateTime>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QVBoxLayout>
#include <algorithm>
#include <chrono>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kPollMs = 100;

// Secondary facts, wrapped.
QLabel* makeHint(const QString& text = {}) {
    auto* label = new QLabel(text);
    label->setObjectName(QStringLiteral("dim"));
    label->setWordWrap(true);
    return label;
}

QVBoxLayout* addRows(Section* section) {
    auto* rows = new QWidget;
    auto* layout = new QVBoxLayout(rows);
    layout->setContentsMargins(0, 0, 0, 0);
    section->add(rows);
    return layout;
}

// "1,234", "12.6 million"
QString largeNumber(double number) {
    const QLocale locale;
    if (number < 1e6)
        return locale.toString(number, 'f', 0);
    return BakePanel::tr("%1 million")
        .arg(locale.toString(number * 1e-6, 'f', number < 1e7 ? 1 : 0));
}

// "14:03", and with the day unless it is today's.
QString timeText(std::filesystem::file_time_type when) {
    const auto system = std::chrono::file_clock::to_sys(when);
    const auto seconds = std::chrono::floor<std::chrono::seconds>(system).time_since_epoch();
    const QDateTime time = QDateTime::fromSecsSinceEpoch(seconds.count());
    return QLocale().toString(time, time.date() == QDate::currentDate()
                                        ? QStringLiteral("HH:mm")
                                        : QStringLiteral("d MMM HH:mm"));
}

int raysOf(const BakeRequest& request) {
    return samplesOf(normalized(request));
}

} // namespace

BakePanel::BakePanel(DocumentController& controller, BakeService& bakes, JobManager& jobs,
                     QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_bakes(bakes)
    , m_jobs(jobs) {
    setObjectName(QStringLiteral("bakePanel"));
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    auto* scroll = new PanelScroll;
    outer->addWidget(scroll);
    QVBoxLayout* layout = scroll->contents();

    auto* newBake = new Section(tr("New bake"));
    layout->addWidget(newBake);
    m_form = new BakeSettingsForm;
    newBake->add(m_form);
    m_cost = makeHint();
    m_cost->setAccessibleName(tr("Cost of the bake"));
    newBake->add(m_cost);
    m_start = makeTextButton(tr("Start bake"),
                             tr("Computes in the background; you can go on editing meanwhile"));
    m_start->setObjectName(QStringLiteral("bakeStart"));
    m_start->setProperty("primary", true);
    newBake->add(m_start);
    m_queue = addRows(newBake);
    m_interrupted = addRows(newBake);

    auto* attached = new Section(tr("Attached bakes"));
    layout->addWidget(attached);
    m_attached = new AttachedBakes(
        controller, m_bakes, [this](BakeKind kind) { return m_form->requestFor(kind); },
        [this](const BakeRequest& request) { resume(request); });
    attached->add(m_attached);

    auto* lighting = new Section(tr("Lighting"));
    layout->addWidget(lighting);
    lighting->add(makeLighting());
    layout->addStretch(1);

    connect(m_form, &BakeSettingsForm::changed, this, [this] {
        refreshCost();
        m_attached->refresh();
    });
    connect(m_start, &QPushButton::clicked, this, [this] { m_bakes.start(m_form->request()); });
    connect(&m_bakes, &BakeService::stateChanged, this, &BakePanel::refreshState);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.isAnotherDocument())
            takeSettings();
        else if (touches(change.affects, Affects::Bakes))
            followBakes();
        refreshLighting();
    });
    m_poll.setInterval(kPollMs);
    connect(&m_poll, &QTimer::timeout, this, &BakePanel::pollQueue);
    refreshState();
}

void BakePanel::bakeTransfer(bool bounces) {
    BakeRequest request = m_form->requestFor(BakeKind::PrtVertex);
    if (bounces)
        request.prt.transfer = TransferKind::Interreflected;
    m_form->setRequest(request);
    m_bakes.start(request);
}

QWidget* BakePanel::makeLighting() {
    auto* row = new QWidget;
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(1); // parts of one switch
    m_ibl = makeTextButton(tr("IBL"), tr("Light from the environment without shadows (live)"));
    m_prt = makeTextButton(tr("PRT"),
                           tr("Soft self-shadows from the baked transfer; needs a PRT bake"));
    m_ibl->setObjectName(QStringLiteral("lightingIbl"));
    m_prt->setObjectName(QStringLiteral("lightingPrt"));
    m_lightMap = makeTextButton(
        tr("Light map"), tr("Image-based light, corrected where a baked light map knows better: "
                            "shadows, bounces and reflections as they are traced"));
    m_lightMap->setObjectName(QStringLiteral("lightingLightMap"));
    m_radiosity = makeTextButton(tr("Radiosity"),
                                 tr("Light that goes from surface to surface, solved by elements"));
    m_radiosity->setObjectName(QStringLiteral("lightingRadiosity"));
    // None is pressed under a mode that has no button here.
    for (QPushButton* button : {m_ibl, m_prt, m_lightMap, m_radiosity}) {
        button->setCheckable(true);
        layout->addWidget(button);
    }
    const auto setLighting = [this](LightingMode mode) {
        m_controller.setParameter(*findParameter("view.lighting"), Target{Scope::View, 0},
                                  static_cast<int>(mode));
        refreshLighting();
    };
    connect(m_ibl, &QPushButton::clicked, this, [setLighting] { setLighting(LightingMode::Ibl); });
    connect(m_prt, &QPushButton::clicked, this, [setLighting] { setLighting(LightingMode::Prt); });
    connect(m_lightMap, &QPushButton::clicked, this,
            [setLighting] { setLighting(LightingMode::LightMap); });
    connect(m_radiosity, &QPushButton::clicked, this,
            [setLighting] { setLighting(LightingMode::Radiosity); });
    return row;
}

void BakePanel::takeSettings() {
    m_followed.clear();
    for (const BakeArtifactPtr& bake : m_controller.document().bakes) {
        m_followed[bake->kind] = bake;
        if (!isAbsent(*bake))
            m_form->setRequest(requestOf(*bake));
    }
}

void BakePanel::followBakes() {
    for (const BakeArtifactPtr& bake : m_controller.document().bakes)
        if (std::exchange(m_followed[bake->kind], bake) != bake && !isAbsent(*bake))
            m_form->follow(requestOf(*bake));
}

void BakePanel::resume(const BakeRequest& request) {
    m_form->setRequest(request);
    m_form->showKind(request.kind);
    m_bakes.start(request);
}

void BakePanel::refreshCost() {
    const BakeRequest request = m_form->request();
    const BakeInputs inputs = bakeInputs(m_controller.document());
    const BakeEstimate cost = estimateBake(request, inputs);
    const std::uint64_t available = availableMemory();
    const Result<void> fits = checkBake(request, inputs);
    const auto duration = [&](const BakeRequest& asked) {
        return roughDurationText(m_bakes.expectedSeconds(asked, inputs));
    };
    m_form->describePresets(duration);
    m_start->setEnabled(m_controller.document().triangleCount() > 0 && fits.ok());
    if (!fits) {
        m_cost->setText(QStringLiteral("<span style='color:%1'>%2</span>")
                            .arg(QColor(tokens::kCopper).name(),
                                 QString::fromStdString(fits.error().message).toHtmlEscaped()));
        return;
    }
    QString text =
        isPerTexel(request.kind) ? tr("At most %1 texels, %2 rays") : tr("%1 vertices, %2 rays");
    text = text.arg(largeNumber(static_cast<double>(cost.elements)),
                    largeNumber(static_cast<double>(cost.rays)));
    text += QStringLiteral("; ") + duration(request);
    text += tr(" and %1 of memory").arg(QString::fromStdString(memoryText(cost.bytes)));
    if (available > 0)
        text += tr(", %1 are free").arg(QString::fromStdString(memoryText(available)));
    // No number is parted from its unit.
    text.replace(QLatin1String(" MiB"), QStringLiteral("\u00a0MiB"));
    text.replace(QLatin1String(" GiB"), QStringLiteral("\u00a0GiB"));
    m_cost->setText(text);
}

void BakePanel::refreshState() {
    m_start->setText(m_bakes.running() ? tr("Add to the queue") : tr("Start bake"));
    if (m_bakes.running())
        m_poll.start();
    else
        m_poll.stop();
    refreshCost();
    refreshQueue();
    refreshInterrupted();
    m_attached->refresh();
    refreshLighting();
}

void BakePanel::refreshQueue() {
    const std::vector<quint64> ids = m_bakes.jobIds();
    std::erase_if(m_rows, [&](const auto& row) {
        if (std::ranges::find(ids, row.first) != ids.end())
            return false;
        retire(row.second);
        return true;
    });
    for (const quint64 id : ids) {
        const std::optional<JobRecord> job = m_jobs.job(id);
        if (!job)
            continue;
        JobRow*& row = m_rows[id];
        if (row == nullptr) {
            row = new JobRow(m_jobs, *job, QStringLiteral("bake"));
            m_queue->addWidget(row);
        } else {
            row->show(*job);
        }
    }
}

void BakePanel::pollQueue() {
    for (const auto& [id, row] : m_rows)
        if (const std::optional<JobRecord> job = m_jobs.job(id))
            row->show(*job);
}

void BakePanel::refreshInterrupted() {
    retireAll(*m_interrupted);
    if (m_bakes.running())
        return; // the checkpoint may be the one that is being written
    for (const InterruptedBake& bake : m_bakes.interrupted()) {
        if (m_attached->offers(bake.request))
            continue;
        auto* row = new QWidget;
        auto* layout = new QVBoxLayout(row);
        layout->setContentsMargins(0, tokens::kGap / 2, 0, 0);
        layout->setSpacing(tokens::kGap / 2);
        auto* text = new QLabel(QStringLiteral("%1<br><span style='color:%2'>%3</span>")
                                    .arg(bakeTitle(bake.request.kind).toHtmlEscaped(),
                                         QColor(tokens::kCopper).name(),
                                         tr("Unfinished, from %1: %2 % of its %3 rays")
                                             .arg(timeText(bake.written))
                                             .arg(static_cast<int>(100.0 * bake.done))
                                             .arg(QLocale().toString(raysOf(bake.request)))));
        text->setWordWrap(true);
        text->setObjectName(QStringLiteral("bakeUnfinished"));
        layout->addWidget(text);
        auto* buttons = new QHBoxLayout;
        buttons->addStretch(1);
        QPushButton* goOn = makeTextButton(tr("Resume"), tr("Goes on from its last checkpoint"));
        goOn->setObjectName(QStringLiteral("bakeResume"));
        QPushButton* discard = makeTextButton(tr("Discard"), tr("Deletes the saved progress"));
        discard->setObjectName(QStringLiteral("bakeDiscard"));
        connect(goOn, &QPushButton::clicked, this,
                [this, request = bake.request] { resume(request); });
        connect(discard, &QPushButton::clicked, this, [this, bake] { m_bakes.discard(bake); });
        buttons->addWidget(goOn);
        buttons->addWidget(discard);
        layout->addLayout(buttons);
        m_interrupted->addWidget(row);
    }
}

void BakePanel::refreshLighting() {
    const Document& document = m_controller.document();
    const bool arrives =
        m_bakes.running() && m_bakes.preview() && m_bakes.preview()->kind() != BakeKind::LightMap;
    const bool hasPrt = arrives || hasTransfer(document);
    m_prt->setEnabled(hasPrt);
    m_lightMap->setEnabled(findBake(document, BakeKind::LightMap) != nullptr);
    m_lightMap->setChecked(document.view.lighting == LightingMode::LightMap);
    m_radiosity->setEnabled(whyUnavailable(*findParameter("view.lighting"), document,
                                           static_cast<int>(LightingMode::Radiosity))
                                .empty());
    m_radiosity->setChecked(document.view.lighting == LightingMode::Radiosity);
    m_prt->setChecked(document.view.lighting == LightingMode::Prt);
    m_ibl->setChecked(document.view.lighting == LightingMode::Ibl);
}

} // namespace patina::editor
