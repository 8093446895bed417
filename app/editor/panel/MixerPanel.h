// The Light Mixer dock: as on a mixing desk, one channel for each environment and each light, and
// the cross-fade between the two environments.
#pragma once

#include "app/editor/panel/MixerStrip.h"
#include "core/image/Image.h"

#include <QWidget>
#include <array>
#include <vector>

class QHBoxLayout;
class QMenu;
class QToolButton;

namespace patina::editor {

class NumberField;
class Slider;

class MixerPanel : public QWidget {
    Q_OBJECT
  public:
    explicit MixerPanel(DocumentController& controller, QWidget* parent = nullptr);
    [[nodiscard]] QSize sizeHint() const override;

  protected:
    void showEvent(QShowEvent* event) override;

  private:
    [[nodiscard]] std::vector<MixerChannel> channels() const;
    QWidget* makeFade();
    QWidget* makeSecondSource();
    void fillSources(QMenu& menu);
    void openSecond();
    void fadeToSource(const QString& source);
    void rebuild();
    void refresh();
    void refreshStrip(MixerStrip& strip);
    [[nodiscard]] float illuminanceOf(const ImagePtr& picture);

    struct Known {
        ImagePtr picture;
        float illuminance = 0.0f;
    };
    DocumentController& m_controller;
    QHBoxLayout* m_strips;
    std::vector<MixerStrip*> m_channels;
    QWidget* m_fadeBox;
    QToolButton* m_add; // of the second environment
    Slider* m_fade;
    NumberField* m_fadeField;
    std::array<Known, 2> m_known; // of the environments' pictures
    std::size_t m_nextKnown = 0;
    DragSession m_session = 0, m_stepSession = 0;
    qint64 m_lastStepMs = 0;
};

} // namespace patina::editor
