#include "render/view/Explanation.h"

#include "core/edit/ViewReasons.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "render/view/ExplanationParts.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>
#include <string_view>

namespace patina::render {
namespace {

void compareNumbers(ExplainedStep& step, std::vector<float> recomputed, float floor) {
    const auto close = [floor](float a, float b) {
        if (a == b || (std::isnan(a) && std::isnan(b))) // infinities, too
            return true;
        return std::abs(a - b) <= kAgreement * std::max({std::abs(a), std::abs(b), floor});
    };
    const std::vector<float>& shown = step.result.numbers;
    step.agrees = shown.size() == recomputed.size() &&
                  std::equal(shown.begin(), shown.end(), recomputed.begin(), close);
    step.recomputed = std::move(recomputed);
}

// The terms that are one bar each, and between them one bar for each light.
void addContributions(Explanation& explanation, const Subject& subject) {
    const Inspection& pixel = subject.pixel;
    const auto term = [&](std::size_t i) {
        const ViewInfo& info = viewInfo(kTermViews[i]);
        explanation.contributions.push_back(
            {std::string(info.id), std::string(info.label),
             glm::vec3(pixel.contributions[static_cast<std::size_t>(kTermViews[i])]),
             glm::vec3(0.0f), pixel.view.terms[i]});
    };
    term(0);
    term(1);
    const float diffuse = pixel.view.terms[2] ? 1.0f : 0.0f;
    const float specular = pixel.view.terms[3] ? 1.0f : 0.0f;
    const float alpha = subject.rebuilt.alpha;
    for (const LightShare& share : pixel.lights) {
        const Light* light = subject.document.light(share.light);
        const glm::vec3 highlight = specular * alpha * share.specular;
        explanation.contributions.push_back(
            {fmt::format("light{}", share.light), light ? light->name : std::string("Light"),
             diffuse * alpha * share.diffuse + highlight, highlight, diffuse + specular > 0.0f});
    }
    term(4);
    if (subject.rebuilt.rest != glm::vec3(0.0f)) {
        explanation.contributions.push_back(
            {"rest", "Seen Through the Surface", subject.rebuilt.rest, glm::vec3(0.0f), true});
    }
}

// The views that no other section tells of, so that none of the table is missing.
ExplainedSection explainOtherViews(const Subject& subject, const Explanation& explanation) {
    std::set<std::string_view> told;
    for (const ExplainedSection& section : explanation.sections) {
        for (const ExplainedValue& value : section.values)
            told.insert(value.key);
        for (const ExplainedStep& step : section.steps) {
            told.insert(step.result.key);
            for (const ExplainedValue& factor : step.factors)
                told.insert(factor.key);
        }
    }
    ExplainedSection others{"otherViews", "Other Views", {}, {}};
    for (const ViewInfo& info : views())
        if (info.isRecorded() && info.coversSurface && info.kind != shading::kViewFinal &&
            subject.pixel.recorded[static_cast<std::size_t>(info.kind)] &&
            !told.contains(info.id) &&
            whyEmpty(info.kind, subject.document, subject.pixel.view.light).empty())
            others.values.push_back(ofView(subject, info.kind));
    return others;
}

void explainSurfacePixel(Explanation& explanation, const Inspection& pixel,
                         const Document& document) {
    const MeshInstance* mesh = document.mesh(pixel.mesh);
    const Material* material = document.material(pixel.material);
    const Material fallback; // the one that meshes without a material show
    explanation.mesh = mesh ? mesh->name : std::string();
    explanation.material = material ? material->name : std::string();
    const RebuiltPixel rebuilt = recombine(pixel, document);
    const Subject subject{pixel, document, material ? *material : fallback, rebuilt};

    explanation.sections.push_back(explainSurface(subject));
    if (ExplainedSection maps = explainMaps(subject); !maps.steps.empty())
        explanation.sections.push_back(std::move(maps));
    explanation.sections.push_back(explainEnvironment(subject));
    for (std::size_t i = 0; i < rebuilt.lights.size(); ++i)
        explanation.sections.push_back(explainLight(subject, i));
    explanation.sections.push_back(explainSum(subject));
    explanation.sections.push_back(explainDisplay(pixel, document, rebuilt));
    explanation.sections.push_back(explainOtherViews(subject, explanation));
    addContributions(explanation, subject);
    explanation.exposed = rebuilt.exposed;
    explanation.displayed = glm::vec3(pixel.displayed);
    if (rebuilt.displayed) {
        const glm::vec3 apart = glm::abs(*rebuilt.displayed - explanation.displayed);
        explanation.difference = 255.0f * std::max({apart.x, apart.y, apart.z});
    }
}

void explainBackgroundPixel(Explanation& explanation, const Inspection& pixel,
                            const Document& document) {
    RebuiltPixel rebuilt;
    rebuilt.alpha = pixel.radiance.w;
    rebuilt.radiance = straight(pixel.radiance);
    expose(rebuilt, pixel, document);
    explanation.sections.push_back(explainBackground(pixel, document));
    explanation.sections.push_back(explainDisplay(pixel, document, rebuilt));
    explanation.contributions.push_back(
        {"background", "Background", glm::vec3(pixel.radiance), glm::vec3(0.0f), true});
    explanation.exposed = rebuilt.exposed;
    explanation.displayed = glm::vec3(pixel.displayed);
}

} // namespace

// --- Rows ----------------------------------------------------------------------------------------

glm::vec3 Subject::radiance(int record) const {
    return straight(pixel.value(record));
}

ExplainedValue scalar(std::string key, std::string label, std::string symbol, float x,
                      std::string unit) {
    return {std::move(key), std::move(label), std::move(symbol), {x}, {}, std::move(unit), false};
}

ExplainedValue vector2(std::string key, std::string label, std::string symbol, const glm::vec2& v,
                       std::string unit) {
    return {std::move(key), std::move(label), std::move(symbol), {v.x, v.y}, {}, std::move(unit),
            false};
}

ExplainedValue vector3(std::string key, std::string label, std::string symbol, const glm::vec3& v,
                       std::string unit) {
    return {
        std::move(key), std::move(label), std::move(symbol), {v.x, v.y, v.z}, {}, std::move(unit),
        false};
}

ExplainedValue color(std::string key, std::string label, std::string symbol, const glm::vec3& c,
                     std::string unit) {
    return {std::move(key),
            std::move(label),
            std::move(symbol),
            {c.x, c.y, c.z},
            {},
            std::move(unit),
            true};
}

ExplainedValue words(std::string key, std::string label, std::string text) {
    return {std::move(key), std::move(label), {}, {}, std::move(text), {}, false};
}

ExplainedValue ofView(const Subject& subject, ViewKind kind) {
    const ViewInfo& info = viewInfo(kind);
    const std::string key(info.id), label(info.label), symbol(info.symbol), unit(info.unit);
    switch (info.value) {
    case ViewValue::Radiance:
        return color(key, label, symbol, subject.radiance(kind), unit);
    case ViewValue::Color:
        return color(key, label, symbol, subject.vector(kind), unit);
    case ViewValue::Direction:
        return vector3(key, label, symbol, subject.vector(kind), unit);
    case ViewValue::Scalar:
    case ViewValue::Identity:
    case ViewValue::Picture:
        break;
    }
    return scalar(key, label, symbol, subject.number(kind), unit);
}

void compare(ExplainedStep& step, const glm::vec3& recomputed, float floor) {
    compareNumbers(step, {recomputed.x, recomputed.y, recomputed.z}, floor);
}

void weigh(ExplainedStep& step, float weight) {
    if (weight == 1.0f)
        return;
    step.formula += " · mix";
    step.factors.push_back(scalar("mix", "Diffuse / Reflection", "mix", weight));
}

void compare(ExplainedStep& step, float recomputed) {
    compareNumbers(step, {recomputed}, kAgreement);
}

// --- The whole -----------------------------------------------------------------------------------

bool Explanation::agrees() const {
    return std::all_of(sections.begin(), sections.end(), [](const ExplainedSection& section) {
        return std::all_of(section.steps.begin(), section.steps.end(),
                           [](const ExplainedStep& step) { return step.agrees; });
    });
}

Explanation explain(const Inspection& pixel, const Document& document) {
    Explanation explanation;
    explanation.x = pixel.x;
    explanation.y = pixel.y;
    explanation.width = pixel.width;
    explanation.height = pixel.height;
    if (pixel.onSurface())
        explainSurfacePixel(explanation, pixel, document);
    else
        explainBackgroundPixel(explanation, pixel, document);
    for (const Contribution& part : explanation.contributions)
        if (part.on)
            explanation.sum += part.radiance;
    return explanation;
}

} // namespace patina::render
