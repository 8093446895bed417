// `patina render --inspect X,Y`: why a pixel looks as it does.
#pragma once

#include "app/cli/Session.h"
#include "core/bake/local/NearShadows.h"
#include "core/document/Document.h"

#include <glm/vec2.hpp>
#include <optional>
#include <string>

namespace patina::render {
class ViewRenderer;
struct FrameSettings;
} // namespace patina::render

namespace patina::cli {

// Nothing for an empty text. Usage error when it is no pixel of the picture.
Result<std::optional<glm::ivec2>> parsePixel(const std::string& text,
                                             const render::FrameSettings& frame,
                                             const char* option = "--inspect");

// Prints the explanation of a pixel of the renderer's last frame, or puts it into the report as
// "inspection"; where a surface is, with what a transfer bake has there. `shadows`: of the frame.
Result<void> explainPixel(Session& session, render::ViewRenderer& renderer,
                          const Document& document, const NearShadowsPtr& shadows,
                          const glm::ivec2& pixel);

} // namespace patina::cli
