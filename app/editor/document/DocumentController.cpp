#include "app/editor/document/DocumentController.h"

#include "app/editor/document/EnvironmentResolver.h"
#include "core/document/EnvironmentTitle.h"
#include "core/edit/EditSteps.h"
#include "core/edit/ResetValue.h"
#include "core/library/SoftboxRigs.h"
#include "core/light/Light.h"

#include <algorithm>

namespace patina::editor {
namespace {

QString fromText(std::string_view text) {
    return QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
}

} // namespace

DocumentController::DocumentController(WorkerClient& worker, TaskRunner& runner, QObject* parent)
    : QObject(parent)
    , m_worker(worker)
    , m_runner(runner)
    , m_undo(m_session)
    , m_tasks(runner)
    , m_environment(new EnvironmentResolver(runner, this)) {
    m_session.observe(this);
    connect(&m_undo, &UndoStack::canRedoChanged, this, &DocumentController::deliverWaiting,
            Qt::QueuedConnection); // not in the middle of a push
    connect(m_environment, &EnvironmentResolver::refined, this,
            [this](Id environment, const ImagePtr& image) {
                m_session.setEnvironmentImage(environment, image);
            });
    connect(m_environment, &EnvironmentResolver::blended, this,
            [this](const ImagePtr& image) { m_session.setBlendedImage(image); });
    connect(&m_tasks, &BackgroundTasks::failed, this,
            [this](const QString& activity, const QString& reason) {
                Q_EMIT noticed({NoticeKind::Error, tr("%1 failed.").arg(activity), {reason}});
            });
}

DocumentController::~DocumentController() = default;

QString DocumentController::displayName() const {
    return m_name.isEmpty() ? tr("Untitled") : m_name;
}

bool DocumentController::isPristine() const {
    return m_pristine && m_session.count() == 0;
}

Affects DocumentController::derive(Document& document) {
    return m_environment->update(document) ? Affects::EnvironmentMap : Affects::Nothing;
}

bool DocumentController::showsDraft() const {
    return m_environment->isRefining();
}

void DocumentController::documentChanged(const Change& change) {
    Q_EMIT changed(change);
    noteModified();
}

void DocumentController::historyChanged() {
    m_undo.update();
    noteModified();
}

void DocumentController::stepsDropped() {
    m_pristine = false;
    Q_EMIT noticed({NoticeKind::Info,
                    tr("The oldest undo steps were dropped: what they keep took too much memory."),
                    {}});
}

void DocumentController::noteModified() {
    if (isModified() == m_shownModified)
        return;
    m_shownModified = !m_shownModified;
    Q_EMIT fileChanged();
}

void DocumentController::deliver(const Begun& begun, const QString& name,
                                 std::function<void()> edit) {
    if (!m_session.canRedo() || state() == begun.state) {
        const bool expected = m_opening && begun.opened < m_opened && *m_opening == state();
        edit();
        if (expected)
            *m_opening = state();
        return;
    }
    m_waiting.push_back(std::move(edit));
    Q_EMIT noticed(
        {NoticeKind::Info,
         tr("%1 is ready, but you have gone back since; it comes with your next edit, or "
            "when you have redone everything.")
             .arg(name),
         {}});
}

void DocumentController::deliverWaiting() {
    while (!m_waiting.empty() && !m_session.canRedo()) {
        const std::function<void()> edit = std::move(m_waiting.front());
        m_waiting.erase(m_waiting.begin());
        edit();
    }
}

// --- Edits ---------------------------------------------------------------------------------------

void DocumentController::setParameter(const ParameterInfo& info, Target target,
                                      const ParameterValue& value, DragSession session) {
    // What a file shows depends on its layout: it is read anew.
    if (info.id == "environment.layout") {
        const Environment* environment = document().environment(target.id);
        if (environment && ParameterValue(static_cast<int>(environment->layout)) != value)
            readEnvironment(environment->id, QString::fromStdString(environment->source),
                            static_cast<EnvironmentLayout>(std::get<int>(value)),
                            tr("Change %1").arg(fromText(info.label)));
        return;
    }
    m_session.setParameter(info, target, value, session);
}

void DocumentController::setParameters(Target target, const std::vector<ParameterEdit>& edits,
                                       const QString& text, DragSession session) {
    m_session.setParameters(target, edits, text.toStdString(), session);
}

void DocumentController::resetParameter(const ParameterInfo& info, Target target) {
    if (targetExists(document(), target))
        setParameter(info, target, resetValue(document(), info, target));
}

void DocumentController::editStructure(const QString& undoText,
                                       const std::function<void(Document&)>& edit) {
    m_session.editStructure(undoText.toStdString(), edit);
}

void DocumentController::rename(Target target, const QString& name) {
    m_session.rename(target, name.trimmed().toStdString());
}

void DocumentController::changeLight(const Light& light, DragSession session, const QString& text) {
    m_session.changeLight(light, text.toStdString(), session);
}

void DocumentController::attachBake(BakeArtifactPtr artifact) {
    m_pristine = false;
    m_session.attachBake(std::move(artifact));
}

void DocumentController::showLighting(LightingMode mode) {
    const ParameterInfo& info = parameter("view.lighting");
    if (document().view.lighting == mode)
        return;
    m_pristine = m_pristine && !m_session.canRedo();
    m_session.pushOrApply(std::make_unique<SetParametersStep>(
        fmt::format("Change {}", info.label), document(), Target{Scope::View, 0},
        std::vector<ParameterEdit>{{&info, static_cast<int>(mode)}}, 0));
}

// --- Several environments ------------------------------------------------------------------------

void DocumentController::addEnvironment(EnvironmentKind kind) {
    const Environment& lit = document().environment();
    Environment environment;
    environment.kind = kind;
    // What it shows when it is made an image.
    environment.source = lit.source;
    environment.layout = lit.layout;
    environment.fileImage = lit.fileImage;
    environment.problem = lit.problem;
    if (kind == EnvironmentKind::Softboxes) // a dark room would look like a fault
        environment.softboxes = library::softboxRigs().front().softboxes;
    m_session.addEnvironment(environment, fmt::format("Add {}", environmentTitle(environment)));
}

void DocumentController::fadeTo(Id environment) {
    const Target scene{Scope::Environment, 0};
    m_session.setDiffering(
        scene,
        editsFor(document(), parameter("environment.second"), scene, static_cast<int>(environment)),
        environment == 0
            ? "End Cross-Fade"
            : fmt::format("Fade to {}", nameOf(document(), {Scope::Environment, environment})));
}

// --- Generated environments ----------------------------------------------------------------------

void DocumentController::setEnvironmentKind(EnvironmentKind kind) {
    if (kind == document().environment().kind)
        return;
    const ParameterInfo& info = parameter("environment.kind");
    const std::string text =
        fmt::format("Light with {}", info.choiceLabels[static_cast<std::size_t>(kind)]);
    m_session.group(text, [&] {
        // A dark room would look like a fault: the first rig comes along, in the same step.
        if (kind == EnvironmentKind::Softboxes && document().environment().softboxes.empty())
            setSoftboxRig(library::softboxRigs().front());
        m_session.setDiffering({Scope::Environment, 0}, {{&info, static_cast<int>(kind)}}, text);
    });
}

void DocumentController::setSoftboxRig(const library::SoftboxRig& rig) {
    m_session.setSoftboxes(fmt::format("Set Up {}", rig.title), rig.softboxes);
}

} // namespace patina::editor
