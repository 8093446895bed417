// `patina render --renderer path`: a picture by paths, without OpenGL.
#pragma once

#include "app/cli/Session.h"
#include "app/cli/TracingOptions.h"
#include "core/document/Document.h"
#include "core/io/ImageIO.h"
#include "render/view/FrameSettings.h"

namespace patina::cli {

// A part of a picture, for patina merge: its name needs no ending.
[[nodiscard]] inline bool isTracedPart(const RenderOptions& options) {
    return isTraced(options) && !options.work.shard.empty();
}
// Usage errors: what paths do not have, or only they have.
Result<void> checkRenderer(const CommonOptions& common, const RenderOptions& options);

// `document` is looked at through `frame`; `format` is that of the whole picture, `reference` of
// --error-against or null. With --keep-partial a signal ends it early. Errors besides: CannotCreate
// when another process renders into this file.
Result<void> renderTraced(Session& session, const RenderOptions& options, const Document& document,
                          const render::FrameSettings& frame, ImageFileFormat format,
                          const Image* reference);

} // namespace patina::cli
