#include "core/bake/local/NearShadows.h"

#include "core/bake/BakeMemory.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/GutterFill.h"
#include "core/bake/domain/SameTransport.h"
#include "core/bake/transfer/InsideShares.h"
#include "core/edit/Edit.h"
#include "core/mix/LightMix.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace patina {
namespace {

constexpr std::uint64_t kTriangleBytes = 94; // of the hierarchy while it is built (RayScene)
constexpr float kNoShare = -1.0f;
constexpr float kSameSide = 0.9f; // cosine to their mean of normals that share a texel

// Whether a part of the document's transfer bakes fits the mesh: as TransferValues has it.
std::optional<NearPart> partOf(const MeshInstance& mesh, const BakeArtifactPtr& vertices,
                               const BakeArtifactPtr& texels) {
    if (texels)
        for (const TexelBake& bake : texels->texels)
            if (bake.material == mesh.material && !bake.values.empty())
                return NearPart{bake.material, bake.side};
    if (vertices)
        for (const VertexBake& bake : vertices->vertices)
            if (bake.mesh == mesh.id && !bake.values.empty() &&
                bake.values.size() / static_cast<std::size_t>(bake.stride) ==
                    mesh.mesh->vertexCount())
                return NearPart{bake.mesh, 0};
    return {};
}

std::size_t elementCount(const NearPart& part, const BakeInputs& inputs) {
    if (part.side > 0)
        return static_cast<std::size_t>(part.side) * static_cast<std::size_t>(part.side);
    for (const BakeMesh& mesh : inputs.meshes)
        if (mesh.id == part.id)
            return mesh.mesh->vertexCount();
    return 0;
}

} // namespace

// --- Requests --------------------------------------------------------------------------------

std::vector<NearLight> nearLights(const Document& document) {
    std::vector<NearLight> lights;
    for (const Light& light : document.lights)
        if (isActive(document, light))
            if (const std::optional<NearEmitter> emitter = nearEmitter(light))
                lights.push_back({light.id, *emitter});
    return lights;
}

NearShadowRequest nearShadowRequest(const Document& document) {
    NearShadowRequest request;
    request.lights = nearLights(document);
    const BakeArtifactPtr vertices = findBake(document, BakeKind::PrtVertex);
    const BakeArtifactPtr texels = findBake(document, BakeKind::PrtTexel);
    if (request.lights.empty() || (!vertices && !texels))
        return request;
    for (const MeshInstance& mesh : document.meshes) {
        if (!mesh.visible || !mesh.mesh)
            continue;
        const std::optional<NearPart> part = partOf(mesh, vertices, texels);
        if (part && std::ranges::find(request.parts, *part) == request.parts.end())
            request.parts.push_back(*part);
    }
    if (!request.parts.empty())
        request.inputs = bakeInputs(document);
    return request;
}

bool sameScene(const NearShadowRequest& a, const NearShadowRequest& b) {
    return a.parts == b.parts && sameTransport(a.inputs, b.inputs) &&
           std::ranges::equal(a.inputs.meshes, b.inputs.meshes, {}, &BakeMesh::material,
                              &BakeMesh::material);
}

bool operator==(const NearShadowRequest& a, const NearShadowRequest& b) {
    return a.lights == b.lights && sameScene(a, b);
}

std::uint64_t nearShadowBytes(const NearShadowRequest& request) {
    std::uint64_t elements = 0, triangles = 0;
    for (const NearPart& part : request.parts)
        elements += elementCount(part, request.inputs);
    for (const BakeMesh& mesh : request.inputs.meshes)
        triangles += mesh.mesh->triangleCount();
    // Shares here and on the graphics card, and the points that rays start from.
    return elements * (2 * sizeof(float) * request.lights.size() + sizeof(BakePoint)) +
           triangles * kTriangleBytes;
}

// --- Tracing ---------------------------------------------------------------------------------

