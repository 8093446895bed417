#include "app/cli/BakeInfo.h"

#include "core/bake/document/BakeStaleness.h"
#include "core/bake/domain/BakeOptions.h"
#include "core/bake/file/BakeHeader.h"
#include "core/bake/file/BakeParts.h"
#include "core/bake/file/BakeTarget.h"
#include "core/bake/study/TransferStatistics.h"
#include "core/bake/transfer/BakeCheckpoint.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::cli {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::pair<std::string, std::string>>;

bool hasChannel(const Image& image, std::string_view prefix, std::string_view suffix = {}) {
    const std::vector<std::string>& names = image.channelNames();
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return name.starts_with(prefix) && name.ends_with(suffix);
    });
}

// "as halves", "in 8 bits, a step for each band"
std::string storageText(const BakeFileOptions& options) {
    switch (options.storage) {
    case BakeStorage::Float:
        return "32-bit floats, exact";
    case BakeStorage::Half:
        return "16-bit floats";
    case BakeStorage::Quantised:
        break;
    }
    return fmt::format("{} bits, a step for each band", options.bits);
}

// How the elements of a part see the sky, and what each band holds: "statistics".
std::string describeStatistics(const BakeElements& elements, int order, Json& json) {
    const TransferStatistics s = transferStatistics(elements.values, elements.bounced, order);
    json["statistics"] = {{"elements", s.elements},
                          {"dark", s.dark},
                          {"skyVisibility",
                           {{"lowest", s.lowestVisibility},
                            {"mean", s.meanVisibility},
                            {"highest", s.highestVisibility}}},
                          {"bandShares", s.bandShares}};
    std::string text = fmt::format("; sky visibility {:.1f} to {:.1f} %, {:.1f} % in the mean; "
                                   "bands hold",
                                   100.0f * s.lowestVisibility, 100.0f * s.highestVisibility,
                                   100.0 * s.meanVisibility);
    for (const double share : s.bandShares)
        text += fmt::format(" {:.3g}", 100.0 * share);
    return text + " % of the squares";
}

Result<std::pair<Json, std::string>> describePart(const ImagePart& part, const BakeHeader& header,
                                                  const std::filesystem::path& file) {
    const std::string* target = findAttribute(part.attributes, kTargetAttribute);
    Json json = {{"target", target != nullptr ? *target : part.name}};
    std::string text;
    if (isPerTexel(header.artifact.kind)) {
        json["size"] = part.image.width();
        text = fmt::format("{0} × {0} texels", part.image.width());
    } else if (const auto count =
                   numberAttribute(part.attributes, kVertexCountAttribute, 0, 1ll << 32)) {
        json["vertices"] = *count;
        text = fmt::format("{} vertices", countText(static_cast<std::size_t>(*count)));
    }
    if (const bool bounced = hasChannel(part.image, "bounced.");
        holdsTransfer(header.artifact.kind)) {
        const bool colored = bounced && hasChannel(part.image, "bounced.", ".R");
        json["bounced"] = !bounced ? "none" : colored ? "color" : "grey";
        if (bounced)
            text += colored ? ", coloured bounces" : ", grey bounces";
        json["sky"] = hasChannel(part.image, "sky");
        json["error"] = hasChannel(part.image, "error");
        if (!hasChannel(part.image, "sky"))
            text += ", nothing for the view Sky Visibility";
        if (hasChannel(part.image, "error"))
            text += ", error estimates";
    }
    if (const std::string* error = findAttribute(part.attributes, "patina:storageError")) {
        json["storageError"] = *error;
        text += "; stored with " + *error;
    }
    // A bake of which nothing was left when it was saved has a part without a target.
    if (holdsTransfer(header.artifact.kind) && target != nullptr) {
        const Result<BakeElements> elements = elementsFromPart(part, header, file);
        if (!elements)
            return elements.error();
        text += describeStatistics(*elements, header.artifact.order, json);
    }
    return std::pair(std::move(json), std::move(text));
}

} // namespace

const char* kindText(BakeKind kind) {
    switch (kind) {
    case BakeKind::AoTexel:
        return "ambient occlusion per texel";
    case BakeKind::AoVertex:
        return "ambient occlusion per vertex";
    case BakeKind::PrtVertex:
        return "radiance transfer per vertex";
    case BakeKind::LightMap:
        return "light map";
    case BakeKind::PrtTexel:
        break;
    }
    return "radiance transfer per texel";
}

