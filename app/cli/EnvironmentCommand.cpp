#include "app/cli/Commands.h"
#include "app/cli/SceneSetup.h"
#include "core/light/BrightSources.h"
#include "core/light/EnvironmentProjection.h"
#include "core/light/Light.h"
#include "core/light/ShBands.h"
#include "core/scene/EnvironmentFile.h"
#include "core/scene/EnvironmentSave.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::cli {
namespace {

// The picture of what the first bands hold.
Image bandsOf(Session& session, const Environment& environment, const EnvironmentOptions& options) {
    const int samples = environmentSamples(options.method, options.samples);
    nlohmann::ordered_json& settings = session.report().json()["settings"];
    settings["bands"] = options.bands;
    if (options.method != ShMethod::Exact)
        settings["samples"] = samples;
    session.beginPhase();
    return shLatLong(projectEnvironment(*environment.image, options.bands, options.method, samples,
                                        session.job()),
                     options.bands, environment.image->height(), session.job());
}

// The picture without its brightest sources, which the report lists as lights.
Image withoutSources(Session& session, const Environment& environment, int count) {
    BrightSources found = extractBrightSources(*environment.image, count, session.job());
    auto list = nlohmann::ordered_json::array();
    for (const BrightSource& source : found.sources) {
        const Light light = lightOf(source, environment);
        list.push_back(
            {{"azimuthDeg", light.azimuthDeg},
             {"elevationDeg", light.elevationDeg},
             {"irradiance", {source.irradiance.r, source.irradiance.g, source.irradiance.b}},
             {"diameterDeg", source.diameterDeg},
             {"shareOfLight", source.shareOfLight},
             {"standsOut", source.isClear}});
        session.report().line(fmt::format(
            "source  azimuth {:.1f}°, elevation {:.1f}°, {:.3g} lx, {:.2f}° wide, {:.1f} % of the "
            "light{}",
            light.azimuthDeg, light.elevationDeg,
            std::max({source.irradiance.r, source.irradiance.g, source.irradiance.b}),
            source.diameterDeg, 100.0 * source.shareOfLight,
            source.isClear ? "" : "; it does not stand out"));
    }
    if (std::ssize(found.sources) < count)
        session.report().warn(fmt::format("only {} of {} sources were found: the rest is black or "
                                          "even",
                                          found.sources.size(), count));
    session.report().json()["sources"] = std::move(list);
    return std::move(found.picture);
}

} // namespace

Result<void> run(Session& session, const EnvironmentOptions& options) {
    EnvironmentSaveSettings settings;
    settings.output = options.output;
    settings.size = options.size;
    settings.openExrEnvmap = options.openExrEnvmap;
    const Result<EnvironmentLayout> layout = parseLayout(options.layout);
    if (!layout)
        return layout.error();
    if (*layout == EnvironmentLayout::Automatic)
        return Error{ErrorKind::Usage,
                     "a file that is written needs a layout; name it with --layout",
                     {},
                     {}};
    settings.layout = *layout;
    const Result<std::vector<std::filesystem::path>> files = environmentOutputs(settings);
    if (!files)
        return files.error();
    for (const std::filesystem::path& file : *files)
        if (Result<void> output = checkOutput(file); !output)
            return output;

    session.report().json()["settings"] = {{"environment", options.environment},
                                           {"layout", options.layout}};
    session.beginPhase();
    const Result<Document> document =
        openEnvironmentFor(session, options.environment, options.environmentLayout);
    if (!document)
        return document.error();
    Environment environment = document->environment();
    if (options.bands > 0)
        environment.image = std::make_shared<const Image>(bandsOf(session, environment, options));
    if (options.extract > 0) {
        session.report().json()["settings"]["extract"] = options.extract;
        environment.image =
            std::make_shared<const Image>(withoutSources(session, environment, options.extract));
    }
    if (session.job().cancelled())
        return Error{ErrorKind::Cancelled, "it was cancelled", {}, {}};
    if (settings.size == 0)
        settings.size = environmentSaveSize(settings.layout, environment.image->width());
    session.report().json()["settings"]["size"] = settings.size;

    session.beginPhase();
    const auto written = saveEnvironment(session.worker(), environment, settings, session.job());
    if (!written)
        return written.error();
    const ImageSize size = EnvironmentMapping::imageSize(settings.layout, settings.size);
    session.report().json()["width"] = size.width;
    session.report().json()["height"] = size.height;
    for (const std::filesystem::path& file : *written)
        session.report().output(file, std::string(layoutLabel(settings.layout)));
    return {};
}

} // namespace patina::cli
