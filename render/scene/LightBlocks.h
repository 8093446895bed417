// The document's lights as the surface shader wants them: those that shine, sorted by the loop that
// adds them up.
#pragma once

#include "core/document/Document.h"
#include "render/scene/Blocks.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace patina::render {

struct PackedLights {
    glm::ivec4 ends{0}; // FrameBlock::lightEnds
    // Of more than kUniformLights: from here to ends.y points and spots that have a range and no
    // shadow map, which count within their range alone. Else ends.y.
    int firstRanged = 0;
    std::vector<LightBlock> lights;
};

// At most kMaxLights, of the first in the document. `shadowSlots`: ids of the lights that have a
// shadow map, by slot.
[[nodiscard]] PackedLights packLights(const Document& document, std::span<const Id> shadowSlots);
// Into the frame, whose `lights` stay empty where it has no room for them.
void packLights(const Document& document, std::span<const Id> shadowSlots, FrameBlock& frame);

// The ids of the packed lights, in their order.
[[nodiscard]] std::vector<Id> lightOrder(const Document& document);

// What of the document's light pictures leave out.
struct LightLimit {
    std::string_view id; // "lights", "shadows", "transmission"
    std::string text;    // a sentence for the user: what, and what helps
};
[[nodiscard]] std::vector<LightLimit> lightLimits(const Document& document);

// Those that shine and cast a shadow, in the document's order; the first kMaxShadows get a map.
[[nodiscard]] std::vector<const Light*> castingLights(const Document& document);

} // namespace patina::render
