// How bright a picture is on the whole, and what the eye is used to meanwhile.
#pragma once

namespace patina::render {

// Relative luminances, never 0: kLogDelta of shaders/shared/tonemap.glsl is added to each.
struct Luminance {
    float logAverage = 0.18f; // exp(mean(log(delta + L))) of the picture, pixels weighted by alpha
    float adapted = 0.18f;    // what the eye is used to, on its way to logAverage
    float darkest = 0.18f, brightest = 0.18f;

    [[nodiscard]] bool adapting() const { return adapted != logAverage; }
    friend bool operator==(const Luminance&, const Luminance&) = default;
};

} // namespace patina::render
