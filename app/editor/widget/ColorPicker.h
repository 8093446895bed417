// The colour picker: a square of saturation and value, a strip of hues, the sRGB hexadecimal
// number and the linear components. Colours go in and out as linear sRGB.
#pragma once

#include "app/editor/widget/ColorConversion.h"

#include <QFrame>

class QLineEdit;

namespace patina::editor {

class NumberField;

// Where saturation (to the right) and value (up) are chosen.
class SaturationValueSquare : public QWidget {
    Q_OBJECT
  public:
    explicit SaturationValueSquare(QWidget* parent = nullptr);
    void setColor(const Hsv& color);

  Q_SIGNALS:
    void dragStarted();
    void dragged(float saturation, float value);
    void dragFinished();

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;

  private:
    Hsv m_color;
};

class HueStrip : public QWidget {
    Q_OBJECT
  public:
    explicit HueStrip(QWidget* parent = nullptr);
    void setHue(float hue);

  Q_SIGNALS:
    void dragStarted();
    void dragged(float hue);
    void dragFinished();

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;

  private:
    float m_hue = 0;
};

class ColorPicker : public QFrame {
    Q_OBJECT
  public:
    explicit ColorPicker(QWidget* parent = nullptr);
    void setColor(const glm::vec3& linear); // shows, emits nothing

  Q_SIGNALS:
    void dragStarted();
    void dragged(const glm::vec3& linear);
    void dragFinished();
    void edited(const glm::vec3& linear); // typed

  private:
    void refresh(bool fromSquare);
    void drag(const Hsv& hsv);

    glm::vec3 m_linear{0.0f};
    Hsv m_hsv; // remembers the hue of greys
    SaturationValueSquare* m_square;
    HueStrip* m_strip;
    QLineEdit* m_hex;
    QWidget* m_swatch;
    NumberField* m_components[3];
};

} // namespace patina::editor
