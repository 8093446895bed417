// OpenEXR files of our own pixels, byte for byte those that OpenImageIO 2.4 writes.
#pragma once

#include "core/codec/Codec.h"

namespace patina::codec {

// `request` and `payload` as codec::encodeImage() gets them, with attributes that mean nothing to
// OpenEXR (core/io/ImageEncode.cpp sees to that). Throws Refusal and std::bad_alloc.
Reply encodeExr(const nlohmann::json& request, std::span<const std::byte> payload);

} // namespace patina::codec
