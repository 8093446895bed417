#include "core/radiosity/file/ResumableRadiosity.h"

#include "core/radiosity/file/RadiosityMerge.h"

#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace patina::radiosity {
namespace {

constexpr std::string_view kDoes = "computes this radiosity"; // who holds its checkpoint

Error otherRadiosity(const std::filesystem::path& file, const std::string& why) {
    return {ErrorKind::InputBroken,
            fmt::format("this checkpoint is of another radiosity: they differ in {}; remove it, or "
                        "bake without resuming",
                        why),
            file,
            {}};
}

} // namespace

void ResumableRadiosity::hold() {
    m_lock.hold(m_settings.checkpoint, kDoes, m_settings.warn);
}

Result<void> ResumableRadiosity::divide(ElementMesh& elements) {
    hold();
    const std::filesystem::path& file = m_settings.checkpoint;
    std::error_code ignored;
    if (!m_settings.resume || file.empty() || !std::filesystem::exists(file, ignored))
        return {};
    Result<RadiosityManifest> there = readRadiosityManifest(file);
    if (!there)
        return there.error();
    const RadiosityManifest& here = m_settings.manifest;
    if (const auto why = whyDifferent(*there, here))
        return otherRadiosity(file, *why);
    if (there->shard != here.shard)
        return otherRadiosity(file, fmt::format("the part (part {} of {} there, {} of {} here)",
                                                there->shard.index + 1, there->shard.count,
                                                here.shard.index + 1, here.shard.count));
    m_from = *std::move(there);
    return divideAsIn(file, elements);
}

Result<void> ResumableRadiosity::begin(const TraceScene& scene, const ElementMesh& elements) {
    m_settings.manifest.elements = hashElements(scene, elements);
    m_settings.manifest.elementCount = elements.size();
    const bool first = m_state.light.size() == 0;
    forget(elements);
    m_last = Clock::now(); // what came before is not kept
    if (!first || !m_from)
        return {};
    if (const auto why = whyDifferent(*m_from, m_settings.manifest))
        return otherRadiosity(m_settings.checkpoint, *why);
    if (Result<void> read = readRadiosity(m_settings.checkpoint, m_settings.maxRowBytes, m_state);
        !read)
        return read;
    m_kept = true;
    return {};
}

void ResumableRadiosity::between(const SolverView& solver) {
    if (m_settings.checkpoint.empty())
        return;
    // The others go on meanwhile: what they find is not in this checkpoint.
    const std::unique_lock one(m_keeping, std::try_to_lock);
    if (!one ||
        std::chrono::duration<double>(Clock::now() - m_last).count() < m_settings.everySeconds)
        return;
    keep(solver);
    m_last = Clock::now();
}

bool ResumableRadiosity::keep(const SolverView& solver) {
    if (m_settings.checkpoint.empty() || m_state.light.size() == 0)
        return false;
    const Result<void> written = writeRadiosity(m_settings.checkpoint, m_settings.manifest, m_state,
                                                solver, StateFileName::Own);
    m_kept = m_kept || written.ok();
    if (!written && !m_warned && m_settings.warn)
        m_settings.warn(written.error());
    m_warned = m_warned || !written;
    return written.ok();
}

void ResumableRadiosity::finish(bool interrupted) {
    const double seconds = std::chrono::duration<double>(Clock::now() - m_start).count();
    if (interrupted ? m_settings.keepOnCancel : seconds >= m_settings.everySeconds)
        keep(viewOf(m_state.solver));
}

Result<void> ResumableRadiosity::writePart(const std::filesystem::path& file) {
    return writeRadiosity(file, m_settings.manifest, m_state, {}, StateFileName::OfUser);
}

bool ResumableRadiosity::removeCheckpoint() {
    m_kept = false;
    return m_lock.remove(m_settings.checkpoint, kDoes, m_settings.warn);
}

} // namespace patina::radiosity
