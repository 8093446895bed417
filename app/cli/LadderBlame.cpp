#include "app/cli/LadderBlame.h"

#include "app/cli/Report.h"
#include "app/cli/SceneSetup.h"
#include "core/document/View.h"
#include "core/image/Channels.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace patina::cli {

bool wantsBlame(const LadderOptions& options) {
    return options.blame || !options.blamePictures.empty();
}

Result<void> checkBlame(const LadderOptions& options, const View& view) {
    // Other weights are no shortcut: the traced picture does not have them.
    if (view.reflectionMix != View().reflectionMix)
        return usageError("--blame explains pictures that show diffuse light and reflections in "
                          "full: set view.reflectionMix to 0.5");
    if (options.blamePictures.empty())
        return {};
    if (std::filesystem::path(options.blamePictures).extension() != ".exr")
        return usageError("--blame-pictures takes an .exr, which holds linear pictures as parts");
    return checkOutput(options.blamePictures);
}

std::vector<std::pair<std::string, std::string>> blameTable(const Blame& blame) {
    std::vector<std::pair<std::string, std::string>> table;
    if (!blame.whole.isKnown) {
        table.emplace_back("Error", "no larger than its noise");
        return table;
    }
    std::vector<BlameCauseInfo> causes(blameCauses().begin(), blameCauses().end());
    std::ranges::stable_sort(causes, std::greater(), [&](const BlameCauseInfo& info) {
        return blame.whole.of(info.cause).share;
    });
    for (const BlameCauseInfo& info : causes) {
        const BlameShare& share = blame.whole.of(info.cause);
        table.emplace_back(info.label,
                           fmt::format("{:6.1f} % ± {:4.1f}   alone {:5.1f} %   light {:+6.2f} %",
                                       100.0 * share.share, 100.0 * share.noise,
                                       100.0 * share.relative, 100.0 * share.bias));
    }
    table.emplace_back("Remedy", infoOf(infoOf(*blame.whole.largest()).remedy).text);
    return table;
}

std::vector<ImagePart> blameParts(const Blame& blame, const Image& drawn, const Image& traced) {
    std::vector<ImagePart> parts;
    parts.push_back({"traced", traced, {}});
    parts.push_back({"drawn", withoutAlpha(drawn), {}});
    for (const BlameCauseInfo& info : blameCauses())
        parts.push_back({info.name, blame.steps[static_cast<std::size_t>(info.cause)], {}});
    return parts;
}

} // namespace patina::cli
