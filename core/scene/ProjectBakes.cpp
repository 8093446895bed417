#include "core/scene/ProjectBakes.h"

#include "core/bake/file/BakeIO.h"
#include "core/base/Leftovers.h"
#include "core/base/Limits.h"
#include "core/base/OwnFile.h"
#include "core/document/AbsentBake.h"
#include "core/document/Document.h"
#include "core/scene/ProjectJson.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <system_error>
#include <vector>

namespace patina::project {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHashDigits = 16;
constexpr std::string_view kExtension = ".exr";

std::string fileName(BakeKind kind, const Hash& content) {
    const auto name =
        std::ranges::find(kBakeKinds, kind, &std::pair<BakeKind, std::string_view>::first);
    return fmt::format("{}-{}{}", name->second, content.hex().substr(0, kHashDigits), kExtension);
}

// "prtVertex-0123456789abcdef.exr", and "prtVertex.exr" as earlier versions wrote it.
bool isBakeName(std::string_view name) {
    if (!name.ends_with(kExtension))
        return false;
    name.remove_suffix(kExtension.size());
    return std::ranges::any_of(kBakeKinds, [&](const auto& kind) {
        if (!name.starts_with(kind.second))
            return false;
        const std::string_view rest = name.substr(kind.second.size());
        return rest.empty() ||
               (rest.size() == kHashDigits + 1 && rest.front() == '-' &&
                rest.find_first_not_of("0123456789abcdef", 1) == std::string_view::npos);
    });
}

// Whether the file holds just this: then it is not written again. A link is not looked through.
bool holds(const fs::path& file, const Bytes& content) {
    std::error_code error;
    if (!fs::is_regular_file(fs::symlink_status(file, error)) ||
        fs::file_size(file, error) != content.size() || error)
        return false;
    const Result<Bytes> there = readFile(file, content.size());
    return there && *there == content;
}

} // namespace

fs::path bakeFolder(const fs::path& projectFile) {
    fs::path folder = projectFile;
    return folder.replace_extension(".bakes");
}

Result<BakeNames> writeBakes(WorkerClient& worker, const Document& document,
                             const fs::path& projectFile) {
    BakeNames names;
    for (const BakeArtifactPtr& bake : document.bakes) {
        if (!bake)
            continue;
        if (isAbsent(*bake)) {
            names[bake->kind] = bake->missingFile;
            continue;
        }
        const Result<Bytes> bytes = encodeBake(worker, *bake, document);
        if (!bytes)
            return bytes.error();
        const fs::path folder = bakeFolder(projectFile);
        if (Result<void> made = makeOwnFolder(folder); !made)
            return made.error();
        const fs::path file = folder / fileName(bake->kind, hashBytes(*bytes));
        names[bake->kind] = file.string();
        if (holds(file, *bytes))
            continue;
        if (Result<void> written = writeOwnFile(file, *bytes); !written)
            return written.error();
    }
    return names;
}

void removeOldBakes(const fs::path& projectFile, const BakeNames& named) {
    const fs::path folder = bakeFolder(projectFile);
    std::error_code error; // what cannot be listed or removed stays: it harms nobody
    if (!fs::is_directory(fs::symlink_status(folder, error)))
        return;
    std::set<fs::path> kept;
    for (const auto& [kind, file] : named)
        kept.insert(fs::path(file).lexically_normal());
    std::vector<fs::path> old;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
        if (isBakeName(entry->path().filename().string()) &&
            !kept.contains(entry->path().lexically_normal()))
            old.push_back(entry->path());
    for (const fs::path& file : old)
        fs::remove(file, error);
    removeAllLeftovers(folder);
    fs::remove(folder, error); // only when nothing is left in it
}

} // namespace patina::project
