#include "render/view/ExplanationParts.h"

#include "core/material/MapUv.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>

namespace patina::render {
namespace {

using namespace shading;

// What the map of an input multiplies.
ExplainedValue factorOf(const MaterialInputInfo& info, const Material& m) {
    const auto text = [](std::string_view view) { return std::string(view); };
    switch (info.role) {
    case InputRole::Color: {
        const float strength = info.input == MaterialInput::Emissive ? m.emissiveStrength : 1.0f;
        return color(text(info.id) + "Factor", text(viewInfo(viewOf(info.input)).label), "factor",
                     m.*info.color * strength);
    }
    case InputRole::Number:
        return scalar(text(info.id) + "Factor", text(viewInfo(viewOf(info.input)).label), "factor",
                      m.*info.number);
    case InputRole::Normal:
    case InputRole::Occlusion:
        break;
    }
    return scalar(text(info.id) + "Strength", "Strength", "strength", m.*info.number);
}

// Of that and the texel.
std::string formulaOf(InputRole role) {
    switch (role) {
    case InputRole::Color:
    case InputRole::Number:
        break;
    case InputRole::Normal:
        return "normalize((2 texel − 1) · (strength, ±strength, 1))";
    case InputRole::Occlusion:
        return "1 + strength · (texel − 1)";
    }
    return "factor · texel";
}

std::string_view channelName(MapChannel channel) {
    switch (channel) {
    case MapChannel::Rgb:
        return "rgb";
    case MapChannel::R:
        return "red";
    case MapChannel::G:
        return "green";
    case MapChannel::B:
        return "blue";
    case MapChannel::A:
        return "alpha";
    }
    return "rgb";
}

// What the shader reads of a texel: a colour, or the number of one channel.
glm::vec3 picked(const glm::vec4& texel, MapChannel channel, bool isColor) {
    switch (channel) {
    case MapChannel::Rgb:
        return isColor ? glm::vec3(texel) : glm::vec3(texel.x);
    case MapChannel::R:
        return glm::vec3(texel.x);
    case MapChannel::G:
        return glm::vec3(texel.y);
    case MapChannel::B:
        return glm::vec3(texel.z);
    case MapChannel::A:
        return glm::vec3(texel.w);
    }
    return glm::vec3(texel);
}

// As the file has it: whole numbers of integer files, floats of the others.
std::string storedText(const Image& image, int x, int y) {
    std::string text;
    for (int c = 0; c < std::min(image.channels(), 4); ++c) {
        const float sample = image.sample(x, y, c);
        if (image.type() == PixelType::F32)
            text += fmt::format("{}{:.5g}", c > 0 ? " " : "", sample);
        else
            text += fmt::format("{}{:.0f}", c > 0 ? " " : "",
                                sample * (image.type() == PixelType::U8 ? 255.0f : 65535.0f));
    }
    return text + (image.type() == PixelType::U8    ? " of 255"
                   : image.type() == PixelType::U16 ? " of 65535"
                                                    : "");
}

ExplainedValue number(std::string key, std::string label, std::string symbol, const glm::vec3& v,
                      bool isColor) {
    if (isColor)
        return color(std::move(key), std::move(label), std::move(symbol), v);
    return scalar(std::move(key), std::move(label), std::move(symbol), v.x);
}

ExplainedStep explainMap(const Subject& subject, const MaterialInputInfo& input) {
    const MapSlot& map = subject.material.*input.map;
    const bool isColor = !readsOneChannel(input);
    const ViewKind view = viewOf(input.input);
    const ViewInfo& info = viewInfo(view);
    ExplainedStep step{
        std::string(info.id), std::string(info.label), {}, {}, ofView(subject, view), {}, true, {}};
    step.factors.push_back(words("file", "File", map.source));
    if (!map.image) {
        step.note = "The file could not be read: " + map.problem;
        return step;
    }
    step.formula = formulaOf(input.role);
    const Image& image = *map.image;
    const glm::vec2 uv = mapUv(map, glm::vec2(subject.pixel.value(kRecordUv)));
    const glm::vec2 wrapped = uv - glm::floor(uv);
    const auto texelAt = [](float position, int size) {
        return std::clamp(static_cast<int>(position * static_cast<float>(size)), 0, size - 1);
    };
    const int x = texelAt(wrapped.x, image.width()), y = texelAt(wrapped.y, image.height());
    step.factors.push_back(vector2("mapUv", "Position", "uv", uv));
    step.factors.push_back(words(
        "texel", "Texel", fmt::format("{}, {} of {} × {}", x, y, image.width(), image.height())));
    step.factors.push_back(words("stored", "Stored", storedText(image, x, y)));
    if (map.channel != MapChannel::Rgb)
        step.factors.push_back(words("channel", "Channel", std::string(channelName(map.channel))));
    step.factors.push_back(number("linear", "Texel, Linear", "texel",
                                  picked(image.linear(x, y), map.channel, isColor), isColor));
    step.factors.push_back(number("filtered", "Between Texels", "",
                                  picked(sampleBilinear(image, uv.x, uv.y), map.channel, isColor),
                                  isColor));
    step.factors.push_back(factorOf(input, subject.material));
    step.note = "The shader averages the texels that the pixel covers.";
    return step;
}

} // namespace

ExplainedSection explainMaps(const Subject& subject) {
    ExplainedSection section{"maps", "Maps", {}, {}};
    for (const MaterialInputInfo& input : kMaterialInputs)
        if ((subject.material.*input.map).assigned())
            section.steps.push_back(explainMap(subject, input));
    return section;
}

namespace {

std::string f0Formula(Fresnel fresnel, bool ownIndex) {
    const std::string dielectric =
        ownIndex || fresnel == Fresnel::Dielectric ? "((n − 1) / (n + 1))²" : "0.04";
    const char* metal = fresnel == Fresnel::Conductor ? "F(n + ik, 0°)" : "c";
    return fmt::format("{} · (1 − m) + {} · m", dielectric, metal);
}

ExplainedStep f0Step(const Subject& subject) {
    const ShadingModel& model = subject.document.model;
    const SurfaceTerms& s = subject.rebuilt.surface;
    const bool ownIndex = subject.material.ior != kDielectricIor;
    ExplainedStep step{"f0",
                       "Reflectance at Normal Incidence",
                       f0Formula(model.fresnel, ownIndex),
                       {color("baseColor", "Base Colour", "c", subject.vector(kViewBaseColor)),
                        scalar("metallic", "Metallic", "m", s.metallic)},
                       color("f0", "F0", "F0", subject.vector(kViewF0)),
                       {},
                       true,
                       {}};
    if (ownIndex || model.fresnel == Fresnel::Dielectric)
        step.factors.push_back(scalar("ior", "Index of Refraction", "n", s.model.ior));
    if (model.fresnel == Fresnel::Conductor) {
        step.factors.push_back(color("conductorN", "Conductor n", "n", model.conductorN));
        step.factors.push_back(color("conductorK", "Conductor k", "k", model.conductorK));
    }
    compare(step, s.f0);
    return step;
}

} // namespace

ExplainedSection explainSurface(const Subject& subject) {
    const SurfaceTerms& s = subject.rebuilt.surface;
    ExplainedSection section{"surface", "Surface", {}, {}};
    const auto add = [&](ExplainedValue value) { section.values.push_back(std::move(value)); };
    add(vector3("position", "Position", "p", subject.vector(kRecordPosition), "m"));
    add(ofView(subject, kViewDepth));
    add(vector2("uv", "Texture Coordinates", "uv", glm::vec2(subject.pixel.value(kRecordUv))));
    add(ofView(subject, kViewGeometricNormal));
    add(ofView(subject, kViewShadingNormal));
    add(ofView(subject, kViewTangent));
    add(ofView(subject, kViewBitangent));
    add(vector3("toViewer", "To the Viewer", "v", subject.vector(kRecordToViewer)));
    add(ofView(subject, kViewNoV));
    add(ofView(subject, kViewBaseColor));
    for (const MaterialInputInfo& input : kMaterialInputs)
        if (input.role == InputRole::Number)
            add(ofView(subject, viewOf(input.input)));
    add(ofView(subject, kViewAo));
    if (subject.material.alphaMode == AlphaMode::Blend)
        add(scalar("alpha", "Opacity", "o", subject.number(kViewAlpha)));

    ExplainedStep diffuse{
        "diffuseColor",
        "Diffuse Colour",
        "c · (1 − m)",
        {color("baseColor", "Base Colour", "c", subject.vector(kViewBaseColor)),
         scalar("metallic", "Metallic", "m", s.metallic)},
        color("diffuseColor", "Diffuse Colour", "ρd", subject.vector(kRecordDiffuseColor)),
        {},
        true,
        {}};
    if (const float through = subject.number(kViewTransmissive); through > 0.0f) {
        diffuse.formula += " · (1 − t)";
        diffuse.factors.push_back(scalar("transmission", "Transmission", "t", through));
    }
    compare(diffuse, s.diffuseColor);
    section.steps.push_back(std::move(diffuse));
    section.steps.push_back(f0Step(subject));
    section.steps.push_back(
        {"alphaRoughness",
         "Roughness of the Terms",
         fmt::format("max(r, {:.3f})²", kMinPerceptualRoughness),
         {scalar("perceptualRoughness", "Roughness", "r", s.perceptualRoughness)},
         scalar("alphaRoughness", "α", "α", s.alpha),
         {},
         true,
         {}});
    return section;
}

} // namespace patina::render
