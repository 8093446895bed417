#include "core/document/ViewChoices.h"
#include "render/view/ExplanationParts.h"

#include "core/document/ToneResponse.h"
#include "core/edit/Parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace patina::render {
namespace {

using namespace shading;

constexpr const char* kRadianceUnit = "cd/m²";

// A pixel of 8 bits differs by half a step from what was computed.
constexpr float kDisplayedTolerance = 1.0f / 255.0f;

ExplainedStep exposureStep(const Inspection& pixel, const Document& document,
                           const RebuiltPixel& rebuilt) {
    const View& view = document.view;
    const Luminance& luminance = pixel.luminance;
    ExplainedStep step{"exposure",
                       "Exposure",
                       "L · 2^EV",
                       {color("radiance", "Radiance", "L", rebuilt.radiance, kRadianceUnit),
                        scalar("exposureEv", "Exposure", "EV", view.exposureEv, "EV")},
                       color("exposed", "Exposed", "x", rebuilt.exposed),
                       {},
                       true,
                       {}};
    if (view.exposureMode == ExposureMode::Automatic &&
        view.toneMap != ToneMap::ReinhardPhotographic) {
        step.formula = "L · 2^EV · 0.18 / La";
        step.factors.push_back(scalar("adapted", "Luminance the Eye Is Used To", "La",
                                      luminance.adapted, kRadianceUnit));
    }
    step.result.numbers = {pixel.exposed.x, pixel.exposed.y, pixel.exposed.z};
    compare(step, rebuilt.exposed);
    return step;
}

std::string curveFormula(const View& view) {
    switch (view.toneMap) {
    case ToneMap::Clamp:
        return "clamp(x, 0, 1)";
    case ToneMap::Reinhard:
        return view.reinhardPerChannel ? "x / (1 + x)" : "x / (1 + Y)";
    case ToneMap::ReinhardPhotographic:
        if (view.reinhardPerChannel)
            return view.reinhardWhite > 0.0f ? "s x (1 + s x / w²) / (1 + s x)" : "s x / (1 + s x)";
        return view.reinhardWhite > 0.0f ? "x · s (1 + s Y / w²) / (1 + s Y), 1 / Y from w on"
                                         : "x · s / (1 + s Y)";
    case ToneMap::Exponential:
        return "1 − e^(−k x)";
    case ToneMap::PbrNeutral:
        return "x − f, from peak 0.76 on compressed and faded to white";
    case ToneMap::Aces:
        return "output · curve(input · x)";
    case ToneMap::AgX:
        return "(outset · S(stops(inset · x)))^2.2";
    case ToneMap::OpenColorIo:
        break;
    }
    return {};
}

// What the curve computes on its way.
std::vector<ExplainedValue> curveSteps(const View& view, const Luminance& luminance,
                                       const glm::vec3& x) {
    const float Y = shading::luminance(x);
    switch (view.toneMap) {
    case ToneMap::Reinhard:
        if (view.reinhardPerChannel)
            return {};
        return {scalar("luminance", "Luminance", "Y", Y)};
    case ToneMap::ReinhardPhotographic: {
        const float s = toneCurve(view, luminance).scale;
        std::vector<ExplainedValue> values{scalar("luminance", "Luminance", "Y", Y),
                                           scalar("key", "Key", "", s * luminance.adapted),
                                           scalar("adapted", "Luminance the Eye Is Used To", "La",
                                                  luminance.adapted, kRadianceUnit),
                                           scalar("scale", "Key / La", "s", s)};
        if (view.reinhardPerChannel)
            values.push_back(color("scaled", "Scaled", "s x", s * x));
        else
            values.push_back(scalar("scaled", "Scaled", "s Y", s * Y));
        if (view.reinhardWhite > 0.0f)
            values.push_back(scalar("white", "White From", "w", view.reinhardWhite));
        return values;
    }
    case ToneMap::Exponential:
        return {scalar("exponentialK", "Slope", "k", view.exponentialK)};
    case ToneMap::PbrNeutral: {
        const float smallest = std::min({x.x, x.y, x.z});
        const float f = pbrNeutralReflection(smallest);
        const float peak = std::max({x.x, x.y, x.z}) - f;
        std::vector<ExplainedValue> values{scalar("reflection", "Reflection Taken Away", "f", f),
                                           scalar("peak", "Largest Channel Left", "peak", peak)};
        if (peak >= kNeutralStart)
            values.push_back(scalar("compressed", "Compressed To", "", pbrNeutralPeak(peak)));
        return values;
    }
    case ToneMap::Aces: {
        const glm::vec3 input = acesInput(x);
        return {color("input", "ACEScg, Desaturated", "input", input),
                color("curve", "Through the Curve", "curve", acesCurve(input))};
    }
    case ToneMap::AgX: {
        const glm::vec3 inset = agxInset(x), stops = agxStops(inset);
        return {color("inset", "Primaries Drawn Together", "inset", inset),
                color("stops", "Share of 16.5 Stops", "stops", stops),
                color("curve", "Through the S", "S",
                      {agxCurve(stops.x), agxCurve(stops.y), agxCurve(stops.z)})};
    }
    case ToneMap::Clamp:
    case ToneMap::OpenColorIo:
        break;
    }
    return {};
}

ExplainedStep curveStep(const View& view, const Luminance& luminance, const glm::vec3& exposed) {
    const ParameterInfo& info = *findParameter("view.toneMap");
    const glm::vec3 x = finiteRadiance(exposed);
    const ToneCurve curve = toneCurve(view, luminance);
    ExplainedStep step{"toneMap",
                       "Tone Curve: " +
                           std::string(info.choiceLabels[static_cast<std::size_t>(view.toneMap)]),
                       curveFormula(view),
                       {color("exposed", "Exposed", "x", exposed)},
                       color("toneMapped", "Display-Linear", "d", toneMap(x, curve)),
                       {},
                       true,
                       {}};
    for (ExplainedValue& value : curveSteps(view, luminance, x))
        step.factors.push_back(std::move(value));
    return step;
}

ExplainedStep encodingStep(const Inspection& pixel, const View& view, const RebuiltPixel& rebuilt) {
    const bool srgb = view.displayTransfer == DisplayTransfer::Srgb;
    ExplainedStep step{"displayed",
                       "Display",
                       srgb ? "sRGB curve of d" : "d^(1 / γ)",
                       {},
                       color("displayed", "Displayed", "", glm::vec3(pixel.displayed)),
                       {},
                       true,
                       {}};
    if (!srgb)
        step.factors.push_back(scalar("displayGamma", "Gamma", "γ", view.displayGamma));
    step.result.isColor = false; // encoded
    const glm::vec3 apart = glm::abs(*rebuilt.displayed - glm::vec3(pixel.displayed));
    step.agrees = std::max({apart.x, apart.y, apart.z}) <= kDisplayedTolerance;
    step.recomputed = {rebuilt.displayed->x, rebuilt.displayed->y, rebuilt.displayed->z};
    return step;
}

// The direction that the middle of a pixel looks along.
glm::vec3 viewDirection(const Inspection& pixel, const Document& document) {
    const auto width = static_cast<float>(pixel.width), height = static_cast<float>(pixel.height);
    const Camera& camera = document.view.camera;
    const glm::mat4 clipToWorld = glm::inverse(
        camera.projectionMatrix(width / height, document.bounds()) * camera.viewMatrix());
    const glm::vec2 ndc(2.0f * (static_cast<float>(pixel.x) + 0.5f) / width - 1.0f,
                        1.0f - 2.0f * (static_cast<float>(pixel.y) + 0.5f) / height);
    const glm::vec4 far = clipToWorld * glm::vec4(ndc, 1.0f, 1.0f);
    return glm::normalize(glm::vec3(far) / far.w - camera.position());
}

} // namespace

