#include "app/editor/memory/MemoryUse.h"

#include "app/editor/Session.h"
#include "core/base/FreedMemory.h"
#include "core/base/ProcessMemory.h"
#include "core/light/Environment.h"
#include "core/material/Material.h"
#include "core/material/MaterialInputs.h"
#include "core/mesh/Mesh.h"
#include "render/gl/GpuMemory.h"

#include <QSettings>
#include <algorithm>
#include <set>

namespace patina::editor {
namespace {

constexpr int kLookMs = 1000;
constexpr std::size_t kMostByDefault = std::size_t{1} << 30;

QString budgetKey() {
    return QStringLiteral("memory/budgetBytes");
}

// Images and meshes, each once however often it is used.
std::size_t sceneBytes(const Document& document) {
    std::set<const void*> seen;
    std::size_t bytes = 0;
    const auto addImage = [&](const ImagePtr& image) {
        if (image && seen.insert(image.get()).second)
            bytes += image->bytes().size();
    };
    for (const MeshInstance& instance : document.meshes)
        if (const Mesh* mesh = instance.mesh.get(); mesh && seen.insert(mesh).second)
            bytes += mesh->positions.size() * sizeof(mesh->positions[0]) +
                     mesh->normals.size() * sizeof(mesh->normals[0]) +
                     mesh->tangents.size() * sizeof(mesh->tangents[0]) +
                     mesh->uvs.size() * sizeof(mesh->uvs[0]) +
                     mesh->indices.size() * sizeof(mesh->indices[0]);
    for (const Material& material : document.materials)
        forEachMap(material, [&](const MapSlot& map) { addImage(map.image); });
    for (const Environment& environment : document.environments) {
        addImage(environment.image);
        addImage(environment.fileImage);
    }
    addImage(document.mix.blended);
    for (const BakeArtifactPtr& bake : document.bakes)
        if (bake && seen.insert(bake.get()).second)
            bytes += artifactBytes(*bake);
    return bytes;
}

} // namespace

std::size_t MemoryUse::usualBudget() {
    const std::size_t installed = installedMemory();
    return installed == 0 ? kMostByDefault
                          : std::clamp(installed / 4, kLeastBudget, kMostByDefault);
}

MemoryUse::MemoryUse(Session& session, QObject* parent)
    : QObject(parent)
    , m_session(session)
    , m_budget(std::max<std::size_t>(
          kLeastBudget, QSettings()
                            .value(budgetKey(), QVariant::fromValue<qulonglong>(usualBudget()))
                            .toULongLong())) {
    m_keepers = {
        {tr("Prepared light"), tr("Of environments that were shown before; they light at once"),
         [this] { return m_session.lights.bytes(); },
         [this](std::size_t most) { m_session.lights.free(most); }},
        {tr("Earlier bakes"), tr("Of other states of the scene; undo brings them back"),
         [this] { return m_session.bakes.kept().bytes(); },
         [this](std::size_t most) { m_session.bakes.kept().free(most); }},
        {tr("Undo history"), tr("Images, meshes and bakes that undo and redo alone keep"),
         [this] { return m_session.controller.session().historyBytes(); },
         [this](std::size_t most) { m_session.controller.session().dropOldest(most); }},
    };
    m_timer.setInterval(kLookMs);
    connect(&m_timer, &QTimer::timeout, this, &MemoryUse::keepToBudget);
    m_timer.start();
}

std::size_t MemoryUse::kept() const {
    std::size_t bytes = 0;
    for (const Keeper& keeper : m_keepers)
        bytes += keeper.bytes();
    return bytes;
}

QList<MemoryPart> MemoryUse::parts() const {
    QList<MemoryPart> parts;
    parts.append({tr("Scene"), tr("Its meshes, images, environments and bakes"),
                  sceneBytes(m_session.controller.document())});
    const gl::GpuMemory gpu = gl::gpuMemory();
    parts.append({tr("Textures"), tr("Of the scene, its light, and the pictures being drawn"),
                  gpu.textures});
    parts.append(
        {tr("Buffers"), tr("Triangles, lights and baked values for drawing"), gpu.buffers});
    for (const Keeper& keeper : m_keepers)
        parts.append({keeper.name, keeper.help, keeper.bytes(), true});
    std::ranges::stable_sort(parts, std::ranges::greater(), &MemoryPart::bytes);
    std::size_t known = 0;
    for (const MemoryPart& part : parts)
        known += part.bytes;
    parts.append({tr("Everything else"),
                  tr("The program, the graphics driver with its shaders, and work in progress"),
                  residentMemory() - std::min(residentMemory(), known)});
    return parts;
}

void MemoryUse::setBudget(std::size_t bytes) {
    m_budget = std::max(bytes, kLeastBudget);
    QSettings().setValue(budgetKey(), QVariant::fromValue<qulonglong>(m_budget));
    keepToBudget();
}

void MemoryUse::keepToBudget() {
    std::size_t all = kept();
    if (all <= m_budget)
        return;
    for (const Keeper& keeper : m_keepers) {
        const std::size_t own = keeper.bytes(), others = all - own;
        keeper.free(m_budget - std::min(m_budget, others));
        all = others + keeper.bytes();
        if (all <= m_budget)
            break;
    }
    returnFreedMemory();
}

void MemoryUse::freeNow() {
    for (qsizetype i = 0; i + 1 < m_keepers.size(); ++i) // the last are the undo steps
        m_keepers[i].free(0);
    returnFreedMemory();
}

} // namespace patina::editor
