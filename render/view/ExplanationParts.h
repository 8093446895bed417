// The sections of an explanation, and how their rows are made; only explain() needs this.
#pragma once

#include "core/mix/LightMix.h"
#include "render/view/Explanation.h"
#include "render/view/Recombine.h"

#include <glm/vec2.hpp>
#include <string_view>

namespace patina::render {

// A pixel on a surface.
struct Subject {
    const Inspection& pixel;
    const Document& document;
    const Material& material;
    const RebuiltPixel& rebuilt;

    [[nodiscard]] float number(int record) const { return pixel.value(record).x; }
    [[nodiscard]] glm::vec3 vector(int record) const { return glm::vec3(pixel.value(record)); }
    [[nodiscard]] glm::vec3 radiance(int record) const; // straight
};

[[nodiscard]] ExplainedValue scalar(std::string key, std::string label, std::string symbol, float x,
                                    std::string unit = {});
[[nodiscard]] ExplainedValue vector2(std::string key, std::string label, std::string symbol,
                                     const glm::vec2& v, std::string unit = {});
[[nodiscard]] ExplainedValue vector3(std::string key, std::string label, std::string symbol,
                                     const glm::vec3& v, std::string unit = {});
[[nodiscard]] ExplainedValue color(std::string key, std::string label, std::string symbol,
                                   const glm::vec3& c, std::string unit = {});
[[nodiscard]] ExplainedValue words(std::string key, std::string label, std::string text);
// The recorded value of a view, named as the table of views names it.
[[nodiscard]] ExplainedValue ofView(const Subject& subject, ViewKind kind);

// Says in `step` what the CPU makes of its factors. Differences of numbers below `floor` count as
// those of that size.
void compare(ExplainedStep& step, const glm::vec3& recomputed, float floor = kAgreement);
void compare(ExplainedStep& step, float recomputed);

// Says that the result is weighed in the mix of diffuse light and reflections; nothing at 1.
void weigh(ExplainedStep& step, float weight);

[[nodiscard]] ExplainedSection explainMaps(const Subject& subject);
[[nodiscard]] ExplainedSection explainSurface(const Subject& subject);
[[nodiscard]] ExplainedSection explainEnvironment(const Subject& subject); // and its terms
[[nodiscard]] ExplainedSection explainLight(const Subject& subject, std::size_t index);
[[nodiscard]] ExplainedSection explainSum(const Subject& subject);
[[nodiscard]] ExplainedSection explainBackground(const Inspection& pixel, const Document& document);
[[nodiscard]] ExplainedSection explainDisplay(const Inspection& pixel, const Document& document,
                                              const RebuiltPixel& rebuilt);
// Where a direction looks in the environment.
void addEnvironmentPosition(std::vector<ExplainedValue>& values, const EnvironmentPart& environment,
                            const glm::vec3& direction);

} // namespace patina::render
