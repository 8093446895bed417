#include "core/bake/file/BakeSource.h"

#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakePoints.h"
#include "core/base/Check.h"
#include "core/base/Utf8.h"
#include "core/document/Source.h"
#include "core/mesh/MeshSource.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>

namespace patina {
namespace {

constexpr const char* kPrefix = "source.";
constexpr const char* kCoverage = "coverage";
constexpr const char* kFile = "patina:source.file";
constexpr const char* kMirrored = "patina:source.mirrored";

constexpr std::uint32_t kBase = 2048; // halves count exactly so far
constexpr int kDigits = 3;            // of 32 bits

std::uint32_t largestOf(const std::vector<std::uint32_t>& numbers) {
    return numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end());
}

int digitsOf(std::uint32_t largest) {
    int digits = 1;
    for (; digits < kDigits && largest >= kBase; largest /= kBase)
        ++digits;
    return digits;
}

void addDigits(std::vector<SourceChannel>& channels, const std::string& name,
               const std::vector<std::uint32_t>& numbers) {
    std::uint32_t divisor = 1;
    const int digits = digitsOf(largestOf(numbers));
    for (int digit = 0; digit < digits; ++digit, divisor *= kBase) {
        SourceChannel& channel = channels.emplace_back();
        channel.name = digit == 0 ? name : fmt::format("{}.{}", name, digit);
        channel.values.reserve(numbers.size());
        for (const std::uint32_t number : numbers)
            channel.values.push_back(static_cast<float>(number / divisor % kBase));
    }
}

} // namespace

std::vector<SourceChannel> sourceChannels(const MeshInstance& mesh) {
    const MeshSource* source = meshSource(mesh.mesh);
    if (source == nullptr)
        return {};
    std::vector<SourceChannel> channels;
    const std::size_t count = mesh.mesh->vertexCount();
    const auto everywhere = [&](const char* name, int number) {
        addDigits(channels, name,
                  std::vector<std::uint32_t>(count, static_cast<std::uint32_t>(number)));
    };
    addDigits(channels, "source.vertex", source->vertices);
    everywhere("source.mesh", source->mesh);
    everywhere("source.primitive", source->primitive);
    for (const MeshSource::Use& use : source->uses)
        if (use.instance == mesh.sourceIndex)
            everywhere("source.node", use.node);
    return channels;
}

std::size_t sourceChannelCount(const MeshPtr& mesh) {
    const MeshSource* source = meshSource(mesh);
    if (source == nullptr)
        return 0;
    int node = -1;
    for (const MeshSource::Use& use : source->uses)
        node = std::max(node, use.node);
    int digits = digitsOf(largestOf(source->vertices));
    for (const int number : {source->mesh, source->primitive, node})
        digits += number < 0 ? 0 : digitsOf(static_cast<std::uint32_t>(number));
    return static_cast<std::size_t>(digits);
}

void describeSource(const MeshInstance& mesh, BakeAttributes& attributes) {
    const MeshSource* source = meshSource(mesh.mesh);
    if (source == nullptr || isBuiltin(mesh.source))
        return;
    attributes[kFile] = makeValidUtf8(std::filesystem::path(mesh.source).filename().string());
    if (source->mirrored)
        attributes[kMirrored] = std::string("x");
}

SourceChannel coverageChannel(const Document& document, Id material, int side) {
    const std::size_t count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    SourceChannel channel{kCoverage, std::vector<float>(count, 0.0f)};
    BakeInputs inputs = bakeInputs(document);
    std::erase_if(inputs.meshes, [&](const BakeMesh& mesh) {
        return mesh.material != material || mesh.mesh->uvs.size() != mesh.mesh->positions.size();
    });
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    if (geometry.ok())
        for (const std::uint32_t texel : texelPoints(*geometry, material, side, {}).texels)
            channel.values[texel] = 1.0f;
    return channel;
}

void addChannels(Image& image, const std::vector<SourceChannel>& channels) {
    if (channels.empty())
        return;
    const auto before = static_cast<std::size_t>(image.channels());
    const std::size_t after = before + channels.size();
    Image result(image.width(), image.height(), static_cast<int>(after), image.type(),
                 image.encoding());
    const std::size_t pixels = image.f32().size() / before;
    for (std::size_t i = 0; i < pixels; ++i)
        std::copy_n(image.f32().begin() + static_cast<std::ptrdiff_t>(i * before), before,
                    result.f32().begin() + static_cast<std::ptrdiff_t>(i * after));
    std::vector<std::string> names = image.channelNames();
    for (std::size_t c = 0; c < channels.size(); ++c) {
        CHECK_LE(channels[c].values.size(), pixels);
        for (std::size_t i = 0; i < channels[c].values.size(); ++i)
            result.f32()[i * after + before + c] = channels[c].values[i];
        names.push_back(channels[c].name);
    }
    result.setChannelNames(std::move(names));
    image = std::move(result);
}

bool isSourceChannel(const std::string& name) {
    return name == kCoverage || name.starts_with(kPrefix);
}

} // namespace patina
