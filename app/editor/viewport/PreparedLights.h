// Image-based light that is prepared: the lights used last in memory, as far as a budget allows,
// and those of earlier sessions on disk (IblCache). Shared by the viewport, the cells of a wall and
// the Light Lab, so that an environment that was shown is shown again in the next frame.
#pragma once

#include "app/editor/viewport/IblWork.h"

#include <cstddef>
#include <filesystem>
#include <list>
#include <mutex>
#include <optional>

namespace patina::editor {

class PreparedLights {
  public:
    // Some ten environments of 1024 × 512.
    static constexpr std::size_t kDefaultBudget = std::size_t{160} << 20; // bytes

    // `cacheFolder`: of IblCache.
    explicit PreparedLights(const std::filesystem::path& cacheFolder,
                            std::size_t budget = kDefaultBudget);

    // What memory holds of this very picture, without its maps, or nothing. It takes no time. On
    // any thread.
    [[nodiscard]] std::optional<IblLight> known(const ImagePtr& environment);
    // From memory or from disk in full, or else small. Of what memory holds the maps are null.
    // Errors: Cancelled. On any thread.
    Result<IblLight> first(const ImagePtr& environment, const JobContext& job);
    // Keeps full light in memory, in place of what was used longest ago; none that exceeds the
    // budget alone. A scene that only ever had one environment keeps none: it never
    // needs it again. On any thread.
    void keep(const IblLight& full);

    [[nodiscard]] std::size_t bytes() const; // in memory
    void free(std::size_t most); // those used longest ago go until the others take so much
    [[nodiscard]] const IblCache& disk() const { return m_disk; }

  private:
    struct Entry {
        Hash key;
        EnvironmentTexelsPtr texels;
    };
    [[nodiscard]] std::optional<IblLight> find(auto matches); // used last from now on
    void keepTo(std::size_t most);                            // m_mutex is held

    IblCache m_disk;
    const std::size_t m_budget;
    mutable std::mutex m_mutex; // guards what follows
    std::list<Entry> m_entries; // the one used last first
    std::size_t m_bytes = 0;
    std::optional<Hash> m_only; // of the one environment that there was so far …
    bool m_several = false;     // … until there was another
};

} // namespace patina::editor
