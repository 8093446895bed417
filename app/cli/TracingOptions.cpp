#include "app/cli/TracingOptions.h"

#include "app/cli/Report.h"
#include "core/bake/BakeMemory.h"
#include "core/base/ProcessMemory.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utility>

namespace patina::cli {
namespace {

constexpr std::array kRasterSamples{1, 2, 4, 8, 16};

Result<void> checkDrawn(const TracingOptions& options) {
    for (const auto& [given, name] : std::array<std::pair<bool, const char*>, 3>{
             {{options.noise.has_value(), "--noise"},
              {options.maxBounces.has_value(), "--max-bounces"},
              {options.seed != 0, "--seed"}}})
        if (given)
            return usageError(fmt::format("{} is for --renderer path and whitted", name));
    if (!std::ranges::count(kRasterSamples, options.samples))
        return usageError("--samples wants 1, 2, 4, 8 or 16; with --renderer path it may be "
                          "any number");
    return {};
}

Result<void> checkOtherThanWhitted(const WhittedOptions& o) {
    for (const auto& [given, name] : std::array<std::pair<bool, const char*>, 7>{
             {{o.model.has_value(), "--whitted-model"},
              {o.minContribution.has_value(), "--min-contribution"},
              {o.contrast.has_value(), "--contrast"},
              {o.subdivisions.has_value(), "--subdivisions"},
              {o.softShadows, "--soft-shadows"},
              {o.gloss, "--gloss"},
              {o.depthOfField, "--depth-of-field"}}})
        if (given)
            return usageError(fmt::format("{} is for --renderer whitted", name));
    return {};
}

Result<void> checkWhittedSamples(const TracingOptions& options) {
    const WhittedOptions& o = options.whitted;
    if (options.maxBounces && *options.maxBounces > kMostWhittedDepth)
        return usageError(fmt::format("--max-bounces wants at most {} with --renderer whitted",
                                      kMostWhittedDepth));
    if (whittedSettings(options).isStochastic()) {
        for (const auto& [given, name] : std::array<std::pair<bool, const char*>, 2>{
                 {{o.contrast.has_value(), "--contrast"},
                  {o.subdivisions.has_value(), "--subdivisions"}}})
            if (given)
                return usageError(fmt::format("{} divides pixels adaptively, which --soft-shadows, "
                                              "--gloss and --depth-of-field do not: they take "
                                              "--samples",
                                              name));
        return {};
    }
    for (const auto& [given, name] :
         std::array<std::pair<bool, const char*>, 3>{{{options.samplesGiven, "--samples"},
                                                      {options.noise.has_value(), "--noise"},
                                                      {options.seed != 0, "--seed"}}})
        if (given)
            return usageError(fmt::format("{} is for --soft-shadows, --gloss and "
                                          "--depth-of-field: without them "
                                          "nothing is random, and --contrast and --subdivisions "
                                          "say how finely pixels are divided",
                                          name));
    return {};
}

} // namespace

bool isTraced(const TracingOptions& options) {
    return options.renderer != "raster";
}

bool isWhitted(const TracingOptions& options) {
    return options.renderer == "whitted";
}

Result<void> checkTracing(const TracingOptions& options) {
    if (!isWhitted(options))
        if (Result<void> others = checkOtherThanWhitted(options.whitted); !others)
            return others;
    if (!isTraced(options))
        return checkDrawn(options);
    for (const auto& [given, name] : std::array<std::pair<bool, const char*>, 2>{
             {{!options.bakes.empty(), "--bake"}, {!options.lighting.empty(), "--lighting"}}})
        if (given)
            return usageError(fmt::format("{} is for --renderer raster: rays bring the light of "
                                          "the whole picture, and need no bake",
                                          name));
    return isWhitted(options) ? checkWhittedSamples(options) : Result<void>();
}

WhittedSettings whittedSettings(const TracingOptions& options) {
    const WhittedOptions& o = options.whitted;
    WhittedSettings settings;
    if (o.model == "1980")
        settings.model = LocalModel::Whitted1980;
    settings.maxDepth = options.maxBounces.value_or(settings.maxDepth);
    settings.minContribution = o.minContribution.value_or(settings.minContribution);
    settings.contrast = o.contrast.value_or(settings.contrast);
    settings.subdivisions = o.subdivisions.value_or(settings.subdivisions);
    settings.softShadows = o.softShadows;
    settings.gloss = o.gloss;
    settings.depthOfField = o.depthOfField;
    settings.seed = options.seed;
    return settings;
}

const char* whittedModelName(LocalModel model) {
    return model == LocalModel::Whitted1980 ? "1980" : "patina";
}

nlohmann::ordered_json describeWhitted(const WhittedSettings& settings) {
    nlohmann::ordered_json json = {{"model", whittedModelName(settings.model)},
                                   {"maxDepth", settings.maxDepth},
                                   {"minContribution", settings.minContribution},
                                   {"softShadows", settings.softShadows},
                                   {"gloss", settings.gloss},
                                   {"depthOfField", settings.depthOfField}};
    if (!settings.isStochastic()) {
        json["contrast"] = settings.contrast;
        json["subdivisions"] = settings.subdivisions;
    }
    return json;
}

std::uint32_t samplesOf(const TracingOptions& options) {
    if (isWhitted(options) && !whittedSettings(options).isStochastic())
        return 1;
    if (options.samplesGiven)
        return static_cast<std::uint32_t>(options.samples);
    if (options.noise)
        return kMostPaths;
    return isWhitted(options) ? kUsualRays : kUsualPaths;
}

const char* unitOf(const TracingOptions& options) {
    return isWhitted(options) ? "samples" : "paths";
}

Result<void> checkTracingMemory(int width, int height, std::size_t bytesPerPixel) {
    const std::uint64_t held =
        static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * bytesPerPixel;
    const std::uint64_t available = availableMemory();
    if (available > 0 && held > available)
        return usageError(fmt::format("the picture takes {} of memory, and {} are free; choose a "
                                      "smaller --size",
                                      memoryText(held), memoryText(available)));
    return {};
}

} // namespace patina::cli
