// Files of the kinds that the worker for images reads itself, with what the formats allow and what
// is seldom used, written by the formats' own libraries.
#pragma once

#include "core/base/AtomicFile.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace patina::test {

struct SampleFile {
    std::string name;
    std::string format; // "png", "jpeg", "openexr"
    Bytes bytes;
};

// Read here exactly as OpenImageIO reads them, and handed on, of which there must be fewer.
struct SampleFiles {
    std::vector<SampleFile> read, handedOn;
};

// A colour profile without any content.
std::string emptyProfile();

SampleFiles pngFiles();
SampleFiles jpegFiles();
SampleFiles exrFiles(const std::filesystem::path& folder); // written there

} // namespace patina::test
