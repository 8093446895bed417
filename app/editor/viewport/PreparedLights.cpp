#include "app/editor/viewport/PreparedLights.h"

#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {

std::size_t bytesOf(const HalfPicture& picture) {
    return picture.texels.size() * sizeof(std::uint16_t);
}

// Its picture is counted, too, though a scene may hold it as well.
std::size_t bytesOf(const EnvironmentTexels& texels) {
    std::size_t bytes = bytesOf(texels.prefiltered) + texels.image->bytes().size();
    for (const HalfPicture& level : *texels.background)
        bytes += bytesOf(level);
    return bytes;
}

} // namespace

PreparedLights::PreparedLights(const std::filesystem::path& cacheFolder, std::size_t budget)
    : m_disk(cacheFolder)
    , m_budget(budget) {}

Result<IblLight> PreparedLights::first(const ImagePtr& environment, const JobContext& job) {
    const Hash key = iblKey(*environment);
    if (EnvironmentTexelsPtr known = find(key)) {
        IblLight light;
        light.environment = environment;
        light.key = key;
        light.background = known->background;
        light.full = true;
        light.texels = known;
        if (known->image != environment) { // the same content: its file was read again
            EnvironmentTexels texels = *known;
            texels.image = environment;
            light.texels = std::make_shared<const EnvironmentTexels>(std::move(texels));
        }
        return light;
    }
    Result<IblLight> light = firstIbl(m_disk, environment, key, job);
    if (light && light->full)
        keep(*light);
    return light;
}

EnvironmentTexelsPtr PreparedLights::find(const Hash& key) {
    const std::scoped_lock lock(m_mutex);
    const auto entry = std::ranges::find(m_entries, key, &Entry::key);
    if (entry == m_entries.end())
        return nullptr;
    m_entries.splice(m_entries.begin(), m_entries, entry);
    return entry->texels;
}

void PreparedLights::keep(const IblLight& full) {
    const std::scoped_lock lock(m_mutex);
    m_several = m_several || (m_only && *m_only != full.key);
    m_only = full.key;
    if (!m_several || std::ranges::find(m_entries, full.key, &Entry::key) != m_entries.end())
        return;
    m_entries.push_front({full.key, full.texels});
    m_bytes += bytesOf(*full.texels);
    while (m_bytes > m_budget) {
        m_bytes -= bytesOf(*m_entries.back().texels);
        m_entries.pop_back();
    }
}

std::size_t PreparedLights::bytes() const {
    const std::scoped_lock lock(m_mutex);
    return m_bytes;
}

} // namespace patina::editor
