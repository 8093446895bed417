#include "core/bake/file/BakeHeader.h"

#include "core/bake/domain/BakeOptions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fmt/format.h>

namespace patina {
namespace {

constexpr const char* kFormat = "patina:format";
constexpr const char* kFormatName = "patina-bake";
constexpr const char* kVersionAttribute = "patina:version";
constexpr const char* kKind = "patina:kind";
constexpr const char* kInputs = "patina:inputHash";
constexpr const char* kAlbedo = "patina:albedoHash";
constexpr const char* kLight = "patina:lightHash";
constexpr const char* kSamples = "patina:samplesDone";
constexpr const char* kOrder = "patina:order";
constexpr const char* kBasis = "patina:basis";
constexpr const char* kDefinition = "patina:definition";
constexpr const char* kTransfer = "patina:transfer"; // version 1: the definition
constexpr const char* kBounces = "patina:bounces";
constexpr const char* kStorage = "patina:storage";
constexpr const char* kBits = "patina:bits";
constexpr const char* kSettingPrefix = "patina:set.";

struct KindName {
    BakeKind kind;
    const char* name;
};
constexpr KindName kKinds[] = {{BakeKind::AoTexel, "ao-texel"},
                               {BakeKind::AoVertex, "ao-vertex"},
                               {BakeKind::PrtVertex, "prt-vertex"},
                               {BakeKind::PrtTexel, "prt-texel"},
                               {BakeKind::LightMap, "light-map"}};

struct TransferName {
    TransferKind kind;
    const char* name;
};
constexpr TransferName kTransfers[] = {{TransferKind::Unshadowed, "unshadowed"},
                                       {TransferKind::Shadowed, "shadowed"},
                                       {TransferKind::Interreflected, "interreflected"}};

constexpr const char* kBasisText =
    "real spherical harmonics with Condon-Shortley phase (Y_1,1 = -0.48860 x), orthonormal, index "
    "l(l+1)+m, zonal axis z; world axes right-handed, +Y up";
constexpr const char* kTransferText =
    "T_i (sh) = integral over the sphere of V(w) max(0, n.w) Y_i(w) dw / pi; B_i (bounced) = the "
    "same light by way of other surfaces; the albedo of the surface itself is not included: exit "
    "radiance = albedo * sum L_i (T_i + B_i) with L_i = integral L(w) Y_i(w) dw";
constexpr const char* kAoText =
    "ambient visibility: integral of V(w) max(0, n.w) dw / pi, 1 is open, 0 is closed";

constexpr const char* kLightMapText =
    "irradiance: to be added to that of the environment; radiance = sum of radiance_i Y_i(r), r "
    "the mirror direction of the view: to be added to the prefiltered radiance times 1 - sum of "
    "hidden_i Y_i(r); visibility: ambient; open: integral of V(w) w max(0, n.w) dw / pi; straight "
    "light of lights is not included; Rec. 709, linear";

// What belongs to a part of its own rather than to the bake.
constexpr std::array<const char*, 10> kOfParts = {
    "patina:target",       "patina:index",         "patina:meshHash", "patina:vertexCount",
    "patina:transform",    "patina:triangleCount", "patina:step.sh",  "patina:step.bounced",
    "patina:storageError", "patina:contentHash"};

bool ofPart(const std::string& key) {
    return key.starts_with("patina:meshHash.") || key.starts_with("patina:source.") ||
           std::find(kOfParts.begin(), kOfParts.end(), key) != kOfParts.end();
}

std::optional<Hash> parseHash(const std::string* hex) {
    Hash hash;
    if (hex == nullptr || hex->size() != 32)
        return std::nullopt;
    for (std::uint64_t* half : {&hash.high, &hash.low}) {
        const char* begin = hex->data() + (half == &hash.high ? 0 : 16);
        const auto [end, code] = std::from_chars(begin, begin + 16, *half, 16);
        if (code != std::errc() || end != begin + 16)
            return std::nullopt;
    }
    return hash;
}

// Order, transport and storage; all of it came with version 2 but the order.
std::optional<Error> readTransfer(const BakeAttributes& attributes, BakeHeader& header,
                                  const std::filesystem::path& file) {
    BakeArtifact& artifact = header.artifact;
    const bool first = header.version == 1;
    const int maxOrder = first ? 5 : 8;
    const auto order = numberAttribute(attributes, kOrder, 1, maxOrder);
    if (!order)
        return damagedBake(file, fmt::format("the order is not 1 to {}", maxOrder));
    artifact.order = static_cast<int>(*order);
    if (first)
        return std::nullopt;
    const std::string* transfer = findAttribute(attributes, kTransfer);
    const auto known =
        std::find_if(std::begin(kTransfers), std::end(kTransfers),
                     [&](const TransferName& t) { return transfer && *transfer == t.name; });
    if (known == std::end(kTransfers))
        return damagedBake(file, "the kind of transfer is unknown");
    artifact.transfer = known->kind;
    if (known->kind == TransferKind::Interreflected) {
        const auto bounces = numberAttribute(attributes, kBounces, 1, 64);
        const std::optional<Hash> albedo = parseHash(findAttribute(attributes, kAlbedo));
        if (!bounces || !albedo)
            return damagedBake(file, "attributes of the bounces are missing");
        artifact.bounces = static_cast<int>(*bounces);
        artifact.albedo = *albedo;
    }
    return std::nullopt;
}

std::optional<Error> readStorage(const BakeAttributes& attributes, BakeHeader& header,
                                 const std::filesystem::path& file) {
    const std::string* name = findAttribute(attributes, kStorage);
    const std::optional<BakeStorage> storage = name ? storageNamed(*name) : std::nullopt;
    if (!storage)
        return damagedBake(file, "it does not say how its numbers are stored");
    header.options.storage = *storage;
    if (*storage == BakeStorage::Quantised) {
        const auto bits = numberAttribute(attributes, kBits, kMinStorageBits, kMaxStorageBits);
        if (!bits || !holdsTransfer(header.artifact.kind))
            return damagedBake(file, "it does not say how its numbers are stored");
        header.options.bits = static_cast<int>(*bits);
    }
    return std::nullopt;
}

} // namespace

BakeAttributes headerAttributes(const BakeArtifact& artifact, const BakeFileOptions& options) {
    BakeAttributes attributes = {{kFormat, kFormatName},
                                 {kVersionAttribute, std::to_string(kBakeFormatVersion)},
                                 {kInputs, artifact.inputs.hex()},
                                 {kSamples, std::to_string(artifact.samplesDone)},
                                 {kStorage, storageName(options.storage)}};
    for (const KindName& kind : kKinds)
        if (kind.kind == artifact.kind)
            attributes[kKind] = kind.name;
    if (options.storage == BakeStorage::Quantised)
        attributes[kBits] = std::to_string(options.bits);
    if (holdsTransfer(artifact.kind)) {
        attributes[kOrder] = std::to_string(artifact.order);
        attributes[kBasis] = kBasisText;
        attributes[kDefinition] = kTransferText;
        for (const TransferName& transfer : kTransfers)
            if (transfer.kind == artifact.transfer)
                attributes[kTransfer] = transfer.name;
        if (artifact.transfer == TransferKind::Interreflected) {
            attributes[kBounces] = std::to_string(artifact.bounces);
            attributes[kAlbedo] = artifact.albedo.hex();
        }
    } else if (artifact.kind == BakeKind::LightMap) {
        attributes[kBasis] = kBasisText;
        attributes[kDefinition] = kLightMapText;
        attributes[kLight] = artifact.light.hex();
    } else {
        attributes[kDefinition] = kAoText;
    }
    for (const auto& [key, value] : recordOf(artifact))
        attributes[kSettingPrefix + key] = value;
    return attributes;
}

Result<BakeHeader> readBakeHeader(const BakeAttributes& attributes,
                                  const std::filesystem::path& file) {
    if (!isBakeFile(attributes))
        return Error{ErrorKind::InputBroken,
                     "the file is no bake of Patina; choose a file that \"patina bake\" or the "
                     "editor wrote",
                     file,
                     {}};
    const auto version = numberAttribute(attributes, kVersionAttribute, 1, 1'000'000);
    if (!version)
        return damagedBake(file, "no version");
    if (*version > kBakeFormatVersion)
        return Error{ErrorKind::InputBroken,
                     "the bake was made by a newer Patina; update Patina or bake it anew",
                     file,
                     {}};
    BakeHeader header;
    header.version = static_cast<int>(*version);
    const std::string* kind = findAttribute(attributes, kKind);
    const auto known = std::find_if(std::begin(kKinds), std::end(kKinds),
                                    [&](const KindName& k) { return kind && *kind == k.name; });
    if (known == std::end(kKinds))
        return damagedBake(file, "unknown kind");
    BakeArtifact& artifact = header.artifact;
    artifact.kind = known->kind;
    const std::optional<Hash> hash = parseHash(findAttribute(attributes, kInputs));
    const auto samples = numberAttribute(attributes, kSamples, 0, 1 << 30);
    if (!hash || !samples)
        return damagedBake(file, "attributes are missing");
    artifact.inputs = *hash;
    artifact.samplesDone = static_cast<int>(*samples);
    if (holdsTransfer(artifact.kind))
        if (std::optional<Error> error = readTransfer(attributes, header, file))
            return *error;
    if (artifact.kind == BakeKind::LightMap) {
        const std::optional<Hash> light = parseHash(findAttribute(attributes, kLight));
        if (!light)
            return damagedBake(file, "attributes are missing");
        artifact.light = *light;
    }
    if (header.version > 1)
        if (std::optional<Error> error = readStorage(attributes, header, file))
            return *error;
    std::map<std::string, std::string> record;
    for (const auto& [key, value] : attributes)
        if (key.starts_with(kSettingPrefix))
            record[key.substr(std::strlen(kSettingPrefix))] = value;
    setRecord(artifact, std::move(record));
    return header;
}

bool sameHeader(const BakeAttributes& a, const BakeAttributes& b) {
    const auto contains = [](const BakeAttributes& all, const BakeAttributes& some) {
        return std::all_of(some.begin(), some.end(), [&](const auto& attribute) {
            const std::string* own = findAttribute(all, attribute.first);
            return !attribute.first.starts_with("patina:") || ofPart(attribute.first) ||
                   (own != nullptr && *own == attribute.second);
        });
    };
    return contains(a, b) && contains(b, a);
}

bool isBakeFile(const BakeAttributes& attributes) {
    const std::string* format = findAttribute(attributes, kFormat);
    return format != nullptr && *format == kFormatName;
}

const std::string* findAttribute(const BakeAttributes& attributes, const std::string& key) {
    const auto found = attributes.find(key);
    return found == attributes.end() ? nullptr : &found->second;
}

std::optional<long long> numberAttribute(const BakeAttributes& attributes, const std::string& key,
                                         long long low, long long high) {
    const std::string* text = findAttribute(attributes, key);
    long long value = 0;
    if (text == nullptr)
        return std::nullopt;
    const char* last = text->data() + text->size();
    const auto [end, code] = std::from_chars(text->data(), last, value);
    if (code != std::errc() || end != last || value < low || value > high)
        return std::nullopt;
    return value;
}

std::optional<std::vector<float>> floatsAttribute(const BakeAttributes& attributes,
                                                  const std::string& key, std::size_t count) {
    const std::string* text = findAttribute(attributes, key);
    if (text == nullptr)
        return std::nullopt;
    std::vector<float> values;
    const char *next = text->data(), *last = next + text->size();
    while (next != last && values.size() <= count) {
        float value = 0.0f;
        const auto [end, code] = std::from_chars(next, last, value);
        if (code != std::errc() || !std::isfinite(value) || (end != last && *end != ' '))
            return std::nullopt;
        values.push_back(value);
        next = end == last ? end : end + 1;
    }
    if (values.size() != count)
        return std::nullopt;
    return values;
}

std::string floatsText(std::span<const float> values) {
    return fmt::format("{}", fmt::join(values, " "));
}

Error damagedBake(const std::filesystem::path& file, const std::string& what) {
    return {ErrorKind::InputBroken,
            fmt::format("the bake is damaged ({}); bake it anew", what),
            file,
            {}};
}

} // namespace patina
