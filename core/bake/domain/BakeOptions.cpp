#include "core/bake/domain/BakeOptions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace patina {
namespace {

using Type = BakeOption::Type;

constexpr int kSamples[] = {8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384};
constexpr int kBounceSamples[] = {16, 32, 64, 128, 256};
constexpr int kOrders[] = {1, 2, 3, 4, 5, 6, 7, 8};
constexpr int kHitBudgets[] = {0, 256, 512, 1024, 2048, 4096};
constexpr int kBounces[] = {1, 2, 3, 4, 6, 8, 16, 32, 64};
constexpr int kSizes[] = {256, 512, 1024, 2048, 4096};
constexpr BakeChoice kTransfers[] = {
    {"unshadowed", "Unshadowed"}, {"shadowed", "Shadowed"}, {"interreflected", "Interreflected"}};
constexpr BakeChoice kMethods[] = {
    {"qmc", "Sobol', scrambled"}, {"stratified", "Stratified N × N"}, {"random", "Random"}};

bool ofTransfer(const BakeRequest& request) {
    return holdsTransfer(request.kind);
}
bool ofOcclusion(const BakeRequest& request) {
    return request.kind == BakeKind::AoTexel || request.kind == BakeKind::AoVertex;
}
bool traces(const BakeRequest& request) {
    return !ofTransfer(request) || request.prt.transfer != TransferKind::Unshadowed;
}
bool tracesTransfer(const BakeRequest& request) {
    return ofTransfer(request) && traces(request);
}
bool bounces(const BakeRequest& request) {
    return ofTransfer(request) && request.prt.transfer == TransferKind::Interreflected;
}

constexpr BakeOption advanced(BakeOption option) {
    option.advanced = true;
    return option;
}

constexpr std::array kOptions{
    BakeOption{"transfer",
               "Transport",
               "Unshadowed: the cosine alone. Shadowed: soft shadows of the scene on itself. "
               "Interreflected: also the light that comes by way of other surfaces, in their "
               "colours",
               "",
               Type::Choice,
               0,
               0,
               {},
               kTransfers,
               [](const BakeRequest& r) { return static_cast<double>(r.prt.transfer); },
               [](BakeRequest& r, double v) { r.prt.transfer = static_cast<TransferKind>(v); },
               ofTransfer},
    BakeOption{"order",
               "Bands",
               "Spherical-harmonic bands: 3 gives soft, 5 sharper shadows; memory grows with the "
               "square",
               "",
               Type::Integer,
               1,
               8,
               kOrders,
               {},
               [](const BakeRequest& r) { return static_cast<double>(r.prt.order); },
               [](BakeRequest& r, double v) { r.prt.order = static_cast<int>(v); },
               ofTransfer},
    BakeOption{"samples",
               "Rays",
               "Rays per vertex or texel: more is smoother and slower",
               "",
               Type::Integer,
               1,
               65536,
               kSamples,
               {},
               [](const BakeRequest& r) { return static_cast<double>(samplesOf(r)); },
               [](BakeRequest& r, double v) {
                   r.prt.samples = r.ao.samples = r.lightMap.samples = static_cast<int>(v);
               },
               traces},
    advanced(BakeOption{
        "tolerance",
        "Tolerance",
        "Ends early, once the estimated error of the coefficients (root mean square) is this "
        "or less; after two passes rays go where they reduce it most. 0 casts every ray",
        "",
        Type::Number,
        0,
        1,
        {},
        {},
        [](const BakeRequest& r) { return static_cast<double>(r.prt.tolerance); },
        [](BakeRequest& r, double v) { r.prt.tolerance = static_cast<float>(v); },
        tracesTransfer,
        true,
        "Off"}),
    BakeOption{"bounces",
               "Bounces",
               "How often light may be reflected on its way",
               "",
               Type::Integer,
               1,
               64,
               kBounces,
               {},
               [](const BakeRequest& r) { return static_cast<double>(r.prt.bounces); },
               [](BakeRequest& r, double v) { r.prt.bounces = static_cast<int>(v); },
               bounces},
    advanced(BakeOption{
        "bounceSamples",
        "Bounce rays",
        "Rays per vertex or texel for the bounces. What those of vertices meet is kept, 8 "
        "bytes each, so that another albedo needs no new ray",
        "",
        Type::Integer,
        1,
        65536,
        kBounceSamples,
        {},
        [](const BakeRequest& r) { return static_cast<double>(r.prt.bounceSamples); },
        [](BakeRequest& r, double v) { r.prt.bounceSamples = static_cast<int>(v); },
        bounces}),
    advanced(BakeOption{
        "hitBudget",
        "Hit memory",
        "Memory that the hits of the bounce rays may take; a scene that needs more traces "
        "them anew for every bounce, which is slower and comes to the same. 0: always",
        " MiB",
        Type::Integer,
        0,
        1048576,
        kHitBudgets,
        {},
        [](const BakeRequest& r) { return static_cast<double>(r.prt.hitBudget >> 20); },
        [](BakeRequest& r, double v) { r.prt.hitBudget = static_cast<std::uint64_t>(v) << 20; },
        bounces,
        false}),
    advanced(BakeOption{
        "fitted",
        "Fit to the surface",
        "Fits the values at the vertices to the whole surface by least squares, so that "
        "coarse meshes show shadows in the right place; off: samples at the vertices alone",
        "",
        Type::Toggle,
        0,
        1,
        {},
        {},
        [](const BakeRequest& r) { return r.prt.fitted ? 1.0 : 0.0; },
        [](BakeRequest& r, double v) { r.prt.fitted = v != 0.0; },
        [](const BakeRequest& r) { return r.kind == BakeKind::PrtVertex && traces(r); }}),
    BakeOption{"size",
               "Size",
               "Side of the square texture that each material gets",
               " px",
               Type::Integer,
               1,
               8192,
               kSizes,
               {},
               [](const BakeRequest& r) { return static_cast<double>(textureSizeOf(r)); },
               [](BakeRequest& r, double v) {
                   r.prt.size = r.ao.size = r.lightMap.size = static_cast<int>(v);
               },
               [](const BakeRequest& r) { return isPerTexel(r.kind); }},
    BakeOption{"maxDistance",
               "Distance",
               "Surfaces farther away than this do not occlude; 0: unlimited",
               " m",
               Type::Number,
               0,
               1e6,
               {},
               {},
               [](const BakeRequest& r) { return static_cast<double>(r.ao.maxDistance); },
               [](BakeRequest& r, double v) { r.ao.maxDistance = static_cast<float>(v); },
               ofOcclusion,
               true,
               "Unlimited"},
    BakeOption{"smooth",
               "Smooth",
               "Takes noise out: texels share with those about them on the same smooth surface, as "
               "far as they differ by no more than their noise",
               "",
               Type::Toggle,
               0,
               1,
               {},
               {},
               [](const BakeRequest& r) { return r.lightMap.smooth ? 1.0 : 0.0; },
               [](BakeRequest& r, double v) { r.lightMap.smooth = v != 0.0; },
               [](const BakeRequest& r) { return r.kind == BakeKind::LightMap; }},
    advanced(BakeOption{
        "method",
        "Sampling",
        "How directions are chosen: scrambled Sobol' points are the smoothest; the others "
        "are there to compare with",
        "",
        Type::Choice,
        0,
        0,
        {},
        kMethods,
        [](const BakeRequest& r) { return static_cast<double>(r.prt.method); },
        [](BakeRequest& r, double v) { r.prt.method = static_cast<SampleMethod>(v); },
        tracesTransfer}),
    advanced(BakeOption{
        "seed",
        "Seed",
        "Another seed gives other noise of the same size; the same seed gives the same bytes",
        "",
        Type::Integer,
        0,
        4294967295.0,
        {},
        {},
        [](const BakeRequest& r) {
            return static_cast<double>(r.kind == BakeKind::LightMap ? r.lightMap.seed
                                       : holdsTransfer(r.kind)      ? r.prt.seed
                                                                    : r.ao.seed);
        },
        [](BakeRequest& r, double v) {
            r.prt.seed = r.ao.seed = r.lightMap.seed = static_cast<std::uint32_t>(v);
        },
        traces}),
};

// No option is called so.
constexpr const char* kNote = "note";
constexpr const char* kStopped = "stopped";

std::optional<double> parse(const BakeOption& option, const std::string& text) {
    if (option.type == Type::Toggle) {
        if (text == "true" || text == "false")
            return text == "true" ? 1.0 : 0.0;
        return std::nullopt;
    }
    if (option.type == Type::Choice) {
        for (std::size_t i = 0; i < option.choices.size(); ++i)
            if (text == option.choices[i].name)
                return static_cast<double>(i);
        return std::nullopt;
    }
    double value = 0.0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || !(value >= option.min && value <= option.max))
        return std::nullopt;
    if (option.type == Type::Integer && value != std::floor(value))
        return std::nullopt;
    return value;
}

} // namespace

