#include "core/radiosity/document/LitDocument.h"
#include "core/trace/document/DocumentTraceInputs.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace patina {

using namespace radiosity;

namespace {

double surfaceArea(const ElementMesh& elements) {
    double sum = 0.0;
    for (const double area : elements.areas())
        sum += area;
    return sum;
}

} // namespace

RadiosityScene::RadiosityScene(TraceScene scene, ElementMesh elements)
    : m_scene(std::move(scene))
    , m_elements(std::move(elements)) {}

Result<std::unique_ptr<RadiosityScene>> RadiosityScene::make(const Document& document,
                                                             const RadiositySettings& settings,
                                                             const JobContext& job) {
    job.setActivity("building the scene");
    auto scene = TraceScene::build(traceInputs(document), job.part(0.0, 0.4));
    if (!scene)
        return scene.error();
    if (scene->isEmpty())
        return Error{ErrorKind::InputBroken,
                     "The scene has no visible mesh; radiosity needs surfaces to light.",
                     {},
                     {}};
    ElementLimits limits{0.0, settings.maxArea, settings.maxElements};
    if (limits.maxArea <= 0.0) {
        const auto whole = ElementMesh::make(*scene->geometry(), limits);
        if (!whole)
            return whole.error();
        limits.maxArea = surfaceArea(*whole) / RadiositySettings::kUsualElements;
    }
    auto elements = ElementMesh::make(*scene->geometry(), limits);
    if (!elements)
        return elements.error();
    std::unique_ptr<RadiosityScene> result(
        new RadiosityScene(std::move(*scene), std::move(*elements)));
    job.setActivity("collecting light");
    result->m_elements.findBuried(*result->m_scene.rays(), job.part(0.4, 0.5));
    SceneProblemSettings light;
    light.lightSamples = settings.lightSamples;
    light.seed = settings.factors.seed;
    light.glowByFactors = settings.classic;
    auto lit = SceneProblem::make(result->m_scene, result->m_elements, light, job.part(0.5, 1.0));
    if (!lit)
        return lit.error();
    result->m_lit = std::move(*lit);
    return result;
}

Result<Solved> RadiosityScene::solve(const RadiositySettings& settings, const JobContext& job,
                                     const SolveObserver& observer) const {
    const auto factors = makeFormFactors(m_elements, *m_scene.rays(), settings.factors);
    return radiosity::solve(m_lit.problem, *factors, settings.solve, job, observer);
}

std::vector<LitPart> litParts(const RadiosityScene& scene, const Solution& solution) {
    const ElementMesh& elements = scene.elements();
    const LitMesh mesh = litMesh(elements, *scene.scene().geometry());
    std::vector<glm::dvec3> irradiance, radiosity;
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        irradiance.push_back(scene.lit().irradiance(solution, e));
        radiosity.push_back(scene.lit().radiosity(solution, e));
    }
    const std::vector<glm::dvec3> smoothIrradiance = vertexLight(mesh, elements, irradiance),
                                  smoothRadiosity = vertexLight(mesh, elements, radiosity);
    std::vector<LitPart> parts;
    std::vector<std::unique_ptr<Mesh>> meshes;
    std::vector<std::uint32_t> numbers(mesh.vertices.size(), kNone); // in the part's mesh
    std::uint32_t lastMesh = kNone;
    bool lastBack = false;
    std::vector<std::size_t> partOf(2 * scene.scene().geometry()->meshes.size(), ~std::size_t{0});
    for (const LitMesh::Triangle& triangle : mesh.triangles) {
        const Face& face = elements.face(triangle.element);
        std::size_t& index = partOf[2 * face.mesh + (face.back ? 1 : 0)];
        if (face.mesh != lastMesh || face.back != lastBack) {
            lastMesh = face.mesh;
            lastBack = face.back;
            if (index == ~std::size_t{0}) {
                index = parts.size();
                parts.push_back(
                    {scene.scene().geometry()->meshes[face.mesh].id, face.back, nullptr, {}, {}});
                meshes.push_back(std::make_unique<Mesh>());
            }
        }
        LitPart& part = parts[index];
        Mesh& to = *meshes[index];
        for (const std::uint32_t v : triangle.vertices) {
            if (numbers[v] == kNone) {
                const LitMesh::Vertex& vertex = mesh.vertices[v];
                numbers[v] = static_cast<std::uint32_t>(to.positions.size());
                to.positions.push_back(vertex.position);
                to.normals.push_back(vertex.normal);
                to.uvs.push_back(vertex.uv);
                part.irradiance.emplace_back(smoothIrradiance[vertex.light]);
                part.radiosity.emplace_back(smoothRadiosity[vertex.light]);
            }
            to.indices.push_back(numbers[v]);
        }
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
        meshes[i]->tangents.assign(meshes[i]->positions.size(), glm::vec4(1, 0, 0, 1));
        parts[i].mesh = std::move(meshes[i]);
    }
    return parts;
}

} // namespace patina
