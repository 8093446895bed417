#include "core/bake/BakeMemory.h"

#include "core/bake/domain/VertexSamples.h"
#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/material/Material.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <set>

namespace patina {
namespace {

// Embree's hierarchy with its copy of the triangles, per triangle, generously.
constexpr std::uint64_t kBytesPerTriangle = 160;
constexpr std::uint64_t kBytesPerPoint = 2 * sizeof(glm::vec3) + 2; // start, normal, passes
constexpr std::uint64_t kBytesPerFittedTriangle = 150; // moments, edges, and sorting those
// Of a light map: paths of both lobes, their rays to lights, and those that ask what is hidden.
constexpr std::uint64_t kRaysPerLightMapPath = 10;
constexpr double kRoom = 1.1; // heaps are never full

std::uint64_t elementsOf(const BakeRequest& request, const BakeInputs& inputs) {
    std::uint64_t vertices = 0;
    std::set<Id> materials;
    for (const BakeMesh& mesh : inputs.meshes) {
        vertices += mesh.mesh ? mesh.mesh->vertexCount() : 0;
        materials.insert(mesh.material);
    }
    if (!isPerTexel(request.kind))
        return vertices;
    const auto side = static_cast<std::uint64_t>(textureSizeOf(request));
    return materials.size() * side * side;
}

// Settings that take less, the most harmless first.
std::optional<std::string> advice(const BakeRequest& request, const BakeInputs& inputs,
                                  std::uint64_t available) {
    const auto fits = [&](const BakeRequest& other) {
        return estimateBake(other, inputs).bytes <= available;
    };
    BakeRequest other = request;
    if (holdsTransfer(request.kind) && request.prt.transfer == TransferKind::Interreflected) {
        other.prt.hitBudget = 0;
        if (fits(other))
            return "Tracing the hits of the bounces anew (hit memory 0) would fit.";
    }
    for (other = request; holdsTransfer(request.kind) && other.prt.order > 1;) {
        --other.prt.order;
        if (fits(other))
            return fmt::format("With {} bands it would take {}.", other.prt.order,
                               memoryText(estimateBake(other, inputs).bytes));
    }
    for (other = request; isPerTexel(request.kind) && textureSizeOf(other) > 64;) {
        other.ao.size = other.prt.size = other.lightMap.size = textureSizeOf(other) / 2;
        if (fits(other))
            return fmt::format("With textures of {0} × {0} it would take {1}.",
                               textureSizeOf(other), memoryText(estimateBake(other, inputs).bytes));
    }
    return std::nullopt;
}

} // namespace

BakeEstimate estimateBake(const BakeRequest& request, const BakeInputs& inputs) {
    BakeEstimate result;
    result.elements = elementsOf(request, inputs);
    const bool transfer = holdsTransfer(request.kind);
    const bool bounces = transfer && request.prt.transfer == TransferKind::Interreflected;
    const auto samples = static_cast<std::uint64_t>(samplesOf(request));
    const auto bounceSamples =
        bounces ? static_cast<std::uint64_t>(request.prt.bounceSamples) : std::uint64_t{0};
    const bool traces = !transfer || request.prt.transfer != TransferKind::Unshadowed;
    // Values at vertices that are fitted rest on points of the triangles too.
    const bool fitted = request.kind == BakeKind::PrtVertex && request.prt.fitted && traces;
    const std::uint64_t onTriangles =
        fitted ? std::max<std::uint64_t>(result.elements, kMinTrianglePoints) : 0;
    result.rays = traces ? result.elements * (samples + bounceSamples) + onTriangles * samples : 0;

    std::uint64_t triangles = 0, vertices = 0;
    for (const BakeMesh& mesh : inputs.meshes)
        if (mesh.mesh) {
            triangles += mesh.mesh->triangleCount();
            vertices += mesh.mesh->vertexCount();
        }
    const auto stride = transfer ? static_cast<std::uint64_t>(request.prt.order * request.prt.order)
                                 : std::uint64_t{1};
    if (request.kind == BakeKind::LightMap) {
        // Sums, the texture that is made and its double while it is filtered, and the values.
        constexpr std::uint64_t kBytesPerTexel = 240 + 2 * 212 + 2 * kLightMapNumbers * 4;
        result.rays = result.elements * samples * kRaysPerLightMapPath;
        result.bytes = static_cast<std::uint64_t>(
            kRoom *
            static_cast<double>(triangles * kBytesPerTriangle + vertices * 2 * sizeof(glm::vec3) +
                                result.elements * kBytesPerTexel));
        return result;
    }
    // What is being traced, what becomes of it, and the preview.
    const std::uint64_t values = (stride + 2) * sizeof(float);
    std::uint64_t perElement = kBytesPerPoint + 3 * values;
    // Bounces hold their sum, the last one and the next in three colours.
    if (bounces)
        perElement += 3 * 3 * stride * sizeof(float);
    const std::uint64_t hits =
        bounces ? std::min(request.prt.hitBudget, 8 * bounceSamples * result.elements) : 0;
    const std::uint64_t scene = triangles * kBytesPerTriangle + vertices * 2 * sizeof(glm::vec3);
    // The points, the system of the fit, and the rows each thread solves, eight columns at a time.
    const std::uint64_t solvers =
        std::min(static_cast<std::uint64_t>(threadCount()), (stride + 7) / 8);
    const std::uint64_t fit =
        onTriangles * (kBytesPerPoint + 2 * values) +
        (fitted ? triangles * kBytesPerFittedTriangle + vertices * solvers * 5 * 8 * sizeof(float)
                : 0);
    result.bytes = static_cast<std::uint64_t>(
        kRoom * static_cast<double>(scene + hits + fit + result.elements * perElement));
    return result;
}

Result<void> checkBakeMemory(const BakeRequest& request, const BakeInputs& inputs,
                             std::uint64_t available) {
    const std::uint64_t needed = estimateBake(request, inputs).bytes;
    if (available == 0 || needed <= available)
        return {};
    return Error{ErrorKind::Usage,
                 fmt::format("The bake needs about {} of memory, and {} are free. {}",
                             memoryText(needed), memoryText(available),
                             advice(request, inputs, available)
                                 .value_or("Hide meshes, or bake fewer of them at a time.")),
                 {},
                 {}};
}

std::size_t texturesAtOnce(const BakeRequest& request, const BakeInputs& inputs,
                           std::uint64_t available) {
    CHECK(request.kind == BakeKind::AoTexel);
    std::set<Id> materials;
    for (const BakeMesh& mesh : inputs.meshes)
        materials.insert(mesh.material);
    const BakeEstimate all = estimateBake(request, inputs);
    if (available == 0 || all.bytes <= available || materials.empty())
        return materials.size();
    BakeRequest tiny = request; // what the scene takes by itself
    tiny.ao.size = 1;
    const std::uint64_t scene = estimateBake(tiny, inputs).bytes;
    const std::uint64_t each = (all.bytes - scene) / materials.size();
    return available <= scene ? 0 : static_cast<std::size_t>((available - scene) / each);
}

std::string memoryText(std::uint64_t bytes) {
    const double mebibytes = static_cast<double>(bytes) / (1024.0 * 1024.0);
    if (mebibytes < 1000.0)
        return fmt::format("{:.0f} MiB", std::max(mebibytes, 1.0));
    return fmt::format("{:.1f} GiB", mebibytes / 1024.0);
}

} // namespace patina
