#include "core/codec/model/MeshoptViews.h"

#include "core/codec/Codec.h"

#include <fmt/format.h>
#include <meshoptimizer.h>
#include <nlohmann/json.hpp>
#include <string>

namespace patina::codec {

namespace {

using nlohmann::json;

[[noreturn]] void refuseView(const std::string& detail) {
    throw Refusal("the file is damaged or cut short; export or download it again",
                  "EXT_meshopt_compression: " + detail);
}

// The best that the vertex codec does: 16 equal bytes in two bits, beside a header.
constexpr std::size_t kMostRatio = 64, kSmall = 4096;

struct Layout {
    std::size_t count, stride;
    std::string mode, filter;
};

// What the extension's schema asks for; meshoptimizer takes it for granted.
Layout layoutOf(const json& extension, std::size_t bytes) {
    const Layout layout{extension.at("count").get<std::size_t>(),
                        extension.at("byteStride").get<std::size_t>(),
                        extension.at("mode").get<std::string>(), extension.value("filter", "NONE")};
    const std::size_t stride = layout.stride;
    const bool vertices = layout.mode == "ATTRIBUTES";
    if (!vertices && layout.mode != "TRIANGLES" && layout.mode != "INDICES")
        refuseView(fmt::format("mode {}", layout.mode));
    if (vertices ? stride < 4 || stride > 256 || stride % 4 != 0 : stride != 2 && stride != 4)
        refuseView(fmt::format("a stride of {} bytes", stride));
    if (layout.mode == "TRIANGLES" && layout.count % 3 != 0)
        refuseView(fmt::format("triangles of {} corners", layout.count));
    const bool fits = layout.filter == "NONE"          ? true
                      : layout.filter == "OCTAHEDRAL"  ? stride == 4 || stride == 8
                      : layout.filter == "QUATERNION"  ? stride == 8
                      : layout.filter == "EXPONENTIAL" ? stride % 4 == 0
                                                       : false;
    if (!fits || (!vertices && layout.filter != "NONE"))
        refuseView(fmt::format("filter {} of elements of {} bytes", layout.filter, stride));
    if (layout.count > (kMostRatio * bytes + kSmall) / stride)
        refuseView(fmt::format("{} elements in {} bytes", layout.count, bytes));
    return layout;
}

} // namespace

const json* meshoptOf(const json& view) {
    const auto extensions = view.find("extensions");
    if (extensions == view.end() || !extensions->is_object())
        return nullptr;
    const auto found = extensions->find("EXT_meshopt_compression");
    return found == extensions->end() ? nullptr : &*found;
}

std::vector<std::byte> decodeMeshopt(const json& extension, std::span<const std::byte> bytes) {
    const Layout layout = layoutOf(extension, bytes.size());
    std::vector<std::byte> result(layout.count * layout.stride);
    if (layout.count == 0)
        return result;
    const auto* source = reinterpret_cast<const unsigned char*>(bytes.data());
    using Decode = int (*)(void*, std::size_t, std::size_t, const unsigned char*, std::size_t);
    Decode decode = meshopt_decodeVertexBuffer;
    if (layout.mode == "TRIANGLES")
        decode = meshopt_decodeIndexBuffer;
    else if (layout.mode == "INDICES")
        decode = meshopt_decodeIndexSequence;
    if (decode(result.data(), layout.count, layout.stride, source, bytes.size()) != 0)
        refuseView(fmt::format("{} that cannot be decoded", layout.mode));
    if (layout.filter == "OCTAHEDRAL")
        meshopt_decodeFilterOct(result.data(), layout.count, layout.stride);
    else if (layout.filter == "QUATERNION")
        meshopt_decodeFilterQuat(result.data(), layout.count, layout.stride);
    else if (layout.filter == "EXPONENTIAL")
        meshopt_decodeFilterExp(result.data(), layout.count, layout.stride);
    return result;
}

} // namespace patina::codec
