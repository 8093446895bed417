#include "app/cli/BakeRun.h"
#include "app/cli/Commands.h"
#include "app/cli/LongBake.h"
#include "app/cli/Report.h"

#include <nlohmann/json.hpp>

namespace patina::cli {
namespace {

const char* targetName(BakeTarget target) {
    return target == BakeTarget::Texel ? "texel" : "vertex";
}

const char* transferName(TransferKind transfer) {
    switch (transfer) {
    case TransferKind::Unshadowed:
        return "unshadowed";
    case TransferKind::Shadowed:
        return "shadowed";
    case TransferKind::Interreflected:
        break;
    }
    return "interreflected";
}

const char* methodName(SampleMethod method) {
    switch (method) {
    case SampleMethod::Qmc:
        return "qmc";
    case SampleMethod::Stratified:
        return "stratified";
    case SampleMethod::Random:
        break;
    }
    return "random";
}

// The settings that options which imply or exclude each other come to.
Result<BakeRequest> requestOf(const BakePrtOptions& options) {
    const bool perTexel = options.target == BakeTarget::Texel;
    const bool bounces = options.bounces || options.bounceSamples;
    BakeRequest request;
    request.kind = perTexel ? BakeKind::PrtTexel : BakeKind::PrtVertex;
    PrtSettings& settings = request.prt = options.settings;
    if (options.transfer && *options.transfer != TransferKind::Interreflected && bounces)
        return usageError("--bounces and --bounce-samples are for --transfer interreflected");
    settings.transfer =
        options.transfer.value_or(bounces ? TransferKind::Interreflected : settings.transfer);
    settings.bounces = options.bounces.value_or(settings.bounces);
    settings.bounceSamples = options.bounceSamples.value_or(settings.bounceSamples);
    if (!options.hitMemory.empty()) {
        if (settings.transfer != TransferKind::Interreflected)
            return usageError("--hit-memory is for --transfer interreflected");
        const Result<std::uint64_t> bytes = parseSize("--hit-memory", options.hitMemory, 0);
        if (!bytes)
            return bytes.error();
        settings.hitBudget = *bytes;
    }
    if (options.size && !perTexel)
        return usageError("--size is for --target texel; the vertices are those of the mesh");
    if (!settings.fitted && perTexel)
        return usageError("--no-fit is for --target vertex; texels are dense enough as they are");
    settings.size = options.size.value_or(settings.size);
    return request;
}

} // namespace

Result<void> run(Session& session, const BakeAoOptions& options) {
    const bool perTexel = options.target == BakeTarget::Texel;
    nlohmann::ordered_json& json = session.report().json()["settings"];
    json = {{"scene", options.scene},
            {"target", targetName(options.target)},
            {"samples", options.samples},
            {"distance", options.distance},
            {"seed", options.seed}};
    if (perTexel)
        json["size"] = options.size;
    BakeRequest request;
    request.kind = perTexel ? BakeKind::AoTexel : BakeKind::AoVertex;
    request.ao.samples = options.samples;
    request.ao.maxDistance = options.distance;
    request.ao.size = options.size;
    request.ao.seed = options.seed;
    return bakeScene(session, {options.scene, options.output, options.work, request});
}

Result<void> run(Session& session, const BakePrtOptions& options) {
    const Result<BakeRequest> request = requestOf(options);
    if (!request)
        return request.error();
    const PrtSettings& settings = request->prt;
    nlohmann::ordered_json& json = session.report().json()["settings"];
    json = {{"scene", options.scene},          {"target", targetName(options.target)},
            {"order", settings.order},         {"transfer", transferName(settings.transfer)},
            {"samples", settings.samples},     {"method", methodName(settings.method)},
            {"tolerance", settings.tolerance}, {"seed", settings.seed}};
    if (settings.transfer == TransferKind::Interreflected) {
        json["bounces"] = settings.bounces;
        json["bounceSamples"] = settings.bounceSamples;
    }
    if (request->kind == BakeKind::PrtTexel)
        json["size"] = settings.size;
    else
        json["fitted"] = settings.fitted;
    if (options.bits && options.storage.storage != BakeStorage::Quantised)
        return usageError("--bits is for --store quantised");
    BakeFileOptions storage = options.storage;
    storage.bits = options.bits.value_or(storage.bits);
    json["store"] = storageName(storage.storage);
    if (storage.storage == BakeStorage::Quantised)
        json["bits"] = storage.bits;
    return bakeScene(session, {options.scene, options.output, options.work, *request, storage});
}

} // namespace patina::cli
