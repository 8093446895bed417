#include "app/editor/panel/TransferPanel.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/job/NearShadowUpdater.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/viewport/LobeOnSurface.h"
#include "app/editor/viewport/PixelProbe.h"
#include "app/editor/widget/BandBars.h"
#include "app/editor/widget/PictureTile.h"
#include "app/editor/widget/PlotStyle.h"
#include "app/editor/widget/TextButton.h"
#include "app/editor/widget/TileArea.h"
#include "core/edit/Edit.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>

namespace patina::editor {
namespace {

QString numbers(const glm::vec3& v) {
    return QStringLiteral("%1  %2  %3").arg(plotNumber(v.x), plotNumber(v.y), plotNumber(v.z));
}

} // namespace

TransferPanel::TransferPanel(DocumentController& controller, PixelProbe& probe,
                             LobeOnSurface& onSurface, const NearShadowUpdater& shadows,
                             QWidget* parent)
    : QWidget(parent)
    , m_controller(controller)
    , m_probe(probe)
    , m_onSurface(onSurface)
    , m_shadows(shadows)
    , m_memory(std::make_shared<TransferPicturesMemory>())
    , m_job(controller.runner(), "transfer inspector") {
    setObjectName(QStringLiteral("transferPanel"));
    m_message = new QLabel;
    m_message->setWordWrap(true);
    m_message->setAlignment(Qt::AlignCenter);
    m_message->setMargin(tokens::kMargin);
    m_message->setObjectName(QStringLiteral("transferMessage"));

    m_bake =
        makeTextButton(tr("Bake now"), tr("Bakes radiance transfer with the Bake dock's settings"));
    m_bake->setObjectName(QStringLiteral("transferBake"));
    connect(m_bake, &QPushButton::clicked, this, &TransferPanel::bakeWanted);
    auto* empty = new QWidget;
    auto* words = new QVBoxLayout(empty);
    words->addStretch(1);
    words->addWidget(m_message);
    words->addWidget(m_bake, 0, Qt::AlignHCenter);
    words->addStretch(1);

    m_numbers = new QLabel;
    m_numbers->setWordWrap(true);
    m_numbers->setTextInteractionFlags(Qt::TextSelectableByMouse);
    m_numbers->setObjectName(QStringLiteral("transferNumbers"));
    m_lightBands = new QComboBox;
    m_lightBands->setObjectName(QStringLiteral("transferLightBands"));
    m_lightBands->setAccessibleName(tr("Bands of the environment"));
    m_lightBands->setToolTip(tr("In how many bands the environment is shown"));
    m_lightBands->setStatusTip(m_lightBands->toolTip());
    for (int bands = 1; bands <= kMaxShOrder; ++bands)
        m_lightBands->addItem(bands == 1 ? tr("1 band") : tr("%1 bands").arg(bands), bands);
    m_lightBands->setCurrentIndex(2);
    auto* header = new QHBoxLayout;
    header->addWidget(m_numbers, 1);
    header->addWidget(m_lightBands, 0, Qt::AlignTop);

    m_bars = new BandBars;
    const PlotAxis radiance{tr("radiance"), tr(" cd/m²")};
    m_function = new PictureTile(tr("Transfer of every direction"), {tr("transfer"), {}});
    m_seen = new PictureTile(tr("Environment"), radiance);
    m_sum = new PictureTile({}, radiance);
    auto* tiles = new TileArea({168, 124});
    const QList<QWidget*> all = {m_bars, m_function, m_seen, m_sum};
    for (QWidget* tile : all)
        tiles->add(tile);
    tiles->setShown(all);

    auto* shown = new QWidget;
    auto* layout = new QVBoxLayout(shown);
    layout->setContentsMargins(tokens::kGap, tokens::kGap, tokens::kGap, tokens::kGap);
    layout->setSpacing(tokens::kGap);
    layout->addLayout(header);
    layout->addWidget(tiles, 1);
    m_pages = new QStackedWidget;
    m_pages->addWidget(empty);
    m_pages->addWidget(shown);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(m_pages);

    connect(m_bars, &BandBars::bandsChanged, this, &TransferPanel::refresh);
    connect(m_lightBands, &QComboBox::currentIndexChanged, this, &TransferPanel::refresh);
    connect(&m_probe, &PixelProbe::hoverChanged, this, &TransferPanel::refresh);
    connect(&m_probe, &PixelProbe::pinChanged, this, &TransferPanel::refresh);
    connect(&m_controller, &DocumentController::changed, this, &TransferPanel::refresh);
    connect(&m_shadows, &NearShadowUpdater::shownChanged, this, &TransferPanel::refresh);
}

TransferPanel::~TransferPanel() {
    if (isVisible())
        m_probe.removeListener();
    m_onSurface.setOther(nullptr);
}

QString TransferPanel::message() const {
    return m_message->text();
}

void TransferPanel::showEvent(QShowEvent* event) {
    m_probe.addListener();
    refresh();
    QWidget::showEvent(event);
}

void TransferPanel::hideEvent(QHideEvent* event) {
    m_probe.removeListener();
    m_requested.reset();
    m_job.cancel();
    m_onSurface.setOther(nullptr);
    QWidget::hideEvent(event);
}

std::optional<TransferPicturesRequest> TransferPanel::request(QString& problem) const {
    TransferPicturesRequest request;
    TransferRequest& study = request.study = transferRequest(m_controller.document());
    if (!study.bake) {
        problem = tr("There is no radiance transfer yet.");
        return std::nullopt;
    }
    const std::optional<render::Inspection>& at = m_probe.shown();
    if (!at || !at->onSurface()) {
        problem = tr("Point at the model to see how light comes to it. P or Ctrl + Shift + click "
                     "pins a point.");
        return std::nullopt;
    }
    if (!study.environment.image) {
        problem = tr("The environment has no picture.");
        return std::nullopt;
    }
    study.shadows = m_shadows.shown();
    study.mesh = at->mesh;
    study.position = glm::vec3(at->value(shading::kRecordPosition));
    study.traced = m_probe.pin().has_value();
    study.bands = m_bars->bands();
    request.lightBands = m_lightBands->currentData().toInt();
    return request;
}

void TransferPanel::refresh() {
    if (!isVisible())
        return;
    QString problem;
    const std::optional<TransferPicturesRequest> wanted = request(problem);
    // Each frame says anew what lies under the pointer.
    if (wanted && wanted == m_requested)
        return;
    m_requested = wanted;
    if (!wanted) {
        m_job.cancel();
        show(nullptr, problem);
        return;
    }
    m_job.request([this, wanted = *wanted, document = m_controller.document(),
                   luminance = m_probe.shown()->luminance,
                   memory = m_memory](const JobContext& job) -> LatestJob::Apply {
        Result<TransferPictures> drawn = drawTransfer(document, wanted, luminance, *memory, job);
        if (!drawn && drawn.error().kind == ErrorKind::Cancelled)
            return {};
        if (!drawn)
            return [this] {
                show(nullptr, tr("The bake has no values for this mesh; bake it again."));
            };
        return [this, pictures = std::make_shared<const TransferPictures>(*std::move(drawn))] {
            show(pictures, {});
        };
    });
}

void TransferPanel::show(std::shared_ptr<const TransferPictures> pictures, const QString& problem) {
    m_shown = std::move(pictures);
    m_message->setText(problem);
    m_bake->setVisible(!hasTransfer(m_controller.document()));
    m_pages->setCurrentIndex(m_shown ? 1 : 0);
    m_onSurface.setOther(m_shown ? m_shown->lobe : nullptr);
    if (!m_shown)
        return;
    const TransferPictures& p = *m_shown;
    const TransferStudy& s = p.study;
    QStringList shares;
    for (const glm::vec3& band : s.byBand)
        shares << plotNumber(shading::luminance(band), 2);
    std::vector<float> coefficients;
    for (std::size_t i = 0; i < s.transfer.direct.size(); ++i)
        coefficients.push_back(s.transfer.meanCoefficient(i));
    m_bars->setCoefficients(std::move(coefficients), shares);
    const glm::vec3 whole = s.all();
    const bool negative = std::min({whole.x, whole.y, whole.z}) < 0.0f;
    m_numbers->setText(
        tr("Light of a white surface: %1%2   ·   sky visibility %3 %   ·   %4")
            .arg(numbers(whole), negative ? tr(" (below zero: shown as dark)") : QString(),
                 plotNumber(100.0 * double{s.visibility}),
                 s.transfer.bounced.empty() ? tr("direct light") : tr("with bounces")) +
        (s.tracedLights == 0
             ? QString()
             : tr("   ·   %1 of it directly from local lights, by rays instead of bands")
                   .arg(numbers(s.local))));
    const auto transferAt = [transfer = s.transfer, bands = m_bars->bands()](const glm::vec3& d) {
        return std::vector{double{transfer.towards(d, bands)}};
    };
    const auto lightOf = [lab = p.lab](LabView view) {
        return [lab, view](const glm::vec3& d) {
            const glm::vec3 v = lab.value(view, d).value_or(glm::vec3(0.0f));
            return std::vector{double{v.x}, double{v.y}, double{v.z}};
        };
    };
    m_function->setPicture(
        p.function,
        s.function.negativeShare > 0.0
            ? tr("rings below zero (magenta) on %1 % of the sphere, to %2")
                  .arg(plotNumber(100.0 * s.function.negativeShare), plotNumber(s.function.lowest))
            : tr("nowhere below zero"),
        transferAt);
    m_seen->setPicture(p.seen,
                       p.rays > 0 ? tr("dark: hidden from the point, by %1 rays").arg(p.rays)
                                  : tr("darkened by the transfer; pin the point to trace rays"),
                       lightOf({LabKind::Environment, 0}));
    m_sum->setTitle(tr("Environment in %1").arg(m_lightBands->currentText()));
    m_sum->setAccessibleName(m_sum->title());
    m_sum->setPicture(p.sum,
                      p.lightLowest < 0.0f
                          ? tr("lowest %1, below zero magenta").arg(plotNumber(p.lightLowest))
                          : tr("nowhere below zero"),
                      lightOf({LabKind::Harmonics, m_lightBands->currentData().toInt()}));
}

} // namespace patina::editor
