// The BRDF Lens dock: how the selected material reflects, as lobes, curves and a ball, with other
// shading models beside the document's. Follows every edit while it is being made.
#pragma once

#include "app/editor/job/LatestJob.h"
#include "app/editor/panel/LensComparison.h"
#include "core/image/Image.h"
#include "core/light/Ibl.h"

#include <QWidget>
#include <optional>
#include <vector>

class QComboBox;
class QLabel;
class QStackedWidget;

namespace patina {
struct Material;
}

namespace patina::editor {

class CurvePlot;
class DocumentController;
class LensControls;
class LitSphere;
class LobeOnSurface;
class LobeView;
class PixelProbe;
class PolarPlot;
class SelectionModel;
class TileArea;

class BrdfLensPanel : public QWidget {
    Q_OBJECT
  public:
    // `probe`: while a point of the selected material is pinned, that point is looked at.
    // `onSurface`: shown as long as the panel is.
    BrdfLensPanel(DocumentController& controller, SelectionModel& selection, PixelProbe& probe,
                  LobeOnSurface& onSurface, QWidget* parent = nullptr);
    ~BrdfLensPanel() override;

    [[nodiscard]] LensControls& controls() { return *m_controls; }
    // What the plots show; evaluated in the background. upToDate(): nothing newer is under way.
    [[nodiscard]] const LensResult& result() const { return m_result; }
    [[nodiscard]] bool upToDate() const { return !m_job.busy() && !m_stale; }
    [[nodiscard]] QSize sizeHint() const override { return {780, 280}; }

  protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

  private:
    using Looks = std::vector<LensComparison::Look>;

    void makePlots();
    QComboBox* makeOnSurface();
    void fillOnSurface(); // the lights may be others
    void showOnSurface();
    void showPage();

    void refresh(); // asks for new curves, when someone sees them
    void refreshEnvironment();
    [[nodiscard]] std::optional<SurfacePoint> pinnedPoint(const Material& material) const;
    void describe();
    void showResult(const LensResult& result, const Looks& looks);
    void showCurves(const Looks& looks);
    void showAlbedo(const Looks& looks);
    void probe(std::optional<double> viewerDeg); // the same configuration in all plots

    DocumentController& m_controller;
    SelectionModel& m_selection;
    PixelProbe& m_probe;
    LobeOnSurface& m_onSurface;

    LensResult m_result;
    bool m_stale = true;
    struct Known;                   // tables and means of maps that were computed before
    std::shared_ptr<Known> m_known; // the pool's thread alone uses it
    ImagePtr m_environment;         // that m_maps are of, or are being made of
    std::shared_ptr<const IblMaps> m_maps;

    LensControls* m_controls;
    LensComparison* m_comparison;
    QComboBox* m_surfaceChoice = nullptr;
    QLabel* m_note;
    QStackedWidget* m_stack;
    TileArea* m_tiles;
    PolarPlot* m_polar;
    CurvePlot *m_cartesian, *m_distribution, *m_masking, *m_fresnel, *m_albedo;
    LobeView* m_space;
    LitSphere* m_ball;
    LatestJob m_job, m_ballLight; // last: they end first
};

} // namespace patina::editor
