// Which keys of a model file that is JSON (glTF) are used, kept or left out.
#pragma once

#include <cstddef>
#include <string>

namespace patina {

enum class KeyUse {
    Used,   // shows in the scene
    Kept,   // stays with the scene without being seen: names
    LeftOut // makes no difference
};

struct ModelKey {
    std::string key; // "meshes[].primitives[].attributes.POSITION": of all elements of the arrays
    KeyUse use = KeyUse::LeftOut;
    std::string why;       // of those that are left out
    std::size_t count = 0; // how often the file has the key, with this use
    friend bool operator==(const ModelKey&, const ModelKey&) = default;
};

} // namespace patina
