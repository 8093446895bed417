// How the scene is looked at: which view of the shading equation, which terms, which split. It is
// no part of the document: looking is never undone and never saved.
#pragma once

#include "render/view/ViewSettings.h"

#include <QObject>

namespace patina::editor {

class ViewState : public QObject {
    Q_OBJECT
  public:
    explicit ViewState(QObject* parent = nullptr)
        : QObject(parent) {}

    [[nodiscard]] const render::ViewSettings& settings() const { return m_settings; }
    void set(const render::ViewSettings& settings) {
        if (settings == m_settings)
            return;
        m_settings = settings;
        Q_EMIT changed();
    }
    // settings() with one thing changed: edit([](ViewSettings& s) { s.shown.kind = … ; }).
    template <class Change>
    void edit(Change change) {
        render::ViewSettings settings = m_settings;
        change(settings);
        set(settings);
    }

  Q_SIGNALS:
    void changed();

  private:
    render::ViewSettings m_settings;
};

} // namespace patina::editor
