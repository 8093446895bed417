#include "core/radiosity/document/GltfParts.h"

#include "core/base/Limits.h"

#include <algorithm>
#include <fmt/format.h>

namespace patina::gltf {
namespace {

namespace fs = std::filesystem;

// Values of the GLB specification.
constexpr std::uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

constexpr const char* kMapKey = "patinaLightMap";

int digitAt(const std::string& text, std::size_t i) {
    const char c = i < text.size() ? text[i] : 'x';
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

} // namespace

std::size_t whole(const Json& object, const char* key, std::optional<std::size_t> whereMissing) {
    const auto found = object.find(key);
    if (found == object.end() && whereMissing)
        return *whereMissing;
    if (found == object.end() || !found->is_number_unsigned())
        throw Broken(fmt::format("\"{}\" is missing or no whole number", key));
    return found->get<std::size_t>();
}

const Json& at(const Json& root, const char* list, std::size_t index) {
    const auto found = root.find(list);
    if (found == root.end() || !found->is_array() || index >= found->size())
        throw Broken(fmt::format("there is no element {} of \"{}\"", index, list));
    return (*found)[index];
}

const Json& member(const Json& object, const char* key) {
    static const Json kNothing;
    const auto found = object.find(key);
    return found != object.end() ? *found : kNothing;
}

std::string besideName(const std::string& name) {
    if (!liesBeside(name))
        throw Broken(
            fmt::format("it names \"{:.80}\", which is no file beside it; write it as .glb", name));
    return name;
}

std::string fileOf(const std::string& uri) {
    std::string name;
    for (std::size_t i = 0; i < uri.size(); ++i)
        if (uri[i] == '%' && digitAt(uri, i + 1) >= 0 && digitAt(uri, i + 2) >= 0) {
            name += static_cast<char>(16 * digitAt(uri, i + 1) + digitAt(uri, i + 2));
            i += 2;
        } else {
            name += uri[i];
        }
    if (uri.starts_with("data:") || name.find("://") != std::string::npos)
        throw Broken(
            fmt::format("it names \"{:.80}\", which is no file beside it; write it as .glb", uri));
    return besideName(name);
}

void addPictures(const fs::path& from, const fs::path& to, const std::vector<std::string>& pictures,
                 FilesTogether& files, std::vector<std::string>& notices) {
    const auto folderOf = [](const fs::path& file) {
        return file.has_parent_path() ? file.parent_path() : fs::path(".");
    };
    if (isSameFile(folderOf(from), folderOf(to)))
        return;
    for (const std::string& picture : pictures) {
        Result<Bytes> bytes = readFile(folderOf(from) / picture, limits::kMaxModelFileBytes);
        if (bytes)
            files.add(folderOf(to) / picture, *std::move(bytes));
        else
            notices.push_back(bytes.error().text());
    }
}

bool isGlb(const Bytes& file) {
    return file.size() >= 4 && numberAt<std::uint32_t>(file, 0) == kMagic;
}

GlbChunks chunksOf(const Bytes& glb) {
    const auto word = [&](std::size_t offset) {
        if (offset + 4 > glb.size())
            throw Broken("it ends before its data do");
        return numberAt<std::uint32_t>(glb, offset);
    };
    if (word(0) != kMagic || word(4) != 2 || word(16) != kJsonChunk)
        throw Broken("it is no glTF 2.0 binary file");
    const std::size_t length = word(12);
    if (20 + length > glb.size())
        throw Broken("it ends before its data do");
    GlbChunks chunks;
    chunks.json = {reinterpret_cast<const char*>(glb.data()) + 20, length};
    chunks.end = std::min(20 + (length + 3) / 4 * 4, glb.size());
    if (chunks.end < glb.size() && word(chunks.end + 4) == kBinaryChunk) {
        chunks.binary = chunks.end + 8;
        chunks.binaryLength = std::min<std::size_t>(word(chunks.end), glb.size() - chunks.binary);
        chunks.end = std::min(chunks.binary + (chunks.binaryLength + 3) / 4 * 4, glb.size());
    }
    return chunks;
}

Json parse(std::string_view text) {
    const Json::parser_callback_t limited = [](int depth, Json::parse_event_t, const Json&) {
        if (depth > limits::kMaxJsonDepth)
            throw Broken("it is nested too deep");
        return true;
    };
    Json root = Json::parse(text.begin(), text.end(), limited, false);
    if (root.is_discarded() || !root.is_object())
        throw Broken("its JSON is damaged");
    return root;
}

bool showsLightMap(const Json& root) {
    return member(member(root, "extras"), kMapKey).is_object();
}

} // namespace patina::gltf
