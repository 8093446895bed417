#include "core/rank/RankingJson.h"

#include "core/edit/ViewJson.h"
#include "core/light/LatLongGrid.h"

#include <algorithm>
#include <cstddef>
#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <utility>

namespace patina {
namespace {

using Json = nlohmann::ordered_json;

Json flagsOf(const Ranking& ranking, std::size_t environment) {
    const SweepEnvironment& measured = ranking.environments[environment];
    Json flags = Json::array();
    if (measured.black)
        flags.push_back("black");
    if (measured.blackFromOneSide())
        flags.push_back("blackFromOneSide");
    if (ranking.same[environment])
        flags.push_back("duplicate");
    return flags;
}

Json describeEnvironment(const Ranking& ranking, std::size_t i) {
    const SweepEnvironment& measured = ranking.environments[i];
    Json json{{"name", measured.name}, {"file", ranking.files[i]}};
    Json flags = flagsOf(ranking, i);
    const auto clipping =
        std::ranges::count_if(ranking.sweep->scores, [&](const LightScore& score) {
            return score.light.environment == i && clips(score);
        });
    if (clipping > 0)
        flags.push_back("clips");
    json["flags"] = std::move(flags);
    json["clippingRotations"] = clipping;
    const glm::dvec2 side = anglesFromDirection(glm::dvec3(measured.darkestSide));
    json["darkestSide"] = {
        {"share", measured.darkestShare}, {"azimuthDeg", side.x}, {"elevationDeg", side.y}};
    if (const std::optional<SameEnvironment>& same = ranking.same[i])
        json["sameAs"] = {{"name", ranking.environments[same->of].name},
                          {"file", ranking.files[same->of]},
                          {"rotationDeg", same->rotationDeg},
                          {"exactly", same->exactly},
                          {"difference", same->difference}};
    return json;
}

Json describeLight(const Ranking& ranking, const LightScore& score, std::size_t rank) {
    const std::size_t environment = score.light.environment;
    Json flags = flagsOf(ranking, environment);
    if (clips(score))
        flags.push_back("clips");
    return {{"rank", rank},
            {"environment", ranking.environments[environment].name},
            {"file", ranking.files[environment]},
            {"rotationDeg", score.light.rotationDeg},
            {"score", rankingScore(score, ranking.by)},
            {"clipped",
             {{"share", score.clipped.sum()},
              {"highlights", score.clipped.highlights},
              {"shadows", score.clipped.shadows}}},
            {"contrast", {{"stops", score.contrastStops}, {"lost", score.lostContrast}}},
            {"difference",
             {{"worst", score.difference.worst},
              {"mean", score.difference.mean},
              {"max", score.difference.max},
              {"maxPixel", {score.worstPixel.x, score.worstPixel.y}}}},
            {"flags", std::move(flags)}};
}

} // namespace

std::string_view nameOf(RankBy by) {
    return by == RankBy::Clipping ? "clipping" : by == RankBy::Contrast ? "contrast" : "difference";
}

Json rankingJson(const Ranking& ranking) {
    const SweepSettings& settings = *ranking.settings;
    const SweepPixels& pixels = *ranking.pixels;
    const LightSweep& sweep = *ranking.sweep;
    Json json;
    json["settings"] = {{"scene", ranking.scene},
                        {"size", {pixels.width, pixels.height}},
                        {"rotations", settings.rotations},
                        {"by", nameOf(ranking.by)}};
    describeView(json["settings"], settings.view);
    json["settings"].erase("lighting"); // transfer, which is said below
    json["settings"]["camera"] = describeCamera(ranking.camera);
    json["transfer"] = {{"source", ranking.transfer}, {"bands", pixels.order}};
    if (ranking.rays > 0)
        json["transfer"]["rays"] = ranking.rays;
    json["reference"] = nullptr; // the mean look
    if (settings.reference)
        json["reference"] = {
            {"environment", ranking.environments[settings.reference->environment].name},
            {"rotationDeg", settings.reference->rotationDeg}};
    json["counts"] = {{"environments", ranking.environments.size()},
                      {"broken", ranking.unread.size()},
                      {"lights", sweep.scores.size()},
                      {"pixels", pixels.count()},
                      {"pixelsWithoutDiffuseLight", pixels.covered - pixels.count()}};
    json["environments"] = Json::array();
    for (std::size_t i = 0; i < ranking.environments.size(); ++i)
        json["environments"].push_back(describeEnvironment(ranking, i));
    json["broken"] = Json::array();
    for (const UnreadEnvironment& unread : ranking.unread)
        json["broken"].push_back({{"file", unread.file}, {"problem", unread.problem}});
    json["ranking"] = Json::array();
    std::size_t rank = 0;
    for (const std::size_t light : rankLights(sweep, ranking.by))
        json["ranking"].push_back(describeLight(ranking, sweep.scores[light], ++rank));
    return json;
}

std::string rankingText(const Json& ranking) {
    return ranking.dump(1, '\t', false, Json::error_handler_t::replace) + "\n";
}

std::string rankingText(const Ranking& ranking) {
    return rankingText(rankingJson(ranking));
}

} // namespace patina
