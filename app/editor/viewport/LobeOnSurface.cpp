#include "app/editor/viewport/LobeOnSurface.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/viewport/PixelProbe.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "render/view/Recombine.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace patina::editor {
namespace {

constexpr glm::vec3 kColor{0.34f, 0.71f, 0.91f}; // of the scene's look in the lens
constexpr int kRings = 32, kSegments = 48;       // it is sorted in every frame

} // namespace

LobeOnSurface::LobeOnSurface(DocumentController& controller, PixelProbe& probe, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_probe(probe)
    , m_tables(std::make_shared<DfgTables>())
    , m_job(controller.runner(), "lobe on the surface") {
    m_scale.logarithmic = true;
    // The numbers of the point follow by the probe; the model and the camera are no part of them.
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (!change.target || change.target->scope == Scope::Model ||
            change.target->scope == Scope::Material || change.target->scope == Scope::View)
            refresh();
    });
    connect(&probe, &PixelProbe::hoverChanged, this, &LobeOnSurface::refresh);
    connect(&probe, &PixelProbe::pinChanged, this, &LobeOnSurface::refresh);
}

LobeOnSurface::~LobeOnSurface() {
    if (m_light)
        m_probe.removeListener();
}

void LobeOnSurface::show(std::optional<Id> light) {
    if (light == m_light)
        return;
    if (light && !m_light)
        m_probe.addListener();
    if (!light && m_light)
        m_probe.removeListener();
    m_light = light;
    refresh();
}

void LobeOnSurface::setScale(const LobeScale& scale) {
    m_scale = scale;
    refresh();
}

void LobeOnSurface::setOther(std::shared_ptr<const render::SurfaceLobe> lobe) {
    if (lobe == m_other)
        return;
    m_other = std::move(lobe);
    Q_EMIT changed();
}

std::optional<LobeOnSurface::Ask> LobeOnSurface::ask(QString& problem) const {
    const std::optional<render::Inspection>& at = m_probe.shown();
    if (!at || !at->onSurface()) {
        problem = tr("Point at the model, or pin a pixel of it.");
        return std::nullopt;
    }
    const Document& document = m_controller.document();
    Ask ask;
    ask.position = glm::vec3(at->value(shading::kRecordPosition));
    ask.normal = glm::normalize(glm::vec3(at->value(shading::kViewShadingNormal)));
    // The tangent of the map's frame; any where the mesh has none.
    const glm::vec3 along(at->value(shading::kViewTangent));
    const glm::vec3 flat = along - ask.normal * glm::dot(along, ask.normal);
    if (glm::dot(flat, flat) > 1e-6f) {
        ask.tangent = glm::normalize(flat);
        ask.bitangent = glm::cross(ask.normal, ask.tangent);
        if (glm::dot(ask.bitangent, glm::vec3(at->value(shading::kViewBitangent))) < 0.0f)
            ask.bitangent = -ask.bitangent;
    } else {
        shading::orthonormalBasis(ask.normal, ask.tangent, ask.bitangent);
    }
    if (*m_light == 0) {
        ask.end = LobeEnd::Viewer;
        ask.toFixed = glm::normalize(document.view.camera.position() - ask.position);
    } else {
        const auto light =
            std::find_if(at->lights.begin(), at->lights.end(),
                         [&](const render::LightShare& share) { return share.light == *m_light; });
        if (light == at->lights.end()) {
            problem = tr("The light is off.");
            return std::nullopt;
        }
        ask.end = LobeEnd::Light;
        ask.toFixed = light->toLight;
    }
    if (!(glm::dot(ask.toFixed, ask.normal) > 0.0f)) {
        problem = *m_light == 0 ? tr("The surface is seen from behind there.")
                                : tr("The light is behind the surface there.");
        return std::nullopt;
    }
    const Material* material = document.material(at->material);
    ask.look = {document.model,
                render::surfaceInputs(*at, material != nullptr ? *material : Material())};
    ask.scale = m_scale;
    return ask;
}

void LobeOnSurface::refresh() {
    if (!m_light) {
        m_job.cancel();
        m_asked.reset();
        set(nullptr, {});
        return;
    }
    QString problem;
    const std::optional<Ask> wanted = ask(problem);
    // Each frame says anew what lies under the pointer: only another answer makes another lobe.
    if (wanted && wanted == m_asked)
        return;
    m_asked = wanted;
    if (!wanted) {
        m_job.cancel();
        set(nullptr, problem);
        return;
    }
    m_job.request([this, of = *wanted, tables = m_tables](const JobContext&) -> LatestJob::Apply {
        const BrdfLens lens(of.look.model, of.look.point, tables->of(of.look.model));
        const glm::vec3 fixed(glm::dot(of.toFixed, of.tangent), glm::dot(of.toFixed, of.bitangent),
                              glm::dot(of.toFixed, of.normal));
        auto lobe = std::make_shared<render::SurfaceLobe>();
        lobe->mesh = std::make_shared<const LobeMesh>(
            makeLobeMesh(lens, fixed, of.end, of.scale, lobePeak(lens, fixed, of.end, of.scale),
                         kRings, kSegments));
        lobe->position = of.position;
        lobe->tangent = of.tangent;
        lobe->bitangent = of.bitangent;
        lobe->normal = of.normal;
        lobe->end = of.end;
        lobe->toFixed = of.toFixed;
        lobe->color = kColor;
        return [this, lobe] { set(lobe, {}); };
    });
}

void LobeOnSurface::set(std::shared_ptr<const render::SurfaceLobe> lobe, const QString& problem) {
    if (lobe == m_lobe && problem == m_problem)
        return;
    m_lobe = std::move(lobe);
    m_problem = problem;
    Q_EMIT changed();
}

} // namespace patina::editor
