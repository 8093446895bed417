#include "core/document/Views.h"

#include "core/base/Check.h"
#include "core/document/View.h"
#include "core/document/ViewChoices.h"
#include "core/material/MaterialInputs.h"

#include <algorithm>
#include <array>

namespace patina {
namespace {

using namespace shading;

constexpr auto kPicture = ViewGroup::Picture;
constexpr auto kMaterial = ViewGroup::Material;
constexpr auto kGeometry = ViewGroup::Geometry;
constexpr auto kFactors = ViewGroup::Factors;
constexpr auto kDirect = ViewGroup::Direct;
constexpr auto kIbl = ViewGroup::Ibl;
constexpr auto kLighting = ViewGroup::Lighting;

constexpr std::string_view kScaledLight = "The part of the picture that this factor scales.";

constexpr ViewInfo row(std::string_view id, std::string_view label, std::string_view symbol,
                       ViewGroup group, ViewValue value, std::string_view help,
                       std::string_view contribution = {}) {
    ViewInfo info;
    info.id = id;
    info.label = label;
    info.symbol = symbol;
    info.group = group;
    info.value = value;
    info.help = help;
    info.contribution = contribution;
    info.exposed = value == ViewValue::Radiance;
    return info;
}
constexpr ViewInfo radiance(std::string_view id, std::string_view label, std::string_view symbol,
                            ViewGroup group, std::string_view help,
                            std::string_view contribution = {}) {
    ViewInfo info = row(id, label, symbol, group, ViewValue::Radiance, help, contribution);
    info.unit = "cd/m²";
    return info;
}
constexpr ViewInfo color(std::string_view id, std::string_view label, std::string_view symbol,
                         ViewGroup group, std::string_view help,
                         std::string_view contribution = {}) {
    return row(id, label, symbol, group, ViewValue::Color, help, contribution);
}
constexpr ViewInfo direction(std::string_view id, std::string_view label, std::string_view symbol,
                             std::string_view help) {
    ViewInfo info = row(id, label, symbol, kGeometry, ViewValue::Direction, help);
    info.rangeMin = -1.0f;
    return info;
}
constexpr ViewInfo scalar(std::string_view id, std::string_view label, std::string_view symbol,
                          ViewGroup group, ColorMap map, float min, float max,
                          std::string_view help, std::string_view contribution = {}) {
    ViewInfo info = row(id, label, symbol, group, ViewValue::Scalar, help, contribution);
    info.colorMap = map;
    info.rangeMin = min;
    info.rangeMax = max;
    return info;
}
constexpr ViewInfo judged(std::string_view id, std::string_view label, std::string_view help) {
    ViewInfo info = row(id, label, {}, kPicture, ViewValue::Picture, help);
    info.recorded = kViewFinal;
    return info;
}
constexpr ViewInfo identity(std::string_view id, std::string_view label, std::string_view help) {
    return row(id, label, {}, kGeometry, ViewValue::Identity, help);
}
// What a grey card of half the light would show of it.
constexpr ViewInfo irradiance(ViewInfo info) {
    info.displayScale = 0.5f * 0.318309886f;
    info.unit = "lx";
    return info;
}
constexpr ViewInfo luminance(ViewInfo info) {
    info.colorMap = ColorMap::Sequential;
    info.rangeMin = -6.0f;
    info.rangeMax = 6.0f;
    info.unit = "EV";
    return info;
}
constexpr ViewInfo inMaterials(ViewInfo info) {
    info.group = kMaterial;
    return info;
}
constexpr ViewInfo inTransfer(ViewInfo info) {
    info.group = kIbl;
    return info;
}
constexpr ViewInfo upTo(float rangeMax, ViewInfo info) {
    info.rangeMax = rangeMax;
    return info;
}
// A letter, or a function key, of views that are looked at often. W A S D Q E fly the camera, F, G
// and P are commands.
constexpr ViewInfo onKey(std::string_view key, ViewInfo info) {
    info.key = key;
    return info;
}
constexpr ViewInfo ofChosenLight(ViewInfo info) {
    info.ofChosenLight = true;
    return info;
}
constexpr ViewInfo ofTransfer(ViewInfo info) {
    info.ofTransfer = true;
    return info;
}
constexpr ViewInfo patterned(ViewInfo info) {
    info.coversSurface = false;
    return info;
}
// The picture, and something over it.
constexpr ViewInfo overPicture(ViewInfo info) {
    info.recorded = kViewFinal;
    info.exposed = true;
    return info;
}
// The picture, lit in another way.
constexpr ViewInfo lit(LightingMode lighting, std::string_view key, ViewInfo info) {
    info.recorded = kViewFinal;
    info.lighting = lighting;
    info.key = key;
    return info;
}
constexpr ViewInfo ofElements(ViewInfo info) {
    info.lighting = LightingMode::Radiosity;
    info.ofElements = true;
    return info;
}
constexpr ViewInfo measured(ViewInfo info, std::string_view unit, bool logarithmic) {
    info.unit = unit;
    info.logarithmic = logarithmic;
    info.automaticRange = true;
    return info;
}

constexpr ViewInfo numbered(ViewKind kind, ViewInfo info) {
    info.kind = kind;
    if (info.recorded < 0)
        info.recorded = kind;
    return info;
}

constexpr std::array<ViewInfo, kViewCount> kViews{{
#define VIEW(kind, ...) numbered(kind, __VA_ARGS__),
#include "core/document/ViewTable.inc"
}};

constexpr bool hasView(const MaterialInputInfo& input) {
    return std::any_of(kViews.begin(), kViews.end(),
                       [&](const ViewInfo& info) { return info.id == input.view; });
}
static_assert(std::all_of(kMaterialInputs.begin(), kMaterialInputs.end(), hasView),
              "a view for every input of the material");

constexpr bool keysDiffer() {
    for (std::size_t i = 0; i < kViews.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (!kViews[i].key.empty() && kViews[i].key == kViews[j].key)
                return false;
    return true;
}
static_assert(keysDiffer(), "a key shows one view");

} // namespace

std::string_view viewGroupLabel(ViewGroup group) {
    constexpr std::array<std::string_view, kViewGroupCount> kLabels{
        "Picture",      "Material",          "Geometry", "BRDF Factors",
        "Direct Light", "Image-Based Light", "Lighting"};
    return kLabels[static_cast<std::size_t>(group)];
}

std::span<const ViewInfo> views() {
    return kViews;
}

const ViewInfo& viewInfo(ViewKind kind) {
    CHECK(kind >= 0 && kind < kViewCount);
    return kViews[static_cast<std::size_t>(kind)];
}

const ViewInfo* findView(std::string_view id) {
    const auto found = std::find_if(kViews.begin(), kViews.end(),
                                    [&](const ViewInfo& info) { return info.id == id; });
    return found == kViews.end() ? nullptr : &*found;
}

ViewKind viewOf(MaterialInput input) {
    static constexpr PerInput<ViewKind> kKinds = [] {
        PerInput<ViewKind> kinds;
        for (const MaterialInputInfo& info : kMaterialInputs)
            for (const ViewInfo& view : kViews)
                if (view.id == info.view)
                    kinds[info.input] = view.kind;
        return kinds;
    }();
    return kKinds[input];
}

} // namespace patina
