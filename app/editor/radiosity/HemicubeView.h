// What an element or patch sees from its centre: the five faces of a hemicube, unfolded about the
// top one, or the paraboloid map where form factors are found by those. Each cell is in a colour of
// what is seen through it; a press chooses that element.
#pragma once

#include "core/radiosity/document/LiveRadiosity.h"

#include <QImage>
#include <QWidget>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

class QComboBox;
class QLabel;

namespace patina::editor {

class DocumentController;
class HemicubeCross;
class RadiosityUpdater;

class HemicubeView : public QWidget {
    Q_OBJECT
  public:
    enum Colors { kElements, kRadiosity, kFactors };
    // Along an edge of the hemicube's top; half the texels along the diameter of the paraboloid.
    static constexpr int kCells = 64;

    HemicubeView(RadiosityUpdater& radiosity, DocumentController& controller,
                 QWidget* parent = nullptr);

    // Of the chosen element or its patch, or else of what shoots next.
    void refresh();
    [[nodiscard]] const QImage& picture() const { return m_picture; }
    [[nodiscard]] bool isParaboloid() const { return m_paraboloid; } // or else a hemicube
    // Text on a pixel of picture(): what is seen there, its cell, and its share of the light;
    // empty: a corner that is no cell.
    [[nodiscard]] QString wordsAt(const QPoint& pixel) const;

  private:
    [[nodiscard]] std::optional<std::uint32_t> sender() const;
    [[nodiscard]] bool wantsParaboloid() const;
    void see(std::uint32_t sender);
    void placeHemicube();
    void placeParaboloid();
    void paintPicture();
    [[nodiscard]] std::optional<std::uint32_t> seenAt(const QPoint& pixel) const;

    RadiosityUpdater& m_radiosity;
    DocumentController& m_controller;
    QComboBox* m_colors;
    QLabel *m_title, *m_hover;
    HemicubeCross* m_cross;
    QImage m_picture;
    // Of what is shown, as long as the elements last.
    std::shared_ptr<const RadiosityShape> m_shape;
    std::uint32_t m_sender = 0;
    bool m_paraboloid = false;
    std::vector<std::uint32_t> m_seen; // of each cell, as PointFactors::seenFromCentre()
    std::vector<double> m_factors;     // of each cell
    std::vector<std::int32_t> m_cells; // of each pixel its cell, or -1
    std::vector<double> m_sums;        // of each element, all of its cells together
    double m_outside = 0.0, m_back = 0.0;
};

} // namespace patina::editor
