// One picture of the Light lab with its caption: small in the contact sheet or large beside it. It
// shows what it is given and says where the pointer is.
#pragma once

#include "app/editor/panel/LabLight.h"
#include "app/editor/widget/PlotFrame.h"

#include <functional>
#include <optional>

namespace patina::editor {

// Where something is on a picture: a direction of the world, or N·V and perceptual roughness in the
// DFG table.
struct LabPlace {
    glm::vec3 direction{0.0f};
    float NoV = 0.0f, perceptualRoughness = 0.0f;
    friend bool operator==(const LabPlace&, const LabPlace&) = default;
};

class LabPicture : public PlotFrame {
    Q_OBJECT
  public:
    enum class Role { Thumbnail, Stage };
    LabPicture(LabView view, Role role, QWidget* parent = nullptr);

    [[nodiscard]] LabView view() const { return m_view; }
    void setView(LabView view); // of the stage: another one is shown from now on

    // `detail` stands below or beside the title; `warning` too, in copper.
    void setCaption(const QString& title, const QString& detail, const QString& warning = {});
    [[nodiscard]] QString title() const { return m_caption; }
    [[nodiscard]] QString detail() const { return m_detail; }
    [[nodiscard]] QString warning() const { return m_warning; }
    void setReason(const QString& message); // why there is no picture; empty: there is one
    // The values at a place; none while they are not known.
    using Reader = std::function<std::vector<PlotValue>(const LabPlace&)>;
    void setReader(Reader reader);
    void setPicture(const QImage& picture); // stretched over pictureArea()
    [[nodiscard]] const QImage& picture() const { return m_picture; }
    void setColorRange(const glm::vec2& range); // of the DFG table's legend
    void setSelected(bool selected);

    // Marks: the pointer in any of the pictures, the picked pixel, the lowest value of a sum.
    void setPointer(const std::optional<LabPlace>& place);
    void setPicked(const std::optional<LabPlace>& place, const QString& label);
    void setLowest(const std::optional<glm::vec3>& direction);
    [[nodiscard]] const std::optional<LabPlace>& picked() const { return m_picked; }
    [[nodiscard]] QString pickedLabel() const { return m_pickedLabel; }
    [[nodiscard]] const std::optional<glm::vec3>& lowest() const { return m_lowest; }

    [[nodiscard]] QRectF pictureArea() const; // of the image or the table, without axes
    [[nodiscard]] QSize pictureSize() const;  // device pixels that fill pictureArea()
    // Outside of pictureArea() when it is on another face.
    [[nodiscard]] QPointF position(const LabPlace& place) const;
    [[nodiscard]] std::optional<LabPlace> place(const QPointF& position) const;
    // The same as places of the frame: azimuth and elevation, or N·V and roughness.
    [[nodiscard]] QPointF pointOf(const QPointF& place) const override;
    [[nodiscard]] std::optional<QPointF> placeAt(const QPointF& point) const override;
    [[nodiscard]] LabPlace labPlace(const QPointF& place) const;
    [[nodiscard]] std::vector<PlotValue> valuesAt(const QPointF& place) const override;
    [[nodiscard]] QColor colorAt(const LabPlace& place) const; // of the picture

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return {}; } // as the layout has it
    [[nodiscard]] bool hasHeightForWidth() const override { return true; }
    [[nodiscard]] int heightForWidth(int width) const override;

  Q_SIGNALS:
    void chosen();
    void faceChosen(int face); // of the large cross, 1…6; 0: a face alone, all are wanted again
    void stepped(int by);      // an arrow key: to the neighbour
    void pointed(const std::optional<patina::editor::LabPlace>& place); // nothing: left
    void resized();

  protected:
    [[nodiscard]] bool hasValues() const override { return !m_picture.isNull(); }
    [[nodiscard]] QString placeText(const QPointF& place) const override;
    [[nodiscard]] QRectF area() const override { return pictureArea(); }
    [[nodiscard]] bool boxesReadout() const override { return m_role == Role::Stage; }
    bool pick(const QPointF& place, Qt::KeyboardModifiers modifiers) override;
    void paintGround(QPainter& painter) const override;
    void paintMessage(QPainter& painter, const QString& message) const override;
    void paintValues(QPainter& painter) const override;
    void paintProbe(QPainter& painter, const QPointF& place) const override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    [[nodiscard]] int captionHeight() const;
    [[nodiscard]] QRectF box() const; // without the caption
    [[nodiscard]] QPointF placeOf(const LabPlace& place) const;
    void fitAxes(); // to the view
    void describe();
    void paintCaption(QPainter& painter) const;
    void paintCross(QPainter& painter) const;
    void paintHorizon(QPainter& painter) const;
    void paintTable(QPainter& painter) const; // its axes
    void paintMarks(QPainter& painter) const;

    LabView m_view;
    Role m_role;
    QString m_caption, m_detail, m_warning, m_reason, m_pickedLabel;
    QImage m_picture;
    bool m_selected = false, m_hovered = false;
    Reader m_reader;
    std::optional<LabPlace> m_picked;
    std::optional<glm::vec3> m_lowest;
};

} // namespace patina::editor
