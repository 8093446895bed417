// What one run of the editor is made of, apart from its window: the document, the services that
// panels use, and the one runner of their work. Who lives longer stands first.
#pragma once

#include "app/editor/document/DisplayLoader.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/job/BakeService.h"
#include "app/editor/job/BounceUpdater.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/job/NearShadowUpdater.h"
#include "app/editor/job/UiTasks.h"
#include "app/editor/library/EnvironmentLibrary.h"
#include "app/editor/library/EnvironmentPreview.h"
#include "app/editor/memory/MemoryUse.h"
#include "app/editor/radiosity/RadiosityUpdater.h"
#include "app/editor/trace/PathBlame.h"
#include "app/editor/trace/PathError.h"
#include "app/editor/trace/PathView.h"
#include "app/editor/trace/RayTreeProbe.h"
#include "app/editor/trace/TracedSide.h"
#include "app/editor/trace/WhittedHeat.h"
#include "app/editor/viewport/IblUpdater.h"
#include "app/editor/viewport/LightLimitNotice.h"
#include "app/editor/viewport/LobeOnSurface.h"
#include "app/editor/viewport/PixelProbe.h"
#include "app/editor/viewport/ViewState.h"
#include "app/editor/wall/TracedCells.h"
#include "app/editor/wall/WallComparison.h"
#include "app/editor/wall/WallState.h"
#include "app/editor/widget/Thumbnails.h"
#include "core/worker/WorkerClient.h"

#include <chrono>

namespace patina::editor {

struct Session {
    WorkerClient worker;
    TaskRunner tasks{postToThisThread()}; // all work in the background
    DocumentController controller{worker, tasks};
    DisplayLoader displays{controller};
    SelectionModel selection{controller};
    Thumbnails thumbnails{tasks};
    PreparedLights lights{iblCacheFolder()};
    IblUpdater ibl{tasks, lights};
    EnvironmentLibrary library{controller, libraryCacheFolder()};
    EnvironmentPreview preview{controller, lights};
    ViewState views;
    WallState wall{controller};
    WallComparison comparison{wall, tasks, worker};
    PixelProbe probe;
    LobeOnSurface lobe{controller, probe};
    PathView paths{controller};
    PathError pathError{controller, paths};
    PathBlame pathBlame{controller, paths, pathError};
    RayTreeProbe rayTree{controller, paths};
    WhittedHeat heat{controller, paths};
    TracedSide side{views, paths, pathError, heat};
    TracedCells tracedCells{wall, controller, paths};
    JobManager jobs{controller};
    BakeService bakes{controller, jobs};
    BounceUpdater bounces{controller, bakes.hits()};
    NearShadowUpdater nearShadows{controller};
    RadiosityUpdater radiosity{controller, radiosityCacheFolder()};
    LightLimitNotice lightLimits{controller};
    MemoryUse memory{*this};

    // The end of all work in the background: what is being saved is saved, bakes keep their
    // checkpoints, solved radiosity goes to its cache, and the rest has `patience` to notice. False
    // when something still runs.
    bool shutDown(std::chrono::milliseconds patience) {
        jobs.shutDown();
        radiosity.shutDown();
        return tasks.shutDown(patience);
    }
};

} // namespace patina::editor
