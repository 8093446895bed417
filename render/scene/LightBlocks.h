// The document's lights as the surface shader wants them: those that shine, sorted by the loop that
// adds them up.
#pragma once

#include "core/document/Document.h"
#include "render/scene/Blocks.h"

#include <span>
#include <vector>

namespace patina::render {

// Fills the lights of the frame. `shadowSlots`: ids of the lights that have a shadow map, by slot.
// At most kMaxLights are taken, in the document's order.
void packLights(const Document& document, std::span<const Id> shadowSlots, FrameBlock& frame);

// The lights of the frame by their place in it.
[[nodiscard]] std::vector<Id> lightOrder(const Document& document);

// Whether more lights shine than packLights() takes.
[[nodiscard]] bool tooManyLights(const Document& document);

// Those that shine and cast a shadow, in the document's order; the first kMaxShadows get a map.
[[nodiscard]] std::vector<const Light*> castingLights(const Document& document);
[[nodiscard]] bool tooManyShadows(const Document& document);

} // namespace patina::render
