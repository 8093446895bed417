#include "app/editor/viewport/LegendContent.h"

#include "app/editor/document/QtText.h"
#include "app/editor/viewport/ViewState.h"
#include "core/document/Document.h"
#include "core/edit/ViewReasons.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/material/Material.h"
#include "core/math/Shading.h"
#include "core/mix/LightMix.h"

#include <QCoreApplication>
#include <algorithm>

namespace patina::editor {
namespace {

using namespace shading;

constexpr std::size_t kMostSwatches = 8;

QString trLegend(const char* text) {
    return QCoreApplication::translate("LegendContent", text);
}

// Names of what is visible, in the colours of shaders/view.frag.
template <class Things, class Keep>
void addIdentities(LegendContent& content, const Things& things, Keep keep) {
    for (const auto& thing : things) {
        if (!keep(thing))
            continue;
        if (content.swatches.size() == kMostSwatches) {
            ++content.moreSwatches;
            continue;
        }
        const glm::vec3 color = identityColor(static_cast<float>(thing.id));
        content.swatches.push_back(
            {QColor::fromRgbF(color.r, color.g, color.b), QString::fromStdString(thing.name)});
    }
}

// The colours of shaders/view.frag and tonemap.frag.
void addMarks(LegendContent& content) {
    switch (content.kind) {
    case kViewInvalid:
        content.swatches = {{QColor::fromRgbF(1.0f, 0.0f, 1.0f), trLegend("Not a number")},
                            {QColor::fromRgbF(1.0f, 0.9f, 0.0f), trLegend("Infinite")},
                            {QColor::fromRgbF(0.0f, 0.9f, 0.9f), trLegend("Negative")}};
        break;
    case kViewClipped:
        content.swatches = {{QColor::fromRgbF(1.0f, 0.15f, 0.1f), trLegend("One channel clipped")},
                            {Qt::white, trLegend("All channels clipped")},
                            {QColor::fromRgbF(0.1f, 0.25f, 1.0f), trLegend("Black")}};
        break;
    case kViewOutOfGamut:
        content.swatches = {{QColor::fromRgbF(1.0f, 0.2f, 0.8f), trLegend("A channel below zero")}};
        break;
    default:
        break;
    }
}

void describeColors(LegendContent& content, const ViewInfo& info, const Document& document) {
    switch (info.value) {
    case ViewValue::Radiance:
        content.note = trLegend("Exposed and tone mapped like the picture");
        break;
    case ViewValue::Color:
        content.note = trLegend("Raw 0…%1").arg(static_cast<double>(info.rangeMax));
        break;
    case ViewValue::Scalar:
        content.hasScale = true;
        break;
    case ViewValue::Direction:
        content.note =
            info.kind == kViewNormalMap
                ? trLegend("Red, green, blue: along the tangent, the bitangent, the normal")
                : trLegend("Red, green, blue: X, Y, Z from −1 to 1");
        break;
    case ViewValue::Identity:
        if (info.kind == kViewMaterialId)
            addIdentities(content, document.materials, [&](const Material& material) {
                return std::any_of(document.meshes.begin(), document.meshes.end(),
                                   [&](const MeshInstance& mesh) {
                                       return mesh.visible && mesh.material == material.id;
                                   });
            });
        else
            addIdentities(content, document.meshes,
                          [](const MeshInstance& mesh) { return mesh.visible; });
        break;
    case ViewValue::Picture:
        content.hasScale = info.kind == kViewLuminance;
        addMarks(content);
        break;
    }
}

void addLights(LegendContent& content, const render::ViewSettings& settings,
               const Document& document) {
    content.light = settings.light;
    content.lights.push_back(
        {0, content.kind == kViewShadow ? trLegend("All lights") : trLegend("Mirror direction")});
    for (const Light& light : document.lights)
        if (isActive(document, light))
            content.lights.push_back({light.id, QString::fromStdString(light.name)});
}

} // namespace

LegendContent describeView(const render::ViewSettings& settings, const render::ViewChoice& choice,
                           const Document& document) {
    const ViewInfo& info = viewInfo(choice.kind);
    LegendContent content;
    content.kind = choice.kind;
    content.symbol = toQString(info.symbol);
    content.title = toQString(info.label);
    content.help = toQString(info.help) + QLatin1Char('.');
    content.contribution = choice.mode == render::ViewMode::Contribution;
    content.hasModes = !info.contribution.empty();
    if (content.hasModes)
        content.help += trLegend("\nContribution: ") + toQString(info.contribution);
    content.why = QString::fromStdString(whyEmpty(choice.kind, document, settings.light));
    if (!content.why.isEmpty()) {
        content.hasModes = false;
        content.remedy = viewRemedy(choice.kind, document);
        if (whyEmpty(choice.kind, document).empty())
            addLights(content, settings, document); // another light would do
        return content;
    }
    if (choice.kind == kViewFinal)
        return content; // beside a split its name says it all
    if (content.contribution) {
        content.note = toQString(info.contribution);
    } else {
        content.unit = toQString(info.unit);
        describeColors(content, info, document);
    }
    if (info.ofChosenLight)
        addLights(content, settings, document);
    return content;
}

} // namespace patina::editor
