// Has the driver compile programs before a frame needs them: in the background, by a second
// renderer that draws them small (render/WarmUp.h) and is gone afterwards. What is compiled reaches
// the viewport through the driver's cache on disk.
#pragma once

#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/job/JobContext.h"
#include "render/WarmUp.h"

#include <QObject>
#include <QThreadPool>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace patina::editor {

class ProgramWarmer : public QObject {
    Q_OBJECT
  public:
    explicit ProgramWarmer(QObject* parent = nullptr);
    ~ProgramWarmer() override; // cancels and waits

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
    struct Task {
        Document document;
        std::vector<std::pair<render::FrameKind, Programs>> frames;
        bool verify = false; // that the driver keeps what it compiles
    };
    [[nodiscard]] Programs missing(const Document& document, const render::FrameKind& frame) const;

    // On the pool's thread.
    void work(quint64 id, const Task& task, const JobContext& job);
    Result<void> warm(quint64 id, const Task& task, const JobContext& job);
    template <class Apply>
    void post(quint64 id, Apply apply); // to the UI thread, unless it is overtaken

    QThreadPool m_pool, m_idlePool; // somebody waits; nobody does
    JobControl m_control;
    quint64 m_id = 0; // the newest
    bool m_running = false;
    Urgency m_urgency = Urgency::Idle;
    Programs m_underWay;

    Programs m_known;
    bool m_verified = false; // the driver keeps what it compiles
    bool m_useless = false;  // no second context, or no cache on disk
};

} // namespace patina::editor
