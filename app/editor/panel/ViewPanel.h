// The Camera dock: exposure, tone mapping with its curve, the display, the camera.
#pragma once

#include "core/document/ToneResponse.h"

#include <QWidget>
#include <optional>

class QComboBox;
class QLabel;
class QPushButton;
class QToolButton;

namespace patina::editor {

class DisplayLoader;
class DocumentController;
class ParameterList;
class Thumbnails;
class ToneCurvePlot;

class ViewPanel : public QWidget {
    Q_OBJECT
  public:
    ViewPanel(DocumentController& controller, DisplayLoader& displays, Thumbnails& thumbnails,
              QWidget* parent = nullptr);

    // What the viewport measured last.
    void setLuminance(const Luminance& luminance);

    [[nodiscard]] ToneCurvePlot* plot() { return m_plot; }

  private:
    QWidget* makeCurve();
    QWidget* makeDisplay();
    void refresh();
    void refreshCurve();
    void refreshDisplay();
    void browse();

    DocumentController& m_controller;
    DisplayLoader& m_displays;
    std::optional<Luminance> m_luminance;

    ToneCurvePlot* m_plot;
    QLabel *m_average, *m_adapted, *m_exposure;
    ParameterList* m_parameters;
    QLabel *m_config, *m_problem, *m_space;
    QToolButton* m_clear;
    QWidget* m_choices; // display and view
    QComboBox *m_display, *m_view;
};

} // namespace patina::editor
