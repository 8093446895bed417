// Plots of a radiosity solution, one at a time: how fast the solvers come to it, radiosity along a
// line over the chosen element's surface, the matrices that are solved, what an element sees, and
// leaks and seams.
#pragma once

#include "core/radiosity/document/SurfaceProfile.h"

#include <QWidget>
#include <cstdint>
#include <memory>
#include <vector>

class QComboBox;
class QStackedWidget;

namespace patina::editor {

class CurvePlot;
class DocumentController;
class FactorMap;
class HemicubeView;
class LeakList;
class PlotLegend;
class RadiosityUpdater;

class RadiosityPlots : public QWidget {
    Q_OBJECT
  public:
    enum Plot { kConvergence, kSurface, kFactors, kMatrix, kHemicube, kLeaks };
    // Cells along an edge of a matrix; of more elements a cell stands for several of them.
    static constexpr std::size_t kMostInMatrix = 512;

    RadiosityPlots(RadiosityUpdater& radiosity, DocumentController& controller,
                   QWidget* parent = nullptr);

    void refresh();

  private:
    void show(int plot);
    void plotConvergence();
    void plotSurface();
    void findProfiles();
    void showMatrix();

    RadiosityUpdater& m_radiosity;
    QComboBox* m_choice;
    QStackedWidget* m_stack;
    CurvePlot *m_convergence, *m_surface;
    PlotLegend *m_convergenceLegend, *m_surfaceLegend;
    FactorMap* m_matrix;
    // What it shows: as long as it is that, it need not be added up anew.
    std::weak_ptr<const LiveRadiosity> m_matrixOf;
    int m_matrixPlot = -1;
    HemicubeView* m_hemicube;
    LeakList* m_leaks;
    // Lines over the surface of an element: they last as long as the elements do.
    struct Profiles {
        std::shared_ptr<const RadiosityShape> shape;
        std::uint32_t element = 0;
        SurfaceProfile across, up;
    };
    Profiles m_profiles;
};

// F_ij: the share of the light leaving element i that arrives at element j, and so (reciprocity)
// how much the radiosity of j counts in what i receives. Row after row. Of patches, where there are
// some. In groups of `group`: the share of what leaves the elements of a group, each as bright as
// the others, that arrives at those of another.
[[nodiscard]] std::vector<float> factorTable(const LiveRadiosity& live, std::size_t group = 1);
// I - ρF, of which the solution is E divided by: ρ of all colours together.
[[nodiscard]] std::vector<float> equationTable(const LiveRadiosity& live, std::size_t group = 1);

} // namespace patina::editor
