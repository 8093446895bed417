// `patina bake radiosity`: the light that surfaces send to one another, at their vertices or in a
// light map. The steps of it that merging parts has in common.
#pragma once

#include "app/cli/Options.h"
#include "app/cli/SceneSetup.h"
#include "app/cli/Session.h"
#include "core/document/Document.h"
#include "core/radiosity/SolveKeeper.h"
#include "core/radiosity/document/LitDocument.h"
#include "core/trace/path/TraceInputs.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace patina::cli {

struct RadiosityInputs {
    SceneRequest request;
    Document document;
    TraceInputs traced;
};
struct SolvedRadiosity {
    std::unique_ptr<RadiosityScene> scene;
    radiosity::Solved solved;
};

// Usage error for options that have no effect, and for files that radiosity is not written to.
Result<void> checkRadiosityFile(const BakeRadiosityOptions& options);
// Usage errors.
Result<RadiositySettings> radiositySettingsOf(const BakeRadiosityOptions& options);
void reportRadiositySettings(Session& session, const BakeRadiosityOptions& options,
                             const RadiositySettings& settings);
// `sets`: instead of those of --set.
Result<RadiosityInputs> openRadiosityScene(Session& session, const BakeRadiosityOptions& options,
                                           std::optional<std::vector<std::string>> sets = {});
// Errors: those of RadiosityScene::make() and solve(), and of writing what there is on the way.
Result<SolvedRadiosity> solveRadiosity(Session& session, const BakeRadiosityOptions& options,
                                       const RadiositySettings& settings, RadiosityInputs& inputs,
                                       radiosity::SolveKeeper* keeper);
// Into options.output, after what else was asked for of the solution.
Result<void> writeRadiositySolution(Session& session, const BakeRadiosityOptions& options,
                                    const RadiositySettings& settings,
                                    const RadiosityInputs& inputs, const SolvedRadiosity& solved);

} // namespace patina::cli
