// The document: everything the user made, as one value. A copy is a snapshot (heavy payloads are
// shared and immutable); everything else in Patina is a view of it.
#pragma once

#include "core/bake/BakeArtifact.h"
#include "core/image/Image.h"
#include "core/material/Material.h"
#include "core/math/Camera.h"
#include "core/mesh/Mesh.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace patina {

struct MeshInstance {
    Id id = 0;
    std::string name;
    // Where the mesh came from: absolute path (UTF-8) or "builtin:NAME", and which of its
    // instances.
    std::string source;
    int sourceIndex = 0;
    MeshPtr mesh; // never null in a resolved document
    glm::mat4 transform{1.0f};
    Id material = 0;
    bool visible = true;
    friend bool operator==(const MeshInstance&, const MeshInstance&) = default;
};

enum class LightType { Point, Directional, Spot, Sphere, Rectangle };

// Every light emits along -directionToLight() where it has a direction (directional, spot,
// rectangle).
struct Light {
    Id id = 0;
    std::string name = "Light";
    LightType type = LightType::Directional;
    bool enabled = true;
    bool solo = false; // while anything is solo, everything else is off: LightMix.h
    bool usesTemperature = false;
    glm::vec3 color{1.0f};        // linear sRGB
    float temperatureK = 6500.0f; // of a black body; replaces `color` when usesTemperature
    // Directional: lux at normal incidence (E); point and spot: candela (I, at the spot's centre);
    // sphere and rectangle: nit (radiance L). Radiometrically the same numbers: 1 W ≙ 1 lm.
    float intensity = 3.0f;
    float gainEv = 0.0f;                  // the mixer's: scales the light by 2^EV
    glm::vec3 tint{1.0f};                 // the mixer's, linear sRGB: multiplies the light's colour
    glm::vec3 position{2.0f, 3.0f, 2.0f}; // metres; not of a directional light
    float azimuthDeg = 40.0f;             // where the light comes from, around +Y, 0 is +Z
    float elevationDeg = 45.0f;           // above the horizon
    float rollDeg = 0.0f;                 // rectangle: about its own direction
    float range = 0.0f;          // metres, 0: without end; glTF's windowed falloff (not area)
    float innerConeDeg = 20.0f;  // spot: half angle of full intensity
    float outerConeDeg = 35.0f;  // spot: half angle where it ends
    float radius = 0.25f;        // metres, sphere
    float width = 1.0f;          // metres, rectangle, along its local x
    float height = 1.0f;         // metres, rectangle
    bool castsShadow = true;     // spot and directional
    float shadowSoftness = 1.0f; // degrees: apparent diameter of the source, seen from the scene
    [[nodiscard]] glm::vec3 directionToLight() const; // unit vector
    friend bool operator==(const Light&, const Light&) = default;
};

// How the pixels of an environment file cover the sphere of directions (docs/maths/ibl.md).
enum class EnvironmentLayout {
    Automatic, // guessed from the file when it is loaded
    LatLong,
    AngularMap,
    MirrorBall,
    HorizontalCross,
    VerticalCross,
    HorizontalStrip,
    VerticalStrip,
    SixFaces // one file per face; `source` names the +X one
};

enum class EnvironmentKind { Image, Sky, Softboxes };
enum class BackgroundMode { Environment, Blurred, Color, Off };

// An analytic clear sky with a sun.
struct Sky {
    float sunAzimuthDeg = 40.0f;   // where the sun stands, around +Y, 0 is +Z
    float sunElevationDeg = 35.0f; // above the horizon
    float turbidity = 3.0f;        // 2 very clear … 10 hazy
    float groundAlbedo = 0.3f;
    float sunScale = 1.0f;        // multiplies the sun's radiance; 0: no disc
    float sunDiameterDeg = 0.53f; // larger: softer, its light staying the same
    friend bool operator==(const Sky&, const Sky&) = default;
};

// A luminous rectangle on the sphere of directions.
struct Softbox {
    Id id = 0;
    std::string name = "Softbox";
    bool enabled = true;
    float azimuthDeg = 0.0f;    // of its centre, around +Y, 0 is +Z
    float elevationDeg = 30.0f; // of its centre, above the horizon
    float widthDeg = 40.0f, heightDeg = 30.0f;
    float rollDeg = 0.0f;    // counter-clockwise, seen from the centre
    float softness = 0.1f;   // share of the smaller half size over which its edge fades, 0…1
    glm::vec3 color{1.0f};   // linear sRGB
    float intensity = 10.0f; // radiance (nit)
    friend bool operator==(const Softbox&, const Softbox&) = default;
};

// Another picture of an environment, to fade to. Conventions of Environment, where it is a part.
struct SecondEnvironment {
    std::string source;  // absolute path or builtin:NAME; empty: there is none
    ImagePtr image;      // of the file; null where there is none
    std::string problem; // why it could not be read; there is then no image
    bool enabled = true;
    bool solo = false;
    float rotationDeg = 0.0f;
    float exposureEv = 0.0f;
    glm::vec3 tint{1.0f}; // linear sRGB
    friend bool operator==(const SecondEnvironment&, const SecondEnvironment&) = default;
};

