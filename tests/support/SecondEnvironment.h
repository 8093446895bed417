// A second environment in the mix of a document.
#pragma once

#include "core/document/Document.h"

#include <string>
#include <utility>

namespace patina::test {

// References to environments that were there before are no longer good.
inline Environment& addSecond(Document& document, const std::string& source, ImagePtr image) {
    Environment& second = document.environments.emplace_back();
    second.id = document.mix.second = document.takeId();
    second.source = source;
    second.image = second.fileImage = std::move(image);
    return second;
}

} // namespace patina::test
