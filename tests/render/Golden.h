// Golden pictures: what the renderer drew when somebody looked at it and found it right.
#pragma once

#include "core/image/Image.h"

#include <string>

namespace patina {

// How far a picture may be from its golden one, in 1/255 of a channel. Other processors round
// differently inside llvmpipe: single steps everywhere, a few more at silhouettes.
struct GoldenLimits {
    float max = 16.0f;
    float mean = 0.25f;
};

// Compares an 8-bit RGBA picture with tests/golden/NAME.png and reports to GoogleTest. With
// PATINA_UPDATE_GOLDEN=1 the picture becomes the golden one. A golden picture that is missing is
// written and the test fails, so that it is looked at before it is committed.
void expectGolden(const Image& picture, const std::string& name, const GoldenLimits& limits = {});

} // namespace patina
