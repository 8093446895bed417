// How the scene is looked at: camera, exposure, tone mapping, lighting mode, background.
#pragma once

#include "core/math/Camera.h"

#include <string>

namespace patina {

enum class ToneMap {
    Clamp,
    Reinhard,             // L / (1 + L)
    ReinhardPhotographic, // key over the log-average luminance, optional white point
    Exponential,          // 1 - exp(-k L)
    PbrNeutral,           // Khronos
    Aces,                 // fitted
    AgX,
    OpenColorIo // display and view of the configuration; only when there is one
};
enum class ExposureMode { Fixed, Automatic };
// What is seen behind the scene.
enum class BackgroundMode { Environment, Blurred, Color, Off };
enum class DisplayTransfer { Srgb, Gamma };
// How the environment lights the scene, from one directional light to everything that a bake knows.
enum class LightingMode {
    Ibl,          // split-sum image-based light, with ambient occlusion
    Cosine,       // N·L: the dominant light of the environment
    ShIrradiance, // irradiance from nine coefficients, nothing hidden
    Unshadowed,   // transfer of an open sky, per vertex, in as many bands as the bake
    Shadowed,     // baked transfer: what the scene hides
    Prt           // and light by way of other surfaces, as far as the bake holds it
};

struct View {
    Camera camera; // navigation is saved, but is no undo step
    ExposureMode exposureMode = ExposureMode::Fixed;
    float exposureEv = 0.0f;
    ToneMap toneMap = ToneMap::PbrNeutral;
    float reinhardKey = 0.18f;    // 0.045…0.72
    bool reinhardAutoKey = false; // the key follows from the picture's luminances
    float reinhardWhite = 0.0f;   // smallest scaled luminance that becomes white; 0: none
    float exponentialK = 1.0f;
    DisplayTransfer displayTransfer = DisplayTransfer::Srgb;
    float displayGamma = 2.2f;
    std::string ocioConfig;            // file; empty: $OCIO
    std::string ocioDisplay, ocioView; // empty: the configuration's defaults
    LightingMode lighting = LightingMode::Ibl;
    int bounces = 0; // Prt: how often light may bounce; 0: as often as the bake says
    BackgroundMode background = BackgroundMode::Environment;
    float backgroundBlur = 0.5f; // Blurred: perceptual roughness of the level that is shown
    glm::vec3 backgroundColor{0.05f};
    float reflectionMix = 0.5f; // 0 diffuse light only … 0.5 both in full … 1 reflections only
    friend bool operator==(const View&, const View&) = default;
};

} // namespace patina
