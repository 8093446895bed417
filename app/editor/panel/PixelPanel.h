// The Pixel dock: why the pixel under the pointer, or the pinned point, looks as it does.
#pragma once

#include "render/view/Explanation.h"

#include <QWidget>
#include <optional>

class QBoxLayout;
class QLabel;
class QStackedWidget;
class QToolButton;
class QTreeView;

namespace patina::editor {

class ContributionChart;
class DocumentController;
class ElidedLabel;
class ExplanationModel;
class PanelScroll;
class PixelPicker;
class PixelProbe;

class PixelPanel : public QWidget {
    Q_OBJECT
  public:
    PixelPanel(DocumentController& controller, PixelProbe& probe, PixelPicker& picker,
               QWidget* parent = nullptr);
    ~PixelPanel() override;

    // What is shown; nothing before a pixel has been looked at.
    [[nodiscard]] const std::optional<render::Explanation>& explanation() const {
        return m_explanation;
    }

    [[nodiscard]] QSize minimumSizeHint() const override; // that of the narrowest flow

  protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

  private:
    QWidget* makeHeader();
    QWidget* makeTree();
    void listen(bool wanted);
    void refresh(); // while the document is the one that was looked at
    void refreshHeader();
    void reflow();
    void openSections();
    void reveal(const QString& contribution); // its formula in the tree
    void copy(const std::string& text, const QString& what);

    DocumentController& m_controller;
    PixelProbe& m_probe;
    PixelPicker& m_picker;
    std::optional<render::Explanation> m_explanation;
    ExplanationModel* m_model;
    bool m_listens = false;

    QStackedWidget* m_pages;
    QLabel *m_swatch, *m_state;
    ElidedLabel *m_title, *m_subtitle;
    QToolButton *m_pin, *m_copyText, *m_copyJson, *m_channels;
    ContributionChart* m_chart;
    PanelScroll* m_chartArea;
    QTreeView* m_tree;
    QBoxLayout *m_header, *m_body;
};

} // namespace patina::editor
