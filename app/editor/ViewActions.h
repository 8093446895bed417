// Every action of looking at the terms of shading: one per view, in turn by group, back to the
// picture, contribution, range, light, split, the terms that the picture is made of. Menu, keys and
// the page of shortcuts come from here. A key that is held longer than a moment only peeks: letting
// go returns to what was shown.
#pragma once

#include "core/document/Views.h"
#include "render/view/ViewSettings.h"

#include <QAction>
#include <QElapsedTimer>
#include <QList>
#include <QObject>
#include <vector>

class QMenu;

namespace patina::editor {

class DocumentController;
class ViewState;

class ViewActions : public QObject {
    Q_OBJECT
  public:
    static constexpr int kPeekMs = 250; // a key held longer peeks

    ViewActions(ViewState& views, DocumentController& controller, QObject* parent);

    QAction *toFinal, *contribution, *lockRange, *split, *strip, *equation, *allTerms;
    [[nodiscard]] QAction* view(ViewKind kind) const {
        return m_views[static_cast<std::size_t>(kind)];
    }
    [[nodiscard]] QList<QAction*> all() const;
    // Those of the page of shortcuts: going back through a group is the same key with Shift.
    [[nodiscard]] QList<QAction*> listed() const;
    void fillMenu(QMenu& menu);

    // The key of a view, "B"; empty when it has none.
    [[nodiscard]] static QString keyOf(ViewKind kind);

  protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    QAction* make(const QString& text, const QString& keys, const QString& sentence, bool peeks);
    void makeViews();
    void makeCycles();
    void makeTerms();
    void refresh();
    void fillLights(QMenu& menu);
    void endHold(bool restore);
    [[nodiscard]] bool heldUntil(quint64 releaseMs) const; // longer than a moment

    ViewState& m_state;
    DocumentController& m_controller;
    std::vector<QAction*> m_views;  // by ViewKind
    std::vector<QAction*> m_cycles; // by ViewGroup: forwards and back
    std::vector<QAction*> m_terms;  // by kTermViews: part of the picture
    QElapsedTimer m_held;           // since the key of an action went down; invalid: none is
    quint64 m_lastPressMs = 0;      // of the newest key press, by the window system's clock
    quint64 m_heldSinceMs = 0;      // of the key that m_held is about; 0: not known
    render::ViewSettings m_beforeHold;
};

} // namespace patina::editor
