#include "core/bake/file/BakeFileSize.h"

#include "core/bake/BakeMemory.h"
#include "core/bake/file/BakeSource.h"
#include "core/base/Limits.h"

#include <fmt/format.h>
#include <optional>

namespace patina {
namespace {

std::uint64_t channelsOf(const BakeRequest& request) {
    if (request.kind == BakeKind::LightMap)
        return kLightMapNumbers;
    if (!holdsTransfer(request.kind))
        return 1;
    const auto coefficients = static_cast<std::uint64_t>(request.prt.order * request.prt.order);
    const bool bounces = request.prt.transfer == TransferKind::Interreflected;
    return (bounces ? 4 : 1) * coefficients + 2; // and sky visibility, error
}

// What leads back to the model's file.
std::uint64_t sourceNumbers(const BakeRequest& request, const BakeInputs& inputs) {
    if (isPerTexel(request.kind))
        return estimateBake(request, inputs).elements; // coverage
    std::uint64_t numbers = 0;
    for (const BakeMesh& mesh : inputs.meshes)
        numbers += mesh.mesh->vertexCount() * sourceChannelCount(mesh.mesh);
    return numbers;
}

// Settings that would fit, or nothing.
std::optional<std::string> advice(const BakeRequest& request, const BakeInputs& inputs) {
    const auto fits = [&](const BakeRequest& other) {
        return bakeFileBytes(other, inputs) <= limits::kMaxImageBytes;
    };
    for (BakeRequest other = request; holdsTransfer(request.kind) && other.prt.order > 1;) {
        --other.prt.order;
        if (fits(other))
            return fmt::format("With {} bands it would fit.", other.prt.order);
    }
    for (BakeRequest other = request; isPerTexel(request.kind) && textureSizeOf(other) > 64;) {
        other.ao.size = other.prt.size = other.lightMap.size = textureSizeOf(other) / 2;
        if (fits(other))
            return fmt::format("With textures of {0} × {0} it would fit.", textureSizeOf(other));
    }
    return std::nullopt;
}

} // namespace

std::uint64_t bakeFileBytes(const BakeRequest& request, const BakeInputs& inputs,
                            const BakeFileOptions& storage) {
    const std::uint64_t numbers = estimateBake(request, inputs).elements * channelsOf(request) +
                                  sourceNumbers(request, inputs);
    return numbers * (storage.storage == BakeStorage::Float ? 4 : 2);
}

std::uint64_t bakePictureBytes(const BakeRequest& request, const BakeInputs& inputs) {
    return estimateBake(request, inputs).elements;
}

Result<void> checkBakeFile(const BakeRequest& request, const BakeInputs& inputs) {
    // What is encoded are floats, whatever they are stored as.
    const std::uint64_t bytes = bakeFileBytes(request, inputs);
    if (bytes <= limits::kMaxImageBytes)
        return {};
    return Error{
        ErrorKind::Usage,
        fmt::format(
            "The bake would hold {} of numbers, and a bake file holds {} at most. "
            "{}",
            memoryText(bytes), memoryText(limits::kMaxImageBytes),
            advice(request, inputs).value_or("Hide meshes, or bake fewer of them at a time.")),
        {},
        {}};
}

} // namespace patina
