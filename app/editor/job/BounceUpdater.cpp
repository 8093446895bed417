#include "app/editor/job/BounceUpdater.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/job/LivePreview.h"
#include "core/bake/BakeOptions.h"
#include "core/bake/Interreflection.h"
#include "core/base/Log.h"

#include <algorithm>

namespace patina::editor {
namespace {

BakeArtifactPtr bouncingBake(const Document& document) {
    for (const BakeArtifactPtr& artifact : document.bakes)
        if (artifact->kind == BakeKind::PrtVertex &&
            artifact->transfer == TransferKind::Interreflected)
            return artifact;
    return nullptr;
}

// Rays end at the same places.
bool sameTransport(const BakeMesh& a, const BakeMesh& b) {
    if (a.id != b.id || a.mesh != b.mesh || a.transform != b.transform ||
        a.doubleSided != b.doubleSided || a.surface.alphaMode != b.surface.alphaMode)
        return false;
    return a.surface.alphaMode == AlphaMode::Opaque ||
           (a.surface.opacity == b.surface.opacity &&
            a.surface.alphaCutoff == b.surface.alphaCutoff &&
            a.surface.baseColorMap == b.surface.baseColorMap);
}

bool sameTransport(const BakeInputs& a, const BakeInputs& b) {
    return std::equal(a.meshes.begin(), a.meshes.end(), b.meshes.begin(), b.meshes.end(),
                      [](const BakeMesh& x, const BakeMesh& y) { return sameTransport(x, y); });
}

std::vector<BakeSurface> surfacesOf(const BakeInputs& inputs) {
    std::vector<BakeSurface> surfaces;
    for (const BakeMesh& mesh : inputs.meshes)
        surfaces.push_back(mesh.surface);
    return surfaces;
}

// The hits are of these meshes; where those stand, the bake's hash has told.
bool fits(const HitSource& hits, const HitSettings& settings, const BakeInputs& inputs) {
    return hits.settings() == settings &&
           std::all_of(hits.elements().meshes().begin(), hits.elements().meshes().end(),
                       [&](const BounceElements::MeshPart& part) {
                           return std::any_of(inputs.meshes.begin(), inputs.meshes.end(),
                                              [&](const BakeMesh& mesh) {
                                                  return mesh.id == part.id &&
                                                         mesh.mesh == part.mesh &&
                                                         mesh.doubleSided == part.doubleSided;
                                              });
                       });
}

// Null when there are none to be had; an error is one of tracing.
Result<HitSourcePtr> hitsFor(const BakeArtifact& artifact, const BakeInputs& inputs,
                             const HitSourcePtr& ofBake, const JobContext& job) {
    if (hashBakeInputs(inputs) != artifact.inputs)
        return HitSourcePtr();
    PrtSettings settings = requestFromText(artifact.kind, artifact.settings).prt;
    settings.order = artifact.order;
    const Result<HitSettings> rays = hitSettings(settings);
    if (!rays)
        return rays.error();
    if (ofBake && fits(*ofBake, *rays, inputs))
        return ofBake;
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, job);
    if (!geometry)
        return geometry.error();
    const Result<RayScene> scene = RayScene::build(*geometry, job);
    if (!scene)
        return scene.error();
    Result<HitSourcePtr> hits = traceHits(*scene, *geometry, settings, job);
    if (hits && !(*hits)->kept()) // would need the scene to live on
        return HitSourcePtr();
    return hits;
}

// Null when the bake has the bounces of this albedo already, or holds other meshes.
Result<BakeArtifactPtr> withBounces(BounceSolver& solver, const BakeArtifact& artifact,
                                    const BakeInputs& inputs, const JobContext& job) {
    const Hash albedo = hashBakeAlbedo(inputs);
    if (albedo == artifact.albedo)
        return BakeArtifactPtr();
    const BounceElements& elements = solver.hits().elements();
    const std::optional<std::vector<float>> direct = directTransfer(elements, artifact);
    if (!direct)
        return BakeArtifactPtr();
    solver.setSurfaces(patina::surfacesOf(elements, inputs), job);
    const Result<std::vector<float>> bounced = solver.solve(*direct, artifact.bounces, job);
    if (!bounced)
        return bounced.error();
    BakeArtifact result = artifact;
    setBounced(result, elements, *bounced);
    result.albedo = albedo;
    return BakeArtifactPtr(std::make_shared<const BakeArtifact>(std::move(result)));
}

void report(const Error& error) {
    if (error.kind != ErrorKind::Cancelled)
        logError("following bounces: {}", error.text());
}

} // namespace

BounceUpdater::BounceUpdater(DocumentController& controller, JobManager& jobs, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_jobs(jobs)
    , m_tracing("hits of a bake")
    , m_solving("bounces", nullptr, LatestJob::Priority::Normal) {
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        // Lights and the view change nothing here.
        if (change.target && change.target->scope != Scope::Material &&
            change.target->scope != Scope::Mesh)
            return;
        update();
    });
}

bool BounceUpdater::upToDate() const {
    const BakeArtifactPtr artifact = bouncingBake(m_controller.document());
    return artifact && m_solver && !m_tracing.busy() && !m_solving.busy() && artifact == m_solved &&
           m_solvedSurfaces == surfacesOf(bakeInputs(m_controller.document()));
}

const HitSource* BounceUpdater::hits() const {
    return m_solver ? &m_solver->hits() : nullptr;
}

void BounceUpdater::forget() {
    m_tracing.cancel();
    m_solving.cancel();
    m_inputs = {};
    m_hopeless = m_solved = nullptr;
    m_solver = nullptr;
}

void BounceUpdater::update() {
    const BakeArtifactPtr artifact = bouncingBake(m_controller.document());
    if (!artifact) {
        forget();
        return;
    }
    BakeInputs inputs = bakeInputs(m_controller.document());
    if (sameTransport(inputs, m_inputs) && artifact->settings == m_settings) {
        if (m_solver)
            solve(artifact, std::move(inputs));
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
    const std::shared_ptr<LivePreview> preview = m_jobs.preview(); // of a bake that has just ended
    m_tracing.request([this, artifact, inputs = std::move(inputs),
                       ofBake = preview ? preview->bounceHits() : nullptr](const JobContext& job) {
        Result<HitSourcePtr> hits = hitsFor(*artifact, inputs, ofBake, job);
        if (!hits)
            report(hits.error());
        const HitSourcePtr found = hits ? *hits : nullptr;
        return LatestJob::Apply([this, artifact, found] {
            if (found)
                m_solver = std::make_shared<BounceSolver>(found);
            else
                m_hopeless = artifact;
            update();
        });
    });
}

void BounceUpdater::solve(const BakeArtifactPtr& artifact, BakeInputs inputs) {
    // One at a time: what changes meanwhile is seen when it is done.
    std::vector<BakeSurface> surfaces = surfacesOf(inputs);
    if (m_solving.busy() || (artifact == m_solved && surfaces == m_solvedSurfaces))
        return;
    m_solving.request([this, artifact, inputs = std::move(inputs), solver = m_solver,
                       surfaces = std::move(surfaces)](const JobContext& job) {
        const Result<BakeArtifactPtr> result = withBounces(*solver, *artifact, inputs, job);
        if (!result)
            report(result.error());
        const BakeArtifactPtr after = result ? *result : nullptr;
        return LatestJob::Apply([this, artifact, after, surfaces] {
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
