// A swatch with its sRGB number; a click opens the picker.
#pragma once

#include <QAbstractButton>
#include <glm/vec3.hpp>

namespace patina::editor {

class ColorPicker;

class ColorButton : public QAbstractButton {
    Q_OBJECT
  public:
    explicit ColorButton(QWidget* parent = nullptr);
    void setColor(const glm::vec3& linear);
    [[nodiscard]] ColorPicker* picker() { return m_picker; }
    [[nodiscard]] QSize sizeHint() const override;

  Q_SIGNALS:
    void dragStarted();
    void dragged(const glm::vec3& linear);
    void dragFinished();
    void edited(const glm::vec3& linear);

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    void openPicker();

    glm::vec3 m_linear{0.0f};
    ColorPicker* m_picker;
};

} // namespace patina::editor
