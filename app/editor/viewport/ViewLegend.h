// The legend of a view, over the viewport: its name, range and colours, or why it does not apply.
// Its range is locked by dragging the scale or by a number, its mode and light are chosen here.
#pragma once

#include "app/editor/viewport/LegendContent.h"

#include <QFrame>

class QAbstractButton;
class QVBoxLayout;

namespace patina::editor {

class ColorScale;
class DocumentController;
class NumberField;
class ViewState;
enum class ViewSide;

class ViewLegend : public QFrame {
    Q_OBJECT
  public:
    ViewLegend(ViewState& views, DocumentController& controller, ViewSide side, QWidget* parent);

    // There is something to say: not for the picture alone.
    [[nodiscard]] bool isWanted() const;
    // Nothing but a name and a note: no scale, colours, choices or remedy.
    [[nodiscard]] bool isOnlyANote() const;

  Q_SIGNALS:
    void changed();                               // its size, or whether it is wanted
    void remedyWanted(patina::ViewRemedy remedy); // by a click, so that the view applies

  private:
    void refresh();
    void rebuild();
    void addTitle(QVBoxLayout& rows);
    void addModes(QVBoxLayout& rows);
    void addScale(QVBoxLayout& rows);
    void addSwatches(QVBoxLayout& rows);
    void addLights(QVBoxLayout& rows);
    void addRemedy(QVBoxLayout& rows);
    void refreshRange();
    void lockRange(double min, double max);
    void typeEnd(double value, bool isMax);
    [[nodiscard]] const render::ViewChoice* choice() const; // null: no such side now

    ViewState& m_views;
    DocumentController& m_controller;
    ViewSide m_side;
    LegendContent m_content; // as built
    QWidget* m_body = nullptr;
    ColorScale* m_scale = nullptr;
    NumberField *m_min = nullptr, *m_max = nullptr;
    QAbstractButton* m_automatic = nullptr;
};

} // namespace patina::editor
