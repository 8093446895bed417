#include "core/scene/OutsideGrants.h"

#include "core/base/AtomicFile.h"
#include "core/base/FileLock.h"
#include "core/scene/ProjectPath.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace patina {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMostGrantBytes = std::size_t{8} << 20;
constexpr std::chrono::seconds kGrantPatience(5); // for another one that adds

// One name for a project, however it is spelled.
std::string nameOf(const fs::path& project) {
    std::error_code failed;
    const fs::path name = fs::weakly_canonical(fs::absolute(project, failed), failed);
    return failed ? project.string() : name.string();
}

// Paths are bytes and JSON is text.
std::string textOf(const std::string& path) {
    return toProjectPath(path, "/root.patina");
}
std::string pathOf(const std::string& text) {
    return fromProjectPath(text, "/root.patina").value_or(std::string());
}

struct Entry {
    std::string project;
    std::set<std::string> files;
};

// Newest first. A file that is damaged holds none: the user is asked again.
std::vector<Entry> readEntries(const fs::path& kept) {
    std::vector<Entry> entries;
    if (kept.empty())
        return entries;
    const Result<std::string> text = readTextFile(kept, kMostGrantBytes);
    if (!text)
        return entries;
    try {
        for (const json& one : json::parse(*text)) {
            Entry entry{pathOf(one.at("project")), {}};
            for (const json& file : one.at("files"))
                entry.files.insert(pathOf(file));
            entries.push_back(std::move(entry));
        }
    } catch (const json::exception&) {
        entries.clear();
    }
    return entries;
}

std::string written(const std::vector<Entry>& entries) {
    json list = json::array();
    for (const Entry& entry : entries) {
        json files = json::array();
        for (const std::string& file : entry.files)
            files.push_back(textOf(file));
        list.push_back({{"project", textOf(entry.project)}, {"files", std::move(files)}});
    }
    return list.dump(1) + "\n";
}

} // namespace

fs::path outsideGrantsFile() {
    const auto folder = [](const char* variable) {
        // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody changes them
        const char* value = std::getenv(variable);
        const fs::path path = value != nullptr ? value : "";
        return path.is_absolute() ? path : fs::path();
    };
    fs::path state = folder("XDG_STATE_HOME");
    if (state.empty())
        if (const fs::path home = folder("HOME"); !home.empty())
            state = home / ".local/state";
    return state.empty() ? fs::path() : state / "Patina/outside-pictures.json";
}

std::set<std::string> outsideGrants(const fs::path& project, const fs::path& kept) {
    const std::string name = nameOf(project);
    for (Entry& entry : readEntries(kept))
        if (entry.project == name)
            return std::move(entry.files);
    return {};
}

Result<void> grantOutside(const fs::path& project, const std::vector<std::string>& files,
                          const fs::path& kept, std::size_t mostProjects) {
    if (files.empty() || kept.empty())
        return {};
    std::error_code ignored;
    fs::create_directories(kept.parent_path(), ignored); // or the lock says why it cannot be
    const Result<std::optional<FileLock>> lock = FileLock::takeWhenFree(kept, kGrantPatience);
    if (!lock)
        return lock.error();
    std::vector<Entry> entries = readEntries(kept);
    const std::string name = nameOf(project);
    auto known = std::ranges::find(entries, name, &Entry::project);
    if (known == entries.end())
        known = entries.insert(entries.end(), {name, {}});
    else if (std::ranges::all_of(files,
                                 [&](const auto& file) { return known->files.contains(file); }))
        return {};
    known->files.insert(files.begin(), files.end());
    std::rotate(entries.begin(), known, known + 1);
    entries.resize(std::min(entries.size(), mostProjects));
    return writeFileAtomically(kept, written(entries));
}

} // namespace patina