Result<void> describeBake(Report& report, const std::vector<ImagePart>& parts,
                          const std::filesystem::path& file) {
    const Result<BakeHeader> header = readBakeHeader(parts.front().attributes, file);
    if (!header)
        return header.error();
    const BakeArtifact& artifact = header->artifact;
    Json json = {{"kind", kindText(artifact.kind)},
                 {"version", header->version},
                 {"samplesDone", artifact.samplesDone},
                 {"inputs", artifact.inputs.hex()},
                 {"storage", storageName(header->options.storage)}};
    Rows rows = {{"holds", kindText(artifact.kind)}};
    if (holdsTransfer(artifact.kind)) {
        const std::string* transfer = findAttribute(parts.front().attributes, "patina:transfer");
        const std::string name = header->version == 1 ? "shadowed" : *transfer;
        json["order"] = artifact.order;
        json["transfer"] = name;
        rows.emplace_back("bands", fmt::format("{} ({} coefficients)", artifact.order,
                                               artifact.order * artifact.order));
        rows.emplace_back("transfer", artifact.transfer == TransferKind::Interreflected
                                          ? fmt::format("{}, {} bounce{}", name, artifact.bounces,
                                                        artifact.bounces == 1 ? "" : "s")
                                          : name);
        if (artifact.transfer == TransferKind::Interreflected) {
            json["bounces"] = artifact.bounces;
            json["albedo"] = artifact.albedo.hex();
        }
    }
    if (header->options.storage == BakeStorage::Quantised)
        json["bits"] = header->options.bits;
    const std::optional<StoppedBake> stopped = stoppedEarly(artifact);
    if (stopped)
        json["samplesAsked"] = stopped->asked;
    rows.emplace_back("rays", !restsOnRays(artifact) ? "none: it is in closed form"
                              : stopped ? fmt::format("{} of {} per element: it was stopped",
                                                      stopped->done, stopped->asked)
                                        : fmt::format("{} per element", artifact.samplesDone));
    rows.emplace_back("stored as", storageText(header->options));
    rows.emplace_back("inputs", artifact.inputs.hex());
    report.table({}, rows);

    rows.clear();
    for (const auto& [key, value] : recordOf(artifact)) {
        json["settings"][key] = value;
        rows.emplace_back(key, value);
    }
    if (!rows.empty())
        report.table("Settings", rows);
    rows.clear();
    for (const ImagePart& part : parts) {
        if (!sameHeader(parts.front().attributes, part.attributes))
            return damagedBake(file, "its parts do not belong together");
        Result<std::pair<Json, std::string>> described = describePart(part, *header, file);
        if (!described)
            return described.error();
        auto& [entry, text] = *described;
        rows.emplace_back(entry["target"].get<std::string>(), std::move(text));
        json["parts"].push_back(std::move(entry));
    }
    report.table(fmt::format("Parts ({})", rows.size()), rows);
    report.json()["bake"] = std::move(json);
    return {};
}

Result<void> describeUnfinishedBake(Report& report, const std::filesystem::path& file) {
    const Result<BakeManifest> manifest = readBakeManifest(file);
    if (!manifest)
        return manifest.error();
    const BakeManifest& m = *manifest;
    const bool whole = m.shard.count == 1;
    // A checkpoint is kept until its last ray is cast; what parts are joined from is complete.
    const char* kind = m.complete ? "part" : "checkpoint";
    Json json = {{"holds", kindText(m.kind)},
                 {"points", m.points},
                 {"samplesDone", m.samplesDone},
                 {"done", m.done},
                 {"complete", m.complete},
                 {"shard", {{"part", m.shard.index + 1}, {"of", m.shard.count}}},
                 {"scene", m.scene},
                 {"inputs", m.inputs.hex()}};
    Rows rows = {
        {"kind", m.complete ? "part of a bake, complete" : "checkpoint of a bake, unfinished"},
        {"holds", kindText(m.kind)},
        {"part", whole ? "1 of 1, the whole surface"
                       : fmt::format("{} of {}", m.shard.index + 1, m.shard.count)},
        {"points", fmt::format("{}{}", countText(static_cast<std::size_t>(m.points)),
                               whole ? "" : " in all parts together")},
        {"done", fmt::format("{:.0f} % of its rays; every point has {} or more",
                             std::floor(100.0 * m.done), m.samplesDone)},
        {"scene", m.scene.empty() ? "the editor's document" : m.scene},
        {"inputs", m.inputs.hex()}};
    if (m.kind == BakeKind::LightMap) {
        const std::string environment = m.environment.empty() ? "the scene's own" : m.environment;
        json["environment"] = environment;
        rows.emplace_back("environment", environment);
    }
    if (!m.sets.empty())
        rows.emplace_back("with", fmt::format("{}", fmt::join(m.sets, ", ")));
    rows.emplace_back("goes on with",
                      m.complete ? "patina merge, with the other parts"
                      : m.kind == BakeKind::LightMap
                          ? "the command that began it, and --resume"
                          : "the command that began it, and --resume; or in the editor");
    report.table({}, rows);
    rows.clear();
    for (const auto& [key, value] : m.settings) {
        json["settings"][key] = value;
        rows.emplace_back(key, value);
    }
    report.table("Settings", rows);
    report.json()["kind"] = kind;
    report.json()["bake"] = std::move(json);
    return {};
}

} // namespace patina::cli
