// Light from all around, as plain values: a picture, a sky or softboxes; and the mix of two.
#pragma once

#include "core/base/Id.h"
#include "core/image/Image.h"

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace patina {

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

// A lat-long environment: the centre of the image is -Z, its top +Y, u grows to the right as seen
// from inside: u = 0.5 + atan2(x, -z) / 2pi, v = acos(y) / pi.
struct Environment {
    Id id = 0;
    std::string name; // empty: called by what it shows (environmentTitle())
    EnvironmentKind kind = EnvironmentKind::Image;
    std::string source = "builtin:studio";                   // Image: absolute path or builtin:NAME
    EnvironmentLayout layout = EnvironmentLayout::Automatic; // Image: of the file
    // F32 linear, 3 channels, w = 2h: of the file, or generated from `sky` or the softboxes
    // (resolveEnvironment() of core/light/GeneratedEnvironment.h).
    ImagePtr image;
    // Image: how many of its brightest sources are taken out of `image`, because lights stand for
    // them (core/light/BrightSources.h), 0 … kMostBrightSources.
    int removedSources = 0;
    ImagePtr fileImage;  // what `source` holds, kept while another kind lights the scene
    std::string problem; // why it could not be read; a neutral grey stands in
    Sky sky;
    glm::vec3 softboxAmbient{0.02f}; // radiance between the softboxes
    std::vector<Softbox> softboxes;
    // How it stands in the world: Orientation of core/light/Orientation.h.
    float rotationDeg = 0.0f, tiltDeg = 0.0f, rollDeg = 0.0f;
    float exposureEv = 0.0f; // scales radiance by 2^EV
    bool enabled = true;     // off: its light is not in the scene, nor is it seen
    bool solo = false;       // as of a light
    glm::vec3 tint{1.0f};    // linear sRGB, multiplies radiance
    friend bool operator==(const Environment&, const Environment&) = default;
};

// Which environments of a document light its scene.
struct EnvironmentMix {
    Id first = 0;      // always one of them
    Id second = 0;     // another one, to fade to; 0: none
    float fade = 0.0f; // 0: only the first … 1: only the second; shares of their light (LightMix.h)
    ImagePtr blended; // one picture of both where both light the scene (EnvironmentBlend.h)
    friend bool operator==(const EnvironmentMix&, const EnvironmentMix&) = default;
};

} // namespace patina