class NearScene {
  public:
    static Result<std::shared_ptr<const NearScene>> make(const NearShadowRequest& request,
                                                         const JobContext& job) {
        Result<BakeScene> built = BakeScene::build(request.inputs, job);
        if (!built)
            return built.error();
        auto scene = std::make_shared<NearScene>(std::move(*built));
        const std::vector<BakePoint> vertices = vertexPoints(*scene->m_scene.geometry, job);
        for (const NearPart& part : request.parts)
            scene->m_parts.push_back(part.side > 0 ? scene->texelsOf(part, job)
                                                   : scene->verticesOf(part, vertices));
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "Tracing shadows was cancelled.", {}, {}};
        return std::shared_ptr<const NearScene>(std::move(scene));
    }

    explicit NearScene(BakeScene scene)
        : m_scene(std::move(scene)) {}

    [[nodiscard]] std::string note() const {
        std::size_t texels = 0, soft = 0;
        for (const Part& part : m_parts) {
            texels += part.texels.texels.size();
            soft += part.soft.size();
        }
        if (soft * 1000 <= texels) // a few texels on seams are normal
            return {};
        return fmt::format(
            "On {:.0f} % of the texels shadows of local lights stay soft, and let some "
            "light through: places that face different ways share them. Unwrap the "
            "mesh for one place per texel, and bake again.",
            std::max(1.0, 100.0 * static_cast<double>(soft) / static_cast<double>(texels)));
    }

    Result<NearShares> trace(std::size_t part, const NearEmitter& emitter,
                             const JobContext& job) const {
        const Part& own = m_parts[part];
        Result<std::vector<float>> shares = nearVisibility(m_scene, own.points, emitter, job);
        if (!shares)
            return shares.error();
        if (own.side > 0)
            shares = texture(own, *shares);
        else if (own.inside)
            own.inside->mend(*shares, job);
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "Tracing shadows was cancelled.", {}, {}};
        return NearShares(std::make_shared<const std::vector<float>>(std::move(*shares)));
    }

  private:
    struct Part {
        int side = 0; // 0: vertices, one point each
        std::vector<BakePoint> points;
        TexelPoints texels;                         // without its points
        std::vector<std::size_t> soft;              // of `texels`, those without a share
        std::unique_ptr<const InsideShares> inside; // of vertices
    };

    [[nodiscard]] Part verticesOf(const NearPart& part, std::span<const BakePoint> vertices) const {
        Part result;
        std::size_t first = 0;
        for (std::uint32_t m = 0; m < m_scene.geometry->meshes.size(); ++m) {
            const BakeGeometryMesh& mesh = m_scene.geometry->meshes[m];
            if (mesh.id == part.id && first + mesh.positions.size() <= vertices.size()) {
                const auto own = vertices.subspan(first, mesh.positions.size());
                result.points.assign(own.begin(), own.end());
                result.inside = std::make_unique<InsideShares>(m_scene, m, result.points);
            }
            first += mesh.positions.size();
        }
        return result;
    }

    [[nodiscard]] Part texelsOf(const NearPart& part, const JobContext& job) const {
        Part result;
        result.side = part.side;
        result.texels = texelPoints(*m_scene.geometry, part.id, part.side, job);
        result.points = std::exchange(result.texels.points, {});
        if (job.cancelled())
            return result;
        for (std::size_t t = 0; t < result.texels.texels.size(); ++t)
            if (!faceOneWay(
                    std::span(result.points)
                        .subspan(result.texels.firstPoint[t],
                                 result.texels.firstPoint[t + 1] - result.texels.firstPoint[t])))
                result.soft.push_back(t);
        return result;
    }

    static bool faceOneWay(std::span<const BakePoint> points) {
        glm::vec3 sum(0.0f);
        for (const BakePoint& point : points)
            sum += point.normal;
        const float least = kSameSide * glm::length(sum);
        return std::ranges::all_of(
            points, [&](const BakePoint& point) { return glm::dot(point.normal, sum) > least; });
    }

    // A texel takes the mean of its places' shares, as it takes the mean of their transfer, unless
    // they face different ways: the light of such a mean is that of none of them.
    [[nodiscard]] static std::vector<float> texture(const Part& part,
                                                    std::span<const float> shares) {
        const std::size_t count =
            static_cast<std::size_t>(part.side) * static_cast<std::size_t>(part.side);
        std::vector<float> result(count, kNoShare);
        std::vector<std::uint8_t> known(count, 0);
        const TexelPoints& texels = part.texels;
        auto soft = part.soft.begin();
        for (std::size_t t = 0; t < texels.texels.size(); ++t) {
            if (soft != part.soft.end() && *soft == t) {
                ++soft;
                continue;
            }
            const std::uint32_t first = texels.firstPoint[t], end = texels.firstPoint[t + 1];
            float sum = 0.0f;
            for (std::uint32_t p = first; p < end; ++p)
                sum += shares[p];
            result[texels.texels[t]] = sum / static_cast<float>(end - first);
            known[texels.texels[t]] = 1;
        }
        constexpr std::array<float, 1> kNowhere{kNoShare};
        fillGutters(result, std::move(known), part.side, kNowhere);
        for (const std::size_t t : part.soft)
            result[texels.texels[t]] = kNoShare;
        return result;
    }

    BakeScene m_scene;
    std::vector<Part> m_parts; // as the request's
};

Result<NearShadowsPtr> traceNearShadows(const NearShadowRequest& request,
                                        const NearShadowsPtr& before, std::uint64_t maxBytes,
                                        const JobContext& job) {
    auto result = std::make_shared<NearShadows>();
    result->request = request;
    if (request.empty())
        return NearShadowsPtr(std::move(result));
    const std::uint64_t bytes = nearShadowBytes(request);
    if (maxBytes > 0 && bytes > maxBytes)
        return Error{ErrorKind::Usage,
                     fmt::format("shadows of {} local light{} need {} of memory, and {} are free; "
                                 "switch lights off, or bake smaller textures",
                                 request.lights.size(), request.lights.size() == 1 ? "" : "s",
                                 memoryText(bytes), memoryText(maxBytes)),
                     {},
                     {}};
    const bool same = before && before->scene && sameScene(before->request, request);
    if (same) {
        result->scene = before->scene;
    } else {
        auto made = NearScene::make(request, job);
        if (!made)
            return made.error();
        result->scene = std::move(*made);
    }
    result->note = result->scene->note();
    for (std::size_t l = 0; l < request.lights.size(); ++l) {
        std::vector<NearShares>& shares = result->shares.emplace_back();
        if (same) {
            const auto known = std::ranges::find(before->request.lights, request.lights[l]);
            if (known != before->request.lights.end())
                shares =
                    before
                        ->shares[static_cast<std::size_t>(known - before->request.lights.begin())];
        }
        for (std::size_t p = shares.size(); p < request.parts.size(); ++p) {
            Result<NearShares> traced = result->scene->trace(p, request.lights[l].emitter, job);
            if (!traced)
                return traced.error();
            shares.push_back(std::move(*traced));
            job.setProgress(static_cast<double>(l * request.parts.size() + p + 1) /
                            static_cast<double>(request.lights.size() * request.parts.size()));
        }
    }
    return NearShadowsPtr(std::move(result));
}

} // namespace patina
