// Draws the thumbnails of views (strip, equation bar) in time that nothing else needs: one pass of
// up to eight at a time, only while the hand rests, with pauses that keep all of them together at a
// quarter of what frames cost.
#pragma once

#include "app/editor/viewport/FrameSchedule.h"
#include "core/base/Result.h"
#include "core/image/Image.h"
#include "render/SheetRenderer.h"

#include <QImage>
#include <QObject>
#include <algorithm>
#include <functional>
#include <map>
#include <vector>

namespace patina::editor {

// Who shows thumbnails: a widget that adds itself to the scheduler and calls wake() when what can
// be seen of it changes (shown, scrolled, unfolded, resized).
class SheetClient {
  public:
    // What can be seen of it now, in any number, the most important first; no kinds while it is
    // hidden or folded. Sizes are device pixels.
    [[nodiscard]] virtual render::ViewSheet wantedSheet() const = 0;
    virtual void showThumbnail(ViewKind kind, const QImage& picture) = 0;

  protected:
    ~SheetClient() = default;
};

class SheetScheduler : public QObject {
    Q_OBJECT
  public:
    // Draws the views of a sheet, at most kPassViews of them; takes its time on the UI thread.
    using Draw = std::function<Result<std::vector<Image>>(const render::ViewSheet&)>;
    static constexpr int kPassViews = 8;

    // Passes are drawn in their turn of `schedule`, which outlives it.
    explicit SheetScheduler(FrameSchedule& schedule, QObject* parent = nullptr);

    // Whether a view can be drawn now without a stall; others wait for wake().
    using Ready = std::function<bool(ViewKind)>;

    void setDraw(Draw draw) { m_draw = std::move(draw); }
    void setReady(Ready ready) { m_ready = std::move(ready); }
    void add(SheetClient& client);
    void remove(SheetClient& client);

    [[nodiscard]] std::vector<ViewKind> wanted() const; // by all clients

    void wake();                   // a client wants others, or another size
    void invalidate();             // the scene looks different: every thumbnail is old
    void setResting(bool resting); // false: a drag needs the time

    // How long nothing is drawn after a pass, so that thumbnails cost a quarter of the rest. A pass
    // that took very long waited for the driver's compiler; the next one will not.
    [[nodiscard]] static double pauseAfterMs(double passMs) {
        return std::min(passMs / kShare, kLongestPauseMs);
    }

    // What a frame at rest takes: a pass has fewer views when it takes more than a quarter of that.
    void setFrameMs(double milliseconds) { m_frameMs = milliseconds; }

  Q_SIGNALS:
    void passDrawn(int views, double milliseconds);
    void allDrawn(); // nothing is old any more

  private:
    static constexpr double kShare = 0.25, kLongestPauseMs = 500.0;

    double m_frameMs = 0.0; // 0: unknown

    struct Entry {
        SheetClient* client;
        render::ViewSheet format;                 // mode and size of what was drawn
        std::map<ViewKind, quint64> drawnVersion; // of m_version
    };
    void drawNext();
    // The oldest wishes of one client that one pass can fulfil; no kinds: it has none.
    [[nodiscard]] render::ViewSheet nextSheet(Entry& entry);

    Draw m_draw;
    Ready m_ready;
    bool m_waits = false; // for what is not ready
    std::vector<Entry> m_entries;
    std::size_t m_turn = 0; // whose pass it is, so that no client waits for another
    quint64 m_version = 1;
    int m_passViews = kPassViews;
    bool m_resting = false;
    FrameSchedule::Task m_pass; // wanted during the pause, too
};

} // namespace patina::editor
