// One channel of the light mixer: name, fader, gain as a number, tint, mute and solo, and how much
// light comes out. It stores nothing: what it shows comes from the document, what the user does
// goes to the controller.
#pragma once

#include "app/editor/document/DocumentController.h"
#include "core/edit/Parameters.h"

#include <QFrame>

class QLabel;
class QToolButton;
class QVBoxLayout;

namespace patina::editor {

class ColorButton;
class ElidedLabel;
class Fader;
class NumberField;

// Which parameters the channel's controls change.
struct MixerChannel {
    Target target;
    const ParameterInfo* gain = nullptr;
    const ParameterInfo* tint = nullptr;
    const ParameterInfo* enabled = nullptr;
    const ParameterInfo* solo = nullptr;
    friend bool operator==(const MixerChannel&, const MixerChannel&) = default;
};

class MixerStrip : public QFrame {
    Q_OBJECT
  public:
    MixerStrip(DocumentController& controller, const MixerChannel& channel,
               QWidget* parent = nullptr);

    [[nodiscard]] const MixerChannel& channel() const { return m_channel; }
    // What it says above the fader, for readers of the screen, too.
    void setName(const QString& name, const QString& iconName);
    // Takes the channel's values from the document; `lux`: what comes out.
    void refresh(float lux, bool active);

  private:
    void connectGain();
    void connectTint();
    void set(const ParameterInfo& info, const ParameterValue& value, DragSession session = 0);
    void step(const ParameterInfo& info, const ParameterValue& value);

    DocumentController& m_controller;
    MixerChannel m_channel;
    QVBoxLayout* m_layout;
    QLabel* m_icon;
    ElidedLabel* m_name;
    Fader* m_fader;
    NumberField* m_gain;
    ColorButton* m_tint;
    QToolButton *m_mute, *m_solo;
    QLabel* m_level;
    DragSession m_session = 0, m_stepSession = 0;
    qint64 m_lastStepMs = 0;
};

} // namespace patina::editor
