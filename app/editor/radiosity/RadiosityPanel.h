// The Radiosity dock: the solution of the scene, how it comes about step by step, and what a chosen
// element receives and sends.
#pragma once

#include <QTimer>
#include <QWidget>
#include <cstdint>
#include <memory>
#include <optional>

class QComboBox;
class QLabel;
class QPushButton;
class QSlider;
class QTreeWidget;

namespace patina {
struct LiveRadiosity;
}

namespace patina::editor {

class ElementOverlay;
class PanelScroll;
class RadiosityPlots;
struct Session;
class Thumbnails;

class RadiosityPanel : public QWidget {
    Q_OBJECT
  public:
    // `overlay`: shown while the dock is.
    RadiosityPanel(Session& session, ElementOverlay& overlay, QWidget* parent = nullptr);
    ~RadiosityPanel() override;

    [[nodiscard]] QSize sizeHint() const override { return {980, 300}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {260, 180}; }

  protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

  private:
    [[nodiscard]] QWidget* makeHeader();
    [[nodiscard]] QWidget* makeSettings();
    [[nodiscard]] QWidget* makeSteps();
    [[nodiscard]] QWidget* makePlots();
    [[nodiscard]] QWidget* makeElement();
    void refresh();
    void refreshViews();
    void refreshSteps();
    void refreshElement();
    void addLinks(const LiveRadiosity& live, std::uint32_t element);
    void goTo(std::uint64_t steps);
    [[nodiscard]] std::uint64_t mostSteps() const; // that the slider goes to
    void play(bool on);

    // What the list of light is of.
    struct Listed {
        std::shared_ptr<const void> live, step;
        std::optional<std::uint32_t> chosen;
        std::optional<bool> wanted; // nothing: not listed yet
        QString missing = {};       // missingFactorsText()
        friend bool operator==(const Listed&, const Listed&) = default;
    };

    Session& m_session;
    PanelScroll* m_scroll = nullptr;
    QWidget* m_header = nullptr;
    ElementOverlay& m_overlay;
    Listed m_listed;
    QPushButton *m_light, *m_solve;
    QLabel* m_status;
    QComboBox* m_view;
    QComboBox* m_unit;
    QPushButton *m_first, *m_back, *m_next, *m_round, *m_play, *m_end;
    QSlider* m_slider;
    QLabel* m_stepText;
    RadiosityPlots* m_plots;
    QLabel* m_elementText;
    QTreeWidget* m_flow;
    QTimer m_playing;
    bool m_refreshing = false;
};

} // namespace patina::editor
