// Draws the cells of the wall into the viewport: makes of the document what each shows, has their
// light prepared, and draws what has changed, piece by piece.
#pragma once

#include "app/editor/trace/TraceWork.h"
#include "app/editor/wall/WallLights.h"
#include "app/editor/wall/WallRadiosity.h"
#include "render/WallRenderer.h"

#include <QObject>
#include <QRect>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace patina::render {
class SceneRenderer;
struct FrameKind;
} // namespace patina::render

namespace patina::editor {

class DocumentController;
class EnvironmentPreview;
class TracedCells;
class WallComparison;
class WallState;

class WallPainter : public QObject {
    Q_OBJECT
  public:
    WallPainter(DocumentController& controller, PreparedLights& lights, QObject* parent = nullptr);

    void setWall(WallState& wall, WallComparison& comparison, TracedCells& traced);
    [[nodiscard]] bool isOn() const;
    // Whether frames of these kinds are drawn without a stall; else it sees to that, and calls
    // recompose() when they are.
    using Ready = std::function<bool(const std::vector<render::FrameKind>&)>;
    void setReady(Ready ready) { m_ready = std::move(ready); }
    // The light that the scene holds for the document is of this picture; null: of none yet.
    void setSceneLight(const ImagePtr& picture);
    void setNearShadows(const NearShadowsPtr& shadows); // of the document's local lights
    void setGate(const std::shared_ptr<const WorkGate>& gate) { m_lights.setGate(gate); }
    void setRadiosity(RadiosityUpdater& radiosity) { m_radiosity.setRadiosity(radiosity); }
    // What is looked at is shown by the current cell.
    void setPreview(EnvironmentPreview& preview) { m_preview = &preview; }

    // --- With the scene's context current
    // --------------------------------------------------------- What the next frame shows: `frame`
    // is that of the whole viewport, of whose camera, view, samples and marks cells take theirs;
    // `cells`: their places in pixels of the viewport, from its top left corner; null: not drawn.
    // `scale`: sides of what is drawn to those.
    void set(render::SceneRenderer& scene, const render::FrameSettings& frame,
             const std::vector<QRect>& cells, float scale);
    // As WallRenderer::proceed().
    Result<bool> draw(double budgetMs);
    // All cells as they are into a framebuffer of `size` pixels.
    Result<void> present(unsigned framebuffer, const QSize& size);
    void measure(); // the cells that are compared, when they rest
    // A frame of a cell of a sheet (sheetCells()); nothing while another one is to be added to it.
    // `linear`: half floats as they are before the tone curve, else the picture as displayed.
    // `begins`: the cell's first.
    Result<std::optional<Image>> drawSheetFrame(render::SceneRenderer& scene,
                                                const render::CellView& cell, bool begins,
                                                bool linear);
    void endSheet();
    void release(); // what it has in the scene; the document is to be set again

    // The scene looks different in a way that the document does not say.
    void invalidate();
    void recompose() { m_composed = false; } // cells of the document anew
    [[nodiscard]] bool complete() const;     // draw() has nothing to do
    // What it would present is the document as it is, as far as that is prepared.
    [[nodiscard]] bool isCurrent() const { return m_composed && complete(); }
    [[nodiscard]] std::size_t due() const; // cells that show what they showed before
    // Of these, and of all cells, those that are drawn from the scene, which takes time.
    [[nodiscard]] std::size_t dueFromScene() const;
    [[nodiscard]] std::size_t cellsFromScene() const;
    [[nodiscard]] bool isTracing() const;                    // traced cells will become finer
    [[nodiscard]] bool isLitBy(LightingMode lighting) const; // any cell
    [[nodiscard]] bool preparing() const;                    // some wait for light or programs
    // All cells as fine as they get, `width` pixels wide and as high as they are shown, the one
    // that is enlarged as all of them. Nothing while what they show is not complete.
    struct SheetCell {
        render::CellView view;
        QString problem; // why there will be no picture
        // Traced in place of drawn; nothing: it is drawn.
        std::optional<TracedBy> tracer = {};
        WhittedSettings whitted = {}; // of its tracer
    };
    [[nodiscard]] std::optional<std::vector<SheetCell>> sheetCells(int width) const;
    [[nodiscard]] QSize sheetCellSize(int width) const; // null: nothing is shown

  Q_SIGNALS:
    void changed(); // set() would show something else
    void finer();   // of traced cells alone: it may wait for a slice

  private:
    void compose(const render::FrameSettings& frame);
    void composeCell(std::size_t index, const render::FrameSettings& frame);
    void traceCells(const render::FrameSettings& frame, const std::vector<QRect>& cells,
                    bool composed);
    // The traced picture of a cell in place of what it would draw; null: it draws.
    [[nodiscard]] ImagePtr tracedPicture(std::size_t index,
                                         const render::FrameSettings& frame) const;
    [[nodiscard]] bool isTraced(std::size_t index) const;
    [[nodiscard]] bool isMeasurable(std::size_t index) const;   // of full size
    [[nodiscard]] bool previews() const;                        // some cell shows what is no cell's
    [[nodiscard]] std::optional<std::size_t> shownCell() const; // the enlarged one, or any
    [[nodiscard]] render::FrameSettings frameOf(const render::FrameSettings& frame,
                                                const QRect& cell, float scale) const;

    DocumentController& m_controller;
    WallState* m_wall = nullptr;
    WallComparison* m_comparison = nullptr;
    TracedCells* m_traced = nullptr;
    EnvironmentPreview* m_preview = nullptr;
    WallLights m_lights;
    WallRadiosity m_radiosity;
    Ready m_ready;
    ImagePtr m_sceneLight;
    NearShadowsPtr m_nearShadows;
    std::unique_ptr<render::WallRenderer> m_renderer;     // null until it is on, with a scene
    std::unique_ptr<render::ViewRenderer> m_sheetPicture; // of the sheet that is being drawn
    std::vector<render::CellView> m_views;
    std::vector<QRect> m_places;
    struct Absence {
        QString text;       // why the cell cannot be drawn; empty: it can
        bool passes = true; // by itself; what it showed before stays meanwhile
    };
    std::vector<Absence> m_absences; // by cell
    std::vector<bool> m_edited;      // by cell: it is another one than before compose()
    std::vector<bool> m_resolved;    // by cell: its document in m_views is what it is to show
    bool m_composed = false;         // m_views are of the document and the wall as they are
    bool m_sameCells = false;        // since the last set(): cells are those that they were
};

} // namespace patina::editor
