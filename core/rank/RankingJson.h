// A ranking of lights as JSON: what `patina rank -o` writes, and the Light sweep dock.
#pragma once

#include "core/math/Camera.h"
#include "core/rank/LightSweep.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina {

struct UnreadEnvironment {
    std::string file, problem;
};

// What a ranking was made of; points into what outlives it.
struct Ranking {
    std::string scene; // path or builtin:NAME; empty: it was never saved
    RankBy by = RankBy::Difference;
    Camera camera;
    const SweepSettings* settings = nullptr;
    const SweepPixels* pixels = nullptr;
    const LightSweep* sweep = nullptr;
    std::span<const SweepEnvironment> environments;
    std::vector<std::string> files; // of each: path or builtin:NAME; empty: of the scene alone
    std::span<const std::optional<SameEnvironment>> same; // findSameEnvironments()
    std::vector<UnreadEnvironment> unread;
    std::string_view transfer; // "unshadowed", "quick", "project", "file"
    int rays = 0;              // per element of the transfer's bake; 0: there is none
};

[[nodiscard]] std::string_view nameOf(RankBy by); // "clipping"

// settings, transfer, reference, counts, environments, broken, and ranking: a light each, the worst
// first.
[[nodiscard]] nlohmann::ordered_json rankingJson(const Ranking& ranking);
// As it stands in a file.
[[nodiscard]] std::string rankingText(const nlohmann::ordered_json& ranking);
[[nodiscard]] std::string rankingText(const Ranking& ranking);

} // namespace patina
