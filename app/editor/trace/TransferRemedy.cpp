#include "app/editor/trace/TransferRemedy.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/job/BakeService.h"
#include "app/editor/trace/PathBlame.h"
#include "app/editor/trace/PathError.h"
#include "app/editor/widget/StatusHint.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"

#include <QLocale>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr int kRemedyOrder = 5; // as `patina ladder` bakes
// Of the squared error: where what the bake reduces makes less, it is not offered.
constexpr double kWorthwhile = 0.1;

QSize sizeOf(const PathError::Measured& measured) {
    return {measured.drawn->width(), measured.drawn->height()};
}

} // namespace

TransferRemedy::TransferRemedy(PathError& error, PathBlame& blame, DocumentController& controller,
                               BakeService& bakes, QWidget* parent)
    : QPushButton(parent)
    , m_error(error)
    , m_blame(blame)
    , m_controller(controller)
    , m_bakes(bakes) {
    setObjectName(QStringLiteral("transferRemedy"));
    setFocusPolicy(Qt::TabFocus);
    connect(this, &QPushButton::clicked, this, &TransferRemedy::apply);
    connect(&bakes, &BakeService::stateChanged, this, &TransferRemedy::refresh);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (change.isAnotherDocument()) {
            m_waits = false;
            m_before.reset();
        }
        if (change.affects != Affects::Nothing)
            refresh();
    });
    connect(&error, &PathError::changed, this, [this] {
        tellSuccess();
        refresh();
    });
    connect(&blame, &PathBlame::changed, this, &TransferRemedy::refresh);
    refresh();
}

bool TransferRemedy::isDone() const {
    const Document& document = m_controller.document();
    return document.view.lighting == LightingMode::Prt && hasTransfer(document);
}

std::optional<double> TransferRemedy::reducedShare() const {
    const auto& found = m_blame.found();
    if (!found || !found->blame.whole.isKnown)
        return std::nullopt;
    double sum = 0.0;
    for (const BlameCauseInfo& info : blameCauses())
        if (info.remedy == BlameRemedy::BakeTransfer)
            sum += found->blame.whole.of(info.cause).share;
    return std::clamp(sum, 0.0, 1.0);
}

bool TransferRemedy::isComparable(const Before& before) const {
    Document then = before.scene, now = m_controller.document();
    // What the remedy itself changes.
    then.view.lighting = now.view.lighting;
    then.bakes.clear();
    now.bakes.clear();
    return before.size == sizeOf(*m_error.measured()) && then == now;
}

void TransferRemedy::refresh() {
    const bool has = hasTransfer(m_controller.document());
    if (m_waits && has)
        light();
    else if (m_waits && !m_bakes.running())
        m_waits = false; // it was cancelled, or could not be made
    const std::optional<double> share = reducedShare();
    setVisible(m_error.isOn() && !isDone() && (!share || *share >= kWorthwhile));
    setEnabled(has || !m_bakes.running());
    setText(has                 ? tr("Light with Transfer")
            : m_bakes.running() ? tr("Baking…")
                                : tr("Bake Transfer"));
    setAccessibleName(text());
    QString help = has ? tr("Light with the baked transfer: with the shadows of the environment "
                            "and the bounces that the bake holds")
                       : tr("Bake radiance transfer per vertex and light with it: it knows what "
                            "the scene hides of the environment and what it reflects onto itself");
    if (share)
        help += tr(". What it reduces makes %1 % of the squared error; by how much is known once "
                   "it has been tried")
                    .arg(QLocale().toString(100.0 * *share, 'f', 0));
    setToolTip(help);
    setStatusTip(toolTip());
}

void TransferRemedy::apply() {
    if (const auto& measured = m_error.measured())
        m_before = Before{measured->error.whole.flip, sizeOf(*measured), m_controller.document()};
    if (hasTransfer(m_controller.document())) {
        light();
        return;
    }
    BakeRequest request;
    request.kind = BakeKind::PrtVertex;
    request.prt.order = kRemedyOrder;
    request.prt.transfer = TransferKind::Interreflected;
    m_waits = true;
    m_bakes.start(request);
    refresh();
}

void TransferRemedy::light() {
    m_waits = false;
    m_replaced = m_error.measured();
    m_controller.setParameter(*findParameter("view.lighting"), {Scope::View, 0},
                              static_cast<int>(LightingMode::Prt));
}

void TransferRemedy::tellSuccess() {
    const auto& measured = m_error.measured();
    if (!m_before || !m_error.isOn() || !measured)
        return;
    if (!isDone() || m_waits) // what a running bake previews is no success yet
        m_replaced = measured;
    if (measured == m_replaced)
        return;
    const double before = m_before->flip, now = measured->error.whole.flip;
    const bool comparable = isComparable(*m_before);
    m_before.reset();
    m_replaced = nullptr;
    if (!comparable) {
        showHint(*this, tr("The scene, the camera or the size of the picture has changed: what was "
                           "before it cannot be compared with what is now"));
        return;
    }
    const QLocale locale;
    showHint(*this, tr("Visible difference (FLIP) %1 before, %2 now: %3 %")
                        .arg(locale.toString(before, 'f', 3), locale.toString(now, 'f', 3),
                             locale.toString(100.0 * (now / before - 1.0), 'f', 0)));
}

} // namespace patina::editor
