#include "app/cli/LightInfo.h"

#include "app/cli/Numbers.h"
#include "app/cli/PreparedLight.h"
#include "app/cli/Vectors.h"
#include "core/light/DominantLight.h"
#include "core/light/EnvironmentLookup.h"
#include "core/light/LatLongGrid.h"
#include "core/math/Shading.h"
#include "core/mix/LightMix.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/trigonometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace patina::cli {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::pair<std::string, std::string>>;

std::string anglesText(const glm::vec3& direction) {
    const glm::dvec2 angles = anglesFromDirection(glm::dvec3(direction));
    return fmt::format("azimuth {:.1f}°, elevation {:.1f}°", angles.x, angles.y);
}

Json directionJson(const glm::vec3& direction) {
    const glm::dvec2 angles = anglesFromDirection(glm::dvec3(direction));
    return {
        {"direction", vectorJson(direction)}, {"azimuthDeg", angles.x}, {"elevationDeg", angles.y}};
}

std::string countOfBands(int bands) {
    return fmt::format("{} band{}", bands, bands == 1 ? "" : "s");
}

std::string roughnessText(int step) {
    return fmt::format("roughness {:.2f}", roughnessStep(step));
}

std::string rotatedText(const Orientation& stands) {
    const std::string rotated = fmt::format("{:.1f}°", stands.rotationDeg);
    return stands.isLevel() ? rotated
                            : fmt::format("{}, tilted {:.1f}°, rolled {:.1f}°", rotated,
                                          stands.tiltDeg, stands.rollDeg);
}

void describeWhole(Report& report, Json& json, const EnvironmentLookup& light) {
    const Image& environment = *light.analysis->environment;
    json["width"] = environment.width();
    json["height"] = environment.height();
    json["invalidSamples"] = light.analysis->invalidSamples;
    const Orientation& stands = light.orientation;
    json["rotationDeg"] = stands.rotationDeg;
    json["tiltDeg"] = stands.tiltDeg;
    json["rollDeg"] = stands.rollDeg;
    json["scale"] = vectorJson(light.scale * light.tint);
    json["rms"] = light.rms();
    json["irradianceError"] = irradianceError(*light.maps);
    // The light of the scene: as the environment is rotated and scaled.
    DominantLight dominant = dominantLight(light.maps->irradianceSh);
    dominant.toLight = stands.toWorld(dominant.toLight);
    dominant.irradiance *= light.scale * light.tint;
    json["dominantLight"] = directionJson(dominant.toLight);
    json["dominantLight"]["irradiance"] = vectorJson(dominant.irradiance);
    json["dominantLight"]["directionality"] = directionality(light.maps->irradianceSh);
    report.table(
        "Light",
        {{"size", fmt::format("{} × {} pixels", environment.width(), environment.height())},
         {"rotated", rotatedText(stands)},
         {"RMS", fmt::format("{:.4g}", light.rms())},
         {"dominant light", fmt::format("{}, irradiance {}", anglesText(dominant.toLight),
                                        vectorText(dominant.irradiance))},
         {"directionality",
          fmt::format("{:.1f} %", 100.0f * directionality(light.maps->irradianceSh))},
         {"irradiance", fmt::format("{:.1f} % RMS off from nine coefficients",
                                    100.0 * irradianceError(*light.maps))}});
}

// Shares of the energy are those of the picture, whatever its tint.
void describeBands(Report& report, Json& json, const EnvironmentLookup& light) {
    const ShBands& bands = light.analysis->bands;
    const double all = bands.rms * bands.rms;
    Rows rows;
    for (int n = 1; n <= kMaxShOrder; ++n) {
        const BandSumError sum = light.bandSumError(n);
        const double energy = all > 0.0 ? bandEnergy(bands.coefficients, n - 1) / all : 0.0;
        json["bands"].push_back({{"bands", n},
                                 {"coefficients", n * n},
                                 {"energyShare", energy},
                                 {"rmse", sum.rmse},
                                 {"rmseShare", sum.share},
                                 {"lowest", sum.lowest},
                                 {"lowestDirection", vectorJson(sum.lowestDirection)},
                                 {"belowZero", sum.belowZero}});
        rows.emplace_back(
            countOfBands(n),
            fmt::format("RMSE {:.4g}, {:.2f} % of the RMS; the last holds {:.2f} % of the energy{}",
                        sum.rmse, 100.0 * sum.share, 100.0 * energy,
                        sum.belowZero ? fmt::format("; lowest {:.3g}", sum.lowest) : ""));
    }
    report.table("Spherical harmonics", rows);
}

