// A sweep of lights as a job's work: which environments are rotated how often, and what was found
// of the lights. Values only; docs/maths/light-sweep.md says what is measured.
#pragma once

#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/job/JobContext.h"
#include "core/rank/LightSweep.h"

#include <cstddef>
#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patina {
class WorkerClient;
}

namespace patina::editor {

struct SweepOrder {
    Document document; // as it was when the sweep was asked for
    bool ofDocument = true, shipped = true;
    std::filesystem::path folder; // empty: none
    int rotations = 36;
    bool comparesWithScene = false; // differences are from the scene's light, not the mean look
    int width = 128, height = 128;  // pixels of each picture
};

// One that was measured. What lights the scene by it: the document's environment `id` while that
// still shows `image`, else `source` in place of what lights the scene.
struct SweptEnvironment {
    std::string title;
    std::string source;    // path or builtin:NAME; empty: made by the document alone
    Id id = 0;             // 0: not of the document
    ImagePtr image;        // of the document's; null: of none
    glm::vec3 scale{1.0f}; // of its radiance: tint and 2^EV
};

struct SweepProblem {
    std::string source, text;
};

// Of which transfer the pictures are.
struct SweepTransfer {
    bool quick = false; // made for the sweep: the document has none
    int bands = 0, rays = 0;
    std::vector<std::string> stale; // reasons why the document's is of an earlier scene
};

struct SweepOutcome {
    std::shared_ptr<const SweepOrder> order;
    std::vector<SweptEnvironment> environments; // as those of SweepLight
    std::vector<SweepEnvironment> measured;     // of each, harmonics scaled
    std::vector<std::optional<SameEnvironment>> same;
    std::vector<SweepProblem> problems; // environments that could not be read
    SweepTransfer transfer;
    SweepPixels pixels;
    SweepSettings settings;
    LightSweep sweep;

    [[nodiscard]] std::size_t rotations() const {
        return static_cast<std::size_t>(settings.rotations);
    }
};
using SweepOutcomePtr = std::shared_ptr<const SweepOutcome>;

// Errors: Usage where there is nothing to sweep or the view is OpenColorIO's; InputBroken where no
// environment can be read; those of a quick bake, traceSweepPixels() and sweepLights(); Cancelled.
Result<SweepOutcomePtr> runSweep(std::shared_ptr<const SweepOrder> order, WorkerClient& worker,
                                 const JobContext& job);

// How `environment` lights the document as it is now.
enum class SweptUse { OfDocument, BySource, Gone };
[[nodiscard]] SweptUse useOf(const SweptEnvironment& environment, const Document& document);

// Whether the outcome is true of the document as it is now. Which of the swept lights the scene has
// does not count, nor what lies behind it.
[[nodiscard]] bool stillHolds(const SweepOutcome& outcome, const Document& document);

} // namespace patina::editor
