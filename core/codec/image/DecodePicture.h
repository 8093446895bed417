// What all picture files have in common once a library has opened them: limits, the choice of parts
// and channels, the display window, reduction. One function, so that both workers answer alike.
#pragma once

#include "core/codec/Codec.h"
#include "core/codec/image/PictureReader.h"

namespace patina::codec {

// `request` as codec::decodeImage() gets it; `payloadFd` is the file. Throws what the reader
// throws.
Reply decodePicture(PictureReader& reader, const nlohmann::json& request, int payloadFd);

// The first line of what a library says: some repeat themselves for each row.
std::string libraryText(const std::string& format, std::string error);

// Numbers of an attribute, as text.
std::string joined(std::span<const float> values);

} // namespace patina::codec
