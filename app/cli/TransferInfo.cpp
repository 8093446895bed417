#include "app/cli/TransferInfo.h"

#include "app/cli/Vectors.h"
#include "core/bake/study/TransferStudy.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace patina::cli {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::pair<std::string, std::string>>;

// A band's coefficients of the transfer and the radiance it adds.
std::pair<Json, std::string> describeBand(const TransferStudy& study, int l) {
    const glm::vec3& radiance = study.byBand[static_cast<std::size_t>(l)];
    Json json = {{"radiance", vectorJson(radiance)}};
    std::string text = fmt::format("radiance {}; coefficients", vectorText(radiance));
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
        const float c = study.transfer.meanCoefficient(static_cast<std::size_t>(i));
        json["coefficients"].push_back(c);
        text += fmt::format(" {:.4g}", c);
    }
    return {std::move(json), std::move(text)};
}

} // namespace

Result<void> describeTransfer(Session& session, const Document& document,
                              const NearShadowsPtr& shadows, Id mesh, const glm::vec3& position) {
    TransferRequest request = transferRequest(document);
    if (!request.bake || !request.environment.image)
        return {};
    request.shadows = shadows;
    request.mesh = mesh;
    request.position = position;
    TransferMemory memory;
    const Result<TransferStudy> studied = studyTransfer(document, request, memory, session.job());
    Report& report = session.report();
    if (!studied && studied.error().kind != ErrorKind::Cancelled) {
        report.warn(studied.error().text());
        return {};
    }
    if (!studied)
        return studied.error();
    const TransferStudy& study = *studied;
    const bool bounces = !study.transfer.bounced.empty();
    Json json = {
        {"position", vectorJson(position)},
        {"order", study.transfer.order},
        {"bounces", bounces},
        {"skyVisibility", study.visibility},
        {"radiance", vectorJson(study.all())},
        {"localLights", {{"count", study.tracedLights}, {"radiance", vectorJson(study.local)}}},
        {"lowest", study.function.lowest},
        {"highest", study.function.highest},
        {"negativeShare", study.function.negativeShare}};
    Rows rows = {
        {"radiance", fmt::format("{} of a white surface, {}", vectorText(study.all()),
                                 bounces ? "with bounces" : "direct light")},
        {"sky visibility", fmt::format("{:.1f} %", 100.0f * study.visibility)},
        {"by direction",
         fmt::format("{:.4g} … {:.4g}, below zero on {:.1f} % of the sphere", study.function.lowest,
                     study.function.highest, 100.0 * study.function.negativeShare)}};
    if (study.tracedLights > 0)
        rows.emplace_back("local lights", fmt::format("{} of it directly, by rays instead of bands",
                                                      vectorText(study.local)));
    for (int l = 0; l < study.transfer.order; ++l) {
        auto [entry, text] = describeBand(study, l);
        json["bands"].push_back(std::move(entry));
        rows.emplace_back(fmt::format("band {}", l), std::move(text));
    }
    report.table("Transfer", rows);
    report.json()["transfer"] = std::move(json);
    return {};
}

} // namespace patina::cli
