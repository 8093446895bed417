#include "core/cells/Cell.h"

#include "core/document/Snapshot.h"
#include "core/edit/Edit.h"
#include "core/edit/EditSession.h"
#include "core/edit/Looks.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/mix/EnvironmentBlend.h"

#include <fmt/format.h>
#include <utility>

namespace patina {

Cell combined(Cell below, const Cell& above) {
    if (above.environment != 0)
        below.environment = above.environment;
    if (above.camera)
        below.camera = above.camera;
    if (above.snapshot != 0)
        below.snapshot = above.snapshot;
    below.own.insert(below.own.end(), above.own.begin(), above.own.end());
    return below;
}

Result<Document> documentOf(const Document& document, const Cell& cell) {
    Document shown = document;
    if (cell.snapshot != 0) {
        const Snapshot* snapshot = document.snapshot(cell.snapshot);
        if (snapshot == nullptr)
            return Error{ErrorKind::Usage,
                         "the snapshot of this cell was removed; choose another one",
                         {},
                         {}};
        shown = withLook(std::move(shown), *snapshot->look);
    }
    if (cell.environment != 0) {
        if (shown.environment(cell.environment) == nullptr)
            return Error{ErrorKind::Usage,
                         "the environment of this cell is no longer in the scene; choose another "
                         "one",
                         {},
                         {}};
        shown.mix = {};
        shown.mix.first = cell.environment;
    }
    if (cell.camera)
        shown.view.camera = *cell.camera;
    for (const CellEdit& own : cell.own) {
        if (!targetExists(shown, own.target))
            return Error{ErrorKind::Usage,
                         fmt::format("{} of this cell cannot be set: its {} is no longer in the "
                                     "scene; choose another one",
                                     own.info->id, scopeName(own.target.scope)),
                         {},
                         {}};
        for (const ParameterEdit& edit : editsFor(shown, *own.info, own.target, own.value))
            if (Result<Change> done = applyParameter(shown, *edit.info, own.target, edit.value);
                !done)
                return done.error();
    }
    return shown;
}

void putIntoScene(EditSession& session, const Cell& cell) {
    session.group("Use Cell in Scene", [&] {
        if (cell.snapshot != 0)
            session.restoreSnapshot(cell.snapshot);
        if (cell.environment != 0) {
            session.lightWith(cell.environment);
            session.setParameter(*findParameter("environment.second"), {Scope::Environment, 0}, 0);
        }
        for (const CellEdit& own : cell.own)
            session.setParameter(*own.info, own.target, own.value);
    });
    if (cell.camera)
        session.setCamera(*cell.camera);
}

void resolveCell(Document& shown, const Document& document, const JobContext& job) {
    for (Environment& environment : shown.environments) {
        const Environment* linked = document.environment(environment.id);
        if (linked == nullptr || environmentRecipe(environment) != environmentRecipe(*linked))
            resolveEnvironment(environment, job);
    }
    if (environmentBlend(shown) != environmentBlend(document))
        resolveBlend(shown, job);
}

} // namespace patina
