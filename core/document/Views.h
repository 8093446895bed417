// THE table of views: every term of the shading equation that can be looked at, described once. It
// drives the renderer, the menu, the strip, the keys, `--list-views`, the channel names of
// `--view all`, the pixel panel and the documentation. Its rows are in ViewTable.inc, which numbers
// them, too.
#pragma once

#include "core/image/ColorMap.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace patina::shading {

enum class ViewNumber {
#define VIEW(kind, ...) kind,
#include "core/document/ViewTable.inc"
    Count
};
enum class RecordNumber {
    LastView = static_cast<int>(ViewNumber::Count) - 1,
#define VIEW(kind, ...)
#define RECORD(kind) kind,
#include "core/document/ViewTable.inc"
    Count
};

// kView… and kRecord…; records come after the views.
#define VIEW(kind, ...) inline constexpr int kind = static_cast<int>(ViewNumber::kind);
#define RECORD(kind) inline constexpr int kind = static_cast<int>(RecordNumber::kind);
#include "core/document/ViewTable.inc"
inline constexpr int kViewCount = static_cast<int>(ViewNumber::Count);
inline constexpr int kRecordCount = static_cast<int>(RecordNumber::Count);

} // namespace patina::shading

namespace patina {

struct Document;
enum class MaterialInput;
enum class LightingMode;

using ViewKind = int; // one of shading::kView…

enum class ViewGroup { Picture, Material, Geometry, Factors, Direct, Ibl, Lighting };
inline constexpr int kViewGroupCount = 7;
[[nodiscard]] std::string_view viewGroupLabel(ViewGroup group);

// What the numbers of a view are, and so how they are shown.
enum class ViewValue {
    Radiance,  // rgb, scene-linear: exposed and tone mapped like the picture
    Color,     // rgb 0…rangeMax, linear: encoded for the display, neither exposed nor tone mapped
    Scalar,    // one number: through the colour map over the range
    Direction, // unit vector, world space: 0.5 + 0.5 n, as normal maps show it
    Identity,  // whole number: a colour of its own for each
    Picture    // judged from the finished picture: luminance, clipping …
};

struct ViewInfo {
    ViewKind kind = 0;
    std::string_view id;     // "perceptualRoughness": `--view`, files
    std::string_view label;  // "Roughness"
    std::string_view symbol; // as in formulas: "E(n)", "D"; empty when it has none
    ViewGroup group = ViewGroup::Picture;
    ViewValue value = ViewValue::Scalar;
    ColorMap colorMap = ColorMap::Grey;  // of Scalar
    float rangeMin = 0.0f, rangeMax = 1; // of Scalar, when it is not automatic; of Color
    bool logarithmic = false;            // Scalar: shown by its logarithm (rangeMin > 0)
    bool automaticRange = false;         // Scalar: by default the range follows the picture
    std::string_view unit;               // "m", "W/(m² sr)", "" for ratios
    float displayScale = 1.0f;     // Radiance: factor on what is displayed, beside the exposure
    std::string_view help;         // one sentence: what it is
    std::string_view contribution; // one sentence: what its contribution shows; empty: none
    std::string_view key;          // that shows it in the editor: "B", "F5"; empty: none

    // What the shader records for it: itself, or the picture that it judges or lights otherwise.
    ViewKind recorded = -1;               // in the table: itself, unless a row says otherwise
    std::optional<LightingMode> lighting; // that it stands for; nothing: the document's
    bool ofChosenLight = false;           // its numbers are of the chosen light or direction
    bool ofTransfer = false;              // shows what a bake of radiance transfer holds
    bool ofElements = false;              // shows what radiosity knows of its elements
    // Seen through exposure and tone curve, as the picture is.
    bool exposed = false;
    bool coversSurface = true; // false: a pattern over it, whose numbers say nothing

    // A row of what a pixel's explanation tells, and of its numbers in files.
    [[nodiscard]] constexpr bool isRecorded() const { return recorded == kind; }
};

[[nodiscard]] std::span<const ViewInfo> views(); // by number, kViewCount of them
[[nodiscard]] const ViewInfo& viewInfo(ViewKind kind);
[[nodiscard]] const ViewInfo* findView(std::string_view id); // null: no such view
// That of an input of the material, times its map.
[[nodiscard]] ViewKind viewOf(MaterialInput input);

// The terms of the picture's sum: diffuse and specular image-based light, diffuse and specular
// direct light, emission. Their views are kViewDiffuseIbl …; the picture is their sum.
inline constexpr int kTermCount = 5;
inline constexpr ViewKind kTermViews[kTermCount] = {
    shading::kViewDiffuseIbl, shading::kViewSpecularIbl, shading::kViewDirectDiffuse,
    shading::kViewDirectSpecular, shading::kViewEmissive};

// Why a view shows nothing in this document ("The scene has no light that is on"), as a
// sentence for the legend; empty when it applies.
[[nodiscard]] std::string whyEmpty(ViewKind kind, const Document& document);

} // namespace patina
