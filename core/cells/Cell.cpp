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

namespace {

// Sets what each visible mesh is covered with.
template <class Set> // Set: (const Target&, const ParameterInfo&, const ParameterValue&)
void cover(const Document& document, Id material, Set set) {
    const ParameterInfo& info = *findParameter("mesh.material");
    std::vector<Id> meshes; // setting one may move the others
    for (const MeshInstance& mesh : document.meshes)
        if (mesh.visible)
            meshes.push_back(mesh.id);
    for (const Id mesh : meshes)
        set(Target{Scope::Mesh, mesh}, info, static_cast<int>(material));
}

Error goneError(std::string_view what) {
    return {ErrorKind::Usage,
            fmt::format("the {} of this cell is no longer in the scene; choose another one", what),
            {},
            {}};
}

} // namespace

Cell combined(Cell below, const Cell& above) {
    if (above.environment != 0)
        below.environment = above.environment;
    if (above.camera)
        below.camera = above.camera;
    if (above.snapshot != 0)
        below.snapshot = above.snapshot;
    if (above.material != 0) {
        below.material = above.material;
        const ParameterInfo* info = findParameter("mesh.material");
        std::erase_if(below.own, [info](const CellEdit& own) { return own.info == info; });
    }
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
            return goneError("environment");
        shown.mix = {};
        shown.mix.first = cell.environment;
    }
    if (cell.camera)
        shown.view.camera = *cell.camera;
    const auto set = [&shown](const Target& target, const ParameterInfo& info,
                              const ParameterValue& value) -> Result<void> {
        for (const ParameterEdit& edit : editsFor(shown, info, target, value))
            if (Result<Change> done = applyParameter(shown, *edit.info, target, edit.value); !done)
                return done.error();
        return {};
    };
    if (cell.material != 0) {
        if (shown.material(cell.material) == nullptr)
            return goneError("material");
        Result<void> covered;
        cover(shown, cell.material, [&](const auto&... edit) {
            if (covered)
                covered = set(edit...);
        });
        if (!covered)
            return covered.error();
    }
    for (const CellEdit& own : cell.own) {
        if (!targetExists(shown, own.target))
            return Error{ErrorKind::Usage,
                         fmt::format("{} of this cell cannot be set: its {} is no longer in the "
                                     "scene; choose another one",
                                     own.info->id, scopeName(own.target.scope)),
                         {},
                         {}};
        if (Result<void> done = set(own.target, *own.info, own.value); !done)
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
        if (cell.material != 0)
            cover(session.document(), cell.material,
                  [&](const Target& target, const ParameterInfo& info,
                      const ParameterValue& value) { session.setParameter(info, target, value); });
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
