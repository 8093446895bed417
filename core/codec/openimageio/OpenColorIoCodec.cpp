// The only file that sees OpenColorIO: a view of a configuration as shader text and tables.
#include "core/codec/openimageio/OpenImageIoCodec.h"

#include <OpenColorIO/OpenColorIO.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <vector>

namespace OCIO = OCIO_NAMESPACE;

namespace patina::codec {

namespace {

using nlohmann::json;

constexpr int kCurveStops = 8, kCurvePoints = 257; // as DisplayTransform::curve

// Linear Rec.709 as configurations call it: ACES 1.x, ACES 2 and the CG configs, Blender, others.
constexpr std::array kLinearRec709 = {
    "Linear Rec.709 (sRGB)", "lin_rec709", "lin_rec709_srgb", "Utility - Linear - sRGB", "lin_srgb",
    "Linear Rec.709",        "Linear sRGB"};

OCIO::ConstConfigRcPtr openConfig(const json& request) {
    std::string path;
    for (const int byte : request.at("path"))
        path += static_cast<char>(byte);
    OCIO::SetLoggingLevel(OCIO::LOGGING_LEVEL_WARNING);
    try {
        OCIO::ConstConfigRcPtr config = OCIO::Config::CreateFromFile(path.c_str());
        config->validate();
        if (config->getNumDisplays() == 0)
            throw Refusal("the OpenColorIO configuration has no displays; choose another one");
        return config;
    } catch (const OCIO::Exception& exception) {
        throw Refusal("this is no OpenColorIO configuration that can be used; choose another one "
                      "or correct what is said about it",
                      exception.what());
    }
}

std::vector<std::string> viewsOf(const OCIO::ConstConfigRcPtr& config, const char* display) {
    std::vector<std::string> views;
    for (int i = 0; i < config->getNumViews(display); ++i)
        views.emplace_back(config->getView(display, i));
    return views;
}

std::vector<std::string> displaysOf(const OCIO::ConstConfigRcPtr& config) {
    std::vector<std::string> displays;
    for (int i = 0; i < config->getNumDisplays(); ++i)
        displays.emplace_back(config->getDisplay(i));
    return displays;
}

std::string choose(const std::string& wanted, const char* fallback,
                   const std::vector<std::string>& names, const char* what) {
    if (wanted.empty())
        return fallback;
    if (std::find(names.begin(), names.end(), wanted) == names.end())
        throw Refusal(fmt::format("the OpenColorIO configuration has no {} \"{}\"; it has {}", what,
                                  wanted, fmt::join(names, ", ")));
    return wanted;
}

// Everything from linear Rec.709 to the display; `space` says how the one enters the configuration.
OCIO::ConstProcessorRcPtr makeProcessor(const OCIO::ConstConfigRcPtr& config,
                                        const std::string& display, const std::string& view,
                                        std::string& space) {
    auto group = OCIO::GroupTransform::Create();
    std::string source;
    if (config->hasRole("aces_interchange")) {
        // Exact, whatever the configuration calls its spaces.
        auto toAcesCg = OCIO::BuiltinTransform::Create();
        toAcesCg->setStyle("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD");
        toAcesCg->setDirection(OCIO::TRANSFORM_DIR_INVERSE);
        group->appendTransform(toAcesCg);
        auto toAces = OCIO::BuiltinTransform::Create();
        toAces->setStyle("ACEScg_to_ACES2065-1");
        group->appendTransform(toAces);
        source = "aces_interchange";
        space = "aces_interchange, by the matrices from linear Rec.709 to ACES2065-1";
    } else {
        for (const char* name : kLinearRec709)
            if (source.empty() && config->getColorSpace(name))
                source = name;
        space = "colour space " + source;
        if (source.empty() && config->hasRole(OCIO::ROLE_SCENE_LINEAR)) {
            source = OCIO::ROLE_SCENE_LINEAR;
            space = fmt::format("scene_linear ({}), taken to have Rec.709 primaries",
                                config->getColorSpace(OCIO::ROLE_SCENE_LINEAR)->getName());
        }
    }
    if (source.empty())
        throw Refusal("the OpenColorIO configuration has neither the role aces_interchange nor a "
                      "linear Rec.709 colour space nor the role scene_linear; add one of them");
    auto shown = OCIO::DisplayViewTransform::Create();
    shown->setSrc(source.c_str());
    shown->setDisplay(display.c_str());
    shown->setView(view.c_str());
    group->appendTransform(shown);
    return config->getProcessor(group);
}

// Tables of the shader; their values go to `values`.
json describeTables(const OCIO::GpuShaderDescRcPtr& shader, std::vector<float>& values) {
    json tables = json::array();
    const auto add = [&](const char* sampler, unsigned width, unsigned height, unsigned depth,
                         unsigned channels, bool linear, const float* data) {
        tables.push_back({{"sampler", sampler},
                          {"width", width},
                          {"height", height},
                          {"depth", depth},
                          {"channels", channels},
                          {"linear", linear}});
        const std::size_t count =
            std::size_t{width} * std::max(height, 1u) * std::max(depth, 1u) * channels;
        values.insert(values.end(), data, data + count);
    };
    for (unsigned i = 0; i < shader->getNumTextures(); ++i) {
        const char *texture = nullptr, *sampler = nullptr;
        unsigned width = 0, height = 0;
        auto channel = OCIO::GpuShaderDesc::TEXTURE_RGB_CHANNEL;
        auto interpolation = OCIO::INTERP_LINEAR;
        shader->getTexture(i, texture, sampler, width, height, channel, interpolation);
        const float* data = nullptr;
        shader->getTextureValues(i, data);
        // A table of one row is read through a sampler1D.
        add(sampler, width, height > 1 ? height : 0, 0,
            channel == OCIO::GpuShaderDesc::TEXTURE_RED_CHANNEL ? 1 : 3,
            interpolation != OCIO::INTERP_NEAREST, data);
    }
    for (unsigned i = 0; i < shader->getNum3DTextures(); ++i) {
        const char *texture = nullptr, *sampler = nullptr;
        unsigned edge = 0;
        auto interpolation = OCIO::INTERP_LINEAR;
        shader->get3DTexture(i, texture, sampler, edge, interpolation);
        const float* data = nullptr;
        shader->get3DTextureValues(i, data);
        // The shader of the tetrahedral interpolation reads whole texels.
        add(sampler, edge, edge, edge, 3,
            interpolation != OCIO::INTERP_NEAREST && interpolation != OCIO::INTERP_TETRAHEDRAL,
            data);
    }
    return tables;
}

json greyCurve(const OCIO::ConstProcessorRcPtr& processor) {
    const OCIO::ConstCPUProcessorRcPtr cpu = processor->getDefaultCPUProcessor();
    json curve = json::array();
    for (int i = 0; i < kCurvePoints; ++i) {
        const double stops = kCurveStops * (2.0 * i / (kCurvePoints - 1) - 1.0);
        std::array<float, 3> pixel{};
        pixel.fill(static_cast<float>(0.18 * std::exp2(stops)));
        cpu->applyRGB(pixel.data());
        const float shown = 0.2126f * pixel[0] + 0.7152f * pixel[1] + 0.0722f * pixel[2];
        curve.push_back(std::isfinite(shown) ? std::clamp(shown, 0.0f, 1.0f) : 0.0f);
    }
    return curve;
}

} // namespace

Reply displayMenu(const json& request) {
    const OCIO::ConstConfigRcPtr config = openConfig(request);
    json displays = json::array();
    for (const std::string& display : displaysOf(config)) {
        const std::vector<std::string> views = viewsOf(config, display.c_str());
        if (!views.empty())
            displays.push_back({{"name", display},
                                {"defaultView", config->getDefaultView(display.c_str())},
                                {"views", views}});
    }
    Reply reply;
    reply.header =
        toJsonText({{"displays", displays}, {"defaultDisplay", config->getDefaultDisplay()}});
    reply.payload = allocate(0);
    return reply;
}

Reply displayTransform(const json& request) {
    const OCIO::ConstConfigRcPtr config = openConfig(request);
    const std::string display =
        choose(request.at("display"), config->getDefaultDisplay(), displaysOf(config), "display");
    const std::string view =
        choose(request.at("view"), config->getDefaultView(display.c_str()),
               viewsOf(config, display.c_str()),
               fmt::format("view for the display \"{}\" called", display).c_str());
    try {
        std::string space;
        const OCIO::ConstProcessorRcPtr processor = makeProcessor(config, display, view, space);
        OCIO::GpuShaderDescRcPtr shader = OCIO::GpuShaderDesc::CreateShaderDesc();
        shader->setLanguage(OCIO::GPU_LANGUAGE_GLSL_4_0);
        shader->setFunctionName("ocioDisplay");
        shader->setResourcePrefix("ocio_");
        processor->getDefaultGPUProcessor()->extractGpuShaderInfo(shader);

        std::vector<float> values;
        const json tables = describeTables(shader, values);
        Reply reply;
        reply.header = toJsonText({{"display", display},
                                   {"view", view},
                                   {"space", space},
                                   {"shader", shader->getShaderText()},
                                   {"tables", tables},
                                   {"curve", greyCurve(processor)}});
        reply.payload = allocate(values.size() * sizeof(float));
        if (!values.empty())
            std::memcpy(reply.payload.writable().data(), values.data(),
                        values.size() * sizeof(float));
        return reply;
    } catch (const OCIO::Exception& exception) {
        throw Refusal(fmt::format("OpenColorIO cannot make the view \"{}\" of the display \"{}\"; "
                                  "choose another one or correct the configuration",
                                  view, display),
                      exception.what());
    }
}

} // namespace patina::codec