std::span<const BakeOption> bakeOptions() {
    return kOptions;
}

const BakeOption* findBakeOption(std::string_view name) {
    const auto found = std::ranges::find(kOptions, name, &BakeOption::name);
    return found == kOptions.end() ? nullptr : &*found;
}

std::string optionText(const BakeOption& option, const BakeRequest& request) {
    const double value = option.get(request);
    switch (option.type) {
    case Type::Integer:
        return fmt::format("{:.0f}", value);
    case Type::Number:
        return fmt::format("{}", static_cast<float>(value));
    case Type::Toggle:
        return value != 0.0 ? "true" : "false";
    case Type::Choice:
        break;
    }
    return option.choices[static_cast<std::size_t>(value)].name;
}

std::map<std::string, std::string> settingsText(const BakeRequest& request) {
    std::map<std::string, std::string> result;
    for (const BakeOption& option : kOptions)
        if (option.applies(request) && option.shapesResult)
            result[option.name] = optionText(option, request);
    return result;
}

BakeRequest requestFromText(BakeKind kind, const std::map<std::string, std::string>& settings) {
    BakeRequest request;
    request.kind = kind;
    for (const BakeOption& option : kOptions)
        if (const auto found = settings.find(option.name); found != settings.end())
            if (const std::optional<double> value = parse(option, found->second))
                option.set(request, *value);
    return request;
}

BakeRequest requestOf(const BakeArtifact& artifact) {
    return requestFromText(artifact.kind, artifact.settings);
}

std::map<std::string, std::string> recordOf(const BakeArtifact& artifact) {
    std::map<std::string, std::string> record = artifact.settings;
    if (!artifact.note.empty())
        record[kNote] = artifact.note;
    if (artifact.stopped)
        record[kStopped] = "true";
    return record;
}

void setRecord(BakeArtifact& artifact, std::map<std::string, std::string> record) {
    const auto take = [&](const char* name) {
        const auto node = record.extract(name);
        return node ? node.mapped() : std::string();
    };
    artifact.note = take(kNote);
    artifact.stopped = take(kStopped) == "true";
    artifact.settings = std::move(record);
}

} // namespace patina
