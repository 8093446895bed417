// The lighting ladder as a job's work: the scene lit by every method, drawn, and held against its
// path-traced picture, which becomes finer meanwhile.
#pragma once

#include "app/editor/document/SceneCopy.h"
#include "core/base/Hash.h"
#include "core/document/View.h"
#include "core/document/ViewChoices.h"
#include "core/ladder/Ladder.h"
#include "core/ladder/LadderTruth.h"
#include "core/trace/error/PictureError.h"
#include "core/trace/path/TraceInputs.h"

#include <QImage>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patina::editor {

// What was baked for a ladder, for the next one of the same geometry.
struct KeptLadderBakes {
    Hash inputs; // hashBakeInputs() of the scene
    LadderBakes bakes;
    TraceInputs lit; // that its light map rests on
};

struct LadderOrder {
    SceneCopy scene;
    int width = 0, height = 0; // pixels of each picture
    LadderTruthSettings truth;
    std::shared_ptr<const KeptLadderBakes> kept; // null: none
};

// A method, or last the path-traced picture. Pictures are as displayed; null: not there yet.
struct LadderStep {
    std::string name;  // LadderRung's; "path" of the traced picture
    std::string label; // "N·L"
    std::string whyNot;
    QImage picture, exposure, visible;         // the latter two: errorPicture()
    std::optional<ErrorScore> score;           // not of the traced picture
    double milliseconds = 0.0;                 // of a frame; 0: not drawn yet
    double bakeSeconds = 0.0;                  // that its bake took, now or for an earlier ladder
    LightingMode lighting = LightingMode::Ibl; // that the document takes to be lit so
    BakeArtifactPtr bake;                      // that it needs beside; null: none
};

[[nodiscard]] bool needsLadderBake(const LadderStep& step);

// The index of the method that lights the document as it is; of the one with the least visible
// error of those that can light it. Nothing: none is known.
[[nodiscard]] std::optional<std::size_t> stepInUse(const std::vector<LadderStep>& steps,
                                                   const Document& document);
[[nodiscard]] std::optional<std::size_t> closestStep(const std::vector<LadderStep>& steps,
                                                     const Document& document);

struct LadderShown {
    std::shared_ptr<const LadderOrder> order;
    std::vector<LadderStep> steps;
    std::uint32_t samples = 0;        // paths per pixel of the traced picture so far
    double noise = 0.0;               // Film::noise() of it
    double seconds = 0.0;             // that tracing took; 0: it is not done
    std::optional<std::string> limit; // of what was traced: LadderTruth::limit
    std::shared_ptr<const KeptLadderBakes> kept;

    [[nodiscard]] bool isDone() const { return seconds > 0.0; }
};
using LadderShownPtr = std::shared_ptr<const LadderShown>;

// `shown`: called with what there is, again and again. Errors: Usage where the tone curve is
// OpenColorIO's; those of ladderBakes(), TraceScene::build() and of OpenGL; Cancelled.
Result<LadderShownPtr> runLadder(std::shared_ptr<const LadderOrder> order, PreparedLights& lights,
                                 const std::function<void(LadderShownPtr)>& shown,
                                 const JobContext& job);

// Whether what was found is true of the document as it is now. How it is lit does not count.
[[nodiscard]] bool stillHolds(const LadderOrder& order, const Document& document);

} // namespace patina::editor
