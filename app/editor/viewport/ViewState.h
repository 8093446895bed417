// How the scene is looked at: which view of the shading equation, which terms, which split. It is
// no part of the document: looking is never undone and never saved.
#pragma once

#include "render/view/ViewSettings.h"

#include <QObject>
#include <array>
#include <map>

namespace patina::editor {

// Whether colours stand for numbers over a range, so that it can be locked.
[[nodiscard]] bool hasRange(const render::ViewChoice& choice);

enum class ViewSide { Shown, Other }; // of the split

class ViewState : public QObject {
    Q_OBJECT
  public:
    explicit ViewState(QObject* parent = nullptr);

    [[nodiscard]] const render::ViewSettings& settings() const { return m_settings; }
    [[nodiscard]] ViewKind shown() const { return m_settings.shown.kind; }
    void set(const render::ViewSettings& settings);
    // settings() with one thing changed: edit([](ViewSettings& s) { s.shown.kind = … ; }).
    template <class Change>
    void edit(Change change) {
        render::ViewSettings settings = m_settings;
        change(settings);
        set(settings);
    }

    // In the whole picture, or left of the split.
    void show(ViewKind kind);
    // Right of the split, which is made when there is none.
    void showOther(ViewKind kind);
    // The picture, or from there what was looked at before.
    void toggleFinal();
    // The next view of the group; from another group the one that was looked at there last. Back:
    // the one before.
    void cycle(ViewGroup group, bool back = false);
    // Splits what is shown from what was shown before it; or joins. A traced picture is split from
    // the drawn one.
    void toggleSplit();
    void setTraced(bool traced) { m_traced = traced; } // the picture is

    // Contributions are a wish: views without one (ViewInfo::contribution) show their value.
    void setMode(render::ViewMode mode);
    [[nodiscard]] render::ViewMode mode() const { return m_mode; }

    // Locks the range of a view wherever it is shown, or lets it go.
    void setRange(ViewKind kind, const std::optional<render::ViewRange>& range);

    // What the last frame's views were shown over, where they have a range.
    void setMeasuredRanges(const std::optional<render::ViewRange>& shown,
                           const std::optional<render::ViewRange>& other);
    // The range that a view is shown over: locked, measured, or the table's.
    [[nodiscard]] render::ViewRange rangeOf(const render::ViewChoice& choice) const;

    // The picture still shows what was shown before: the driver compiles what this view needs.
    void setPreparing(bool preparing);
    [[nodiscard]] bool preparing() const { return m_preparing; }

  Q_SIGNALS:
    void changed();
    void rangeMeasured(); // and it is another one
    void preparingChanged();

  private:
    [[nodiscard]] render::ViewChoice choice(ViewKind kind) const;

    render::ViewSettings m_settings;
    render::ViewMode m_mode = render::ViewMode::Raw;
    std::map<ViewKind, render::ViewRange> m_ranges; // the locked ones
    std::optional<render::ViewRange> m_shownRange, m_otherRange;
    bool m_preparing = false, m_traced = false;
    std::array<ViewKind, kViewGroupCount> m_lastOfGroup{}; // looked at last
    ViewKind m_before = shading::kViewFinal;               // shown before the one that is
    ViewKind m_lastFactor = shading::kViewFinal;           // the last one that is not the picture
};

} // namespace patina::editor
