// What `patina render --view` makes: one view, all of them as parts of one OpenEXR file, or all on
// a contact sheet with captions.
#pragma once

#include "app/cli/Session.h"
#include "core/document/Document.h"
#include "core/io/ImageIO.h"
#include "render/ViewRenderer.h"

#include <string>
#include <vector>

namespace patina::cli {

// `patina render --list-views`: a line for each view, by groups.
[[nodiscard]] std::string listViews();

[[nodiscard]] bool wantsAllViews(const RenderOptions& options);

// The view of --view, --view-mode, --view-range and --view-light. Usage errors name what exists,
// and why a view does not apply to this document.
[[nodiscard]] Result<render::ViewSettings> viewSettings(const RenderOptions& options,
                                                        const Document& document);

// The views that "all" leaves out because they do not apply to this document, with the reasons.
struct LeftOut {
    const ViewInfo* view;
    std::string reason; // a sentence
};
[[nodiscard]] std::vector<LeftOut> leftOutViews(const Document& document,
                                                const render::ViewSettings& settings);

// A part for each view that applies and has numbers, 32-bit floats: R, G, B of radiance and colours
// (radiance premultiplied by A), X, Y, Z of directions, Z of depth, id of identities, else Y; A is
// 1 where a surface is. "final" is the picture that has been drawn; with "background", what the
// terms of kTermViews leave of it, they add up to it.
[[nodiscard]] Result<std::vector<ImagePart>> viewParts(render::ViewRenderer& renderer,
                                                       const Document& document,
                                                       const render::ViewSettings& settings);
// The numbers of one view, the same way. Usage error for views that are judgements.
[[nodiscard]] Result<Image> viewNumbers(render::ViewRenderer& renderer,
                                        const render::ViewChoice& choice);

// Every view that applies in a picture of frame.width × frame.height, with name and range; below
// them those that do not, with the reasons.
[[nodiscard]] Result<Image> contactSheet(Session& session, render::ViewRenderer& renderer,
                                         const Document& document, render::FrameSettings frame);

} // namespace patina::cli
