#include "core/bake/local/NearShadows.h"

#include "core/bake/BakeMemory.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/GutterFill.h"
#include "core/bake/domain/SameTransport.h"
#include "core/bake/transfer/InsideShares.h"
#include "core/edit/Edit.h"
#include "core/job/Parallel.h"
#include "core/light/Light.h"
#include "core/mix/LightMix.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <functional>
#include <glm/geometric.hpp>
#include <set>
#include <unordered_map>

namespace patina {
namespace {

constexpr std::uint64_t kTriangleBytes = 94; // of the hierarchy while it is built (RayScene)
constexpr float kNoShare = -1.0f;
constexpr float kSameSide = 0.9f; // cosine to their mean of normals that share a texel

// What the document's transfer bakes hold, by id: scenes have thousands of parts.
class BakedParts {
  public:
    explicit BakedParts(const Document& document)
        : m_vertexBake(findBake(document, BakeKind::PrtVertex))
        , m_texelBake(findBake(document, BakeKind::PrtTexel)) {
        if (m_texelBake)
            for (const TexelBake& bake : m_texelBake->texels)
                if (!bake.values.empty())
                    m_texels.try_emplace(bake.material, &bake);
        if (m_vertexBake)
            for (const VertexBake& bake : m_vertexBake->vertices)
                if (!bake.values.empty())
                    m_vertices.try_emplace(bake.mesh, &bake);
    }
    [[nodiscard]] bool none() const { return !m_vertexBake && !m_texelBake; }

    // What fits the mesh: as TransferValues has it.
    [[nodiscard]] std::optional<NearPart> of(const MeshInstance& mesh) const {
        if (const auto bake = m_texels.find(mesh.material); bake != m_texels.end())
            return NearPart{mesh.material, bake->second->side};
        const auto found = m_vertices.find(mesh.id);
        if (found == m_vertices.end())
            return {};
        const VertexBake& bake = *found->second;
        if (bake.values.size() / static_cast<std::size_t>(bake.stride) != mesh.mesh->vertexCount())
            return {};
        return NearPart{mesh.id, 0};
    }

  private:
    BakeArtifactPtr m_vertexBake, m_texelBake; // that the others point into
    std::unordered_map<Id, const VertexBake*> m_vertices;
    std::unordered_map<Id, const TexelBake*> m_texels;
};

} // namespace

// --- Requests --------------------------------------------------------------------------------

std::vector<NearLight> nearLights(const Document& document) {
    std::vector<NearLight> lights;
    for (const Light* light : activeLights(document))
        if (const std::optional<NearEmitter> emitter = nearEmitter(*light))
            lights.push_back({light->id, *emitter});
    return lights;
}

NearShadowRequest nearShadowRequest(const Document& document) {
    NearShadowRequest request;
    request.lights = nearLights(document);
    const BakedParts transfer(document);
    if (request.lights.empty() || transfer.none())
        return request;
    std::set<std::pair<Id, int>> taken; // meshes may share a material's texels
    for (const MeshInstance& mesh : document.meshes) {
        if (!mesh.visible || !mesh.mesh)
            continue;
        const std::optional<NearPart> part = transfer.of(mesh);
        if (part && taken.emplace(part->id, part->side).second)
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
    std::unordered_map<Id, std::size_t> vertices;
    for (const BakeMesh& mesh : request.inputs.meshes) {
        triangles += mesh.mesh->triangleCount();
        vertices.try_emplace(mesh.id, mesh.mesh->vertexCount());
    }
    for (const NearPart& part : request.parts) {
        if (part.side > 0)
            elements +=
                static_cast<std::uint64_t>(part.side) * static_cast<std::uint64_t>(part.side);
        else if (const auto own = vertices.find(part.id); own != vertices.end())
            elements += own->second;
    }
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
        const std::unordered_map<Id, MeshPoints> meshes =
            pointsById(*scene->m_scene.geometry, vertices);
        for (const NearPart& part : request.parts)
            scene->m_parts.push_back(part.side > 0 ? scene->texelsOf(part, job)
                                                   : scene->verticesOf(part, meshes));
        for (std::size_t p = 0; p < scene->m_parts.size(); ++p)
            (scene->m_parts[p].points.size() <= kNearGrain ? scene->m_small : scene->m_large)
                .push_back(p);
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

    // Of all parts; calls `done` with how many of them are.
    Result<std::vector<NearShares>> trace(const NearEmitter& emitter, const JobContext& job,
                                          const std::function<void(std::size_t)>& done) const {
        std::vector<NearShares> shares(m_parts.size());
        // Thousands of small parts are for a thread each, large ones for all threads.
        parallelFor(job, m_small.size(), kSmallParts, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end && !job.cancelled(); ++i)
                if (Result<NearShares> traced = trace(m_small[i], emitter, job); traced.ok())
                    shares[m_small[i]] = *std::move(traced);
        });
        done(m_small.size());
        for (std::size_t i = 0; i < m_large.size(); ++i) {
            Result<NearShares> traced = trace(m_large[i], emitter, job);
            if (!traced)
                return traced.error();
            shares[m_large[i]] = *std::move(traced);
            done(m_small.size() + i + 1);
        }
        if (job.cancelled())
            return Error{ErrorKind::Cancelled, "Tracing shadows was cancelled.", {}, {}};
        return shares;
    }

  private:
    static constexpr std::size_t kSmallParts = 16; // traced by one thread, one after another

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

    struct Part {
        int side = 0; // 0: vertices, one point each
        std::vector<BakePoint> points;
        TexelPoints texels;                         // without its points
        std::vector<std::size_t> soft;              // of `texels`, those without a share
        std::unique_ptr<const InsideShares> inside; // of vertices
    };

    // Of a mesh of the geometry.
    struct MeshPoints {
        std::uint32_t mesh = 0; // its index
        std::span<const BakePoint> points;
    };

    // `vertices` of all meshes, one after another; after a cancel of some.
    [[nodiscard]] static std::unordered_map<Id, MeshPoints>
    pointsById(const BakeGeometry& geometry, std::span<const BakePoint> vertices) {
        std::unordered_map<Id, MeshPoints> meshes;
        std::size_t first = 0;
        for (std::uint32_t m = 0; m < geometry.meshes.size(); ++m) {
            const std::size_t count = geometry.meshes[m].positions.size();
            if (first + count > vertices.size())
                break;
            meshes[geometry.meshes[m].id] = {m, vertices.subspan(first, count)};
            first += count;
        }
        return meshes;
    }

    [[nodiscard]] Part verticesOf(const NearPart& part,
                                  const std::unordered_map<Id, MeshPoints>& meshes) const {
        Part result;
        const auto own = meshes.find(part.id);
        if (own == meshes.end())
            return result;
        result.points.assign(own->second.points.begin(), own->second.points.end());
        result.inside = std::make_unique<InsideShares>(m_scene, own->second.mesh, result.points);
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
    std::vector<Part> m_parts;                 // as the request's
    std::vector<std::size_t> m_small, m_large; // of m_parts: what one thread traces, and the others
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
        if (shares.empty()) {
            const auto done = [&](std::size_t parts) {
                job.setProgress(static_cast<double>(l * request.parts.size() + parts) /
                                static_cast<double>(request.lights.size() * request.parts.size()));
            };
            Result<std::vector<NearShares>> traced =
                result->scene->trace(request.lights[l].emitter, job, done);
            if (!traced)
                return traced.error();
            shares = std::move(*traced);
        }
    }
    return NearShadowsPtr(std::move(result));
}

} // namespace patina