ExplainedSection explainBackground(const Inspection& pixel, const Document& document) {
    const EnvironmentPart shown = shownEnvironment(document);
    ExplainedSection section{"background", "Background", {}, {}};
    const auto add = [&](ExplainedValue value) { section.values.push_back(std::move(value)); };
    const glm::vec3 picture =
        pixel.radiance.w > 0.0f ? glm::vec3(pixel.radiance) / pixel.radiance.w : glm::vec3(0.0f);
    const glm::vec3 direction = viewDirection(pixel, document);
    switch (document.view.background) {
    case BackgroundMode::Color:
        add(words("kind", "Shows", "a colour"));
        break;
    case BackgroundMode::Off:
        add(words("kind", "Shows", "nothing: the picture is transparent here"));
        break;
    case BackgroundMode::Environment:
    case BackgroundMode::Blurred:
        add(words("kind", "Shows",
                  document.view.background == BackgroundMode::Blurred ? "the environment, blurred"
                                                                      : "the environment"));
        add(vector3("direction", "Direction", "d", direction));
        addEnvironmentPosition(section.values, shown, direction);
        if (shown.image) {
            const glm::vec2 uv = latLongFromDirection(shown.orientation.toPicture(direction));
            add(color("texel", "Its Radiance", "",
                      glm::vec3(sampleBilinear(*shown.image, uv.x, uv.y)), kRadianceUnit));
            add(color("environmentScale", "Gain and Tint of the Environment", "", shown.scale));
        }
        break;
    }
    add(color("background", "Radiance in the Picture", "L", picture, kRadianceUnit));
    return section;
}

