#include "app/editor/panel/BakePanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/panel/JobTexts.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/PanelScroll.h"
#include "app/editor/widget/Section.h"
#include "core/material/Parameters.h"

#include <QButtonGroup>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLabel>
#include <QLocale>
#include <QProgressBar>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr int kPollMs = 33;

QComboBox* makeChoice(std::initializer_list<int> values, int current, const QString& suffix,
                      const QString& name, const QString& help) {
    auto* box = new QComboBox;
    for (const int value : values)
        box->addItem(QLocale().toString(value) + suffix, value);
    box->setCurrentIndex(box->findData(current));
    box->setAccessibleName(name);
    box->setToolTip(help);
    box->setStatusTip(help);
    return box;
}

// Secondary facts, wrapped.
QLabel* makeHint(const QString& text = {}) {
    auto* label = new QLabel(text);
    label->setObjectName(QStringLiteral("dim"));
    label->setWordWrap(true);
    return label;
}

QPushButton* makeButton(const QString& text, const QString& help) {
    auto* button = new QPushButton(text);
    button->setToolTip(help);
    button->setStatusTip(help);
    button->setAccessibleName(text);
    return button;
}

void clear(QLayout* layout) {
    while (QLayoutItem* item = layout->takeAt(0)) {
        if (QWidget* widget = item->widget()) {
            widget->hide(); // at once; deleting waits for the event loop
            widget->deleteLater();
        }
        delete item;
    }
}

} // namespace

BakePanel::BakePanel(DocumentController& controller, JobManager& jobs, QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_jobs(jobs)
    , m_runner(controller, jobs) {
    setObjectName(QStringLiteral("bakePanel"));
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    auto* scroll = new PanelScroll;
    outer->addWidget(scroll);
    QVBoxLayout* layout = scroll->contents();

    auto* newBake = new Section(tr("New bake"));
    layout->addWidget(newBake);
    newBake->add(makeSettings());
    m_start = makeButton(tr("Start bake"),
                         tr("Computes in the background; you can go on editing meanwhile"));
    m_start->setObjectName(QStringLiteral("bakeStart"));
    m_start->setProperty("primary", true);
    m_progress = makeProgress();
    newBake->add(m_start);
    newBake->add(m_progress);

    auto* attached = new Section(tr("Attached bakes"));
    layout->addWidget(attached);
    auto* attachedRows = new QWidget;
    m_attached = new QVBoxLayout(attachedRows);
    m_attached->setContentsMargins(0, 0, 0, 0);
    attached->add(attachedRows);

    auto* lightingSection = new Section(tr("Lighting"));
    layout->addWidget(lightingSection);
    auto* lightingRow = new QWidget;
    lightingSection->add(lightingRow);
    auto* lighting = new QHBoxLayout(lightingRow);
    lighting->setContentsMargins(0, 0, 0, 0);
    lighting->setSpacing(1); // two halves of one switch
    auto* group = new QButtonGroup(this);
    m_ibl = makeButton(tr("IBL"), tr("Light from the environment without shadows (live)"));
    m_prt =
        makeButton(tr("PRT"), tr("Soft self-shadows from the baked transfer; needs a PRT bake"));
    m_ibl->setObjectName(QStringLiteral("lightingIbl"));
    m_prt->setObjectName(QStringLiteral("lightingPrt"));
    for (QPushButton* button : {m_ibl, m_prt}) {
        button->setCheckable(true);
        group->addButton(button);
        lighting->addWidget(button);
    }
    layout->addStretch(1);

    const auto setLighting = [this](LightingMode mode) {
        m_controller.setParameter(*findParameter("view.lighting"), Target{Scope::View, 0},
                                  static_cast<int>(mode));
        refreshLighting();
    };
    connect(m_ibl, &QPushButton::clicked, this, [setLighting] { setLighting(LightingMode::Ibl); });
    connect(m_prt, &QPushButton::clicked, this, [setLighting] { setLighting(LightingMode::Prt); });
    connect(m_start, &QPushButton::clicked, this, &BakePanel::start);
    connect(&m_runner, &BakeRunner::stateChanged, this, &BakePanel::refreshState);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (touches(change.affects, Affects::Bakes | Affects::Geometry | Affects::Structure))
            refreshState();
        refreshLighting();
    });
    m_poll.setInterval(kPollMs);
    connect(&m_poll, &QTimer::timeout, this, &BakePanel::refreshProgress);
    refreshSettings();
    refreshState();
    refreshLighting();
}

