// What one run of the editor is made of, apart from its window: who lives longer stands first.
#pragma once

#include "app/editor/document/DisplayLoader.h"
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/job/BounceUpdater.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/job/NearShadowUpdater.h"
#include "app/editor/job/UiTasks.h"
#include "app/editor/viewport/LightLimitNotice.h"
#include "app/editor/viewport/LobeOnSurface.h"
#include "app/editor/viewport/PixelProbe.h"
#include "app/editor/viewport/ViewState.h"
#include "app/editor/widget/Thumbnails.h"
#include "core/worker/WorkerClient.h"

namespace patina::editor {

struct Session {
    WorkerClient worker;
    TaskRunner tasks{postToThisThread()}; // all work in the background
    DocumentController controller{worker, tasks};
    DisplayLoader displays{controller};
    SelectionModel selection{controller};
    Thumbnails thumbnails{tasks};
    ViewState views;
    PixelProbe probe;
    LobeOnSurface lobe{controller, probe};
    JobManager jobs{controller};
    BounceUpdater bounces{controller, jobs};
    NearShadowUpdater nearShadows{controller};
    LightLimitNotice lightLimits{controller};
};

} // namespace patina::editor
