// The viewport's picture traced by paths or by the classical ray tracer, in the background: coarse
// within a moment of a change, then of full size, then finer with every pass, until it is as
// certain as is asked for.
#pragma once

#include "core/document/View.h"
#include "core/job/TaskRunner.h"
#include "core/light/Ibl.h"
#include "core/math/Camera.h"
#include "core/mix/LightMix.h"
#include "core/trace/error/TracedPicture.h"
#include "core/trace/path/PathTracer.h"
#include "core/trace/whitted/WhittedSettings.h"

#include <QObject>
#include <QSize>
#include <memory>
#include <optional>
#include <vector>

namespace patina::editor {

class DocumentController;

enum class TracedBy { Paths, Whitted };

class PathView : public QObject {
    Q_OBJECT
  public:
    static constexpr std::uint32_t kMostSamples = 4096; // per pixel
    static constexpr double kCertain = 0.01;            // Film::noise() that ends the work

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
    struct Progress {
        std::uint32_t samples = 0; // per pixel of full size; 0: coarse yet; Whitted: passes
        std::optional<double> noise;
        double raysPerSecond = 0.0, seconds = 0.0, rays = 0.0; // of the passes so far
        bool refined = false;                                  // nothing more is to come
        std::optional<Error> error;                            // why there is no picture
        std::optional<std::string> limit;                      // TraceScene::limit()
    };
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
    struct Reference {
        std::shared_ptr<const TracedPicture> traced;      // null: none yet
        std::shared_ptr<const std::vector<Id>> materials; // seenMaterials() of it
    };
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
    void changed(); // the picture, the progress, whether it is on or paused

  private:
    struct Work; // of one task at a time
    struct BlurredLight {
        ImagePtr image;
        std::shared_ptr<const IblMaps> maps; // of the image; null: none was needed
    };
    struct Pass {
        ImagePtr picture;
        std::shared_ptr<const TraceScene> scene;
        BlurredLight blurred;
        std::optional<double> noise;
        double rays = 0.0, seconds = 0.0;
        Reference reference;
        bool traces = false; // a pass, not only what it tells
    };
    void begin();
    void run(bool traces); // a pass, or only what it tells
    void proceed();
    void take(const Result<Pass>& pass);
    static Result<void> blurBackground(Work& work, const JobContext& job);
    static Result<Pass> trace(Work& work, bool traces, bool tells, const JobContext& job);
    static Reference tell(Work& work, const JobContext& job);
    static Result<void> tracePass(Work& work, Pass& pass, const JobContext& job, TraceRays& rays);
    static Result<void> traceWhittedPass(Work& work, Pass& pass, const JobContext& job,
                                         TraceRays& rays);

    DocumentController& m_controller;
    bool m_on = false, m_paused = false, m_tells = false;
    TracedBy m_tracer = TracedBy::Paths;
    WhittedSettings m_whitted;
    TraceInputs m_inputs; // wanted
    Camera m_camera;
    View m_look;              // what of it stands behind the scene …
    EnvironmentPart m_behind; // … blurred
    QSize m_size;
    bool m_stale = false;    // something else is wanted than what is under way
    bool m_hasFirst = false; // a picture of what is under way has come
    std::shared_ptr<Work> m_work;
    std::shared_ptr<const TraceScene> m_scene; // the one built last
    BlurredLight m_blurred;
    ImagePtr m_picture;
    Reference m_reference;
    std::uint64_t m_number = 0;
    Progress m_progress;
    double m_rays = 0.0;
    TaskGroup m_tasks; // last: it ends before the rest
};

} // namespace patina::editor
