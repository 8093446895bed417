// Draws the cells of a wall over one scene: what they have in common is uploaded and prepared once,
// what they differ in is set for each. Qt-free. All calls need the scene's context to be current,
// on one thread.
#pragma once

#include "core/bake/local/NearShadows.h"
#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/light/EnvironmentTexels.h"
#include "render/view/FrameSettings.h"

#include <cstddef>
#include <memory>
#include <span>

namespace patina::render {

class SceneRenderer;
class ViewRenderer;

// All that a cell's picture depends on.
struct CellView {
    Document document;          // as the cell shows it: documentOf() of core/cells
    EnvironmentTexelsPtr light; // of the picture that lights it (shownEnvironment()); null: none
    NearShadowsPtr nearShadows; // of its local lights under transfer; null: none
    FrameSettings frame;        // light and look are the document's

    // Whether both show the same picture.
    [[nodiscard]] bool sameAs(const CellView& other) const;
};

class WallRenderer {
  public:
    // The scene, which outlives it, shows one cell's document after the other.
    explicit WallRenderer(SceneRenderer& scene);
    ~WallRenderer();

    // Renews the picture of each cell that has changed since, by its place in the list; the others
    // stay as they are. Environments that no cell has any more are let go. Errors: Internal from
    // the driver.
    Result<void> draw(std::span<const CellView> cells);

    // A cell's picture as it was drawn last. What looks into its scene (inspect(), readView(),
    // pick()) is right for the cell whose document the scene shows: see show().
    [[nodiscard]] const ViewRenderer& picture(std::size_t cell) const;
    // Sets the scene to a cell of the last draw().
    void show(std::size_t cell);

    // What has been done since it was made, to see that nothing is done twice.
    struct Counts {
        std::size_t pictures = 0; // drawn
        std::size_t lights = 0;   // of environments, added to the scene
    };
    [[nodiscard]] Counts counts() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace patina::render
