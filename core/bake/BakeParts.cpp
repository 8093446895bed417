#include "core/bake/BakeParts.h"

#include "core/document/Document.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <set>
#include <span>

namespace patina {
namespace {

// Attribute names; all values are text.
constexpr const char* kFormat = "patina:format";
constexpr const char* kFormatName = "patina-bake";
constexpr const char* kVersion = "patina:version";
constexpr const char* kKind = "patina:kind";
constexpr const char* kInputs = "patina:inputHash";
constexpr const char* kSamples = "patina:samplesDone";
constexpr const char* kOrder = "patina:order";
constexpr const char* kBasis = "patina:basis";
constexpr const char* kTransfer = "patina:transfer";
constexpr const char* kTarget = "patina:target";
constexpr const char* kIndex = "patina:index";
constexpr const char* kMeshHash = "patina:meshHash";
constexpr const char* kVertexCount = "patina:vertexCount";
constexpr const char* kSettingPrefix = "patina:set.";

struct KindName {
    BakeKind kind;
    const char* name;
};
constexpr KindName kKinds[] = {{BakeKind::AoTexel, "ao-texel"},
                               {BakeKind::AoVertex, "ao-vertex"},
                               {BakeKind::PrtVertex, "prt-vertex"},
                               {BakeKind::PrtTexel, "prt-texel"}};

constexpr const char* kBasisText =
    "real spherical harmonics with Condon-Shortley phase (Y_1,1 = -0.48860 x), orthonormal, index "
    "l(l+1)+m, zonal axis z; world axes right-handed, +Y up";
constexpr const char* kTransferText =
    "T_i = integral over the sphere of V(w) max(0, n.w) Y_i(w) dw / pi; albedo not included: exit "
    "radiance = albedo * sum L_i T_i with L_i = integral L(w) Y_i(w) dw";
constexpr const char* kAoText =
    "ambient visibility: integral of V(w) max(0, n.w) dw / pi, 1 is open, 0 is closed";

using Attributes = std::map<std::string, std::string>;

// The names of the parts: the elements', numbered where they repeat.
template <class Element>
std::vector<std::string> partNames(const std::vector<Element>& elements) {
    std::vector<std::string> names;
    std::set<std::string> taken;
    for (const Element& element : elements) {
        const std::string base = element.name.empty() ? "unnamed" : element.name;
        std::string name = base;
        for (int number = 2; !taken.insert(name).second; ++number)
            name = fmt::format("{}#{}", base, number);
        names.push_back(std::move(name));
    }
    return names;
}

template <class Element>
std::optional<std::size_t> indexOf(const std::vector<Element>& elements, Id id) {
    const auto found = std::find_if(elements.begin(), elements.end(),
                                    [id](const Element& e) { return e.id == id; });
    if (found == elements.end())
        return std::nullopt;
    return static_cast<std::size_t>(found - elements.begin());
}

std::vector<std::string> channelNames(const BakeArtifact& artifact) {
    if (!holdsTransfer(artifact.kind))
        return {"ao"};
    std::vector<std::string> names;
    for (int l = 0; l < artifact.order; ++l)
        for (int m = -l; m <= l; ++m)
            names.push_back(fmt::format("sh.l{}m{}", l, m));
    return names;
}

Attributes commonAttributes(const BakeArtifact& artifact) {
    Attributes attributes = {{kFormat, kFormatName},
                             {kVersion, std::to_string(kBakeFormatVersion)},
                             {kInputs, artifact.inputs.hex()},
                             {kSamples, std::to_string(artifact.samplesDone)}};
    for (const KindName& kind : kKinds)
        if (kind.kind == artifact.kind)
            attributes[kKind] = kind.name;
    if (holdsTransfer(artifact.kind)) {
        attributes[kOrder] = std::to_string(artifact.order);
        attributes[kBasis] = kBasisText;
        attributes[kTransfer] = kTransferText;
    } else {
        attributes[kTransfer] = kAoText;
    }
    for (const auto& [key, value] : artifact.settings)
        attributes[kSettingPrefix + key] = value;
    return attributes;
}

Image vertexImage(const BakeArtifact& artifact, const VertexBake& bake) {
    const std::size_t count = bake.values.size() / static_cast<std::size_t>(bake.stride);
    const std::size_t width = std::min<std::size_t>(count, kMaxBakeRow);
    const std::size_t height = (count + width - 1) / width;
    Image image(static_cast<int>(width), static_cast<int>(height), bake.stride, PixelType::F32,
                ColorEncoding::Linear);
    std::copy(bake.values.begin(), bake.values.end(), image.f32().begin());
    image.setChannelNames(channelNames(artifact));
    return image;
}

Image texelImage(const BakeArtifact& artifact, const TexelBake& bake) {
    Image image = bake.image ? convertImage(*bake.image, PixelType::F32, bake.image->encoding())
                             : Image(bake.side, bake.side, bake.stride, PixelType::F32,
                                     ColorEncoding::Linear);
    if (!bake.image)
        std::copy(bake.values.begin(), bake.values.end(), image.f32().begin());
    image.setChannelNames(channelNames(artifact));
    return image;
}

// Reading.

struct Reader {
    const std::filesystem::path& file;
    const Document& document;

