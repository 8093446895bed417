#include "core/recovery/RecoveryRecord.h"

#include "core/base/AtomicFile.h"
#include "core/base/Limits.h"
#include "core/base/Utf8.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/scene/ProjectJson.h"
#include "core/scene/ProjectPath.h"

#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>

namespace patina {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr const char* kFormat = "patina-recovery";
constexpr std::size_t kHashDigits = 32;
// The project's text is quoted, which makes it longer.
constexpr std::size_t kMaxFileBytes = 2 * limits::kMaxProjectFileBytes;

// Paths as in projects: file names are bytes, JSON is not.
std::string pathToText(const fs::path& path) {
    return toProjectPath(path.string(), "/");
}

std::optional<Hash> hashFromHex(std::string_view hex) {
    Hash hash;
    if (hex.size() != kHashDigits)
        return std::nullopt;
    const auto read = [](std::string_view digits, std::uint64_t& value) {
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
        return error == std::errc() && end == digits.data() + digits.size();
    };
    if (!read(hex.substr(0, 16), hash.high) || !read(hex.substr(16), hash.low))
        return std::nullopt;
    return hash;
}

Hash hashText(std::string_view text) {
    return hashBytes(std::as_bytes(std::span(text.data(), text.size())));
}

Json toJson(const RecoveryRecord& record) {
    Json json{{"format", kFormat},
              {"version", kVersion},
              {"name", makeValidUtf8(record.name)},
              {"file", record.file.empty() ? std::string() : pathToText(record.file)},
              {"savedContent", record.savedContent.hex()},
              {"writtenAt", record.writtenAt},
              {"unsavedSince", record.unsavedSince},
              {"steps", record.steps},
              {"lastStep", makeValidUtf8(record.lastStep)},
              {"meshes", record.meshes},
              {"materials", record.materials},
              {"lights", record.lights}};
    json["bakes"] = Json::array();
    for (const RecoveryBake& bake : record.bakes)
        for (const auto& [kind, name] : project::kBakeKinds)
            if (bake.kind == kind)
                json["bakes"].push_back({{"kind", std::string(name)},
                                         {"content", bake.content.hex()},
                                         {"inputs", bake.inputs.hex()},
                                         {"samplesDone", bake.samplesDone}});
    json["leftOut"] = Json::array();
    for (const std::string& text : record.leftOut)
        json["leftOut"].push_back(makeValidUtf8(text));
    json["outside"] = Json::array();
    for (const std::string& source : record.outside)
        json["outside"].push_back(pathToText(source));
    json["project"] = record.project;
    return json;
}

// Throws Json::exception where a value is missing or of another type.
std::optional<RecoveryRecord> fromJson(const Json& json) {
    if (json.at("format") != kFormat || json.at("version") != kVersion)
        return std::nullopt;
    RecoveryRecord record;
    record.name = json.at("name").get<std::string>();
    if (const auto file = json.at("file").get<std::string>(); !file.empty()) {
        const std::optional<std::string> path = fromProjectPath(file, "/");
        if (!path)
            return std::nullopt;
        record.file = *path;
    }
    const auto hash = [](const Json& value) { return hashFromHex(value.get<std::string>()); };
    const std::optional<Hash> saved = hash(json.at("savedContent"));
    if (!saved)
        return std::nullopt;
    record.savedContent = *saved;
    record.writtenAt = json.at("writtenAt").get<std::int64_t>();
    record.unsavedSince = json.at("unsavedSince").get<std::int64_t>();
    record.steps = json.at("steps").get<int>();
    record.lastStep = json.at("lastStep").get<std::string>();
    record.meshes = json.at("meshes").get<int>();
    record.materials = json.at("materials").get<int>();
    record.lights = json.at("lights").get<int>();
    for (const Json& value : json.at("bakes")) {
        const auto kind = value.at("kind").get<std::string>();
        const auto known = std::ranges::find(project::kBakeKinds, kind,
                                             [](const auto& entry) { return entry.second; });
        const std::optional<Hash> content = hash(value.at("content"));
        const std::optional<Hash> inputs = hash(value.at("inputs"));
        if (known == project::kBakeKinds.end() || !content || !inputs)
            return std::nullopt;
        record.bakes.push_back(
            {known->first, *content, *inputs, value.at("samplesDone").get<int>()});
    }
    for (const Json& text : json.at("leftOut"))
        record.leftOut.push_back(text.get<std::string>());
    // (Earlier versions left nothing out.)
    for (const Json& text : json.value("outside", Json::array())) {
        const std::optional<std::string> path = fromProjectPath(text.get<std::string>(), "/");
        if (!path)
            return std::nullopt;
        record.outside.push_back(*path);
    }
    record.project = json.at("project").get<std::string>();
    return record;
}

} // namespace

fs::path RecoveryRecord::projectFile() const {
    return file.empty() ? fs::path("/untitled.patina") : file;
}

Result<void> writeRecoveryRecord(const fs::path& file, const RecoveryRecord& record) {
    const std::string text = toJson(record).dump() + "\n";
    return writeFileAtomically(file, text + hashText(text).hex());
}

Result<RecoveryRecord> readRecoveryRecord(const fs::path& file) {
    Result<std::string> text = readTextFile(file, kMaxFileBytes);
    if (!text)
        return text.error();
    const auto broken = [&](std::string detail) {
        return Error{ErrorKind::InputBroken,
                     "the unsaved work cannot be read: the file is damaged, or of a newer Patina",
                     file, std::move(detail)};
    };
    if (text->size() < kHashDigits)
        return broken("cut short");
    const std::string_view content(text->data(), text->size() - kHashDigits);
    if (std::string_view(*text).substr(content.size()) != hashText(content).hex())
        return broken("the hash at its end is another");
    try {
        if (std::optional<RecoveryRecord> record = fromJson(Json::parse(content)))
            return *std::move(record);
        return broken("unknown values");
    } catch (const Json::exception& problem) {
        return broken(makeValidUtf8(problem.what()));
    }
}

Hash hashFile(const fs::path& file) {
    const Result<Bytes> bytes = readFile(file, limits::kMaxProjectFileBytes);
    return bytes ? hashBytes(*bytes) : Hash{};
}

} // namespace patina
