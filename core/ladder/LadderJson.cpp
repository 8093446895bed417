#include "core/ladder/LadderJson.h"

#include "core/document/Document.h"
#include "core/material/Material.h"

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace patina {
namespace {

nlohmann::ordered_json blameScoreJson(const BlameScore& score) {
    nlohmann::ordered_json json = {{"relative", score.relative}};
    auto& causes = json["causes"] = nlohmann::ordered_json::array();
    for (const BlameCauseInfo& info : blameCauses()) {
        const BlameShare& share = score.of(info.cause);
        nlohmann::ordered_json one = {{"cause", info.name}};
        one["share"] = score.isKnown ? nlohmann::ordered_json(share.share) : nullptr;
        one["shareNoise"] = score.isKnown ? nlohmann::ordered_json(share.noise) : nullptr;
        one["relative"] = share.relative;
        one["bias"] = share.bias;
        causes.push_back(std::move(one));
    }
    const std::optional<BlameCause> largest = score.largest();
    json["largest"] = largest ? nlohmann::ordered_json(infoOf(*largest).name) : nullptr;
    json["remedy"] =
        largest ? nlohmann::ordered_json(infoOf(infoOf(*largest).remedy).name) : nullptr;
    return json;
}

} // namespace

nlohmann::ordered_json scoreJson(const ErrorScore& score) {
    return {{"flip", score.flip},
            {"flipNoise", score.flipNoise},
            {"biasEv", score.biasEv},
            {"biasEvNoise", score.biasEvNoise},
            {"relative", score.relative}};
}

nlohmann::ordered_json errorJson(const PictureError& error, const Document& document) {
    nlohmann::ordered_json json = scoreJson(error.whole);
    auto& materials = json["materials"] = nlohmann::ordered_json::array();
    for (const ErrorScore& score : error.materials) {
        const Material* material = document.material(score.material);
        nlohmann::ordered_json one = {{"name", material != nullptr ? material->name : ""},
                                      {"pixels", score.pixels}};
        one.update(scoreJson(score));
        materials.push_back(std::move(one));
    }
    return json;
}

nlohmann::ordered_json blameJson(const Blame& blame, const Document& document) {
    nlohmann::ordered_json json = blameScoreJson(blame.whole);
    auto& materials = json["materials"] = nlohmann::ordered_json::array();
    for (const BlameScore& score : blame.materials) {
        const Material* material = document.material(score.material);
        nlohmann::ordered_json one = {{"name", material != nullptr ? material->name : ""},
                                      {"pixels", score.pixels}};
        one.update(blameScoreJson(score));
        materials.push_back(std::move(one));
    }
    return json;
}

} // namespace patina
