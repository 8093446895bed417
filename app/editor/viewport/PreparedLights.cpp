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

std::optional<IblLight> PreparedLights::find(auto matches) {
    const std::scoped_lock lock(m_mutex);
    const auto entry = std::ranges::find_if(m_entries, matches);
    if (entry == m_entries.end())
        return std::nullopt;
    m_entries.splice(m_entries.begin(), m_entries, entry);
    IblLight light;
    light.environment = entry->texels->image;
    light.key = entry->key;
    light.background = entry->texels->background;
    light.full = true;
    light.texels = entry->texels;
    return light;
}

std::optional<IblLight> PreparedLights::known(const ImagePtr& environment) {
    return find([&](const Entry& entry) { return entry.texels->image == environment; });
}

Result<IblLight> PreparedLights::first(const ImagePtr& environment, const JobContext& job) {
    if (std::optional<IblLight> light = known(environment))
        return std::move(*light);
    const Hash key = iblKey(*environment);
    if (std::optional<IblLight> light = find([&](const Entry& e) { return e.key == key; })) {
        // The same content: its file was read again.
        EnvironmentTexels texels = *light->texels;
        texels.image = environment;
        light->environment = environment;
        light->texels = std::make_shared<const EnvironmentTexels>(std::move(texels));
        return std::move(*light);
    }
    Result<IblLight> light = firstIbl(m_disk, environment, key, job);
    if (light && light->full)
        keep(*light);
    return light;
}

void PreparedLights::keep(const IblLight& full) {
    const std::scoped_lock lock(m_mutex);
    m_several = m_several || (m_only && *m_only != full.key);
    m_only = full.key;
    if (!m_several || std::ranges::find(m_entries, full.key, &Entry::key) != m_entries.end())
        return;
    m_entries.push_front({full.key, full.texels});
    m_bytes += bytesOf(*full.texels);
    keepTo(m_budget);
}

void PreparedLights::free(std::size_t most) {
    const std::scoped_lock lock(m_mutex);
    keepTo(most);
}

void PreparedLights::keepTo(std::size_t most) {
    while (m_bytes > most) {
        m_bytes -= bytesOf(*m_entries.back().texels);
        m_entries.pop_back();
    }
}

std::size_t PreparedLights::bytes() const {
    const std::scoped_lock lock(m_mutex);
    return m_bytes;
}

} // namespace patina::editor
