// Has the driver compile programs before a frame needs them: in the background, by a second
// renderer that draws them small (render/WarmUp.h) and is gone afterwards. What is compiled reaches
// the viewport through the driver's cache on disk.
#pragma once

#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/job/TaskRunner.h"
#include "render/WarmUp.h"

#include <QObject>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace patina::editor {

class ProgramWarmer : public QObject {
    Q_OBJECT
  public:
    explicit ProgramWarmer(TaskRunner& runner, QObject* parent = nullptr);

    // ContextInfo::renderer of the window's driver, which alone finds what it has compiled itself.
    void setRenderer(const std::string& renderer) { m_renderer = renderer; }

    // Whether such frames of the document are drawn without a stall: what they need is compiled, or
    // nothing can be done about it.
    [[nodiscard]] bool knows(const Document& document, const render::FrameKind& frame) const;
    // They have been drawn, or are about to be.
    void learn(const Document& document, const render::FrameKind& frame);

    enum class Urgency { Idle, Awaited };
    // Prepares frames of these kinds, one after the other. The newest request wins; one that asks
    // for nothing new leaves what is under way alone.
    void request(const Document& document, const std::vector<render::FrameKind>& frames,
                 Urgency urgency);
    [[nodiscard]] bool busy() const { return m_running; }

  Q_SIGNALS:
    void progressed(); // knows() says yes to more
    void finished();   // nothing is under way

  private:
    using Programs = std::set<std::uint64_t>;
    [[nodiscard]] Programs missing(const Document& document, const render::FrameKind& frame) const;

    // The frames of the request, one task after the other.
    void compileNext();
    void compiled(const render::FrameKind& frame, const Programs& programs, double milliseconds);
    void verify(); // that the driver keeps what it compiles
    void compile(const render::FrameKind& frame, std::function<void(double milliseconds)> then);
    void end(const std::optional<Error>& error);

    std::string m_renderer;
    bool m_running = false;
    Urgency m_urgency = Urgency::Idle;
    Programs m_underWay;
    std::shared_ptr<const Document> m_document; // of the request
    std::deque<std::pair<render::FrameKind, Programs>> m_frames;
    // Of the frames of eight views, the one that took longest: lighting modes share programs, and
    // one that finds most of its own compiled would tell nothing.
    render::FrameKind m_slowest;
    double m_slowestMs = 0.0;

    Programs m_known;
    bool m_verified = false; // the driver keeps what it compiles
    bool m_useless = false;  // no second context, or no cache on disk
    TaskGroup m_tasks;
};

} // namespace patina::editor