void describeLevels(Report& report, Json& json, const EnvironmentLookup& light) {
    Rows rows;
    for (int step = 0; step < kRoughnessSteps; ++step) {
        const LevelPair levels = levelsOf(*light.maps, roughnessStep(step));
        const int size = light.maps->prefiltered[levels.first].size;
        json["prefiltered"].push_back({{"perceptualRoughness", roughnessStep(step)},
                                       {"level", levels.first},
                                       {"shareOfNext", levels.share},
                                       {"faceSize", size}});
        rows.emplace_back(roughnessText(step),
                          fmt::format("level {:.2f}, {} texels per face",
                                      static_cast<float>(levels.first) + levels.share, size));
    }
    report.table("Prefiltered light", rows);
}

void describeDirection(Report& report, Json& json, const EnvironmentLookup& light,
                       const glm::vec3& direction) {
    Json at = directionJson(direction);
    Rows rows;
    const auto add = [&](Json& into, const std::string& label, const glm::vec3& value) {
        into = vectorJson(value);
        rows.emplace_back(label, vectorText(value));
    };
    add(at["radiance"], "radiance", light.radiance(direction).value());
    for (int n = 1; n <= kMaxShOrder; ++n)
        add(at["bands"].emplace_back(), countOfBands(n), light.bandSum(n, direction).value());
    for (int step = 0; step < kRoughnessSteps; ++step)
        add(at["prefiltered"].emplace_back(), roughnessText(step),
            light.prefiltered(roughnessStep(step), direction).value());
    add(at["irradianceSh9"], "irradiance, SH 9", light.irradianceSh9(direction).value());
    add(at["irradiance"], "irradiance, exact", light.irradiance(direction).value());
    report.table(fmt::format("Towards {}", anglesText(direction)), rows);
    json["at"] = std::move(at);
}

} // namespace

Result<std::optional<glm::vec3>> parseDirection(const std::string& text) {
    if (text.empty())
        return std::optional<glm::vec3>();
    std::vector<double> angles;
    if (!parseNumbers(text, ',', angles) || angles.size() != 2 || !(std::abs(angles[0]) <= 360.0) ||
        !(std::abs(angles[1]) <= 90.0))
        return Error{ErrorKind::Usage,
                     fmt::format("--direction wants AZIMUTH,ELEVATION in degrees, within ±360 and "
                                 "±90, not \"{}\"",
                                 text),
                     {},
                     {}};
    return std::optional(glm::vec3(directionFromAngles(angles[0], angles[1])));
}

Result<void> describeLight(Session& session, const Document& document,
                           const std::optional<glm::vec3>& direction) {
    const EnvironmentPart shown = shownEnvironment(document);
    if (!shown.image)
        return Error{ErrorKind::InputMissing, "there is no environment to analyse", {}, {}};
    session.beginPhase();
    session.job().setActivity("analysing light");
    EnvironmentLookup light;
    light.orientation = shown.orientation;
    light.setScale(shown.scale);
    light.analysis = analyseEnvironment(shown.image, session.job());
    if (!light.analysis)
        return Error{ErrorKind::Cancelled, "it was cancelled", {}, {}};
    Result<IblMaps> maps = prepareLight(*light.analysis->environment, session.job());
    if (!maps)
        return maps.error();
    light.maps = std::make_shared<const IblMaps>(*std::move(maps));
    session.endProgress();

    Report& report = session.report();
    Json json;
    describeWhole(report, json, light);
    describeBands(report, json, light);
    describeLevels(report, json, light);
    if (direction)
        describeDirection(report, json, light, *direction);
    report.json()["light"] = std::move(json);
    return {};
}

} // namespace patina::cli