QWidget* BakePanel::makeSettings() {
    auto* widget = new QWidget;
    m_form = new QFormLayout(widget);
    m_form->setContentsMargins(0, 0, 0, 0);
    m_form->setHorizontalSpacing(tokens::kMargin);
    m_form->setVerticalSpacing(tokens::kGap);
    m_form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    m_kind = new QComboBox;
    for (const BakeKind kind :
         {BakeKind::PrtVertex, BakeKind::PrtTexel, BakeKind::AoTexel, BakeKind::AoVertex})
        m_kind->addItem(bakeTitle(kind), static_cast<int>(kind));
    m_kind->setObjectName(QStringLiteral("bakeKind"));
    m_kind->setAccessibleName(tr("What to bake"));
    m_kind->setToolTip(tr("What to compute and attach to the scene"));
    m_kind->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    m_form->addRow(tr("Bake"), m_kind);
    m_samples = makeChoice({32, 64, 128, 256, 512, 1024, 2048, 4096}, 256, {}, tr("Rays"),
                           tr("Rays per vertex or texel: more is smoother and slower"));
    m_samples->setObjectName(QStringLiteral("bakeSamples"));
    m_form->addRow(tr("Rays"), m_samples);
    m_order = makeChoice({1, 2, 3, 4, 5}, 3, {}, tr("Bands"),
                         tr("Spherical-harmonic bands: 3 gives soft, 5 sharper shadows"));
    m_form->addRow(tr("Bands"), m_order);
    m_size = makeChoice({256, 512, 1024, 2048, 4096}, 1024, tr(" px"), tr("Texture size"),
                        tr("Side of the square texture that each material gets"));
    m_form->addRow(tr("Size"), m_size);
    m_distance = new QDoubleSpinBox;
    m_distance->setRange(0.0, 1e6);
    m_distance->setDecimals(3);
    m_distance->setSingleStep(0.1);
    m_distance->setSuffix(tr(" m"));
    m_distance->setSpecialValueText(tr("Unlimited"));
    m_distance->setAccessibleName(tr("Distance"));
    m_distance->setToolTip(tr("Surfaces farther away than this do not occlude"));
    m_form->addRow(tr("Distance"), m_distance);
    m_estimate = makeHint();
    m_form->addRow(m_estimate);
    for (QComboBox* box : {m_kind, m_samples, m_order, m_size})
        connect(box, &QComboBox::currentIndexChanged, this, &BakePanel::refreshSettings);
    return widget;
}

QWidget* BakePanel::makeProgress() {
    auto* widget = new QWidget;
    auto* layout = new QVBoxLayout(widget);
    layout->setContentsMargins(0, 0, 0, 0);
    m_bar = new QProgressBar;
    m_bar->setRange(0, 1000);
    m_bar->setAccessibleName(tr("Bake progress"));
    m_bar->setTextVisible(false); // the words stand below
    m_progressText = makeHint();
    m_stop = makeButton(tr("Stop"), tr("Ends now and keeps what has converged"));
    m_cancel = makeButton(tr("Cancel"), tr("Ends now and keeps nothing"));
    m_stop->setObjectName(QStringLiteral("bakeStop"));
    m_cancel->setObjectName(QStringLiteral("bakeCancel"));
    auto* buttons = new QHBoxLayout;
    buttons->addWidget(m_stop);
    buttons->addWidget(m_cancel);
    layout->addWidget(m_bar);
    layout->addWidget(m_progressText);
    layout->addLayout(buttons);
    connect(m_stop, &QPushButton::clicked, &m_runner, &BakeRunner::stop);
    connect(m_cancel, &QPushButton::clicked, &m_runner, &BakeRunner::cancel);
    return widget;
}

BakeRequest BakePanel::request() const {
    BakeRequest request;
    request.kind = static_cast<BakeKind>(m_kind->currentData().toInt());
    request.ao.samples = request.prt.samples = m_samples->currentData().toInt();
    request.ao.maxDistance = static_cast<float>(m_distance->value());
    request.ao.size = request.prt.size = m_size->currentData().toInt();
    request.prt.order = m_order->currentData().toInt();
    return request;
}

void BakePanel::start() {
    m_runner.start(request());
}

