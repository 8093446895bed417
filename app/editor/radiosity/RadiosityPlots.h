// Plots of a radiosity solution, one at a time: unshot light over the shots, radiosity along a line
// over the chosen element's surface, and the matrices that are solved.
#pragma once

#include <QWidget>
#include <cstdint>
#include <vector>

class QComboBox;
class QStackedWidget;

namespace patina {
struct LiveRadiosity;
}

namespace patina::editor {

class CurvePlot;
class FactorMap;
class RadiosityUpdater;

class RadiosityPlots : public QWidget {
    Q_OBJECT
  public:
    enum Plot { kUnshot, kSurface, kFactors, kMatrix };
    static constexpr std::size_t kMostInMatrix = 512; // elements

    explicit RadiosityPlots(RadiosityUpdater& radiosity, QWidget* parent = nullptr);

    void refresh();

  private:
    void show(int plot);
    void plotUnshot();
    void plotSurface();
    void showMatrix();

    RadiosityUpdater& m_radiosity;
    QComboBox* m_choice;
    QStackedWidget* m_stack;
    CurvePlot *m_unshot, *m_surface;
    FactorMap* m_matrix;
};

// F_ij, the share of the light of element j's equation: how much of what element j sends per area
// arrives per area at element i, as the rows of the solution have it. Row after row.
[[nodiscard]] std::vector<float> factorTable(const LiveRadiosity& live);
// I - ρF, of which the solution is E divided by: ρ of all colours together.
[[nodiscard]] std::vector<float> equationTable(const LiveRadiosity& live);

} // namespace patina::editor
