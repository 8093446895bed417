#include "app/editor/job/BounceUpdater.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/job/FinishedHits.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeHash.h"
#include "core/base/Log.h"

#include <algorithm>

namespace patina::editor {
namespace {

constexpr int kPauseMs = 150; // without an edit until all coefficients are worth their time

BakeArtifactPtr bouncingBake(const Document& document) {
    for (const BakeArtifactPtr& artifact : document.bakes)
        if (artifact->kind == BakeKind::PrtVertex &&
            artifact->transfer == TransferKind::Interreflected)
            return artifact;
    return nullptr;
}

void report(const Error& error) {
    if (error.kind != ErrorKind::Cancelled)
        logError("following bounces: {}", error.text());
}

// Its value, or nothing and a line in the log.
template <class Value>
Value reported(Result<Value> result) {
    if (result)
        return std::move(*result);
    report(result.error());
    return nullptr;
}

} // namespace

BounceUpdater::BounceUpdater(DocumentController& controller, FinishedHits& ended, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_ended(ended)
    , m_tracing(controller.runner(), "hits of a bake")
    , m_lighting(controller.runner(), "bounced light", nullptr, TaskPriority::High)
    , m_solving(controller.runner(), "bounces") {
    m_pause.setSingleShot(true);
    m_pause.setInterval(kPauseMs);
    connect(&m_pause, &QTimer::timeout, this, &BounceUpdater::solve);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        // Lights come by setLight(); of the view one number counts.
        if (change.target && change.target->scope != Scope::Material &&
            change.target->scope != Scope::Mesh &&
            m_controller.document().view.bounces == m_bounces)
            return;
        update();
    });
}

bool BounceUpdater::upToDate() const {
    const BakeArtifactPtr artifact = bouncingBake(m_controller.document());
    return artifact && m_solver && !m_tracing.busy() && !m_lighting.busy() && !m_solving.busy() &&
           artifact == m_solved &&
           m_solvedSurfaces == surfacesOf(bakeInputs(m_controller.document()));
}

bool BounceUpdater::isOnItsWay() const {
    return m_tracing.busy() || m_lighting.busy() || m_solving.busy() || m_pause.isActive();
}

const HitSource* BounceUpdater::hits() const {
    return m_solver ? &m_solver->hits() : nullptr;
}

int BounceUpdater::lightOrder() const {
    const BakeArtifactPtr artifact = bouncingBake(m_controller.document());
    return artifact ? artifact->order : 0;
}

void BounceUpdater::setLight(std::span<const glm::vec3> light) {
    if (std::ranges::equal(light, m_light))
        return;
    const bool first = m_light.empty();
    m_light.assign(light.begin(), light.end());
    if (first || m_request.artifact)
        update();
}

void BounceUpdater::forget() {
    m_tracing.cancel();
    m_lighting.cancel();
    m_solving.cancel();
    m_pause.stop();
    m_inputs = {};
    m_hopeless = m_solved = nullptr;
    m_solvedSurfaces.clear();
    m_shownSurfaces.clear();
    m_solver = nullptr;
    m_request = {};
    show(nullptr);
}

void BounceUpdater::update() {
    m_bounces = m_controller.document().view.bounces;
    const BakeArtifactPtr artifact = bouncingBake(m_controller.document());
    if (!artifact) {
        forget();
        return;
    }
    BakeInputs inputs = bakeInputs(m_controller.document());
    if (sameTransport(inputs, m_inputs) && artifact->settings == m_settings) {
        if (m_solver)
            follow(artifact, inputs);
        else if (artifact != m_hopeless && !m_tracing.busy())
            trace(artifact, std::move(inputs));
        return;
    }
    forget();
    trace(artifact, std::move(inputs));
}

void BounceUpdater::trace(const BakeArtifactPtr& artifact, BakeInputs inputs) {
    m_inputs = inputs;
    m_settings = artifact->settings;
    m_tracing.request([this, artifact, inputs = std::move(inputs),
                       ofBake = m_ended.take(artifact)](const JobContext& job) {
        const HitSourcePtr found = reported(hitsFor(*artifact, inputs, ofBake, job));
        const bool right = found && hashBakeAlbedo(inputs) == artifact->albedo;
        return LatestJob::Apply([this, artifact, found, right, surfaces = surfacesOf(inputs)] {
            if (found) {
                m_solver = std::make_shared<const BounceSolver>(found);
                m_solved = artifact;
                if (right)
                    m_solvedSurfaces = surfaces;
            } else {
                m_hopeless = artifact;
            }
            update();
        });
    });
}

void BounceUpdater::follow(const BakeArtifactPtr& artifact, const BakeInputs& inputs) {
    Request request{artifact, surfacesOf(inputs), m_light,
                    m_bounces > 0 ? m_bounces : artifact->bounces};
    const bool known = artifact == m_solved; // whether its bounces are right; else they may well be
    const bool right = known && request.surfaces == m_solvedSurfaces;
    const bool rightNumber = request.bounces == artifact->bounces;

    // All coefficients, behind the light that is shown.
    if (right) {
        m_solving.cancel();
        m_pause.stop();
    } else if (!known) {
        if (!m_solving.busy()) // one at a time: what changes meanwhile is seen when it is done
            solve();
    } else if (!m_solving.busy() || m_solvingSurfaces != request.surfaces) {
        m_solving.cancel();
        m_pause.start();
    }

    if (m_light.empty() || ((right || !known) && rightNumber)) {
        m_lighting.cancel();
        m_request = {};
        show(nullptr);
    } else if (request != m_request) {
        m_request = request;
        showLight(std::move(request), inputs);
    }
}

void BounceUpdater::showLight(Request request, const BakeInputs& inputs) {
    m_lighting.request([this, request = std::move(request), inputs,
                        solver = m_solver](const JobContext& job) {
        const BounceSolverPtr now = resurfaced(*solver, inputs, job);
        const BouncedLightPtr light =
            reported(bouncedLight(*now, *request.artifact, request.light, request.bounces, job));
        if (!light)
            return LatestJob::Apply();
        return LatestJob::Apply([this, now, light, surfaces = request.surfaces] {
            m_solver = now;
            m_shownSurfaces = surfaces;
            show(light);
        });
    });
}

void BounceUpdater::show(BouncedLightPtr light) {
    if (light == m_shown)
        return;
    m_shown = std::move(light);
    Q_EMIT shownChanged();
}

void BounceUpdater::solve() {
    const BakeArtifactPtr artifact = bouncingBake(m_controller.document());
    if (!artifact || !m_solver)
        return;
    BakeInputs inputs = bakeInputs(m_controller.document());
    m_solvingSurfaces = surfacesOf(inputs);
    if (m_lighting.busy() && m_shownSurfaces != m_solvingSurfaces) { // which comes first
        m_pause.start();
        return;
    }
    m_solving.request([this, artifact, inputs = std::move(inputs), solver = m_solver,
                       surfaces = m_solvingSurfaces](const JobContext& job) {
        const BounceSolverPtr now = resurfaced(*solver, inputs, job);
        const BakeArtifactPtr after = reported(withBounces(*now, *artifact, inputs, job));
        if (job.cancelled())
            return LatestJob::Apply();
        return LatestJob::Apply([this, artifact, after, surfaces, now] {
            m_solver = now;
            m_solved = after ? after : artifact;
            m_solvedSurfaces = surfaces;
            if (after)
                m_controller.renewBake(artifact, after);
            Q_EMIT updated();
            update(); // whatever was edited meanwhile
        });
    });
}

} // namespace patina::editor
