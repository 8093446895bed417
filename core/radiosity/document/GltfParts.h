// A glTF file as its JSON and its bytes, for those who change a part of one and leave the rest as
// it is. Private to this module.
#pragma once

#include "core/base/AtomicFile.h"
#include "core/radiosity/document/FilesTogether.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace patina::gltf {

using Json = nlohmann::ordered_json;

// Leaves the module as an Error (InputBroken).
struct Broken : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// Of a value that is of another kind than the specification has it (Json::exception).
inline constexpr const char* kNotAsSpecified =
    "its JSON is not as glTF 2.0 has it; write it again, or bake the scene again";

template <class Number>
Number numberAt(const Bytes& bytes, std::size_t offset) {
    Number result{};
    std::memcpy(&result, bytes.data() + offset, sizeof result);
    return result;
}

// A whole number of an object; `whereMissing`, or Broken.
[[nodiscard]] std::size_t whole(const Json& object, const char* key,
                                std::optional<std::size_t> whereMissing = std::nullopt);
// An element of one of the root's lists. Throws Broken where there is none.
[[nodiscard]] const Json& at(const Json& root, const char* list, std::size_t index);
// A value of an object; null where there is none.
[[nodiscard]] const Json& member(const Json& object, const char* key);

// A name as that of a file in the same folder or below. Throws Broken.
[[nodiscard]] std::string besideName(const std::string& name);
// The same for a URI.
[[nodiscard]] std::string fileOf(const std::string& uri);

// Pictures that a file names are where it was: a folder that it moves to gets them, too. `notices`:
// of those that cannot be read.
void addPictures(const std::filesystem::path& from, const std::filesystem::path& to,
                 const std::vector<std::string>& pictures, FilesTogether& files,
                 std::vector<std::string>& notices);

[[nodiscard]] bool isGlb(const Bytes& file);
// Offsets within a .glb. Without a binary chunk its length is 0. `end`: where chunks of others
// begin.
struct GlbChunks {
    std::string_view json;
    std::size_t binary = 0, binaryLength = 0, end = 0;
};
// Throws Broken.
[[nodiscard]] GlbChunks chunksOf(const Bytes& glb);
// Throws Broken: damaged, nested too deep, no object.
[[nodiscard]] Json parse(std::string_view text);
// Whether its surfaces show a light map of Patina's.
[[nodiscard]] bool showsLightMap(const Json& root);

} // namespace patina::gltf
