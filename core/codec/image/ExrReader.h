// OpenEXR files as OpenImageIO 2.4 reads them: the order of channels, names of attributes, windows.
// Half and float, scan lines and tiles, one part or many.
#pragma once

#include <memory>
#include <string>

namespace patina::codec {

class PictureReader;

// Null where the first part has channels of a lower resolution (LuminanceChroma.h). Throws HandOn
// and what OpenEXR throws.
std::unique_ptr<PictureReader> readExr(const std::string& file);

// Makes OpenEXR's tables, which every reader would make for itself.
void prepareExr();

} // namespace patina::codec