QString BakePanel::estimate() const {
    const BakeRequest wanted = request();
    const QLocale locale;
    if (isPerTexel(wanted.kind))
        return tr("One texture of %1 × %1 for each material").arg(wanted.ao.size);
    double vertices = 0;
    for (const MeshInstance& mesh : m_controller.document().meshes)
        if (mesh.visible && mesh.mesh)
            vertices += static_cast<double>(mesh.mesh->vertexCount());
    const double rays = vertices * wanted.prt.samples;
    return tr("%1 vertices × %2 rays = %3 million rays")
        .arg(locale.toString(vertices, 'f', 0), locale.toString(wanted.prt.samples),
             locale.toString(rays * 1e-6, 'f', rays < 1e7 ? 1 : 0));
}

void BakePanel::refreshSettings() {
    const BakeKind kind = request().kind;
    const auto show = [this](QWidget* field, bool visible) {
        field->setVisible(visible);
        m_form->labelForField(field)->setVisible(visible);
    };
    show(m_order, holdsTransfer(kind));
    show(m_size, isPerTexel(kind));
    show(m_distance, !holdsTransfer(kind));
    m_estimate->setText(estimate());
}

void BakePanel::refreshState() {
    const bool running = m_runner.running();
    m_start->setVisible(!running);
    m_progress->setVisible(running);
    m_start->setEnabled(m_controller.document().triangleCount() > 0);
    if (running)
        m_poll.start();
    else
        m_poll.stop();
    m_estimate->setText(estimate());
    refreshProgress();
    refreshAttached();
    refreshLighting();
}

void BakePanel::refreshProgress() {
    const std::optional<JobRecord> job = m_jobs.job(m_runner.jobId());
    if (!job)
        return;
    m_bar->setValue(static_cast<int>(job->progress.fraction * 1000.0));
    m_progressText->setText(progressText(*job));
}

void BakePanel::refreshAttached() {
    clear(m_attached);
    const Document& document = m_controller.document();
    if (document.bakes.empty()) {
        m_attached->addWidget(
            makeHint(tr("None yet. A bake stays with the scene and is saved with it.")));
        return;
    }
    for (const BakeArtifactPtr& bake : document.bakes) {
        const bool stale = isStale(*bake, m_runner.currentInputs());
        auto* row = new QWidget;
        auto* layout = new QHBoxLayout(row);
        layout->setContentsMargins(0, 2, 0, 2);
        QString status = stale ? tr("Stale: the geometry has changed")
                               : tr("Up to date, %1 rays").arg(bake->samplesDone);
        // What the user should know of this bake, such as overlapping texture coordinates.
        if (const auto note = bake->settings.find("note"); note != bake->settings.end())
            status += QStringLiteral("<br>") + QString::fromStdString(note->second).toHtmlEscaped();
        auto* text =
            new QLabel(QStringLiteral("%1<br><span style='color:%2'>%3</span>")
                           .arg(bakeTitle(bake->kind).toHtmlEscaped(),
                                QColor(stale ? tokens::kCopper : tokens::kTextDim).name(), status));
        text->setWordWrap(true);
        text->setObjectName(QStringLiteral("bakeStatus"));
        layout->addWidget(text, 1);
        if (stale) {
            QPushButton* again =
                makeButton(tr("Re-bake"), tr("Bakes again with the settings above"));
            connect(again, &QPushButton::clicked, this, [this, kind = bake->kind] {
                m_kind->setCurrentIndex(m_kind->findData(static_cast<int>(kind)));
                start();
            });
            again->setEnabled(!m_runner.running());
            layout->addWidget(again);
        }
        QPushButton* remove = makeButton(tr("Remove"), tr("Detaches this bake from the scene"));
        connect(remove, &QPushButton::clicked, this,
                [this, kind = bake->kind] { m_controller.detachBake(kind); });
        layout->addWidget(remove);
        m_attached->addWidget(row);
    }
}

void BakePanel::refreshLighting() {
    const Document& document = m_controller.document();
    const bool hasPrt =
        (m_runner.running() && m_jobs.preview()) ||
        std::any_of(document.bakes.begin(), document.bakes.end(),
                    [](const auto& bake) { return bake->kind == BakeKind::PrtVertex; });
    m_prt->setEnabled(hasPrt);
    m_prt->setChecked(document.view.lighting == LightingMode::Prt);
    m_ibl->setChecked(document.view.lighting == LightingMode::Ibl);
}

} // namespace patina::editor
