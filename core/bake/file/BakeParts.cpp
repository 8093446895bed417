#include "core/bake/file/BakeParts.h"

#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/domain/BakeHash.h"
#include "core/bake/file/BakeSource.h"
#include "core/bake/file/BakeTarget.h"
#include "core/base/Check.h"
#include "core/document/Document.h"
#include "core/material/Material.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

namespace patina {
namespace {

constexpr const char* kStepsOfValues = "patina:step.sh";
constexpr const char* kStepsOfBounced = "patina:step.bounced";
constexpr const char* kStorageError = "patina:storageError";
constexpr const char* kContentHash = "patina:contentHash";

template <class Element>
std::unordered_map<Id, std::size_t> indicesById(const std::vector<Element>& elements) {
    std::unordered_map<Id, std::size_t> indices;
    for (std::size_t i = 0; i < elements.size(); ++i)
        indices.try_emplace(elements[i].id, i);
    return indices;
}

template <class Bake>
BakeElementsView viewOf(const Bake& bake) {
    return {bake.stride, bake.values, bake.bounced, bake.sky, bake.error};
}

// How many elements the bake has, or nothing when its vectors do not agree.
std::optional<std::size_t> countOf(const BakeElementsView& view) {
    if (view.stride < 1 || view.values.empty() ||
        view.values.size() % static_cast<std::size_t>(view.stride) != 0)
        return std::nullopt;
    const std::size_t count = view.values.size() / static_cast<std::size_t>(view.stride);
    const auto fits = [](std::size_t size, std::size_t wanted) {
        return size == 0 || size == wanted;
    };
    if (!fits(view.bounced.size(), 3 * view.values.size()) || !fits(view.sky.size(), count) ||
        !fits(view.error.size(), count))
        return std::nullopt;
    return count;
}

// Of all that a part says and holds, in the order of the channels' names.
Hash hashContent(const ImagePart& part) {
    Hasher hasher;
    for (const auto& [key, value] : part.attributes)
        // OpenImageIO does not store empty ones.
        if (key.starts_with("patina:") && key != kContentHash && !value.empty())
            hasher.text(key).text(value);
    hasher.value(part.image.width()).value(part.image.height());
    const std::vector<std::string>& names = part.image.channelNames();
    std::map<std::string, std::size_t> channels;
    for (std::size_t c = 0; c < names.size(); ++c)
        channels[names[c]] = c;
    std::vector<float> values;
    for (const auto& [name, channel] : channels) {
        values.clear();
        for (std::size_t i = channel; i < part.image.f32().size(); i += names.size())
            values.push_back(part.image.f32()[i]);
        hasher.text(name).array(std::span<const float>(values));
    }
    return hasher.finish();
}

void addElements(ImagePart& part, const BakeElementsView& elements, const BakeArtifact& artifact,
                 std::size_t width, const BakeFileOptions& options,
                 const std::vector<SourceChannel>& source) {
    const int order = holdsTransfer(artifact.kind) ? artifact.order : 0;
    BakeImage packed = imageFromElements(elements, artifact.kind, order, width, options);
    part.image = std::move(packed.image);
    if (!packed.steps.values.empty())
        part.attributes[kStepsOfValues] = floatsText(packed.steps.values);
    if (!packed.steps.bounced.empty() && hasBounced(part.image))
        part.attributes[kStepsOfBounced] = floatsText(packed.steps.bounced);
    if (options.storage != BakeStorage::Float)
        part.attributes[kStorageError] = storageErrorText(
            storageError(elements.values, elements.bounced, std::max(order, 1), options));
    addChannels(part.image, source);
    part.attributes[kContentHash] = hashContent(part).hex();
}

// Reading.

struct Reader {
    const BakeHeader& header;
    const std::filesystem::path& file;
    const BakeTargets& targets;

