// How the scene is looked at: camera, exposure, tone mapping, lighting mode, background.
#pragma once

#include "core/math/Camera.h"

#include <string>

namespace patina {

// Of core/document/ViewChoices.h.
enum class ToneMap;
enum class ExposureMode;
enum class ExposureMeter;
enum class BackgroundMode;
enum class DisplayTransfer;
enum class LightingMode;
enum class RadiosityDivision;
enum class RadiosityMethod;
enum class RadiositySolver;

struct View {
    View(); // a fixed exposure, PBR Neutral, image-based light, the environment behind

    Camera camera; // navigation is saved, but is no undo step
    ExposureMode exposureMode;
    ExposureMeter exposureMeter;
    float exposureEv = 0.0f;
    ToneMap toneMap;
    bool reinhardPerChannel = false; // of both curves of Reinhard: not on luminance
    float reinhardKey = 0.18f;       // 0.045…0.72
    bool reinhardAutoKey = false;    // the key follows from the picture's luminances
    float reinhardWhite = 0.0f;      // smallest scaled luminance that becomes white; 0: none
    float exponentialK = 1.0f;
    DisplayTransfer displayTransfer;
    float displayGamma = 2.2f;
    std::string ocioConfig;            // file; empty: $OCIO
    std::string ocioDisplay, ocioView; // empty: the configuration's defaults
    LightingMode lighting;
    int bounces = 0;                // Prt: how often light may bounce; 0: as often as the bake says
    float radiosityArea = 0.0f;     // Radiosity: m², largest of an element; 0: by the scene
    float radiosityAdaptive = 0.0f; // RadiositySettings::adaptive
    RadiosityDivision radiosityDivideBy;
    bool radiosityDynamic = false;   // RadiositySettings::dynamic; of solvers that shoot
    float radiosityPatches = 0.0f;   // RadiositySettings::patchArea; of solvers that shoot
    RadiosityMethod radiosityMethod; // of form factors
    int radiosityRays = 256;         // per element, for form factors
    int radiosityCells = 64;         // Hemicube: along an edge; an odd number counts as one more
    int radiosityPairs = 8;          // Analytic: of points that decide over a visibility
    int radiosityTexels = 128;       // Paraboloid: along the diameter
    RadiositySolver radiositySolver;
    float radiosityLinkError = 0.3f; // Hierarchical: millionths of the emitted power, of a link
    bool radiosityClassic = false;   // glowing surfaces shoot, too: RadiositySettings::classic
    BackgroundMode background;
    float backgroundBlur = 0.5f; // Blurred: perceptual roughness of the level that is shown
    glm::vec3 backgroundColor{0.05f};
    float reflectionMix = 0.5f; // 0 diffuse light only … 0.5 both in full … 1 reflections only
    friend bool operator==(const View&, const View&) = default;
};

} // namespace patina
