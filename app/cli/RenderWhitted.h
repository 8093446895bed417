// `patina render --renderer whitted`: what the classical ray tracer has besides renderTraced().
#pragma once

#include "app/cli/Session.h"
#include "core/base/StateFile.h"
#include "core/document/Document.h"
#include "core/io/ImageIO.h"
#include "core/trace/file/FilmTracer.h"
#include "core/trace/whitted/RayCountImages.h"
#include "core/trace/whitted/TeachingHierarchy.h"

#include <glm/vec2.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

namespace patina::cli {

// Usage errors besides those of checkTracing(): what only it has, or does not have.
Result<void> checkWhitted(const RenderOptions& options);

// By the options' names.
void addSettings(const WhittedSettings& settings, StateSettings& to);

// Traces a picture, and counts what its pixels take where --aov asks for it.
class WhittedPicture {
  public:
    // All must outlive it. Errors: Cancelled.
    static Result<WhittedPicture> prepare(const TraceScene& scene, const TraceView& view,
                                          const WhittedSettings& settings,
                                          std::vector<const RayCountInfo*> counts,
                                          const JobContext& job);
    [[nodiscard]] FilmPass pass();
    [[nodiscard]] std::vector<ImagePart> parts() const; // of the counts
    void describe(nlohmann::ordered_json& json) const;  // rays, and of the counts the sums

  private:
    WhittedPicture(const TraceScene& scene, const TraceView& view, const WhittedSettings& settings)
        : m_scene(&scene)
        , m_view(&view)
        , m_settings(settings) {}

    const TraceScene* m_scene;
    const TraceView* m_view;
    WhittedSettings m_settings;
    std::vector<const RayCountInfo*> m_counts;
    std::optional<TeachingHierarchy> m_hierarchy;
    std::optional<RayCountMap> m_map;
    std::unique_ptr<TraceRays> m_rays = std::make_unique<TraceRays>();
};

// Prints the tree of a pixel's rays, or puts it into the report as "rayTree".
void reportRayTree(Session& session, const Document& document, const RayTree& tree,
                   const glm::ivec2& pixel);

} // namespace patina::cli