ExplainedSection explainSum(const Subject& subject) {
    const Inspection& pixel = subject.pixel;
    ExplainedSection section{"sum", "Sum", {}, {}};
    ExplainedStep step{"radiance",
                       "Radiance",
                       "sum of the terms",
                       {},
                       color("radiance", "Radiance", "L", subject.rebuilt.radiance, kRadianceUnit),
                       {},
                       true,
                       {}};
    for (std::size_t i = 0; i < kTermCount; ++i) {
        ExplainedValue term = ofView(subject, kTermViews[i]);
        if (!pixel.view.terms[i])
            term.label += " (off)";
        step.factors.push_back(std::move(term));
    }
    if (subject.rebuilt.alpha < 1.0f) {
        step.factors.push_back(scalar("alpha", "Opacity", "o", subject.rebuilt.alpha));
        step.formula = "o · sum of the terms";
    }
    if (subject.rebuilt.rest != glm::vec3(0.0f)) {
        step.factors.push_back(color("rest", "Behind the Surface", "", subject.rebuilt.rest));
        step.formula += " + what is behind";
    }
    if (pixel.radiance.w > 0.0f) {
        const glm::vec3 picture = glm::vec3(pixel.radiance) / pixel.radiance.w;
        step.result.numbers = {picture.x, picture.y, picture.z};
        compare(step, subject.rebuilt.radiance);
    }
    section.steps.push_back(std::move(step));
    return section;
}

ExplainedSection explainDisplay(const Inspection& pixel, const Document& document,
                                const RebuiltPixel& rebuilt) {
    const View& view = document.view;
    const Luminance& luminance = pixel.luminance;
    ExplainedSection section{"display", "Display", {}, {}};
    section.steps.push_back(exposureStep(pixel, document, rebuilt));
    if (view.toneMap == ToneMap::OpenColorIo) {
        section.values.push_back(
            words("openColorIo", "OpenColorIO",
                  fmt::format("{} / {}", view.ocioDisplay.empty() ? "default" : view.ocioDisplay,
                              view.ocioView.empty() ? "default" : view.ocioView)));
        section.values.push_back(vector3("displayed", "Displayed", "", glm::vec3(pixel.displayed)));
    } else {
        section.steps.push_back(curveStep(view, luminance, rebuilt.exposed));
        section.steps.push_back(encodingStep(pixel, view, rebuilt));
    }
    const glm::vec3 shown(pixel.displayed);
    const auto byte = [](float x) {
        return static_cast<int>(std::lround(255.0f * std::clamp(x, 0.0f, 1.0f)));
    };
    section.values.push_back(words(
        "eightBit", "In 8 Bits",
        fmt::format("{} {} {}   {}", byte(shown.x), byte(shown.y), byte(shown.z), hexText(shown))));
    return section;
}

} // namespace patina::render
