// The BRDF Lens dock: how the selected material reflects, as lobes, curves and a ball, with other
// shading models beside the document's. Follows every edit while it is being made.
#pragma once

#include "app/editor/job/LatestJob.h"
#include "core/image/Image.h"
#include "core/light/Ibl.h"
#include "core/light/LensCurves.h"

#include <QWidget>
#include <optional>
#include <vector>

class QComboBox;
class QHBoxLayout;
class QLabel;
class QMenu;
class QStackedWidget;
class QToolButton;

namespace patina::editor {

class CurvePlot;
class DocumentController;
class LitSphere;
class LobeView;
class NumberField;
class PixelProbe;
class PolarPlot;
class SelectionModel;
class Slider;
class TileArea;

class BrdfLensPanel : public QWidget {
    Q_OBJECT
  public:
    enum class Page { Lobe, Factors, Albedo, All };

    // `probe`: while a point of the selected material is pinned, that point is looked at.
    BrdfLensPanel(DocumentController& controller, SelectionModel& selection, PixelProbe& probe,
                  QWidget* parent = nullptr);
    ~BrdfLensPanel() override;

    void setPage(Page page);
    void setIncidence(double degrees);                // of the light, 0…89
    void compareWithPreset(int preset, bool compare); // of modelPresets()

    [[nodiscard]] double incidence() const { return m_incidenceDeg; }
    // What the plots show; evaluated in the background. upToDate(): nothing newer is under way.
    [[nodiscard]] const LensResult& result() const { return m_result; }
    [[nodiscard]] bool upToDate() const { return !m_job.busy() && !m_stale; }
    [[nodiscard]] QSize sizeHint() const override { return {780, 280}; }

  protected:
    void showEvent(QShowEvent* event) override;

  private:
    // A look beside the document's; its slot gives it colour and dash.
    struct Compared {
        enum class Kind { Preset, SingleScatter, Frozen } kind = Kind::Preset;
        int preset = 0; // of modelPresets()
        int slot = 1;
        LensLook frozen;
    };

    QWidget* makeControls();
    QWidget* makePages();
    QWidget* makeIncidence();
    QComboBox* makeChoice(const QString& name, const QString& help, const QStringList& items);
    QToolButton* makeCompare();
    void makePlots();
    void fillCompareMenu();
    void toggleCompared(const Compared& compared, bool compare);
    [[nodiscard]] std::vector<Compared>::iterator findCompared(Compared::Kind kind, int preset);
    [[nodiscard]] QString nameOf(const Compared& compared) const;
    [[nodiscard]] ShadingModel modelOf(const Compared& compared) const;

    void refresh(); // asks for new curves, when someone sees them
    [[nodiscard]] std::optional<SurfacePoint> pinnedPoint(const Material& material) const;
    void describe(const Material& material, bool pinned);
    void refreshSurroundings();
    void refreshLegend();
    void showResult(const LensResult& result, const std::vector<int>& slots,
                    const QStringList& names);
    void showCurves(const std::vector<int>& slots, const QStringList& names);
    void showAlbedo(const std::vector<int>& slots, const QStringList& names);
    void probe(std::optional<double> viewerDeg); // the same configuration in all plots

    DocumentController& m_controller;
    SelectionModel& m_selection;
    PixelProbe& m_probe;

    double m_incidenceDeg = 45.0;
    std::vector<Compared> m_compared;
    LensResult m_result;
    bool m_stale = true;
    struct Known;                   // tables and means of maps that were computed before
    std::shared_ptr<Known> m_known; // the pool's thread alone uses it
    ImagePtr m_environment;         // that m_maps are of, or are being made of
    std::shared_ptr<const IblMaps> m_maps;

    std::vector<QToolButton*> m_pages;
    Slider* m_slider = nullptr;
    NumberField* m_angle = nullptr;
    QComboBox *m_quantity = nullptr, *m_lobe = nullptr, *m_channel = nullptr;
    QToolButton *m_logarithmic = nullptr, *m_compare = nullptr;
    QMenu* m_compareMenu = nullptr;
    QWidget* m_legend = nullptr;
    QHBoxLayout* m_legendRow = nullptr;
    QLabel *m_note = nullptr, *m_nothing = nullptr;
    QStackedWidget* m_stack = nullptr;
    TileArea* m_tiles = nullptr;
    PolarPlot* m_polar;
    CurvePlot *m_cartesian, *m_distribution, *m_masking, *m_fresnel, *m_albedo;
    LobeView* m_space;
    LitSphere* m_ball;
    LatestJob m_job{"BRDF lens"}, m_surroundings{"light of the ball"}; // last: they end first
};

} // namespace patina::editor
