// What the shader computed under the pointer and at the pinned point. The viewport fills it after a
// frame while somebody wants it; panels read it.
#pragma once

#include "render/view/Inspection.h"

#include <QObject>
#include <optional>

namespace patina::editor {

// Where the pinned point of the surface is: its numbers are new only while it is seen.
enum class PinState { Seen, Hidden, Outside };

class PixelProbe : public QObject {
    Q_OBJECT
  public:
    explicit PixelProbe(QObject* parent = nullptr)
        : QObject(parent) {}

    // Who shows values takes part, so that nothing is computed for nobody.
    void addListener() {
        if (++m_listeners == 1)
            Q_EMIT wantedChanged();
    }
    void removeListener() { --m_listeners; }
    [[nodiscard]] bool wanted() const { return m_listeners > 0; }

    [[nodiscard]] const std::optional<render::Inspection>& hover() const { return m_hover; }
    [[nodiscard]] const std::optional<render::Inspection>& pin() const { return m_pin; }
    [[nodiscard]] PinState pinState() const { return m_pinState; }
    // The pin, else what lies under the pointer, or lay there when it left.
    [[nodiscard]] const std::optional<render::Inspection>& shown() const {
        return m_pin ? m_pin : m_hover;
    }

    void setHover(std::optional<render::Inspection> inspection) {
        m_hover = std::move(inspection);
        Q_EMIT hoverChanged();
    }
    void setPin(std::optional<render::Inspection> inspection) {
        m_pin = std::move(inspection);
        m_pinState = PinState::Seen;
        Q_EMIT pinChanged();
    }
    void setPinState(PinState state) {
        if (state == m_pinState)
            return;
        m_pinState = state;
        Q_EMIT pinChanged();
    }

  Q_SIGNALS:
    void hoverChanged();
    void pinChanged();    // set, taken away, out of sight, or its numbers are new
    void wantedChanged(); // somebody begins to listen

  private:
    int m_listeners = 0;
    std::optional<render::Inspection> m_hover, m_pin;
    PinState m_pinState = PinState::Seen;
};

} // namespace patina::editor