    [[nodiscard]] Error damaged(const std::string& what) const { return damagedBake(file, what); }
    [[nodiscard]] Error misfit(const std::string& why) const {
        return {ErrorKind::InputBroken,
                fmt::format("the bake {}; open the scene it was made from, or bake this one", why),
                file,
                {}};
    }
};

Result<VertexBake> readVertices(const Reader& reader, const ImagePart& part) {
    if (const std::string why = meshMismatch(reader.targets, part.attributes); !why.empty())
        return reader.misfit(why);
    const MeshInstance& mesh =
        reader.targets.document().meshes[reader.targets.mesh(part.attributes).value()];
    const auto count = numberAttribute(part.attributes, kVertexCountAttribute, 1, 1ll << 32);
    if (!count || static_cast<std::size_t>(*count) != mesh.mesh->vertexCount())
        return reader.damaged("the number of vertices is wrong");
    Result<BakeElements> e = elementsFromPart(part, reader.header, reader.file);
    if (!e)
        return e.error();
    return VertexBake{
        mesh.id,           e->stride,          std::move(e->values), std::move(e->bounced),
        std::move(e->sky), std::move(e->error)};
}

Result<TexelBake> readTexels(const Reader& reader, const ImagePart& part) {
    const std::optional<std::size_t> target = reader.targets.material(part.attributes);
    if (!target) {
        const std::string* name = findAttribute(part.attributes, kTargetAttribute);
        return reader.misfit(fmt::format("has values for a material \"{}\", which the scene does "
                                         "not have",
                                         name != nullptr ? *name : "unnamed"));
    }
    const int side = part.image.width();
    if (side != part.image.height())
        return reader.damaged("the texture is not square");
    Result<BakeElements> e = elementsFromPart(part, reader.header, reader.file);
    if (!e)
        return e.error();
    TexelBake bake;
    bake.material = reader.targets.document().materials[*target].id;
    if (reader.header.artifact.kind == BakeKind::AoTexel) {
        auto image = std::make_shared<Image>(side, side, 1, PixelType::F32, ColorEncoding::Data);
        std::copy(e->values.begin(), e->values.end(), image->f32().begin());
        bake.image = std::move(image);
        return bake;
    }
    bake.side = side;
    bake.stride = e->stride;
    bake.values = std::move(e->values);
    bake.bounced = std::move(e->bounced);
    bake.sky = std::move(e->sky);
    bake.error = std::move(e->error);
    return bake;
}

} // namespace

std::vector<ImagePart> bakeToParts(const BakeArtifact& artifact, const Document& document,
                                   const BakeFileOptions& options) {
    CHECK(options.storage != BakeStorage::Quantised || holdsTransfer(artifact.kind));
    const BakeAttributes header = headerAttributes(artifact, options);
    const std::vector<std::string> meshNames = partNames(document.meshes);
    const std::vector<std::string> materialNames = partNames(document.materials);
    const std::unordered_map<Id, std::size_t> meshes = indicesById(document.meshes);
    const std::unordered_map<Id, std::size_t> materials = indicesById(document.materials);
    std::vector<ImagePart> parts;
    for (const VertexBake& bake : artifact.vertices) {
        const auto found = meshes.find(bake.mesh);
        const std::optional<std::size_t> count = countOf(viewOf(bake));
        if (found == meshes.end() || !count)
            continue;
        const std::size_t index = found->second;
        if (!document.meshes[index].mesh || document.meshes[index].mesh->vertexCount() != *count)
            continue;
        ImagePart& part = parts.emplace_back();
        part.name = meshNames[index];
        part.attributes = header;
        describeMesh(document.meshes[index], part.name, index, part.attributes);
        describeSource(document.meshes[index], part.attributes);
        addElements(part, viewOf(bake), artifact, std::min<std::size_t>(*count, kMaxBakeRow),
                    options, sourceChannels(document.meshes[index]));
    }
    // Only the geometry that was baked can tell which texels are its own.
    const bool current =
        !artifact.texels.empty() && artifact.inputs == hashBakeInputs(bakeInputs(document));
    for (const TexelBake& bake : artifact.texels) {
        const auto found = materials.find(bake.material);
        BakeElementsView elements = viewOf(bake);
        std::size_t side = static_cast<std::size_t>(bake.side);
        if (bake.image) {
            elements = {1, bake.image->f32(), {}, {}, {}};
            side = static_cast<std::size_t>(bake.image->width());
        }
        if (found == materials.end() || countOf(elements) != side * side)
            continue;
        ImagePart& part = parts.emplace_back();
        part.name = materialNames[found->second];
        part.attributes = header;
        describeMaterial(part.name, found->second, part.attributes);
        std::vector<SourceChannel> coverage;
        if (current)
            coverage.push_back(coverageChannel(document, bake.material, static_cast<int>(side)));
        addElements(part, elements, artifact, side, options, coverage);
    }
    if (parts.empty()) {
        ImagePart& part = parts.emplace_back();
        part.image = Image(1, 1, 1, PixelType::F32, ColorEncoding::Linear);
        part.attributes = header;
    }
    return parts;
}

Result<BakeArtifact> bakeFromParts(const std::vector<ImagePart>& parts, const Document& document,
                                   const std::filesystem::path& file) {
    if (parts.empty())
        return damagedBake(file, "it is empty");
    Result<BakeHeader> header = readBakeHeader(parts.front().attributes, file);
    if (!header)
        return header.error();
    const BakeTargets targets(document);
    const Reader reader{*header, file, targets};
    BakeArtifact artifact = header->artifact;
    std::set<Id> seen;
    for (const ImagePart& part : parts) {
        if (parts.size() == 1 && findAttribute(part.attributes, kTargetAttribute) == nullptr)
            break; // nothing of it was left when it was saved
        if (!sameHeader(parts.front().attributes, part.attributes))
            return damagedBake(file, "its parts do not belong together");
        Id target = 0;
        if (isPerTexel(artifact.kind)) {
            Result<TexelBake> texels = readTexels(reader, part);
            if (!texels)
                return texels.error();
            target = texels->material;
            artifact.texels.push_back(std::move(*texels));
        } else {
            Result<VertexBake> vertices = readVertices(reader, part);
            if (!vertices)
                return vertices.error();
            target = vertices->mesh;
            artifact.vertices.push_back(std::move(*vertices));
        }
        if (!seen.insert(target).second)
            return damagedBake(file, "two parts have the same target");
    }
    return artifact;
}

Result<BakeElements> elementsFromPart(const ImagePart& part, const BakeHeader& header,
                                      const std::filesystem::path& file) {
    const bool transfer = holdsTransfer(header.artifact.kind);
    const int order = transfer ? header.artifact.order : 0;
    auto count = static_cast<std::size_t>(part.image.width()) *
                 static_cast<std::size_t>(part.image.height());
    if (!isPerTexel(header.artifact.kind)) {
        const auto vertices = numberAttribute(part.attributes, kVertexCountAttribute, 1, 1ll << 32);
        if (!vertices)
            return damagedBake(file, "the number of vertices is wrong");
        count = static_cast<std::size_t>(*vertices);
    }
    const auto bands = static_cast<std::size_t>(order);
    BakeSteps steps;
    if (header.options.storage == BakeStorage::Quantised) {
        auto values = floatsAttribute(part.attributes, kStepsOfValues, bands);
        auto bounced = floatsAttribute(part.attributes, kStepsOfBounced, bands);
        if (!values || (hasBounced(part.image) && !bounced))
            return damagedBake(file, "the steps of its quantised numbers are missing");
        steps.values = *std::move(values);
        if (bounced)
            steps.bounced = *std::move(bounced);
    }
    std::optional<BakeElements> elements =
        elementsFromImage(part.image, header.artifact.kind, order, count, steps);
    if (!elements)
        return damagedBake(file, "elements or channels are missing, or are not those of its kind");
    if (transfer && elements->bounced.empty() &&
        header.artifact.transfer == TransferKind::Interreflected)
        return damagedBake(file, "the channels of its bounces are missing");
    if (!plausible(*elements, header.artifact.kind))
        return damagedBake(file, "a value is out of range");
    const std::string* hash = findAttribute(part.attributes, kContentHash);
    if (header.version > 1 && (hash == nullptr || *hash != hashContent(part).hex()))
        return damagedBake(file, "it was changed after it had been written");
    return *std::move(elements);
}

} // namespace patina
