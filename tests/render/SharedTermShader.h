// The compute shader that runs a case's body over a buffer of inputs.
#pragma once

#include <string>

namespace patina::render {

inline constexpr int kCaseGroup = 64; // sets of inputs per work group

// Inputs: kCaseInputs floats a set in storage 0; outputs: kCaseOutputs floats in storage 1.
[[nodiscard]] std::string sharedTermShader(const std::string& body);

} // namespace patina::render
