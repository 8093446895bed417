#include "app/cli/InspectPixel.h"

#include "app/cli/TransferInfo.h"
#include "core/math/Shading.h"
#include "render/ViewRenderer.h"
#include "render/view/Explanation.h"

#include <charconv>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace patina::cli {

Result<std::optional<glm::ivec2>>
parsePixel(const std::string& text, const render::FrameSettings& frame, const char* option) {
    if (text.empty())
        return std::optional<glm::ivec2>();
    glm::ivec2 pixel(-1);
    const char* const end = text.data() + text.size();
    const auto [comma, first] = std::from_chars(text.data(), end, pixel.x);
    const bool read = first == std::errc() && comma != end && *comma == ',';
    const auto [last, second] =
        read ? std::from_chars(comma + 1, end, pixel.y) : std::from_chars_result{end, first};
    if (!read || second != std::errc() || last != end || pixel.x < 0 || pixel.y < 0 ||
        pixel.x >= frame.width || pixel.y >= frame.height)
        return Error{ErrorKind::Usage,
                     fmt::format("{} wants X,Y of a pixel of the picture, from 0,0 at the top left "
                                 "to {},{}, not \"{}\"",
                                 option, frame.width - 1, frame.height - 1, text),
                     {},
                     {}};
    return std::optional(pixel);
}

Result<void> explainPixel(Session& session, render::ViewRenderer& renderer,
                          const Document& document, const NearShadowsPtr& shadows,
                          const glm::ivec2& pixel) {
    const Result<render::Inspection> inspection = renderer.inspect(pixel.x, pixel.y);
    if (!inspection)
        return inspection.error();
    const render::Explanation explanation = render::explain(*inspection, document);
    session.report().json()["inspection"] = nlohmann::ordered_json::parse(toJson(explanation));
    std::string text = toText(explanation);
    text.pop_back(); // line() ends the last line
    session.report().line(text);
    if (!inspection->onSurface())
        return {};
    return describeTransfer(session, document, shadows, inspection->mesh,
                            glm::vec3(inspection->value(shading::kRecordPosition)));
}

} // namespace patina::cli
