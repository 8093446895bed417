// Draws the terms that a picture under image-based light is the sum of, a frame at a time.
#pragma once

#include "core/base/Result.h"
#include "render/TermPictures.h"
#include "render/ViewRenderer.h"

#include <array>
#include <memory>

namespace patina::editor {

// The scene's context is current in all of it, and its end.
class TermDrawing {
  public:
    // `frame`: as the picture is looked at; its frames accumulate.
    TermDrawing(render::SceneRenderer& scene, render::FrameSettings frame)
        : m_scene(scene)
        , m_frame(std::move(frame)) {}

    // True: nothing is left. Errors: Internal from the driver.
    Result<bool> drawFrame();
    [[nodiscard]] DrawnTerms take(); // of what is complete

  private:
    render::SceneRenderer& m_scene;
    const render::FrameSettings m_frame;
    std::unique_ptr<render::ViewRenderer> m_picture; // the one that is under way
    std::size_t m_done = 0;                          // pictures: the whole one, then its terms
    Image m_whole;
    std::array<Image, render::kTermPictures> m_terms;
};

} // namespace patina::editor
