// Draws the cells of a wall over one scene: what they have in common is uploaded and prepared once,
// what they differ in is set for each. Qt-free. All calls need the scene's context to be current,
// on one thread.
#pragma once

#include "core/bake/local/NearShadows.h"
#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/light/EnvironmentTexels.h"
#include "core/radiosity/document/LiveRadiosity.h"
#include "render/view/FrameSettings.h"

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>

namespace patina::render {

class SceneRenderer;
class ViewRenderer;

// All that a cell's picture depends on.
struct CellView {
    Document document;          // as the cell shows it: documentOf() of core/cells
    EnvironmentTexelsPtr light; // of the picture that lights it (shownEnvironment()); null: none
    // Lit by what SceneRenderer::setEnvironment() was given for the document instead. Not for cells
    // beside others that cross-fade: those set it.
    bool sceneLight = false;
    NearShadowsPtr nearShadows; // of its local lights under transfer; null: none
    // Of its document; nothing: what SceneRenderer::setRadiosity() was given, or it does not show.
    std::optional<ShownRadiosityPtr> radiosity;
    FrameSettings frame; // light and look are the document's
    bool waits = false;  // it is not drawn yet: something that its picture depends on is not there

    // Whether both show the same picture.
    [[nodiscard]] bool sameAs(const CellView& other) const;
};

class WallRenderer {
  public:
    // The scene, which outlives it, shows one cell's document after the other.
    explicit WallRenderer(SceneRenderer& scene);
    ~WallRenderer();

    // What the cells show from now on. One that shows what another one showed takes the picture
    // along. Others have none until they are drawn, or, where cells are those of the last call with
    // something edited (`sameCells`), the one that they had.
    void set(std::span<const CellView> cells, bool sameCells);
    // One of them through another frame from now on, of the same document and light.
    void setFrame(std::size_t cell, const FrameSettings& frame);
    // The scene has changed in a way that documents do not tell: all are drawn anew.
    void invalidate();
    // Draws cells that have changed, and the frames that are added to what is there
    // (FrameSettings::accumulate), for about `budgetMs`, but at least one; it waits for what it
    // draws where that is finite. True: nothing is left. Environments that no cell has any more are
    // let go. Errors: Internal from the driver.
    Result<bool> proceed(double budgetMs = std::numeric_limits<double>::infinity());
    [[nodiscard]] bool complete() const;   // proceed() has nothing to do
    [[nodiscard]] std::size_t due() const; // cells that do not show yet what they are to show
    [[nodiscard]] std::size_t dueFromScene() const; // of these, without radiance of their own
    // set() and proceed() to the end.
    Result<void> draw(std::span<const CellView> cells);
    // A frame of a cell that need not be one of these, into a picture elsewhere; `continues`: the
    // last frame there was this cell's, too. It is as fine as it gets when isFine().
    Result<void> drawFrame(const CellView& cell, ViewRenderer& picture, bool continues);
    [[nodiscard]] static bool isFine(const CellView& cell, const ViewRenderer& picture);

    [[nodiscard]] std::size_t size() const; // cells
    [[nodiscard]] bool hasPicture(std::size_t cell) const;
    // A cell's picture as it was drawn last, which it must have been. What looks into its scene
    // (inspect(), readView(), pick()) is right for the cell whose document the scene shows: see
    // show().
    [[nodiscard]] const ViewRenderer& picture(std::size_t cell) const;
    // Sets the scene to a cell.
    void show(std::size_t cell);

    // What has been done since it was made, to see that nothing is done twice.
    struct Counts {
        std::size_t pictures = 0; // frames of cells that were drawn
        std::size_t lights = 0;   // of environments, added to the scene
    };
    [[nodiscard]] Counts counts() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace patina::render
