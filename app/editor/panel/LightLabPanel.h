// The Light lab: the environment and what shading makes of it, side by side and live: faces of the
// cube, irradiance, sums of harmonics, prefiltered levels and the DFG table. One picture is large.
#pragma once

#include "app/editor/panel/LabDrawing.h"
#include "app/editor/panel/LabPicture.h"

#include <QTimer>
#include <QWidget>
#include <array>
#include <memory>

class QBoxLayout;
class QLabel;
class QScrollArea;
class QToolButton;

namespace patina {
struct Change;
}

namespace patina::editor {

class DocumentController;
class ElidedLabel;
class IblUpdater;
class LatestJob;
class NumberField;
class PixelProbe;
class Slider;

class LightLabPanel : public QWidget {
    Q_OBJECT
  public:
    // `ibl`: whose maps are shown; `probe`: whose pixel is marked.
    LightLabPanel(DocumentController& controller, IblUpdater& ibl, PixelProbe& probe,
                  QWidget* parent = nullptr);
    ~LightLabPanel() override;

    // A dock behind a tab counts as visible with Qt: its owner says whether anybody sees it.
    // Nothing is computed for nobody.
    void setSeen(bool seen);

    // What the viewport measured last, for automatic exposure.
    void setLuminance(const Luminance& luminance);

    [[nodiscard]] LabPicture* picture(LabView view) const; // in the contact sheet
    [[nodiscard]] LabPicture* stage() const { return m_stage; }
    [[nodiscard]] const LabLight& light() const { return m_light; }
    [[nodiscard]] const LabDfg* dfg() const { return m_dfg.get(); }
    [[nodiscard]] QStringList readout() const; // its two lines
    [[nodiscard]] bool idle() const;           // nothing is being computed or waits for it

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

  private:
    struct Cell {
        LabPicture* widget = nullptr;
        quint64 state = 0; // m_state that its picture was made of
        QSize size;
    };
    struct Section {
        QLabel* heading = nullptr;
        QWidget* box = nullptr;
        QToolButton* button = nullptr;
        LabView first;
    };

    QWidget* makeSections();
    QWidget* makeExposure();
    QWidget* makeSheet();
    void connectPicture(LabPicture* widget);
    void showSection(int index); // -1: all
    void select(LabView view);
    void step(int by);
    void arrange();

    void follow(const Change& change);
    void refreshLight(); // the document's environment, when somebody sees it
    void refreshDfg();
    void refreshMaps();
    void invalidate(); // the pictures show something else
    void requestPictures();
    void refreshCaptions();
    void refreshPicked();
    // Of a picture, as numbers; nothing while it is not computed.
    [[nodiscard]] std::optional<glm::vec3> valueAt(LabView view, const LabPlace& place) const;
    void point(LabPicture* from, const std::optional<LabPlace>& place);

    [[nodiscard]] QString message(LabView view) const; // why there is no picture

    DocumentController& m_controller;
    IblUpdater& m_ibl;
    PixelProbe& m_probe;

    LabLight m_light;
    ImagePtr m_image; // that is, or will be, analysed
    double m_irradianceError = 0.0;
    std::shared_ptr<const LabDfg> m_dfg;
    std::optional<std::pair<Distribution, Visibility>> m_dfgTerms; // of m_dfg, or under way
    Luminance m_luminance;
    float m_offsetEv = 0.0f;
    quint64 m_state = 1;

    std::vector<Cell> m_cells;
    Cell m_large; // the stage
    std::array<Section, 4> m_sections;
    QToolButton* m_allButton = nullptr;
    LabPicture* m_stage = nullptr;
    QWidget *m_stageColumn = nullptr, *m_swatch = nullptr;
    ElidedLabel *m_where = nullptr, *m_what = nullptr, *m_note = nullptr;
    QBoxLayout *m_bar = nullptr, *m_body = nullptr;
    QScrollArea* m_scroll = nullptr;
    Slider* m_slider = nullptr;
    NumberField* m_exposure = nullptr;

    QTimer m_request;
    bool m_seen = false;
    LatestJob *m_analysisJob, *m_dfgJob, *m_pictureJob; // last: they end first
};

} // namespace patina::editor
