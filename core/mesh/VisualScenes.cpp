#include "core/mesh/VisualScenes.h"

#include <algorithm>
#include <fmt/format.h>

namespace patina {
namespace {

constexpr std::size_t kListed = 10;

} // namespace

std::vector<std::string> visualSceneTitles(const std::vector<VisualScene>& scenes) {
    const auto alone = [&](const std::string VisualScene::*text, const std::string& value) {
        return !value.empty() && std::ranges::count(scenes, value, text) == 1;
    };
    std::vector<std::string> titles;
    for (const VisualScene& scene : scenes)
        titles.push_back(alone(&VisualScene::name, scene.name) ? scene.name
                         : alone(&VisualScene::id, scene.id)   ? scene.id
                                                               : std::string());
    for (std::size_t i = 0; i < titles.size(); ++i) {
        std::size_t number = i + 1;
        while (titles[i].empty()) {
            std::string title = fmt::format("scene {}", number);
            if (std::ranges::find(titles, title) == titles.end())
                titles[i] = std::move(title);
            number += scenes.size();
        }
    }
    return titles;
}

std::optional<std::size_t> visualScene(const std::vector<VisualScene>& scenes,
                                       std::string_view title) {
    const std::vector<std::string> titles = visualSceneTitles(scenes);
    if (const auto found = std::ranges::find(titles, title); found != titles.end())
        return static_cast<std::size_t>(found - titles.begin());
    if (const auto found = std::ranges::find(scenes, title, &VisualScene::id);
        !title.empty() && found != scenes.end())
        return static_cast<std::size_t>(found - scenes.begin());
    return std::nullopt;
}

std::string listVisualScenes(const std::vector<std::string>& titles,
                             std::optional<std::size_t> except) {
    std::vector<std::string> named;
    for (std::size_t i = 0; i < titles.size(); ++i)
        if (i != except)
            named.push_back(fmt::format("\"{}\"", titles[i]));
    if (named.size() > kListed) {
        const std::size_t more = named.size() - kListed;
        named.resize(kListed);
        named.push_back(fmt::format("{} more", more));
    }
    if (named.empty())
        return {};
    const std::string last = named.back();
    named.pop_back();
    return named.empty() ? last : fmt::format("{} and {}", fmt::join(named, ", "), last);
}

std::string noSuchVisualScene(const std::vector<std::string>& titles, std::string_view title) {
    return fmt::format("it has no visual scene \"{}\"; it has {}", title, listVisualScenes(titles));
}

} // namespace patina
