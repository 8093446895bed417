// What is chosen from a few possibilities in a view. View.h knows only that they exist: another
// possibility rebuilds its users, not all that know a document.
#pragma once

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
// Which pixels say how bright the picture is, for automatic exposure and the photographic key.
enum class ExposureMeter {
    Surfaces, // where an opaque surface is nearest; the frame where there is none
    Frame     // all, the background among them
};
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
    Prt,          // and light by way of other surfaces, as far as the bake holds it
    LightMap,     // image-based light, corrected by a baked light map
    Radiosity     // all light of diffuse surfaces, solved by elements (core/radiosity)
};

// How the live radiosity finds which share of an element's light arrives where …
enum class RadiosityMethod { Raycast, Hemicube, Analytic, Paraboloid }; // radiosity::FactorMethod
// … and how it solves for all of it; as radiosity::Solver.
enum class RadiositySolver {
    Gathering, // Gauss-Seidel
    Jacobi,
    Progressive,
    Southwell,
    Overshooting,
    Direct,
    Hierarchical
};

// What tells it where elements are to be divided; as radiosity::DivisionRule.
enum class RadiosityDivision { Gradient, Visibility, L1, L2, Linf };

} // namespace patina
