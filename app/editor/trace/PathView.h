// The viewport's picture traced by paths or by the classical ray tracer, in the background: coarse
// within a moment of a change, then of full size, then finer with every pass, until it is as
// certain as is asked for.
#pragma once

#include "app/editor/trace/TraceWork.h"
#include "core/job/TaskRunner.h"

#include <QObject>
#include <QSize>
#include <memory>
#include <optional>

namespace patina::editor {

class DocumentController;

class PathView : public QObject {
    Q_OBJECT
  public:
    static constexpr double kCertain = TraceWork::kCertain;

    explicit PathView(DocumentController& controller, QObject* parent = nullptr);

    void setOn(bool on); // off: traces nothing, and lets go of all that it has
    [[nodiscard]] bool isOn() const { return m_on; }
    void setTracer(TracedBy tracer);
    [[nodiscard]] TracedBy tracer() const { return m_tracer; }
    [[nodiscard]] bool isWhitted() const { return m_on && m_tracer == TracedBy::Whitted; }
    void setWhitted(const WhittedSettings& settings); // not stochastic: the camera has the lens
    [[nodiscard]] const WhittedSettings& whitted() const { return m_whitted; }
    void setPaused(bool paused); // after the pass that is under way
    [[nodiscard]] bool isPaused() const { return m_paused; }

    // What the next pictures are of: the document as it is now, from this camera, at this size in
    // pixels. Where that is something else, it begins anew, once there is a first picture of what
    // was asked for before: a camera that keeps moving is followed.
    void want(const Camera& camera, const QSize& size);

    // The newest picture of full or, at first, of reduced size: F32, 4 channels, premultiplied.
    // Null: nothing has been traced yet.
    [[nodiscard]] const ImagePtr& picture() const { return m_picture; }
    [[nodiscard]] bool isTracing() const; // a pass is under way
    using Progress = TraceProgress;
    [[nodiscard]] const Progress& progress() const { return m_progress; }

    // What the newest picture of full size was traced in; nothing: there is none yet.
    struct Frame {
        std::shared_ptr<const TraceScene> scene;
        TraceView view;
    };
    [[nodiscard]] std::optional<Frame> frame() const;

    // Whether reference() is wanted, which takes memory: 16 bytes per pixel, and again as much of
    // what is under way.
    void setTellsCertainty(bool tells);
    using Reference = TraceWork::Reference;
    // Of the newest picture of full size.
    [[nodiscard]] const Reference& reference() const { return m_reference; }
    // What it traces, of full size; without a scene where there is no picture yet.
    struct Subject {
        std::shared_ptr<const TraceScene> scene;
        TraceView view;
        ShadingModel model;
    };
    [[nodiscard]] Subject subject() const;
    // Grows whenever it begins anew.
    [[nodiscard]] std::uint64_t number() const { return m_number; }

  Q_SIGNALS:
    void changed();      // the picture, the progress, whether it is on or paused
    void modelChanged(); // of whitted()

  private:
    void begin();
    void run(bool traces); // a pass, or only what it tells
    void proceed();
    void take(const Result<TraceWork::Pass>& pass);

    DocumentController& m_controller;
    bool m_on = false, m_paused = false, m_tells = false;
    TracedBy m_tracer = TracedBy::Paths;
    WhittedSettings m_whitted;
    TraceSubject m_subject;            // wanted
    bool m_stale = false;              // something else is wanted than what is under way
    bool m_hasFirst = false;           // a picture of what is under way has come
    std::shared_ptr<TraceWork> m_work; // of one task at a time
    TraceWork::Known m_known;          // of the pass before
    ImagePtr m_picture;
    Reference m_reference;
    std::uint64_t m_number = 0;
    Progress m_progress;
    TaskGroup m_tasks; // last: it ends before the rest
};

} // namespace patina::editor
