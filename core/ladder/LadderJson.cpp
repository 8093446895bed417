#include "core/ladder/LadderJson.h"

#include "core/document/Document.h"
#include "core/material/Material.h"

#include <nlohmann/json.hpp>

namespace patina {

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

} // namespace patina