// A lat-long environment: the centre of the image is -Z, its top +Y, u grows to the right as seen
// from inside: u = 0.5 + atan2(x, -z) / 2pi, v = acos(y) / pi.
struct Environment {
    EnvironmentKind kind = EnvironmentKind::Image;
    std::string source = "builtin:studio";                   // Image: absolute path or builtin:NAME
    EnvironmentLayout layout = EnvironmentLayout::Automatic; // Image: of the file
    // F32 linear, 3 channels, w = 2h: of the file, or generated from `sky` or the softboxes
    // (resolveEnvironment() of core/light/GeneratedEnvironment.h).
    ImagePtr image;
    ImagePtr fileImage;  // what `source` holds, kept while another kind lights the scene
    std::string problem; // why it could not be read; a neutral grey stands in
    Sky sky;
    glm::vec3 softboxAmbient{0.02f}; // radiance between the softboxes
    std::vector<Softbox> softboxes;
    float rotationDeg = 0.0f; // rotates the environment about +Y, counter-clockwise from above
    float exposureEv = 0.0f;  // scales radiance by 2^EV
    bool enabled = true;      // off: its light is not in the scene, nor is it seen
    bool solo = false;        // as of a light
    glm::vec3 tint{1.0f};     // linear sRGB, multiplies radiance
    SecondEnvironment second;
    float fade = 0.0f; // 0: only this one … 1: only the second; shares of their light (LightMix.h)
    ImagePtr blended;  // one picture of both where both light the scene (EnvironmentBlend.h)
    BackgroundMode background = BackgroundMode::Environment;
    float backgroundBlur = 0.5f; // Blurred: perceptual roughness of the level that is shown
    glm::vec3 backgroundColor{0.05f};
    friend bool operator==(const Environment&, const Environment&) = default;
};

// Which terms make up the surface's reflection: shaders/shared/brdf.glsl has each of them. The
// enumerators' values are the numbers used there.
enum class Distribution { GGX, Beckmann, BlinnPhong };
enum class Visibility {
    SmithCorrelated,
    SmithSeparable,
    SchlickDirect, // Schlick-GGX, k = (r + 1)² / 8
    SchlickIbl,    // Schlick-GGX, k = alpha / 2
    Kelemen,
    Implicit
};
enum class Fresnel { Schlick, SchlickF90, Dielectric, Conductor };
enum class Diffuse { Lambert, Burley, OrenNayar, Eon };
// Where image-based specular light is looked up: along the lobe's mean direction, or classically
// along the mirror direction.
enum class LobeDirection { Mean, Mirror };

struct ShadingModel {
    Distribution distribution = Distribution::GGX;
    Visibility visibility = Visibility::SmithCorrelated;
    Fresnel fresnel = Fresnel::Schlick;
    Diffuse diffuse = Diffuse::Lambert;
    bool multiScatter = true; // energy compensation (Turquin 2019)
    LobeDirection lobeDirection = LobeDirection::Mean;
    float f90 = 1.0f;                          // SchlickF90: reflectance at grazing incidence
    float ior = 1.5f;                          // Dielectric: refractive index of non-metals
    glm::vec3 conductorN{0.18f, 0.42f, 1.37f}; // Conductor: complex index of metals, gold
    glm::vec3 conductorK{3.42f, 2.35f, 1.77f};
    friend bool operator==(const ShadingModel&, const ShadingModel&) = default;
};

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
    int bounces = 0;            // Prt: how often light may bounce; 0: as often as the bake says
    float reflectionMix = 0.5f; // 0 diffuse light only … 0.5 both in full … 1 reflections only
    friend bool operator==(const View&, const View&) = default;
};

struct Document {
    std::vector<MeshInstance> meshes;
    std::vector<Material> materials;
    std::vector<Light> lights;
    Environment environment;
    ShadingModel model;
    View view;
    std::vector<BakeArtifactPtr> bakes; // at most one of each BakeKind
    Id nextId = 1;

    [[nodiscard]] Id takeId() { return nextId++; }
    [[nodiscard]] const Material* material(Id id) const;
    [[nodiscard]] Material* material(Id id);
    [[nodiscard]] const Light* light(Id id) const;
    [[nodiscard]] Light* light(Id id);
    [[nodiscard]] const Softbox* softbox(Id id) const;
    [[nodiscard]] Softbox* softbox(Id id);
    [[nodiscard]] const MeshInstance* mesh(Id id) const;
    [[nodiscard]] MeshInstance* mesh(Id id);
    [[nodiscard]] Bounds bounds() const;             // of the visible meshes, in the world
    [[nodiscard]] std::size_t triangleCount() const; // visible
    friend bool operator==(const Document&, const Document&) = default;
};

} // namespace patina