    [[nodiscard]] Error error(std::string message) const {
        return {ErrorKind::InputBroken, std::move(message), file, {}};
    }
    [[nodiscard]] Error damaged(const std::string& what) const {
        return error(fmt::format("the bake is damaged ({}); bake it anew", what));
    }
};

const std::string* find(const Attributes& attributes, const std::string& key) {
    const auto found = attributes.find(key);
    return found == attributes.end() ? nullptr : &found->second;
}

std::optional<long long> number(const Attributes& attributes, const char* key, long long low,
                                long long high) {
    const std::string* text = find(attributes, key);
    long long value = 0;
    if (!text)
        return std::nullopt;
    const auto [end, code] = std::from_chars(text->data(), text->data() + text->size(), value);
    if (code != std::errc() || end != text->data() + text->size() || value < low || value > high)
        return std::nullopt;
    return value;
}

std::optional<Hash> parseHash(const std::string& hex) {
    Hash hash;
    if (hex.size() != 32)
        return std::nullopt;
    for (std::uint64_t* half : {&hash.high, &hash.low}) {
        const char* begin = hex.data() + (half == &hash.high ? 0 : 16);
        const auto [end, code] = std::from_chars(begin, begin + 16, *half, 16);
        if (code != std::errc() || end != begin + 16)
            return std::nullopt;
    }
    return hash;
}

// What all parts have in common, from the first.
Result<BakeArtifact> readHeader(const Reader& reader, const Attributes& attributes) {
    const std::string* format = find(attributes, kFormat);
    if (!format || *format != kFormatName)
        return reader.error("the file is no bake of Patina; choose a file that \"patina bake\" or "
                            "the editor wrote");
    const auto version = number(attributes, kVersion, 1, 1'000'000);
    if (!version)
        return reader.damaged("no version");
    if (*version > kBakeFormatVersion)
        return reader.error("the bake was made by a newer Patina; update Patina or bake it anew");
    BakeArtifact artifact;
    const std::string* kind = find(attributes, kKind);
    const auto known = std::find_if(std::begin(kKinds), std::end(kKinds),
                                    [&](const KindName& k) { return kind && *kind == k.name; });
    if (known == std::end(kKinds))
        return reader.damaged("unknown kind");
    artifact.kind = known->kind;
    const std::string* inputs = find(attributes, kInputs);
    const std::optional<Hash> hash = inputs ? parseHash(*inputs) : std::nullopt;
    const auto samples = number(attributes, kSamples, 0, 1 << 30);
    if (!hash || !samples)
        return reader.damaged("attributes are missing");
    artifact.inputs = *hash;
    artifact.samplesDone = static_cast<int>(*samples);
    if (holdsTransfer(artifact.kind)) {
        const auto order = number(attributes, kOrder, 1, 5);
        if (!order)
            return reader.damaged("the order is not 1 to 5");
        artifact.order = static_cast<int>(*order);
    }
    for (const auto& [key, value] : attributes)
        if (key.starts_with(kSettingPrefix))
            artifact.settings[key.substr(std::strlen(kSettingPrefix))] = value;
    return artifact;
}

// By name; by position when nothing has that name any more.
template <class Element>
std::optional<std::size_t> targetOf(const std::vector<Element>& elements,
                                    const Attributes& attributes) {
    const std::vector<std::string> names = partNames(elements);
    if (const std::string* target = find(attributes, kTarget))
        if (const auto named = std::find(names.begin(), names.end(), *target); named != names.end())
            return static_cast<std::size_t>(named - names.begin());
    const auto index = number(attributes, kIndex, 0, 1 << 30);
    if (!index || static_cast<std::size_t>(*index) >= elements.size())
        return std::nullopt;
    return static_cast<std::size_t>(*index);
}

bool allValuesFit(std::span<const float> values, BakeKind kind) {
    return std::all_of(values.begin(), values.end(), [kind](float v) {
        return std::isfinite(v) && (holdsTransfer(kind) || (v >= 0.0f && v <= 1.0f));
    });
}

// The samples of a part in the order of `names`, interleaved: EXR readers sort channels as they
// like.
std::optional<std::vector<float>> channelsInOrder(const Image& image,
                                                  const std::vector<std::string>& names) {
    if (image.type() != PixelType::F32 ||
        static_cast<std::size_t>(image.channels()) != names.size() ||
        image.channelNames().size() != names.size())
        return std::nullopt;
    const std::size_t stride = names.size(), count = image.f32().size() / stride;
    std::vector<float> values(image.f32().size());
    for (std::size_t c = 0; c < stride; ++c) {
        const auto found =
            std::find(image.channelNames().begin(), image.channelNames().end(), names[c]);
        if (found == image.channelNames().end())
            return std::nullopt;
        const auto source = static_cast<std::size_t>(found - image.channelNames().begin());
        for (std::size_t i = 0; i < count; ++i)
            values[i * stride + c] = image.f32()[i * stride + source];
    }
    return values;
}

Result<VertexBake> readVertices(const Reader& reader, const BakeArtifact& artifact,
                                const ImagePart& part) {
    const std::optional<std::size_t> target = targetOf(reader.document.meshes, part.attributes);
    const std::string* hash = find(part.attributes, kMeshHash);
    if (!target || !hash || !reader.document.meshes[*target].mesh ||
        hashMesh(*reader.document.meshes[*target].mesh).hex() != *hash)
        return reader.error("the bake belongs to other geometry; open the scene it was made from, "
                            "or bake this one");
    const MeshInstance& mesh = reader.document.meshes[*target];
    std::optional<std::vector<float>> values = channelsInOrder(part.image, channelNames(artifact));
    const auto count = number(part.attributes, kVertexCount, 1, 1ll << 32);
    const std::size_t stride = channelNames(artifact).size();
    if (!values || !count || static_cast<std::size_t>(*count) != mesh.mesh->vertexCount() ||
        values->size() < static_cast<std::size_t>(*count) * stride)
        return reader.damaged("vertices or channels are missing");
    values->resize(static_cast<std::size_t>(*count) * stride);
    if (!allValuesFit(*values, artifact.kind))
        return reader.damaged("a value is out of range");
    return VertexBake{mesh.id, static_cast<int>(stride), std::move(*values)};
}

Result<TexelBake> readTexels(const Reader& reader, const BakeArtifact& artifact,
                             const ImagePart& part) {
    const std::optional<std::size_t> target = targetOf(reader.document.materials, part.attributes);
    if (!target)
        return reader.error("the bake belongs to a material that the scene does not have; open the "
                            "scene it was made from, or bake this one");
    const std::vector<std::string> channels = channelNames(artifact);
    std::optional<std::vector<float>> values = channelsInOrder(part.image, channels);
    if (!values || part.image.width() != part.image.height())
        return reader.damaged("the texture is not square or lacks its channel");
    if (!allValuesFit(*values, artifact.kind))
        return reader.damaged("a value is out of range");
    if (holdsTransfer(artifact.kind))
        return TexelBake{reader.document.materials[*target].id, nullptr, part.image.width(),
                         static_cast<int>(channels.size()), *std::move(values)};
    auto image = std::make_shared<Image>(part.image.width(), part.image.height(), 1, PixelType::F32,
                                         ColorEncoding::Data);
    std::copy(values->begin(), values->end(), image->f32().begin());
    return TexelBake{reader.document.materials[*target].id, std::move(image)};
}

} // namespace

std::vector<ImagePart> bakeToParts(const BakeArtifact& artifact, const Document& document) {
    const Attributes common = commonAttributes(artifact);
    const std::vector<std::string> meshNames = partNames(document.meshes);
    const std::vector<std::string> materialNames = partNames(document.materials);
    std::vector<ImagePart> parts;
    for (const VertexBake& bake : artifact.vertices) {
        const std::optional<std::size_t> index = indexOf(document.meshes, bake.mesh);
        if (!index || !document.meshes[*index].mesh || bake.values.empty() ||
            document.meshes[*index].mesh->vertexCount() * static_cast<std::size_t>(bake.stride) !=
                bake.values.size())
            continue;
        ImagePart& part = parts.emplace_back();
        part.name = meshNames[*index];
        part.image = vertexImage(artifact, bake);
        part.attributes = common;
        part.attributes[kTarget] = part.name;
        part.attributes[kIndex] = std::to_string(*index);
        part.attributes[kMeshHash] = hashMesh(*document.meshes[*index].mesh).hex();
        part.attributes[kVertexCount] = std::to_string(document.meshes[*index].mesh->vertexCount());
    }
    for (const TexelBake& bake : artifact.texels) {
        const std::optional<std::size_t> index = indexOf(document.materials, bake.material);
        if (!index || (!bake.image && bake.values.empty()))
            continue;
        ImagePart& part = parts.emplace_back();
        part.name = materialNames[*index];
        part.image = texelImage(artifact, bake);
        part.attributes = common;
        part.attributes[kTarget] = part.name;
        part.attributes[kIndex] = std::to_string(*index);
    }
    if (parts.empty()) {
        ImagePart& part = parts.emplace_back();
        part.image = Image(1, 1, 1, PixelType::F32, ColorEncoding::Linear);
        part.attributes = common;
    }
    return parts;
}

Result<BakeArtifact> bakeFromParts(const std::vector<ImagePart>& parts, const Document& document,
                                   const std::filesystem::path& file) {
    const Reader reader{file, document};
    if (parts.empty())
        return reader.damaged("it is empty");
    Result<BakeArtifact> artifact = readHeader(reader, parts.front().attributes);
    if (!artifact)
        return artifact;
    const Attributes common = commonAttributes(*artifact);
    std::set<Id> seen;
    for (const ImagePart& part : parts) {
        if (parts.size() == 1 && !find(part.attributes, kTarget))
            break; // nothing of it was left when it was saved
        for (const auto& [key, value] : common) {
            const std::string* own = find(part.attributes, key);
            if (!own || *own != value)
                return reader.damaged("its parts do not belong together");
        }
        Id target = 0;
        if (isPerTexel(artifact->kind)) {
            Result<TexelBake> texels = readTexels(reader, *artifact, part);
            if (!texels)
                return texels.error();
            target = texels->material;
            artifact->texels.push_back(std::move(*texels));
        } else {
            Result<VertexBake> vertices = readVertices(reader, *artifact, part);
            if (!vertices)
                return vertices.error();
            target = vertices->mesh;
            artifact->vertices.push_back(std::move(*vertices));
        }
        if (!seen.insert(target).second)
            return reader.damaged("two parts have the same target");
    }
    return artifact;
}

} // namespace patina
