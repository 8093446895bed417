// Brings what the user looks at into the viewport's frames: the chosen views, the picture where a
// view does not apply, marks that blink; and back how the frame showed them.
#pragma once

#include "app/editor/viewport/Blink.h"
#include "render/view/ViewSettings.h"

#include <QObject>

namespace patina::render {
class ViewRenderer;
}

namespace patina::editor {

class DocumentController;
class TracedSide;
class ViewGate;
class ViewState;

class ViewFeed : public QObject {
    Q_OBJECT
  public:
    explicit ViewFeed(DocumentController& controller, QObject* parent = nullptr);

    void setViews(ViewState& views);
    void setTraced(const TracedSide& traced) { m_traced = &traced; } // its side is not drawn

    // Of the frame that is drawn next, as the gate lets it.
    [[nodiscard]] render::ViewSettings beginFrame(ViewGate& gate);
    // Of the frame that was drawn last, with marks at full strength.
    [[nodiscard]] const render::ViewSettings& drawn() const { return m_drawn; }
    // As chosen: for thumbnails, which must not keep what the frame shows while it waits for its
    // programs.
    [[nodiscard]] const render::ViewSettings& chosen() const { return m_followed; }
    // Whether that frame shows the scene of the frame before, apart from how strong marks are.
    [[nodiscard]] bool sameAsBefore() const { return m_same; }
    void endFrame(const render::ViewRenderer& renderer);
    void setPreparing(bool preparing); // what is asked for is not shown yet
    [[nodiscard]] Blink& blink() { return m_blink; }

  Q_SIGNALS:
    void changed();      // something else is shown
    void termsChanged(); // and thumbnails, too, look different

  private:
    void follow();
    // The view, or the picture where the legend says why it does not apply.
    void standIn(render::ViewChoice& choice) const;

    DocumentController& m_controller;
    ViewState* m_views = nullptr;
    const TracedSide* m_traced = nullptr;
    render::ViewSettings m_followed; // as chosen, and announced last
    render::ViewSettings m_drawn;    // as drawn last, with marks at full strength
    bool m_same = false;
    bool m_drawsOther = false; // that frame has the other side's view alone
    Blink m_blink;
};

} // namespace patina::editor
