// Values of the shared terms that are known from papers and closed forms, for the CPU and the GPU.
// Bodies are C++ and, as text, GLSL: see SharedTermCases.h.
#pragma once

#include <string>
#include <vector>

namespace patina::render {

enum class Tolerance { Absolute, Relative };

struct KnownValue {
    std::vector<float> inputs;
    std::vector<double> expected;
};

struct KnownValueCase {
    std::string name;
    double tolerance;
    Tolerance kind;
    std::string body; // as GLSL
    void (*run)(const float* in, float* out);
    std::vector<KnownValue> values;
};

[[nodiscard]] const std::vector<KnownValueCase>& knownValueCases();

} // namespace patina::render
