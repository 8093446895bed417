// The furnace for the viewport: a uniform environment of a colour in place of the scene's, without
// lights, and the view that marks what is lost and what is made. It changes how the scene is looked
// at, never the document.
#pragma once

#include <QWidget>
#include <glm/vec3.hpp>

class QToolButton;

namespace patina::editor {

class ColorButton;
class NumberField;
class ViewState;

class FurnaceControls : public QWidget {
    Q_OBJECT
  public:
    explicit FurnaceControls(ViewState& views, QWidget* parent = nullptr);

  private:
    [[nodiscard]] QToolButton* addButton(const QString& text, const QString& help);
    void setFurnace(bool on);
    void setColor(const glm::vec3& color);
    void apply(); // the colour and intensity, to a furnace that is on
    void refresh();

    ViewState& m_views;
    QToolButton *m_furnace, *m_furnaceView;
    ColorButton* m_colorButton;
    NumberField* m_intensityField;
    glm::vec3 m_color{1.0f}; // linear sRGB
    double m_intensity = 1.0;
};

} // namespace patina::editor
