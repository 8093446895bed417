// One traced picture under way, pass by pass: coarse at first, then of full size, then with more
// and more samples per pixel, until it is as certain as is asked for.
#pragma once

#include "core/document/View.h"
#include "core/job/JobContext.h"
#include "core/light/Ibl.h"
#include "core/math/Camera.h"
#include "core/mix/LightMix.h"
#include "core/trace/error/TracedPicture.h"
#include "core/trace/path/PathTracer.h"
#include "core/trace/whitted/WhittedSettings.h"

#include <QSize>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patina::editor {

enum class TracedBy { Paths, Whitted };

// What a traced picture is of.
struct TraceSubject {
    TraceInputs inputs;
    Camera camera;
    QSize size;             // pixels
    View look;              // what of it stands behind the scene …
    EnvironmentPart behind; // … blurred

    [[nodiscard]] static TraceSubject of(const Document& document, const Camera& camera,
                                         const QSize& size);
    // Whether a picture of either is one of the other, too.
    [[nodiscard]] bool sameAs(const TraceSubject& other) const;
};

class TraceWork {
  public:
    static constexpr std::uint32_t kMostSamples = 4096; // per pixel
    static constexpr double kCertain = 0.01;            // Film::noise() that ends the work
    // The sides of the first pictures, of one sample, are these shares of the full ones.
    static constexpr int kCoarsest = 8;
    static constexpr std::size_t kBytesPerPixel = sizeof(Film::Pixel) + 4 * sizeof(float);

    struct BlurredLight {
        ImagePtr image;
        std::shared_ptr<const IblMaps> maps; // of the image; null: none was needed
    };
    // Of the picture before: what fits this one is used again.
    struct Known {
        std::shared_ptr<const TraceScene> scene; // null: none
        BlurredLight blurred;
    };
    TraceWork(const TraceSubject& subject, TracedBy tracer, const WhittedSettings& whitted,
              Known known);

    // Before the first pass: of full size at once, with so many samples (not of a classical picture
    // without any that are random, which has its own).
    void setFine(std::uint32_t samples);

    struct Reference {
        std::shared_ptr<const TracedPicture> traced;      // null: none yet
        std::shared_ptr<const std::vector<Id>> materials; // seenMaterials() of it
    };
    struct Pass {
        ImagePtr picture; // F32, 4 channels, premultiplied; null: nothing was traced
        Known known;
        std::optional<double> noise;
        double rays = 0.0, seconds = 0.0;
        Reference reference;
        bool traces = false; // a pass, not only what it tells
    };
    // The next one, which takes about `seconds` where a sample takes less. `tells`: with what it is
    // a reference of. Errors: those of TraceScene::build() and computeIbl(). In a job; two never
    // run at once, and nothing else looks at the work meanwhile.
    [[nodiscard]] Result<Pass> trace(double seconds, bool tells, const JobContext& job);
    [[nodiscard]] Pass tell(const JobContext& job); // without another one

    [[nodiscard]] TracedBy tracer() const { return m_tracer; }
    [[nodiscard]] const TraceView& view() const { return m_view; } // complete after a pass
    [[nodiscard]] const ShadingModel& model() const { return m_inputs.model; }
    [[nodiscard]] int reduction() const { return m_reduction; } // of the next pass; 1: full size
    [[nodiscard]] std::uint32_t samples() const {
        return m_samples;
    } // of full size; Whitted: passes
    [[nodiscard]] std::uint32_t mostSamples() const;

  private:
    Result<void> prepare(const JobContext& job);
    Result<void> blurBackground(const JobContext& job);
    Result<void> tracePass(Pass& pass, const JobContext& job, TraceRays& rays);
    Result<void> traceWhittedPass(Pass& pass, const JobContext& job, TraceRays& rays);
    Result<void> addSamples(Pass& pass, const JobContext& job, TraceRays& rays);
    Reference reference(const JobContext& job);

    TraceInputs m_inputs;
    Known m_known;
    std::shared_ptr<const TraceScene> m_scene; // null: to be built
    TraceView m_view;
    std::optional<EnvironmentPart> m_behind; // blurred, in place of the environment
    float m_blur = 0.0f;
    int m_reduction = kCoarsest;
    Film m_film; // of full size
    std::uint32_t m_samples = 0, m_next = 1;
    std::optional<std::uint32_t> m_most;                // nothing: as many as there may be
    std::shared_ptr<const std::vector<Id>> m_materials; // null: not looked for yet
    TracedBy m_tracer;
    WhittedSettings m_whitted;
};

// How far such a picture is.
struct TraceProgress {
    std::uint32_t samples = 0; // per pixel of full size; 0: coarse yet; Whitted: passes
    std::optional<double> noise;
    double raysPerSecond = 0.0, seconds = 0.0, rays = 0.0; // of the passes so far
    bool refined = false;                                  // nothing more is to come
    std::optional<Error> error;                            // why there is no picture
    std::optional<std::string> limit;                      // TraceScene::limit()

    void add(const TraceWork::Pass& pass, const TraceWork& work); // after it
    void fail(const Error& error);
};

} // namespace patina::editor
