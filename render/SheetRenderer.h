// Draws several views of a scene small, as a strip of thumbnails shows them. Qt-free. All calls
// need the scene's context to be current, on one thread.
#pragma once

#include "core/base/Result.h"
#include "core/image/Image.h"
#include "render/view/FrameSettings.h"

#include <memory>
#include <vector>

namespace patina::render {

class SceneRenderer;
class ViewRenderer;

struct ViewSheet {
    std::vector<ViewKind> kinds;
    ViewMode mode = ViewMode::Raw;
    int width = 0, height = 0; // pixels of each
};

class SheetRenderer {
  public:
    explicit SheetRenderer(SceneRenderer& scene); // which outlives it
    ~SheetRenderer();

    // The views of `sheet` as displayed, each 8-bit RGBA, top row first; up to eight are drawn in
    // one pass. Of `frame` camera, light, look and terms; exposed for the eye that looks at
    // `picture`. Errors: Usage for an impossible size, Internal from the driver.
    [[nodiscard]] Result<std::vector<Image>>
    draw(const FrameSettings& frame, const ViewSheet& sheet, const ViewRenderer& picture);

  private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace patina::render
